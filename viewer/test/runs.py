# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the program whose pages are tested: its commands, and its logs as what must be seen."""
import base64
import csv
import fractions
import itertools
import json
import math
import struct
import subprocess

HALF_ULP = fractions.Fraction(1, 2**53)
TRACKS = """t,id,x,y
0,ada,0,0
4,ada,5,5
0,bea,4,0
5,bea,0,4
0,cid,2,6
6,cid,2,0
1,dan,1,2
3,dan,3,2
0,eva,9,9
4,eva,3,8
6,eva,-1,7
2,fay,5,-1
6,fay,6,7
"""
# cas and ben are with ann from 2 to 4, and with each other until 6.
TOGETHER = """t,id,x,y
0,ann,0,0
4,ann,4,0
8,ann,4,8
0,ben,0,4
2,ben,2,0
6,ben,6,0
8,ben,8,0
0,cas,2,8
2,cas,2,0
6,cas,6,0
8,cas,6,8
0,dot,9,9
8,dot,9,9
0,eve,-3,9
8,eve,-3,9
0,fin,3,-6
8,fin,3,-6
"""


def accelerated_points():
    """Balls that are thrown, in exact numbers."""
    lines = ["x,y,vx,vy,ax,ay,jx,jy"]
    for i in range(18):
        x, y = (i * 37) % 53, (i * 23) % 41
        lines.append(f"{x},{y},{(i * 7) % 11 - 5},{(i * 5) % 13 - 3},{(i % 5 - 2) / 4},-2,"
                     f"{(i % 3 - 1) / 8},{(i % 4) / 16}")
    return "\n".join(lines) + "\n"


# A point falls through the fourth corner of a square, at exactly t = 1.
SQUARE = "x,y,vx,vy\n0,0,0,0\n2,0,0,0\n2,2,0,0\n0,3,0,-1\n"

# Points 2 and 3 meet on the hull at t = 1 and go through each other: before, 2 is inside the triangle
# 0 1 3; after, 3 is inside 0 1 2. All edges stay, and nothing is logged.
PASSING = "x,y,vx,vy\n-4,0,0,0\n4,0,0,0\n0,2,0,1\n0,4,0,-1\n0,-50,0,0\n"

# The singular cases of certificates. The edge 0-1 touches its circle at t = 1 and flips at t = 2; points that
# stay cocircular; an edge 0-1 whose certificate has a triple root at t = 1.
TOUCHING = "x,y,vx,vy\n0,1,0,0\n0,-1,0,0\n1.5,0,-0.5,0\n-0.5,1,-0.5,-1\n"
COCIRCULAR = "x,y,vx,vy\n0,1,0,1\n0,-1,0,-1\n1,0,1,0\n-1,0,-1,0\n"
TRIPLE = "x,y,vx,vy\n1,1,-1,0\n0,-1,0,0\n1,-1,0,1\n-1,0,0,0\n"


def sizes():
    """Discs of many sizes, of which some grow and some shrink, in exact numbers; some hide others."""
    lines = ["x,y,vx,vy,radius,growth"]
    for i in range(30):
        x, y = (i * 37) % 53, (i * 23) % 41
        lines.append(f"{x},{y},{(i * 7) % 11 - 5},{(i * 5) % 13 - 6},{(1 + i * 3 % 4) ** 2 / 2},"
                     f"{(i % 3 - 1) / 16}")
    return "\n".join(lines) + "\n"


RANGE = 3  # of "near"


def near():
    """Points 0 and 1 are always at the range; 2 comes into the range of 1 at 4 and of 0 at 7; 3 touches that of 0 at
    5 and of 1 at 8. The others cross it at any time."""
    lines = ["x,y,vx,vy", "0,0,0,0", "3,0,0,0", "10,0,-1,0", "-5,3,1,0"]
    for i in range(50):
        lines.append(f"{(i * 37) % 29 - 14},{(i * 23) % 33 - 16},{(i * 7) % 11 / 4 - 1.25},{(i * 5) % 13 / 4 - 1.5}")
    return "\n".join(lines) + "\n"


def crowd():
    """250 points that are all within range of each other, and eight far from them in pairs that are, too."""
    lines = ["x,y,vx,vy"]
    for y in (-60, -20, 20, 60):
        lines += [f"100,{y},0,0.25", f"120,{y + 4},0,-0.25"]
    for i in range(250):
        lines.append(f"{(i * 37) % 101 / 5},{(i * 53) % 103 / 5},{(i * 7) % 11 / 40 - 0.125},{(i * 5) % 13 / 50 - 0.12}")
    return "\n".join(lines) + "\n"


# By name: how the points are generated (or what is in their file), the end, further options.
RUNS = {
    "uniform": ("uniform --points 40 --seed 3", 8, ()),
    "box": ("uniform --points 30 --seed 5 --side 60", 9, ("--box", "0,0,60,60")),
    "discs": ("lattice-jitter --points 25 --jitter 0.5 --seed 2", 8,
              ("--box", "-5,-5,45,45", "--collisions", "elastic", "--radius", "2")),
    "vanishing": ("uniform --points 40 --seed 4", 6, ("--collisions", "remove", "--radius", "1.5")),
    "accelerated": (accelerated_points(), 5, ()),
    "sizes": (sizes(), 6, ("--regular",)),
    "near": (near(), 8, ("--range", RANGE)),
    "crowd": (crowd(), 1, ("--range", 30)),
    "lattice": ("lattice --points 16 --movers all", 4, ()),
    "tracks": (TRACKS, 6, ()),
    "together": (TOGETHER, 8, ()),
    "square": (SQUARE, 1.5, ()),
    "passing": (PASSING, 1.75, ()),
    "touching": (TOUCHING, 2.5, ()),
    "cocircular": (COCIRCULAR, 2, ()),
    "triple": (TRIPLE, 2, ()),
    "wave": (None, 12, ("--columns", "6", "--rows", "5")),
    "thinned": ("uniform --points 130 --seed 6 --side 100", 330, ("--box", "0,0,100,100")),
}


class Event:
    def __init__(self, row):
        edge = lambda a, b: (int(row[a]), int(row[b])) if row[a] else None
        point = lambda name: int(row[name]) if row[name] else None
        self.number = int(row["event"])
        self.kind = row["kind"]
        self.time = tuple(float(row[name]) for name in ("time", "time_lo", "time_hi"))
        self.removed = edge("removed_a", "removed_b")
        self.added = edge("added_a", "added_b")
        self.points = [point("point_a"), point("point_b")]
        # Points that others hide, or hide no more, keep their motions.
        self.turns = [] if self.kind in ("hide", "reveal") else [p for p in self.points if p is not None]


class Run:
    """A run of the program in a folder: its page, and what its logs say."""

    def __init__(self, program, folder, name):
        source, self.until, options = RUNS[name]
        folder.mkdir(parents=True, exist_ok=True)
        self.page = folder / f"{name}.html"
        points = folder / f"{name}.csv"
        files = {option: folder / f"{name}.{option[2:]}.csv"
                 for option in ("--events", "--initial-edges", "--edges")}
        for file in (self.page, *files.values()):
            file.unlink(missing_ok=True)
        if source is not None and "," in source:
            points.write_text(source)
        elif source is not None:
            execute(program, "generate", *source.split(), "--output", points)
        command = {"tracks": "tracks", "together": "tracks", "wave": "wave"}.get(name, "simulate")
        inputs = [points] if source is not None else []
        outputs = [word for pair in files.items() for word in pair]
        execute(program, command, *inputs, "--until", self.until, *options, *outputs,
                "--html", self.page, "--quiet")
        self.motions = None
        if command == "simulate":
            with open(points, newline="", encoding="utf-8") as file:
                self.motions = [{key: float(value) for key, value in row.items()}
                                for row in csv.DictReader(file)]
        self.initial = read_edges(files["--initial-edges"])
        self.last = read_edges(files["--edges"])
        with open(files["--events"], newline="", encoding="utf-8") as file:
            self.events = [Event(row) for row in csv.DictReader(file)]

    def instants(self):
        """(time, number of events, edges) just after each time of events; equal times are one."""
        edges = set(self.initial)
        result = []
        for i, event in enumerate(self.events):
            if event.removed:
                edges.remove(event.removed)
            if event.added:
                edges.add(event.added)
            if i + 1 == len(self.events) or self.events[i + 1].time != event.time:
                result.append((event.time, i + 1, sorted(edges)))
        return result

    def exact_position(self, point, time):
        """The exact place of a point that never turned, and a bound for its evaluation in binary64:
        of the eight operations or less each errs by half a unit in the last place of what is at most
        the sum of the terms' magnitudes."""
        s = fractions.Fraction(time)
        motion = self.motions[point]
        place, bound = [], []
        for axis in "xy":
            terms = [fractions.Fraction(motion.get(prefix + axis, 0.0)) * s**k / math.factorial(k)
                     for k, prefix in enumerate(("", "v", "a", "j"))]
            place.append(sum(terms))
            bound.append(8 * HALF_ULP * (1 + 16 * HALF_ULP) * sum(map(abs, terms)))
        return place, bound

    def exact_radius(self, point, time):
        """The radius of a disc whose point never turned, where discs have sizes of their own."""
        radius, growth = sizes_of(self.motions[point])
        return radius + growth * fractions.Fraction(time)


def sizes_of(motion):
    return [fractions.Fraction(motion.get(name, 0.0)) for name in ("radius", "growth")]


def check_combinatorics(edges, triangles):
    """Whether the triangles are those of a triangulation with these edges, as far as that can be said
    without places: what is wrong, or an empty text."""
    sides = [(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)]
    points = {point for edge in edges for point in edge}
    if any(t[0] > min(t) for t in triangles) or sorted(map(tuple, triangles)) != list(map(tuple, triangles)):
        return "they are not in order"
    if len(set(sides)) != len(sides):
        return "two triangles are on the same side of an edge"
    if triangles and {tuple(sorted(side)) for side in sides} != set(edges):
        return "their sides are not the edges"
    if triangles and len(triangles) != len(edges) - len(points) + 1:
        return f"{len(triangles)} triangles of {len(points)} points with {len(edges)} edges"
    return ""


def is_delaunay(run, triangles, time):
    """Whether each triangle is counterclockwise at the time and has no point inside of its circle, or
    of its power circle: exactly, for points that never turned."""
    places = [run.exact_position(point, time)[0] for point in range(len(run.motions))]
    weights = [run.exact_radius(point, time) ** 2 for point in range(len(run.motions))]
    for a, b, c in triangles:
        for d, place in enumerate(places):
            rows = [[places[p][0] - place[0], places[p][1] - place[1], weights[p] - weights[d]]
                    for p in (a, b, c)]
            rows = [(x, y, x * x + y * y - w) for x, y, w in rows]
            if d in (a, b, c):
                continue
            (ux, uy, uu), (vx, vy, vv), (wx, wy, ww) = rows
            if uu * (vx * wy - vy * wx) + vv * (wx * uy - wy * ux) + ww * (ux * vy - uy * vx) > 0:
                return False
        (ax, ay), (bx, by), (cx, cy) = places[a], places[b], places[c]
        if (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) <= 0:
            return False
    return True


def polynomial(run, point, axis, origin):
    """A coordinate of a point that never turned, in s = t - origin: exact coefficients."""
    terms = [fractions.Fraction(run.motions[point].get(prefix + axis, 0.0)) / math.factorial(k)
             for k, prefix in enumerate(("", "v", "a", "j"))]
    shift = fractions.Fraction(origin)
    return [sum(c * math.comb(n, k) * shift ** (n - k) for n, c in enumerate(terms) if n >= k)
            for k in range(len(terms))]


def product(*factors):
    result = [fractions.Fraction(1)]
    for factor in factors:
        longer = [fractions.Fraction(0)] * (len(result) + len(factor) - 1)
        for i, a in enumerate(result):
            for j, b in enumerate(factor):
                longer[i + j] += a * b
        result = longer
    return result


def total(*terms):
    return [sum(values) for values in itertools.zip_longest(*terms, fillvalue=fractions.Fraction(0))]


def delaunay_polynomial(run, corners, origin):
    """Minus the determinant of the rows (x, y, x^2 + y^2 - w, 1) of four points, w being the square of
    the radius, in s = t - origin: exact coefficients, without zeros at the end."""
    rows = []
    for point in corners:
        x, y = (polynomial(run, point, axis, origin) for axis in "xy")
        radius, growth = sizes_of(run.motions[point])
        disc = [radius + growth * fractions.Fraction(origin), growth]
        lifted = total(product(x, x), product(y, y), product([fractions.Fraction(-1)], disc, disc))
        rows.append((x, y, lifted, [fractions.Fraction(1)]))
    result = []
    for order in itertools.permutations(range(4)):
        inversions = sum(order[i] > order[j] for i in range(4) for j in range(i + 1, 4))
        sign = [fractions.Fraction(-1 if inversions % 2 == 0 else 1)]
        result = total(result, product(sign, *(rows[i][order[i]] for i in range(4))))
    return without_zeros(result)


def without_zeros(coefficients):
    """The coefficients without zeros at the end."""
    count = len(coefficients)
    while count > 0 and coefficients[count - 1] == 0:
        count -= 1
    return coefficients[:count]


def sturm_sequence(polynomial):
    """The Sturm sequence of a polynomial that is not zero, by division of fractions."""
    terms = [polynomial]
    following = without_zeros([k * c for k, c in enumerate(polynomial)][1:])
    while following:
        terms.append(following)
        rest = list(terms[-2])
        while len(rest) >= len(following):
            factor = rest[-1] / following[-1]
            for k, c in enumerate(following):
                rest[len(rest) - len(following) + k] -= factor * c
            rest.pop()
        following = without_zeros([-c for c in rest])
    return terms


def signs(terms, s):
    """-1, 0 or 1 for each term at s, or, at infinity, after all roots."""
    values = [term[-1] if s == math.inf else sum(c * fractions.Fraction(s)**k for k, c in enumerate(term))
              for term in terms]
    return [(value > 0) - (value < 0) for value in values]


def execute(program, *words):
    command = [str(program), *map(str, words)]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}")


def read_edges(file):
    with open(file, newline="", encoding="utf-8") as lines:
        return [(int(row["a"]), int(row["b"])) for row in csv.DictReader(lines)]


def recording_of(page):
    """The JSON object in a page."""
    text = page.read_text(encoding="utf-8")
    start = text.index('id="recording">') + len('id="recording">')
    return json.loads(text[start:text.index("</script>", start)])


def numbers(text):
    """The binary64 numbers in base64."""
    data = base64.b64decode(text)
    return struct.unpack(f"<{len(data) // 8}d", data)


def with_recording(page, text, target):
    """Writes the page with another text in the place of its recording."""
    old = page.read_text(encoding="utf-8")
    start = old.index('id="recording">') + len('id="recording">')
    target.write_text(old[:start] + text + old[old.index("</script>", start):], encoding="utf-8")
