#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A tessellation over time as a block: on the top the Voronoi cells at the end, on the two sides what two sides of
the box cut out of the cells at each time before. Time goes up. A cell has one color everywhere.

usage: space_time.py PICTURE.png
"""
import sys

import matplotlib
import numpy as np
from scipy.spatial import cKDTree

import kinetri

matplotlib.use("Agg")  # files, no windows
from matplotlib import pyplot  # noqa: E402
from matplotlib.transforms import Affine2D  # noqa: E402

SIDE, SECONDS, PIXELS = 100.0, 16.0, 700
PALETTE = ["#0b3c5d", "#126e82", "#2fa4a0", "#8ccfb3", "#e8e6c9", "#f2b872", "#d96c3f", "#8f2d3f"]
BORDER = "#fdfdfe"


def face(cells, shade):
    """A picture of the cells whose numbers are in the array: pale lines where two meet, else their colors."""
    colors = np.array([matplotlib.colors.to_rgb(PALETTE[i % len(PALETTE)]) for i in range(cells.max() + 1)])
    picture = shade * colors[cells]
    border = np.zeros(cells.shape, bool)
    for axis in (0, 1):
        differs = np.diff(cells, axis=axis) != 0
        border |= np.pad(differs, [(0, 1) if k == axis else (0, 0) for k in (0, 1)])
    picture[border] = shade * np.array(matplotlib.colors.to_rgb(BORDER))
    return np.clip(picture, 0, 1)


def main():
    positions, velocities = kinetri.scenario("uniform", 70, seed=11, side=SIDE, speed=5)
    box = kinetri.Simulation(positions, velocities, box=(0, 0, SIDE, SIDE))
    along = (np.arange(PIXELS) + 0.5) * SIDE / PIXELS
    front, right = [], []
    for time in np.linspace(0, SECONDS, PIXELS):
        box.advance_to(time)
        nearest = cKDTree(box.positions())
        front.append(nearest.query(np.column_stack((along, np.zeros(PIXELS))))[1])
        right.append(nearest.query(np.column_stack((np.full(PIXELS, SIDE), along)))[1])
    x, y = np.meshgrid(along, along)
    top = nearest.query(np.column_stack((x.ravel(), y.ravel())))[1].reshape(PIXELS, PIXELS)

    # Where a step in x, in y and in time goes on the picture.
    by_x, by_y, by_time = np.array([0.87, -0.36]), np.array([0.62, 0.46]), np.array([0.0, 0.95])
    figure = pyplot.figure(figsize=(9, 8), dpi=90, facecolor=BORDER)
    ax = figure.add_axes((0.03, 0.03, 0.94, 0.94))
    for cells, first, second, corner, shade in (
            (np.array(front), by_x, by_time, 0 * by_x, 0.92),
            (np.array(right), by_y, by_time, by_x, 0.74),
            (top, by_x, by_y, by_time, 1.0)):
        place = Affine2D(np.array([[*np.column_stack((first, second))[0], corner[0]],
                                   [*np.column_stack((first, second))[1], corner[1]], [0, 0, 1]]))
        ax.imshow(face(cells, shade), origin="lower", extent=(0, 1, 0, 1), interpolation="antialiased",
                  transform=place + ax.transData)
    start = 0 * by_x - np.array([0.045, 0])
    ax.annotate("", start + by_time, start, arrowprops={"arrowstyle": "->", "color": "#5a6675"})
    ax.text(*(start + by_time / 2 - np.array([0.025, 0])), "time", rotation=90, ha="right", va="center",
            color="#5a6675", fontsize=13)
    ax.set(xlim=(-0.12, 1.53), ylim=(-0.40, 1.45), aspect="equal")
    ax.axis("off")
    figure.savefig(sys.argv[1])


if __name__ == "__main__":
    main()
