# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas of cells within walls and a distance, frame by frame, against those of another library: GEOS
computes the Voronoi diagram, and intersects its cells with the walkable area and with polygons inside
and outside of the circle of the cutoff. Skipped without shapely, the Python package of GEOS."""
import os
import pathlib

import numpy as np
import pytest

import kinetri

shapely = pytest.importorskip("shapely")
from shapely import affinity, geometry, ops, wkt  # noqa: E402

#: Of GEOS, which rounds the corners of intersections.
ROUNDING = 1e-9

#: A room with an entrance, a table and two pillars.
ROOM = ("POLYGON((-1 -1, 17 -1, 17 6, 16.5 6, 16.5 8, 17 8, 17 15, -1 15, -1 -1),"
        "(3 4, 7 4, 7 5, 4 5, 4 9, 3 9, 3 4), (10 10, 11 10, 11 11, 10 11, 10 10), (12 3, 13 4, 12 5, 11 4, 12 3))")


def own_part(shape, place):
    """The part of a shape that has the place."""
    point = geometry.Point(place)
    parts = [part for part in getattr(shape, "geoms", [shape]) if part.distance(point) < ROUNDING]
    assert len(parts) <= 1
    return parts[0].area if parts else 0.0


def bounds_of_areas(places, walkable, cutoff):
    """Lower and upper bounds of the areas, one of each for each place."""
    far = walkable.envelope.buffer(100)
    diagram = ops.voronoi_diagram(geometry.MultiPoint(places), envelope=far)
    sectors = 128
    disc = geometry.Point(0, 0).buffer(cutoff, sectors)
    outer = 1 / np.cos(np.pi / (4 * sectors))
    result = []
    for place in places:
        point = geometry.Point(place)
        if not walkable.covers(point):
            result.append((0.0, 0.0))
            continue
        cell = next(cell for cell in diagram.geoms if cell.covers(point))
        room = cell.intersection(walkable)
        result.append(tuple(
            own_part(room.intersection(affinity.translate(affinity.scale(disc, k, k), *place)), place)
            for k in (1, outer)))
    return np.array(result)


def expect_those_of_geos(places, areas, cutoff):
    walkable = wkt.loads(ROOM)
    bounds = bounds_of_areas(places, walkable, cutoff)
    assert (areas >= bounds[:, 0] * (1 - ROUNDING)).all()
    assert (areas <= bounds[:, 1] * (1 + ROUNDING)).all()


@pytest.mark.parametrize("cutoff", [0.4, 1.5, 50])
def test_areas_of_random_points_are_those_of_geos(cutoff):
    rng = np.random.default_rng(5)
    kd = kinetri.KineticDelaunay(rng.uniform(0, 16, (60, 2)), rng.uniform(-0.5, 0.5, (60, 2)))
    for time in (0, 0.75, 2):
        kd.advance_to(time)
        places = kd.positions()
        expect_those_of_geos(places, kd.cell_areas(ROOM, cutoff), cutoff)


@pytest.mark.parametrize("name", ["students003.txt", "biwi_eth.txt"])
def test_areas_of_recorded_crowds_are_those_of_geos(name):
    path = pathlib.Path(os.environ.get("KINETRI_SHARED_DATA", ""), "crowd", name)
    if not path.exists():
        pytest.skip(f"the recorded crowd {name} is not there")
    rows = np.loadtxt(path)
    tracks = kinetri.Tracks.from_arrays(rows[:, 0], rows[:, 1].astype(int), rows[:, 2], rows[:, 3])
    frames, sizes = np.unique(rows[:, 0], return_counts=True)
    some = frames[sizes >= 4][:: max(1, len(frames) // 12)]
    table = tracks.areas(some, walkable=ROOM, cutoff=2)
    checked = 0
    for frame in some:
        seen = rows[rows[:, 0] == frame]
        found = table[table["t"] == frame].set_index("id")["area"]
        # In a gap of its observations somebody is there, too, between two places.
        if set(found.index) != set(seen[:, 1].astype(int)):
            continue
        expect_those_of_geos(seen[:, 2:4], found.loc[seen[:, 1].astype(int)].to_numpy(), 2)
        checked += len(seen)
    assert checked > 50
