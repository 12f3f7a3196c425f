# SPDX-License-Identifier: GPL-3.0-or-later
"""The points that a change is about: all, ids, slices and masks."""
import numpy as np
import pytest
from support import uniform

import kinetri


def some(n=12, erased=(3, 8)):
    """Points of which some have left."""
    kd = kinetri.KineticDelaunay(*uniform(n, 5))
    kd.erase(list(erased))
    return kd


CLASSES = {
    "Delaunay": lambda n, seed: kinetri.KineticDelaunay(*uniform(n, seed)),
    "accelerated": lambda n, seed: kinetri.KineticDelaunay(*uniform(n, seed), acceleration=np.ones((n, 2))),
    "regular": lambda n, seed: kinetri.KineticRegular(*uniform(n, seed), radius=np.linspace(0, 9, n)),
    "discs": lambda n, seed: kinetri.Simulation(*uniform(n, seed), radius=0.5, collisions="elastic"),
}


@pytest.mark.parametrize("name", CLASSES)
def test_velocities_of_all_points_are_those_of_all_ids(name):
    one, other = CLASSES[name](30, 4), CLASSES[name](30, 4)
    rng = np.random.default_rng(9)
    for time in (0.5, 1.0, 1.5):
        for points in (one, other):
            points.advance_to(time)
            points.erase(points.ids[::7])
        new = rng.uniform(-3, 3, (one.next_id, 2))
        new[np.isnan(one.radii())] = np.nan
        one.set_velocities(new)
        other.set_velocities(other.ids, new[other.ids])
        assert np.array_equal(one.velocities(), new, equal_nan=True)
        assert one.snapshot() == other.snapshot() and one.audit()
    one.set_velocities(velocities=(1, 2))
    assert one.velocities()[one.ids].tolist() == [[1, 2]] * len(one)


def test_velocities_that_come_back_change_nothing_where_there_are_gaps():
    kd = some()
    before = kd.velocities()
    kd.set_velocities(kd.velocities())
    assert np.array_equal(kd.velocities(), before, equal_nan=True)


def test_a_velocity_for_a_point_that_is_not_there_is_refused():
    kd = some()
    for new in (np.ones((12, 2)), np.ones((12, 2), dtype=int), np.where(np.arange(24).reshape(12, 2) == 7, 1.0,
                                                                        kd.velocities())):
        before = kd.snapshot()
        with pytest.raises(kinetri.PreconditionError, match=r"^velocities\[3, [01]\] is 1(.0)?, and there is no "
                                                            r"point 3; expected NaN in the rows of ids without"):
            kd.set_velocities(new)
        assert kd.snapshot() == before
    with pytest.raises(kinetri.PreconditionError, match=r"^velocities\[5, 1\] is inf; expected finite numbers"):
        new = kd.velocities()
        new[5, 1] = np.inf
        kd.set_velocities(new)
    with pytest.raises(kinetri.PreconditionError, match=r"shape \(10, 2\); expected \(12, 2\)"):
        kd.set_velocities(np.ones((10, 2)))


@pytest.mark.parametrize("wrong", [{"ids": [0]}, {}, {"ids": [0], "speeds": [1, 2]}])
def test_velocities_without_velocities_are_a_wrong_call(wrong):
    kd = some()
    before = kd.snapshot()
    with pytest.raises(TypeError):
        kd.set_velocities(**wrong)
    with pytest.raises(TypeError, match="takes velocities, or ids and velocities"):
        kd.set_velocities([0], [1, 2], ids=[0])
    assert kd.snapshot() == before


# What a slice of the ids 0 to 11 has, without 3 and 8, which have left.
SLICES = [
    (slice(None), [0, 1, 2, 4, 5, 6, 7, 9, 10, 11]),
    (slice(2, 5), [2, 4]),
    (slice(3, 4), []),
    (slice(-4, None), [9, 10, 11]),
    (slice(None, None, 4), [0, 4]),
    (slice(9, 3, -2), [9, 7, 5]),
    (slice(10, 99), [10, 11]),
    (slice(np.int64(1), np.uint8(3)), [1, 2]),
]


@pytest.mark.parametrize("chosen, ids", SLICES)
def test_a_slice_is_about_the_points_in_it(chosen, ids):
    new = np.random.default_rng(1).uniform(-1, 1, (len(ids), 2))
    kd = some()
    before = kd.velocities()
    kd.set_velocities(chosen, new)
    before[ids] = new
    assert np.array_equal(kd.velocities(), before, equal_nan=True)
    kd.set_motions(chosen, 200 + 9 * new, new)
    assert np.array_equal(kd.positions()[ids], 200 + 9 * new)
    there = kd.ids.tolist()
    kd.erase(chosen)
    assert kd.ids.tolist() == [id for id in there if id not in ids] and kd.audit()


def test_a_mask_is_about_the_points_that_it_marks():
    kd = some()
    mask = kd.positions()[:, 0] < 60
    ids = np.flatnonzero(mask).tolist()
    assert 2 < len(ids) < 9 and not {3, 8} & set(ids)
    new = np.random.default_rng(1).uniform(-1, 1, (len(ids), 2))
    expected = kd.velocities()
    expected[ids] = new
    kd.set_velocities(mask.tolist(), new)
    assert np.array_equal(kd.velocities(), expected, equal_nan=True)
    kd.set_motions(ids=mask, positions=new, velocities=new)
    assert np.array_equal(kd.positions()[ids], new)
    kd.erase(mask)
    assert kd.ids.tolist() == [id for id in range(12) if id not in (3, 8, *ids)] and kd.audit()
    with pytest.raises(kinetri.PreconditionError, match="there is no point 3"):
        kd.erase(~mask)
    none = np.zeros(12, dtype=bool)
    kd.set_velocities(none, np.empty((0, 2)))
    kd.erase(none)
    assert kinetri.KineticDelaunay([], []).erase(np.empty(0, dtype=bool)) is None


def test_masses_of_slices_and_masks():
    sim = kinetri.Simulation(*uniform(5, 1), radius=1, collisions="elastic")
    sim.set_masses(slice(1, 3), [2, 3])
    sim.set_masses(sim.masses() == 1, 7)
    assert sim.masses().tolist() == [7, 2, 3, 7, 7]
