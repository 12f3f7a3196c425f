#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Regular triangulations in periodic boxes (`kinetri simulate --periodic --regular`): edges and hidden points are those
of copies of the discs in the plane, which kinetri-verify verifies; logs, pictures, runs in parts, and what is refused.

usage: periodic_regular_test.py PROGRAM
"""
import csv
import io
import itertools
import json
import random
import re
import sys
import unittest

sys.dont_write_bytecode = True
from periodic_case import Program_in_box, edge_of, edges_in  # noqa: E402


def text_of(discs, columns="radius"):
    return f"x,y,vx,vy,{columns}\n" + "".join(",".join(map(repr, disc)) + "\n" for disc in discs)


def random_discs(generator, number, side, radii, growths=(0,)):
    """Multiples of 1/8, in the box."""
    def coordinate(least, most):
        return generator.randint(8 * least, 8 * most - 1) / 8

    return [(coordinate(0, side), coordinate(0, side), coordinate(-2, 2), coordinate(-2, 2), generator.choice(radii),
             generator.choice(growths)) for _ in range(number)]


def visible(edges):
    return {end for a, b, _ in edges for end in (a, b)}


class Periodic_regular(Program_in_box):
    def test_edges_are_those_of_copies_in_the_plane(self):
        """Of many copies, far from their border; the triangulation of these is verified by kinetri-verify."""
        reach = 3
        compared = hidden = 0
        for seed in range(4):
            generator = random.Random(seed)
            discs = random_discs(generator, 6, 8, (0, 0.5, 1, 3), (0, 0.25))
            shear = generator.choice([0, 0.25, -0.5])
            offsets = list(itertools.product(range(-reach, reach + 1), repeat=2))
            copies = [(x + 8 * k, y + 8 * l, vx + shear * 8 * l, vy, radius, growth)
                      for x, y, vx, vy, radius, growth in discs for k, l in offsets]
            self.write("copies.csv", text_of(copies, "radius,growth"))
            for until in (0.5, 1.5):
                self.run_program(f"simulate p.csv --until {until} --periodic 8,8 --shear={shear} --regular --edges f.csv "
                                 "--audit end", text_of(discs, "radius,growth"))
                done = self.run_program(f"simulate copies.csv --until {until} --regular --edges plane.csv --verify")
                self.assertIn("verified: ", done.stdout)
                images = [(i, offset) for i in range(len(discs)) for offset in offsets]
                expected = set()
                for row in csv.DictReader(io.StringIO(self.read("plane.csv"))):
                    (a, o), (b, p) = images[int(row["a"])], images[int(row["b"])]
                    if (0, 0) not in (o, p):
                        continue
                    offset = p[0] - o[0], p[1] - o[1]
                    expected.add((a, b, max(offset, (-offset[0], -offset[1])) if a == b else offset))
                self.assertEqual(edges_in(self.read("f.csv")), sorted(expected), (seed, until))
                self.assertEqual(len(expected), 3 * len(visible(expected)))
                compared += len(expected)
                hidden += len(discs) - len(visible(expected))
        self.assertGreater(compared, 80)
        self.assertGreater(hidden, 3)

    def test_log_leads_from_the_first_edges_and_hidden_points_to_the_last(self):
        kinds = []
        for seed in range(6):
            generator = random.Random(seed)
            number = 2 + 5 * seed
            discs = random_discs(generator, number, 5, (0, 0.25, 1, 2), (0, 0.125))
            self.run_program(
                f"simulate p.csv --until 3 --periodic 4,5,1 --shear={generator.choice([0, 0.25, -1])} --regular --quiet "
                "--events e.csv --initial-edges i.csv --edges f.csv --audit events", text_of(discs, "radius,growth"))
            first, last = edges_in(self.read("i.csv")), edges_in(self.read("f.csv"))
            hidden = set(range(number)) - visible(first)
            edges = set(first)
            self.assertEqual(len(edges), 3 * (number - len(hidden)))
            for row in self.rows():
                kinds.append(row["kind"])
                removed, added = edge_of(row, "removed"), edge_of(row, "added")
                if removed:
                    edges.remove(removed)
                if added:
                    self.assertNotIn(added, edges)
                    edges.add(added)
                if row["kind"] == "hide":
                    self.assertNotIn(int(row["point_a"]), hidden)
                    hidden.add(int(row["point_a"]))
                elif row["kind"] == "reveal":
                    hidden.remove(int(row["point_a"]))
            self.assertEqual(sorted(edges), last)
            self.assertEqual(hidden, set(range(number)) - visible(last))
        self.assertGreater(kinds.count("flip"), 100)
        self.assertGreater(min(kinds.count("hide"), kinds.count("reveal")), 5)

    def test_discs_of_one_radius_have_the_delaunay_triangulation(self):
        discs = random_discs(random.Random(5), 15, 8, (0.5,))
        points = text_of([disc[:4] + (1,) for disc in discs], "ignored")
        box = "--until 2 --periodic 8,8,1 --shear 0.25 --edges f.csv --events"
        self.run_program(f"simulate p.csv {box} d.csv", points)
        delaunay = self.read("d.csv")
        self.assertGreater(delaunay.count("flip"), 30)
        done = self.run_program(f"simulate p.csv {box} r.csv --regular --radius 0.5 --verify")
        self.assertEqual(self.read("r.csv"), delaunay)
        self.assertRegex(done.stdout, r"^verified: 15 points, \d+ events")
        # Contacts are the same with both triangulations; those of a lattice do not overlap at the start.
        self.write("p.csv", self.discs("", lambda _: ""))
        collide = "--until 2 --periodic 10,10,3 --radius 0.5 --collisions elastic --quiet --events"
        self.run_program(f"simulate p.csv {collide} d.csv")
        self.run_program(f"simulate p.csv {collide} r.csv --regular")
        self.assertGreater(self.read("d.csv").count("collision"), 5)
        self.assertEqual(self.read("r.csv"), self.read("d.csv"))

    def test_discs_without_a_radius_are_refused(self):
        refused = self.run_program("simulate p.csv --until 1 --periodic 8,8 --regular", "x,y,vx,vy\n1,1,0,0\n", code=2)
        self.assertIn("--regular: discs have a radius; expected a column radius in p.csv, or --radius R", refused.stderr)
        refused = self.run_program("simulate p.csv --until 1 --periodic 8,8 --regular --growth=-2", text_of([(1, 1, 0, 0, 1)]), code=2)
        self.assertIn("p.csv:2: the radius shrinks to 0 at t = 0.5", refused.stderr)

    def test_a_run_in_parts_is_the_run_in_one(self):
        run = "simulate p.csv --periodic 8,8,1 --shear 0.25 --regular --quiet"
        self.run_program(f"{run} --until 3 --events whole.csv --edges edges.csv",
                         text_of(random_discs(random.Random(6), 20, 8, (0, 0.25, 1, 2), (0, 0.125)), "radius,growth"))
        self.run_program(f"{run} --until 1 --events one.csv --checkpoint a")
        self.run_program("resume a --until 3 --events two.csv --edges end.csv --audit end --quiet")
        one, two, whole = (self.read(name).splitlines() for name in ("one.csv", "two.csv", "whole.csv"))
        self.assertEqual(one + two[1:], whole)
        self.assertEqual(self.read("end.csv"), self.read("edges.csv"))
        self.assertTrue(any(",hide," in row for row in two))

    def test_pictures_show_power_cells_and_hidden_discs(self):
        """A small disc in one as wide as the box is hidden, and passes out of it."""
        discs = [(4, 4, 0, 0, 4), (4, 5, 1, 0, 0.5), (0, 0, 0, 1, 1)]
        self.run_program("simulate p.csv --until 4 --periodic 8,8 --shear 0.25 --regular --events e.csv --html r.html "
                         "--frames f --vtu v --frames-per-time 0.5 --quiet", text_of(discs))
        kinds = [row["kind"] for row in self.rows()]
        self.assertIn("reveal", kinds)
        first = self.read("f/frame_000000.svg")
        self.assertIn("hidden", first)
        self.assertIn('Name="hidden"', self.read("v/frame_000000.vtu"))
        recording = json.loads(re.search('id="recording">(.*?)</script>', self.read("r.html"))[1])
        self.assertEqual(recording["periodic"], [0, 8, 0, 0, 0, 0, 0, 8, 2, 0])
        self.run_program("render r.html --at 1 --output p.svg --view show=voronoi,discs&color=area")
        drawing = self.read("p.svg")
        for name in ("box", "edges", "leaving-edges", "voronoi", "discs"):
            self.assertIn(f'class="{name}"', drawing)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
