#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies event logs of the program, true ones and ones in which something was changed.

usage: verify_test.py true|lies|second|input KINETRI VERIFY FOLDER

`lies` prints a table: kinds of lies, how many were told, how many refuted, and how many at the right
row or instant. `second` compares both checkers, on small logs and on lies about them.
"""
import collections
import copy
import math
import os
import pathlib
import pickle
import random
import re
import subprocess
import sys
from fractions import Fraction

import degenerate_runs
import false_logs
import lies
import second_checker

KINDS = ("grid", "line", "meet", "mirror", "random")
TIMES = int(os.environ.get("KINETRI_TEST_MULTIPLIER", "1"))
HEADER = "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b"
COLUMNS = HEADER.split(",")
INSTANT = ",instant"  # the last column of the log, which may be absent
MOTIONS = "event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch"


class Run:
    """What a run has written. Motions have the numbers of their events, or no text at the start."""

    def __init__(self, points, rows, motions, initial, final, start, until):
        self.points, self.rows, self.motions = points, rows, motions
        self.initial, self.final, self.start, self.until = initial, final, start, until

    def drop_motions(self, number):
        self.motions = [m for m in self.motions if not m[0] or int(m[0]) != number]
        for motion in self.motions:
            if motion[0] and int(motion[0]) > number:
                motion[0] = str(int(motion[0]) - 1)

    def insert(self, number, row):
        self.rows.insert(number, row)
        copies = [list(m) for m in self.motions if m[0] and int(m[0]) == number - 1]
        for motion in self.motions:
            if motion[0] and int(motion[0]) >= number:
                motion[0] = str(int(motion[0]) + 1)
        for motion in copies:
            motion[0] = str(number)
        self.motions = sorted(self.motions + copies, key=lambda m: int(m[0] or -1))


def make_points(kind, generator, number=None):
    """Points of one kind of degeneracy, in random order."""
    points = set()
    number = number or generator.randint(1, 14)
    while len(points) < number:
        if kind == "grid":
            point = [generator.randint(-2, 2) for _ in range(2)]
            point += [generator.randint(-1, 1) for _ in range(2)]
        elif kind == "line":
            x, v = generator.randint(-9, 9), generator.randint(-3, 3)
            point = [x, 2 * x, v, 2 * v]
        elif kind == "meet":  # most of them at time 2
            v = [generator.randint(-3, 3) for _ in range(2)]
            point = [-2 * v[0] + generator.choice([0, 0, 0, 1]), -2 * v[1], *v]
        elif kind == "mirror":  # on a line at time 2
            v = generator.randint(-3, 3)
            point = [generator.randint(-3, 3), -2 * v, 0, v]
        else:
            point = [generator.uniform(-3, 3) for _ in range(4)]
        points.add(tuple(point))
    points = sorted(points)
    generator.shuffle(points)
    return points


def with_copies(points, generator):
    """The points and some of them again, as points that coincide at all times; in random order."""
    points = points + [generator.choice(points) for _ in range(generator.randint(1, 4))]
    generator.shuffle(points)
    return points


class Case:
    """The files of a run in a folder, and the programs."""

    def __init__(self, kinetri, verify, folder):
        self.kinetri, self.verify_program = kinetri, verify
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        names = ("points", "events", "initial", "final", "motions")
        self.points, self.events, self.initial, self.final, self.motions = (
            str(self.folder / f"{name}.csv") for name in names
        )

    def outputs(self, command):
        """Runs the program. None if it refuses the points."""
        command = [self.kinetri, *command, "--quiet", "--events", self.events]
        command += ["--initial-edges", self.initial, "--edges", self.final, "--motions", self.motions]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        assert result.returncode in (0, 2), f"{command}: {result.stderr}"
        if result.returncode != 0:
            return None
        return [
            [line.split(",") for line in pathlib.Path(file).read_text("utf-8").splitlines()[1:]]
            for file in (self.events, self.motions, self.initial, self.final)
        ]

    def simulate(self, points, until, start=0, options=()):
        header = "x,y,vx,vy" + {4: "", 6: ",radius,growth", 8: ",ax,ay,jx,jy"}[len(points[0])]
        text = header + "\n" + "".join(",".join(map(repr, p)) + "\n" for p in points)
        pathlib.Path(self.points).write_text(text, encoding="utf-8")
        command = ["simulate", self.points, "--until", str(until), "--from", str(start), *options]
        outputs = self.outputs(command)
        return outputs and Run(points, *outputs, start, until)

    def write(self, run):
        """The files of the run, whose rows are numbered anew, and so are its instants: rows in order
        that have the same text in the last column are of one."""
        log, first, has_instants = [], 0, any(len(row) > len(COLUMNS) for row in run.rows)
        for number, row in enumerate(run.rows):
            row[0] = str(number)
            if number == 0 or row[11:] != run.rows[number - 1][11:]:
                first = number
            log.append(row[:11] + [str(first)] * has_instants)
        for file, header, rows in (
            (self.events, HEADER + INSTANT * has_instants, log),
            (self.motions, MOTIONS, run.motions),
            (self.initial, "a,b", run.initial),
            (self.final, "a,b", run.final),
        ):
            text = "".join(",".join(row) + "\n" for row in rows)
            pathlib.Path(file).write_text(f"{header}\n{text}", encoding="utf-8")

    def verify(self, run, options=(), points=None):
        """Exit code, text, and the row at fault."""
        self.write(run)
        motions = [] if points else ["--motions", self.motions]
        if not any("edges" in option for option in options):
            options = (*options, "--initial-edges", self.initial, "--edges", self.final)
        times = ["--until", repr(run.until), "--from", repr(run.start)]
        return self.answer(points or self.points, *motions, *times, *options)

    def answer(self, points, *options):
        command = [self.verify_program, points, self.events, *options]
        result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
        text = result.stdout + result.stderr
        where = text.split(":")[1].strip() if text.startswith("refuted") else ""
        row = int(where[4:]) if where.startswith("row ") else {"the start": -1}.get(where)
        return result.returncode, text, row


# ---- true logs ----


def scenarios(kind, generator):
    """Points, options of the program and those that the checker needs too, and the end."""
    points = make_points(kind, generator)
    yield points, [], [], 5
    box = ["--box=-40,-40,40,40"] if kind == "line" else ["--box=-9,-9,9,9"]
    yield points, [], box, 20
    radius = ["--radius", "0.4" if kind == "random" else "0.25"]
    for response in ("swap", "elastic", "stop", "remove", "log"):
        yield points, radius, ["--collisions", response], 6
        yield points, radius, [*box, "--rim", "--collisions", response], 6
    if kind != "random":  # elsewhere, discs overlap at the start
        weights = [p + (generator.choice((0, 0.25, 0.5)), 0.0625) for p in points]
        yield weights, [], [*box, "--collisions", generator.choice(("swap", "elastic", "log"))], 4
    if kind != "line":
        weights = [p + (generator.choice((0, 1, 2)), generator.choice((0, 0, 1, 0.5))) for p in points]
        yield weights, ["--regular"], [], 5
    if kind == "random":
        growing = [p + (0.02 * i / 16, 0.02) for i, p in enumerate(points)]
        yield growing, [], [*box, "--rim", "--collisions", "elastic"], 5
    turns = [generator.randint(-1, 1) for _ in range(2)] if kind != "line" else [1, 2]
    falling = [p + (turns[0], turns[1], 0, 0) for p in points[:7]]
    yield falling, [], [], 3
    if kind == "random":
        falling = [p + tuple(generator.uniform(-1, 1) for _ in range(4)) for p in points[:7]]
        yield falling, ["--radius", "0.2"], [*box, "--collisions", "elastic"], 3
    copies = with_copies(points, generator)
    yield copies, [], [], 5
    yield copies, [], box, 8
    for response in ("swap", "elastic", "stop", "remove", "log"):
        yield copies, radius, [*box, "--collisions", response], 4
    yield with_copies(falling, generator), [], [], 3
    if kind != "line":
        weights = [p + (generator.choice((0, 1, 2)), generator.choice((0, 0, 1, 0.5))) for p in points]
        yield with_copies(weights, generator), ["--regular"], [], 5
        yield with_copies(weights, generator), ["--regular"], box, 5


def check_true(case, seeds):
    counts = collections.Counter()
    for kind in KINDS:
        for seed in range(seeds):
            generator = random.Random(f"{kind} {seed}")
            for number, (points, options, both, until) in enumerate(scenarios(kind, generator)):
                run = case.simulate(points, until, 0, [*options, *both])
                if run is None:
                    continue
                # In turn. Without options, walls and contacts are found from their rows.
                more = (both, [*both, "--edges", case.final, "--threads", "2"], [])[(seed + number) % 3]
                code, text, _ = case.verify(run, more)
                if code == 2 and "on one line" in text:
                    continue
                what = f"{kind} {seed} {options} {both} {more}"
                assert code == 0, f"{what}: {text}"
                expected = f"verified: {len(points)} points, {len(run.rows)} events, "
                assert text.startswith(expected), text
                counts[kind] += 1
                if kind == "random" and len(set(points)) == len(points):  # no two exact times are that near
                    for row in run.rows:
                        del row[len(COLUMNS):]
                    code, text, _ = case.verify(run, both)
                    assert code == 0, f"{kind} {seed} {options} {both} without instants: {text}"
    for kind in KINDS:
        assert counts[kind] > 2 * seeds, counts
    for seed in range(seeds):
        run = tracks(case, random.Random(seed))
        code, text, _ = case.verify(run, points=case.motions)
        assert code == 0, f"tracks {seed}: {text}"


# Several points leave the hull at one time, t = 2.
LEAVING = [(0, 0, -1, -1), (0, 0, -1, 0), (2, 0, -1, 0), (2, 2, 0, 0), (-2, 1, 0, -1)]

# Discs that pass through each other, with rims that touch the box. 7 is hidden at t = 58/17, up to rounding, enters
# another triangle, and is revealed there, all within 2^-51.
PASSING = [(6, 3, 2, -2, 0, 0), (3, 6, -2, -2, 0.25, 0), (6, 6, 1, 0, 0.5, 0.125), (0, 3, 2, 2, 0, 0.0625),
           (0, 0, 1, -2, 0.25, 0.0625), (0, 6, 2, -1, 0.5, 0.125), (3, 3, 0, -2, 0.25, 0.125), (3, 0, 0, -2, 0.25, 0.125)]

# Discs with several events at one time. A hidden point has left the hull before a corner that is in line with
# it does, t = 5.
HIDING = [(3, -2, 2, 1, 0, 0), (-3, -2, 2, 1, 0, 0.5), (0, 3, 1, 0, 2, 1), (0, -2, 2, 1, 0, 0.5), (2, 0, 2, 1, 2, 1)]
# Discs 0, 5 and 6 are in line at t = 0.5, where their triangle turns over and keeps its edges; and the same in reverse.
TURNING = [(2, 0, 2, 2, 1, 0), (2, -2, -2, 2, 0, 0), (1, -1, 1, 0, 1, 0), (0, 3, -1, -2, 2, 0), (0, 0, 2, -2, 0, 0),
           (3, 2, 0, -1, 0.5, 0), (3, 2, 0, 2, 1, 0)]
TURNING_BACK = [(x + vx, y + vy, -vx, -vy, radius, growth) for x, y, vx, vy, radius, growth in TURNING]

# Equal discs that grow. The centers are on one circle at t = 1, and the same edge is right before and after.
TOUCHING = [(x, y, 0, vy, 0.125, 0.125) for x, y, vy in ((-1, 0, 0), (0, 1, 0), (0, -1, 0), (1, -1, 1))]


def check_instants(case):
    """Several events of one exact time: discs of a wave meet, at times that are no binary64 numbers."""
    run = case.simulate(LEAVING, 4)
    kinds = [row[1] for row in run.rows if row[2] == "2"]
    assert kinds.count("hull_remove") == 2, run.rows
    code, text, _ = case.verify(run)
    assert code == 0, text
    for discs, time in ((HIDING, "5"), (TURNING, "0.5"), (TURNING_BACK, "0.5")):
        run = case.simulate(discs, 5, 0, ["--regular"])
        assert len([row for row in run.rows if row[2] == time]) > 2, run.rows
        code, text, _ = case.verify(run)
        assert code == 0, f"{discs}: {text}"
    run = case.simulate(TOUCHING, 2, 0, ["--regular"])
    assert not run.rows, run.rows
    code, text, _ = case.verify(run)
    assert code == 0, text
    options = ["--collisions", "log", "--box=-6,-6,15,15", "--rim"]
    run = case.simulate(PASSING, 4, 0, options)
    assert [row[1] for row in run.rows if row[2] > "3.4117" and row[2] < "3.4118"].count("reveal") == 1, run.rows
    code, text, _ = case.verify(run, options)
    assert code == 0, text
    for columns, rows in ((3, 4), (5, 5), (8, 3), (20, 20)):
        for radius in ("0.3", "0.5", "0.7", "1", "2", "4") if columns < 20 else ("0.5", "2"):
            command = [case.kinetri, "wave", "--columns", str(columns), "--rows", str(rows), "--radius", radius]
            result = subprocess.run([*command, "--quiet", "--verify"], capture_output=True, text=True, check=False)
            assert result.returncode == 0, f"{command}: {result.stdout}{result.stderr}"
            assert result.stdout.startswith(f"verified: {columns * rows} points, "), result.stdout


# In the ring of Gaussian integers, of norm p: all points of the circle of the radius 5 13 17 29 37 are products of
# squares of these and of their conjugates.
FACTORS = {5: 2 + 1j, 13: 3 + 2j, 17: 4 + 1j, 29: 5 + 2j, 37: 6 + 1j}


def check_circle(case):
    """972 points that are always on one circle come to one place and part again, and have the edges after it that
    they had before; and 324 of them within a ring that rests, where more than 600 rows have one exact time that is
    no binary64 number, t = 1/3."""
    places = {1 + 0j}
    for p, z in FACTORS.items():
        places = {place * factor for place in places for factor in (p, z * z, (z * z).conjugate())}
    circle = sorted((int(turned.real), int(turned.imag)) for place in places
                    for turned in (place, place * 1j, -place, place * -1j))
    radius = math.prod(FACTORS)
    assert len(set(circle)) == 972 and all(x * x + y * y == radius**2 for x, y in circle)
    collapsing = [(x, y, -3 * x, -3 * y) for x, y in circle]
    ring = [(2 * x, 2 * y, 0, 0) for x, y in circle[::97]] + [(radius // 3, radius // 5, 0, 0)]
    for points, fewest in ((collapsing, 0), (collapsing[::3] + ring, 600)):
        run = case.simulate(points, 2)
        assert len([row for row in run.rows if row[2] == "0.3333333333333333"]) >= fewest
        code, text, _ = case.verify(run)
        assert code == 0, text


def check_resumed(case):
    """Discs that pass through each other when the first part of a run ends, and then turn back before they have
    separated: without a contact. Some of them coincide with others."""
    for seed in (30, 45, 99, 106, 171, 194):
        generator = random.Random(seed)
        header, *rows = degenerate_runs.lattice(generator).splitlines()
        until = generator.randint(4, 12)
        for copies in ([], rows[:2]):
            pathlib.Path(case.points).write_text("\n".join([header, *rows, *copies]) + "\n", encoding="utf-8")
            checkpoint = str(case.folder / "checkpoint")
            first = ["simulate", case.points, "--until", str(until / 2), "--radius", "1.4", "--collisions", "log",
                     "--box=-4,-4,13,13", "--checkpoint", checkpoint]
            for command in (first, ["resume", checkpoint, "--until", str(until), "--verify"]):
                result = subprocess.run([case.kinetri, *command, "--quiet"], capture_output=True, text=True, check=False)
                assert result.returncode == 0, f"{seed}: {command}: {result.stdout}{result.stderr}"


def tracks(case, generator):
    """People who come and go, on a grid that makes for degenerate times."""
    rows = ["t,id,x,y"]
    for thing in range(generator.randint(3, 9)):
        first, x, y = generator.randint(0, 5), generator.randint(0, 9), generator.randint(0, 9)
        for step in range(generator.randint(2, 6)):
            rows.append(f"{(first + step) / 4},{thing},{x / 2},{y / 2}")
            x, y = x + generator.randint(-1, 1), y + generator.randint(-1, 1)
    file = case.folder / "tracks.csv"
    file.write_text("\n".join(rows) + "\n", encoding="utf-8")
    times = [float(row.split(",")[0]) for row in rows[1:]]
    return Run([None] * 9, *case.outputs(["tracks", str(file)]), min(times), max(times))


# ---- lies ----


def is_right(run, row, expected, true_run):
    """Whether the row is the expected one, or of the time of that one, before or after the lie."""
    row = len(run.rows) if row is None else row
    if row == expected:
        return True
    times = [r.rows[expected][3:5] for r in (run, true_run) if 0 <= expected < len(r.rows)]
    if row == -1:
        return any(float(low) <= run.start for low, _ in times)
    return 0 <= row < len(run.rows) and run.rows[row][3:5] in times


def tell(case, table, counts, run, generator, options=(), points=None):
    true_run = pickle.dumps(run)  # many times faster to copy than by deepcopy
    for name, lie in table.items():
        false_run = pickle.loads(true_run)
        expected = lie(false_run, generator)
        if expected is None:
            continue
        code, text, row = case.verify(false_run, options, points)
        counts[name]["told"] += 1
        counts[name]["refuted"] += code == 1
        counts[name]["right"] += code == 1 and is_right(false_run, row, expected, run)
        if code != 1 or not is_right(false_run, row, expected, run):
            counts[name]["wrong"].append(f"{case.folder} expected {expected}: {text[:200]}")


def new_counts():
    """Of each kind of lie."""
    return collections.defaultdict(lambda: {"told": 0, "refuted": 0, "right": 0, "wrong": []})


def report(counts):
    print(f"{'lie':40} {'told':>5} {'refuted':>8} {'right row':>10}")
    for name, count in sorted(counts.items()):
        print(f"{name:40} {count['told']:5} {count['refuted']:8} {count['right']:10}")
    print(f"{len(counts)} kinds")
    failed = {name: c["wrong"][:2] for name, c in counts.items() if c["right"] < c["told"]}
    assert not failed, failed


def check_lies(case, seeds):
    counts = new_counts()
    for kind in KINDS:
        for seed in range(seeds):
            generator = random.Random(f"{kind} {seed}")
            run = case.simulate(make_points(kind, generator), 5)
            tell(case, lies.PLAIN, counts, run, generator)
    box = ["--box=-9,-9,9,9", "--collisions", "elastic"]
    for seed in range(2 * seeds):
        generator = random.Random(f"box {seed}")
        run = case.simulate(make_points("random", generator, 12), 10, 0, ["--radius", "0.2", *box])
        if run:
            tell(case, lies.BOX, counts, run, generator, box)
        rim = [*box, "--rim"]
        points = [p + (0, 0.02 * (i % 3)) for i, p in enumerate(make_points("random", generator, 9))]
        run = case.simulate(points, 5, 0, rim)
        tell(case, lies.RIM, counts, run, generator, rim)
        run = case.simulate(make_points("random", generator, 12), 6, 0, ["--radius", "0.3", "--collisions", "log"])
        if run:
            tell(case, lies.LOG, counts, run, generator, ["--collisions", "log"])
        points = [p + (generator.choice((0, 1, 2)), 0.5) for p in make_points("random", generator, 12)]
        run = case.simulate(points, 5, 0, ["--regular"])
        tell(case, lies.WEIGHTS, counts, run, generator)
        tell(case, lies.NONE, counts, run, generator, ["--collisions", "none"])
        run = tracks(case, generator)
        tell(case, lies.TRACKS, counts, run, generator, points=case.motions)
    report(counts)
    assert len(counts) >= 40 and all(c["told"] >= 2 for c in counts.values()), counts


def check_false_logs(case):
    for log in false_logs.LOGS:
        run = Run(None, copy.deepcopy(log.rows), log.motions, log.edges, [], 0, log.until)
        options = ("--initial-edges", case.initial, *log.options)
        code, text, _ = case.verify(run, options, case.motions)
        expected = f"refuted: {log.where}: " if log.where else "verified: "
        assert code == (1 if log.where else 0) and text.startswith(expected), f"{log.name}: {code} {text}"


# ---- two checkers ----


def second_answer(run):
    def edge(a, b):
        return (int(a), int(b)) if a else None

    rows = [
        (row[1], Fraction(float(row[3])), Fraction(float(row[4])), edge(*row[5:7]), edge(*row[7:9]))
        for row in run.rows
    ]
    edges = [[tuple(map(int, e)) for e in edges] for edges in (run.initial, run.final)]
    return second_checker.check(run.points, rows, *edges, run.start, run.until)


def check_second(case, seeds):
    told = 0
    for kind in KINDS:
        for seed in range(seeds):
            generator = random.Random(f"second {kind} {seed}")
            points = make_points(kind, generator, generator.randint(3, 5))
            run = case.simulate(with_copies(points, generator) if seed % 2 else points, 5)
            assert second_answer(run) is None and case.verify(run)[0] == 0, f"{kind} {seed}"
            for name in ("a_row_left_out", "neighbors_swapped", "another_initial_edge", "cut_off"):
                false_run = copy.deepcopy(run)
                if lies.PLAIN[name](false_run, generator) is None:
                    continue
                told += 1
                code, text, row = case.verify(false_run)
                second = second_answer(false_run)
                assert code == 1 and second is not None, f"{kind} {seed} {name}: {text} {second}"
                assert is_right(false_run, row, second, run), f"{kind} {seed} {name}: {text} {second}"
    print(f"both checkers agree on {told} lies")


def check_input(case):
    good = HEADER + "\n"
    square = "x,y,vx,vy\n0,0,0,0\n3,0,0,0\n0,1,0,0\n"
    edges = "a,b\n0,1\n0,2\n1,2\n"
    cases = (
        ("points", "x,y,vx\n0,0,0\n", "points.csv:2: the column vy is missing"),
        ("points", "", "points.csv:0: the file is empty"),
        ("points", square + "1,2\n", "points.csv:5: the row has 2 fields"),
        ("points", square + "1,2,inf,0\n", "points.csv:5: the column vx is 'inf'"),
        ("points", square + "1 2,2,0,0\n", "points.csv:5: the column x is '1 2'"),
        ("events", "event\n", "events.csv:1: the header is not"),
        ("events", good + "0,jump,1,1,1,,,,,0,\n", "events.csv:2: the kind 'jump'"),
        ("events", good + "0,flip,1,1,x,0,1,2,3,,\n", "events.csv:2: the column time_hi is 'x'"),
        ("initial", "a,b\n0,1\n0,1\n", "initial.csv:3: expected edges that differ"),
        ("motions", MOTIONS + "\n7,0" + ",0" * 11 + "\n", "motions.csv:2: the event is not"),
    )
    motions = MOTIONS + "".join(
        f"\n,{i},{x},{y},0,0,0,0,0,0,0,0,0" for i, (x, y) in enumerate(((0, 0), (3, 0), (0, 1)))
    )
    texts = {"points": square, "events": good, "initial": edges, "final": edges}
    texts["motions"] = motions + "\n"
    for changed, text, message in (("", "", ""), *cases):
        for name, content in {**texts, changed: text}.items():
            if name:
                (case.folder / f"{name}.csv").write_text(content, encoding="utf-8")
        files = ("--initial-edges", case.initial, "--motions", case.motions)
        code, answer, _ = case.answer(case.points, "--until", "1", *files)
        assert code == (2 if changed else 0), f"{text!r}: exit code {code}: {answer}"
        assert message in answer, f"{answer!r} is not about {message!r}"
    for row in ("wall,1,1,1,,,,,0,", "collision,1,1,1,,,,,0,1", "trajectory,1,1,1,,,,,0,"):
        pathlib.Path(case.events).write_text(f"{good}0,{row}\n", encoding="utf-8")
        code, answer, _ = case.answer(case.points, "--until", "1", "--edges", case.final)
        assert code == 2 and "expected --motions" in answer, answer
    good_options = ("--until", "1", "--edges", case.final)
    for options in ((), ("--until",), ("--until", "1", "--edge", "f"),
                    (*good_options, "--rim=no"), (*good_options, "--threads", "1.5"),
                    (*good_options, "--box", "5,0,1,9")):
        code, answer, _ = case.answer(case.points, *options)
        assert code == 2 and "--help" in answer, answer
    for text in ("", "x", "1x", "1 0", "nan", "inf", "-inf", "1e999", "1,", "1,2"):
        for name, options in (("--until", ("--edges", case.final)), ("--from", good_options),
                              ("--threads", good_options), ("--box", good_options)):
            code, answer, _ = case.answer(case.points, *options, name, text)
            assert code == 2 and f"{name} is '{text}'; expected " in answer, answer


def check_page(case):
    """The manual page has the options of --help, and no others."""
    usage = case.answer("--help")[1]
    page = (pathlib.Path(__file__).parents[2] / "apps/verify/kinetri-verify.1").read_text("utf-8")
    described = re.findall(r"^\.BI? (\\-\\-\S+)", page, re.MULTILINE)
    options = set(re.findall(r"--[a-z]+(?:-[a-z]+)*", usage[: usage.index("Decides")])) | {"--help"}
    assert {option.replace("\\", "") for option in described} == options, (described, options)


def main():
    what, kinetri, verify, folder = sys.argv[1:]
    case = Case(kinetri, verify, folder)
    if what == "true":
        check_true(case, 2 * TIMES)
        check_instants(case)
        check_circle(case)
        check_resumed(case)
    elif what == "lies":
        check_lies(case, 2 * TIMES)
        check_false_logs(case)
    elif what == "second":
        check_second(case, 4)
    else:
        check_input(case)
        check_page(case)


if __name__ == "__main__":
    main()
