#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Motion logs of runs (--motions), replayed in rational arithmetic: that the motions begin as the points
file says and end as the checkpoint says; that they change at the events that say so, and go on as
docs/PROGRAM.md says, bit for bit; that with them each flip, wall and contact is where the event log has it;
and that a run that repeats them has the same logs.

usage: motions_test.py PROGRAM
"""
import collections
import csv
import fractions
import json
import math
import pathlib
import re
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from in_folder import In_folder  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
HEADER = "event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch"
NUMBERS = HEADER.split(",")[2:]
CHANGES = ("wall", "collision", "insert", "erase", "trajectory")

FALLING = ("x,y,vx,vy,ax,ay,jx,jy\n"
           "1,1,2,0,0,-2,0,0\n4,1,-1,1,0,-2,0,0\n7.5,1.25,0,1,0,-2,0.1,0\n1,4,0,0,0,-2,0,0\n"
           "4,4.5,1,1,0,-2,0,0\n7,4,-2,0,0,-2,0,0.2\n1.5,7,1,0,0,-2,0,0\n4,7,0,-1,0,-2,0,0\n7,7,0.5,0,0,0,0,0\n")
TRACKS = ("t,id,x,y\n"
          "0,a,0,0\n0,b,9,0.3\n0,c,0.1,9\n0,d,9,8\n"
          "1,visitor,1,1\n2.1,visitor,3.3,1.7\n3.3,visitor,3.9,1.1\n5,visitor,1.3,4.7\n"
          "0.7,other,8.1,8.2\n2.1,other,0.3,0.7\n4.9,other,7,2\n"
          "10,a,0.7,0.1\n2.1,b,9.7,1.9\n10,b,9.4,0\n10,c,0,9\n10,d,9,9\n")

Fraction = fractions.Fraction
Side = collections.namedtuple("Side", "axis sign position")


class Motion:
    """x, y and the radius, by powers of the time since the epoch, exactly."""

    def __init__(self, numbers):
        self.numbers = numbers  # as binary64
        exact = {name: Fraction(number) for name, number in numbers.items()}
        self.epoch = exact["epoch"]
        self.axes = [[exact[axis], exact["v" + axis], exact["a" + axis] / 2, exact["j" + axis] / 6] for axis in "xy"]
        self.sizes = [exact["radius"], exact["growth"]]

    def later(self, coefficients, time):
        """The same polynomial by powers of the time since `time`."""
        result = list(coefficients)
        for i in range(len(result)):
            for k in reversed(range(i, len(result) - 1)):
                result[k] += (time - self.epoch) * result[k + 1]
        return result

    def axis(self, index, time):
        return self.later(self.axes[index], time)

    def place(self, time):
        return [self.axis(index, time)[0] for index in (0, 1)]

    def radius(self, time):
        return self.sizes[0] + self.sizes[1] * (time - self.epoch)

    def is_linear(self):
        return not any(self.numbers[name] for name in ("ax", "ay", "jx", "jy"))

    def speed(self, index, time, slack):
        """A bound of |velocity| that motion_log's documentation allows for."""
        s = abs(time - self.epoch) + slack
        v, a, j = (abs(Fraction(self.numbers[name + "xy"[index]])) for name in "vaj")
        return v + s * (a + s * j / 2)


def rounded_toward(number, sign):
    """The nearest binary64 number that is not beyond `number`: at most that if sign is 1, else at least that."""
    result = float(number)
    return math.nextafter(result, -sign * math.inf) if sign * Fraction(result) > sign * number else result


class Run:
    """A run of the program, and the files that it writes."""

    def __init__(self, folder, command, name="run", has_checkpoint=True):
        self.files = {kind: folder / f"{name}.{kind}" for kind in ("events", "motions", "checkpoint")}
        has_checkpoint = has_checkpoint and not command.startswith("tracks")
        checkpoint = f"--checkpoint {self.files['checkpoint'].name}" if has_checkpoint else ""
        line = (f"{command} --events {self.files['events'].name} --motions {self.files['motions'].name} "
                f"{checkpoint} --quiet")
        result = subprocess.run([PROGRAM, *line.split()], cwd=folder, timeout=600, check=False,
                                capture_output=True, text=True)
        assert result.returncode == 0, result.stderr
        with open(self.files["events"], encoding="utf-8", newline="") as file:
            self.events = {int(row["event"]): row for row in csv.DictReader(file)}
        self.text = self.files["motions"].read_text(encoding="utf-8")
        self.rows = list(csv.DictReader(self.text.splitlines()))

    def changes(self):
        """The lines that name an event."""
        return [line for line in self.text.splitlines()[1:] if not line.startswith(",")]

    def start(self):
        return {int(row["id"]): Motion(numbers_of(row)) for row in self.rows if not row["event"]}

    def motions_at_end(self):
        """By id, from the checkpoint: {name: number}."""
        text = self.files["checkpoint"].read_text(encoding="utf-8")
        state = json.loads(text[text.index("\n") + 1 : text.rindex("checksum")])
        kind = state["motion"]
        names = ["x", "y", "vx", "vy"] + ["ax", "ay", "jx", "jy"] * kind.startswith("polynomial") + ["epoch"]
        names += ["radius", "growth", "weight"] * kind.endswith("disc")
        return {point: dict(zip(names, numbers)) for point, numbers in enumerate(state["points"]) if numbers}


def numbers_of(row):
    return {name: float(row[name]) for name in NUMBERS}


class Motions(In_folder):
    def generate(self, arguments, name="p.csv"):
        subprocess.run([PROGRAM, "generate", *arguments.split(), "--output", name], cwd=self.folder, check=True)

    def replay(self, command, box=None, rim=False, **wanted):
        """Runs, checks all of the log, and expects so many events of a kind at least."""
        run = Run(self.folder, command)
        self.assertTrue(run.text.startswith(HEADER + "\n"))
        self.sides = []
        if box:
            self.sides = [Side(axis, sign, Fraction(box[axis + (2 if sign > 0 else 0)])) for axis in (0, 1)
                          for sign in (-1, 1)]
        self.rim = rim
        self.motions = run.start()
        self.assertEqual([int(row["id"]) for row in run.rows[: len(self.motions)]], sorted(self.motions))
        rows = collections.defaultdict(list)
        for row in run.rows[len(self.motions) :]:
            rows[int(row["event"])].append(row)
        self.assertEqual([int(row["event"]) for row in run.rows[len(self.motions) :]],
                         sorted(number for number in rows for _ in rows[number]))
        counts = collections.Counter()
        for number, event in run.events.items():
            counts[event["kind"]] += 1
            with self.subTest(event=event):
                self.check_event(event)
                self.check_changes(event, rows.pop(number, []), command)
        self.assertFalse(rows, "rows of events that there are not")
        if not command.startswith("tracks"):
            self.check_end(run)
        for kind, number in wanted.items():
            self.assertGreaterEqual(counts[kind], number, kind)
        self.check_repetition(run, command)
        return run

    def check_repetition(self, run, command):
        """simulate --replay gives the same logs. Radii, growth and masses are not options of it."""
        command = re.sub(r" --(radius|growth|mass) \S+", "", command)
        options = re.sub(r"^(simulate|tracks) \S+", "", command)
        again = Run(self.folder, f"simulate {run.files['motions'].name} --replay {run.files['events'].name} {options}",
                    "again", has_checkpoint=False)
        self.assertEqual(again.events, run.events)
        self.assertEqual(again.text, run.text)

    def check_end(self, run):
        end = run.motions_at_end()
        self.assertEqual(end.keys(), self.motions.keys())
        for point, numbers in end.items():
            self.assertEqual(numbers.pop("weight", 0), 0)
            self.assertEqual({name: self.motions[point].numbers[name] for name in numbers}, numbers)

    # ---- the event is where the log has it, for the motions before it ----

    def check_event(self, event):
        low, high = Fraction(float(event["time_lo"])), Fraction(float(event["time_hi"]))
        if event["kind"] == "flip":
            four = [self.motions[int(event[end])] for end in ("removed_a", "removed_b", "added_a", "added_b")]
            values = [circle_determinant(four, time) for time in (low, high)]
        elif event["kind"] == "wall":
            point = self.motions[int(event["point_a"])]
            inside = [[self.inside(point, side, time) for time in (low, high)] for side in self.sides]
            values = min(inside, key=lambda pair: abs(pair[0]))
        elif event["kind"] == "collision":
            a, b = self.motions[int(event["point_a"])], self.motions[int(event["point_b"])]
            values = [gap(a, b, time) for time in (low, high)]
            # A response may round so that two go on a little nearer than they touch, and touch again.
            if self.have_met(a, b, low):
                return
        else:
            return
        self.assertLessEqual(values[0] * values[1], 0)
        if low == high:
            self.assertEqual(values[0], 0)

    def have_met(self, a, b, time):
        return gap(a, b, time) < 0 and any(motion.epoch >= time for motion in (a, b))

    def inside(self, motion, side, time):
        """How far the point, or its rim, is inside of the side."""
        distance = side.sign * (side.position - motion.place(time)[side.axis])
        return distance - (motion.radius(time) if self.rim else 0)

    # ---- how the motions change ----

    def check_changes(self, event, rows, command):
        kind = event["kind"]
        points = [int(event[name]) for name in ("point_a", "point_b") if event[name]]
        if kind not in CHANGES:
            return self.assertEqual(rows, [])
        changed = [int(row["id"]) for row in rows]
        if kind == "collision":
            self.assertEqual(changed, [point for point in points if point in changed])
        else:
            self.assertEqual(changed, points)
        for row in rows:
            point = int(row["id"])
            self.assertEqual(point in self.motions, kind != "insert")
            old = self.motions.pop(point, None)
            if not row["x"]:
                self.assertTrue(all(row[name] == "" for name in NUMBERS))
                self.assertTrue(kind == "erase" or "--collisions remove" in command)
                continue
            new = self.motions[point] = Motion(numbers_of(row))
            if kind in ("wall", "collision"):
                self.check_continuation(event, old, new, "--collisions stop" in command and kind == "collision")
                if kind == "wall":
                    self.check_reflection(event, old, new)
            elif command.startswith("tracks"):
                self.assertEqual(event["time_lo"], event["time_hi"])
                self.assertEqual(new.numbers["epoch"], float(event["time"]))
                if kind == "trajectory":
                    self.check_turn(old, new)

    def check_turn(self, old, new):
        for was, is_now, begin in zip(old.place(new.epoch), new.place(new.epoch), old.place(old.epoch)):
            self.assertLessEqual(abs(was - is_now), abs(is_now - begin) / 2**51)

    def check_continuation(self, event, old, new, stops):
        """Steps 1, 2, 4 and 5 of docs/PROGRAM.md."""
        time = Fraction(float(event["time"]))
        expected = dict(new.numbers)  # the velocity, and a radius that changes
        expected["epoch"] = float(event["time"])
        for index, axis in enumerate("xy"):
            place, _, half_acceleration, _ = old.axis(index, time)
            expected[axis] = float(place)
            expected["a" + axis] = 0.0 if stops else float(2 * half_acceleration)
            expected["j" + axis] = 0.0 if stops else old.numbers["j" + axis]
            if stops:
                expected["v" + axis] = 0.0
        expected["growth"] = 0.0 if stops else old.numbers["growth"]
        if old.numbers["growth"] == 0:
            expected["radius"] = old.numbers["radius"]
        else:
            self.check_radius(old, new, expected, time)
        for side in self.sides:
            self.move_inside(expected, side, event)
        self.assertEqual(new.numbers, expected)

    def check_radius(self, old, new, expected, time):
        last = abs(float(time))
        half = (Fraction(math.nextafter(last, math.inf)) - Fraction(last)) / 2
        speeds = sum(old.speed(i, time, half) + new.speed(i, time, half) for i in (0, 1))
        shift = ((abs(Fraction(expected["x"])) + abs(Fraction(expected["y"]))) / 2**53
                 + half * (speeds + abs(old.sizes[1])))
        most = ((abs(old.sizes[0]) + abs(old.sizes[1] * (time - old.epoch))) / 2**48 + 4 * shift
                + Fraction(1, 2**1019))
        self.assertGreaterEqual(new.sizes[0], 0)
        self.assertLessEqual(new.sizes[0], max(0, old.radius(time)))
        self.assertLessEqual(old.radius(time) - new.sizes[0], most)

    def move_inside(self, numbers, side, event):
        low, high = Fraction(float(event["time_lo"])), Fraction(float(event["time_hi"]))
        motion = Motion(numbers)
        c = [-side.sign * number for number in motion.axis(side.axis, low)]
        c[0] += side.sign * side.position
        if self.rim:
            c[0] -= motion.radius(low)
            c[1] -= motion.sizes[1]
        c = [number * (high - low) ** power for power, number in enumerate(c)]
        least = min(c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, sum(c))
        if least < 0:
            name = "xy"[side.axis]
            numbers[name] = rounded_toward(Fraction(numbers[name]) + side.sign * least, side.sign)
            for time in (low, high):
                self.assertGreaterEqual(self.inside(Motion(numbers), side, time), 0)

    def check_reflection(self, event, old, new):
        """Step 3."""
        low, time = Fraction(float(event["time_lo"])), Fraction(float(event["time"]))
        side = min(self.sides, key=lambda side: abs(self.inside(old, side, low)))
        for index, axis in enumerate("xy"):
            before = old.axis(index, time)[1]
            after = Fraction(new.numbers["v" + axis])
            if index == side.axis:
                turned = 2 * old.sizes[1] * -side.sign if self.rim else 0
                before = -before
                if self.rim and old.sizes[1] and old.is_linear():
                    self.assertEqual(after, Fraction(float(before + turned)))
                    continue
                before += turned
            terms = old.speed(index, time, 0) + abs(before)
            self.assertLessEqual(abs(after - before), 0 if old.is_linear() else terms / 2**49)

    # ---- runs ----

    def test_points_in_a_box_of_another_start(self):
        self.generate("uniform --points 40 --speed 5 --seed 3")
        self.replay("simulate p.csv --from -2 --until 8 --box -12,-12,112,112", (-12, -12, 112, 112),
                    wall=5, flip=50)

    def test_start_is_the_points_file(self):
        self.write("p.csv", "y,vx,x,vy\n0.1,1e-300,0x1.8p1,-0\n5,6,7,8\n-3,0,0,0\n")
        run = Run(self.folder, "simulate p.csv --until 1")
        self.assertEqual(run.text.splitlines()[1:4], [",0,3,0.1,1e-300,-0,0,0,0,0,0,0,0", ",1,7,5,6,8,0,0,0,0,0,0,0",
                                                      ",2,0,-3,0,0,0,0,0,0,0,0,0"])

    def test_discs_of_one_size(self):
        self.generate("lattice-jitter --points 49 --speed 5 --seed 2")
        for response in ("elastic", "swap", "stop", "remove", "log"):
            for rim in ("", "--rim"):
                with self.subTest(response=response, rim=rim):
                    few = response in ("stop", "remove")
                    self.replay(f"simulate p.csv --until 6 --box -6,-6,66,66 {rim} --collisions {response} --radius 3",
                                (-6, -6, 66, 66), bool(rim), collision=5, wall=1 if few else 10)

    def test_discs_that_grow(self):
        self.generate("packing --points 30 --share 0.2 --sizes 3 --side 40 --speed 2 --growth 0.02 --seed 5")
        for options, rim in (("elastic --rim", True), ("elastic --mass area", False), ("swap --rim", True)):
            with self.subTest(options=options):
                self.replay(f"simulate p.csv --until 6 --box 0,0,40,40 --collisions {options}", (0, 0, 40, 40), rim,
                            collision=20, wall=10, flip=20)

    def test_discs_that_grow_and_stop(self):
        self.generate("packing --points 30 --share 0.2 --sizes 3 --side 40 --speed 2 --growth 0.1 --seed 5")
        self.replay("simulate p.csv --until 2 --collisions stop", collision=5)

    def test_points_that_accelerate(self):
        self.write("p.csv", FALLING)
        self.replay("simulate p.csv --until 6 --box 0,0,9,9", (0, 0, 9, 9), wall=10, flip=5)
        self.replay("simulate p.csv --until 6 --box 0,0,9,9 --collisions elastic --radius 0.5 --rim", (0, 0, 9, 9), True,
                    wall=10, collision=10)
        self.replay("simulate p.csv --until 3 --box 0,0,9,9 --collisions stop --radius 0.5 --growth 0.03125",
                    (0, 0, 9, 9), wall=2, collision=3)
        self.replay("simulate p.csv --until 6 --box 0,0,9,9 --collisions elastic --radius 0.375 --growth 0.015625 --rim",
                    (0, 0, 9, 9), True, wall=10, collision=5)

    def test_points_that_are_hidden(self):
        self.generate("packing --points 40 --share 0.3 --sizes 5 --side 40 --speed 4 --growth 0.2 --seed 1")
        run = self.replay("simulate p.csv --until 8 --regular", flip=20, hide=3)
        self.assertEqual(run.changes(), [])

    def test_tracks(self):
        self.write("t.csv", TRACKS)
        self.replay("tracks t.csv --until 9", insert=2, erase=2, trajectory=4)
        self.replay("tracks t.csv --from 0.8 --until 9", insert=1, erase=2, trajectory=3)

    def test_parts_are_the_whole(self):
        self.generate("lattice-jitter --points 49 --speed 5 --seed 2")
        command = "simulate p.csv --box -6,-6,66,66 --collisions elastic --radius 3"
        whole = Run(self.folder, f"{command} --until 5", "whole")
        first = Run(self.folder, f"{command} --until 2.5", "first")
        second = Run(self.folder, "resume first.checkpoint --until 5", "second")
        self.assertGreater(len(second.changes()), 50)
        self.assertEqual(first.changes() + second.changes(), whole.changes())
        self.assertEqual({point: motion.numbers | {"radius": 0} for point, motion in second.start().items()},
                         {point: {name: 0 for name in NUMBERS} | numbers
                          for point, numbers in first.motions_at_end().items()})


def gap(a, b, time):
    """The squared distance of the centers less the square of the sum of the radii."""
    (ax, ay), (bx, by) = a.place(time), b.place(time)
    return (ax - bx) ** 2 + (ay - by) ** 2 - (a.radius(time) + b.radius(time)) ** 2


def circle_determinant(four, time):
    """Zero where the four discs have a common orthogonal circle: of points, where they are cocircular."""
    places = [motion.place(time) for motion in four]
    x, y = places[3]
    weight = four[3].radius(time) ** 2
    a, b, c = ((px - x, py - y, (px - x) ** 2 + (py - y) ** 2 - motion.radius(time) ** 2 + weight)
               for (px, py), motion in zip(places, four[:3]))
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
