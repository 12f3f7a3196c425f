#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Discs that grow in a box until they cover a share of it: `kinetri simulate --until-share`. That no two
of them overlap at the end, that they are in the box and that they cover the share is checked here over all
discs and all pairs, in integers, from the motions in the checkpoint.

usage: packing_test.py PROGRAM [POINTS]
"""
import fractions
import json
import math
import pathlib
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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
