# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the tables of docs/verification/elastic-tube.md anew and holds them against the committed ones:
elastic_tube.py SOURCE PROGRAM FOLDER.
"""

import os
import shutil
import subprocess
import sys

from page import hold


def main():
    source, program, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    committed = os.path.join(source, "docs", "verification", "elastic-tube.md")
    made = os.path.join(folder, "elastic-tube.md")
    shutil.copyfile(committed, made)
    subprocess.run(
        [program, os.path.join(source, "scenes", "elastic_tube.toml"),
         os.path.join(source, "notebooks_data", "elastic_tube_published.csv"), made,
         os.path.join(folder, "elastic-tube.svg"), os.path.join(folder, "elastic_tube.csv")],
        check=True,
    )
    hold(made, committed, "tunica_elastic_tube")


if __name__ == "__main__":
    main()
