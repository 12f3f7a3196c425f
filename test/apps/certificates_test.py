#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Certificates of events (--certificates): the checker in examples/python, which knows nothing of Kinetri, accepts
those of every kind of run, and refuses a good file with any single thing wrong in it.

usage: certificates_test.py PROGRAM
"""
import copy
import csv
import fractions
import json
import pathlib
import re
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from in_folder import In_folder  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
CHECKER = ROOT / "examples" / "python" / "check_certificates.py"
WITHOUT = {"insert", "erase", "trajectory", "rebuild"}

sys.path.insert(0, str(CHECKER.parent))
import check_certificates  # noqa: E402

TRACKS = ("t,id,x,y\n0,a,0,0\n0,b,9,0.3\n0,c,0.1,9\n0,d,9,8\n1,visitor,1,1\n2.1,visitor,3.3,1.7\n3.3,visitor,3.9,1.1\n"
          "5,visitor,1.3,4.7\n0.7,other,8.1,8.2\n2.1,other,0.3,0.7\n4.9,other,7,2\n10,a,0.7,0.1\n2.1,b,9.7,1.9\n"
          "10,b,9.4,0\n10,c,0,9\n10,d,9,9\n")
ACCELERATED = ("x,y,vx,vy,ax,ay,jx,jy\n1,1,2,0,0,-2,0,0\n4,1,-1,1,0,-2,0,0\n7.5,1.25,0,1,0,-2,0.1,0\n1,4,0,0,0,-2,0,0\n"
               "4,4.5,1,1,0,-2,0,0\n7,4,-2,0,0,-2,0,0.2\n1.5,7,1,0,0,-2,0,0\n4,7,0,-1,0,-2,0,0\n7,7,0.5,0,0,0,0,0\n")
# Point 3 comes down to the hull edge below it at t = 1, and goes through it at t = 3: y = (t - 1)^2 (3 - t).
TOUCH = "x,y,vx,vy,ax,ay,jx,jy\n-10,0,0,0,0,0,0,0\n10,0,0,0,0,0,0,0\n0,50,0,0,0,0,0,0\n0,3,0,-7,0,10,0,-6\n"


ERRORS = (AssertionError, ArithmeticError, LookupError, TypeError, ValueError)


def number(pair):
    return int(pair[0]) * fractions.Fraction(2) ** pair[1]


def dyadic(value):
    """Of a fraction whose denominator is a power of two."""
    return [str(value.numerator), 1 - value.denominator.bit_length()]


class Certificates(In_folder):
    def run_program(self, command, fails=False):
        result = subprocess.run([PROGRAM, *command.split()], cwd=self.folder, timeout=600, check=False,
                                capture_output=True, text=True)
        if not fails:
            self.assertEqual(result.returncode, 0, command + result.stderr)
        return result

    def run_checker(self, name):
        return subprocess.run([sys.executable, CHECKER, name], cwd=self.folder, check=False, capture_output=True, text=True)

    def certified(self, command):
        """The rows of a run, accepted by the checker; one for each event, whose time is in its interval."""
        self.run_program(f"{command} --events log.csv --certificates c.jsonl --quiet")
        rows = [json.loads(line) for line in (self.folder / "c.jsonl").read_text("ascii").splitlines()]
        for row in rows:
            check_certificates.check(row)
        with open(self.folder / "log.csv", encoding="ascii", newline="") as file:
            log = list(csv.DictReader(file))
        self.assertEqual([(row["event"], row["kind"]) for row in rows], [(int(e["event"]), e["kind"]) for e in log])
        for row, event in zip(rows, log):
            named = {int(event[key]) for key in ("removed_a", "removed_b", "added_a", "added_b", "point_a", "point_b")
                     if event[key]}
            self.assertLessEqual(named, set(row["points"]))
            if row["polynomial"] is None:
                self.assertIn(row["kind"], WITHOUT | {"flip", "collision", "hide", "reveal"})
                continue
            self.assertNotIn(row["kind"], WITHOUT)
            low, high = (fractions.Fraction(float(event[key])) for key in ("time_lo", "time_hi"))
            self.assertLessEqual(low, number(row["lower"]))
            self.assertLessEqual(number(row["upper"]), high)
        return rows

    def kinds(self, rows):
        return {row["kind"] for row in rows if row["polynomial"] is not None}

    def test_the_degenerate_corpus_is_accepted(self):
        touches, finer, multiple = 0, 0, 0
        for path in sorted((ROOT / "data" / "degenerate").glob("*.csv")):
            text = path.read_text("utf-8")
            self.write("points.csv", text)
            until = re.search(r"^# until: (\S+)", text, re.MULTILINE)
            with self.subTest(path.name):
                rows = self.certified(f"simulate points.csv --until {until[1] if until else '1e3'}")
                failed = [row for row in rows if row["polynomial"] is not None]
                touches += sum(bool(row["touches"]) for row in failed)
                multiple += sum(row["multiplicity"] > 1 for row in failed)
                finer += sum(number(row["upper"]).denominator > 2**53 for row in failed)
        self.assertGreater(min(touches, finer, multiple), 0, (touches, finer, multiple))

    def test_walls_discs_and_regular_triangulations_are_accepted(self):
        self.write("a.csv", ACCELERATED)
        self.assertLessEqual({"wall", "flip"}, self.kinds(self.certified("simulate a.csv --until 4 --box 0,0,9,9")))
        self.certified("simulate a.csv --until 4 --box 0,0,9,9 --radius 0.4 --collisions log")
        self.run_program("generate uniform --points 40 --side 1 --seed 3 --speed 0.3 --output u.csv")
        self.assertLessEqual({"collision", "wall", "hull_insert", "hull_remove"},
                             self.kinds(self.certified("simulate u.csv --until 3 --box 0,0,1,1 --radius 0.01 "
                                                       "--collisions elastic")))

    def test_points_that_others_hide_are_accepted(self):
        lines = ["x,y,vx,vy,radius,growth"]
        state = 7
        for _ in range(40):
            values = []
            for _ in range(6):
                state = state * 6364136223846793005 + 1442695040888963407 & 2**64 - 1
                values.append((state >> 44) / 2**20)
            x, y, vx, vy, radius, growth = values
            lines.append(f"{10 * x},{10 * y},{2 * vx - 1},{2 * vy - 1},{3 * radius**3},{0.2 * growth}")
        self.write("d.csv", "\n".join(lines) + "\n")
        self.assertLessEqual({"hide", "reveal", "flip"}, self.kinds(self.certified("simulate d.csv --until 9 --regular")))

    def test_periodic_boxes_are_accepted(self):
        self.run_program("generate uniform --points 30 --side 1 --seed 3 --speed 0.5 --output u.csv")
        for options, kinds in (("", {"flip"}), ("--shear 0.5", {"flip"}),
                               ("--shear 0.25 --collisions elastic --radius 0.02", {"flip", "collision"})):
            rows = self.certified(f"simulate u.csv --until 2 --periodic 1,1,0.25 {options}")
            self.assertLessEqual(kinds, self.kinds(rows))
            failed = [row for row in rows if row["polynomial"] is not None]
            self.assertTrue(all(len(row["offsets"]) == len(row["points"]) for row in failed))
            self.assertTrue(any(offset != [0, 0] for row in failed for offset in row["offsets"]))
        # Two flips of images of one point, or of two.
        self.write("p.csv", "x,y,vx,vy\n0,0,0,0\n0.3,0.4,0.2,-0.1\n")
        rows = self.certified("simulate p.csv --until 9 --periodic 1,1 --shear 1")
        self.assertTrue(any(len(set(row["points"])) < 4 for row in rows if row["polynomial"] is not None))
        self.flip_polynomials_are_those_of_images(rows, 1)

    def flip_polynomials_are_those_of_images(self, rows, shear):
        """In a box of the side 1 that is sheared, of the points of p.csv: at five times, up to a positive factor."""
        lines = (self.folder / "p.csv").read_text("ascii").splitlines()[1:]
        points = [[fractions.Fraction(text) for text in line.split(",")] for line in lines]
        points = [[fractions.Fraction(float(c)) for c in point] for point in points]  # as binary64 numbers

        def place(id, offset, t):
            x, y, vx, vy = points[id]
            k, l = offset
            return x + vx * t + k + l * shear * t, y + vy * t + l

        def circle(places):
            (*three, (x, y)) = places
            (a, b, c), (d, e, f), (g, h, i) = [(p - x, q - y, (p - x) ** 2 + (q - y) ** 2) for p, q in three]
            return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)

        flips = [row for row in rows if row["kind"] == "flip" and row["polynomial"] is not None]
        self.assertGreater(len(flips), 5)
        for row in flips:
            images = list(zip(row["points"], row["offsets"]))
            values = [(-circle([place(*image, t) for image in images]),
                       check_certificates.value([int(c) for c in row["polynomial"]], t)) for t in range(-2, 3)]
            factor = next(b / a for a, b in values if a)
            self.assertGreater(factor, 0)
            self.assertTrue(all(a * factor == b for a, b in values))

    def test_tracks_and_waves_are_accepted(self):
        self.write("t.csv", TRACKS)
        rows = self.certified("tracks t.csv")
        self.assertTrue({row["kind"] for row in rows} & {"insert", "erase"})
        self.assertLessEqual({"flip", "collision"}, self.kinds(self.certified("wave --columns 6 --rows 6 --jitter 2 --until 20")))

    def test_a_run_in_two_parts_is_accepted(self):
        self.run_program("generate uniform --points 30 --side 1 --seed 5 --speed 0.5 --output u.csv")
        whole = self.certified("simulate u.csv --until 2")
        first = self.certified("simulate u.csv --until 1 --checkpoint s.kinetri")
        second = self.certified("resume s.kinetri --until 2")
        self.assertEqual([row["event"] for row in first + second], [row["event"] for row in whole])
        # From the checkpoint on all certificates are asked for anew; the failures are the same.
        keys = ("kind", "points", "polynomial", "lower", "upper", "multiplicity")
        self.assertEqual([[row.get(key) for key in keys] for row in first + second],
                         [[row.get(key) for key in keys] for row in whole])

    def test_the_log_is_that_of_a_run_without(self):
        self.run_program("generate uniform --points 60 --side 1 --seed 9 --speed 0.5 --output u.csv")
        self.run_program("simulate u.csv --until 2 --events without.csv --quiet")
        self.certified("simulate u.csv --until 2")
        self.run_program("simulate u.csv --until 2 --certificates exact.jsonl --exact-only --quiet")
        self.run_program("simulate u.csv --until 2 --certificates again.jsonl --quiet")
        log, without, exact, rows, again = ((self.folder / name).read_bytes() for name in (
            "log.csv", "without.csv", "exact.jsonl", "c.jsonl", "again.jsonl"))
        self.assertEqual(log, without)
        self.assertEqual(rows, exact)
        self.assertEqual(rows, again)

    def test_a_file_that_cannot_be_written_is_an_error_and_not_there(self):
        self.write("p.csv", TOUCH)
        for path in ("nowhere/c.jsonl", "."):
            result = self.run_program(f"simulate p.csv --until 4 --certificates {path}", fails=True)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(path, result.stderr)
        result = self.run_program("simulate p.csv --until 4 --certificates /dev/full --events log.csv", fails=True)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("/dev/full", result.stderr)
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"p.csv"})

    def test_every_sabotage_is_refused(self):
        self.write("t.csv", (ROOT / "data" / "degenerate" / "touches_and_flips_together.csv").read_text("utf-8"))
        rows = [row for row in self.certified("simulate t.csv --until 1e3") if row["polynomial"] is not None]
        self.run_program("generate uniform --points 30 --side 1 --seed 5 --speed 0.5 --output u.csv")
        plain = next(row for row in self.certified("simulate u.csv --until 2")
                     if row["kind"] == "flip" and number(row["from"]) < number(row["lower"]) < number(row["upper"]))
        self.write("touch.csv", TOUCH)
        touching = next(row for row in self.certified("simulate touch.csv --until 9") if row["touches"])
        exact = next(row for row in rows if row["lower"] == row["upper"])
        for row in (plain, touching, exact):
            check_certificates.check(row)

        def set_member(**members):
            return lambda row: row.update(members)

        def moved(key, by):
            return lambda row: row.update({key: dyadic(number(row[key]) + by)})

        def flipped_sign(place, term):
            def change(row):
                row["signs"][place][term] = -row["signs"][place][term]
            return change

        width = number(plain["upper"]) - number(plain["lower"])
        root = touching["touches"][0]
        sabotages = {
            "a coefficient": (plain, lambda row: row["polynomial"].__setitem__(0, str(int(row["polynomial"][0]) + 10**60))),
            "the polynomial negated": (plain, set_member(polynomial=[str(-int(c)) for c in plain["polynomial"]])),
            "the polynomial of another event": (plain, set_member(polynomial=touching["polynomial"])),
            "a leading zero": (plain, lambda row: row["polynomial"].append("0")),
            "a constant": (plain, set_member(polynomial=["1"])),
            "a text that is no integer": (plain, lambda row: row["polynomial"].__setitem__(0, "1.5")),
            "no polynomial": (plain, set_member(polynomial=None, reason="none")),
            "from after lower": (plain, set_member(**{"from": plain["upper"]})),
            "lower before all": (plain, moved("lower", -10**6)),
            "lower beyond the root": (plain, set_member(lower=plain["upper"])),
            "upper before the root": (plain, set_member(upper=plain["lower"])),
            "upper beyond all": (plain, moved("upper", 10**6)),
            "both beyond the root": (plain, set_member(lower=plain["upper"],
                                                       upper=dyadic(number(plain["upper"]) + width))),
            "a sign at from": (plain, flipped_sign(0, 0)),
            "a sign at lower": (plain, flipped_sign(1, 1)),
            "a sign at upper": (plain, flipped_sign(2, -1)),
            "a list of signs that is missing": (plain, lambda row: row["signs"].pop()),
            "a term that is missing": (plain, lambda row: row["signs"][1].pop()),
            "the multiplicity": (plain, set_member(multiplicity=3)),
            "a touch that is none": (plain, set_member(touches=[[plain["from"], plain["lower"]]])),
            "a point that is missing": (plain, lambda row: row["points"].pop()),
            "a point twice": (plain, lambda row: row["points"].__setitem__(0, row["points"][1])),
            "another kind": (plain, set_member(kind="wall")),
            "a kind that does not exist": (plain, set_member(kind="flop")),
            "a member that is missing": (plain, lambda row: row.pop("upper")),
            "a touch that is missing": (touching, set_member(touches=[])),
            "a touch twice": (touching, lambda row: row["touches"].append(root)),
            "a touch elsewhere": (touching, set_member(touches=[[touching["from"], touching["from"]]])),
            "an exact root moved": (exact, lambda row: row.update(
                lower=dyadic(number(row["lower"]) + fractions.Fraction(1, 2**40)),
                upper=dyadic(number(row["upper"]) + fractions.Fraction(1, 2**40)))),
            "an exact root of another multiplicity": (exact, set_member(multiplicity=exact["multiplicity"] + 1)),
        }
        for name, (row, change) in sabotages.items():
            bad = copy.deepcopy(row)
            change(bad)
            self.assertNotEqual(bad, row, name)
            with self.subTest(name), self.assertRaises(ERRORS):
                check_certificates.check(bad)

    def test_the_checker_names_the_line(self):
        self.write("touch.csv", "x,y,vx,vy\n0,0,1,0\n4,0,0,1\n0,4,0,0\n5,5,-1,-1\n1,2,0,-0.7\n")
        rows = self.certified("simulate touch.csv --until 9")
        self.assertGreater(len(rows), 2)
        result = self.run_checker("c.jsonl")
        self.assertEqual((result.returncode, result.stdout), (0, f"{len(rows)} certificates are right\n"))
        lines = [json.dumps(row) + "\n" for row in rows]
        for name, bad in (("a line that is missing", lines[:1] + lines[2:]), ("a line twice", lines[:2] + lines[1:]),
                          ("half a line", [lines[0], lines[1][:40]])):
            self.write("bad.jsonl", "".join(bad))
            result = self.run_checker("bad.jsonl")
            self.assertEqual(result.returncode, 1, name)
            self.assertIn("bad.jsonl, line " + ("3" if "twice" in name else "2"), result.stderr, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
