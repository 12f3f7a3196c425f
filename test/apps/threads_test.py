#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`--threads N`: the outputs are the same for any N, byte for byte, and no thread but the first one takes
signals.

usage: threads_test.py PROGRAM
"""
import json
import pathlib
import signal
import subprocess
import sys
import time
import unittest

sys.dont_write_bytecode = True
from in_folder import In_folder  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())

# With fewer than 50 000 points there are no regions.
MANY = 51000

OUTPUTS = ("events", "initial-edges", "edges", "motions")

# What --stats promises: what happened. The rest tells how, and how long it took.
PROMISED = ("points", "from", "until", "reached", "interrupted", "events", "events_total", "instants",
            "largest_instant", "batches", "flat_hulls", "points_set_aside", "reconstructions", "audits")

TRACKS = "t,id,x,y\n0,a,0,0\n0,b,9,0\n0,c,4,7\n0,d,5,3\n5,a,1,1\n5,b,9,1\n5,c,4,-2\n5,d,-3,3\n"


class Threads(In_folder):
    maxDiff = 2000

    def run_program(self, arguments, code=0):
        done = subprocess.run([PROGRAM, *arguments.split()], cwd=self.folder, timeout=600, check=False,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def results(self, command, threads, more, label):
        """({output: content}, statistics) of a run."""
        name = f"{label}with{threads}"
        (self.folder / name).mkdir()
        outputs = " ".join(f"--{output} {name}/{output}" for output in (*OUTPUTS, "stats"))
        self.run_program(f"{command} {outputs} {more.format(name)} --threads {threads} --quiet")
        written = {path.name: path.read_bytes() for path in (self.folder / name).iterdir()}
        stats = json.loads(written.pop("stats"))
        if "checkpoint" in written:  # but for where its logs are
            written["checkpoint"] = b"".join(line for line in written["checkpoint"].splitlines(True)
                                             if b'"path"' not in line and b"checksum" not in line)
        return written, stats

    def expect_same(self, command, more="", label=""):
        """Returns the statistics of one thread and of two."""
        one, stats_of_one = self.results(command, 1, more, label)
        two, stats_of_two = self.results(command, 2, more, label)
        self.assertEqual(one.keys(), two.keys())
        for output, content in one.items():
            self.assertTrue(content == two[output], f"--{output} differs")
        for name in PROMISED:
            self.assertEqual(stats_of_one[name], stats_of_two[name], name)
        return stats_of_one, stats_of_two

    def expect_regions(self, stats):
        """By regions other certificates are checked again."""
        one, two = stats
        self.assertNotEqual(one["rechecks"], two["rechecks"])

    def expect_one_thread(self, stats):
        one, two = stats
        self.assertEqual(one["rechecks"], two["rechecks"])

    def test_runs_of_few_points_are_the_same(self):
        self.run_program("generate uniform --points 60 --side 60 --seed 3 --output p.csv")
        self.expect_same("simulate p.csv --until 3 --box -9,-9,69,69 --radius 1 --collisions elastic",
                         "--checkpoint {0}/checkpoint")

    def test_tracks_are_the_same(self):
        self.write("t.csv", TRACKS)
        self.expect_same("tracks t.csv", "--components {0}/components --encounters {0}/encounters --range 4")

    def test_very_many_points_are_the_same(self):
        self.run_program(f"generate uniform --points {MANY} --side 2300 --speed 5 --seed 4 --output p.csv")
        more = "--checkpoint {0}/checkpoint --encounters {0}/encounters --range 0.02"
        self.expect_regions(self.expect_same("simulate p.csv --until 1", more))

    def test_recordings_of_very_many_points_are_the_same(self):
        self.run_program(f"generate uniform --points {MANY} --seed 5 --output p.csv")
        self.expect_regions(self.expect_same("simulate p.csv --until 1.5", "--html {0}/run.html"))

    def test_walls_are_the_same(self):
        self.run_program(f"generate uniform --points {MANY} --side 2450 --seed 6 --output p.csv")
        more = "--html {0}/run.html --checkpoint {0}/checkpoint --encounters {0}/encounters --range 0.05 " \
               "--components {0}/components"
        self.expect_regions(self.expect_same("simulate p.csv --until 1.5 --box 0,0,2450,2450", more))

    def test_collisions_are_the_same(self):
        self.run_program(f"generate lattice-jitter --points {MANY} --speed 5 --seed 3 --output p.csv")
        for response in ("elastic", "swap", "log"):
            discs = f"--box=-10,-10,2450,2450 --radius 3 --collisions {response}"
            expect = self.expect_one_thread if response == "log" else self.expect_regions
            with self.subTest(response):
                expect(self.expect_same(f"simulate p.csv --until 0.75 {discs}",
                                        "--html {0}/run.html --checkpoint {0}/checkpoint", response))

    def test_discs_that_vanish_are_the_same(self):
        self.run_program(f"generate lattice-jitter --points {MANY} --speed 5 --seed 5 --output p.csv")
        discs = "--box=-10,-10,2450,2450 --radius 4 --collisions remove"
        more = "--checkpoint {0}/checkpoint --neighbors {0}/neighbors --encounters {0}/encounters --range 0.05"
        stats = self.expect_same(f"simulate p.csv --until 0.25 {discs}", more)
        self.expect_one_thread(stats)
        self.assertGreater(stats[0]["events"]["collision"], 1000)

    def test_discs_of_any_size_are_the_same(self):
        self.run_program(f"generate lattice-jitter --points {MANY} --speed 5 --seed 4 --output p.csv")
        comments_and_header, rows = self.rows_of("p.csv")
        self.write("d.csv", "".join(
            [comments_and_header.rstrip("\n") + ",radius\n",
             *(f"{row},{1 + 0.25 * (k * 7 % 9)}\n" for k, row in enumerate(rows))]))
        box = "--box=-10,-10,2450,2450"
        more = "--html {0}/run.html --checkpoint {0}/checkpoint"
        for label, options in (("none", box), ("elastic", box + " --collisions elastic")):
            with self.subTest(label):
                self.expect_regions(self.expect_same(f"simulate d.csv --until 0.75 {options}", more, label))

    def rows_of(self, name):
        """The comments and the header of a file of points, and its rows."""
        lines = (self.folder / name).read_text(encoding="utf-8").splitlines()
        first = next(k for k, line in enumerate(lines) if not line.startswith("#")) + 1
        return "\n".join(lines[:first]), lines[first:]

    def test_very_many_points_resumed_are_the_same(self):
        self.run_program(f"generate uniform --points {MANY} --side 2300 --speed 5 --seed 5 --output p.csv")
        self.run_program("simulate p.csv --until 0.1 --checkpoint c --quiet")
        self.expect_regions(self.expect_same("resume c --until 1.1", "--checkpoint {0}/checkpoint"))

    def test_a_number_that_is_none_is_refused(self):
        self.run_program("generate uniform --points 9 --output p.csv")
        for number in ("x", "-1", "1.5", "1025"):
            done = subprocess.run([PROGRAM, "simulate", "p.csv", "--until", "1", f"--threads={number}"],
                                  cwd=self.folder, capture_output=True, text=True, check=False, timeout=60)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"--threads: '{number}' cannot be used; expected a whole number from 0 to 1024\n",
                          done.stderr)

    @unittest.skipUnless(pathlib.Path("/proc/self/task").exists(), "no /proc")
    def test_only_the_first_thread_takes_signals(self):
        self.run_program("generate uniform --points 4000 --seed 1 --output p.csv")
        bits = sum(1 << (number - 1) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGALRM))
        for threads in (1, 2, 5):
            command = [PROGRAM, "simulate", "p.csv", "--until", "1000000", "--progress", "always",
                       "--threads", str(threads)]
            with subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE) as process:
                shown = b""
                while b"running" not in shown and b"events/s" not in shown:
                    shown += process.stderr.read(1)
                blocked = {}
                for task in pathlib.Path(f"/proc/{process.pid}/task").iterdir():
                    status = dict(line.split(":", 1) for line in
                                  (task / "status").read_text(encoding="utf-8").splitlines() if ":" in line)
                    blocked[int(task.name)] = int(status["SigBlk"], 16) & bits
                process.send_signal(signal.SIGINT)
                begin = time.monotonic()
                process.communicate(timeout=60)
                self.assertEqual(process.returncode, 130)
                self.assertLess(time.monotonic() - begin, 30)
            self.assertEqual(len(blocked), threads)
            self.assertEqual(blocked.pop(process.pid), 0)
            self.assertEqual(set(blocked.values()), {bits} if threads > 1 else set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
