# SPDX-License-Identifier: GPL-3.0-or-later
"""People walk through a bottleneck: how dense the crowd is, by Voronoi cells, and who came near whom."""
import numpy as np
import pandas as pd

import kinetri

# The corridor, in meters: 20 long, 4 wide, and 2 wide from x = 10 to x = 14. It need not be convex.
CORRIDOR = np.array([[0, 0], [9, 0], [10, 1], [14, 1], [15, 0], [20, 0],
                     [20, 4], [15, 4], [14, 3], [10, 3], [9, 4], [0, 4]])
FRAMES_PER_SECOND = 2


def recording(people=60, seed=5):
    """An invented recording as a table: frame, person, x, y. People in the bottleneck walk slowly."""
    rng = np.random.default_rng(seed)
    rows = []
    for person in range(people):
        begin = 0.5 * person + rng.uniform(0, 0.4)
        speed = rng.uniform(1.2, 1.4)
        slow = 0.5 * speed
        lane = rng.uniform(-1.6, 1.6)
        # The times at which the person is at x = 0, 9, 15 and 20.
        at = begin + np.cumsum([0, 9 / speed, 6 / slow, 5 / speed])
        frames = np.arange(np.ceil(at[0] * FRAMES_PER_SECOND), at[3] * FRAMES_PER_SECOND)
        x = np.interp(frames / FRAMES_PER_SECOND, at, [0, 9, 15, 20])
        y = 2 + lane * np.interp(x, [0, 9, 10, 14, 15, 20], [1, 1, 0.5, 0.5, 1, 1])
        rows.append(pd.DataFrame({"frame": frames.astype(int), "person": f"P{person:02d}", "x": x, "y": y}))
    return pd.concat(rows, ignore_index=True)


def densities(tracks, frames):
    """A row for each person and frame: the position, and the density, 1 over the area of the own cell."""
    walk = tracks.simulation()
    rows = []
    for frame in frames:
        walk.advance_to(frame / FRAMES_PER_SECOND)
        ids = walk.ids
        x, y = walk.positions()[ids].T
        rows.append(pd.DataFrame({
            "frame": frame, "person": [walk.label(id) for id in ids], "x": x, "y": y,
            "density": 1 / walk.voronoi_areas(CORRIDOR)[ids]}))
    return pd.concat(rows, ignore_index=True)


def main():
    table = recording()
    print(table.head(3).to_string(index=False))
    table["t"] = table["frame"] / FRAMES_PER_SECOND
    tracks = kinetri.Tracks.from_dataframe(table, id="person")
    print(tracks)

    density = densities(tracks, range(10, 71, 10))
    density["where"] = pd.cut(density["x"], [0, 9, 15, 20], labels=["before", "bottleneck", "after"])
    print("people a square meter, mean of the persons there:")
    means = density.groupby(["frame", "where"])["density"].mean().unstack()
    print(means.round(2).rename_axis(columns=None).reset_index().to_string(index=False))
    print("the most:")
    print(density.nlargest(1, "density").round(2).to_string(index=False))

    print("closest approaches, between the frames too:")
    print(tracks.closest(3)[["a", "b", "time", "distance"]].round(4).to_string(index=False))


if __name__ == "__main__":
    main()
