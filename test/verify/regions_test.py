#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies the logs of runs by regions: 100 of them, or as many times more as the environment variable
KINETRI_TEST_MULTIPLIER says.

usage: regions_test.py LOGS VERIFY FOLDER
"""
import os
import pathlib
import shutil
import subprocess
import sys

BATCH = 100


def main():
    logs, verify, folder = sys.argv[1:]
    events = 0
    for batch in range(int(os.environ.get("KINETRI_TEST_MULTIPLIER", "1"))):
        shutil.rmtree(folder, ignore_errors=True)
        pathlib.Path(folder).mkdir(parents=True)
        written = subprocess.run([logs, folder, str(batch * BATCH), str(BATCH)], capture_output=True, text=True,
                                 check=True)
        commands = written.stdout.splitlines()
        assert len(commands) == BATCH, written.stdout
        for command in commands:
            result = subprocess.run([verify, *command.split()], cwd=folder, capture_output=True, text=True,
                                    check=False)
            assert result.returncode == 0, f"{command}\n{result.stdout}{result.stderr}"
            rows = pathlib.Path(folder, command.split()[1]).read_text(encoding="utf-8").count("\n") - 1
            assert rows > 0, command
            events += rows
        print(f"{(batch + 1) * BATCH} runs verified, {events} events", flush=True)


if __name__ == "__main__":
    main()
