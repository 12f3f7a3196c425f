# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers about a run, against all pairs in exact arithmetic, and against a count at each time."""
import json
from fractions import Fraction

import numpy as np
import pandas as pd
import pytest

import kinetri


def squared_distance(p, q, time):
    """At a rational time, of points given as position and velocity."""
    return sum(((Fraction(a) + Fraction(v) * time) - (Fraction(b) + Fraction(w) * time)) ** 2
               for a, v, b, w in zip(p[0], p[1], q[0], q[1]))


def scene(seed, n=12, companions=0):
    """Random points, the last of which are companions: they go with the first ones."""
    rng = np.random.default_rng(seed)
    columns = rng.uniform(0, 20, (n, 2)), rng.uniform(-2, 2, (n, 2))
    for column in columns:
        column[n - companions:] = column[:companions]
    return columns


def near_pairs(points, time, distance):
    return {(a, b) for b in range(len(points)) for a in range(b)
            if squared_distance(points[a], points[b], time) <= Fraction(distance) ** 2}


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("kind", [kinetri.KineticDelaunay, kinetri.Simulation])
@pytest.mark.parametrize("companions", [0, 3])
def test_encounters_are_the_near_pairs_of_every_time(seed, kind, companions):
    positions, velocities = scene(seed, companions=companions)
    points = list(zip(positions, velocities))
    table = kind(positions, velocities).encounters(3, until=4)
    assert (table["a"] < table["b"]).all() and table["begin"].is_monotonic_increasing
    assert (table["begin_lo"] <= table["begin"]).all() and (table["begin"] <= table["begin_hi"]).all()
    for step in range(33):
        time = Fraction(step, 8)
        now = table[(table["begin_lo"] <= time) & (table["end_hi"] >= time)]
        assert set(zip(now["a"], now["b"])) == near_pairs(points, time, 3)


def test_encounters_have_the_least_distance_and_its_time():
    kd = kinetri.KineticDelaunay([[0, 0], [4, 3]], [[1, 0], [-1, 0]])
    row = kd.encounters(5, until=10).iloc[0]
    assert (row["begin"], row["closest"], row["end"], row["distance"]) == (0, 2, 4, 3)


def test_discs_have_gaps():
    sim = kinetri.Simulation([[0, 0], [9, 0]], [[1, 0], [0, 0]], radius=[1, 2], collisions="log")
    row = sim.encounters(2, until=6).iloc[0]
    assert (row["begin"], row["end"], row["distance"], row["gap"]) == (4, 6, 3, 0)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("companions", [0, 3])
def test_components_are_those_of_the_near_pairs(seed, companions):
    positions, velocities = scene(seed, companions=companions)
    points = list(zip(positions, velocities))
    table = kinetri.KineticDelaunay(positions, velocities).components(3, until=4)
    assert table["kind"][0] == "start" and table["a"].isna()[0] and table["b"].isna()[0]
    assert set(table["kind"][1:]) <= {"merge", "split"}
    for step in range(33):
        time = Fraction(step, 8)
        parent = list(range(len(points)))

        def root(a):
            while parent[a] != a:
                a = parent[a]
            return a

        for a, b in near_pairs(points, time, 3):
            parent[root(a)] = root(b)
        sizes = np.bincount([root(a) for a in range(len(points))])
        now = table[table["time_hi"] <= time].iloc[-1]
        assert (now["components"], now["largest"]) == (np.count_nonzero(sizes), sizes.max())


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("companions", [0, 3])
def test_neighbor_lives_are_the_edges_of_every_time(seed, companions):
    positions, velocities = scene(seed, companions=companions)
    table = kinetri.KineticDelaunay(positions, velocities).neighbor_lives(until=4, ridge=0.5)
    kd = kinetri.KineticDelaunay(positions, velocities)
    companionships = [(a, 12 - companions + a) for a in range(companions)]
    for step in range(32):
        time = step / 8 + 1 / 64  # no event is at such a time
        kd.advance_to(time)
        now = table[(table["begin_lo"] <= time) & (table["end_hi"] >= time)]
        assert sorted(zip(now["a"], now["b"])) == sorted([*map(tuple, kd.edges().tolist()), *companionships])
    assert set(table["begins_by"]) <= {"run", "exchange"} and table["short"].dtype == bool
    assert (table["begins_by"] == "run").sum() == companions + len(
        kinetri.KineticDelaunay(positions, velocities).edges())


def test_exchanges_are_counted_by_point():
    positions, velocities = scene(2)
    kd = kinetri.KineticDelaunay(positions, velocities)
    table = kd.exchanges(until=4)
    events = kinetri.KineticDelaunay(positions, velocities).record(4)
    gained = np.bincount(events["added"][events["added"][:, 0] != kinetri.NO_POINT].ravel(), minlength=12)
    lost = np.bincount(events["removed"][events["removed"][:, 0] != kinetri.NO_POINT].ravel(), minlength=12)
    assert table["id"].tolist() == list(range(12))
    assert table["gained"].tolist() == gained.tolist() and table["lost"].tolist() == lost.tolist()
    assert set(table["from"]) == {0} and set(table["until"]) == {4} and "short" not in table


def test_certificates_are_those_of_all_events():
    positions, velocities = scene(2)
    kd = kinetri.KineticDelaunay(positions, velocities)
    watch = kd.watch("certificates")
    kd.advance_to(2)
    table = watch.table()
    assert table.equals(kinetri.KineticDelaunay(positions, velocities).certificates(until=2))
    events = kinetri.KineticDelaunay(positions, velocities).record(2)
    assert len(table) == len(events) > 0 and table["event"].tolist() == list(range(len(events)))
    for text, low, high in zip(table["certificate"], events["time_lo"], events["time_hi"]):
        row = json.loads(text)
        (lower, e), (upper, f) = row["lower"], row["upper"]
        assert low <= int(lower) * Fraction(2) ** e <= int(upper) * Fraction(2) ** f <= high
    sim = kinetri.Simulation([[1, 1]], [[-1, 0]], box=[0, 0, 2, 2])
    assert sim.certificates(until=1.5)["kind"].tolist() == ["wall"]


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("companions", [0, 3])
def test_nearest_neighbor_changes_lead_to_the_nearest_neighbors(seed, companions):
    positions, velocities = scene(seed, companions=companions)
    table = kinetri.KineticDelaunay(positions, velocities).nearest_neighbor_changes(until=4)
    assert table["before"].isna().sum() == 12 and not pd.isna(table["after"]).any()
    kd = kinetri.KineticDelaunay(positions, velocities)
    for step in range(33):
        kd.advance_to(step / 8)
        now = table[table["time_lo"] <= step / 8].groupby("id")["after"].last()
        assert now.tolist() == kd.nearest_neighbors().ids.tolist()


def test_several_watches_follow_one_run():
    positions, velocities = scene(1)
    kd = kinetri.KineticDelaunay(positions, velocities)
    watches = [kd.watch("encounters", range=3), kd.watch("components", range=3)]
    kd.advance_to(2)
    halfway = len(watches[0].table())
    kd.advance_to(4)
    other = kinetri.KineticDelaunay(positions, velocities)
    assert watches[0].table().equals(other.encounters(3, until=4))
    assert halfway <= len(watches[0].table())
    assert watches[1].table().equals(kinetri.KineticDelaunay(positions, velocities).components(3, until=4))


def test_tracks_have_labels_and_dates():
    times = np.array(["2026-01-01T00:00", "2026-01-01T00:04"], dtype="datetime64[s]")
    tracks = kinetri.Tracks.from_arrays(np.tile(times, 2), ["a", "a", "b", "b"], [0, 240, 240, 0], [0, 0, 3, 3])
    row = tracks.encounters(5).iloc[0]
    assert (row["a"], row["b"], row["begin"], row["end"]) == ("a", "b", 118, 122)
    assert row["begin_date"] == np.datetime64("2026-01-01T00:01:58")
    table = tracks.components(5)
    assert table["kind"].tolist()[:3] == ["start", "merge", "split"]
    assert table["a"].tolist()[:2] == [None, "a"]
    assert table["date"][1] == np.datetime64("2026-01-01T00:01:58")


@pytest.mark.parametrize("arguments, message", [
    ((), "range is missing"), ((-1,), "range"), ((np.nan,), "range"), ((np.inf,), "range"), (("far",), "range")])
def test_a_range_is_a_number(arguments, message):
    kd = kinetri.KineticDelaunay([[0, 0], [4, 3]], [[1, 0], [-1, 0]])
    with pytest.raises((kinetri.PreconditionError, TypeError), match=message):
        kd.watch("encounters", **dict(zip(["range"], arguments)))


def test_a_question_has_a_name_and_what_belongs_to_it():
    kd = kinetri.KineticDelaunay([[0, 0], [4, 3]], [[1, 0], [-1, 0]])
    with pytest.raises(kinetri.PreconditionError, match="'meetings'; expected one of 'closest', 'encounters'"):
        kd.watch("meetings", range=1)
    with pytest.raises(kinetri.PreconditionError, match="number is given; expected range for 'encounters'"):
        kd.watch("encounters", range=1, number=3)


def test_components_of_discs_of_different_radii_are_refused():
    sim = kinetri.Simulation([[0, 0], [9, 0]], [[1, 0], [0, 0]], radius=[1, 2], collisions="log")
    with pytest.raises(kinetri.PreconditionError, match="radii of their own"):
        sim.components(2, until=1)
