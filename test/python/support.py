# SPDX-License-Identifier: GPL-3.0-or-later
"""What several files of tests need."""
import os
import pathlib
import subprocess

import numpy as np
from hypothesis import HealthCheck, settings

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


def edge_set(edges):
    """The edges as a set of pairs."""
    return {tuple(edge) for edge in edges.tolist()}
