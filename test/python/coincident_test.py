# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that coincide for a while: against a run without the hidden ones, and against runs that begin anew."""
import copy
import pickle

import numpy as np
import pandas as pd
import pytest
from support import edge_set, nearest_of_all_pairs, trajectory, uniform

import kinetri
from kinetri import Tracks

#: 0 and 2 go together, and so do 1, 4 and 5; 3 and 6 go alone.
PLACES = np.array([[0, 0], [10, 1], [0, 0], [1, 9], [10, 1], [10, 1], [8, 11]])
VELOCITIES = np.array([[1, 0], [0, 1], [1, 0], [0, -1], [0, 1], [0, 1], [-1, -1]])
SHOWN = [0, 1, 3, 6]
GROUPS = [[0, 2], [1, 4, 5], [0, 2], [3], [1, 4, 5], [1, 4, 5], [6]]
BOX = (-20, -20, 30, 30)


def accelerated(positions, velocities, **options):
    return kinetri.KineticDelaunay(positions, velocities, acceleration=np.asarray(velocities) * [1, 2], **options)


def regular(positions, velocities, **options):
    return kinetri.KineticRegular(positions, velocities, radius=0.5, **options)


def discs(positions, velocities, **options):
    return kinetri.Simulation(positions, velocities, radius=0.5, **options)


KINDS = [kinetri.KineticDelaunay, kinetri.KineticRegular, kinetri.Simulation, accelerated, regular, discs]


def renamed(ids, names):
    """The ids in an array, each of which counts the names."""
    return np.append(names, kinetri.NO_POINT)[np.minimum(ids, len(names))]


def made_anew(points):
    """A triangulation of the points that there are, and their ids."""
    ids = points.ids
    return kinetri.KineticDelaunay(points.positions()[ids], points.velocities()[ids]), ids


def is_as_made_anew(points):
    """Whether edges, triangles and hidden points are those of the present positions and velocities."""
    other, ids = made_anew(points)
    return bool(points.audit()) and all(
        np.array_equal(getattr(points, name)(), renamed(getattr(other, name)(), ids))
        for name in ("edges", "triangles", "hull", "hidden_points"))


# ---- at the start ----

@pytest.mark.parametrize("kind", KINDS)
def test_the_others_have_the_run_without_the_hidden_ones(kind):
    positions, velocities = uniform(40, 5)
    random = np.random.default_rng(6)
    # Each of the 40 motions, some of them several times, in any order.
    motion = random.permutation([*range(40), *random.integers(0, 40, 25)])
    groups = [np.flatnonzero(motion == motion[id]).tolist() for id in range(65)]
    shown = [id for id in range(65) if groups[id][0] == id]
    hidden = [id for id in range(65) if groups[id][0] != id]
    points = kind(positions[motion], velocities[motion])
    others = kind(positions[motion[shown]], velocities[motion[shown]])
    assert len(points) == 65 and points.ids.tolist() == list(range(65))
    happened = 0
    for time in (0, 0.7, 2):
        events, expected = points.record(time), others.record(time)
        happened += len(expected)
        assert events["kind"].tolist() == expected["kind"].tolist()
        assert events["time"].tolist() == expected["time"].tolist()
        for name in ("removed", "added", "points"):
            assert np.array_equal(events[name], renamed(expected[name], shown))
        for name in ("edges", "triangles", "hull"):
            assert np.array_equal(getattr(points, name)(), renamed(getattr(others, name)(), shown))
        assert points.hidden_points().tolist() == hidden and points.audit()
        for id, group in enumerate(groups):
            assert points.coincident_points(id).tolist() == [other for other in group if other != id]
            assert points.positions()[id].tolist() == others.positions()[shown.index(group[0])].tolist()
            assert points.velocities()[id].tolist() == others.velocities()[shown.index(group[0])].tolist()
            assert trajectory(points.motion(id)) == trajectory(points.motion(group[0]))
    assert happened > 30


@pytest.mark.parametrize("kind", KINDS)
def test_a_hidden_point_is_a_neighbor_of_the_one_that_hides_it(kind):
    points, others = kind(PLACES, VELOCITIES), kind(PLACES[SHOWN], VELOCITIES[SHOWN])
    points.advance_to(1.5)
    others.advance_to(1.5)
    for i, id in enumerate(SHOWN):
        hidden = GROUPS[id][1:]
        assert points.neighbors(id).tolist() == [*renamed(others.neighbors(i), SHOWN).tolist(), *hidden]
        for other in hidden:
            assert points.neighbors(other).tolist() == [id]
    assert points.nearest_vertex(points.positions()[5]) == 1
    assert points.locate(points.positions()[5]) == ("vertex", (1,))


@pytest.mark.parametrize("kind", [kinetri.KineticDelaunay, kinetri.Simulation])
def test_nearest_points_are_those_that_coincide(kind):
    points = kind(PLACES, VELOCITIES)
    for time in (0, 1, 2):
        points.advance_to(time)
        for k in (1, 2, 3, 7):
            ids, distances = points.nearest_neighbors(k)
            assert np.array_equal(ids, nearest_of_all_pairs(points, k))
            assert (distances[[0, 2, 1, 4, 5], 0] == 0).all() and (distances[[3, 6], 0] > 0).all()
        assert np.array_equal(points.nearest_neighbors().ids, nearest_of_all_pairs(points, 1)[:, 0])
        assert points.closest_pair() == (0, 2)


@pytest.mark.parametrize("kind", KINDS)
def test_the_area_of_a_cell_is_shared_equally(kind):
    points, others = kind(PLACES, VELOCITIES), kind(PLACES[SHOWN], VELOCITIES[SHOWN])
    square = [[-20, -20], [30, -20], [30, 30], [-20, 30]]

    def shared(areas):
        return pytest.approx([areas[SHOWN.index(group[0])] / len(group) for group in GROUPS])

    assert points.voronoi_areas(BOX) == shared(others.voronoi_areas(BOX))
    assert points.cell_areas(square, cutoff=6) == shared(others.cell_areas(square, cutoff=6))
    table, expected = (run.mean_areas(until=1, walkable=square, tolerance=1e-9) for run in (points, others))
    assert table["id"].tolist() == list(range(7)) and set(table["from"]) == {0} and set(table["until"]) == {1}
    assert table["area"].to_numpy() == shared(expected["area"].to_numpy())
    table, expected = (run.areas([2.5], walkable=square) for run in (points, others))
    assert table["area"].to_numpy() == shared(expected["area"].to_numpy())
    assert table["density"].to_numpy() == pytest.approx(1 / table["area"].to_numpy())
    assert points.voronoi_areas(BOX).sum() == pytest.approx(2500)
    for id, group in enumerate(GROUPS):
        assert np.array_equal(points.voronoi_cell(id).vertices, points.voronoi_cell(group[0]).vertices)


def test_all_points_in_one_place():
    for kind in KINDS:
        points = kind([[1, 2]] * 3, [[0, 0]] * 3)
        assert points.hidden_points().tolist() == [1, 2] and points.hull().tolist() == [0]
        assert len(points.edges()) == len(points.triangles()) == 0
        assert points.advance_to(2) == 0 and points.positions().tolist() == [[1, 2]] * 3
        assert [points.neighbors(id).tolist() for id in range(3)] == [[1, 2], [0], [0]]
        assert points.voronoi_areas(BOX) == pytest.approx([2500 / 3] * 3) and points.audit()


def test_points_that_only_meet_hide_nothing():
    kd = kinetri.KineticDelaunay([[0, 0], [0, 0], [5, 1]], [[1, 0], [0, 1], [0, 0]])
    assert kd.hidden_points().tolist() == [] and kd.coincident_points(0).tolist() == []
    # In one place, with one velocity, until the acceleration parts them.
    kd = kinetri.KineticDelaunay([[0, 0], [0, 0], [5, 1]], [[1, 0]] * 3, acceleration=[[0, 0], [0, 1], [0, 0]])
    assert kd.hidden_points().tolist() == [] and (0, 1) in edge_set(kd.edges())


def test_weights_must_be_equal_too():
    kr = kinetri.KineticRegular([[0, 0], [9, 0], [0, 0], [0, 0], [3, 8]], [[0, 0]] * 5, radius=[2, 1, 3, 2, 1])
    # The point 2 has a greater weight, and so hides 0 and 3, as weights do.
    assert kr.hidden_points().tolist() == [0, 3] and kr.hull().tolist() == [1, 4, 2]
    assert [kr.coincident_points(id).tolist() for id in range(5)] == [[3], [], [], [0], []]
    # A weight instead of a part of the radius: 5^2 = 3^2 + 16.
    kr = kinetri.KineticRegular([[0, 0], [9, 0], [0, 0]], [[0, 0]] * 3, radius=[5, 1, 3], weight=[0, 0, 16])
    assert kr.hidden_points().tolist() == [2] and kr.coincident_points(2).tolist() == [0] and kr.audit()


def test_a_point_that_is_not_there():
    kd = kinetri.KineticDelaunay(PLACES, VELOCITIES)
    kd.erase(3)
    for id in (3, 7):
        with pytest.raises(kinetri.PreconditionError, match=f"there is no point {id}; expected an id that has"):
            kd.coincident_points(id)
    with pytest.raises(kinetri.PreconditionError, match="id is -1; expected an id from 0 to"):
        kd.coincident_points(-1)


# ---- changes ----

@pytest.mark.parametrize("kind", [kinetri.KineticDelaunay, kinetri.Simulation, accelerated])
def test_points_join_and_part(kind):
    points = kind([[0, 0], [8, 0], [0, 8], [8, 9], [3, 3]], [[0, 0]] * 5)
    points.advance_to(1)
    points.set_motions([3, 1], [[4, 1]] * 2, [[1, 0]] * 2)
    assert points.hidden_points().tolist() == [3] and points.coincident_points(1).tolist() == [3]
    assert is_as_made_anew(points)
    points.set_motions(2, [4, 1], [1, 0])
    assert points.hidden_points().tolist() == [2, 3] and points.coincident_points(3).tolist() == [1, 2]
    assert is_as_made_anew(points)
    # A point with a smaller id joins, and has the edges from then on.
    points.set_motions(0, [4, 1], [1, 0])
    assert points.hidden_points().tolist() == [1, 2, 3] and is_as_made_anew(points)
    points.advance_to(2)
    points.set_motions([0, 2], [[5, 1], [0, 0]], [[0, 1], [1, 1]])
    assert points.hidden_points().tolist() == [3] and is_as_made_anew(points)
    assert points.positions()[:4].tolist() == [[5, 1], [5, 1], [0, 0], [5, 1]]
    points.set_velocities(3, [0, -1])
    assert points.hidden_points().tolist() == [] and is_as_made_anew(points)
    points.advance_to(4)
    assert points.positions().tolist() == [[5, 3], [7, 1], [2, 2], [5, -1], [3, 3]]
    counts = points.statistics()["events"]
    assert counts["hide"] == counts["reveal"] == 3  # of 3, 2 and 1; of 1, 2 and 3


@pytest.mark.parametrize("erased", [[0], [2], [0, 2], [1], [4], [1, 4], [4, 5], [1, 4, 5], [2, 3, 5], SHOWN])
@pytest.mark.parametrize("kind", [kinetri.KineticDelaunay, kinetri.Simulation])
def test_points_are_erased(kind, erased):
    points = kind(PLACES, VELOCITIES)
    points.advance_to(1)
    points.erase(erased)
    left = [id for id in range(7) if id not in erased]
    assert points.ids.tolist() == left and len(points) == len(left) and is_as_made_anew(points)
    for id in left:
        assert points.coincident_points(id).tolist() == [other for other in GROUPS[id] if other in left and other != id]


def test_points_are_inserted():
    for kind in KINDS:
        sizes = {"radius": 0.5} if kind is regular else {}
        points = kind(PLACES, VELOCITIES)
        edges = edge_set(points.edges())
        motion = {"acceleration": [0, 2]} if kind is accelerated else {}
        assert points.insert([10, 1], [0, 1], **motion, **sizes).tolist() == [7]
        assert points.hidden_points().tolist() == [2, 4, 5, 7] and edge_set(points.edges()) == edges
        assert points.coincident_points(4).tolist() == [1, 5, 7] and points.audit()


def test_velocities_that_are_set_again_keep_points_together():
    kd = kinetri.KineticDelaunay(PLACES / 3, VELOCITIES / 7)
    kd.advance_to(0.3)
    kd.set_velocities(kd.velocities())
    assert kd.hidden_points().tolist() == [2, 4, 5] and is_as_made_anew(kd)
    kd.set_velocities([1, 4], [3, 4])
    assert kd.hidden_points().tolist() == [2, 4] and kd.coincident_points(5).tolist() == [] and is_as_made_anew(kd)


def test_events_name_the_point_that_hides():
    sim = kinetri.Simulation([[0, 0], [4, 1], [0, 0], [1, 5]], [[1, 0], [0, 0], [1, 0], [0, 0]])
    edges = edge_set(sim.edges())
    sim.schedule_motion(1, 3, [1, 0], [1, 0])
    sim.schedule_motion(2, 0, [2, 0], [0, 1])
    sim.schedule_erase(3, 2)
    events = sim.record(until=5)
    named = events[np.isin(events["kind"], ["hide", "reveal"])]
    assert [(kind, time, *points) for kind, time, points in
            zip(named["kind"].tolist(), named["time"].tolist(), named["points"].tolist())] == [
                ("hide", 1, 3, 0), ("reveal", 2, 2, 0), ("reveal", 3, 3, 2)]
    for event in events:
        edges -= {tuple(event["removed"].tolist())}
        edges |= {tuple(event["added"].tolist())} - {(kinetri.NO_POINT,) * 2}
    assert edges == edge_set(sim.edges()) and is_as_made_anew(sim)
    again = kinetri.Simulation([[0, 0], [4, 1], [0, 0]], [[1, 0], [0, 0], [1, 0]])
    again.schedule_motion(2, 0, [2, 0], [0, 1])
    assert [event.points for event in again.events() if event.kind == "reveal"] == [(2, 0)]
    table = kinetri.to_dataframe(named)
    assert table["point_a"].tolist() == [3, 2, 3] and table["point_b"].tolist() == [0, 0, 2]


def test_time_runs_backwards():
    kd = kinetri.KineticDelaunay(PLACES, VELOCITIES)
    start = kd.edges()
    forward = kd.record(until=6)
    kd.reverse()
    assert kd.hidden_points().tolist() == [2, 4, 5] and kd.coincident_points(5).tolist() == [1, 4]
    backward = kd.record(until=0)
    assert len(forward) > 0 and backward["time"].tolist() == (-forward["time"][::-1]).tolist()
    assert np.array_equal(kd.edges(), start)


# ---- answers about a run ----

#: B goes alone from 0 to 12. A is with it from 2 to 10, which is all of A's time; C is far.
TOGETHER = {"t": [2, 10, 0, 2, 10, 12, 0, 12], "id": ["A"] * 2 + ["B"] * 4 + ["C"] * 2,
            "x": [0, 8, 0, 0, 8, 12, 50, 50], "y": [0, 0, -4, 0, 0, -4, 50, 62]}
#: A and B come from two sides, go together from 2 to 10, and part.
MEETING = {"t": [0, 2, 10, 12] * 2 + [0, 12], "id": ["A"] * 4 + ["B"] * 4 + ["C"] * 2,
           "x": [-4, 0, 8, 12, 0, 0, 8, 12, 50, 50], "y": [0, 0, 0, 4, -4, 0, 0, -4, 50, 62]}


def rows(table, *columns):
    """The rows of some columns as tuples."""
    return list(zip(*(table[column] for column in columns)))


def test_an_encounter_lasts_while_two_go_together():
    tracks = Tracks.from_arrays(*TOGETHER.values())
    table = tracks.encounters(2)
    assert rows(table, "a", "b", "begin", "end", "closest", "distance") == [("B", "A", 2, 10, 2, 0)]
    assert (table["begin_lo"] == table["begin_hi"]).all() and (table["end_lo"] == table["end_hi"]).all()
    events = tracks.record(kinds=["insert", "hide", "reveal"])
    # The erasure of A needs no event of its own: B has the edges.
    assert rows(events, "kind", "time") == [("insert", 2), ("hide", 2)] and events["points"][1].tolist() == [2, 0]


def test_two_meet_go_together_and_part():
    tracks = Tracks.from_arrays(*MEETING.values())
    events = tracks.record(kinds=["hide", "reveal"])
    assert rows(events, "kind", "time") == [("hide", 2), ("reveal", 10)] and events["points"].tolist() == [[1, 0]] * 2
    assert rows(tracks.encounters(0), "a", "b", "begin", "end", "closest", "distance") == [("A", "B", 2, 10, 2, 0)]
    # Before 2 the distance is sqrt(2) (4 - 2 t), after 10 it is 4 (t - 10).
    begin, end = 2 - np.sqrt(0.5), 10.5
    near = tracks.encounters(2)
    assert rows(near, "a", "b", "end", "closest", "distance") == [("A", "B", end, 2, 0)]
    assert near["begin"][0] == pytest.approx(begin, rel=1e-15)
    connected = tracks.connected("A", "B", 2)
    assert rows(connected, "begin", "end") == rows(near, "begin", "end")
    components = tracks.components(2)
    components = components[components["kind"] != "erase"]
    assert rows(components, "kind", "components", "largest") == [("start", 3, 1), ("merge", 2, 2), ("split", 3, 1)]
    assert components["time"].tolist() == [0, near["begin"][0], end]
    assert rows(tracks.closest(1), "a", "b", "time", "distance") == [("A", "B", 2, 0)]


def test_neighbors_and_trees_of_two_who_go_together():
    tracks = Tracks.from_arrays(*MEETING.values())
    nearest = tracks.nearest_neighbor_changes()
    nearest = nearest[nearest["time"] < 12]
    for id, other in (("A", "B"), ("B", "A")):
        assert nearest[nearest["id"] == id]["after"].tolist() == [other]
    tree = tracks.spanning_tree()
    tree = tree[tree["time"] < 12]
    assert {"A", "B"} in [set(pair) for pair in rows(tree[tree["kind"] == "start"], "a", "b")]
    assert {"A", "B"} not in [set(pair) for pair in rows(tree[tree["kind"].isin(["remove", "add"])], "a", "b")]
    lives = tracks.neighbor_lives()
    lives = lives[(lives["a"] == "A") & (lives["b"] == "B")]
    assert lives["begin"].iloc[0] == 0 and lives["end"].iloc[-1] == 12
    assert lives["begin"].tolist()[1:] == lives["end"].tolist()[:-1]
    square = [[-20, -20], [60, -20], [60, 70], [-20, 70]]
    areas = tracks.areas([5], walkable=square)["area"].tolist()
    others = Tracks.from_arrays(*(values[4:] for values in MEETING.values()))
    alone = others.areas([5], walkable=square)["area"].tolist()
    assert areas == pytest.approx([alone[0] / 2, alone[0] / 2, alone[1]])


def test_watches_follow_points_that_jump_together():
    kd = kinetri.KineticDelaunay([[0, 0], [8, 0], [0, 8], [8, 9]], [[0, 0]] * 4)
    encounters, components, nearest = (kd.watch(about, **options) for about, options in (
        ("encounters", {"range": 1}), ("components", {"range": 1}), ("nearest_neighbor_changes", {})))
    kd.advance_to(1)
    kd.set_motions(1, [0, 8], [0, 0])
    kd.advance_to(3)
    kd.set_motions(2, [8, 0], [0, 0])
    kd.advance_to(4)
    kd.set_motions([0, 3], [[0, 8]] * 2, [[0, 0]] * 2)
    kd.advance_to(5)
    kd.erase(0)  # which hides the others
    kd.advance_to(6)
    assert rows(encounters.table(), "a", "b", "begin", "end", "distance") == [
        (1, 2, 1, 3, 0), (0, 1, 4, 5, 0), (0, 3, 4, 5, 0), (1, 3, 4, 6, 0)]
    table = components.table()
    assert {time: table[table["time"] == time]["components"].tolist()[-1] for time in (0, 1, 3, 4, 5)} == {
        0: 4, 1: 3, 3: 4, 4: 2, 5: 2}
    table = nearest.table()
    for time, expected in ((1, [1, 2, 1, 1]), (3, [1, 0, 0, 1]), (4, [1, 0, 0, 0]), (5, [None, 3, 1, 1])):
        last = table[table["time"] <= time].groupby("id")["after"].apply(lambda after: after.iloc[-1])
        assert [None if pd.isna(id) else id for id in last] == expected


def test_contacts_of_discs_that_go_together():
    motions = [[0, 0], [0, 0], [10, 0], [50, 9]], [[1, 0], [1, 0], [-1, 0], [0, 0]]
    sim = kinetri.Simulation(*motions, radius=1, collisions="log")
    events = sim.record(until=5, kinds="collision")
    assert events["time"].tolist() == [4, 4] and events["points"].tolist() == [[0, 2], [1, 2]]
    assert sim.hidden_points().tolist() == [1] and sim.audit()
    # The first contact gives 0 and 2 each other's velocity; then 1 and 2 do not approach each other.
    sim = kinetri.Simulation(*motions, radius=1, collisions="elastic")
    events = sim.record(until=5, kinds=["collision", "hide", "reveal"])
    assert rows(events, "kind", "time") == [("collision", 4), ("reveal", 4)]
    assert events["points"].tolist() == [[0, 2], [1, 0]] and sim.audit()
    assert sim.velocities()[:3].tolist() == [[-1, 0], [1, 0], [1, 0]]
    # They overlap from the start on.
    with pytest.raises(kinetri.OverlappingDiscsError) as raised:
        kinetri.Simulation(*motions, radius=1, refuse_overlaps=True)
    assert raised.value.pairs == [[0, 1]]


# ---- state ----

@pytest.mark.parametrize("kind", KINDS)
def test_copies_know_what_is_hidden(kind, tmp_path):
    points = kind(PLACES, VELOCITIES)
    points.advance_to(1)
    points.save(tmp_path / "state")
    copies = [points.snapshot().restore(), pickle.loads(pickle.dumps(points)), copy.deepcopy(points),
              type(points).load(tmp_path / "state")]
    expected = points.record(until=8)
    points.erase(1)
    for other in copies:
        assert other.hidden_points().tolist() == [2, 4, 5] and other.coincident_points(1).tolist() == [4, 5]
        assert other.record(until=8).tobytes() == expected.tobytes()
        other.erase(1)
        assert other.hidden_points().tolist() == [2, 5] and np.array_equal(other.edges(), points.edges())


def test_pages_and_pictures_have_points_that_coincide(tmp_path):
    kd = kinetri.KineticDelaunay(PLACES, VELOCITIES)
    kd.play(2).save(tmp_path / "page.html")
    assert (tmp_path / "page.html").stat().st_size > 1000 and kd.time == 2


# ---- refused ----

@pytest.mark.parametrize("kind", KINDS)
def test_they_are_refused_at_the_start(kind):
    with pytest.raises(kinetri.CoincidentTrajectoriesError) as raised:
        kind(PLACES[:4], VELOCITIES[:4], coincident="refuse")
    assert raised.value.ids == (0, 2)
    assert str(raised.value) == (
        "points 0 and 2 are at the same place with the same velocity; expected distinct trajectories: remove one of "
        "them or change its motion, or make the object with coincident='hide'")
    assert kind(PLACES[SHOWN], VELOCITIES[SHOWN], coincident="refuse").audit()


@pytest.mark.parametrize("kind", KINDS)
def test_a_change_that_is_refused_changes_nothing(kind, tmp_path):
    points = kind(PLACES[SHOWN], VELOCITIES[SHOWN], coincident="refuse")
    points.advance_to(1)
    points.save(tmp_path / "state")
    sizes = {"radius": 0.5} if kind is regular else {}
    for other in (points, points.snapshot().restore(), copy.deepcopy(points), type(points).load(tmp_path / "state")):
        expected = other.snapshot().restore()
        for change in (lambda: other.set_motions([0, 1], [[3, 3]] * 2, [[1, 1]] * 2),
                       lambda: other.insert([[4, 4], [4, 4]], [[0, 1]] * 2, **sizes)):
            with pytest.raises(kinetri.CoincidentTrajectoriesError):
                change()
            assert len(other) == 4 and np.array_equal(other.positions()[:4], expected.positions())
            assert other.hidden_points().tolist() == [] and other.audit()
        assert other.record(until=8).tobytes() == expected.record(until=8).tobytes()


def test_velocities_that_are_refused():
    kd = kinetri.KineticDelaunay([[0, 0], [4, 0], [0, 9]], [[1, 0], [-1, 0], [0, 0]], coincident="refuse")
    kd.advance_to(2)
    with pytest.raises(kinetri.CoincidentTrajectoriesError) as raised:
        kd.set_velocities([0, 1], [0, 1])
    assert sorted(raised.value.ids) == [0, 1] and kd.velocities().tolist() == [[1, 0], [-1, 0], [0, 0]]
    # The same without refusal.
    kd = kinetri.KineticDelaunay([[0, 0], [4, 0], [0, 9]], [[1, 0], [-1, 0], [0, 0]])
    kd.advance_to(2)
    kd.set_velocities([0, 1], [0, 1])
    assert kd.hidden_points().tolist() == [1] and kd.edges().tolist() == [[0, 2]]


@pytest.mark.parametrize("word", ["keep", "Hide", None, 0])
def test_there_are_two_words(word, tmp_path):
    table = pd.DataFrame(MEETING)
    table.to_csv(tmp_path / "t.csv", index=False)
    for make in (*(lambda kind=kind, **options: kind(PLACES, VELOCITIES, **options) for kind in KINDS),
                 lambda **options: kinetri.run_in_pieces(PLACES, VELOCITIES, 1, **options),
                 lambda **options: Tracks.from_arrays(*MEETING.values(), **options),
                 lambda **options: Tracks.from_dataframe(table, **options),
                 lambda **options: Tracks.read(tmp_path / "t.csv", **options)):
        with pytest.raises(ValueError) as raised:
            make(coincident=word)
        assert isinstance(raised.value, kinetri.PreconditionError)
        assert str(raised.value) == f"coincident is {word!r}; expected 'hide' or 'refuse'"
