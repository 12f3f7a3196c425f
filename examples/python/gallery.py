#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of the gallery that matplotlib draws.

usage: gallery.py FOLDER
"""
import pathlib
import sys

import matplotlib
import numpy as np
from crowd_density import CORRIDOR, FRAMES_PER_SECOND, recording

import kinetri

matplotlib.use("Agg")  # files, no windows
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402


def discs(ax):
    """Discs of two sizes that collide, and their regular triangulation."""
    box = kinetri.Simulation(**kinetri.packing(90, share=0.7, sizes=2.5, seed=1), rim=True,
                             collisions="elastic", mass="area")
    box.advance_to(3)
    box.plot(ax)


def polygon(cell, far=1000):
    """The vertices of a Voronoi cell; of an unbounded one, up to points far away."""
    if cell.rays is None:
        return cell.vertices
    return np.vstack((cell.vertices[0] + far * cell.rays[0], cell.vertices,
                      cell.vertices[-1] + far * cell.rays[1]))


def crowd(ax):
    """The crowd of crowd_density.py: the Voronoi cells, colored by density."""
    table = recording()
    tracks = kinetri.Tracks.from_arrays(table["frame"] / FRAMES_PER_SECOND, table["person"], table["x"],
                                        table["y"])
    walk = tracks.simulation()
    walk.advance_to(25)
    ids = walk.ids
    cells = PolyCollection([polygon(walk.voronoi_cell(id)) for id in ids], cmap="YlOrRd", edgecolors="white",
                           array=1 / walk.voronoi_areas(CORRIDOR)[ids], clim=(0, 3))
    ax.add_collection(cells)
    outline = ax.fill(*CORRIDOR.T, facecolor="none", edgecolor="0.3")[0]
    cells.set_clip_path(outline)
    ax.scatter(*walk.positions()[ids].T, s=8, color="0.2")
    ax.set(aspect="equal", xlabel="meters", xlim=(-0.5, 20.5), ylim=(-0.5, 4.5))
    ax.figure.colorbar(cells, ax=ax, label="people a square meter", shrink=0.6)


def shock(ax):
    """A piston of discs runs into a row of columns: where and when discs collide, and edges flip."""
    rng = np.random.default_rng(1)
    columns, rows = np.meshgrid(np.arange(70), np.arange(6))
    positions = np.column_stack((columns.ravel(), rows.ravel())) + rng.uniform(-0.2, 0.2, (420, 2))
    velocities = np.zeros((420, 2))
    velocities[columns.ravel() < 4, 0] = 1.5
    gas = kinetri.Simulation(positions, velocities, radius=0.3, collisions="elastic",
                             box=(-0.6, -0.6, 69.6, 5.6), rim=True)
    seen = {"flip": [], "collision": []}
    for event in gas.events(until=40):
        if event.kind in seen:
            id = event.points[0] if event.points else event.removed[0]
            motion = gas.motion(id)
            time = float(event.time)
            x = motion["position"][0] + motion["velocity"][0] * (time - motion["epoch"])
            seen[event.kind].append((x, time))
    for kind, places in seen.items():
        ax.scatter(*np.transpose(places), s=3, color=kinetri.event_colors[kind], label=f"{kind}s", linewidths=0)
    ax.set(xlabel="x", ylabel="time")
    ax.legend(loc="lower right", markerscale=4)


def main():
    folder = pathlib.Path(sys.argv[1])
    for file, draw, size in (("python_discs.svg", discs, (6, 6)), ("python_crowd.svg", crowd, (9, 3)),
                             ("python_shock.png", shock, (8, 4.5))):
        figure, ax = pyplot.subplots(figsize=size, layout="constrained")
        draw(ax)
        figure.savefig(folder / file, dpi=80)


if __name__ == "__main__":
    main()
