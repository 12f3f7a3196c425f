#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Discs that grow in a box until they cover a share of it: `kinetri simulate --until-share`. That no two
of them overlap at the end, that they are in the box and that they cover the share is checked here over all
discs and all pairs, in integers, from the motions in the checkpoint. And discs that are jammed, with every
response, and contacts without end.

usage: packing_test.py PROGRAM [POINTS]
"""
import fractions
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
POINTS = int(sys.argv[2]) if len(sys.argv) > 2 else 100
SIDE = 100
# What few discs reach depends on the walls.
SHARES = (0.82, 0.8) if POINTS >= 1000 else (0.78, 0.74)
GROWTH = 3.2 / POINTS**0.5

Fraction = fractions.Fraction
PI = (Fraction("3.14159265358979323846"), Fraction("3.14159265358979323847"))


def discs_of(checkpoint):
    """[(x, y, radius)] at the time of the checkpoint, as integers, and their unit."""
    text = checkpoint.read_text(encoding="utf-8")
    state = json.loads(text[text.index("\n") + 1 : text.rindex("checksum")])
    time = Fraction(state["time"])
    discs = []
    for x, y, vx, vy, epoch, radius, growth, weight in state["points"]:
        assert weight == 0
        past = time - Fraction(epoch)
        discs.append((Fraction(x) + Fraction(vx) * past, Fraction(y) + Fraction(vy) * past,
                      Fraction(radius) + Fraction(growth) * past))
    unit = math.lcm(*(number.denominator for disc in discs for number in disc))
    return [tuple(int(number * unit) for number in disc) for disc in discs], unit


class Packing(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, arguments):
        result = subprocess.run([PROGRAM, *arguments.split()], cwd=self.folder, timeout=600, check=False,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stderr

    def grow(self, generate, share, more):
        """The discs of a run until they cover the share, as discs_of."""
        self.run_program(f"generate {generate} --points {POINTS} --side {SIDE} --speed 1 --output p.csv")
        summary = self.run_program(
            f"simulate p.csv --until-share {share} --box 0,0,{SIDE},{SIDE} --rim --collisions elastic "
            f"{more} --checkpoint c --audit end")
        self.assertIn(f"cover {share} of the box\n", summary)
        discs, unit = discs_of(self.folder / "c")
        self.assertEqual(len(discs), POINTS)
        self.expect_apart(discs, SIDE * unit)
        squares = sum(radius * radius for _, _, radius in discs)
        area = Fraction(share) * (SIDE * unit) ** 2
        self.assertGreaterEqual(PI[0] * squares, area)
        self.assertLess(PI[1] * squares, area * (1 + Fraction(1, 10**9)))
        return discs

    def expect_apart(self, discs, side):
        for a, (x, y, radius) in enumerate(discs):
            self.assertTrue(radius <= x <= side - radius and radius <= y <= side - radius, a)
            for b, (other_x, other_y, other_radius) in enumerate(discs[:a]):
                distance = (x - other_x) ** 2 + (y - other_y) ** 2
                self.assertGreaterEqual(distance, (radius + other_radius) ** 2, (a, b))

    # Contacts round radii down, and more so the faster the discs are.

    def test_equal_discs_cover_a_share(self):
        discs = self.grow("uniform", SHARES[0], f"--growth {GROWTH}")
        radii = [radius for _, _, radius in discs]
        self.assertLess(max(radii) - min(radii), min(radii) * 1e-7)

    def test_discs_of_two_sizes_cover_a_share(self):
        discs = self.grow(f"packing --share 0.1 --sizes 1.4 --growth {GROWTH}", SHARES[1], "--mass area")
        for (_, _, small), (_, _, large) in zip(discs[::2], discs[1::2]):
            self.assertAlmostEqual(large / small, 1.4, delta=1e-7)

    def test_a_run_in_two_parts_is_one_run(self):
        growth = f"--box 0,0,{SIDE},{SIDE} --rim --collisions elastic --growth 0.5 --quiet"
        self.run_program("generate uniform --points 40 --side 100 --speed 5 --output p.csv")
        self.run_program(f"simulate p.csv --until-share 0.6 {growth} --events one.csv --checkpoint one")
        self.run_program(f"simulate p.csv --until-share 0.3 {growth} --events two.csv --checkpoint two")
        self.run_program("resume two --until-share 0.6 --events more.csv --checkpoint three --quiet")
        one, two, more = ((self.folder / name).read_text(encoding="utf-8").splitlines()
                          for name in ("one.csv", "two.csv", "more.csv"))
        self.assertGreater(len(two), 50)
        self.assertGreater(len(more), 50)
        self.assertTrue(one == two + more[1:], "the logs of the parts are not the log of the whole")
        self.assertEqual(discs_of(self.folder / "one"), discs_of(self.folder / "three"))


RESPONSES = ("none", "log", "swap", "elastic", "stop", "remove")


class Jam(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_to(self, until, response, more="", side=8):
        command = (f"simulate p.csv --until {until} --box 0,0,{side},{side} --rim --collisions {response} "
                   f"{more} --quiet --events e.csv --edges d.csv --checkpoint c --stats s.json")
        return subprocess.run([PROGRAM, *command.split()], cwd=self.folder, timeout=600, check=False,
                              capture_output=True, text=True)

    def time_of_jam(self, until, response, more=""):
        """The time at which a run ends that is jammed, and the ids that its message names. Its outputs are
        whole: the run goes on from its checkpoint to the same jam."""
        for name in ("e.csv", "d.csv", "c", "s.json"):
            (self.folder / name).unlink(missing_ok=True)
        result = self.run_to(until, response, more)
        self.assertEqual(result.returncode, 130, (response, result.stderr))
        match = re.fullmatch(r"kinetri: the discs are jammed \((.+)\), and the run ends at t = (\S+) instead "
                             rf"of {until}; results up to then are written; expected an earlier end or a "
                             r"smaller share, slower growth, faster or fewer discs, or a larger box\n",
                             result.stderr)
        self.assertTrue(match, result.stderr)
        statistics = json.loads((self.folder / "s.json").read_text(encoding="utf-8"))
        rows = (self.folder / "e.csv").read_text(encoding="utf-8").splitlines()[1:]
        self.assertEqual(len(rows), statistics["events_total"])
        self.assertTrue((self.folder / "d.csv").stat().st_size > 0)
        resumed = subprocess.run([PROGRAM, "resume", "c", "--until", str(until), "--quiet"], cwd=self.folder,
                                 timeout=600, check=False, capture_output=True, text=True)
        self.assertEqual(resumed.returncode, 130, resumed.stderr)
        return float(match[2]), match[1]

    def expect_end(self, until, response, more="", side=8):
        result = self.run_to(until, response, more, side)
        self.assertEqual((result.returncode, result.stderr), (0, ""), response)

    def write(self, rows):
        (self.folder / "p.csv").write_text("x,y,vx,vy,radius,growth\n" + rows, encoding="utf-8")

    def test_a_disc_that_would_fill_the_box_is_refused_or_jammed(self):
        jams = {"stop": 3.25, "remove": 20}  # how long a disc grows is not known before the run
        for response in RESPONSES:
            self.write("4,3,1,0.5,1,1\n")  # no room is left at 3
            if response in jams:
                time, ids = self.time_of_jam(jams[response], response)
                self.assertTrue(2 < time < 3.01, time)
                self.assertEqual(ids, "0")
            for until in () if response in jams else (3.25, 20):
                result = self.run_to(until, response)
                self.assertEqual(result.returncode, 2, response)
                self.assertIn("p.csv:2: a disc of the radius", result.stderr)
                self.assertIn("does not fit the box", result.stderr)
            # An earlier end, slower growth, a larger box.
            self.expect_end(2.99, response)
            self.expect_end(3.5, response, side=16)
            self.write("4,3,1,0.5,1,0.125\n")
            self.expect_end(20, response)

    def test_a_disc_whose_center_meets_the_walls_is_not_jammed(self):
        # It meets them 37 600 times, and grows far beyond the box.
        self.write("4,3,1000,505,1,1\n")
        result = subprocess.run([PROGRAM, *"simulate p.csv --until 200 --box 0,0,8,8 --collisions log --quiet".split()],
                                cwd=self.folder, timeout=600, check=False, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_two_discs_between_two_walls_are_jammed(self):
        # They touch each other and the walls from 2 on, at which 4 radii are the width of the box.
        self.write("2,4,1,0,1,0.5\n6,4,-1,0,1,0.5\n")
        for response in ("swap", "elastic"):
            time, ids = self.time_of_jam(5, response)
            self.assertTrue(1.9 < time < 2.01, time)
            self.assertEqual(ids, "0, 1")
            self.expect_end(1.9, response)
        for response in ("none", "log", "stop", "remove"):  # they overlap, stop or vanish
            self.expect_end(5, response)

    def test_growing_points_are_jammed_and_runs_before_that_end(self):
        command = "generate uniform --points 20 --side 8 --speed 1 --output p.csv --seed 1"
        generated = subprocess.run([PROGRAM, *command.split()], cwd=self.folder, check=False, capture_output=True,
                                   text=True)
        self.assertEqual(generated.returncode, 0, generated.stderr)
        for response in ("swap", "elastic"):
            time, _ = self.time_of_jam(12, response, "--growth 0.25")
            for share in (0.9, 0.99):
                self.expect_end(share * time, response, "--growth 0.25")
        for response in ("none", "log", "remove"):  # the discs fill the box at 16
            self.expect_end(12, response, "--growth 0.25")


class Contacts_without_end(unittest.TestCase):
    """Points that are pressed against a wall or one another: the run ends with whole outputs, as one that is jammed."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_it(self, command):
        return subprocess.run([PROGRAM, *command.split()], cwd=self.folder, timeout=600, check=False,
                              capture_output=True, text=True)

    def check(self, rows, options, time, place, expected_events):
        (self.folder / "p.csv").write_text("x,y,vx,vy,ax,ay,jx,jy\n" + rows, encoding="utf-8")
        outputs = "--events e.csv --motions m.csv --edges d.csv --checkpoint c --stats s.json --html h.html --vtu v"
        for more in ("--threads 1", "--audit events", "--fps 4"):
            shutil.rmtree(self.folder / "v", ignore_errors=True)
            result = self.run_it(f"simulate p.csv --until 9 {options} --quiet {outputs} {more}")
            self.assertEqual(result.returncode, 130, result.stderr)
            self.assertTrue(result.stderr.startswith(
                f"p.csv:{place}: the run ends at t = {time} instead of 9; results up to then are written; "), result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            statistics = json.loads((self.folder / "s.json").read_text(encoding="utf-8"))
            logged = (self.folder / "e.csv").read_text(encoding="utf-8").splitlines()[1:]
            self.assertEqual(len(logged), statistics["events_total"])
            self.assertEqual([row.split(",")[1] for row in logged if row.split(",")[2] == str(time)], expected_events)
            for name in ("m.csv", "d.csv", "h.html"):
                self.assertGreater((self.folder / name).stat().st_size, 0, name)
            self.assertEqual(any((self.folder / "v").glob("*.vtu")), time > 0)
            before = result.stderr.split("; ", 2)[2]
            # The run goes on from its checkpoint to the same error, at once.
            result = self.run_it("resume c --until 9 --quiet --events more.csv --audit end")
            self.assertEqual(result.returncode, 130, result.stderr)
            self.assertEqual(result.stderr.split("; ", 2)[2], before)
            self.assertEqual((self.folder / "more.csv").read_text(encoding="utf-8").count("\n"), 1)

    def test_at_a_wall(self):
        # 1 rests at the lower wall at t = 1, and its jerk presses it on; 0 and 2 turn at others then.
        rows = "1,5,-1,0,0,0,0,0\n4,1,0,-3,0,6,0,-6\n8,5,1,0,0,0,0,0\n"
        for response in RESPONSES:
            discs = "" if response == "none" else f"--collisions {response} --radius 0.25"
            self.check(rows, f"--box 0,0,9,9 {discs}", 1, 3, ["wall"])

    def test_at_each_other(self):
        rows = "0,0,0,0,1,0,0,0\n4,0,0,0,-1,0,0,0\n1,9,0,0,0,0,0,0\n"
        for response in ("swap", "elastic"):
            self.check(rows, f"--collisions {response} --radius 2", 0, 2, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
