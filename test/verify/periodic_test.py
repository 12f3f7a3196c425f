#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Logs of runs in periodic boxes: true ones are verified, most of them degenerate, and false ones are refuted.

usage: periodic_test.py true|lies KINETRI VERIFY FOLDER
"""
import collections
import copy
import csv
import math
import pathlib
import random
import subprocess
import sys

KINETRI, VERIFY = (str(pathlib.Path(path).resolve()) for path in sys.argv[2:4])
FOLDER = pathlib.Path(sys.argv[4])
KINDS = ("grid", "few", "crystal", "one", "random")
LIES = {}


# ---- runs ----

def make_points(kind, generator):
    """Points (x, y, vx, vy), and the box (LX, LY, XY, shear)."""
    def whole(least, most):
        return generator.randint(least, most)

    if kind == "one":
        return [(0.5, 0.25, 1, -2)], (whole(1, 3), whole(1, 3), whole(-2, 2), whole(-3, 3) or 1)
    if kind == "grid":  # points meet, and have the same images
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
    number = whole(5, 40)
    return [tuple(generator.uniform(*limits) for limits in ((0, 9), (0, 9), (-2, 2), (-2, 2)))
            for _ in range(number)], (9.1, 8.9, 0.3, generator.choice([0, 0.1, -0.7]))


class Run:
    """What a run has written, as lists of fields; and its options."""

    def __init__(self, kind, generator, folder):
        self.points, self.box = make_points(kind, generator)
        self.start, self.until = generator.choice([0, 0, 0.5, -1]), 2
        self.folder = folder
        self.write_points()
        subprocess.run([KINETRI, "simulate", "points.csv", "--until", str(self.until), f"--from={self.start}",
                        "--quiet", *self.box_options(), "--events", "events.csv", "--motions", "motions.csv",
                        "--initial-edges", "initial.csv", "--edges", "final.csv", "--audit", "end"],
                       check=True, cwd=folder)
        self.header, *self.rows = self.read("events.csv")
        _, *self.initial = self.read("initial.csv")
        _, *self.final = self.read("final.csv")

    def box_options(self):
        return [f"--periodic={','.join(map(repr, self.box[:3]))}", f"--shear={self.box[3]!r}"]

    def read(self, name):
        with open(self.folder / name, encoding="utf-8", newline="") as file:
            return list(csv.reader(file))

    def write(self, name, rows):
        (self.folder / name).write_text("".join(",".join(map(str, row)) + "\n" for row in rows), encoding="utf-8")

    def write_points(self):
        self.write("points.csv", [("x", "y", "vx", "vy"), *(map(repr, point) for point in self.points)])

    def verify(self, points="points.csv", edges=("initial", "final"), more=()):
        """The exit code, and what the verifier says."""
        self.write_points()
        self.write("events.csv", [self.header, *self.rows])
        self.write("initial.csv", [("a", "b", "offset"), *self.initial])
        self.write("final.csv", [("a", "b", "offset"), *self.final])
        files = {"initial": ["--initial-edges", "initial.csv"], "final": ["--edges", "final.csv"]}
        options = [word for name in edges for word in files[name]]
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


def check_true():
    counts = collections.Counter()
    for kind in KINDS:
        for seed, run in runs(kind, 16, FOLDER / kind):
            for options in ({}, {"edges": ["initial"]}, {"edges": ["final"]}, {"points": "motions.csv"},
                            {"more": ["--motions", "motions.csv"]}):
                code, says = run.verify(**options)
                if code != 0:
                    sys.exit(f"{kind} {seed} {options}: {code}: {says}")
            counts[kind] += len(run.rows)
            counts["rebuild"] += sum(row[1] == "rebuild" for row in run.rows)
            counts["roots"] += sum(row[3] != row[4] for row in run.rows)
            counts["together"] += sum(row[0] != row[-3] for row in run.rows)
    print(dict(counts))
    least = {"grid": 1000, "few": 600, "crystal": 100, "one": 15, "random": 1500, "rebuild": 800, "roots": 2500,
             "together": 800}
    short = {name: counts[name] for name, number in least.items() if counts[name] < number}
    if short:
        sys.exit(f"too few rows: {short}")


# ---- lies ----

def lie(function):
    """A function that changes a run, and returns whether it has."""
    LIES[function.__name__] = function
    return function


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
    i = chosen(run, generator)
    if i is None:
        return False
    del run.rows[i]
    for row in run.rows[i:]:
        row[0] = str(int(row[0]) - 1)
        row[-3] = str(int(row[-3]) - 1) if int(row[-3]) > i else row[-3]
    return True


@lie
def a_row_doubled(run, generator):
    i = chosen(run, generator, is_alone)
    if i is None:
        return False
    run.rows.insert(i, list(run.rows[i]))
    run.number_anew()
    return True


@lie
def the_last_rows_left_out(run, generator):
    if not run.rows:
        return False
    del run.rows[generator.randrange(len(run.rows)):]
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
    run.box = (*run.box[:3], run.box[3] + generator.choice([-1, 1]) / 1024)
    return any(row[3] != row[4] for row in run.rows) and any(
        int(offset.split(" ")[1]) != 0 for row in run.rows for offset in row[-2:] if offset)


@lie
def a_run_that_ends_sooner(run, generator):
    """Than its last row."""
    if not run.rows or float(run.rows[-1][2]) <= run.start + 0.125:
        return False
    run.until = float(run.rows[-1][2]) - 0.0625
    return True


@lie
def a_run_that_begins_later(run, generator):
    if not run.rows or float(run.rows[0][4]) >= run.until:
        return False
    run.start = float(run.rows[0][4])
    return True


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


def check_lies():
    check_double_cover()
    told, refuted = collections.Counter(), collections.Counter()
    for kind in KINDS:
        for seed, run in runs(kind, 8, FOLDER / kind):
            for name, change in LIES.items():
                changed = copy.deepcopy(run)
                if not change(changed, random.Random(f"{kind} {seed} {name}")):
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
