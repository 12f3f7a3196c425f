#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the corpus of degenerate input, the files *.csv here, and README.md, its list.

usage: generate.py           writes them
       generate.py --check   says which of them are out of date; exit code 1 if any is

A file of the corpus that is written by hand, such as what a fuzzer found, stays as it is; README.md
takes its first line for the list. All numbers are binary64 and exact: what has to be collinear,
cocircular or in one place at an instant is so without rounding. tests: test/degenerate.
"""
import pathlib
import sys

import places
import roots

HERE = pathlib.Path(__file__).resolve().parent

README = """\
<!-- SPDX-License-Identifier: GPL-3.0-or-later -->
<!-- Written by generate.py. -->
# Degenerate input

Points files with hard cases: many events at one exact time, touches that are not events, points that
meet, sets that are flat for an instant, numbers of very different magnitudes. The comment at the top of
each file says what it is and why it is hard. `test/degenerate/corpus_test.cpp` runs every file with full
audits between all instants, with and without filters, and, for at most 8 points, against the brute-force
simulator. It reads these comments:

    # until: T      run to time T, which may be the time of an event; without it, run until no event is left
    # events: N     the number of events, if the geometry determines it

`generate.py` writes all files, except files whose first line says "Found by". To add a file by hand, put
it into this folder and run `generate.py`, which updates this list.

| file | points | what it is |
|---|---|---|
"""


def text_of(case):
    comment = [case.title, *case.why]
    if case.until is not None:
        comment.append(f"until: {case.until!r}")
    if case.events is not None:
        comment.append(f"events: {case.events}")
    lines = [f"# {line}" for line in comment]
    lines.append("x,y,vx,vy")
    lines += [",".join(number(value) for value in point) for point in case.points]
    return "\n".join(lines) + "\n"


def number(value):
    """The shortest text that reads back as the number."""
    value = float(value)
    return str(int(value)) if value == int(value) and abs(value) < 2**53 else repr(value)


def row_of(name, text):
    lines = text.splitlines()
    points = sum(1 for line in lines if line.strip() and not line.startswith("#")) - 1
    return f"| {name} | {points} | {lines[0].removeprefix('#').strip()} |"


def outputs():
    """(path, text) of everything that is written."""
    files = {HERE / f"{case.name}.csv": text_of(case) for case in roots.cases() + places.cases()}
    texts = {path: path.read_text(encoding="utf-8") for path in HERE.glob("*.csv")} | files
    rows = [row_of(path.name, texts[path]) for path in sorted(texts)]
    files[HERE / "README.md"] = README + "\n".join(rows) + "\n"
    return files


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    stale = [
        (path, text)
        for path, text in sorted(outputs().items())
        if not path.exists() or path.read_text(encoding="utf-8") != text
    ]
    for path, text in stale:
        if sys.argv[1:]:
            print(f"{path.name} is out of date; run data/degenerate/generate.py")
        else:
            path.write_text(text, encoding="utf-8")
    return 1 if stale and sys.argv[1:] else 0


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    sys.exit(main())
