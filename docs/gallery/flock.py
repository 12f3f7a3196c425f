#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracks of the flock of examples/python/flock.py, which is steered live, ten times a second: each bird looks at
its neighbors in the triangulation. Between two of these times birds fly straight on, as tracks do.

usage: flock.py > flock.csv
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples" / "python"))
from flock import STEP, steer  # noqa: E402

import kinetri  # noqa: E402


def main():
    positions, velocities = kinetri.scenario("constant-speed", 120, seed=4, side=60, speed=5)
    flock = kinetri.KineticDelaunay(positions - 30, velocities)
    print("t,id,x,y")
    for step in range(101):
        for bird, (x, y) in zip(flock.ids, flock.positions()):
            print(f"{step * STEP:.1f},{bird},{x:.3f},{y:.3f}")
        flock.set_velocities(flock.ids, steer(flock, flock.velocities()))
        flock.advance_to((step + 1) * STEP)


if __name__ == "__main__":
    main()
