# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers about runs in periodic boxes: compared with the events of the same run, and with places in fractions."""
import json
from collections import Counter

import numpy as np
import pytest
from periodic_support import BOXES, edges_of, named, triangulation

import kinetri

# No event is at this time: its exchanges would count, but lifetimes that begin at it are left out.
END = 1.4375 + 2**-40


def lives_by_events(kd, until):
    """The lifetimes of edges by the edges at the start and the events, rounded."""
    present = dict.fromkeys(edges_of(kd), 0.0)
    lives = []
    for event in kd.record(until=until):
        for change in ("removed", "added"):
            ids = event[change].tolist()
            if kinetri.NO_POINT in ids:
                continue
            edge = named(*ids, *event[f"{change}_offset"].tolist())
            if change == "removed":
                lives.append((*edge, present.pop(edge), event["time"]))
            elif lives and lives[-1][:4] == edge and lives[-1][-1] == event["time"]:
                present[edge] = lives.pop()[-2]  # removed and added again
            else:
                present[edge] = event["time"]
    lives += [(*edge, begin, until) for edge, begin in present.items()]
    return sorted(life for life in lives if life[-1] > life[-2])


@pytest.mark.parametrize("box", BOXES)
def test_neighbor_lives_are_those_of_the_events(box):
    for seed, n in enumerate((1, 2, 5, 9)):
        expected = lives_by_events(triangulation(n, seed, box), END)
        table = triangulation(n, seed, box).neighbor_lives(until=END)
        found = sorted(table[["a", "b", "k", "l", "begin", "end"]].itertuples(index=False, name=None))
        assert found == expected
        changes = Counter()
        for row in table.itertuples():
            for id in (row.a, row.b):
                changes[id, "gained"] += row.begins_by == "exchange"
                changes[id, "lost"] += row.ends_by == "exchange"
        for row in triangulation(n, seed, box).exchanges(until=END).itertuples():
            assert (row.gained, row.lost) == (changes[row.id, "gained"], changes[row.id, "lost"])


def test_lives_of_discs_have_offsets_and_short_ridges():
    sim = kinetri.Simulation([[1, 1], [5, 5], [4, 1]], [[1, 0], [-1, 1], [0, 1]], radius=[1, 0.5, 0.5],
                             collisions="elastic", box=kinetri.Box((8, 8)))
    table = sim.neighbor_lives(until=3, ridge=0.5)
    assert table.columns.tolist()[:4] == ["a", "b", "k", "l"] and table["short"].dtype == bool
    assert (table["k"] != 0).any() and (table["begins_by"] == "exchange").any()


@pytest.mark.parametrize("box", BOXES)
def test_areas_have_the_sum_of_the_box(box):
    kd = triangulation(7, 3, box)
    for _ in range(3):
        areas = kd.cell_areas()
        assert areas == pytest.approx(kd.voronoi_areas(), abs=1e-12)
        assert areas.sum() == pytest.approx(kd.box.area(kd.time), rel=1e-12)
        assert (kd.cell_areas(cutoff=0.5) <= np.minimum(areas, np.pi / 4) + 1e-12).all()
        kd.advance_to(float(kd.time) + 0.5)
    table = kd.areas([2.0, 2.5])
    sums = table.groupby("t")["area"].sum()
    assert sums.loc[2.0] == pytest.approx(kd.box.area(2.0), rel=1e-12)
    assert sums.loc[2.5] == pytest.approx(kd.box.area(2.5), rel=1e-12)
    means = kd.mean_areas(until=3.0)
    # Simpson's rule is exact for the area of the box.
    mean = (kd.box.area(2.5) + 4 * kd.box.area(2.75) + kd.box.area(3.0)) / 6
    assert means["area"].sum() == pytest.approx(mean, abs=means["error"].sum())
    assert (means["error"] < 1e-3).all()


def test_areas_of_discs_are_those_of_power_cells():
    # The cell of the larger disc ends at (4^2 + 2^2 - 1^2) / (2 * 4) = 19 / 8 from its center, on both sides.
    sim = kinetri.Simulation([[0, 0], [4, 0]], np.zeros((2, 2)), radius=[2, 1], box=kinetri.Box((8, 8)))
    assert sim.cell_areas() == pytest.approx([38, 26], rel=1e-14)


def test_walls_are_refused():
    kd = triangulation(4, 3, BOXES[0])
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    for call in (lambda: kd.cell_areas(square), lambda: kd.areas([1.0], walkable=square),
                 lambda: kd.mean_areas(until=1, walkable=square)):
        with pytest.raises(kinetri.PreconditionError, match="a walkable area in a periodic box"):
            call()


def test_encounters_and_components_are_those_of_images():
    def points():
        return kinetri.KineticDelaunay([[9, 5], [4, 5]], [[1, 0], [0, 0]], box=kinetri.Box((10, 10)))

    table = points().encounters(1.0, until=9)
    assert table.columns.tolist()[:4] == ["a", "b", "k", "l"]
    assert table[["a", "b", "k", "l", "begin", "end", "distance"]].to_numpy().tolist() == [[0, 1, 1, 0, 4, 6, 0]]
    table = points().components(1.0, until=9)
    assert table["kind"].tolist() == ["start", "merge", "split"] and table["wrapping"].tolist() == [0, 0, 0]
    assert table["k"].isna().tolist() == [True, False, False] and table["k"].tolist()[1:] == [1, 1]
    table = points().components(6.0, until=9)
    assert set(table["kind"]) == {"start", "wrap", "unwrap"} and table["wrapping"].max() == 1


def test_encounters_of_discs_are_gaps():
    sim = kinetri.Simulation([[9, 5], [4, 5]], [[1, 0], [0, 0]], radius=0.5, box=kinetri.Box((10, 10)))
    table = sim.encounters(1.0, until=9)
    assert table[["a", "b", "k", "l", "begin", "end", "distance", "gap"]].to_numpy().tolist() == [
        [0, 1, 1, 0, 3, 7, 0, -1]]


def test_encounters_of_discs_with_radii_are_gaps_of_images():
    sim = kinetri.Simulation([[9, 5], [4, 5]], [[1, 0], [0, 0]], radius=[0.5, 1], growth=[0, 0.25], collisions="log",
                             box=kinetri.Box((10, 10)))
    # The gap falls from 5 - 1.5 at the rate 1.25, up to the time 5, and rises at 0.75 then. That of the disc and
    # its own images falls from 8 at the rate 0.5.
    table = sim.encounters(1.0, until=9)
    assert table[["a", "b", "k", "l", "begin", "end", "closest", "distance", "gap"]].to_numpy().tolist() == [
        [0, 1, 1, 0, 2, 9, 5, 0, -2.75]]
    table = kinetri.Simulation([[4, 5]], [[0, 0]], radius=[1], growth=[0.25], box=kinetri.Box((10, 10))).encounters(2.0, until=13)
    assert table[["a", "b", "k", "l", "begin", "gap"]].to_numpy().tolist() == [
        [0, 0, 0, 1, 12, 1.5], [0, 0, 1, 0, 12, 1.5]]


def test_queries_about_discs_with_radii_are_about_powers():
    sim = kinetri.Simulation([[1, 5], [6, 5], [1, 5]], [[0, 0], [0, 0], [1, 0]], radius=[3, 0.5, 0.25], box=kinetri.Box((10, 10)))
    # In the large disc, though the other center is nearer.
    assert sim.nearest_vertex([3.75, 5]) == 0 and sim.nearest_vertex_offset([3.75, 5]) == (0, 0)
    assert sim.nearest_vertex([16, 5]) == 1 and sim.nearest_vertex_offset([16, 5]) == (1, 0)
    assert sim.hidden_points().tolist() == [2] and sim.voronoi_cell(2).is_empty and sim.neighbors(2).tolist() == []
    assert not sim.voronoi_cell(0).is_empty and sim.locate([1, 5])[0] == "vertex"
    areas = sim.voronoi_areas()
    assert areas.sum() == pytest.approx(100, rel=1e-15) and areas[2] == 0 and areas[0] > areas[1] > 0


def test_connected_are_points_over_the_border():
    kd = kinetri.KineticDelaunay([[1, 5], [9, 5], [5, 0]], [[0, 0], [0, 0], [0, 1]], box=kinetri.Box((10, 10)))
    assert kd.connected(0, 1, 2, until=1)[["begin", "end"]].to_numpy().tolist() == [[0, 1]]
    # The third one links the two that are at most 4 away.
    assert kd.connected(1, 2, 4, until=9)[["begin", "end"]].to_numpy().tolist() == [[5, 5]]


def test_nearest_neighbors_are_images():
    kd = kinetri.KineticDelaunay([[0, 0]], [[1, 1]], box=kinetri.Box([[4, 0], [0, 3]], rates=[[-1, 0], [0, 0]]))
    table = kd.nearest_neighbor_changes(until=3)
    assert table["time"].tolist() == [0, 1] and table["after"].tolist() == [0, 0]
    assert table[["after_k", "after_l"]].to_numpy().tolist() == [[0, -1], [-1, 0]]
    assert table["before_k"].isna().tolist() == [True, False] and table["before_l"].tolist()[1] == -1


def test_a_watch_is_kept_over_changes():
    kd = triangulation(4, 3, BOXES[2])
    watch = kd.watch("neighbor_lives")
    kd.advance_to(0.5)
    kd.insert([1, 1], [0, 0])
    kd.advance_to(1.0)
    kd.erase(4)
    table = watch.table()
    assert (table["begins_by"] == "point").any() and (table["ends_by"] == "point").any()
    assert repr(watch) == "<kinetri.Watch of neighbor_lives>"


def test_closest_approaches_are_those_of_images():
    sim = kinetri.Simulation([[9, 5], [4, 6]], [[1, 0], [0, 0]], box=kinetri.Box((10, 10)))
    table = sim.closest(2, until=16)
    assert table.columns.tolist() == ["a", "b", "k", "l", "time", "time_lo", "time_hi", "distance"]
    assert table[["a", "b", "k", "l", "time", "distance"]].to_numpy().tolist() == [
        [0, 1, 1, 0, 5, 1], [0, 1, 2, 0, 15, 1]]
    # A disc that is larger than the box, and its image.
    sim = kinetri.Simulation([[1, 1]], [[1, 3]], radius=[1], growth=[1], box=kinetri.Box((4, 5)))
    assert sim.closest(1, until=2)[["a", "b", "k", "l", "time", "distance", "gap"]].to_numpy().tolist() == [
        [0, 0, 1, 0, 2, 4, -2]]


def test_spanning_trees_are_those_of_images():
    kd = kinetri.KineticDelaunay([[1, 2], [2, 2]], [[0, 0], [1, 0]], box=kinetri.Box((10, 10)))
    table = kd.spanning_tree(until=12)
    assert table[["time", "kind", "a", "b", "k", "l"]].to_numpy().tolist() == [
        [0, "start", 0, 1, 0, 0], [0, "longest", 0, 1, 0, 0], [4, "remove", 0, 1, 0, 0], [4, "add", 0, 1, -1, 0],
        [4, "longest", 0, 1, -1, 0], [9, "least", 0, 1, -1, 0], [4, "greatest", 0, 1, 0, 0]]
    assert table["length"].dropna().tolist() == [1, 5, 0, 5]


@pytest.mark.parametrize("box", BOXES)
def test_each_event_has_a_certificate(box):
    kd = triangulation(7, 3, box)
    watch = kd.watch("certificates")
    kd.advance_to(float(kd.time) + 1.5)
    rows = [json.loads(line) for line in watch.table()["certificate"]]
    proved = [row for row in rows if row["polynomial"] is not None]
    assert len(rows) == len(watch.table()) and proved
    assert all(len(row["offsets"]) == len(row["points"]) for row in proved)
