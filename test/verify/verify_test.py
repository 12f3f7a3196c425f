#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies event logs of the program, true ones and ones in which something was changed.

usage: verify_test.py true|lies|input KINETRI VERIFY FOLDER

A changed log may only be verified if it says the same: if its rows, with the instants in which they
are, have the same edges. None of the changes below leaves that.
"""
import collections
import pathlib
import random
import subprocess
import sys

Run = collections.namedtuple("Run", "points rows initial final until")
KINDS = ("grid", "line", "meet", "random")
HEADER = "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b"
REMOVED, ADDED = slice(5, 7), slice(7, 9)


def make_points(kind, generator):
    """Points of one kind of degeneracy, in random order."""
    points = set()
    number = generator.randint(1, 14)
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
        else:
            point = [generator.uniform(-3, 3) for _ in range(4)]
        points.add(tuple(point))
    points = sorted(points)
    generator.shuffle(points)
    return points


class Case:
    """The files of a run in a folder, and the programs."""

    def __init__(self, kinetri, verify, folder):
        self.kinetri, self.verify_program = kinetri, verify
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.points, self.events, self.initial, self.final = (
            str(self.folder / f"{name}.csv") for name in ("points", "events", "initial", "final")
        )

    def simulate(self, points, until, start=0):
        text = "x,y,vx,vy\n" + "".join(",".join(map(repr, p)) + "\n" for p in points)
        pathlib.Path(self.points).write_text(text, encoding="utf-8")
        command = [self.kinetri, "simulate", self.points, "--until", str(until), "--quiet"]
        command += ["--from", str(start), "--events", self.events]
        command += ["--initial-edges", self.initial, "--edges", self.final]
        subprocess.run(command, check=True)
        rows, initial, final = (
            [line.split(",") for line in pathlib.Path(file).read_text("utf-8").splitlines()[1:]]
            for file in (self.events, self.initial, self.final)
        )
        return Run(points, rows, initial, final, until)

    def verify(self, run, options=(), start=0):
        """Exit code and output for the run, whose rows are numbered anew."""
        for number, row in enumerate(run.rows):
            row[0] = str(number)
        for file, header, rows in (
            (self.events, HEADER, run.rows),
            (self.initial, "a,b", run.initial),
            (self.final, "a,b", run.final),
        ):
            text = "".join(",".join(row) + "\n" for row in rows)
            pathlib.Path(file).write_text(f"{header}\n{text}", encoding="utf-8")
        return self.answer("--until", str(run.until), "--from", str(start), *options)

    def answer(self, *options):
        if not any("edges" in option for option in options):
            options = (*options, "--initial-edges", self.initial, "--edges", self.final)
        command = [self.verify_program, self.points, self.events, *options]
        result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
        return result.returncode, result.stdout + result.stderr


def copy_of(run):
    return Run(run.points, *([list(row) for row in rows] for rows in run[1:4]), run.until)


# ---- lies: each changes the run, or returns False if there is nothing to change ----


def is_later(row, other):
    return float(row[3]) > float(other[4])


def leave_out(run, generator):
    if not run.rows:
        return False
    del run.rows[generator.randrange(len(run.rows))]
    return True


def double(run, generator):
    if not run.rows:
        return False
    i = generator.randrange(len(run.rows))
    run.rows.insert(i, list(run.rows[i]))
    return True


def swap(run, generator):
    pairs = [i for i in range(1, len(run.rows)) if is_later(run.rows[i], run.rows[i - 1])]
    if not pairs:
        return False
    i = generator.choice(pairs)
    run.rows[i - 1], run.rows[i] = run.rows[i], run.rows[i - 1]
    return True


def swap_edges(run, generator):
    """The edges of two rows, with the times as they were."""
    pairs = [i for i in range(1, len(run.rows)) if is_later(run.rows[i], run.rows[i - 1])]
    if not pairs:
        return False
    i = generator.choice(pairs)
    a, b = run.rows[i - 1], run.rows[i]
    a[1], b[1], a[5:9], b[5:9] = b[1], a[1], b[5:9], a[5:9]
    return True


def other_edge(run, generator):
    ends = [(row, i) for row in run.rows for i in range(5, 9) if row[i]]
    if not ends or len(run.points) < 3:
        return False
    row, i = generator.choice(ends)
    row[i] = generator.choice([str(v) for v in range(len(run.points)) if str(v) != row[i]])
    return True


def exchange_ends(run, generator):
    if not run.rows:
        return False
    row = generator.choice(run.rows)
    part = REMOVED if row[5] else ADDED
    row[part] = row[part][::-1]
    return True


def backward(run, generator):
    """What a row removes is what it adds."""
    if not run.rows:
        return False
    row = generator.choice(run.rows)
    row[5:9] = row[7:9] + row[5:7]
    return True


def other_time(run, generator):
    if not run.rows:
        return False
    row = generator.choice(run.rows)
    shift = generator.choice([-1, 1]) * 2.0 ** -generator.randint(1, 40)
    row[2:5] = [repr(float(time) + shift) for time in row[2:5]]
    return True


def wide_interval(run, generator):
    if not run.rows:
        return False
    row = generator.choice(run.rows)
    row[4] = repr(float(row[4]) + 1e-9 * max(1, abs(float(row[4]))))
    return True


def cut_off(run, generator):
    if not run.rows:
        return False
    del run.rows[generator.randrange(len(run.rows)) :]
    return True


def more(run, generator):
    """An edge is flipped, and back again, where nothing happens."""
    if not run.initial or len(run.points) < 4:
        return False
    edge = generator.choice(run.initial)
    a, b = generator.sample(range(len(run.points)), 2)
    added = sorted([a, b])
    time = [repr(generator.uniform(0, run.until))] * 3
    row = ["0", "flip", *time, *edge, *map(str, added), "", ""]
    at = sum(float(other[3]) <= float(time[0]) for other in run.rows)
    run.rows.insert(at, row)
    return True


def initial_lacks(run, generator):
    if not run.initial:
        return False
    del run.initial[generator.randrange(len(run.initial))]
    return True


def other_edge_of(edges, run, generator):
    """One edge of the file is replaced by one that is not there."""
    n = len(run.points)
    there = {tuple(map(int, edge)) for edge in edges}
    absent = [(a, b) for b in range(n) for a in range(b) if (a, b) not in there]
    if not absent or not edges:
        return False
    del edges[generator.randrange(len(edges))]
    edges.append([str(v) for v in generator.choice(absent)])
    edges.sort(key=lambda edge: tuple(map(int, edge)))
    return True


def initial_other(run, generator):
    return other_edge_of(run.initial, run, generator)


def final_lacks(run, generator):
    if not run.final:
        return False
    del run.final[generator.randrange(len(run.final))]
    return True


def final_other(run, generator):
    return other_edge_of(run.final, run, generator)


LIES = (leave_out, double, swap, swap_edges, other_edge, exchange_ends, backward, other_time)
LIES += (wide_interval, cut_off, more, initial_lacks, initial_other, final_lacks, final_other)


def check_true(case, seeds):
    for kind in KINDS:
        for seed in range(seeds):
            generator = random.Random(f"{kind} {seed}")
            start = generator.choice([0, 0, -3, 0.5])
            run = case.simulate(make_points(kind, generator), 5, start)
            for options in ((), ("--initial-edges", case.initial), ("--edges", case.final)):
                code, text = case.verify(run, options, start)
                assert code == 0, f"{kind} {seed} {options}: {text}"
                expected = f"verified: {len(run.points)} points, {len(run.rows)} events, "
                assert text.startswith(expected), text


def check_lies(case, seeds):
    told = collections.Counter()
    for kind in KINDS:
        for seed in range(seeds):
            generator = random.Random(f"{kind} {seed}")
            run = case.simulate(make_points(kind, generator), 5)
            for lie in LIES:
                false_run = copy_of(run)
                if not lie(false_run, generator) or false_run == run:
                    continue
                told[lie.__name__] += 1
                # Without the edges at the end, what failed in between has to be found.
                is_at_end = lie in (final_lacks, final_other)
                for options in ((),) if is_at_end else ((), ("--initial-edges", case.initial)):
                    code, text = case.verify(false_run, options)
                    assert code == 1 and text.startswith("refuted: "), (
                        f"{kind} {seed} {lie.__name__} {options}: exit code {code}: {text}"
                    )
    for lie in LIES:
        assert told[lie.__name__] >= seeds, f"{lie.__name__} was told {told[lie.__name__]} times"


def check_input(case):
    good = HEADER + "\n"
    square = "x,y,vx,vy\n0,0,0,0\n3,0,0,0\n0,1,0,0\n"
    edges = "a,b\n0,1\n0,2\n1,2\n"
    cases = (
        ("points", "x,y,vx\n", "points.csv:1: the column vy is missing"),
        ("points", "", "points.csv:1: the file is empty"),
        ("points", square + "1,2\n", "points.csv:5: the row has 2 fields"),
        ("points", square + "1,2,inf,0\n", "points.csv:5: the column vx is 'inf'"),
        ("points", square + "0,1,0,0\n", "points.csv:5: the point moves as the one in line 4"),
        ("points", "x,y,vx,vy,radius\n0,0,0,0,1\n", "points.csv:1: the column radius is not"),
        ("events", "event\n", "events.csv:1: this is not the header"),
        ("events", good + "0,wall,1,1,1,,,,,0,\n", "events.csv:2: the kind 'wall'"),
        ("events", good + "0,flip,1,1,x,0,1,2,3,,\n", "events.csv:2: "),
        ("events", good + "0,rebuild,1,1,1,0,7,,,,\n", "events.csv:2: the column removed_b is '7'"),
        ("initial", "a,b\n0,1\n0,1\n", "initial.csv:3: expected edges that differ"),
    )
    texts = {"points": square, "events": good, "initial": edges, "final": edges}
    for changed, text, message in (("", "", ""), *cases):
        for name, content in {**texts, changed: text}.items():
            if name:
                (case.folder / f"{name}.csv").write_text(content, encoding="utf-8")
        code, answer = case.answer("--until", "1")
        assert code == (2 if changed else 0), f"{text!r}: exit code {code}: {answer}"
        assert message in answer, f"{answer!r} is not about {message!r}"
    for options in ((), ("--until",), ("--until", "x"), ("--until", "1", "--edge", "f")):
        code, answer = case.answer(*options)
        assert code == 2 and "Usage" in answer, answer


def main():
    what, kinetri, verify, folder = sys.argv[1:]
    case = Case(kinetri, verify, folder)
    if what == "true":
        check_true(case, 60)
    elif what == "lies":
        check_lies(case, 12)
    else:
        check_input(case)


if __name__ == "__main__":
    main()
