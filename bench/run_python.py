#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the Python package beside C++ and scipy, and prints one table, each figure beside its target.

The C++ figures are those of `kinetri_bench arrays`, run in turn with the same in Python. The package is
that on PYTHONPATH: build/release/python after `cmake --build --preset release`, for example.

The command `flock` measures a flock beside scipy instead: run_python.py flock --help.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build" / "bench" / "bin" / "kinetri_bench"

EXAMPLES = """examples:
  PYTHONPATH=build/test/python bench/run_python.py --quick
  PYTHONPATH=build/test/python bench/run_python.py --frames 5700 --people 700
  PYTHONPATH=build/test/python bench/run_python.py flock --birds 10000 --steps 50
"""


def seconds(function):
    """The seconds of one call, and its result."""
    start = time.perf_counter()
    result = function()
    return time.perf_counter() - start, result


def in_cpp(program, points, until, seed):
    command = [str(program), "arrays", "--points", str(points), "--until", str(until), "--seed", str(seed)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def in_python(points, until, seed, rounds):
    """The medians of the same in Python, and the number of events."""
    import numpy as np

    import kinetri

    positions, velocities = kinetri.scenario("uniform", points, seed=seed)
    ids = np.arange(min(1000, points), dtype=np.uint32)
    figures = {"construction_seconds": [], "turns_seconds": [], "record_seconds": [], "advance_seconds": []}
    for _ in range(rounds):
        spent, kd = seconds(lambda: kinetri.KineticDelaunay(positions, velocities))
        figures["construction_seconds"].append(spent)
        turned = np.column_stack((velocities[-1, 0] + 1e-3 * ids, np.full(len(ids), velocities[-1, 1])))
        spent, _ = seconds(lambda: kd.set_velocities(ids, turned))
        figures["turns_seconds"].append(spent)
        kd.set_velocities(ids, velocities[ids])
        spent, events = seconds(lambda: kd.record(until))
        figures["record_seconds"].append(spent)
        kd = kinetri.KineticDelaunay(positions, velocities)
        figures["advance_seconds"].append(seconds(lambda: kd.advance_to(until))[0])
    return {name: statistics.median(values) for name, values in figures.items()} | {"events": len(events)}


def turn_overhead(points, seed, rounds=200):
    """The least seconds of set_velocities of 1000 points in Python, less those of its C++ alone."""
    import numpy as np

    import kinetri

    positions, velocities = kinetri.scenario("uniform", points, seed=seed)
    kd = kinetri.KineticDelaunay(positions, velocities)
    ids = np.arange(min(1000, points), dtype=np.uint32)
    least = [float("inf"), float("inf")]
    for i in range(rounds):
        for way, call in enumerate((kd.set_velocities, kd._engine.set_velocities)):
            turned = np.ascontiguousarray(velocities[: len(ids)] + (-1) ** way * 1e-3 * i)
            least[way] = min(least[way], seconds(lambda: call(ids, turned))[0])
    return least[0] - least[1]


def import_seconds(rounds):
    """The seconds of the import in a new process, after that of NumPy."""
    code = "import numpy, time; t = time.perf_counter(); import kinetri; print(time.perf_counter() - t)"
    return statistics.median(
        float(subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout)
        for _ in range(rounds))


def crowd(people, frames, seed):
    """A crowd in a corridor of 60 x 20: times, and positions of shape (frames, people, 2)."""
    import numpy as np

    rng = np.random.default_rng(seed)
    places = np.empty((frames, people, 2))
    now = rng.uniform((1, 1), (59, 19), (people, 2))
    velocity = rng.normal(0, 1, (people, 2))
    for frame in range(frames):
        places[frame] = now
        velocity = 0.95 * velocity + rng.normal(0, 0.3, (people, 2))
        now = now + velocity / 16
        outside = (now < (0.5, 0.5)) | (now > (59.5, 19.5))
        velocity[outside] *= -1
        now = np.clip(now, (0.5, 0.5), (59.5, 19.5))
    return np.arange(frames) / 16, places


def crowd_in_kinetri(places, box):
    """The areas of all cells at each frame, by one triangulation whose points move to their next positions."""
    import numpy as np

    import kinetri

    areas = np.empty(places.shape[:2])
    kd = kinetri.KineticDelaunay(places[0], np.zeros_like(places[0]))
    for frame, now in enumerate(places):
        kd.set_positions(now)
        areas[frame] = kd.voronoi_areas(clip=box)
    return areas


def crowd_in_tracks(times, places, box):
    """The same by exact tracks between the frames."""
    import numpy as np

    import kinetri

    frames, people = places.shape[:2]
    tracks = kinetri.Tracks.from_arrays(np.repeat(times, people), np.tile(np.arange(people), frames),
                                        places[:, :, 0].ravel(), places[:, :, 1].ravel())
    simulation = tracks.simulation()
    areas = np.empty(places.shape[:2])
    for frame, now in enumerate(times[:-1]):
        simulation.advance_to(now)
        areas[frame] = simulation.voronoi_areas(clip=box)
    areas[-1] = np.nan
    return areas


def crowd_in_scipy(places, box):
    """The same by a static Voronoi diagram for each frame, bounded by mirrored points."""
    import numpy as np
    from scipy.spatial import Voronoi

    xmin, ymin, xmax, ymax = box
    people = places.shape[1]
    areas = np.empty(places.shape[:2])
    for frame, p in enumerate(places):
        mirrored = np.concatenate((
            p, np.column_stack((2 * xmin - p[:, 0], p[:, 1])), np.column_stack((2 * xmax - p[:, 0], p[:, 1])),
            np.column_stack((p[:, 0], 2 * ymin - p[:, 1])), np.column_stack((p[:, 0], 2 * ymax - p[:, 1]))))
        diagram = Voronoi(mirrored)
        for i in range(people):
            corners = diagram.vertices[diagram.regions[diagram.point_region[i]]]
            x, y = corners[:, 0], corners[:, 1]
            areas[frame, i] = 0.5 * abs(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1)))
    return areas


def flock_beside_scipy(birds, steps, length):
    """(mean path in a step / distance of neighbors, seconds of a step, of set_positions, of a rebuild), medians."""
    import flock
    import numpy as np
    from scipy.spatial import Delaunay

    import kinetri

    flock.STEP = length
    side = 60 * (birds / 200) ** 0.5  # the density of the example
    positions, velocities = kinetri.scenario("constant-speed", birds, seed=4, side=side, speed=5)
    kd = kinetri.KineticDelaunay(positions - side / 2, velocities)
    moved = kinetri.KineticDelaunay(positions - side / 2, np.zeros_like(positions))
    rows = []
    for step in range(1, steps + 1):
        velocities, before = flock.steer(kd, kd.velocities()), kd.positions()

        def kept():
            kd.set_velocities(velocities)
            kd.advance_to(step * length)
            return kd.edges()

        def stepped():
            moved.set_positions(positions)
            return moved.edges()

        kept_seconds, edges = seconds(kept)
        positions = kd.positions()
        stepped_seconds, _ = seconds(stepped)
        rebuilt_seconds, _ = seconds(lambda: Delaunay(positions))
        neighbors = np.linalg.norm(positions[edges[:, 0]] - positions[edges[:, 1]], axis=1)
        path = np.linalg.norm(positions - before, axis=1)
        rows.append((path.mean() / neighbors.mean(), kept_seconds, stepped_seconds, rebuilt_seconds))
    return np.median(rows, axis=0)


def flock_main(words):
    parser = argparse.ArgumentParser(
        prog="run_python.py flock",
        description="The flock of examples/python/flock.py, in which all birds turn at each step: set_velocities, "
        "advance_to and edges; set_positions and edges; a new scipy.spatial.Delaunay of the same positions, in turn. "
        "Prints medians.")
    parser.add_argument("--birds", type=int, default=1000, help="number of birds (1000)")
    parser.add_argument("--steps", type=int, default=100, help="number of steps (100)")
    parser.add_argument("--lengths", type=float, nargs="+", default=[0.01, 0.1, 0.4, 0.8], metavar="SECONDS",
                        help="lengths of a step (0.01 0.1 0.4 0.8)")
    arguments = parser.parse_args(words)
    sys.path.insert(0, str(ROOT / "examples" / "python"))
    for length in arguments.lengths:
        path, kept, stepped, rebuilt = flock_beside_scipy(arguments.birds, arguments.steps, length)
        print(f"{length} s, {path:.2f} distances: {1e3 * kept:.2f} ms, set_positions {1e3 * stepped:.2f} ms, "
              f"SciPy {1e3 * rebuilt:.2f} ms", flush=True)


def main():
    if sys.argv[1:2] == ["flock"]:
        return flock_main(sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="without the million points, and 200 frames")
    parser.add_argument("--rounds", type=int, default=5, help="rounds of each figure (5)")
    parser.add_argument("--people", type=int, default=700, help="in the crowd (700)")
    parser.add_argument("--frames", type=int, default=5700, help="of the crowd (5700)")
    parser.add_argument("--seed", type=int, default=1, help="of all random numbers (1)")
    parser.add_argument("--program", type=pathlib.Path, default=PROGRAM, help="kinetri_bench")
    arguments = parser.parse_args()

    print(f"{'figure':52}  {'measured':>10}  target")

    def row(name, value, target, is_met):
        print(f"{name:52}  {value:10.3g}  {target}{'' if is_met else '  MISSED'}", flush=True)

    sizes = [(1_000, 3.0), (10_000, 1.0)] + ([] if arguments.quick else [(100_000, 0.3)])
    for points, until in sizes:
        cpp = in_cpp(arguments.program, points, until, arguments.seed)
        python = in_python(points, until, arguments.seed, arguments.rounds)
        if python["events"] != cpp["events"]:
            raise RuntimeError(f"{python['events']} events in Python, {cpp['events']} in C++")
        ratio = python["record_seconds"] / cpp["record_seconds"]
        row(f"record / C++ recorded run, {points} points", ratio, "<= 1.15", ratio <= 1.15)
        row(f"record / run without a record, {points} points",
            python["record_seconds"] / python["advance_seconds"], "-", True)
        extra = 1e6 * turn_overhead(points, arguments.seed)
        row(f"1000 turns over C++, microseconds, {points} points", extra, "<= 20", extra <= 20)
        row(f"1000 turns after a construction / C++, {points} points",
            python["turns_seconds"] / cpp["turns_seconds"], "-", True)
    if not arguments.quick:
        cpp = in_cpp(arguments.program, 1_000_000, 1e-6, arguments.seed)
        python = in_python(1_000_000, 1e-6, arguments.seed, 2)
        ratio = python["construction_seconds"] / cpp["construction_seconds"]
        row("construction / C++, 1000000 points", ratio, "<= 1.1", ratio <= 1.1)
    spent = import_seconds(arguments.rounds)
    row("import, seconds", spent, "<= 0.3", spent <= 0.3)

    import numpy as np

    frames = 200 if arguments.quick else arguments.frames
    box = (0, 0, 60, 20)
    times, places = crowd(arguments.people, frames, arguments.seed)
    kinetic_seconds, kinetic = seconds(lambda: crowd_in_kinetri(places, box))
    tracks_seconds, exact = seconds(lambda: crowd_in_tracks(times, places, box))
    static_seconds, static = seconds(lambda: crowd_in_scipy(places, box))
    difference = max(np.max(np.abs(kinetic - static)), np.nanmax(np.abs(exact - static)))
    if not difference < 1e-6:
        raise RuntimeError(f"areas of kinetri and scipy differ by {difference}")
    text = f"{arguments.people} people, {frames} frames"
    row(f"densities, scipy, seconds, {text}", static_seconds, "-", True)
    row("densities, scipy / set_positions for each frame", static_seconds / kinetic_seconds, ">= 100",
        static_seconds >= 100 * kinetic_seconds)
    row("densities, scipy / exact tracks", static_seconds / tracks_seconds, ">= 10",
        static_seconds >= 10 * tracks_seconds)


if __name__ == "__main__":
    main()
