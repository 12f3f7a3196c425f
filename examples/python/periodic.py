# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear of a periodic box: particles move along with it, and exchange neighbors."""
import numpy as np

import kinetri

SIDE, RATE = 10.0, 0.5
SIZE = 100


def distances(kd):
    """The length of each edge, in the image that is the neighbor."""
    a, b = kd.edges().T
    places = kd.positions()
    vectors = places[b] + kd.edge_offsets() @ kd.box.vectors_at(kd.time) - places[a]
    return np.sqrt((vectors**2).sum(axis=1))


def main():
    places = np.random.default_rng(1).uniform(0, SIDE, (SIZE, 2))
    velocities = np.column_stack((RATE * places[:, 1], np.zeros(SIZE)))  # each moves with the box
    kd = kinetri.KineticDelaunay(places, velocities, box=kinetri.Box.shear(SIDE, SIDE, RATE))

    print("strain  exchanges  edges  mean distance  farthest out")
    exchanges = 0
    for strain in (0.0, 0.25, 0.5, 0.75, 1.0):
        exchanges += kd.advance_to(strain / RATE)
        out = np.abs(kd.positions()).max() / SIDE
        print(f"{strain:6.2f} {exchanges:10d} {len(kd.edges()):6d} {distances(kd).mean():14.3f} {out:13.2f}")

    for event in kd.record(until=2.1)[:3]:
        edges = (f"{event[edge][0]}-{event[edge][1]} {tuple(event[edge + '_offset'].tolist())}"
                 for edge in ("removed", "added"))
        print(f"t = {event['time']:.4f}:", " gives way to ".join(edges))

    wrapped = kd.positions(wrapped=True)
    print(len(kd.triangles()), "triangles;", kd.box, "has the area", kd.box.area(kd.time))
    print("point 7, in the box at", wrapped[7].round(3).tolist(), "has the neighbors", *kd.neighbors(7))

    nearest = kd.nearest_neighbors(k=6)
    print("its six nearest are", *nearest.ids[7], "and up to", nearest.distances[7, 5].round(3), "away")
    images = kd.positions()[nearest.ids] + nearest.offsets @ kd.box.vectors_at(kd.time)
    print("the mean of their images is", images[7].mean(axis=0).round(3).tolist())
    corner = kd.locate([0, 0])
    print("the corner of the box is in the triangle", *corner.points, "with the offsets", *corner.offsets)
    print("audit passed:", bool(kd.audit()))


if __name__ == "__main__":
    main()
