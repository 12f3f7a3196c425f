#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies the logs of runs whose points often get the motion of another one: 400 of them, or as many times
more as the environment variable KINETRI_TEST_MULTIPLIER says.

usage: coincident_test.py LOGS VERIFY FOLDER
"""
import collections
import os
import pathlib
import shutil
import subprocess
import sys

BATCH = 400


def main():
    logs, verify, folder = sys.argv[1:]
    counts = collections.Counter()
    batches = int(os.environ.get("KINETRI_TEST_MULTIPLIER", "1"))
    for batch in range(batches):
        shutil.rmtree(folder, ignore_errors=True)
        pathlib.Path(folder).mkdir(parents=True)
        first = batch * BATCH
        written = subprocess.run([logs, folder, str(first), str(BATCH)], capture_output=True, text=True, check=True)
        lines = written.stdout.splitlines()
        assert len(lines) > 0.9 * BATCH, written.stdout
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


if __name__ == "__main__":
    main()
