# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds a page that a program makes against the committed one.

Words have to be the same; numbers may differ by one in their last printed digit, as compilers differ in rounding.
"""

import re
import sys

NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?!\w)")


def hold(made, committed, command):
    """Ends the program with a message that names `command` when the files `made` and `committed` differ."""
    with open(made, encoding="utf-8") as file:
        ours = file.read()
    with open(committed, encoding="utf-8") as file:
        theirs = file.read()
    if NUMBER.sub("#", ours) != NUMBER.sub("#", theirs):
        sys.exit(f"{committed} has other words than {command} writes; run it and commit")
    for new, old in zip(NUMBER.findall(ours), NUMBER.findall(theirs)):
        decimals = len(old.partition(".")[2])
        if abs(float(new) - float(old)) > 1.01 * 10.0 ** -decimals or (decimals == 0 and new != old):
            sys.exit(f"{committed} says {old}, {command} {new}; run it and commit")
