#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies the logs of runs whose points often get the motion of another one: 400 of them, or as many times
more as the environment variable KINETRI_TEST_MULTIPLIER says. `lies` tells lies about the first ones: each kind about
16 runs, in which there is what it is about, or as many times more.

usage: coincident_test.py true|lies LOGS VERIFY FOLDER
"""
import collections
import os
import pathlib
import random
import shutil
import subprocess
import sys

import lies
import verify_test

BATCH = 400
LIES = 16


def written(logs, folder, first, number):
    """The lines that the program prints."""
    shutil.rmtree(folder, ignore_errors=True)
    pathlib.Path(folder).mkdir(parents=True)
    return subprocess.run([logs, folder, str(first), str(number)], capture_output=True, text=True,
                          check=True).stdout.splitlines()


def check_true(logs, verify, folder):
    counts = collections.Counter()
    batches = int(os.environ.get("KINETRI_TEST_MULTIPLIER", "1"))
    for batch in range(batches):
        first = batch * BATCH
        lines = written(logs, folder, first, BATCH)
        assert len(lines) > 0.9 * BATCH, len(lines)
        for number, line in enumerate(lines):
            seed, *options = line.split()
            edges = ("--initial-edges", f"{seed}.initial.csv", "--edges", f"{seed}.edges.csv")
            if number % 3 < 2:
                edges = edges[2 * (number % 3):][:2]
            command = [verify, f"{seed}.motions.csv", f"{seed}.events.csv", *options, *edges]
            result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
            if result.returncode == 2 and "on one line" in result.stderr:
                counts["not supported"] += 1
                continue
            assert result.returncode == 0, f"{command}\n{result.stdout}{result.stderr}"
            for row in pathlib.Path(folder, f"{seed}.events.csv").read_text("utf-8").splitlines()[1:]:
                fields = row.split(",")
                counts[fields[1] + " by a point" * (fields[1] in ("hide", "reveal") and fields[10] != "")] += 1
        print(f"{first + BATCH} runs: {dict(counts)}", flush=True)
    for kind in ("hide", "reveal", "hide by a point", "reveal by a point", "wall", "collision"):
        assert counts[kind] > BATCH / 20, counts
    assert counts["not supported"] < batches * BATCH / 20, counts


def check_lies(logs, verify, folder):
    multiplier = int(os.environ.get("KINETRI_TEST_MULTIPLIER", "1"))
    lines = written(logs, folder, 0, BATCH // 2 * multiplier)
    case = verify_test.Case("", verify, pathlib.Path(folder) / "lies")
    counts = verify_test.new_counts()
    for line in lines:
        seed, _, until, *options = line.split()
        files = [
            [row.split(",") for row in pathlib.Path(folder, f"{seed}.{name}.csv").read_text("utf-8").splitlines()[1:]]
            for name in ("events", "motions", "initial", "edges")
        ]
        run = verify_test.Run([None], *files, 0.0, float(until))
        if case.verify(run, options, case.motions)[0] == 0:  # else it is not supported
            table = {name: lie for name, lie in lies.TWINS.items() if counts[name]["told"] < LIES * multiplier}
            verify_test.tell(case, table, counts, run, random.Random(seed), options, case.motions)
    verify_test.report(counts)
    assert len(counts) == len(lies.TWINS) and all(c["told"] >= 5 for c in counts.values()), counts


def main():
    what, *arguments = sys.argv[1:]
    check_lies(*arguments) if what == "lies" else check_true(*arguments)


if __name__ == "__main__":
    main()
