# SPDX-License-Identifier: GPL-3.0-or-later
"""Points in periodic boxes, exactly: what several files of tests need."""
import math
from fractions import Fraction

import numpy as np

import kinetri

BOXES = [
    kinetri.Box((6, 5)),
    kinetri.Box([[6, 1], [-2, 5]]),
    kinetri.Box.shear(5, 4, 0.5),
    kinetri.Box((4, 6), rates=(0.25, -0.5)),
    kinetri.Box([5, 0], [1, 4], rates=[[0.5, 0.25], [-0.25, 0.5]], epoch=1),
]


def triangulation(n, seed, box, spread=12):
    rng = np.random.default_rng(seed)
    return kinetri.KineticDelaunay(rng.integers(-spread, spread, (n, 2)), rng.integers(-3, 4, (n, 2)), box=box)


def exact(kd):
    """At the present time, a fraction: the positions by id, and the lattice vectors, in fractions."""
    now = kd.time.fraction
    places = {}
    for id in kd.ids.tolist():
        motion = kd.motion(id)
        since = now - Fraction(motion["epoch"])
        places[id] = [Fraction(p) + Fraction(v) * since for p, v in zip(motion["position"], motion["velocity"])]
    since = now - Fraction(kd.box.epoch)
    lattice = [[Fraction(x) + Fraction(r) * since for x, r in zip(*rows)] for rows in zip(
        kd.box.vectors.tolist(), kd.box.rates.tolist())]
    return places, lattice


def image(place, offset, lattice):
    return [p + int(offset[0]) * a + int(offset[1]) * b for p, a, b in zip(place, *lattice)]


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def minus(a, b):
    return [a[0] - b[0], a[1] - b[1]]


def edges_of(kd):
    """The edges with offsets, as they are named."""
    return [(*ids, *by) for ids, by in zip(kd.edges().tolist(), kd.edge_offsets().tolist())]


def named(a, b, k, l):
    """The name of an edge: the smaller id first, of an edge from a point to its image the greater offset."""
    return max((a, b, k, l), (b, a, -k, -l)) if a == b else (a, b, k, l) if a < b else (b, a, -k, -l)


def integers(kd, others=()):
    """The same times a common denominator; and other positions times it."""
    places, lattice = exact(kd)
    others = [[Fraction(x) for x in row] for row in others]
    scale = math.lcm(*(x.denominator for row in [*places.values(), *lattice, *others] for x in row))

    def whole(row):
        return [int(x * scale) for x in row]

    return {id: whole(row) for id, row in places.items()}, [whole(row) for row in lattice], [
        whole(row) for row in others]


def nearest_copy(place, other, lattice):
    """About how often the vectors must be added to a place to come to another one."""
    away, area = minus(other, place), cross(*lattice)
    return cross(away, lattice[1]) // area, cross(lattice[0], away) // area
