#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Logs of runs in periodic boxes: true ones are verified, most of them degenerate, and false ones are refuted.

usage: periodic_test.py true|lies KINETRI VERIFY FOLDER

The environment variable KINETRI_TEST_MULTIPLIER says how many times as many runs with contacts there are.
"""
import collections
import copy
import csv
import itertools
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import zlib
from fractions import Fraction

KINETRI, VERIFY = (str(pathlib.Path(path).resolve()) for path in sys.argv[2:4])
FOLDER = pathlib.Path(sys.argv[4])
KINDS = ("grid", "few", "crystal", "one", "random", "moving", "weights")
DISCS = ("lattice", "gas", "sizes")  # kinds with contacts
RESPONSES = ("log", "swap", "elastic", "stop", "remove")
MOTIONS = "event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch".split(",")
LIES = {}
TWICE = set()  # lies that are told twice
TIMES = int(os.environ.get("KINETRI_TEST_MULTIPLIER", "1"))


# ---- runs ----

def make_points(kind, generator):
    """Points (x, y, vx, vy), and the box (LX, LY, XY, shear)."""
    def whole(least, most):
        return generator.randint(least, most)

    if kind == "one":
        return [(0.5, 0.25, 1, -2)], (whole(1, 3), whole(1, 3), whole(-2, 2), whole(-3, 3) or 1)
    if kind in ("grid", "moving"):  # points meet, and have the same images
        number = whole(2, 12)
        box = whole(1, 4), whole(1, 4), whole(-1, 1), whole(-1, 1) / 2
        return [(whole(-4, 4), whole(-4, 4), whole(-1, 1), whole(-1, 1)) for _ in range(number)], box
    if kind == "few":
        box = whole(1, 3), whole(1, 3), whole(-9, 9) / 4, whole(-4, 4) / 4
        return [(whole(-9, 9) / 4, whole(-9, 9) / 4, whole(-9, 9) / 4, whole(-9, 9) / 4)
                for _ in range(whole(1, 5))], box
    if kind == "crystal":  # cocircular all over, at rest or sheared with the box
        n = whole(1, 4)
        shear = generator.choice([0, 0.5, 1])
        return [(x, y, shear * y, 0) for x in range(n) for y in range(n)], (n, n, 0, shear)
    if kind == "weights":  # discs of several radii, some of which grow, and hide others
        box = whole(3, 6), whole(3, 6), whole(-1, 1), whole(-2, 2) / 4
        sizes = [(1, 0), *((generator.choice([0, 0.5, 1, 2]), generator.choice([0, 0, 0.25])) for _ in range(whole(6, 20)))]
        return [(whole(-4, 4), whole(-4, 4), whole(-2, 2), whole(-2, 2), radius + growth, growth)
                for radius, growth in sizes], box
    number = whole(5, 40)
    return [tuple(generator.uniform(*limits) for limits in ((0, 9), (0, 9), (-2, 2), (-2, 2)))
            for _ in range(number)], (9.1, 8.9, 0.3, generator.choice([0, 0.1, -0.7]))


def make_rates(kind, box, start, generator):
    """How much the vectors of the box change in a unit of time, and the time at which they are those of the box; None
    if only --shear changes them."""
    if kind != "moving" and (kind not in ("weights", "sizes") or generator.random() < 0.5):
        return None
    width, height, tilt, _ = box
    share = generator.choice([-1, 1, 2]) / 8
    return generator.choice([[share * width, 0, share * tilt, share * height], [0, share, 0, 0], [share, 0, 0, 0],
                             [0, 0, share, share], [0.125, 0.25, -0.25, 0.125]]), generator.choice([0, start])


def make_discs(kind, generator):
    """Points whose discs are apart, the box, a response and a radius. On a lattice many contacts have one time. Discs
    of several sizes, of which some grow or shrink, have their radii and growths in the points."""
    n, m = generator.randint(1, 3), generator.randint(2, 3)
    shear = generator.choice([0, 0, 0.5, -1])
    box = 3 * n, 3 * m, generator.choice([0, 0, 1, -2]), shear
    drift = generator.choice([0, shear])  # with the box
    is_mirrored = generator.random() < 0.5  # neighbors have opposite velocities
    u, v = generator.choice([(1, 0), (0, 1), (1, 1), (1, -2)])
    points = []
    for i, j in itertools.product(range(n), range(m)):
        k, l = generator.choice([(0, 0), (0, 0), (1, 0), (-1, 1)])
        x, y = 3 * i + k * box[0] + l * box[2], 3 * j + l * box[1]
        if kind == "lattice" and is_mirrored:
            sign = (-1) ** (i + j)
            points.append((x, y, sign * u + drift * y, sign * v))
        elif kind == "lattice":
            points.append((x, y, generator.randint(-1, 1) + drift * y, generator.randint(-1, 1)))
        else:
            place = x + generator.uniform(-0.5, 0.5), y + generator.uniform(-0.5, 0.5)
            points.append((*place, generator.uniform(-2, 2), generator.uniform(-2, 2)))
    response = generator.choice(RESPONSES)
    # With little room in a sheared box these two make discs faster and faster.
    is_wild = shear and response in ("swap", "elastic")
    radius = 0.5 if is_wild else generator.choice([0.5, 0.75, 1])
    if kind == "sizes":
        points = [(*point, radius / (1 + k % 3), generator.choice([0, 0.0625, -0.03125]) if k > 0 else 0)
                  for k, point in enumerate(points)]
    return points, box, response, radius


class Row(list):
    """The fields of a row of the log; and the motions that it has, without the number of the row."""

    motions = ()


class Run:
    """What a run has written, as lists of fields; and its options."""

    def __init__(self, kind, generator, folder):
        self.response, self.told = None, None  # told to the verifier, if it is another one
        self.radius = None  # of all discs
        if kind in DISCS:
            self.points, self.box, self.response, self.radius = make_discs(kind, generator)
        else:
            self.points, self.box = make_points(kind, generator)
        # Discs of several sizes are apart at 0.
        self.start = generator.choice([0, 0, 0.5, -1]) if kind != "sizes" else 0
        self.until = 4 if kind in DISCS else 2
        self.rates = make_rates(kind, self.box, self.start, generator)
        self.folder = folder
        self.write_points()
        collide = ["--collisions", self.response] if self.response else []
        if self.response and not self.has_sizes():
            collide.append(f"--radius={self.radius}")
        self.simulate(self.until, "--events", "events.csv", "--motions", "motions.csv", "--initial-edges", "initial.csv",
                      "--edges", "final.csv", "--audit", "end", start=collide)
        self.header, *self.rows = map(Row, self.read("events.csv"))
        self.motions = []  # at the start
        for event, *motion in self.read("motions.csv")[1:]:
            if event:
                self.rows[int(event)].motions = (*self.rows[int(event)].motions, motion)
            else:
                self.motions.append(motion)
        _, *self.initial = self.read("initial.csv")
        _, *self.final = self.read("final.csv")

    def has_sizes(self):
        return len(self.points[0]) > 4

    def simulate(self, until, *outputs, start=()):
        """Makes the run, with options of its start. A box that not only shears is put into the checkpoint of a run that
        ends where it starts, as only Python has such boxes; the points there are those of the file."""
        sides = f"--periodic={','.join(map(repr, self.box[:3]))}"
        regular = ["--regular"] if self.has_sizes() else []
        begin = [KINETRI, "simulate", "points.csv", f"--from={self.start}", "--quiet", *regular, *start]
        if not self.rates:
            subprocess.run([*begin, *self.box_options(), "--until", str(until), *outputs], check=True, cwd=self.folder)
            return
        subprocess.run([*begin, sides, "--until", str(self.start), "--checkpoint", "start"], check=True, cwd=self.folder)
        text = (self.folder / "start").read_text(encoding="utf-8")
        first, *middle, _ = text.splitlines(keepends=True)
        state = json.loads("".join(middle))
        width, height, tilt, _ = map(float, self.box)
        (a, b, c, d), epoch = self.rates
        state["periodic_box"] = [[width, 0.0, float(a), float(b), float(epoch)], [tilt, height, float(c), float(d), float(epoch)]]
        text = first + json.dumps(state) + "\n"
        (self.folder / "start").write_text(f"{text}checksum {zlib.crc32(text.encode()):08x}\n", encoding="utf-8")
        subprocess.run([KINETRI, "resume", "start", "--quiet", "--until", str(until), *outputs], check=True, cwd=self.folder)

    def box_options(self):
        if self.rates:
            width, height, tilt, _ = self.box
            rates, epoch = self.rates
            return [f"--periodic={width},0,{tilt},{height}", f"--rates={','.join(map(repr, rates))}",
                    f"--epochs={epoch},{epoch}"]
        return [f"--periodic={','.join(map(repr, self.box[:3]))}", f"--shear={self.box[3]!r}"]

    def read(self, name):
        with open(self.folder / name, encoding="utf-8", newline="") as file:
            return list(csv.reader(file))

    def write(self, name, rows):
        (self.folder / name).write_text("".join(",".join(map(str, row)) + "\n" for row in rows), encoding="utf-8")

    def write_points(self):
        columns = ("x", "y", "vx", "vy", "radius", "growth")
        self.write("points.csv", [columns[:len(self.points[0])], *(map(repr, point) for point in self.points)])

    def verify(self, points="points.csv", edges=("initial", "final"), more=()):
        """The exit code, and what the verifier says."""
        self.write_points()
        self.write("events.csv", [self.header, *self.rows])
        self.write("initial.csv", [("a", "b", "offset"), *self.initial])
        self.write("final.csv", [("a", "b", "offset"), *self.final])
        self.write("motions.csv", [MOTIONS, *(("", *motion) for motion in self.motions),
                                   *((row[0], *motion) for row in self.rows for motion in row.motions)])
        files = {"initial": ["--initial-edges", "initial.csv"], "final": ["--edges", "final.csv"]}
        options = [word for name in edges for word in files[name]]
        if (self.response or self.has_sizes()) and points == "points.csv":
            options += ["--motions", "motions.csv", "--collisions", self.told or self.response or "none"]
        done = subprocess.run([VERIFY, points, "events.csv", "--until", str(self.until), f"--from={self.start}",
                               *self.box_options(), *options, *more],
                              cwd=self.folder, text=True, capture_output=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def column(self, name):
        return self.header.index(name)

    def number_anew(self):
        """Numbers the rows, and gives each row at the three numbers of the row before its instant."""
        instant, before = 0, None
        for i, row in enumerate(self.rows):
            now = row[2:5], row[-3]
            if now != before:
                instant = i
            before = now
            row[0], row[-3] = str(i), str(instant)


def runs(kind, number, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for seed in range(number):
        yield seed, Run(kind, random.Random(f"{kind} {seed}"), folder)


def expect_true(run, kind, seed, ways):
    for options in ways:
        code, says = run.verify(**options)
        if code != 0:
            sys.exit(f"{kind} {seed} {options}: {code}: {says}")


def second_part(run):
    """The run from the middle on, where discs that pass through each other may overlap: the numbers of its rows
    begin with another one than 0."""
    part = copy.deepcopy(run)
    part.start = (run.start + run.until) / 2
    run.simulate(part.start, "--edges", "middle.csv")
    _, *part.initial = run.read("middle.csv")
    part.rows = [row for row in run.rows if float(row[2]) > part.start]
    return part


def check_true():
    counts = collections.Counter()
    for kind in KINDS:
        for seed, run in runs(kind, 16, FOLDER / kind):
            expect_true(run, kind, seed, ({}, {"edges": ["initial"]}, {"edges": ["final"]}, {"points": "motions.csv"},
                                          *([] if run.has_sizes() else [{"more": ["--motions", "motions.csv"]}])))
            counts[kind] += len(run.rows)
            for name in ("rebuild", "hide", "reveal"):
                counts[name] += sum(row[1] == name for row in run.rows)
            counts["rows in boxes with rates"] += len(run.rows) if run.rates else 0
            counts["roots"] += sum(row[3] != row[4] for row in run.rows)
            counts["together"] += sum(row[0] != row[-3] for row in run.rows)
    for kind in DISCS:
        for seed, run in runs(kind, 24 * TIMES, FOLDER / kind):
            # A file of motions that stands for the points has no response: that there are contacts is inferred.
            expect_true(run, kind, seed, ({"more": ["--threads", "2"]}, {"edges": ["final"], "points": "motions.csv"}))
            if run.response == "log":
                expect_true(second_part(run), kind, seed, ({},))
            contacts = [row for row in run.rows if row[1] == "collision"]
            counts[kind] += len(contacts)
            counts["contacts in boxes with rates"] += len(contacts) if run.rates else 0
            counts[run.response] += len(contacts)
            counts["contacts together"] += sum(row[0] != row[-3] for row in contacts)
            counts["contacts of far images"] += sum(row[-1] != "0 0" for row in contacts)
    print(dict(counts))
    least = {"grid": 1000, "few": 600, "crystal": 100, "one": 15, "random": 1500, "rebuild": 800, "roots": 2500,
             "together": 800,
             "moving": 1000, "weights": 1000, "hide": 60, "reveal": 60, "rows in boxes with rates": 1200,
             "sizes": 60, "contacts in boxes with rates": 20,
             "lattice": 100, "gas": 80, "contacts together": 30, "contacts of far images": 100,
             **dict.fromkeys(RESPONSES, 10)}
    short = {name: counts[name] for name, number in least.items() if counts[name] < number}
    if short:
        sys.exit(f"too few rows: {short}")


# ---- lies ----

def lie(function):
    """A function that changes a run, and returns whether it has."""
    LIES[function.__name__] = function
    return function


def lie_about_sizes(function):
    """A lie that is about runs with discs of several sizes and without contacts."""
    TWICE.add(function.__name__)
    return lie(function)


def lie_about_contacts(function):
    """A lie that is about runs with contacts only, and chooses one of them."""
    def told(run, generator):
        i = chosen(run, generator, lambda run, i: run.rows[i][1] == "collision")
        return i is not None and function(run, generator, i)

    LIES[function.__name__] = told
    TWICE.add(function.__name__)
    return function


def may_pass(run):
    """Whether discs may pass through each other. Then two that are not neighbors may overlap, and so have contacts
    that the log does not determine."""
    return run.response == "log" or (run.response == "stop" and (run.box[3] != 0 or run.rates))


def is_alone(run, i):
    """Whether the row is the only one of its instant."""
    return sum(row[-3] == run.rows[i][-3] for row in run.rows) == 1


def chosen(run, generator, condition=lambda run, i: True):
    return generator.choice([i for i in range(len(run.rows)) if condition(run, i)] or [None])


def shifted(field, by):
    x, y = map(int, field.split(" "))
    return f"{x + by[0]} {y + by[1]}"


@lie
def a_row_left_out(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][1] != "collision")
    if i is None:
        return False
    leave_out(run, i)
    return True


def leave_out(run, i):
    del run.rows[i]
    for row in run.rows[i:]:
        row[0] = str(int(row[0]) - 1)
        row[-3] = str(int(row[-3]) - 1) if int(row[-3]) > i else row[-3]


@lie
def a_row_doubled(run, generator):
    i = chosen(run, generator, is_alone)
    if i is None or (run.rows[i][1] == "collision" and run.response == "stop" and may_pass(run)):
        return False  # of a disc that is stopped the image may go on, and have more contacts of that time
    run.rows.insert(i, copy.deepcopy(run.rows[i]))
    run.number_anew()
    return True


@lie
def the_last_rows_left_out(run, generator):
    if not run.rows:
        return False
    i = generator.randrange(len(run.rows))
    if may_pass(run) and all(row[1] == "collision" for row in run.rows[i:]):
        return False
    del run.rows[i:]
    return True


@lie
def rows_swapped(run, generator):
    i = chosen(run, generator, lambda run, i: i > 0 and is_alone(run, i) and is_alone(run, i - 1))
    if i is None:
        return False
    first, second = run.rows[i - 1: i + 1]
    first[5:], second[5:] = second[5:-3] + first[-3:-2] + second[-2:], first[5:-3] + second[-3:-2] + first[-2:]
    return first[5:9] != second[5:9] or first[-2:] != second[-2:]


@lie
def a_time_that_is_another_number(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][3] == run.rows[i][4] and is_alone(run, i))
    if i is None:
        return False
    run.rows[i][2:5] = [repr(math.nextafter(float(run.rows[i][2]), generator.choice([-9, 9])))] * 3
    return True


@lie
def an_interval_moved(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][3] != run.rows[i][4])
    if i is None:
        return False
    towards = generator.choice([-9, 9])
    for row in run.rows:
        if row[-3] == run.rows[i][-3] and row is not run.rows[i]:
            row[2:5] = [repr(math.nextafter(float(text), towards)) for text in row[2:5]]
    run.rows[i][2:5] = [repr(math.nextafter(float(text), towards)) for text in run.rows[i][2:5]]
    return True


@lie
def the_other_end_of_an_interval(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][3] != run.rows[i][4])
    if i is None:
        return False
    row = run.rows[i]
    row[2] = row[4] if row[2] == row[3] else row[3]
    return True


@lie
def an_exact_time_for_a_root(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][3] != run.rows[i][4])
    if i is None:
        return False
    run.rows[i][3] = run.rows[i][4] = run.rows[i][2]
    return True


@lie
def an_offset_of_a_removed_edge(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][-2] and run.rows[i][5] != run.rows[i][6])
    if i is None:
        return False
    run.rows[i][-2] = shifted(run.rows[i][-2], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    return True


@lie
def an_offset_of_an_added_edge(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][-1] and run.rows[i][7] != run.rows[i][8])
    if i is None:
        return False
    run.rows[i][-1] = shifted(run.rows[i][-1], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    return True


@lie
def an_offset_that_is_reversed(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][-1] not in ("", "0 0"))
    if i is None:
        return False
    run.rows[i][-1] = " ".join(str(-int(number)) for number in run.rows[i][-1].split(" "))
    return True


@lie
def an_offset_of_a_first_edge(run, generator):
    edge = generator.choice([edge for edge in run.initial if edge[0] != edge[1]] or [None])
    if edge is None:
        return False
    edge[2] = shifted(edge[2], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    run.initial.sort(key=lambda e: (int(e[0]), int(e[1]), *map(int, e[2].split(" "))))
    return all(a != b for a, b in zip(run.initial, run.initial[1:]))


@lie
def an_offset_of_a_last_edge(run, generator):
    edge = generator.choice([edge for edge in run.final if edge[0] != edge[1]] or [None])
    if edge is None:
        return False
    edge[2] = shifted(edge[2], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    run.final.sort(key=lambda e: (int(e[0]), int(e[1]), *map(int, e[2].split(" "))))
    return all(a != b for a, b in zip(run.final, run.final[1:]))


@lie
def a_first_edge_left_out(run, generator):
    del run.initial[generator.randrange(len(run.initial))]
    return True


@lie
def a_last_edge_left_out(run, generator):
    if not run.final:  # all discs are removed
        return False
    del run.final[generator.randrange(len(run.final))]
    return True


@lie
def another_edge_flipped(run, generator):
    """The row tells of the flip of an edge of the first row of another time."""
    i = chosen(run, generator, lambda run, i: run.rows[i][1] == "flip" and is_alone(run, i))
    k = chosen(run, generator, lambda run, k: run.rows[k][1] == "flip")
    if i is None or run.rows[i][5:9] + run.rows[i][-2:] == run.rows[k][5:9] + run.rows[k][-2:]:
        return False
    run.rows[i][5:9], run.rows[i][-2:] = run.rows[k][5:9], run.rows[k][-2:]
    return True


@lie
def a_flip_of_the_hull(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][1] == "flip")
    if i is None:
        return False
    run.rows[i][1] = "hull_insert"
    run.rows[i][7] = run.rows[i][8] = run.rows[i][-1] = ""
    return True


@lie
def a_box_of_another_shear(run, generator):
    if not run.rows:
        return False
    if run.rates:
        run.rates[0][generator.choice([2, 3])] += generator.choice([-1, 1]) / 1024
    else:
        run.box = (*run.box[:3], run.box[3] + generator.choice([-1, 1]) / 1024)
    return any(row[1] != "rebuild" and row[3] != row[4] and int(offset.split(" ")[1]) != 0
               for row in run.rows for offset in row[-2:] if offset)


@lie_about_sizes
def a_hidden_point_for_another(run, generator):
    """The row hides or reveals another point."""
    i = chosen(run, generator, lambda run, i: run.rows[i][1] in ("hide", "reveal"))
    others = [] if i is None else [str(k) for k in range(len(run.points)) if str(k) not in run.rows[i][9:11]]
    if not others:
        return False
    run.rows[i][9] = generator.choice(others)
    return True


@lie_about_sizes
def a_point_hidden_for_one_revealed(run, generator):
    """Or the reverse."""
    i = chosen(run, generator, lambda run, i: run.rows[i][1] in ("hide", "reveal"))
    if i is None:
        return False
    run.rows[i][1] = "reveal" if run.rows[i][1] == "hide" else "hide"
    return True


@lie_about_sizes
def a_hidden_disc_that_is_the_largest(run, _):
    """And so hidden by none. No row tells of it."""
    told = {end for edge in run.initial for end in edge[:2]} | {row[9] for row in run.rows}
    hidden = [k for k in range(len(run.points)) if str(k) not in told]
    if not run.has_sizes() or not hidden:
        return False
    run.points[hidden[0]] = (*run.points[hidden[0]][:4], 9, 0)
    run.motions[hidden[0]][9:11] = ["9", "0"]
    return True


@lie_about_sizes
def another_size(run, generator):
    """The radius or the growth of an end of an edge that is flipped."""
    i = chosen(run, generator, lambda run, i: run.rows[i][1] == "flip" and run.rows[i][3] != run.rows[i][4]
               and len({*run.rows[i][5:9]}) > 1)
    if i is None or not run.has_sizes():
        return False
    point = int(generator.choice(run.rows[i][5:9]))
    k = generator.choice([4, 5])
    number = run.points[point][k] + 1 / 1024
    run.points[point] = (*run.points[point][:k], number, *run.points[point][k + 1:])
    run.motions[point][k + 5] = repr(number)
    return True


@lie
def a_run_that_ends_sooner(run, generator):
    """Than its last row."""
    if not run.rows or float(run.rows[-1][2]) <= run.start + 0.125:
        return False
    run.until = float(run.rows[-1][2]) - 0.0625
    return True


@lie
def a_run_that_begins_later(run, generator):
    if not run.rows or float(run.rows[0][4]) >= run.until or run.rows[0][1] == "collision":
        return False
    run.start = float(run.rows[0][4])
    return True


@lie_about_contacts
def a_contact_left_out(run, generator, i):
    if may_pass(run):  # only neighbors have the first one
        i = next(k for k, row in enumerate(run.rows) if row[1] == "collision")
    leave_out(run, i)
    return True


@lie_about_contacts
def an_offset_of_a_contact(run, generator, i):
    run.rows[i][-1] = shifted(run.rows[i][-1], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    return True


@lie_about_contacts
def an_offset_of_a_contact_reversed(run, _, i):
    before = run.rows[i][-1]
    run.rows[i][-1] = " ".join(str(-int(number)) for number in before.split(" "))
    return before != run.rows[i][-1]


@lie_about_contacts
def a_contact_of_another_point(run, generator, i):
    """The offset is kept; the motions are those of the other points."""
    row = run.rows[i]
    others = [str(k) for k in range(len(run.points)) if str(k) not in row[9:11]]
    if not others:
        return False
    pair = sorted((generator.choice(row[9:11]), generator.choice(others)), key=int)
    row.motions = [[pair[row[9:11].index(motion[0])], *motion[1:]] for motion in row.motions]
    row[9:11] = pair
    return True


def move_contact(run, i, times):
    """The row and its motions at other times, `time`, `time_lo` and `time_hi`. The discs are in the places in which
    they would be then."""
    row = run.rows[i]
    row[2:5] = times
    row.motions = copy.deepcopy(row.motions)
    for motion in row.motions:
        if not motion[1]:
            continue
        before = [m for r in [*run.rows[:i]] for m in r.motions if m[0] == motion[0]]
        before = before[-1] if before else next(m for m in run.motions if m[0] == motion[0])
        since = Fraction(float(times[0])) - Fraction(float(before[11]))
        for k in (1, 2):
            motion[k] = repr(float(Fraction(float(before[k])) + Fraction(float(before[k + 2])) * since))
        motion[9] = repr(float(Fraction(float(before[9])) + Fraction(float(before[10])) * since))
        motion[11] = times[0]


def is_root(run, i):
    return run.rows[i][3] != run.rows[i][4]


@lie_about_contacts
def a_contact_beyond_its_interval(run, generator, i):
    if not is_alone(run, i):
        return False
    towards = generator.choice([-math.inf, math.inf])
    width = abs(float(run.rows[i][4]) - float(run.rows[i][3])) or math.ulp(float(run.rows[i][2]))
    move_contact(run, i, [repr(float(text) + math.copysign(width, towards)) for text in run.rows[i][2:5]])
    return True


@lie_about_contacts
def a_contact_much_later(run, generator, i):
    """In the middle between the row and the next one, or the end."""
    later = float(run.rows[i + 1][3]) if i + 1 < len(run.rows) else run.until
    middle = (float(run.rows[i][4]) + later) / 2
    if not is_alone(run, i) or not float(run.rows[i][4]) < middle < later:
        return False
    move_contact(run, i, [repr(middle)] * 3)
    return True


@lie_about_contacts
def a_contact_at_the_other_end_of_its_interval(run, _, i):
    if not is_root(run, i) or not is_alone(run, i):
        return False
    _, _, time, lo, hi = run.rows[i][:5]
    move_contact(run, i, [hi if time == lo else lo, lo, hi])
    return True


@lie_about_contacts
def a_contact_at_a_number_for_a_root(run, _, i):
    if not is_root(run, i) or not is_alone(run, i):
        return False
    move_contact(run, i, [run.rows[i][2]] * 3)
    return True


@lie_about_contacts
def a_contact_too_much(run, generator, i):
    """Of two images that are apart then; nothing changes."""
    pair = sorted(generator.sample(range(len(run.points)), 2))
    offset = f"{generator.randint(7, 9)} {generator.randint(7, 9)}"
    row = Row([*run.rows[i][:5], "", "", "", "", *map(str, pair), run.rows[i][-3], "", offset])
    run.rows.insert(i + 1, row)
    run.number_anew()
    return True


@lie_about_contacts
def another_response(run, generator, i):
    """Those that stop or remove all discs have motions, `log` has none, and `none` has no contacts."""
    told = ["none", "stop", "remove"] if run.response == "log" else ["none"]
    run.told = generator.choice(told)
    return True


@lie_about_contacts
def a_place_after_a_contact(run, generator, i):
    """In the last bit."""
    found = [motion for motion in run.rows[i].motions if motion[1]]
    if not found:
        return False
    motion = generator.choice(found)
    k = generator.choice([1, 2])
    motion[k] = repr(math.nextafter(float(motion[k]), generator.choice([-math.inf, math.inf])))
    return True


@lie_about_contacts
def a_radius_after_a_contact(run, generator, i):
    found = [motion for motion in run.rows[i].motions if motion[1]]
    if not found:
        return False
    motion = generator.choice(found)
    motion[9] = repr(float(motion[9]) + 0.125)
    return True


@lie_about_contacts
def a_motion_of_a_third_point(run, generator, i):
    others = [str(k) for k in range(len(run.points)) if str(k) not in run.rows[i][9:11]]
    if not others or not run.rows[i].motions:
        return False
    generator.choice(run.rows[i].motions)[0] = generator.choice(others)
    return True


def check_own_image():
    """The run ends before a disc meets its own image. A log that goes on is false."""
    folder = FOLDER / "own"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "points.csv").write_text("x,y,vx,vy\n0,0,1,0\n2.25,0.25,0,0.25\n", encoding="utf-8")
    box = ["--periodic=4,1,2", "--shear=0.125", "--collisions=elastic"]
    done = subprocess.run([KINETRI, "simulate", "points.csv", "--until", "40", *box, "--radius", "0.53125", "--events",
                           "events.csv", "--motions", "motions.csv", "--initial-edges", "initial.csv"],
                          cwd=folder, text=True, capture_output=True, check=False)
    end = float(done.stderr.split("the run ends at t = ")[1].split(" ")[0])
    for until, expected in ((end - 2**-40, "verified"), (end + 2**-40, "refuted: the end: contact of ")):
        says = subprocess.run([VERIFY, "points.csv", "events.csv", "--until", repr(until), "--motions", "motions.csv",
                               "--initial-edges", "initial.csv", *box],
                              cwd=folder, text=True, capture_output=True, check=False).stdout
        if not says.startswith(expected) or (expected[0] == "r" and not re.search(r"of (\d) \1 \(1, -1\)", says)):
            sys.exit(f"until {until}: {says}")


def check_refusals():
    """What is not supported, and input that no run has."""
    _, run = next(runs("gas", 1, FOLDER / "refused"))
    i = next(i for i, row in enumerate(run.rows) if row[1] == "collision")

    def expect(code, words, change, **ways):
        changed = copy.deepcopy(run)
        change(changed)
        found, says = changed.verify(**ways)
        if found != code or words not in says:
            sys.exit(f"expected {code}: {words}; found {found}: {says}")

    def edit(table, k, column, field):
        def change(changed):
            (changed.rows if table == "rows" else changed.motions)[k][column] = field
        return change

    def double_a_point(changed):  # and its images
        changed.motions.append([str(len(changed.motions)), *changed.motions[0][1:]])
        changed.rows = []
        changed.until = changed.start

    def take_box(*options):
        def change(changed):
            changed.box_options = lambda: options
        return change

    no_area = "the area of the --periodic box is 0 or negative at a time of the run"
    expect(2, no_area, take_box("--periodic=1,2,2,4"))
    expect(2, no_area, take_box("--periodic=-1,2"))
    expect(2, no_area, take_box("--periodic=4,0,0,4", "--rates=-1,0,0,0"))  # at the end
    expect(2, "--rates needs --periodic AX,AY,BX,BY", take_box("--periodic=4,4", "--rates=1,0,0,0"))
    expect(2, "--epochs needs --periodic AX,AY,BX,BY", take_box("--periodic=4,4", "--epochs=1,0"))
    expect(2, "--epochs needs --periodic", take_box("--epochs=1,0"))
    expect(2, "--shear needs --periodic LX,LY", take_box("--periodic=1,0,0,1", "--shear=1"))
    expect(2, "expected 2 to 4 finite numbers", take_box("--periodic=1,0,0,1,1"))
    expect(2, "discs coincide in a periodic box", double_a_point, points="motions.csv", edges=["initial"],
           more=["--collisions", "log"])
    expect(2, "the column added_offset is ''; expected two whole numbers", edit("rows", i, -1, ""))
    expect(1, f"refuted: row {i}: it has an offset of no edge", edit("rows", i, -2, "0 0"))
    expect(1, f"refuted: row {i}: there is no wall in a periodic box", edit("rows", i, 1, "wall"))


def check_double_cover():
    """The edges of every other image of one point are those of a surface, and Delaunay."""
    _, run = next(runs("one", 1, FOLDER / "double"))
    run.points, run.box, run.start, run.until, run.rows = [(0, 0, 0, 0)], (1, 1, 0, 0), 0, 2, []
    says = []
    for diagonal in ("2 -1", "2 1"):
        run.initial = [("0", "0", "0 1"), *sorted([("0", "0", "2 0"), ("0", "0", diagonal)])]
        code, answer = run.verify(edges=["initial"])
        says.append(answer)
        if code != 1:
            sys.exit(f"edges that cover the box twice: {code}: {answer}")
    if not any("do not cover the box once, but 2 times" in answer for answer in says):
        sys.exit(f"no answer says that the box is covered twice: {says}")


def check_growth_from_nothing():
    """A square that has no area at 0 can be used from 1 on. One of its diagonals is an edge."""
    _, run = next(runs("one", 1, FOLDER / "growth"))
    run.points, run.start, run.until, run.rows = [(0, 0, 0, 0)], 1, 2, []
    run.box_options = lambda: ("--periodic=0,0,0,0", "--rates=1,0,0,1")
    codes = []
    for diagonal in ("1 -1", "1 1"):
        run.initial = sorted([("0", "0", "0 1"), ("0", "0", "1 0"), ("0", "0", diagonal)])
        codes.append(run.verify(edges=["initial"]))
    if sorted(code for code, _ in codes) != [0, 1]:
        sys.exit(f"a square that grows from nothing: {codes}")


def check_lies():
    check_double_cover()
    check_growth_from_nothing()
    check_own_image()
    check_refusals()
    told, refuted = collections.Counter(), collections.Counter()
    for kind in (*KINDS, *DISCS):
        for seed, run in runs(kind, 8 * TIMES if kind in DISCS else 8, FOLDER / kind):
            for name, time in itertools.product(LIES, range(2)):
                if kind in DISCS and name not in TWICE and seed % 2 == 1:
                    continue
                changed = copy.deepcopy(run)
                generator = random.Random(f"{kind} {seed} {name}" + " again" * time)
                if (time == 1 and name not in TWICE) or not LIES[name](changed, generator):
                    continue
                told[name] += 1
                code, says = changed.verify()
                if code == 1 and says.startswith("refuted: "):
                    refuted[name] += 1
                else:
                    print(f"{name}, {kind} {seed}: {code}: {says.strip()}")
    for name in LIES:
        print(f"{name}: {told[name]} told, {refuted[name]} refuted")
    few = [name for name in LIES if told[name] < 10]
    if told != refuted or few:
        sys.exit(f"not all are refuted, or told often enough: {few}")


if __name__ == "__main__":
    {"true": check_true, "lies": check_lies}[sys.argv[1]]()
