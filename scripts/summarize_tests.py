#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints what a ctest run came to: the tests that failed and the end of what they printed, then
`N passed, N failed`, and `, N skipped` where some were.

usage: summarize_tests.py RESULTS.xml    (from ctest --output-junit)
Exit code 1 if any test failed or none ran.
"""
import sys
import xml.etree.ElementTree as ElementTree

# A test that ctest could not start is "notrun" too; only these reasons mean that it was meant to be.
SKIPPED_ON_PURPOSE = ("SKIP_RETURN_CODE", "SKIP_REGULAR_EXPRESSION_MATCHED")

# How much of a failed test's output is shown.
OUTPUT_LINES = 60


def outcome(test):
    """`passed`, `failed` or `skipped`."""
    status = test.get("status")
    if status == "run":
        return "passed"
    if status == "disabled":
        return "skipped"
    skipped = test.find("skipped")
    if status == "notrun" and skipped is not None:
        if skipped.get("message", "").startswith(SKIPPED_ON_PURPOSE):
            return "skipped"
    return "failed"


def report(test):
    """The test's name and the end of its output."""
    print(f"FAILED {test.get('name')} (after {float(test.get('time', 0)):.1f} s)")
    output = (test.findtext("system-out") or "").rstrip().splitlines()
    for line in output[-OUTPUT_LINES:]:
        print("    " + line)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    tests = ElementTree.parse(sys.argv[1]).getroot().findall("testcase")
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for test in tests:
        count[outcome(test)] += 1
        if outcome(test) == "failed":
            report(test)
    line = f"{count['passed']} passed, {count['failed']} failed"
    if count["skipped"]:
        line += f", {count['skipped']} skipped"
    print(line)
    return 1 if count["failed"] or not count["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())
