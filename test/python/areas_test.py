# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas of cells within walls and a distance, and their means, against areas in exact arithmetic."""
from fractions import Fraction

import numpy as np
import pytest

import kinetri

SQUARE = "POLYGON((0 0, 4 0, 4 4, 0 4, 0 0))"


def cut(polygon, p, q):
    """What is as near to p as to q, or nearer."""
    def excess(v):
        return sum((a - b) ** 2 for a, b in zip(v, p)) - sum((a - b) ** 2 for a, b in zip(v, q))

    result = []
    for v, w in zip(polygon, polygon[1:] + polygon[:1]):
        if excess(v) <= 0:
            result.append(v)
        if excess(v) * excess(w) < 0:
            part = excess(v) / (excess(v) - excess(w))
            result.append(tuple(a + part * (b - a) for a, b in zip(v, w)))
    return result


def exact_areas(places, polygon):
    """Of all cells in a convex polygon."""
    exact = [tuple(map(Fraction, place)) for place in places]
    result = []
    for p in exact:
        cell = [tuple(map(Fraction, v)) for v in polygon]
        for q in exact:
            if q != p:
                cell = cut(cell, p, q)
        result.append(float(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(cell, cell[1:] + cell[:1])) / 2))
    return result


@pytest.mark.parametrize("seed", range(4))
def test_areas_in_a_convex_polygon_are_exact(seed):
    rng = np.random.default_rng(seed)
    polygon = [(0, 0), (8, 1), (9, 7), (2, 9)]
    inside = kinetri.KineticDelaunay(rng.uniform(2, 7, (12, 2)), rng.uniform(-0.25, 0.25, (12, 2)))
    for time in (0, 1.5, 3):
        inside.advance_to(time)
        areas = inside.cell_areas(polygon)
        np.testing.assert_allclose(areas, exact_areas(inside.positions(), polygon), rtol=1e-12)
        np.testing.assert_allclose(areas, inside.voronoi_areas(polygon), rtol=1e-12)


def test_walls_divide_cells_and_points_outside_have_none():
    room = "POLYGON((0 0, 4 0, 4 4, 0 4, 0 2.5, 3 2.5, 3 1.5, 0 1.5, 0 0))"
    kd = kinetri.KineticDelaunay([[1, 1], [5, 1]], np.zeros((2, 2)))
    assert kd.cell_areas(room).tolist() == [4.5, 0]
    assert np.isclose(kd.cell_areas(cutoff=0.5), np.pi / 4).all()
    assert np.isclose(kd.cell_areas(SQUARE, 0.5), [np.pi / 4, 0]).all()


def test_an_id_without_a_point_has_no_area():
    kd = kinetri.KineticDelaunay([[1, 2], [2, 2], [3, 2]], np.zeros((3, 2)))
    kd.erase([1])
    assert kd.cell_areas(SQUARE).tolist() == [8, 0, 8]


@pytest.mark.parametrize("make", [kinetri.KineticDelaunay, kinetri.Simulation])
def test_areas_over_time_are_those_of_each_time(make):
    rng = np.random.default_rng(1)
    positions, velocities = rng.uniform(0, 4, (9, 2)), rng.uniform(-1, 1, (9, 2))
    times = [0, 0.5, 0.5, 2]
    table = make(positions, velocities).areas(times, walkable=SQUARE, cutoff=1.5)
    assert list(table.columns) == ["t", "id", "area", "density"] and len(table) == 36
    step = make(positions, velocities)
    for k, time in enumerate(times):
        step.advance_to(time)
        rows = table[9 * k:9 * k + 9]
        assert (rows["t"] == time).all() and rows["id"].tolist() == list(range(9))
        assert rows["area"].tolist() == step.cell_areas(SQUARE, 1.5).tolist()
    some = table[table["area"] > 0]
    assert (some["density"] == 1 / some["area"]).all()
    assert table[table["area"] == 0]["density"].isna().all()


@pytest.mark.parametrize("make", [kinetri.KineticDelaunay, kinetri.Simulation])
def test_means_of_areas_that_are_linear_are_exact(make):
    table = make([[0.5, 2], [1.5, 2]], [[0, 0], [1, 0]]).mean_areas(until=2, walkable=SQUARE)
    assert table["id"].tolist() == [0, 1]
    assert table["from"].tolist() == [0, 0] and table["until"].tolist() == [2, 2]
    assert (np.abs(table["area"] - [6, 10]) <= table["error"]).all()
    assert (table["error"] < 1e-5).all()


def test_tables_of_tracks_have_labels():
    tracks = kinetri.Tracks.from_arrays(
        np.array(["2030-01-01T00:00", "2030-01-01T00:00:04", "2030-01-01T00:00:02", "2030-01-01T00:00:04"],
                 dtype="datetime64[s]"), ["Ada", "Ada", "Ben", "Ben"], [1, 1, 3, 3], [1, 3, 2, 3])
    table = tracks.areas(fps=1, walkable=SQUARE)
    assert list(table["t"]) == [0, 1, 2, 2, 3, 3]
    assert list(table["id"]) == ["Ada", "Ada", "Ada", "Ben", "Ada", "Ben"]
    assert table["area"].tolist()[:2] == [16, 16] and np.isclose(table["area"][2:4].sum(), 16)
    assert str(table["date"][1]) == "2030-01-01 00:00:01"
    means = tracks.mean_areas(walkable=SQUARE)
    assert means["id"].tolist() == ["Ada", "Ben"] and means["from"].tolist() == [0, 2]
    assert np.isclose(means["area"][0] * 4 + means["area"][1] * 2, 64)


def test_what_is_wrong_is_said():
    kd = kinetri.KineticDelaunay([[1, 2]], [[0, 0]])
    with pytest.raises(kinetri.PreconditionError, match="cells of points on the convex hull are unbounded"):
        kd.cell_areas()
    with pytest.raises(kinetri.PreconditionError, match="the cutoff is 0"):
        kd.cell_areas(SQUARE, 0)
    with pytest.raises(kinetri.InputError, match="walkable:1: column 1: 'POINT' stands here"):
        kd.cell_areas("POINT(1 2)")
    with pytest.raises(kinetri.PreconditionError, match="crosses another edge"):
        kd.cell_areas([[0, 0], [2, 2], [2, 0], [0, 2]])
    with pytest.raises(kinetri.PreconditionError, match=r"times\[1\] is 0.0, before times\[0\]"):
        kd.areas([1, 0], walkable=SQUARE)
    with pytest.raises(kinetri.PreconditionError, match="tolerance"):
        kd.mean_areas(until=1, walkable=SQUARE, tolerance=0)
    with pytest.raises(kinetri.PreconditionError, match="expected times, or fps"):
        kinetri.Tracks.from_arrays([0, 1], [0, 0], [0, 1], [0, 1]).areas(walkable=SQUARE)
