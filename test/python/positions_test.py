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


@pytest.mark.parametrize("arguments, text", [
    (([[0, 0], [1, np.nan], [2, 2]],), "finite|NaN|nan"),
    (([[0, 0], [1, 1]],), "shape"),
    (([0, 0], [[1, 1], [2, 2]]), "twice"),
    (([7], [1, 1]), "no point"),
    ((None,), "positions is None"),
])
def test_what_is_wrong_changes_nothing(arguments, text):
    kd = kinetri.KineticDelaunay([[0, 0], [9, 0], [0, 9]], 3 * [[0, 0]])
    with pytest.raises(kinetri.PreconditionError, match=text):
        kd.set_positions(*arguments)
    assert kd.positions().tolist() == [[0, 0], [9, 0], [0, 9]]
    with pytest.raises(TypeError, match=r"set_positions\(\) takes positions, or ids and positions"):
        kd.set_positions([0], [1, 1], [2])
