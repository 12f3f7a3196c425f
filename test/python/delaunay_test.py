# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangulations against scipy's static ones, and the events against replayed edges."""
import pickle
from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial import Delaunay, KDTree
from support import nearest_of_all_pairs

import kinetri


def uniform(n, seed):
    rng = np.random.default_rng(seed)
    return rng.uniform(0, 100, (n, 2)), rng.uniform(-5, 5, (n, 2))


def static_triangles(places):
    """The triangles as rows of sorted ids, sorted."""
    return sorted(tuple(sorted(map(int, row))) for row in Delaunay(places).simplices)


@pytest.mark.parametrize("seed", range(5))
def test_triangles_are_those_of_scipy(seed):
    positions, velocities = uniform(200, seed)
    kd = kinetri.KineticDelaunay(positions, velocities)
    for time in np.random.default_rng(seed).uniform(0, 3, 4).cumsum():
        kd.advance_to(time)
        exact = [[float(Fraction(p) + Fraction(v) * Fraction(time)) for p, v in zip(place, velocity)]
                 for place, velocity in zip(positions[:20], velocities[:20])]
        assert kd.positions()[:20].tolist() == exact
        # Random points in general position: the rounded ones have the same triangulation.
        assert sorted(tuple(sorted(map(int, row))) for row in kd.triangles()) == static_triangles(
            kd.positions())


def test_edges_follow_from_those_at_the_start_and_the_events():
    kd = kinetri.KineticDelaunay(*uniform(300, 7))
    edges = {tuple(edge) for edge in kd.edges().tolist()}
    events = kd.record(until=2.0)
    assert len(events) > 500
    for event in events:
        if event["removed"][0] != kinetri.NO_POINT:
            edges.remove(tuple(event["removed"].tolist()))
        if event["added"][0] != kinetri.NO_POINT:
            edges.add(tuple(event["added"].tolist()))
    assert sorted(edges) == [tuple(edge) for edge in kd.edges().tolist()]
    assert kd.audit()


@pytest.mark.parametrize("kinds", [["flip"], "hull_insert", ("hull_insert", "hull_remove", "wall"), [],
                                   np.array(["flip", "trajectory"]), kinetri.event_kinds])
def test_of_the_events_those_of_some_kinds_are_kept(kinds):
    events = kinetri.KineticDelaunay(*uniform(60, 3)).record(until=5)
    assert {"flip", "hull_insert", "hull_remove"} <= set(events["kind"].tolist())
    kd = kinetri.KineticDelaunay(*uniform(60, 3))
    found = kd.record(until=5, kinds=iter([kinds] if isinstance(kinds, str) else kinds))
    if isinstance(kinds, str):
        again = kinetri.KineticDelaunay(*uniform(60, 3)).record(5, kinds=kinds)
        assert again.tobytes() == found.tobytes()
    expected = events[np.isin(events["kind"], kinds)]
    assert found.tobytes() == expected.tobytes() and found.dtype == kinetri.event_dtype
    assert kd.time == 5 and kd.statistics()["events"]["flip"] == (events["kind"] == "flip").sum()


@pytest.mark.parametrize("k", [1, 2, 5, 39, 40, 60])
@pytest.mark.parametrize("side", [4, 12, 40])
@pytest.mark.parametrize("companions", [0, 6])
def test_the_k_nearest_are_those_of_all_pairs(k, side, companions):
    rng = np.random.default_rng(side)
    # On small grids many points are equally near, and coincide. The companions go with others, also with 7.
    positions, velocities = rng.integers(0, side, (42, 2)), rng.permutation(84).reshape(42, 2) - 42
    for columns in (positions, velocities):
        columns[30:30 + companions] = columns[4:4 + companions]
    kd = kinetri.KineticDelaunay(positions, velocities)
    kd.erase([7, 20])
    for time in (0, 1, 3):
        kd.advance_to(time)
        ids, distances = kd.nearest_neighbors(k=k)
        assert ids.shape == distances.shape == (42, k) and ids.dtype == np.uint32
        assert np.array_equal(ids, nearest_of_all_pairs(kd, k))
        assert np.array_equal(np.isnan(distances), ids == kinetri.NO_POINT)
        difference = kd.positions()[ids[0, :min(k, 39)]] - kd.positions()[0]
        assert distances[0, :39] == pytest.approx(np.sqrt((difference**2).sum(axis=1)))
        assert np.array_equal(kd.nearest_neighbors().ids, ids[:, 0])


def test_the_k_nearest_of_random_points_are_those_of_scipy():
    kd = kinetri.KineticDelaunay(*uniform(500, 2))
    kd.advance_to(1.5)
    distances, ids = KDTree(kd.positions()).query(kd.positions(), k=11)
    found = kd.nearest_neighbors(k=10)
    assert np.array_equal(found.ids, ids[:, 1:])
    assert found.distances == pytest.approx(distances[:, 1:])


def test_events_of_the_iterator_are_those_of_record():
    motions = kinetri.scenario("lattice", 100, seed=3)
    recorded = kinetri.KineticDelaunay(*motions).record(until=5.0)
    kd = kinetri.KineticDelaunay(*motions)
    events = list(kd.events(until=5.0))
    assert kd.time == 5.0
    assert [event.kind for event in events] == recorded["kind"].tolist()
    assert [float(event.time) for event in events] == recorded["time"].tolist()
    assert [event.time.lower for event in events] == recorded["time_lo"].tolist()
    assert [event.time.upper for event in events] == recorded["time_hi"].tolist()
    assert all(a.time <= b.time for a, b in zip(events, events[1:]))
    assert any(a.time == b.time for a, b in zip(events, events[1:]))


def test_arrays_of_events_that_are_put_together_keep_type_and_bytes():
    kd = kinetri.KineticDelaunay(*uniform(100, 8))
    snapshot = kd.snapshot()
    whole = kd.record(until=2)
    again = snapshot.restore()
    parts = np.concatenate([again.record(until=1), again.record(until=2)])
    assert parts.dtype == whole.dtype == kinetri.event_dtype
    assert parts.tobytes() == whole.tobytes()


def test_a_snapshot_goes_on_as_the_object_does():
    kd = kinetri.KineticDelaunay(*uniform(100, 5))
    kd.advance_to(1)
    snapshot = pickle.loads(pickle.dumps(kd.snapshot()))
    expected = kd.record(until=3)
    assert np.array_equal(snapshot.restore().record(until=3), expected)
    assert len(expected) > 50


def test_time_runs_backwards():
    kd = kinetri.KineticDelaunay(*uniform(100, 6))
    start = kd.edges()
    forward = kd.record(until=2)
    kd.reverse()
    assert kd.time == -2
    backward = kd.record(until=0)
    assert np.array_equal(kd.edges(), start)
    assert backward["time"].tolist() == (-forward["time"][::-1]).tolist()
    assert np.array_equal(backward["removed"], forward["added"][::-1])
