#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""True logs of runs in periodic boxes are verified.

usage: periodic_true_test.py KINETRI VERIFY FOLDER
"""
import collections
import copy
import sys

from periodic_runs import DISCS, FOLDER, KINDS, RESPONSES, TIMES, runs


def expect_true(run, kind, seed, ways):
    for options in ways:
        code, says = run.verify(**options)
        if code != 0:
            sys.exit(f"{kind} {seed} {options}: {code}: {says}")


def second_part(run):
    """The run from the middle on, where discs that pass through each other may overlap: the numbers of its rows
    begin with another one than 0."""
    part = copy.deepcopy(run)
    part.start = (run.start + run.until) / 2
    run.simulate(part.start, "--edges", "middle.csv")
    _, *part.initial = run.read("middle.csv")
    part.rows = [row for row in run.rows if float(row[2]) > part.start]
    return part


def check_true():
    counts = collections.Counter()
    for kind in KINDS:
        for seed, run in runs(kind, 8 * TIMES, FOLDER / kind):
            expect_true(run, kind, seed, ({}, {"edges": ["initial"]}, {"edges": ["final"]}, {"points": "motions.csv"},
                                          *([] if run.has_sizes() else [{"more": ["--motions", "motions.csv"]}])))
            counts[kind] += len(run.rows)
            for name in ("rebuild", "hide", "reveal"):
                counts[name] += sum(row[1] == name for row in run.rows)
            counts["rows in boxes with rates"] += len(run.rows) if run.rates else 0
            counts["roots"] += sum(row[3] != row[4] for row in run.rows)
            counts["together"] += sum(row[0] != row[-3] for row in run.rows)
    for kind in DISCS:
        for seed, run in runs(kind, 24 * TIMES, FOLDER / kind):
            # A file of motions that stands for the points has no response: that there are contacts is inferred.
            expect_true(run, kind, seed, ({"more": ["--threads", "2"]}, {"edges": ["final"], "points": "motions.csv"}))
            if run.response == "log":
                expect_true(second_part(run), kind, seed, ({},))
            contacts = [row for row in run.rows if row[1] == "collision"]
            counts[kind] += len(contacts)
            counts["contacts in boxes with rates"] += len(contacts) if run.rates else 0
            counts[run.response] += len(contacts)
            counts["contacts together"] += sum(row[0] != row[-3] for row in contacts)
            counts["contacts of far images"] += sum(row[-1] != "0 0" for row in contacts)
    print(dict(counts))
    least = {"grid": 500, "few": 300, "crystal": 50, "one": 7, "random": 750, "rebuild": 400, "roots": 1200,
             "together": 400, "moving": 450, "weights": 500, "hide": 30, "reveal": 30, "rows in boxes with rates": 600,
             "sizes": 60, "contacts in boxes with rates": 20,
             "lattice": 100, "gas": 80, "contacts together": 30, "contacts of far images": 100,
             **dict.fromkeys(RESPONSES, 10)}
    short = {name: counts[name] for name, number in least.items() if counts[name] < number}
    if short:
        sys.exit(f"too few rows: {short}")


if __name__ == "__main__":
    check_true()
