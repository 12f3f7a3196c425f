#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes an animated picture (SVG, without scripts) of a Delaunay triangulation whose points move.

usage: animation.py KINETRI OUTPUT

KINETRI is the program. It runs on points in a box whose velocities are such that all of them are at
their places again at the end, so that the picture repeats without a jump. The edges are those of the
program's own event log.
"""
import csv
import pathlib
import random
import subprocess
import sys
import tempfile

WIDTH, HEIGHT = 160, 72    # of the box
PERIOD = 64                # seconds, and the run's time; velocities are exact numbers in binary
MOVING = 17                # points; others rest at the sides of the box
SEED = 5
SCALE = 5                  # pixels for a unit of length
MARGIN = 14                # pixels
LINE = 16                  # pixels, height of the line of time below the box
AHEAD, AFTER = 0.4, 0.8    # seconds in which a flip is marked before and after it
EDGE, ADDED, REMOVED, POINT = "#8b95a1", "#1f86e8", "#ec6a2c", "#6b7683"


class Coordinate:
    """A coordinate that runs from one side of the box to the other and back, `turns` times in the
    period; 0: it rests."""

    def __init__(self, length, start, turns):
        self.length = length
        self.start = start
        self.velocity = 2 * length * turns / PERIOD

    def at(self, time):
        place = (self.start + self.velocity * time) % (2 * self.length)
        return min(place, 2 * self.length - place)

    def turning_times(self):
        """When it is at a side of the box."""
        if self.velocity == 0:
            return []
        sides = range(-2 * PERIOD, 2 * PERIOD + 1)
        times = [(side * self.length - self.start) / self.velocity for side in sides]
        return sorted(time for time in times if 0 < time < PERIOD)


def make_points():
    """Points at rest on the sides of the box, and moving ones that begin at a distance from each
    other."""
    corners = [(x, y) for x in (0, WIDTH) for y in (0, HEIGHT)]
    sides = [(x, y) for x, y in ((38, 0), (83, 0), (121, 0), (47, HEIGHT), (92, HEIGHT), (128, HEIGHT),
                                 (0, 33), (WIDTH, 39))]
    points = [(Coordinate(WIDTH, x, 0), Coordinate(HEIGHT, y, 0)) for x, y in corners + sides]
    numbers = random.Random(SEED)
    while len(points) < len(corners + sides) + MOVING:
        start = [round(numbers.uniform(0.05, 0.95) * length * 8) / 8 for length in (WIDTH, HEIGHT)]
        turns = numbers.choice([(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1)])
        if all(abs(start[0] - x.start) + abs(start[1] - y.start) > 13 for x, y in points):
            points.append((Coordinate(WIDTH, start[0], turns[0]),
                           Coordinate(HEIGHT, start[1], turns[1])))
    return points


def simulate(program, points):
    """(edges at the start, events as (time, removed edge or None, added edge or None))."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        rows = [f"{x.start!r},{y.start!r},{x.velocity!r},{y.velocity!r}" for x, y in points]
        (folder / "points.csv").write_text("\n".join(["x,y,vx,vy", *rows]) + "\n", encoding="utf-8")
        subprocess.run([program, "simulate", folder / "points.csv", "--until", str(PERIOD), "--box",
                        f"0,0,{WIDTH},{HEIGHT}", "--events", folder / "events.csv", "--initial-edges",
                        folder / "edges.csv", "--audit", "end", "--quiet"], check=True)
        edge = lambda row, a, b: (int(row[a]), int(row[b])) if row[a] else None
        with open(folder / "edges.csv", newline="", encoding="utf-8") as file:
            edges = [edge(row, "a", "b") for row in csv.DictReader(file)]
        with open(folder / "events.csv", newline="", encoding="utf-8") as file:
            events = [(float(row["time"]), edge(row, "removed_a", "removed_b"),
                       edge(row, "added_a", "added_b")) for row in csv.DictReader(file)]
    return edges, events


def lifetimes(edges, events):
    """The intervals of time in which each edge is there: {edge: [(begin, end), ...]}. None for an end
    that is not an event."""
    begins = dict.fromkeys(edges)
    result = {}
    for time, removed, added in events:
        if removed:
            result.setdefault(removed, []).append((begins.pop(removed), time))
        if added:
            begins[added] = time
    if sorted(begins) != sorted(edges):
        sys.exit("animation.py: the edges at the end are not those at the start; take another SEED")
    for edge, begin in begins.items():
        result.setdefault(edge, []).append((begin, None))
    return {edge: [life for life in lives if life[0] != life[1]] for edge, lives in result.items()}


def number(value):
    return f"{value:.1f}".removesuffix(".0")


def animation(attribute, keys):
    """An <animate> through (time, value), linear in between; nothing if the value is constant."""
    values = [value if isinstance(value, str) else number(value) for _, value in keys]
    if len(set(values)) == 1:
        return ""
    times = ";".join(f"{time / PERIOD:.5f}".rstrip("0").rstrip(".") or "0" for time, _ in keys)
    return (f'<animate attributeName="{attribute}" dur="{PERIOD}s" repeatCount="indefinite" '
            f'keyTimes="{times}" values="{";".join(values)}"/>')


def place(coordinate, pixel):
    """The keys of a coordinate, on the picture."""
    times = [0, *coordinate.turning_times(), PERIOD]
    return [(time, pixel(coordinate.at(time))) for time in times]


def pixel_x(x):
    return MARGIN + SCALE * x


def pixel_y(y):
    return MARGIN + SCALE * (HEIGHT - y)


def style(lives):
    """Keys of the color, width and opacity of an edge: it comes in one color and goes in another."""
    color, width, opacity = [], [], []
    if lives[0][0] is not None:
        opacity += [(0, "0"), (lives[0][0], "0")]
    for begin, end in lives:
        first = 0 if begin is None else begin
        last = PERIOD if end is None else end
        if opacity and begin is not None and opacity[-1][0] < first:
            opacity.append((first, "0"))
        opacity += [(first, "1"), (last, "1")]
        middle = (first + last) / 2
        quiet = [min(first + AFTER, middle), max(last - AHEAD, middle)]
        color.append((first, EDGE if begin is None else ADDED))
        width.append((first, 1.3 if begin is None else 3.6))
        color += [(time, EDGE) for time in quiet]
        width += [(time, 1.3) for time in quiet]
        color.append((last, EDGE if end is None else REMOVED))
        width.append((last, 1.3 if end is None else 2.6))
        if end is not None:
            opacity.append((last, "0"))
    if lives[-1][1] is not None:
        opacity.append((PERIOD, "0"))
    return [whole(keys) for keys in (color, width, opacity)]


def whole(keys):
    """From the start to the end."""
    keys = [(0, keys[0][1])] * (keys[0][0] > 0) + keys
    return keys + [(PERIOD, keys[-1][1])] * (keys[-1][0] < PERIOD)


def picture(points, edges, events):
    width, height = 2 * MARGIN + SCALE * WIDTH, 2 * MARGIN + SCALE * HEIGHT + LINE
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
             f'width="{width}" height="{height}" role="img">',
             '<!-- SPDX-License-Identifier: GPL-3.0-or-later -->',
             '<title>A Delaunay triangulation whose points move: edges that have just come are blue, '
             'edges that are about to go are orange</title>',
             f'<g stroke="{EDGE}" stroke-width="1.3" stroke-linecap="round">']
    for (a, b), lives in sorted(lifetimes(edges, events).items()):
        if not lives:
            continue
        ends = [(f"x{k}", place(points[p][0], pixel_x)) for k, p in ((1, a), (2, b))]
        ends += [(f"y{k}", place(points[p][1], pixel_y)) for k, p in ((1, a), (2, b))]
        at = " ".join(f'{name}="{number(keys[0][1])}"' for name, keys in ends)
        shown = "" if lives[0][0] is None else ' opacity="0"'
        color, thickness, opacity = style(lives)
        lines.append(f"<line {at}{shown}>" + "".join(animation(*end) for end in ends) +
                     animation("stroke", color) + animation("stroke-width", thickness) +
                     animation("opacity", opacity) + "</line>")
    lines.append(f'</g><g fill="{POINT}">')
    for x, y in points:
        keys = {"cx": place(x, pixel_x), "cy": place(y, pixel_y)}
        at = " ".join(f'{name}="{number(value[0][1])}"' for name, value in keys.items())
        lines.append(f'<circle {at} r="4.2">' +
                     "".join(animation(*item) for item in keys.items()) + "</circle>")
    lines.append("</g>")
    lines += line_of_time(events, width, height)
    return "\n".join([*lines, "</svg>"]) + "\n"


def line_of_time(events, width, height):
    """A mark for each time of a flip, and a pointer to the present."""
    at = lambda time: MARGIN + (width - 2 * MARGIN) * time / PERIOD
    bottom = height - MARGIN / 2
    marks = "".join(f"M{number(at(time))} {number(bottom - 9)}v7"
                    for time in sorted({time for time, removed, added in events if removed or added}))
    pointer = animation("x", [(0, at(0) - 1.5), (PERIOD, at(PERIOD) - 1.5)])
    return [f'<path d="{marks}" stroke="{EDGE}" stroke-width="1.2" opacity="0.7"/>',
            f'<rect x="{number(at(0) - 1.5)}" y="{number(bottom - 12)}" width="3" height="13" rx="1.5" '
            f'fill="{ADDED}">{pointer}</rect>']


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    points = make_points()
    try:
        edges, events = simulate(sys.argv[1], points)
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"animation.py: {error}")
    pathlib.Path(sys.argv[2]).write_text(picture(points, edges, events), encoding="utf-8")


if __name__ == "__main__":
    main()
