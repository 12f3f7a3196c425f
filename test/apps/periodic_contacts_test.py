#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Discs that collide in periodic boxes: each contact of the log, and that there is no other one, from the motions
that the program has written, by all pairs of images in integers, for discs of one radius and of any; the
velocities after each contact; that runs give the same bytes; pictures; and what ends a run.

usage: periodic_contacts_test.py PROGRAM
"""
import fractions
import math
import random
import re
import sys
import unittest

sys.dont_write_bytecode = True
from periodic_case import Program_in_box  # noqa: E402

Fraction = fractions.Fraction
UNIT = 2**400  # a common denominator of all numbers


class Box:
    """Its vectors are (width, 0) and (tilt + rate t, height)."""

    def __init__(self, width, height, tilt=0, shear=0):
        self.options = f"--periodic {width},{height},{tilt} --shear={shear}"
        self.width, self.height, self.tilt = Fraction(width), Fraction(height), Fraction(tilt)
        self.rate = Fraction(shear) * self.height
        self.exact = [whole(number) for number in (self.width, self.height, self.tilt, self.rate)]

    def places(self, motion, time):
        x, y, vx, vy, _, _, epoch = motion
        return x + vx * (time - epoch), y + vy * (time - epoch)


def radius_at(motion, time):
    *_, radius, growth, epoch = motion
    return radius + growth * (time - epoch)


def whole(number):
    scaled = Fraction(number) * UNIT
    assert scaled.denominator == 1
    return scaled.numerator


class Disc:
    """Its motion from the time 0 on, (x, y, vx, vy, radius, growth): as integers, times UNIT, and rounded."""

    def __init__(self, motion):
        x, y, vx, vy, radius, growth, epoch = motion
        now = x - vx * epoch, y - vy * epoch, vx, vy, radius - growth * epoch, growth
        self.exact = [whole(number) for number in now]
        self.rounded = [float(number) for number in now]

    def at(self, time):
        """Place and radius, rounded."""
        x, y, vx, vy, radius, growth = self.rounded
        return x + vx * time, y + vy * time, radius + growth * time


class Approach:
    """The squared distance of a disc and an image of another one, less that at which they touch: a t^2 + 2 b t + c,
    times UNIT^2.

    The distance of the boundaries is convex in time: so the two come into contact once at most."""

    def __init__(self, box, first, second, offset):
        (k, l), (width, height, tilt, rate) = offset, box.exact
        x, y, vx, vy, radius, growth = first.exact
        to_x, to_y, to_vx, to_vy, other_radius, other_growth = second.exact
        x, y = to_x + k * width + l * tilt - x, to_y + l * height - y
        vx, vy = to_vx + l * rate - vx, to_vy - vy
        reach, growth = radius + other_radius, growth + other_growth
        self.a = vx * vx + vy * vy - growth * growth
        self.b = x * vx + y * vy - reach * growth
        self.c = x * x + y * y - reach * reach

    def at(self, time):
        """It and half its derivative, times positive numbers."""
        n, d = time.numerator, time.denominator
        slope = self.a * n + self.b * d
        return slope * n + (self.b * n + self.c * d) * d, slope

    def is_before(self, time):
        """Whether the two come into contact before the time."""
        value, slope = self.at(time)
        if self.a <= 0:  # the radii grow as fast as the centers move, or faster
            return value < 0
        if self.b * self.b <= self.a * self.c:
            return False
        return value < 0 or slope >= 0

    def is_reached(self, time):
        """Whether they come into contact before or at the time."""
        value, slope = self.at(time)
        return self.is_before(time) or (value == 0 and slope < 0)


class At_once:
    """The contact of two that overlap and approach."""

    def __init__(self, now):
        self.now = now

    def is_before(self, time):
        return self.now < time

    def is_reached(self, time):
        return self.now <= time


class All_pairs:
    """The contacts to come of all images, up to a time."""

    def __init__(self, box, motions, start, until):
        self.box, self.motions, self.until = box, motions, until
        self.discs = {point: Disc(motion) for point, motion in motions.items()}
        self.contacts = {}
        for a in motions:
            for b in motions:
                if a < b:
                    self.add(a, b, start)

    def add(self, a, b, now):
        first, second = self.discs[a], self.discs[b]
        width, height, tilt, rate = map(float, (self.box.width, self.box.height, self.box.tilt, self.box.rate))
        # Between the two times, x and y of the vector from one disc to an image of the other are linear. With room for
        # the rounding: images that are too far away make no contacts.
        d, ends = 0, []
        for time in (float(now), float(self.until)):
            (x, y, radius), (to_x, to_y, other_radius) = first.at(time), second.at(time)
            d = max(d, radius + other_radius + 1e-6)
            ends.append((to_x - x, to_y - y, tilt + rate * time))
        ys = [y for _, y, _ in ends]
        for l in range(math.ceil((-d - max(ys)) / height), math.floor((d - min(ys)) / height) + 1):
            xs = [x + l * tilt for x, _, tilt in ends]
            for k in range(math.ceil((-d - max(xs)) / width), math.floor((d - min(xs)) / width) + 1):
                approach = Approach(self.box, first, second, (k, l))
                value, slope = approach.at(now)
                if value < 0 and slope < 0:
                    self.contacts[a, b, (k, l)] = At_once(now)
                elif not approach.is_before(now) and approach.is_reached(self.until):
                    self.contacts[a, b, (k, l)] = approach

    def change(self, changed, now):
        """Gives points other motions (None: no point) from now on."""
        for point, motion in changed.items():
            if motion is None:
                del self.motions[point], self.discs[point]
            else:
                self.motions[point], self.discs[point] = motion, Disc(motion)
        for key in [key for key in self.contacts if key[0] in changed or key[1] in changed]:
            del self.contacts[key]
        for a in sorted(changed):
            for b in self.motions:
                if a in self.motions and a != b and not (b in changed and b < a):
                    self.add(min(a, b), max(a, b), now)


class Periodic_contacts(Program_in_box):
    def jittered_discs(self, generator, side, masses=False, radii=(), growths=()):
        """A disc for each unit square of a lattice, in it or an image of it; numbers are multiples of 1/64."""
        def number(least, most):
            return generator.randint(64 * least, 64 * most) / 64

        rows = ["x,y,vx,vy" + ",mass" * masses + ",radius" * bool(radii) + ",growth" * bool(growths)]
        for i in range(side):
            for j in range(side):
                x = i + number(0, 1) / 8 + side * generator.randint(-1, 1)
                row = [x, j + number(0, 1) / 8, number(-2, 2), number(-2, 2)] + [number(1, 3)] * masses
                row += [generator.choice(choices) for choices in (radii, growths) if choices]
                rows.append(",".join(map(repr, row)))
        return "\n".join(rows) + "\n"

    def motions(self):
        """Those at the start, and those that each event changes: {event: {id: motion}}."""
        changes = {}
        for row in self.rows("m.csv"):
            motion = row["x"] and tuple(Fraction(float(row[name])) for name in ("x", "y", "vx", "vy", "radius", "growth", "epoch"))
            changes.setdefault(row["event"], {})[int(row["id"])] = motion or None
        return changes.pop(""), changes

    def check_response(self, response, box, before, after, event, masses):
        """That the motions from the contact on are those of the response, up to rounding."""
        a, b, (_, l) = event["pair"]
        time = Fraction(event["time"])
        if response == "remove":
            return self.assertEqual(after, {a: None, b: None})
        for point, motion in after.items():
            self.assertEqual(motion[6], time)
            if before[point][5] == 0 or response == "stop":
                self.assertEqual(motion[5], 0)
            # A radius that does not change is not rounded; one that does is rounded down.
            most = radius_at(before[point], time)
            self.assertLessEqual(motion[4], most)
            self.assertGreaterEqual(motion[4], most if before[point][5] == 0 else most - 16 * math.ulp(8))
            for place, expected in zip(motion[:2], box.places(before[point], time)):
                self.assertLessEqual(abs(place - expected), 2 * math.ulp(float(expected)))
        if response == "stop":
            return self.assertEqual([motion[2:4] for motion in after.values()], [(0, 0)] * len(after))
        drift = l * box.rate
        v, w = before[a][2:4], (before[b][2] + drift, before[b][3])
        if response == "swap":
            expected = {a: w, b: v}
        else:
            (x, y), (to_x, to_y) = box.places(before[a], time), box.places(before[b], time)
            k = event["pair"][2][0]
            x = to_x + k * box.width + l * (box.tilt + box.rate * time) - x
            y = to_y + l * box.height - y
            growth = Fraction(math.hypot(x, y)) * (before[a][5] + before[b][5])
            push = 2 * ((w[0] - v[0]) * x + (w[1] - v[1]) * y - growth) / ((x * x + y * y) * (masses[a] + masses[b]))
            expected = {a: (v[0] + push * masses[b] * x, v[1] + push * masses[b] * y),
                        b: (w[0] - push * masses[a] * x, w[1] - push * masses[a] * y)}
        expected[b] = expected[b][0] - drift, expected[b][1]
        for point in (a, b):
            for found, wanted in zip(after.get(point, before[point])[2:4], expected[point]):
                self.assertLessEqual(abs(found - wanted), 1e-12)

    def check_run(self, response, box, points, radius, until, masses=None, more=""):
        """Compares a run with all pairs of images; the offsets of its contacts. Without a radius it is a column."""
        radius = "" if radius is None else f"--radius {radius}"
        self.run_program(f"simulate p.csv --until {until} {box.options} {radius} --collisions {response} {more} "
                         "--events e.csv --motions m.csv --edges f.csv --audit end --quiet", points)
        start, changes = self.motions()
        pairs = All_pairs(box, start, Fraction(0), Fraction(until))
        offsets = []
        for row in self.rows("e.csv"):
            if row["kind"] != "collision":
                self.assertNotIn(row["event"], changes)
                continue
            self.assertEqual(row["removed_offset"], "")
            a, b = int(row["point_a"]), int(row["point_b"])
            self.assertLess(a, b)
            key = a, b, tuple(map(int, row["added_offset"].split(" ")))
            lower, upper = Fraction(float(row["time_lo"])), Fraction(float(row["time_hi"]))
            self.assertTrue(key in pairs.contacts, row)
            self.assertTrue(pairs.contacts[key].is_reached(upper), row)
            early = [other for other, approach in pairs.contacts.items() if approach.is_before(lower)]
            self.assertEqual(early, [], row)
            del pairs.contacts[key]
            after = changes.get(row["event"], {})
            self.assertEqual(after == {}, response == "log", row)
            if after:
                event = {"pair": key, "time": float(row["time"])}
                before = dict(pairs.motions)
                self.check_response(response, box, before, after, event, masses or dict.fromkeys(before, 1))
                pairs.change(after, upper)
            offsets.append(key[2])
        self.assertEqual(list(pairs.contacts), [])
        return offsets

    def test_contacts_are_those_of_all_pairs_of_images(self):
        found = {}
        for response in ("log", "swap", "elastic", "stop", "remove"):
            for seed, shear in enumerate((0, 0.25, -0.5)):
                if response == "stop" and shear != 0:
                    continue  # images of discs that are stopped go on
                generator = random.Random(f"{response} {seed}")
                box = Box(5, 5, generator.choice([0, 1, -2]), shear)
                offsets = self.check_run(response, box, self.jittered_discs(generator, 5), 0.25, 2)
                found.setdefault(response, []).extend(offsets)
        for response, offsets in found.items():
            self.assertGreater(len(offsets), 15, response)
            self.assertGreater(sum(offset != (0, 0) for offset in offsets), 5, response)
        self.assertGreater(len(found["elastic"]), 60)

    def check_all_responses(self, name, radii, growths, until):
        """Runs of discs with radii of their own; `growths` has those by response."""
        found = {}
        for response in ("log", "swap", "elastic", "stop", "remove"):
            for seed, shear in enumerate((0, 0.25, -0.5)):
                if response == "stop" and shear != 0:
                    continue  # images of discs that are stopped go on
                generator = random.Random(f"{name} {response} {seed}")
                box = Box(5, 5, generator.choice([0, 1, -2]), shear)
                points = self.jittered_discs(generator, 5, radii=radii, growths=growths.get(response, growths.get("")))
                found.setdefault(response, []).extend(self.check_run(response, box, points, None, until))
        for response, offsets in found.items():
            self.assertGreater(len(offsets), 10, response)
            self.assertGreater(sum(offset != (0, 0) for offset in offsets), 5, response)

    def test_radii_may_differ(self):
        """Points, tiny and large discs."""
        self.check_all_responses("radii", (0, 2 ** -20, 0.125, 0.3, 0.4), {}, 2)

    def test_radii_may_grow(self):
        """At different rates; discs that shrink, and that grow from nothing. Swapped velocities do not part such discs."""
        growths = {"": (0, 0.03125, 0.0625, -0.0625), "swap": None}
        self.check_all_responses("growth", (0.125, 0.25, 0.3), growths, 1.5)
        generator = random.Random("from nothing")
        offsets = self.check_run("elastic", Box(4, 4, 1, 0.25), self.jittered_discs(generator, 4), None, 2, more="--growth 0.125")
        self.assertGreater(len(offsets), 5)

    def test_discs_that_overlap_pass_through_each_other(self):
        """Most of them are hidden by large ones."""
        for seed in range(4):
            generator = random.Random(f"overlap {seed}")
            points = self.jittered_discs(generator, 5, radii=(0, 0, 0.125, 0.5, 2))
            offsets = self.check_run("log", Box(5, 5, seed - 1, 0.25 * (seed - 2)), points, None, 2)
            self.assertGreater(len(offsets), 30)

    def test_masses_may_be_areas(self):
        generator = random.Random(7)
        points = self.jittered_discs(generator, 5, radii=(0.125, 0.25, 0.4))
        masses = {i: Fraction(float(line.split(",")[4])) ** 2 for i, line in enumerate(points.splitlines()[1:])}
        self.assertGreater(len(self.check_run("elastic", Box(5, 5), points, None, 2, masses, "--mass area")), 15)

    def test_elastic_collisions_have_masses(self):
        generator = random.Random(5)
        points = self.jittered_discs(generator, 4, masses=True)
        masses = {i: Fraction(line.split(",")[4]) for i, line in enumerate(points.splitlines()[1:])}
        self.assertGreater(len(set(masses.values())), 5)
        self.assertGreater(len(self.check_run("elastic", Box(4, 4), points, 0.25, 2, masses)), 15)

    def test_large_discs_meet_several_images_of_one(self):
        """Two discs in a thin box."""
        points = "x,y,vx,vy\n0,0,0,0\n4,0.5,1,0\n"
        offsets = self.check_run("log", Box(8, 1), points, 0.4375, 12)
        self.assertEqual(len(offsets), len(set(offsets)))
        self.assertGreater(len(offsets), 3)

    def test_radii_may_be_a_column(self):
        generator = random.Random(3)
        points = self.jittered_discs(generator, 4)
        run = "simulate p.csv --until 1 --periodic 4,4 --collisions elastic --events - --quiet "
        expected = self.run_program(run + "--radius 0.25", points).stdout
        self.assertIn(",collision,", expected)
        lines = points.splitlines()
        self.write("p.csv", "\n".join([lines[0] + ",radius", *(line + ",0.25" for line in lines[1:])]) + "\n")
        self.assertEqual(self.run_program(run).stdout, expected)
        # All masses are the same, too.
        self.assertEqual(self.run_program(run + "--mass area").stdout, expected)

    def test_same_run_gives_the_same_bytes(self):
        radii = self.jittered_discs(random.Random(9), 6, radii=(0, 0.25, 0.375), growths=(0, 0.0625))
        names = ("e.csv", "m.csv", "i.csv", "f.csv", "r.html")
        for points, radius in (self.jittered_discs(random.Random(9), 6), "--radius 0.25"), (radii, ""):
            run = (f"simulate p.csv --until 1 --periodic 6,6,1 --shear 0.25 --collisions elastic {radius} --quiet "
                   "--events e.csv --motions m.csv --initial-edges i.csv --edges f.csv --html r.html")
            self.run_program(run, points)
            expected = [self.read(name) for name in names]
            self.assertGreater(expected[0].count(",collision,"), 30)
            for more in ("", " --threads 2", " --exact-only", " --audit events"):
                self.run_program(run + more)
                self.assertEqual([self.read(name) for name in names], expected, more)

    def test_boxes_out_of_the_range_of_filters(self):
        """Squares of coordinates overflow or underflow there, and filters are unsure of all images."""
        for scale in ("1e-300", "1e300"):
            places = ((0, 0, 1, 0), (0.1, 0.2, -1, 2), (0.5, 0.7, 0, 1))
            points = "x,y,vx,vy\n" + "".join(",".join(repr(n * float(scale)) for n in row) + "\n" for row in places)
            run = (f"simulate p.csv --until 1 --periodic {scale},{scale} --radius {0.01 * float(scale)!r} --collisions elastic "
                   "--quiet --verify --events e.csv")
            self.run_program(run, points)
            expected = self.read("e.csv")
            self.assertGreater(expected.count("\n"), 20)
            self.run_program(run + " --exact-only")
            self.assertEqual(self.read("e.csv"), expected)

    def test_what_a_run_says(self):
        done = self.run_program("simulate p.csv --until 1 --periodic 4,4 --collisions log --radius 0.25 --stats s.json",
                                self.jittered_discs(random.Random(1), 4))
        self.assertRegex(done.stderr, r"events +\d+ at \d+ instants \(.*\d+ collision\)\n")
        self.assertRegex(self.read("s.json"), r'"collision": [1-9]')

    def check_picture(self, drawing):
        """That each image of a disc that overlaps the box is drawn, and none far away; returns the number of images."""
        def circles(name):
            group = drawing[drawing.index(f'class="{name}"'):].split("</g>")[0]
            return [tuple(map(float, circle)) for circle in re.findall(r'cx="(.*?)" cy="(.*?)" r="(.*?)"', group)]

        box = re.search('class="box"[^>]* d="([^"]*)"', drawing)[1]
        corners = [complex(*map(float, corner.split(" "))) for corner in re.findall(r"[ML]([^MLZ]*)", box)]
        a, b, c, d = dict.fromkeys(corners)
        sides = [(a, b), (b, c), (c, d), (d, a)]

        def gap(p):
            """From the center to the box."""
            def to_side(start, end):
                share = ((p - start) * (end - start).conjugate()).real / abs(end - start) ** 2
                return abs(p - start - min(max(share, 0), 1) * (end - start))

            turns = [((end - start).conjugate() * (p - start)).imag for start, end in sides]
            return 0 if max(turns) <= 0 or min(turns) >= 0 else min(to_side(*side) for side in sides)

        images = circles("disc-images")
        for x, y, r in images:
            self.assertLess(gap(complex(x, y)), 2 * r)
        for x, y, r in circles("discs"):
            for k in range(-2, 3):
                for l in range(-2, 3):
                    p = complex(x, y) + k * (b - a) + l * (d - a)
                    if (k, l) != (0, 0) and gap(p) < r - 0.1:
                        self.assertTrue(any(abs(complex(u, v) - p) < 0.1 and abs(radius - r) < 0.02 for u, v, radius in images),
                                        (x, y, k, l))
        return len(images)

    def test_pictures_have_images_of_discs_at_the_border(self):
        radii = self.jittered_discs(random.Random(8), 5, radii=(0.125, 0.25, 0.375), growths=(0, 0.0625))
        for name, points, radius in ("one", self.jittered_discs(random.Random(8), 5), "--radius 0.25"), ("many", radii, ""):
            self.run_program(f"simulate p.csv --until 2 --periodic 5,5,1 --shear 0.25 --collisions elastic {radius} --quiet "
                             f"--frames {name} --frames-per-time 1 --html r.html", points)
            images = 0
            for i in range(3):
                images += self.check_picture(self.read(f"{name}/frame_00000{i}.svg"))
                self.run_program(f"render r.html --at {i} --output p.svg")
                images += self.check_picture(self.read("p.svg"))
            self.assertGreater(images, 30)

    def test_runs_of_several_radii_are_verified(self):
        run = "simulate p.csv --until 4 --periodic 8,8 --shear 0.25 --collisions elastic --verify --quiet --events e.csv"
        done = self.run_program(run, "x,y,vx,vy,radius,growth\n0,0,1,0,1,0\n4,4,0,0.5,0.5,0.125\n4,0,-1,0,0.75,0\n")
        self.assertRegex(done.stdout, r"^verified: 3 points, \d+ events")
        self.assertIn("collision", self.read("e.csv"))

    def test_disc_that_meets_its_own_image_ends_the_run(self):
        """The upper vector is (7 - 3 t, 3), and the diameter 5."""
        run = ("simulate p.csv --until 2 --periodic 16,3,7 --shear=-1 --collisions elastic --radius 2.5 "
               "--events e.csv --edges f.csv")
        done = self.run_program(run, "x,y,vx,vy\n0,0,0,0\n", code=130)
        self.assertIn("from t = 0 to 1, at a disc that meets its own image\n", done.stderr)
        self.assertEqual(self.read("f.csv").count("\n"), 4)
        self.assertNotIn("collision", self.read("e.csv"))

    def test_disc_that_grows_ends_the_run_at_its_own_image(self):
        """The second one has the diameter 8 at the time 3."""
        run = "simulate p.csv --until 9 --periodic 16,8 --collisions log --events e.csv --edges f.csv"
        done = self.run_program(run, "x,y,vx,vy,radius,growth\n0,0,0,0,3.75,0\n8,0,0,0,1,1\n", code=130)
        self.assertIn("from t = 0 to 3, at a disc that meets its own image\n", done.stderr)
        self.assertIn("disc 1 meets its own image (0, 1) at t = 3;", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
