# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line and output of the checks of the project (check_*.py)."""
import pathlib
import sys


def run(check, name, unit, usage):
    """Runs `check` on the folder that the command line names, or on the project. `check` returns the number
    of checked files (called `unit`) and the violations, `FILE:LINE: what is wrong`, which are printed.
    Exits with 0 if there are none and at least one file was checked."""
    if len(sys.argv) > 2 or sys.argv[1:2] in (["-h"], ["--help"]):
        sys.exit(usage)
    root = pathlib.Path(sys.argv[1] if len(sys.argv) == 2 else pathlib.Path(__file__).parents[1])
    count, violations = check(root)
    for violation in violations:
        print(violation)
    if count == 0:
        print(f"{root}: no {unit} found")
    elif not violations:
        print(f"{name}: ok ({count} {unit})")
    sys.exit(0 if count and not violations else 1)
