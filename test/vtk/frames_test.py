#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""VTK reads what `kinetri simulate --vtu` writes, and each frame is what a run that ends at its
time gives.

usage: frames_test.py PROGRAM WORK_DIR RUN

RUN names one of the runs below. Places and velocities are compared with exact arithmetic on the
input; edges with the file that another run of the program, which ends at the frame's time, writes;
points and events with the event log. The pictures of the same frames are counted too. Exit code 77,
which says skipped, where there is no VTK.
"""
import collections
import csv
import fractions
import math
import os
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

SKIPPED = 77
# The python3 that comes first need not be the one that Debian's package is for.
DEBIAN_PYTHON = "/usr/bin/python3"

try:
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    if os.environ.get("KINETRI_TEST_PYTHON") is None and os.access(DEBIAN_PYTHON, os.X_OK):
        os.environ["KINETRI_TEST_PYTHON"] = DEBIAN_PYTHON
        os.execv(DEBIAN_PYTHON, [DEBIAN_PYTHON, *sys.argv])
    print("skipped: python has no VTK; expected Debian's python3-vtk9, which nothing else needs")
    sys.exit(SKIPPED)

Fraction = fractions.Fraction
KINDS = ["rebuild", "hull_insert", "hull_remove", "flip", "hide", "reveal", "wall", "collision",
         "insert", "erase", "trajectory"]

ACCELERATED = """x,y,vx,vy,ax,ay,jx,jy
0,0,1,0,0,2,0,0
8,0.5,0,1,-1,0,0,0.5
1,8,0.25,-2,0,0,0,0
9,9,-1,-1,0.5,0.5,-0.25,0
4,5,0,0,0,0,1,-1
5,2,3,1,-2,0,0,0
"""
TRACKS = """t,id,x,y
0,a,0,0
8,a,16,0
0,b,3,9
4,b,3,1
8,b,11,1
1,c,8,8
3,c,0,8
2,d,5,5
6,d,5,3
8,e,1,2
9,e,1,1
"""
HEADER = "x,y,vx,vy\n"


class Failure(Exception):
    pass


def expect(condition, message):
    if not condition:
        raise Failure(message)


def expect_equal(found, expected, what):
    expect(found == expected, f"{what}: {found!r}, expected {expected!r}")


# ---- running the program ----


class Program:
    def __init__(self, program, directory):
        self.program = program
        self.directory = directory

    def __call__(self, *arguments):
        result = subprocess.run([self.program, *arguments], cwd=self.directory,
                                stdin=subprocess.DEVNULL, capture_output=True, text=True)
        expect(result.returncode == 0, f"kinetri {' '.join(arguments)}: {result.stderr}")
        return result.stdout

    def rows(self, name):
        with open(self.directory / name, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))


def edges_in(rows):
    return {(int(row["a"]), int(row["b"])) for row in rows}


# ---- reading a frame ----


class Frame:
    """A VTU file, read by VTK."""

    def __init__(self, path):
        reader = vtkXMLUnstructuredGridReader()
        errors = []
        reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
        reader.AddObserver("WarningEvent", lambda *_: errors.append(1))
        expect(reader.CanReadFile(str(path)) == 1, f"{path}: VTK cannot read it")
        reader.SetFileName(str(path))
        reader.Update()
        expect(not errors and reader.GetErrorCode() == 0, f"{path}: VTK reports errors")
        grid = reader.GetOutput()
        self.places = [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]
        self.ids = [int(value) for (value,) in self.tuples(grid.GetPointData(), "id")]
        self.velocities = self.tuples(grid.GetPointData(), "velocity")
        radius = grid.GetPointData().GetArray("radius")
        self.radii = self.hidden = None
        if radius is not None:
            self.radii = [value for (value,) in self.tuples(grid.GetPointData(), "radius")]
            self.hidden = [value for (value,) in self.tuples(grid.GetPointData(), "hidden")]
        self.triangles = []
        for i in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(i)
            expect_equal(cell.GetClassName(), "vtkTriangle", "the class of a cell")
            self.triangles.append(tuple(cell.GetPointId(corner) for corner in range(3)))
        fields = grid.GetFieldData()
        (self.time,), = self.tuples(fields, "TimeValue")
        (self.events,), = self.tuples(fields, "events")
        self.kinds = [self.tuples(fields, f"events_{kind}")[0][0] for kind in KINDS]

    @staticmethod
    def tuples(attributes, name):
        array = attributes.GetArray(name)
        expect(array is not None, f"there is no array {name}")
        return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]

    def edges(self):
        result = set()
        for triangle in self.triangles:
            a, b, c = (self.ids[corner] for corner in triangle)
            result |= {(min(p, q), max(p, q)) for p, q in ((a, b), (b, c), (c, a))}
        return result


def expect_picture(path, points, edges, discs):
    """An SVG file with so much in it."""
    root = ElementTree.parse(path).getroot()
    name = "{http://www.w3.org/2000/svg}"
    circles = len(root.findall(f".//{name}circle"))
    lines = sum(element.get("d").count("M") for element in root.findall(f".//{name}path"))
    expected = points * (2 if discs else 1), edges
    expect_equal((circles, lines), expected, f"circles and lines in {path}")


# ---- what is expected ----

Motion = collections.namedtuple("Motion", "x y vx vy ax ay jx jy radius growth", defaults=[Fraction(0)] * 6)


def motions_of(rows):
    return [Motion(**{key: Fraction(float(value)) for key, value in row.items()}) for row in rows]


def velocity(m, t):
    return (m.vx + m.ax * t + m.jx * t * t / 2, m.vy + m.ay * t + m.jy * t * t / 2)


def expect_place(found, m, t):
    """Up to some units in the last place of the largest term."""
    for axis, (p, v, a, j) in enumerate(((m.x, m.vx, m.ax, m.jx), (m.y, m.vy, m.ay, m.jy))):
        terms = [p, v * t, a * t * t / 2, j * t**3 / 6]
        bound = 8 * max(map(abs, terms)) * Fraction(2) ** -53
        error = abs(Fraction(found[axis]) - sum(terms))
        expect(error <= bound, f"at t = {float(t)} a point is at {found}, {float(error)} off")


def happened(events, time):
    """The events up to and at the time: exact, as one that is later has a greater time_hi."""
    return [row for row in events if float(row["time_hi"]) <= time]


class Run:
    """A run, and the same run that ends at the time of each frame."""

    command = "simulate"
    options = ()
    start = 0
    until = 2
    rate = 4
    discs = False
    has_hidden_points = False
    least_events = 1  # or the run would show little

    def __init__(self, kinetri):
        self.kinetri = kinetri

    def points(self):
        raise NotImplementedError

    def times(self):
        result = []
        while True:
            time = float(Fraction(self.start) + len(result) / Fraction(float(self.rate)))
            if time > self.until:
                return result
            result.append(time)

    def run(self, until, *more):
        self.kinetri(self.command, "input", *self.options, "--until", repr(float(until)), "--quiet",
                     *more)

    def check(self):
        (self.kinetri.directory / "input").write_text(self.points(), encoding="utf-8")
        self.run(self.until, "--events", "events.csv", "--vtu", "vtu", "--frames", "svg",
                 "--frames-per-time", str(self.rate))
        self.events = self.kinetri.rows("events.csv")
        expect(len(self.events) >= self.least_events, f"only {len(self.events)} events")
        folder = self.kinetri.directory / "vtu"
        series = ElementTree.parse(folder / "frames.pvd").getroot()
        expect_equal(series.get("type"), "Collection", "the type of the series")
        times = []
        for number, entry in enumerate(series.iter("DataSet")):
            name = f"frame_{number:06}"
            expect_equal(entry.get("file"), name + ".vtu", "a file of the series")
            frame = Frame(folder / entry.get("file"))
            expect_equal(frame.time, float(entry.get("timestep")), "the time of a frame")
            times.append(frame.time)
            self.check_frame(frame, self.kinetri.directory / "svg" / (name + ".svg"))
        expect_equal(times, self.times(), "the times of the series")
        for folder, others in (("vtu", 1), ("svg", 0)):
            files = len(list((self.kinetri.directory / folder).iterdir()))
            expect_equal(files, len(times) + others, f"the number of files in {folder}")

    def check_frame(self, frame, picture):
        t = frame.time
        self.run(self.end_for(t), "--edges", "edges.csv")
        edges = edges_in(self.kinetri.rows("edges.csv"))
        expect_equal(frame.edges(), edges if frame.triangles else set(), f"the edges at {t}")
        if edges and not frame.triangles:
            self.check_is_flat(t)
        expect_equal(frame.ids, self.ids(t), f"the ids at {t}")
        events = happened(self.events, t)
        expect_equal(frame.events, len(events), f"the number of events at {t}")
        counts = collections.Counter(row["kind"] for row in events)
        expect_equal(frame.kinds, [counts[kind] for kind in KINDS], f"the kinds of event at {t}")
        expect_equal(frame.radii, self.radii(frame) if self.discs else None, f"the radii at {t}")
        seen = {point for edge in edges for point in edge}
        hidden = [0.0 if point in seen or not self.has_hidden_points else 1.0 for point in frame.ids]
        expect_equal(frame.hidden, hidden if self.discs else None, f"the hidden points at {t}")
        expect(all(z == 0 for _, _, z in frame.places + frame.velocities), "a z is not 0")
        expect_picture(picture, len(frame.ids), len(edges), self.discs)
        self.check_points(frame)

    def end_for(self, t):
        """When a run has to end to have the edges just after t at its end."""
        return t

    def check_is_flat(self, t):
        raise Failure(f"there are edges and no triangles at {t}")

    def ids(self, _):
        return list(range(len(self.kinetri.rows("input"))))

    def radii(self, frame):
        return [1.5] * len(frame.ids)

    def check_points(self, frame):
        motions = motions_of(self.kinetri.rows("input"))
        t = Fraction(frame.time)
        for i, point in enumerate(frame.ids):
            m = motions[point]
            expect_equal(frame.velocities[i][:2], tuple(map(float, velocity(m, t))), "a velocity")
            expect_place(frame.places[i], m, t)


# ---- the runs ----


class Free(Run):
    least_events = 100
    until = 3.3
    rate = 2.7

    def points(self):
        return self.kinetri("generate", "uniform", "--points", "80", "--seed", "4")

    def check_frame(self, frame, picture):
        super().check_frame(frame, picture)
        motions = motions_of(self.kinetri.rows("input"))
        t = Fraction(frame.time)
        places = [(m.x + m.vx * t, m.y + m.vy * t) for m in motions]
        for triangle in frame.triangles:
            (ax, ay), (bx, by), (cx, cy) = (places[corner] for corner in triangle)
            expect((bx - ax) * (cy - ay) > (by - ay) * (cx - ax), f"{triangle} is clockwise at {t}")


class Discs(Run):
    options = ("--box", "-5,-5,55,55", "--collisions", "elastic", "--radius", "1.5")
    discs = True
    least_events = 100
    until = 8
    rate = 1.5

    def points(self):
        return self.kinetri("generate", "lattice-jitter", "--points", "36", "--seed", "2")

    def check_points(self, frame):
        for x, y, _ in frame.places:
            expect(-5 <= x <= 55 and -5 <= y <= 55, f"a point is outside of the box: {x}, {y}")


class Swapped(Run):
    """Velocities are exchanged, exactly."""

    options = ("--collisions", "swap", "--radius", "1.5")
    discs = True
    least_events = 20

    def points(self):
        return self.kinetri("generate", "lattice-jitter", "--points", "36", "--seed", "3")

    def check_points(self, frame):
        velocities = [(float(m.vx), float(m.vy)) for m in motions_of(self.kinetri.rows("input"))]
        for row in happened(self.events, frame.time):
            if row["kind"] != "collision":
                continue
            a, b = int(row["point_a"]), int(row["point_b"])
            velocities[a], velocities[b] = velocities[b], velocities[a]
        expect_equal([(x, y) for x, y, _ in frame.velocities], velocities, "the velocities")


class Removed(Swapped):
    options = ("--collisions", "remove", "--radius", "1.5")
    until = 4

    def ids(self, t):
        result = set(super().ids(t))
        for row in happened(self.events, t):
            if row["kind"] == "collision":
                result -= {int(row["point_a"]), int(row["point_b"])}
        return sorted(result)

    def check_points(self, frame):
        Run.check_points(self, frame)


class Sizes(Run):
    """Discs of many sizes, of which some grow and some shrink, and hide others."""

    options = ("--regular",)
    discs = True
    has_hidden_points = True
    least_events = 100
    until = 3
    rate = 2  # frames are at binary64 numbers with few digits, so that no radius is rounded

    def points(self):
        rows = self.kinetri("generate", "uniform", "--points", "80", "--seed", "5").split()
        sizes = [f"{0.5 + (i * 7) % 11 % 5 * 3},{(i % 3 - 1) / 8}" for i in range(len(rows) - 1)]
        return "\n".join(map(",".join, zip(rows, ["radius,growth", *sizes]))) + "\n"

    def radii(self, frame):
        motions = motions_of(self.kinetri.rows("input"))
        return [float(motions[i].radius + motions[i].growth * Fraction(frame.time)) for i in frame.ids]

    def check(self):
        super().check()
        counts = collections.Counter(row["kind"] for row in self.events)
        expect(counts["hide"] > 3 and counts["reveal"] > 3, f"too few points are hidden: {counts}")


class Tracks(Run):
    command = "tracks"
    least_events = 8
    until = 8.5
    rate = 2

    def points(self):
        return TRACKS

    def end_for(self, t):
        # A run has nothing of a track that begins when it ends.
        return math.nextafter(t, math.inf)

    def tracks(self):
        seen = collections.defaultdict(list)
        for row in self.kinetri.rows("input"):
            seen[row["id"]].append(tuple(Fraction(float(row[key])) for key in ("t", "x", "y")))
        by_start = sorted((min(rows)[0], name) for name, rows in seen.items())
        return [sorted(seen[name]) for _, name in by_start]

    def ids(self, t):
        return [i for i, seen in enumerate(self.tracks()) if seen[0][0] <= t < seen[-1][0]]

    def check_points(self, frame):
        t = Fraction(frame.time)
        tracks = self.tracks()
        for i, point in enumerate(frame.ids):
            seen = tracks[point]
            (t0, x0, y0), (t1, x1, y1) = next(
                pair for pair in zip(seen, seen[1:]) if pair[0][0] <= t < pair[1][0])
            vx, vy = (x1 - x0) / (t1 - t0), (y1 - y0) / (t1 - t0)
            # All numbers are multiples of small powers of two, so that nothing is rounded.
            x, y = x0 + vx * (t - t0), y0 + vy * (t - t0)
            expect_equal(frame.velocities[i], (float(vx), float(vy), 0.0), f"a velocity at {t}")
            expect_equal(frame.places[i], (float(x), float(y), 0.0), f"a place at {t}")

    def check_is_flat(self, t):
        expect(t in (0, 0.5) or t >= 6, f"there are edges and no triangles at {t}")


class Accelerated(Run):
    least_events = 3
    rate = 8

    def points(self):
        return ACCELERATED


class Lattice(Run):
    """Cocircular and collinear points, and points that meet."""

    until = 20
    rate = 1

    def points(self):
        return self.kinetri("generate", "lattice", "--points", "25", "--movers", "one")


class Degenerate(Run):
    """No point, one, two, and some on a line; these run one after the other."""

    inputs = ["", "1,2,3,4\n", "1,2,3,4\n5,6,7,8\n", "0,0,1,1\n1,1,0,0\n2,2,0,0\n5,5,-1,-1\n",
              "0,0,0,0\n1,1,0,1\n2,2,0,0\n"]
    least_events = 0
    rate = 1

    def points(self):
        return HEADER + self.text

    def check(self):
        for self.text in self.inputs:
            super().check()
            for name in ("vtu", "svg"):
                shutil.rmtree(self.kinetri.directory / name)

    def check_is_flat(self, _):
        expect(self.text != self.inputs[-1], "there are no triangles, though one point moves away")


RUNS = {run.__name__.lower(): run
        for run in (Free, Discs, Swapped, Removed, Sizes, Tracks, Accelerated, Lattice, Degenerate)}


def main():
    if len(sys.argv) != 4 or sys.argv[3] not in RUNS:
        sys.exit(__doc__)
    program, directory = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    try:
        RUNS[sys.argv[3]](Program(program, directory)).check()
    except Failure as failure:
        print(failure)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
