#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints what a run of the tests has covered: a table by layer of the functions called, the lines
run and the branches taken, and then, file by file, those that were not.

usage: summarize_coverage.py COVERAGE.json    (from gcovr --json)

A function is a place in a file: a template counts once, and as called if any instance was called;
so do its lines and branches. Exit code 1 if the file names no source of the project.
"""
import collections
import json
import pathlib
import sys

import check_layers

LAYERS = tuple(check_layers.LAYERS)
KINDS = ("functions", "lines", "branches")


def layer_of(path):
    """The layer of a path relative to the root; None if it belongs to none, or to the tests."""
    return None if path.startswith("test/") else check_layers.layer_of(pathlib.PurePath(path))


def short_name(name):
    """The demangled name of a function without its arguments and those of templates."""
    name = name.split("[abi:", 1)[0]
    result, depth = "", 0
    for character in name.replace("(anonymous namespace)::", "").replace("operator()", "operator\0"):
        if character == "(" and depth == 0:
            break
        depth += (character == "<") - (character == ">")
        if character not in "<>" and depth == 0:
            result += character
    return result.replace("operator\0", "operator()").split(" ")[-1].removeprefix("kinetri::")


def ranges(numbers):
    """`1-3, 7` of 1, 2, 3, 7."""
    found = []
    for number in sorted(numbers):
        if found and number == found[-1][1] + 1:
            found[-1][1] = number
        else:
            found.append([number, number])
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in found)


class File:
    """What gcovr says of one file: (covered, all) of each kind, and what is not covered."""

    def __init__(self, entry):
        lines = [line for line in entry["lines"] if not line.get("gcovr/noncode")]
        functions = collections.defaultdict(lambda: [0, ""])
        for function in entry.get("functions", ()):
            functions[function["lineno"]][0] += function["execution_count"]
            functions[function["lineno"]][1] = short_name(function["name"])
        self.functions_not_called = {n: name for n, (count, name) in functions.items() if not count}
        self.lines_not_run = {line["line_number"] for line in lines if not line["count"]}
        branches = {line["line_number"]: [b["count"] for b in line["branches"]] for line in lines}
        # Those of a line that was never run say nothing more.
        self.branches_not_taken = {n: counts.count(0) for n, counts in branches.items()
                                   if 0 in counts and n not in self.lines_not_run}
        self.covered = {
            "functions": (len(functions) - len(self.functions_not_called), len(functions)),
            "lines": (len(lines) - len(self.lines_not_run), len(lines)),
            "branches": (sum(c > 0 for counts in branches.values() for c in counts),
                         sum(map(len, branches.values()))),
        }

    def untested(self):
        """One line of text for each kind of which something is not covered."""
        for number, name in sorted(self.functions_not_called.items()):
            yield f"never called: {name} ({number})"
        if self.lines_not_run:
            yield f"never run: {ranges(self.lines_not_run)}"
        if self.branches_not_taken:
            yield f"a branch never taken: {ranges(self.branches_not_taken)}"


def share(covered, count):
    """`97.5 %`, never rounded up to all."""
    return f"{covered * 1000 // count / 10:.1f} %" if count else "-"


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as report:
        entries = json.load(report)["files"]
    files = {e["file"]: File(e) for e in entries if layer_of(e["file"])}
    if not files:
        print(f"{sys.argv[1]}: no source of the project")
        return 1
    for layer in LAYERS:
        for path in sorted(path for path in files if layer_of(path) == layer):
            untested = list(files[path].untested())
            if untested:
                print(path)
                for text in untested:
                    print(f"  {text}")
    print(f"\n{'layer':<14}" + "".join(f"{kind:>24}" for kind in KINDS))
    for layer in LAYERS + ("all",):
        row = {kind: [sum(file.covered[kind][i] for path, file in files.items()
                          if layer in ("all", layer_of(path))) for i in (0, 1)] for kind in KINDS}
        print(f"{layer:<14}" + "".join(
            f"{f'{a} of {b}':>15}{share(a, b):>9}" for a, b in (row[kind] for kind in KINDS)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
