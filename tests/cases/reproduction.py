# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes docs/reproduction.md anew and holds it against the committed one: reproduction.py SOURCE BUILD FOLDER.

Words have to be the same; numbers may differ by one in their last printed digit, as compilers differ in rounding.
"""

import os
import re
import subprocess
import sys

NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?!\w)")


def main():
    source, build, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    made = os.path.join(folder, "reproduction.md")
    subprocess.run([os.path.join(source, "tools", "reproduce"), made, build,
                    os.path.join(folder, "results")], check=True)
    with open(made, encoding="utf-8") as file:
        ours = file.read()
    with open(os.path.join(source, "docs", "reproduction.md"), encoding="utf-8") as file:
        committed = file.read()
    if NUMBER.sub("#", ours) != NUMBER.sub("#", committed):
        sys.exit("docs/reproduction.md has other words than tools/reproduce writes; run tools/reproduce and commit")
    for new, old in zip(NUMBER.findall(ours), NUMBER.findall(committed)):
        decimals = len(old.partition(".")[2])
        if abs(float(new) - float(old)) > 1.01 * 10.0 ** -decimals or (decimals == 0 and new != old):
            sys.exit(f"docs/reproduction.md says {old}, tools/reproduce {new}; run tools/reproduce and commit")


if __name__ == "__main__":
    main()
