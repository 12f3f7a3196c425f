#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every measurement of kinetri_bench runs, on few points: how long it takes does not matter here.

usage: bench_test.py KINETRI_BENCH
"""

import json
import re
import subprocess
import sys
import unittest

BENCH = sys.argv.pop(1)
# What is refused for so few points, and why.
REFUSED = {"batches": "expected more events", "lines": "expected at least as many --points"}


def run(*arguments):
    return subprocess.run([BENCH, *arguments], capture_output=True, text=True, timeout=300, check=False)


class Measurements(unittest.TestCase):
    def test_each_prints_an_object(self):
        listed = run("--help").stdout.partition("Subcommands:")[2]
        modes = re.findall(r"^  (\S+)  ", listed, re.MULTILINE)
        self.assertGreater(len(modes), 20)
        for mode in modes:
            with self.subTest(mode):
                done = run(mode, "--points", "100", "--until", "0.2")
                if mode in REFUSED:
                    self.assertEqual(done.returncode, 3)
                    self.assertIn(REFUSED[mode], done.stderr)
                else:
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual(json.loads(done.stdout)["mode"], mode)


if __name__ == "__main__":
    unittest.main()
