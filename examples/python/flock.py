# SPDX-License-Identifier: GPL-3.0-or-later
"""A flock: each bird looks at its neighbors in the triangulation and steers, ten times a second."""
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

import kinetri

SIGHT = 15.0  # meters: neighbors farther away are not seen
NEAR = 2.0  # meters: the least comfortable distance
SLOWEST, FASTEST = 4.0, 8.0  # meters per second
STEP = 0.1  # seconds


def seen(flock):
    """Who sees whom: for each edge that is short enough, both directions, and the vector from a to b."""
    places = flock.positions()
    edges = flock.edges()
    vectors = places[edges[:, 1]] - places[edges[:, 0]]
    edges = edges[np.sqrt((vectors**2).sum(axis=1)) < SIGHT]
    a = np.concatenate((edges[:, 0], edges[:, 1]))
    b = np.concatenate((edges[:, 1], edges[:, 0]))
    return a, b, places[b] - places[a]


def sums(birds, values, size):
    """The sum of the rows of each bird."""
    return np.column_stack([np.bincount(birds, column, size) for column in values.T])


def steer(flock, velocities):
    """The new velocities: as the neighbors fly, toward them, not too near, and toward the field."""
    a, b, vectors = seen(flock)
    places = flock.positions()
    size = len(places)
    number = np.maximum(np.bincount(a, minlength=size), 1)[:, None]
    distances = np.sqrt((vectors**2).sum(axis=1))[:, None]
    align = sums(a, velocities[b] - velocities[a], size) / number
    gather = sums(a, vectors, size) / number
    part = -sums(a, vectors / distances * np.maximum(NEAR - distances, 0), size)
    home = -places * (np.sqrt((places**2).sum(axis=1))[:, None] > 60)
    velocities = velocities + STEP * (4.0 * align + 0.3 * gather + 8.0 * part + 0.02 * home)
    speeds = np.sqrt((velocities**2).sum(axis=1))[:, None]
    return velocities * (np.clip(speeds, SLOWEST, FASTEST) / speeds)


def order(velocities):
    """1 if all birds fly in one direction, about 0 if each flies in its own."""
    directions = velocities / np.sqrt((velocities**2).sum(axis=1))[:, None]
    return np.sqrt((directions.mean(axis=0) ** 2).sum())


def groups(flock):
    """The number of groups that do not see one another."""
    a, b, _ = seen(flock)
    size = flock.next_id
    return connected_components(coo_array((np.ones(len(a)), (a, b)), shape=(size, size)))[0]


def report(seconds, events, flock, velocities):
    nearest = flock.nearest_neighbors().distances.min()
    print(f"{seconds:7.0f} {events:>7} {order(velocities):6.2f} {groups(flock):7d} {nearest:8.2f}")


def main():
    positions, velocities = kinetri.scenario("constant-speed", 200, seed=4, side=60, speed=5)
    flock = kinetri.KineticDelaunay(positions - 30, velocities)
    print("seconds  events  order  groups  nearest")
    events = 0
    for step in range(121):
        if step % 20 == 0:
            report(step * STEP, events, flock, flock.velocities())
        flock.set_velocities(steer(flock, flock.velocities()))
        events += flock.advance_to((step + 1) * STEP)
    print("audit passed:", bool(flock.audit()))

    # The same flock, if only the triangulation after each step is of interest.
    flock = kinetri.KineticDelaunay(positions - 30, np.zeros_like(positions))
    for _ in range(120):
        velocities = steer(flock, velocities)
        flock.set_positions(flock.positions() + STEP * velocities)
    report(120 * STEP, "-", flock, velocities)
    print("audit passed:", bool(flock.audit()))


if __name__ == "__main__":
    main()
