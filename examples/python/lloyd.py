# SPDX-License-Identifier: GPL-3.0-or-later
"""Lloyd's relaxation: each point moves to the centroid of its Voronoi cell, until the cells are about equal."""
import numpy as np

import kinetri


def border_of_square(number):
    """Points on the sides of the unit square, `number` on each."""
    along = np.arange(number) / number
    zeros, ones = np.zeros(number), np.ones(number)
    return np.concatenate([np.column_stack(side) for side in (
        (along, zeros), (ones, along), (1 - along, ones), (zeros, 1 - along))])


def centroid(polygon):
    """The centroid of a polygon, counterclockwise."""
    x, y = polygon.T
    next_x, next_y = np.roll(x, -1), np.roll(y, -1)
    cross = x * next_y - next_x * y
    return np.array([(x + next_x) @ cross, (y + next_y) @ cross]) / (3 * cross.sum())


def main():
    border = border_of_square(12)
    inner = np.random.default_rng(1).uniform(0.05, 0.95, (100, 2))
    places = np.concatenate([border, inner])
    points = kinetri.KineticDelaunay(places, np.zeros_like(places))
    moving = np.arange(len(border), len(places))
    print("steps  least area  greatest area  longest move")
    for step in range(41):
        centroids = np.array([centroid(points.voronoi_cell(i).vertices) for i in moving])
        if step % 10 == 0:
            areas = points.voronoi_areas((0, 0, 1, 1))[moving]
            moves = np.hypot(*(centroids - points.positions()[moving]).T)
            print(f"{step:5d} {areas.min():11.4f} {areas.max():14.4f} {moves.max():13.4f}")
        points.set_positions(moving, centroids)
    print("audit passed:", bool(points.audit()))


if __name__ == "__main__":
    main()
