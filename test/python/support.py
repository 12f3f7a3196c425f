# SPDX-License-Identifier: GPL-3.0-or-later
"""What several files of tests need."""
import os
import pathlib
import subprocess
from fractions import Fraction

import numpy as np
from hypothesis import HealthCheck, settings

import kinetri

#: Settings of every test with hypothesis: the same examples in each run.
few = settings(derandomize=True, deadline=None, database=None, max_examples=60,
               suppress_health_check=list(HealthCheck))

#: Whose files the package's results are compared with.
PROGRAM = os.environ.get("KINETRI_PROGRAM")


def uniform(n, seed, side=100.0, speed=5.0):
    """Places in a square and velocities, at random."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0, side, (n, 2)), rng.uniform(-speed, speed, (n, 2))


def run_program(*arguments, directory):
    """Runs the program, which must succeed, in a directory."""
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=directory, check=True, timeout=60,
                          capture_output=True, text=True)


def write_points(path, **columns):
    """A points file with these columns, numbers in full."""
    rows = zip(*[np.asarray(values, dtype=float).tolist() for values in columns.values()])
    lines = [",".join(columns)] + [",".join(map(repr, row)) for row in rows]
    pathlib.Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")


def trajectory(motion):
    """Of a `motion()`, the coefficients in t of x, y and the weight, in fractions."""
    def of_time(coefficients):
        result = []
        for factor in reversed(coefficients):  # by Horner's rule, in t - epoch
            shifted = [Fraction(0), *result]
            result = [a - Fraction(motion["epoch"]) * b for a, b in zip(shifted, [*result, Fraction(0)])]
            result[0] += Fraction(factor)
        return result

    radius, growth, weight = (Fraction(motion[name]) for name in ("radius", "growth", "weight"))
    return [of_time([motion["position"][i], motion["velocity"][i], Fraction(motion["acceleration"][i]) / 2,
                     Fraction(motion["jerk"][i]) / 6]) for i in (0, 1)] + [
        of_time([radius**2 + weight, 2 * radius * growth, growth**2])]


def nearest_of_all_pairs(points, k):
    """The ids of the k nearest by integers, at a time at which positions are small integers."""
    places = {id: points.positions()[id].astype(int).tolist() for id in points.ids.tolist()}
    rows = np.full((points.next_id, k), kinetri.NO_POINT, dtype=np.uint32)
    for id, (x, y) in places.items():
        others = sorted(((x - p)**2 + (y - q)**2, other) for other, (p, q) in places.items() if other != id)
        rows[id, :len(others)] = [other for _, other in others][:k]
    return rows


def edge_set(edges):
    """The edges as a set of pairs."""
    return {tuple(edge) for edge in edges.tolist()}
