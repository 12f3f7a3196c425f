# SPDX-License-Identifier: GPL-3.0-or-later
"""One file of the corpus, and ways to place points."""
import dataclasses


@dataclasses.dataclass
class Case:
    name: str
    title: str  # one line: what it is
    why: list  # further lines: why it is hard
    points: list  # (x, y, vx, vy) at time 0
    until: float | None = None
    events: int | None = None


def at(time, points):
    """The points, at time 0, that are at these places at `time`."""
    return [(x - vx * time, y - vy * time, vx, vy) for x, y, vx, vy in points]


def moved(points, dx, dy):
    return [(x + dx, y + dy, vx, vy) for x, y, vx, vy in points]


def resting(places):
    return [(x, y, 0, 0) for x, y in places]


def lattice(width, height, velocity=lambda x, y: (0, 0)):
    """The integer lattice, row by row; `velocity` is a function of the place."""
    return [(x, y, *velocity(x, y)) for y in range(height) for x in range(width)]


# The integer points of the circle of radius 5, counterclockwise.
RING = [(5, 0), (4, 3), (3, 4), (0, 5), (-3, 4), (-4, 3),
        (-5, 0), (-4, -3), (-3, -4), (0, -5), (3, -4), (4, -3)]


def kite(top, speed, bottom=1, width=1):
    """Three resting points, and one that falls from (0, top): it enters their circle at the height
    width^2 / bottom, where the long diagonal replaces the short one."""
    return resting([(-width, 0), (0, -bottom), (width, 0)]) + [(0, top, 0, -speed)]
