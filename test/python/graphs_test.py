# SPDX-License-Identifier: GPL-3.0-or-later
"""Graphs of near points, at a time and over time, against all pairs and triples in exact arithmetic."""
from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest

import kinetri


def places_at(positions, velocities, time):
    """Exact, at a rational time."""
    return [tuple(Fraction(x) + Fraction(v) * time for x, v in zip(place, velocity))
            for place, velocity in zip(np.asarray(positions).tolist(), np.asarray(velocities).tolist())]


def squared_distance(p, q):
    return sum((x - y) ** 2 for x, y in zip(p, q))


def gabriel(places):
    d = squared_distance
    return [[a, b] for a, b in combinations(range(len(places)), 2)
            if all(d(places[a], c) + d(places[b], c) > d(places[a], places[b])
                   for i, c in enumerate(places) if i not in (a, b))]


def relative_neighbors(places):
    d = squared_distance
    return [[a, b] for a, b in combinations(range(len(places)), 2)
            if all(max(d(places[a], c), d(places[b], c)) >= d(places[a], places[b])
                   for i, c in enumerate(places) if i not in (a, b))]


def scene(seed, n=12):
    rng = np.random.default_rng(seed)
    return rng.uniform(0, 20, (n, 2)), rng.uniform(-2, 2, (n, 2))


@pytest.mark.parametrize("seed", range(30))
def test_graphs_of_points_on_a_grid(seed):
    """Many right angles, equal distances, and points on one circle or line."""
    rng = np.random.default_rng(seed)
    side = 3 + seed % 3
    cells = rng.choice(side * side, size=min(9, side * side), replace=False)
    places = np.column_stack((cells // side, cells % side)).astype(float)
    if seed % 5 == 0:
        places[:, 1] = 0
        places[:, 0] = cells
    kd = kinetri.KineticDelaunay(places, np.zeros_like(places))
    exact = places_at(places, np.zeros_like(places), 0)
    assert kd.gabriel_edges().tolist() == gabriel(exact)
    assert kd.relative_neighbor_edges().tolist() == relative_neighbors(exact)


@pytest.mark.parametrize("kind", [kinetri.KineticDelaunay, kinetri.Simulation])
def test_graphs_of_moving_points(kind):
    positions, velocities = scene(3)
    moving = kind(positions, velocities)
    for step in range(9):
        moving.advance_to(step / 2)
        exact = places_at(positions, velocities, Fraction(step, 2))
        assert moving.gabriel_edges().tolist() == gabriel(exact)
        assert moving.relative_neighbor_edges().tolist() == relative_neighbors(exact)
    assert moving.gabriel_edges().shape[1] == 2 and moving.gabriel_edges().dtype == np.uint32


def test_graphs_are_those_just_after_the_time():
    """At t = 0 the angle at 2 is a right one; then it gets sharper, or blunter."""
    for speed, edges in ((1, [[0, 1], [0, 2], [1, 2]]), (-1, [[0, 2], [1, 2]])):
        kd = kinetri.KineticDelaunay([[-5, 0], [5, 0], [3, 4]], [[0, 0], [0, 0], [0, speed]])
        assert kd.gabriel_edges().tolist() == edges


def test_graphs_of_few_points_and_of_discs():
    one = kinetri.KineticDelaunay([[1, 2]], [[0, 0]])
    assert one.gabriel_edges().shape == (0, 2) and one.relative_neighbor_edges().shape == (0, 2)
    discs = kinetri.KineticRegular([[0, 0], [4, 0]], [[0, 0], [0, 0]], radius=[1, 2])
    with pytest.raises(kinetri.PreconditionError, match="expected points without radii of their own"):
        discs.gabriel_edges()
    with pytest.raises(kinetri.PreconditionError, match="expected points without radii of their own"):
        discs.relative_neighbor_edges()
    with pytest.raises(kinetri.PreconditionError, match="radii of their own"):
        discs.spanning_tree(until=1)
    with pytest.raises(kinetri.PreconditionError, match="radii of their own"):
        discs.connected(0, 1, 2, until=1)


def tree_at(table, time):
    """The edges that the rows up to that time tell of, which is that of no event."""
    edges = set()
    for row in table[(table["time"] <= time) & table["kind"].isin(["start", "add", "remove"])].itertuples():
        change = edges.remove if row.kind == "remove" else edges.add
        change((row.a, row.b))
    return sorted(edges)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("kind", [kinetri.KineticDelaunay, kinetri.Simulation])
def test_the_spanning_tree_is_that_of_each_time(seed, kind):
    graphs = pytest.importorskip("scipy.sparse.csgraph")
    positions, velocities = scene(seed, 20)
    table = kind(positions, velocities).spanning_tree(until=4)
    assert (table["a"] < table["b"]).all()
    assert (table["time_lo"] <= table["time"]).all() and (table["time"] <= table["time_hi"]).all()
    longest = table[table["kind"] == "longest"]
    ranges = []
    for step in range(64):
        time = step / 16 + 1 / 64
        places = positions + time * velocities
        distances = np.hypot(*(places[:, None] - places).transpose(2, 0, 1))
        tree = graphs.minimum_spanning_tree(np.triu(distances)).tocoo()
        edges = tree_at(table, time)
        assert edges == sorted(zip(tree.row.tolist(), tree.col.tolist()))
        last = longest[longest["time"] <= time].iloc[-1]
        assert (last["a"], last["b"]) == max(edges, key=lambda edge: distances[edge])
        ranges.append(tree.data.max())
    least, greatest = table.iloc[-2], table.iloc[-1]
    assert (least["kind"], greatest["kind"]) == ("least", "greatest")
    assert least["length"] <= min(ranges) and max(ranges) <= greatest["length"]
    for row in (least, greatest):
        places = positions + row["time"] * velocities
        assert np.isclose(np.hypot(*(places[row["a"]] - places[row["b"]])), row["length"], rtol=1e-12)
    assert table["length"].isna().tolist() == table["kind"].isin(["start", "add", "remove"]).tolist()


def roots(n, edges):
    """Of each point, the least one that it is connected with."""
    parent = list(range(n))

    def root(a):
        while parent[a] != a:
            a = parent[a]
        return a

    for a, b in edges:
        p, q = sorted((root(a), root(b)))
        parent[q] = p
    return [root(a) for a in range(n)]


def is_within(table, time):
    """Whether a time is in one of the intervals, exactly: bounds of irrational times have no number between."""
    return bool(((table["begin_hi"] <= time) & (time <= table["end_lo"])).any())


@pytest.mark.parametrize("seed", range(4))
def test_two_points_are_connected_at_the_times_at_which_links_connect_them(seed):
    positions, velocities = scene(seed)
    pairs = [(0, 1), (5, 2), (7, 11)]
    tables = [kinetri.KineticDelaunay(positions, velocities).connected(*pair, 6, until=4) for pair in pairs]
    found = set()
    for step in range(65):
        time = Fraction(step, 16)
        places = places_at(positions, velocities, time)
        near = [(a, b) for a, b in combinations(range(12), 2) if squared_distance(places[a], places[b]) <= 36]
        root = roots(12, near)
        for (a, b), table in zip(pairs, tables):
            assert is_within(table, time) == (root[a] == root[b])
            found.add(root[a] == root[b])
    assert found == {False, True}
    for (a, b), table in zip(pairs, tables):
        assert (table["a"] == a).all() and (table["b"] == b).all()
        assert (table["end_hi"][:-1].to_numpy() <= table["begin_lo"][1:].to_numpy()).all()


def test_a_touch_is_a_connection_of_one_moment():
    kd = kinetri.KineticDelaunay([[0, 0], [-5, 3], [0, 20]], [[0, 0], [1, 0], [0, 0]])
    table = kd.connected(1, 0, 3, until=20)
    assert table.values.tolist() == [[1, 0, 5, 5, 5, 5, 5, 5]]


def test_whose_connection_is_asked_must_be_two_points():
    kd = kinetri.KineticDelaunay([[0, 0], [4, 3]], [[1, 0], [-1, 0]])
    for pair, message in (((0, 2), "there is no point 2; expected ids less than 2"), ((0, -1), "b is -1"),
                          ((1, 1), "one point twice"), (("a", 1), "a is 'a'")):
        with pytest.raises(kinetri.PreconditionError, match=message):
            kd.connected(*pair, 3, until=1)
    with pytest.raises(kinetri.PreconditionError, match="between is missing"):
        kd.watch("connected", range=1)
    with pytest.raises(kinetri.PreconditionError, match=r"between has the shape \(3,\)"):
        kd.watch("connected", range=1, between=[0, 1, 2])
    with pytest.raises(kinetri.PreconditionError, match="between is given; expected range for 'encounters'"):
        kd.watch("encounters", range=1, between=[0, 1])


# ---- of tracks ----

def walks(seed, things=8):
    """Rows of t, label, x, y: walks with gaps."""
    rng = np.random.default_rng(seed)
    rows = []
    for thing in range(things):
        place = rng.integers(0, 12, 2)
        for time in range(13):
            place = place + rng.integers(-2, 3, 2)
            if rng.random() < 0.8:
                rows.append((time, f"w{thing}", *place.tolist()))
    return rows


def present(rows, time):
    """Exactly where each thing is at a rational time, by label; not within gaps longer than 1."""
    result = {}
    for label in {row[1] for row in rows}:
        seen = sorted((t, x, y) for t, name, x, y in rows if name == label)
        for (t, *p), (u, *q) in zip(seen, seen[1:]):
            if t <= time <= u and u - t <= 1:
                result[label] = tuple(x + (y - x) * (time - t) / Fraction(u - t) for x, y in zip(p, q))
    return result


@pytest.mark.parametrize("seed", range(4))
def test_things_are_connected_by_label_however_often_they_leave(seed):
    rows = walks(seed)
    tracks = kinetri.Tracks.from_arrays(*zip(*rows), max_gap=1)
    pairs = [("w1", "w0"), ("w2", "w5"), ("w3", "w7")]
    tables = [tracks.connected(*pair, 6) for pair in pairs]
    for step in range(12 * 8):
        time = Fraction(2 * step + 1, 16)  # nothing comes or goes at such a time
        there = present(rows, time)
        names = sorted(there)
        near = [(i, j) for i, j in combinations(range(len(names)), 2)
                if squared_distance(there[names[i]], there[names[j]]) <= 36]
        root = dict(zip(names, roots(len(names), near)))
        for (a, b), table in zip(pairs, tables):
            assert is_within(table, time) == (a in root and b in root and root[a] == root[b])
    assert sum(map(len, tables)) > 2
    assert all((table["a"] == a).all() and (table["b"] == b).all() for (a, b), table in zip(pairs, tables))


def test_tables_of_tracks_have_labels_and_dates():
    times = np.array(["2026-01-01T00:00", "2026-01-01T00:04"], dtype="datetime64[s]")
    tracks = kinetri.Tracks.from_arrays(np.tile(times, 3), ["a", "a", "b", "b", "c", "c"],
                                        [0, 240, 240, 0, 500, 500], [0, 0, 3, 3, 1.5, 1.5])
    middle = np.datetime64("2026-01-01T00:02:00")
    lives = tracks.neighbor_lives(ridge=1)
    assert {*lives["a"], *lives["b"]} == {"a", "b", "c"} and lives["short"].dtype == bool
    assert (lives["end_date"] == lives["begin_date"] + np.timedelta64(240, "s")).all()
    exchanges = tracks.exchanges()
    assert exchanges["id"].tolist() == ["a", "b", "c"] and exchanges["rate"].tolist() == [0, 0, 0]
    assert (exchanges["from_date"] == times[0]).all() and (exchanges["until_date"] == times[1]).all()
    nearest = tracks.nearest_neighbor_changes()
    start = nearest[nearest["date"] == times[0]]
    assert start["before"].isna().all()
    assert start[["id", "after"]].values.tolist() == [["a", "b"], ["b", "a"], ["c", "b"]]
    assert nearest[nearest["id"] == "c"]["after"].tolist()[:2] == ["b", "a"]
    assert nearest[nearest["id"] == "c"]["date"].tolist()[1] == middle
    tree = tracks.spanning_tree()
    assert tree[tree["kind"] == "start"][["a", "b"]].values.tolist() == [["a", "b"], ["b", "c"]]
    added = tree[tree["kind"] == "add"]
    assert added[["a", "b"]].values.tolist() == [["a", "c"]] and added["date"].tolist() == [middle]
    connected = tracks.connected("b", "a", 5)
    assert connected[["a", "b"]].values.tolist() == [["b", "a"]]
    assert connected["begin_date"][0] == np.datetime64("2026-01-01T00:01:58")
    with pytest.raises(kinetri.PreconditionError, match="b is 'x'; expected one of labels"):
        tracks.connected("a", "x", 5)
    with pytest.raises(kinetri.PreconditionError, match="a and b are both 'a'"):
        tracks.connected("a", "a", 5)
