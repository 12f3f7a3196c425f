#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the benchmarks several times and prints one table of ratios, each beside its target."""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import typing

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build" / "bench" / "bin" / "kinetri_bench"

# How long each number of points is simulated.
UNTIL = {100: 10, 1_000: 10, 10_000: 3, 100_000: 1, 1_000_000: 0.2}

# How long 1000 discs that cover that share of the plane are simulated: some 50 000 collisions. The
# time is in inverse proportion to their number.
DISCS_UNTIL = {0.1: 250, 0.3: 100, 0.5: 50}

# The same for discs of different sizes that cover 0.3 of the plane, by the greatest radius over the
# least: some 10 000 to 20 000 collisions.
SIZES_UNTIL = {1: 20, 10: 20, 100: 40}

# How long the events of points with weights are measured.
WEIGHTS_UNTIL = {1_000: 3, 10_000: 1}

# Run at most three times, since each run is already a median.
OBSERVED_MODES = ("encounters", "components")

SCENARIOS = ("uniform", "gaussian", "constant-speed", "one-mover", "lattice-jitter")


class Target(typing.NamedTuple):
    """The bound that a figure should keep, an upper or a lower one."""

    sign: str
    bound: float

    def is_met(self, value):
        return value <= self.bound if self.sign == "<=" else value >= self.bound


def at_most(bound):
    """No target if there is no bound."""
    return None if bound is None else Target("<=", bound)


# The targets: upper bounds, except for collisions.
EVENT_OVER_REBUILD_POINT = {1_000: 1.8, 10_000: 1.8, 100_000: 2.2, 1_000_000: 4.0}  # on uniform
EVENT_OVER_BASELINE_EVENT = 0.9
ROOT_SOLVES_PER_EVENT = 1.3  # on uniform
EXACT_SHARE = 1e-4
INITIAL_NANOSECONDS = {100_000: 150}
BYTES_PER_POINT = {1_000_000: 700}
LATTICE_ROW_OVER_UNIFORM = {10_000: 20}
BUILD_OVER_STATIC = 1.5
START_OVER_STATIC = 3.0
ACCELERATED_OVER_STRAIGHT = 1.8
TURN_NANOSECONDS = {1_000: 1000, 10_000: 1000, 100_000: 2500}
TURN_ALL_OVER_REBUILD = 1.0
TURN_TENTH_OVER_REBUILD = 0.25
INSERT_OVER_STATIC = 4
ERASE_OVER_STATIC = 8
COLLISIONS_OVER_CELL_LIST = 0.2
EQUAL_DISCS_OVER_POINTS = 1.1
ROUNDED_CELL_NANOSECONDS = 2000
CLOSEST_PAIR_MILLISECONDS = {100_000: 30}

# With 5 others in range of a point.
ENCOUNTERS_OVER_BARE = {100_000: 3}

# With fewer events, times per event are not shown.
FEWEST_EVENTS = 1000

EXAMPLES = """examples:
  bench/run.py --quick            some five minutes: mostly n = 1000 and 10 000
  bench/run.py                    every scenario
  bench/run.py --large --runs 3   also n = 100 000 and 1 000 000, on `uniform`
  bench/run.py --json out.json    keeps the results of all runs
"""


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--runs", type=int, default=5, help="runs of each measurement (5)")
    parser.add_argument("--quick", action="store_true", help="a small set")
    parser.add_argument("--large", action="store_true", help="100 000 and 1 000 000 points as well")
    parser.add_argument("--seed", type=int, default=1, help="seed of the scenarios (1)")
    parser.add_argument("--program", type=pathlib.Path, default=PROGRAM, help="kinetri_bench")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results of all runs")
    arguments = parser.parse_args()
    if arguments.runs < 1:
        parser.error("--runs must be at least 1")
    return arguments


def build():
    """Configures and builds the preset `bench`; its output goes to standard error."""
    for command in (["cmake", "--preset", "bench"], ["cmake", "--build", "--preset", "bench"]):
        print("$", *command, file=sys.stderr)
        subprocess.run(command, cwd=ROOT, check=True, stdout=sys.stderr)


def measurements(arguments):
    """(mode, scenario, points, runs) of each measurement. For discs the scenario is their area fraction,
    for discs of different sizes the ratio of these."""
    runs = arguments.runs
    scenarios = ("uniform", "constant-speed") if arguments.quick else SCENARIOS
    sizes = (1_000, 10_000)
    for points in sizes:
        for scenario in scenarios:
            yield "events", scenario, points, runs
    if arguments.large:
        yield "events", "uniform", 100_000, runs
        yield "events", "uniform", 1_000_000, min(runs, 3)
        yield "memory", "uniform", 100_000, 1
        yield "memory", "uniform", 1_000_000, 1
    yield "lattice-row", "uniform", 10_000, runs
    for points in (1_000,) if arguments.quick else (1_000, 10_000):
        yield "frames", "uniform", points, runs
    if arguments.large:
        yield "frames", "uniform", 100_000, min(runs, 3)
    for mode in ("start", "accelerated", "changes", "encounters", "components"):
        for points in (1_000, 10_000, 100_000):
            yield mode, "uniform", points, min(runs, 3) if mode in OBSERVED_MODES else runs
    yield "certificates", "uniform", 1_000, runs
    for points in (1_000, 10_000, 100_000):
        yield "answers", "uniform", points, runs
    for points in (*sizes, 100_000) if arguments.large else sizes:
        yield "steps", "uniform", points, 1 if arguments.quick else min(runs, 3)
    for points in sizes:
        for area_fraction in DISCS_UNTIL:
            yield "discs", area_fraction, points, min(runs, 2) if arguments.quick else runs
    for points in sizes:
        for size_ratio in SIZES_UNTIL:
            yield "sizes", size_ratio, points, min(runs, 2) if arguments.quick else runs
    for points in WEIGHTS_UNTIL:
        yield "weights", "uniform", points, min(runs, 2) if arguments.quick else runs
    for points in (100, 1_000, 10_000):
        yield "paper-table", "uniform", points, 1


def measure(arguments):
    """{(mode, scenario, points): [result of each run]}."""
    results = {}
    todo = list(measurements(arguments))
    for number, (mode, scenario, points, runs) in enumerate(todo, 1):
        for run in range(1, runs + 1):
            print(
                f"[{number}/{len(todo)}] {mode} {scenario} n = {points}, run {run} of {runs}",
                file=sys.stderr,
            )
            program_mode = "discs" if mode == "sizes" else mode
            command = [arguments.program, program_mode, "--points", points, "--seed", arguments.seed]
            if mode == "discs":
                until = DISCS_UNTIL[scenario] * 1_000 / points
                command += ["--area-fraction", scenario, "--until", until]
            elif mode == "sizes":
                command += ["--sizes", scenario, "--until", SIZES_UNTIL[scenario] * 1_000 / points]
            elif mode == "weights":
                command += ["--until", WEIGHTS_UNTIL[points]]
            else:
                command += ["--scenario", scenario, "--until", UNTIL[points]]
            done = subprocess.run(
                [str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True
            )
            results.setdefault((mode, scenario, points), []).append(json.loads(done.stdout))
    return results


def run_root_solves(run):
    """Root solves without those of the start."""
    return run["counters"]["root_solves"] - run["initial_root_solves"]


def event_rows(scenario, points, runs):
    """(what, values of the runs, target) for one setting."""

    def each(function):
        return [function(run) for run in runs]

    counters = [run["counters"] for run in runs]
    uniform = scenario == "uniform"
    if min(c["events"] for c in counters) >= FEWEST_EVENTS:
        yield (
            "event / rebuild time per point",
            each(lambda run: run["event_over_rebuild_point"]),
            at_most(EVENT_OVER_REBUILD_POINT.get(points)) if uniform else None,
        )
        yield (
            "event / event of the uncertified baseline",
            each(lambda run: run["event_over_baseline_event"]),
            at_most(EVENT_OVER_BASELINE_EVENT),
        )
        yield (
            "event / event of the eager baseline",
            each(lambda run: run["seconds_per_event"] / run["baseline"]["eager"]["seconds_per_event"]),
            None,
        )
        yield (
            "root solves / event",
            each(lambda run: run_root_solves(run) / run["counters"]["events"]),
            at_most(ROOT_SOLVES_PER_EVENT) if uniform else None,
        )
        yield (
            "root solves / event, including the start",
            [c["root_solves"] / c["events"] for c in counters],
            None,
        )
    decisions = [(c["exact_decided"], c["exact_decided"] + c["filter_decided"]) for c in counters]
    yield "exact decisions / all", [e / max(all_, 1) for e, all_ in decisions], at_most(EXACT_SHARE)
    yield (
        "initial certificates: ns per edge",
        each(lambda run: 1e9 * run["seconds_per_initial_edge"]),
        at_most(INITIAL_NANOSECONDS.get(points)) if uniform else None,
    )
    yield "event: ns", each(lambda run: 1e9 * run["seconds_per_event"]), None


# Figures of discs: the key in a run, and the target.
DISC_FIGURES = (
    ("collisions / second", "collisions_per_second", None),
    ("collisions / second of the cell list", "baseline_collisions_per_second", None),
    (
        "collisions / collisions of the cell list",
        "ratio",
        Target(">=", COLLISIONS_OVER_CELL_LIST),
    ),
    ("flips / collision", "flips_per_collision", None),
    ("share of flips in the time", "share_of_flips", None),
    ("share of the triangulation in the time", "share_of_triangulation", None),
)

# Figures of other modes: the key in a run, and the bound, perhaps by number of points.
START_FIGURES = (
    ("start: triangulation, ns per point", "build_ns", None),
    ("start: certificates and queue, ns per point", "first_certificates_ns", None),
    ("triangulation at the start / static one", "build_over_static", BUILD_OVER_STATIC),
    ("whole start / static triangulation", "start_over_static", START_OVER_STATIC),
)
ACCELERATED_FIGURES = (
    (
        "event of accelerated points / of straight ones",
        "accelerated_over_straight",
        ACCELERATED_OVER_STRAIGHT,
    ),
)
CHANGE_FIGURES = (
    ("turn of a point: ns", "turn_ns", TURN_NANOSECONDS),
    ("all points turn at once / static rebuild", "turn_all_over_rebuild", TURN_ALL_OVER_REBUILD),
    ("every tenth point turns / static rebuild", "turn_tenth_over_rebuild", TURN_TENTH_OVER_REBUILD),
    ("insertion: ns", "insert_ns", None),
    ("insertion / static insertion", "insert_over_static", INSERT_OVER_STATIC),
    ("erasure: ns", "erase_ns", None),
    ("erasure / static removal", "erase_over_static", ERASE_OVER_STATIC),
)
WEIGHT_FIGURES = (
    ("event of discs of one size / of their centers", "equal_over_delaunay", EQUAL_DISCS_OVER_POINTS),
    ("event of weights that differ / of points without", "unequal_over_delaunay", None),
    ("event with half of the points hidden / without", "hiding_over_unequal", None),
    ("share of hidden points", "hidden_share", None),
)
ENCOUNTER_FIGURES = (
    ("run with encounters / bare run", "over_bare", ENCOUNTERS_OVER_BARE),
    ("more with encounters: ns per event and encounter", "extra_ns_per_event_and_encounter", None),
    ("table of encounters: ns each", "answer_ns_per_encounter", None),
)
COMPONENT_FIGURES = (
    ("run with components / bare run", "components_ratio", None),
    ("run with the spanning tree / bare run", "spanning_tree_ratio", None),
)
FIGURES = {
    "start": START_FIGURES,
    "accelerated": ACCELERATED_FIGURES,
    "changes": CHANGE_FIGURES,
    "weights": WEIGHT_FIGURES,
    "encounters": ENCOUNTER_FIGURES,
    "components": COMPONENT_FIGURES,
}

ANSWER_FIGURES = (
    ("exact Voronoi cell: ns", "exact_cell_ns"),
    ("CGAL's circumcenters of a cell, in doubles: ns", "static_cell_ns"),
    ("areas of Voronoi cells in a box: ns per point", "areas_ns"),
    ("nearest neighbors: ns per point", "nearest_neighbors_ns"),
    ("nearest of all points: ns per point", "nearest_of_all_ns"),
    ("nearest point to a place: ns", "nearest_vertex_ns"),
    ("rounded positions: ns per point", "positions_ns"),
    ("positions not rounded correctly: ns per point", "rounded_place_ns"),
)


def certificate_rows(runs):
    """(what, values of the runs): the time of each certificate, with filters and without."""
    for arithmetic, certificates in runs[0].items():
        if not isinstance(certificates, dict):
            continue
        for name, figures in certificates.items():
            for outcome in (key for key in ("never", "fails") if key in figures):
                what = f"{name} certificate, {arithmetic}, {outcome}: ns"
                yield what, [run[arithmetic][name][outcome]["ns"] for run in runs]


def rows(results):
    """(what, scenario, points, values of the runs, target)."""
    for (mode, scenario, points), runs in results.items():
        if mode == "events":
            for what, values, target in event_rows(scenario, points, runs):
                yield what, scenario, points, values, target
        elif mode == "lattice-row":
            values = [run["event_over_event"] for run in runs]
            target = at_most(LATTICE_ROW_OVER_UNIFORM.get(points))
            yield "event of a lattice row / event", scenario, points, values, target
        elif mode == "memory":
            values = [run["bytes_per_point"] for run in runs]
            target = at_most(BYTES_PER_POINT.get(points))
            yield "peak memory: bytes per point", scenario, points, values, target
        elif mode == "frames":
            for key, name in (("rebuild", "rebuild"), ("move", "move_if_no_collision")):
                what = f"break-even frame rate against {name}: frames / time"
                yield what, scenario, points, [run[f"{key}_crossover_rate"] for run in runs], None
        elif mode in FIGURES:
            for what, key, bound in FIGURES[mode]:
                if key not in runs[0]:  # not measured of so many points
                    continue
                target = at_most(bound.get(points) if isinstance(bound, dict) else bound)
                yield what, scenario, points, [run[key] for run in runs], target
        elif mode == "certificates":
            for what, values in certificate_rows(runs):
                yield what, scenario, points, values, None
        elif mode == "answers":
            cells = [run["rounded_cell_ns"] for run in runs]
            target = at_most(ROUNDED_CELL_NANOSECONDS)
            yield "rounded Voronoi cell: ns", scenario, points, cells, target
            pairs = [run["closest_pair_ms"] for run in runs]
            target = at_most(CLOSEST_PAIR_MILLISECONDS.get(points))
            yield "closest pair: ms", scenario, points, pairs, target
            for what, key in ANSWER_FIGURES:
                yield what, scenario, points, [run[key] for run in runs], None
        elif mode == "discs":
            for what, key, target in DISC_FIGURES:
                yield what, f"discs {scenario}", points, [run[key] for run in runs], target
        elif mode == "sizes":
            for what, key, target in DISC_FIGURES:
                # The ratio must not be less than that of equal discs.
                if target is not None:
                    one_size = results[mode, min(SIZES_UNTIL), points]
                    target = Target(">=", statistics.median(run[key] for run in one_size))
                yield what, f"sizes 1:{scenario}", points, [run[key] for run in runs], target


def number(value):
    if value == 0:
        return "0"
    return f"{value:.1e}" if abs(value) < 1e-3 else f"{value:.4g}" if value < 1000 else f"{value:.0f}"


def print_aligned(lines, left):
    """Prints the columns, the first `left` of them left-aligned."""
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    for line in lines:
        cells = [
            cell.ljust(width) if i < left else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(line, widths))
        ]
        print("  ".join(cells).rstrip())


def print_ratios(results):
    lines = [("figure", "scenario", "n", "median", "least", "most", "target", "")]
    # Grouped by figure.
    by_figure = {}
    for row in rows(results):
        by_figure.setdefault(row[0], []).append(row)
    for figure in by_figure.values():
        for what, scenario, points, values, target in figure:
            value = statistics.median(values)
            verdict = "" if target is None else "met" if target.is_met(value) else "MISSED"
            aim = "" if target is None else f"{target.sign} {number(target.bound)}"
            spread = (number(min(values)), number(max(values)))
            lines.append((what, scenario, str(points), number(value), *spread, aim, verdict))
    print_aligned(lines, 2)


def print_paper_table(results):
    lines = [("n", "way", "scheduled", "executed", "discarded", "share", "root solves", "per event")]
    for (mode, _, points), runs in results.items():
        if mode != "paper-table":
            continue
        for way in ("eager", "lazy"):
            c = runs[0][way]
            events = max(c["events"], 1)
            lines.append(
                (
                    str(points),
                    way,
                    str(c["scheduled"]),
                    str(c["events"]),
                    str(c["discarded"]),
                    f"{100 * c['discarded'] / max(c['scheduled'], 1):.0f} %",
                    str(c["root_solves"]),
                    f"{c['root_solves'] / events:.2f}",
                )
            )
    print("\nEvents on `uniform`: eager (uncertified, to the first root) and lazy (Kinetri, whose")
    print("scheduled entries include rechecks)\n")
    print_aligned(lines, 0)


def print_steps(results):
    ratios = {}
    for (mode, _, points), runs in results.items():
        if mode != "steps":
            continue
        for setting in (setting for run in runs for setting in run["settings"]):
            by_length = ratios.setdefault((points, setting["share"]), {})
            by_length.setdefault(setting["length"], []).append(setting["kinetic_over_rebuild"])
    lines = []
    for (points, share), by_length in ratios.items():
        medians = (f"{statistics.median(values):.2f}" for values in by_length.values())
        lines.append((str(points), f"{100 * share:g} %", *medians))
    lengths = (f"step of {length:g}" for length in by_length)
    print("\nTime of a step / of a static rebuild. The length of a step is the mean path of a point,")
    print("in distances of neighbors\n")
    print_aligned([("n", "points that turn", *lengths), *lines], 0)


def print_disagreements(results):
    """Prints the settings in which the uncertified baseline ends in another triangulation than Kinetri."""
    for (mode, scenario, points), runs in results.items():
        if mode != "events":
            continue
        for way in ("eager", "lazy"):
            baseline = runs[0]["baseline"][way]
            if not baseline["same_edges_at_end"]:
                events = (runs[0]["counters"]["events"], baseline["counters"]["events"])
                print(
                    f"\n{scenario} n = {points}: the {way} uncertified baseline ends in another "
                    f"triangulation ({events[0]} events, the baseline {events[1]})"
                )


def main():
    arguments = parse_arguments()
    if arguments.program == PROGRAM and not PROGRAM.exists():
        build()
    results = measure(arguments)
    print_ratios(results)
    print_paper_table(results)
    print_steps(results)
    print_disagreements(results)
    if arguments.json:
        everything = [run for runs in results.values() for run in runs]
        arguments.json.write_text(json.dumps(everything, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"run.py: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
