# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in periodic boxes, most of them degenerate: their logs, which tests change and have verified. The arguments of
these tests are KINETRI VERIFY FOLDER.

The environment variable KINETRI_TEST_MULTIPLIER says how many times as many runs there are.
"""
import csv
import itertools
import json
import os
import pathlib
import random
import subprocess
import sys
import zlib

KINETRI, VERIFY = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:3])
FOLDER = pathlib.Path(sys.argv[3])
KINDS = ("grid", "few", "crystal", "one", "random", "moving", "weights")
DISCS = ("lattice", "gas", "sizes")  # kinds with contacts
RESPONSES = ("log", "swap", "elastic", "stop", "remove")
MOTIONS = "event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch".split(",")
TIMES = int(os.environ.get("KINETRI_TEST_MULTIPLIER", "1"))


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
