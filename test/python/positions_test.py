# SPDX-License-Identifier: GPL-3.0-or-later
"""set_positions: points that move in steps."""
import numpy as np
import pytest
from support import uniform

import kinetri


@pytest.mark.parametrize("step", [1e-3, 0.1, 1.0, 30.0])
def test_each_step_is_a_new_triangulation(step):
    places, _ = uniform(400, seed=3)
    rng = np.random.default_rng(4)
    kd = kinetri.KineticDelaunay(places, np.zeros_like(places))
    for _ in range(4):
        places = places + rng.normal(0, step, places.shape)
        kd.set_positions(places)
        new = kinetri.KineticDelaunay(places, np.zeros_like(places))
        assert np.array_equal(kd.edges(), new.edges())
        assert np.array_equal(kd.positions(), places)
        assert not kd.velocities().any()
        box = (-50, -50, 150, 150)
        assert np.allclose(kd.voronoi_areas(box), new.voronoi_areas(box), rtol=1e-12, atol=0)
    assert kd.audit()


def test_some_points_move_to_one_position():
    kd = kinetri.KineticDelaunay([[0, 0], [9, 0], [0, 9], [5, 5]], 4 * [[1, 0]])
    kd.set_positions([1, 3], [4, 4])
    assert kd.positions().tolist() == [[0, 0], [4, 4], [0, 9], [4, 4]]
    assert kd.hidden_points().tolist() == [3]
    kd.advance_to(1)
    assert kd.positions()[0].tolist() == [1, 0]
    assert kd.positions()[1].tolist() == [4, 4]


def test_discs_keep_their_sizes():
    discs = kinetri.KineticRegular([[0, 0], [9, 0], [0, 9]], 3 * [[0, 0]], radius=[1, 2, 3], growth=[0, 0.5, 0])
    discs.advance_to(2)
    discs.set_positions([[1, 1], [8, 0], [0, 7]])
    assert discs.radii().tolist() == [1, 3, 3]
    assert discs.audit()


def test_a_position_out_of_the_box_is_refused():
    points = kinetri.Simulation([[1, 1], [2, 3]], [[1, 0], [0, 1]], box=(0, 0, 4, 4))
    points.set_positions([[2, 2], [3, 3]])
    assert points.positions().tolist() == [[2, 2], [3, 3]]
    with pytest.raises(kinetri.OutsideBoxError):
        points.set_positions([[2, 2], [5, 3]])
    assert points.positions().tolist() == [[2, 2], [3, 3]]


def grid_objects():
    """A new object of each kind, with the same points on a grid; two are coincident, and one has left."""
    places = [[x, y] for x in range(5) for y in range(5)] + [[1, 1], [2, 7]]
    at_rest = np.zeros((len(places), 2))
    objects = [kinetri.KineticDelaunay(places, at_rest), kinetri.KineticRegular(places, at_rest, weight=at_rest[:, 0]),
               kinetri.Simulation(places, at_rest, box=(-1, -1, 9, 9))]
    for points in objects:
        points.erase(3)
    return objects


def state(points):
    return (points.edges().tolist(), points.hidden_points().tolist(), points.positions().tobytes(),
            points.velocities().tobytes(), points.time)


def others(**changes):
    """The positions of all points of the grid objects, half a unit to the right, changed at some ids."""
    places = np.array([[x + 0.5, y] for x in range(5) for y in range(5)] + [[1.5, 1], [2.5, 7]])
    places[3] = np.nan
    for id, place in changes.items():
        places[int(id[1:])] = place
    return places


@pytest.mark.parametrize("arguments, text", [
    ((others(_5=(1, np.nan)),), "nan"),
    ((others(_5=(np.inf, 0)),), "inf"),
    ((others(_3=(1, 1)),), "no point 3"),
    ((others()[:26],), "shape"),
    ((others().T,), "shape"),
    ((others().ravel(),), "shape"),
    ((others()[:, :, None],), "shape"),
    ((others().astype(str),), "real numbers"),
    ((np.ma.masked_less(np.nan_to_num(others()), 1),), "masked"),
    (([0, 1], [[1, 1], [np.nan, 2]]), "nan"),
    (([0, 1], [[1, 1], [2, 2], [3, 3]]), "shape"),
    (([0, 1], [[1, 1, 1], [2, 2, 2]]), "shape"),
    (([0, 1, 0], [[1, 1], [2, 2], [3, 3]]), "twice"),
    (([0, 0], [1, 1]), "twice"),
    (([3], [1, 1]), "no point 3"),
    (([27], [1, 1]), "no point 27"),
    (([-1], [1, 1]), "ids from 0"),
    (([2**32 - 1], [1, 1]), "ids from 0"),
    (([0.5], [1, 1]), "integers"),
    (([[0], [1]], [[1, 1], [2, 2]]), "integers"),
    ((np.ones(26, dtype=bool), [1, 1]), "mask"),
    (([], [[1, 1]]), "shape"),
    ((None,), "positions is None"),
])
def test_what_is_refused_changes_nothing(arguments, text):
    for points in grid_objects():
        before = state(points)
        with pytest.raises(kinetri.PreconditionError, match=text):
            points.set_positions(*arguments)
        assert state(points) == before
        points.set_positions(others())
        assert np.array_equal(points.positions(), others(), equal_nan=True)
        assert points.audit()


def test_coincident_positions_that_are_refused_change_nothing():
    places, velocities = uniform(40, seed=6)
    points = kinetri.KineticDelaunay(places, velocities, coincident="refuse")
    before = state(points)
    for arguments in [(np.ones((40, 2)),), (slice(None), [3, 3]), ([3, 8], [[1, 2], [1, 2]])]:
        with pytest.raises(kinetri.CoincidentTrajectoriesError):
            points.set_positions(*arguments)
        assert state(points) == before


def test_takes_one_or_two_arguments():
    kd = kinetri.KineticDelaunay([[0, 0], [9, 0], [0, 9]], 3 * [[0, 0]])
    with pytest.raises(TypeError, match=r"set_positions\(\) takes positions, or ids and positions"):
        kd.set_positions([0], [1, 1], [2])


def test_advance_through_ends_at_the_positions_with_the_events_on_the_way():
    random = np.random.default_rng(3)
    kd = kinetri.KineticDelaunay(random.uniform(0, 10, (50, 2)), np.zeros((50, 2)))
    for step in range(6):
        here, now = kd.positions(), float(kd.time)
        there = random.uniform(0, 10, (50, 2))
        alone = kinetri.KineticDelaunay(here, (there - here) / 0.5)
        events = alone.advance_to(0.5)
        assert kd.advance_through(there, 0.5) == events > 0
        assert float(kd.time) == now + 0.5
        assert (kd.positions() == there).all() and (kd.velocities() == 0).all()
        assert kd.audit()


def test_advance_through_moves_some_points_and_the_others_go_on():
    kd = kinetri.KineticDelaunay([[0, 0], [9, 0], [0, 9], [5, 5]], [[0, 0], [1, 0], [0, 0], [0, 0]])
    assert kd.advance_through([[3, 3]], 0.5, ids=[3]) == 1
    assert kd.positions().tolist() == [[0, 0], [9.5, 0], [0, 9], [3, 3]]
    assert kd.velocities().tolist() == [[0, 0], [1, 0], [0, 0], [0, 0]]


def test_advance_through_goes_straight_though_points_accelerated():
    kd = kinetri.KineticDelaunay([[0, 0], [9, 0], [0, 9], [5, 5]], np.zeros((4, 2)), acceleration=np.ones((4, 2)))
    kd.advance_through([[0, 0], [9, 0], [0, 9], [3, 3]], 1)
    assert kd.positions().tolist() == [[0, 0], [9, 0], [0, 9], [3, 3]]
    kd.advance_to(2)
    assert kd.positions().tolist() == [[0, 0], [9, 0], [0, 9], [3, 3]]


@pytest.mark.parametrize("positions, duration", [
    ([[1, 1]] * 4, 0), ([[1, 1]] * 4, -1), ([[1, 1]] * 4, np.nan), ([[1, 1]] * 4, np.inf),
    ([[1, 1]] * 3, 1), ([[1, np.nan]] * 4, 1), ([[1, 1], [2, 2], [3, 3], [1e308, 4]], 1e-9)])
def test_advance_through_refuses_what_is_wrong_and_changes_nothing(positions, duration):
    kd = kinetri.KineticDelaunay([[0, 0], [9, 0], [0, 9], [5, 5]], 4 * [[0, 0]])
    with pytest.raises(kinetri.PreconditionError):
        kd.advance_through(positions, duration)
    assert float(kd.time) == 0 and (kd.velocities() == 0).all()
    assert kd.positions().tolist() == [[0, 0], [9, 0], [0, 9], [5, 5]]
