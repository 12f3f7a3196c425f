#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same input gives the same event log, byte for byte.

usage: event_logs_test.py builds PROGRAM OTHER_PROGRAM WORK_DIR
         of two builds of the program, degenerate input included; OTHER_PROGRAM is a path, or a
         command, as one argument, that runs the program in an emulator
       event_logs_test.py platforms PROGRAM OTHER_PROGRAM WORK_DIR
         the same, with every kind of run, and all input of data/degenerate; motions are compared as
         well, and a line of numbers is printed at the end. Ends with 77, which ctest takes for
         skipped, if the last word of OTHER_PROGRAM, a path, is not there
       event_logs_test.py arithmetic PROGRAM WORK_DIR
         of a run with filters and of one without, degenerate input included
       event_logs_test.py rows PROGRAM WORK_DIR
         of a points file and of the same with its rows in another order, once the points have their
         old numbers back; on input without simultaneous events, whose order is by number

A difference is shown as the lines that differ, under the commands that make the two logs.
KINETRI_TEST_MULTIPLIER is the number of seeds, times two.
"""
import difflib
import os
import pathlib
import random
import shlex
import subprocess
import sys

CORPUS = pathlib.Path(__file__).resolve().parents[2] / "data" / "degenerate"
SEEDS = range(1, 1 + 2 * int(os.environ.get("KINETRI_TEST_MULTIPLIER", "1")))

# Arguments of `kinetri generate`, the end of the simulation, the least number of events (a run in
# which nothing happens would show nothing), and options of `kinetri simulate`, if any.
GENERIC = [
    ("uniform --points 80", 3, 100),
    ("gaussian --points 60", 3, 100),
    ("constant-speed --points 60", 3, 100),
    ("one-mover --points 200 --speed 40", 8, 5),
    ("lattice-jitter --points 64", 3, 100),
    ("uniform --points 60 --side 80", 4, 100, "--box", "0,0,80,80"),
    ("lattice-jitter --points 36 --jitter 0.5", 6, 100, "--box", "-5,-5,55,55", "--collisions",
     "elastic", "--radius", "3"),
]
DEGENERATE = [
    ("lattice --points 49 --movers one", 20, 1),
    ("lattice --points 49 --movers columns", 5, 50),
    ("lattice --points 36 --movers all", 3, 50),
    ("lattice --points 25 --movers none", 3, 0),
    ("lattice --points 25 --movers one", 20, 4, "--box", "0,0,40,40", "--collisions", "swap",
     "--radius", "2"),
    ("lattice --points 16 --movers all", 4, 20, "--box", "-5,-5,35,35", "--collisions", "log",
     "--radius", "1"),
]

# What builds for other platforms are compared with, beside these and data/degenerate: files of points
# by name, the end, the least number of events, and options.
PLATFORMS = [
    ("falling", 3, 100),
    ("falling", 3, 100, "--box", "0,0,12,12", "--collisions", "elastic", "--radius", "0.1"),
    ("discs", 5, 100, "--regular"),
    ("discs", 2, 20, "--box", "0,0,60,60", "--collisions", "elastic"),
    ("discs", 2, 20, "--box", "0,0,60,60", "--collisions", "log"),
    ("discs", 2, 20, "--box", "0,0,60,60", "--collisions", "stop"),
    ("discs", 2, 20, "--box", "0,0,60,60", "--collisions", "remove"),
    ("packing", 9, 100, "--box", "0,0,20,20", "--rim", "--collisions", "elastic"),
    ("uniform", 3, 100, "--exact-only"),
    ("uniform", 3, 100, "--threads", "2"),
]

# The scenarios of bench/, for both arithmetics; exact arithmetic alone is slow.
LARGE = [
    ("uniform --points 1000", 0.5, 300),
    ("gaussian --points 1000", 0.5, 300),
    ("constant-speed --points 1000", 0.5, 300),
    ("one-mover --points 1000 --speed 40", 8, 5),
    ("lattice-jitter --points 1000", 0.5, 300),
]

ID_COLUMNS = ["removed_a", "removed_b", "added_a", "added_b", "point_a", "point_b"]
MOST_LINES = 40


class Difference(Exception):
    pass


def generate(program, scenario, seed, file):
    command = [program, "generate", *scenario.split(), "--seed", str(seed), "--output", str(file)]
    subprocess.run(command, check=True, stdin=subprocess.DEVNULL)


class Run:
    """`kinetri simulate` of a file: what it wrote and how it ended."""

    def __init__(self, program, points, until, prefix, *options):
        files = {
            "--events": prefix.with_suffix(".events.csv"),
            "--initial-edges": prefix.with_suffix(".initial.csv"),
            "--edges": prefix.with_suffix(".edges.csv"),
            "--motions": prefix.with_suffix(".motions.csv"),
        }
        for file in files.values():
            file.unlink(missing_ok=True)
        words = [program] if pathlib.Path(program).exists() else shlex.split(program)
        command = [*words, "simulate", points, "--until", until, "--audit", "end", "--quiet"]
        command += options
        for option, file in files.items():
            command += [option, file]
        command = [str(word) for word in command]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        self.command = shlex.join(command)
        self.code = done.returncode
        self.errors = done.stderr.splitlines()
        self.events, self.initial, self.edges, self.motions = (
            file.read_text().splitlines() if file.exists() else [] for file in files.values()
        )

    def check_done(self, least):
        if self.code != 0:
            raise Difference("\n".join([self.command, f"ended with {self.code}", *self.errors]))
        if len(self.events) - 1 < least:
            raise Difference(f"{self.command}\nonly {len(self.events) - 1} events; expected {least}")


def compare(what, one, one_lines, other, other_lines):
    if one_lines == other_lines:
        return
    lines = list(difflib.unified_diff(one_lines, other_lines, "first", "second", lineterm="", n=1))
    raise Difference(
        "\n".join([f"first:  {one.command}", f"second: {other.command}", f"{what} differ:"])
        + "\n"
        + "\n".join(lines[:MOST_LINES])
    )


def compare_with(program, folder, run_other, settings, seeds):
    """`run_other` is a function of the points file, the end of the simulation, and options."""
    for scenario, until, least, *options in settings:
        for seed in seeds:
            points = folder / "points.csv"
            generate(program, scenario, seed, points)
            one = Run(program, points, until, folder / "one", *options)
            other = run_other(points, until, options)
            one.check_done(least)
            compare_runs(one, other)
            print(f"{scenario}, seed {seed}: {len(one.events) - 1} events, the same")


def compare_runs(one, other):
    compare("ends", one, [str(one.code), *one.errors], other, [str(other.code), *other.errors])
    for what in ("initial", "events", "edges", "motions"):
        compare(what, one, getattr(one, what), other, getattr(other, what))


def compare_builds(program, other_program, folder):
    def run_other(points, until, options):
        return Run(other_program, points, until, folder / "other", *options)

    compare_with(program, folder, run_other, GENERIC + DEGENERATE, SEEDS)


def uniform(random_number, low, high):
    return low + (high - low) * random_number.random()


def write_points(program, folder):
    """The files that PLATFORMS names."""
    draw = random.Random(5)
    rows = [
        ",".join(map(repr, (uniform(draw, 1, 11), uniform(draw, 1, 11), uniform(draw, -2, 2), uniform(draw, -2, 2),
                            0.0, -1.0, uniform(draw, -0.2, 0.2), 0.0)))
        for _ in range(40)
    ]
    (folder / "falling.csv").write_text("x,y,vx,vy,ax,ay,jx,jy\n" + "\n".join(rows) + "\n")
    rows = [
        ",".join(map(repr, (3 + 7.7 * (i % 8) + draw.random(), 3 + 7.7 * (i // 8) + draw.random(),
                            uniform(draw, -5, 5), uniform(draw, -5, 5), uniform(draw, 0.2, 2.2))))
        for i in range(64)
    ]
    (folder / "discs.csv").write_text("x,y,vx,vy,radius\n" + "\n".join(rows) + "\n")
    generate(program, "uniform --points 80", 9, folder / "uniform.csv")
    generate(program, "packing --points 40 --side 20 --share 0.1 --growth 0.02 --speed 1", 9, folder / "packing.csv")


def compare_platforms(program, other_program, folder):
    is_path = pathlib.Path(other_program).exists()
    path = other_program if is_path else shlex.split(other_program)[-1]
    if not pathlib.Path(path).exists():
        print(f"{path} has not been built; scripts/test.sh --live, or scripts/platform.sh PLATFORM, builds it")
        sys.exit(77)
    compare_builds(program, other_program, folder)
    write_points(program, folder)
    runs = [(folder / f"{name}.csv", *rest) for name, *rest in PLATFORMS]
    for points in sorted(CORPUS.glob("*.csv")):
        until = next((line.split()[2] for line in points.read_text().splitlines() if line.startswith("# until:")), "1e3")
        runs += [(points, until, 0), (points, until, 0, "--exact-only")]
    events = 0
    for points, until, least, *options in runs:
        one = Run(program, points, until, folder / "one", *options)
        other = Run(other_program, points, until, folder / "other", *options)
        one.check_done(least)
        compare_runs(one, other)
        events += len(one.events) - 1
        print(f"{points.name} {' '.join(options)}: {len(one.events) - 1} events, the same")
    more = len(SEEDS) * len(GENERIC + DEGENERATE)
    print(f"{len(runs) + more} runs: events, edges, motions, messages and exit codes are the same")


def compare_arithmetic(program, folder):
    def run_other(points, until, options):
        return Run(program, points, until, folder / "other", "--exact-only", *options)

    compare_with(program, folder, run_other, GENERIC + DEGENERATE, SEEDS)
    compare_with(program, folder, run_other, LARGE, SEEDS[:1])


def rename_events(lines, old_ids):
    """The event log with each new point id replaced by the old one, edges in order again."""
    header = lines[0].split(",")
    columns = [header.index(name) for name in ID_COLUMNS]
    renamed = [lines[0]]
    for line in lines[1:]:
        fields = line.split(",")
        for a, b in zip(columns[::2], columns[1::2]):
            ids = sorted(old_ids[int(fields[i])] for i in (a, b) if fields[i])
            fields[a], fields[b] = [*map(str, ids), "", ""][:2]
        renamed.append(",".join(fields))
    return renamed


def rename_edges(lines, old_ids):
    edges = sorted(sorted(old_ids[int(id)] for id in line.split(",")) for line in lines[1:])
    return lines[:1] + [f"{a},{b}" for a, b in edges]


def permute(points, permuted, seed):
    """Writes the rows in another order; returns the old id of each new one."""
    lines = [line for line in points.read_text().splitlines() if line and not line.startswith("#")]
    old_ids = list(range(len(lines) - 1))
    random.Random(seed).shuffle(old_ids)
    permuted.write_text("\n".join([lines[0]] + [lines[1 + id] for id in old_ids]) + "\n")
    return old_ids


def compare_rows(program, folder):
    for scenario, until, least, *options in GENERIC:
        for seed in SEEDS:
            points, permuted = folder / "points.csv", folder / "permuted.csv"
            generate(program, scenario, seed, points)
            old_ids = permute(points, permuted, seed)
            one = Run(program, points, until, folder / "one", *options)
            other = Run(program, permuted, until, folder / "other", *options)
            one.check_done(least)
            other.check_done(least)
            compare("events", one, one.events, other, rename_events(other.events, old_ids))
            compare("initial edges", one, one.initial, other, rename_edges(other.initial, old_ids))
            compare("edges", one, one.edges, other, rename_edges(other.edges, old_ids))
            print(f"{scenario}, seed {seed}: {len(one.events) - 1} events, the same")


def main():
    arguments = sys.argv[1:]
    modes = {"builds": (4, compare_builds), "platforms": (4, compare_platforms),
             "arithmetic": (3, compare_arithmetic), "rows": (3, compare_rows)}
    if not arguments or arguments[0] not in modes or len(arguments) != modes[arguments[0]][0]:
        sys.exit(__doc__)
    folder = pathlib.Path(arguments.pop())
    folder.mkdir(parents=True, exist_ok=True)
    try:
        modes[arguments[0]][1](*arguments[1:], folder)
    except Difference as difference:
        print(difference)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
