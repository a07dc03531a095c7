# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the page of a study anew and holds it against the committed one:
study.py SOURCE TUNICA_STUDY TUNICA FOLDER STUDY PAGE. Its runs stay in FOLDER/results.
"""

import os
import shutil
import subprocess
import sys

from page import hold


def main():
    source, program, tunica, folder, study, page = sys.argv[1:]
    for place in ("docs/verification", "docs/images", "notebooks_data"):
        os.makedirs(os.path.join(folder, place), exist_ok=True)
    made, committed = os.path.join(folder, page), os.path.join(source, page)
    shutil.copyfile(committed, made)
    subprocess.run(
        [program, study, "--source", source, "--out", folder, "--program", tunica,
         "--kept", os.path.join(folder, "results")],
        check=True,
    )
    hold(made, committed, f"tools/study {study}")


if __name__ == "__main__":
    main()
