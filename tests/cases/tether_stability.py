# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the tables of docs/verification/tether-stability.md anew and holds them against the committed ones:
tether_stability.py SOURCE PROGRAM FOLDER.
"""

import os
import shutil
import subprocess
import sys

from page import hold


def main():
    source, program, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    committed = os.path.join(source, "docs", "verification", "tether-stability.md")
    made = os.path.join(folder, "tether-stability.md")
    shutil.copyfile(committed, made)
    subprocess.run([program, made, folder], check=True)
    hold(made, committed, "tunica_tether_stability")


if __name__ == "__main__":
    main()
