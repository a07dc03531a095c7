# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes docs/reproduction.md anew and holds it against the committed one: reproduction.py SOURCE BUILD FOLDER."""

import os
import subprocess
import sys

from page import hold


def main():
    source, build, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    made = os.path.join(folder, "reproduction.md")
    subprocess.run([os.path.join(source, "tools", "reproduce"), made, build,
                    os.path.join(folder, "results")], check=True)
    hold(made, os.path.join(source, "docs", "reproduction.md"), "tools/reproduce")


if __name__ == "__main__":
    main()
