# SPDX-License-Identifier: GPL-3.0-or-later
"""Closest approaches of discs, against all pairs in exact arithmetic."""
import decimal
from fractions import Fraction

import numpy as np
import pytest

import kinetri

decimal.getcontext().prec = 60


def nearest(p, q, radii, until):
    """The first time at which two discs on straight lines are nearest, and the gap there, to 60 digits."""
    place = [Fraction(a) - Fraction(b) for a, b in zip(p[0], q[0])]
    speed = [Fraction(a) - Fraction(b) for a, b in zip(p[1], q[1])]
    square = sum(v * v for v in speed)
    time = Fraction(0) if square == 0 else -sum(x * v for x, v in zip(place, speed)) / square
    time = min(max(time, Fraction(0)), Fraction(until))
    squared = sum((x + v * time) ** 2 for x, v in zip(place, speed))
    distance = (decimal.Decimal(squared.numerator) / decimal.Decimal(squared.denominator)).sqrt()
    return time, distance - sum(decimal.Decimal(r) for r in radii)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("sizes", ["points", "equal", "different"])
def test_the_first_is_the_closest_of_all_pairs(seed, sizes):
    rng = np.random.default_rng(seed)
    n, until = 9, 4.0
    positions = rng.uniform(0, 20, (n, 2))
    velocities = rng.uniform(-2, 2, (n, 2))
    radius = {"points": None, "equal": np.full(n, 0.375), "different": rng.uniform(0.01, 2, n)}[sizes]
    sim = kinetri.Simulation(positions, velocities, radius=radius,
                             collisions=None if sizes == "points" else "log")
    table = sim.closest(3, until=until)
    assert sim.time == until and len(table) == 3
    assert ("gap" in table) == (sizes != "points")
    radii = np.zeros(n) if radius is None else radius
    pairs = {(a, b): nearest((positions[a], velocities[a]), (positions[b], velocities[b]),
                             (radii[a], radii[b]), until) for b in range(n) for a in range(b)}
    first = min(pairs, key=lambda pair: (pairs[pair][1], pairs[pair][0], pair))
    assert (table["a"][0], table["b"][0]) == first
    for row in table.itertuples():
        time, gap = pairs[row.a, row.b]
        assert row.time_lo <= time <= row.time_hi and row.time == float(time)
        if sizes != "points":
            assert row.gap == float(gap)
        assert row.distance == float(gap + sum(decimal.Decimal(r) for r in (radii[row.a], radii[row.b])))


def test_tracks_with_radii_have_gaps_and_labels():
    tracks = kinetri.Tracks.from_arrays([0, 4, 0, 4, 0, 4], list("aabbcc"), [0, 4, 4, 0, 9, 9],
                                        [0, 0, 3, 3, 1, 1], radius=[1, 1, 0.5, 0.5, 4, 4])
    table = tracks.closest(2)
    root = decimal.Decimal(26).sqrt()
    assert table[["a", "b", "gap"]].values.tolist()[0] == ["a", "c", float(root - 5)]
    assert tracks.closest(1)["distance"][0] == float(root)


def test_discs_of_any_size_need_no_response():
    sim = kinetri.Simulation([[0, 0], [9, 0]], [[1, 0], [0, 0]], radius=[1, 2])
    assert sim.closest(1, until=1)[["a", "b", "time", "gap"]].values.tolist() == [[0, 1, 1, 5]]
    log = kinetri.Simulation([[0, 0], [9, 0]], [[1, 0], [0, 0]], radius=[1, 2], collisions="log")
    with pytest.raises(kinetri.PreconditionError, match="number is 0"):
        log.closest(0, until=1)
