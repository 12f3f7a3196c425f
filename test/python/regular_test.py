# SPDX-License-Identifier: GPL-3.0-or-later
"""Regular triangulations: against lower hulls of lifted points; hidden points, power cells, sizes."""
import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial import ConvexHull
from support import few, uniform

import kinetri


def lower_hull(places, weights):
    """The triangles of the lower hull of the points lifted to x^2 + y^2 - w, and the vertices."""
    centered = places - places.mean(axis=0)
    hull = ConvexHull(np.column_stack((centered, (centered**2).sum(axis=1) - weights)))
    faces = hull.simplices[hull.equations[:, 2] < 0]
    return sorted(tuple(sorted(map(int, face))) for face in faces)


def triangles(kr):
    return sorted(tuple(sorted(map(int, row))) for row in kr.triangles())


@pytest.mark.parametrize("seed", range(6))
def test_triangles_are_the_lower_hull_at_random_times(seed):
    rng = np.random.default_rng(seed)
    positions, velocities = uniform(80, seed)
    radii, growths, weights = rng.uniform(0, 20, 80), rng.uniform(-1, 4, 80), rng.uniform(-50, 50, 80)
    accelerations = {"acceleration": uniform(80, seed + 50)[1]} if seed % 2 else {}
    growths = np.maximum(growths, 0)
    kr = kinetri.KineticRegular(positions, velocities, radius=radii, growth=growths, weight=weights,
                                **accelerations)
    hidden = 0
    for time in rng.uniform(0, 1.5, 4).cumsum():
        kr.advance_to(time)
        assert np.allclose(kr.radii(), radii + growths * time)
        expected = lower_hull(kr.positions(), kr.radii() ** 2 + weights)
        assert triangles(kr) == expected
        seen = {id for triangle in expected for id in triangle}
        assert kr.hidden_points().tolist() == sorted(set(range(80)) - seen)
        hidden += len(kr.hidden_points())
        assert kr.audit()
    assert hidden > 10


def test_equal_radii_give_the_delaunay_triangulation():
    positions, velocities = uniform(100, 9)
    expected = kinetri.KineticDelaunay(positions, velocities).record(until=2)
    for sizes in ({"radius": 3}, {"weight": -7.5}, {"radius": 2, "weight": 1}, {}):
        kr = kinetri.KineticRegular(positions, velocities, **sizes)
        assert kr.record(until=2).tobytes() == expected.tobytes()
        assert kr.hidden_points().tolist() == []


def test_points_hide_and_come_back():
    # A small disc passes through a large one.
    kr = kinetri.KineticRegular([[-20, -20], [20, -20], [0, 20], [0, 0], [-9, 1]],
                                [[0, 0]] * 4 + [[2, 0]], radius=[1, 1, 1, 6, 1])
    events = kr.record(until=12)
    kinds = [(kind, id) for kind, id in zip(events["kind"], events["points"][:, 0])
             if kind in ("hide", "reveal")]
    assert kinds == [("hide", 4), ("reveal", 4)]
    again = kr.snapshot()
    kr = kinetri.KineticRegular([[-20, -20], [20, -20], [0, 20], [0, 0], [-9, 1]],
                                [[0, 0]] * 4 + [[2, 0]], radius=[1, 1, 1, 6, 1])
    kr.advance_to(4.5)
    assert kr.hidden_points().tolist() == [4] and 4 in kr and len(kr) == 5
    assert kr.neighbors(4).tolist() == [] and kr.positions()[4].tolist() == [0, 1]
    cell = kr.voronoi_cell(4)
    assert cell.is_empty and cell.neighbors.tolist() == [] and kr.voronoi_areas((-9, -9, 9, 9))[4] == 0
    assert kr.nearest_vertex([0, 1]) == 3
    kr.erase(3)
    assert kr.hidden_points().tolist() == []
    kr.reverse()
    assert again.restore().time == 12


@few
@given(st.integers(0, 2**32 - 1))
def test_power_cells_are_where_the_power_is_least(seed):
    rng = np.random.default_rng(seed)
    n = 8
    kr = kinetri.KineticRegular(rng.integers(0, 9, (n, 2)) + np.arange(n)[:, None] / 64,
                                rng.integers(-2, 3, (n, 2)), radius=rng.integers(0, 5, n))
    kr.advance_to(0.5)
    places, weights = kr.positions(), kr.radii() ** 2
    for place in rng.uniform(-2, 11, (20, 2)):
        power = ((places - place) ** 2).sum(axis=1) - weights
        assert power[kr.nearest_vertex(place)] <= power.min() + 1e-9
    areas = kr.voronoi_areas((-2, -2, 11, 11))
    assert np.isclose(areas.sum(), 169) and np.all(areas >= 0)
    assert np.all(areas[kr.hidden_points()] == 0)
    empty = [id for id in range(n) if kr.voronoi_cell(id).is_empty]
    # A point that appears just then has no cell yet.
    assert set(empty) >= set(kr.hidden_points().tolist()) and np.all(areas[empty] == 0)


def test_sizes_are_given_and_kept():
    kr = kinetri.KineticRegular([[0, 0], [20, 0], [0, 20]], [[1, 0]] * 3, radius=[1, 2, 3], growth=1,
                                weight=[0, -1, 5])
    kr.advance_to(2)
    kr.set_velocities([0, 2], [0, 1])
    kr.set_motions(1, [20, 1], [0, 0])
    kr.advance_to(3)
    # A growing disc that is given another velocity is rounded so that it does not overlap others.
    assert np.allclose(kr.radii(), [4, 5, 6], rtol=1e-12) and np.all(kr.radii() <= [4, 5, 6])
    assert [kr.motion(id)["weight"] for id in range(3)] == [0, -1, 5]
    kr.set_motions([0, 1], [[0, 1], [20, 2]], [[0, 0]] * 2, radius=[2, 3], growth=0, weight=[1, 2])
    kr.advance_to(4)
    assert kr.radii()[:2].tolist() == [2, 3] and np.isclose(kr.radii()[2], 7)
    assert kr.insert([9, 9], [0, 0]).tolist() == [3] and kr.motion(3)["radius"] == 0
    assert kr.insert([[8, 9]], [[0, 0]], radius=[2], growth=0.5, weight=-1).tolist() == [4]
    assert {name: kr.motion(4)[name] for name in ("radius", "growth", "weight", "epoch")} == {
        "radius": 2, "growth": 0.5, "weight": -1, "epoch": 4}
    with pytest.raises(kinetri.PreconditionError, match=r"radius has the shape \(3,\); expected \(2,\)"):
        kr.set_motions([0, 1], [[0, 0]] * 2, [[0, 0]] * 2, radius=[1, 2, 3])


def test_bad_sizes():
    square = [[0, 0], [9, 0], [0, 9], [9, 9]], [[0, 0]] * 4
    with pytest.raises(kinetri.PreconditionError, match=r"radius\[2\] is -1.0; expected at least 0"):
        kinetri.KineticRegular(*square, radius=[1, 1, -1, 1])
    with pytest.raises(kinetri.PreconditionError, match=r"growth\[3\] is inf"):
        kinetri.KineticRegular(*square, growth=[0, 0, 0, np.inf])
    with pytest.raises(kinetri.PreconditionError, match="weight is an array of <U1"):
        kinetri.KineticRegular(*square, weight=["a"] * 4)
    with pytest.raises(kinetri.CoincidentTrajectoriesError) as raised:
        kinetri.KineticRegular([[0, 0], [1, 1], [1, 1]], [[0, 0]] * 3, radius=2, coincident="refuse")
    assert raised.value.ids == (1, 2)
    # In one place with different weights: one hides the other.
    assert kinetri.KineticRegular([[0, 0], [1, 1], [1, 1]], [[0, 0]] * 3,
                                  radius=[2, 2, 3]).hidden_points().tolist() == [1]


def test_no_discs_and_one():
    kr = kinetri.KineticRegular([], [], radius=[], weight=3)
    assert kr.hidden_points().shape == (0,) and kr.advance_to(2) == 0
    kr = kinetri.KineticRegular([[1, 1], [1, 1]], [[0, 0]] * 2, radius=[5, 1])
    assert kr.hidden_points().tolist() == [1] and kr.hull().tolist() == [0]
    assert kr.edges().shape == (0, 2) and kr.locate((1, 1)) == ("vertex", (0,))


def test_time_runs_backwards():
    rng = np.random.default_rng(3)
    kr = kinetri.KineticRegular(*uniform(60, 3), radius=rng.uniform(0, 15, 60))
    start, hidden = kr.edges(), kr.hidden_points()
    forward = kr.record(until=1)
    assert kr.next_event_time() > 1
    kr.reverse()
    backward = kr.record(until=0)
    assert np.array_equal(kr.edges(), start) and np.array_equal(kr.hidden_points(), hidden)
    opposite = {"hide": "reveal", "reveal": "hide"}
    points = [(opposite[kind], id) for kind, id in zip(forward["kind"], forward["points"][:, 0])
              if kind in opposite]
    assert len(points) > 3
    assert points[::-1] == [(kind, id) for kind, id in zip(backward["kind"], backward["points"][:, 0])
                            if kind in opposite]


def test_a_radius_that_shrinks_goes_on_below_zero():
    kr = kinetri.KineticRegular([[0, 0], [10, 0], [0, 10]], [[0, 0]] * 3, radius=[2, 2, 4],
                                growth=[-1, -1, 0])
    kr.advance_to(6)
    assert kr.radii().tolist() == [-4, -4, 4]
    assert kr.voronoi_areas((-5, -5, 5, 5)).tolist() == [100, 0, 0]  # of equal weights
    kr.set_motions(0, [0, 0], [0, 0])
    assert kr.motion(0)["radius"] == 4 and kr.motion(0)["growth"] == 1
    kr.advance_to(8)
    assert kr.radii().tolist() == [6, -6, 4] and kr.audit()
