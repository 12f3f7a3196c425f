# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangulations of points in periodic boxes: compared with copies in the plane, by fractions and by SciPy."""
import copy
import itertools
import math
import pickle
import zlib
from fractions import Fraction

import numpy as np
import pytest
from periodic_support import BOXES, cross, edges_of, exact, image, integers, minus, named, nearest_copy, triangulation
from scipy.spatial import Delaunay

import kinetri


# ---- oracles ----

def in_circle(p, q, r, s):
    """Positive if s is in the circle of p, q, r, which turn left."""
    a, b, c = (minus(corner, s) for corner in (p, q, r))
    lift = [x * x + y * y for x, y in (a, b, c)]
    return lift[0] * cross(b, c) + lift[1] * cross(c, a) + lift[2] * cross(a, b)


def check_against_copies(kd, reach=3):
    """That the triangles cover the torus once, and that no copy of a point is in the circle of one: exactly."""
    places, lattice, _ = integers(kd)
    hidden = set(kd.hidden_points().tolist())
    visible = [id for id in places if id not in hidden]
    triangles, offsets = kd.triangles().tolist(), kd.triangle_offsets().tolist()
    assert len(triangles) == 2 * len(visible) and len(edges_of(kd)) == 3 * len(visible)
    assert sorted(edges_of(kd)) == edges_of(kd)
    area, sides = 0, []
    for ids, by in zip(triangles, offsets):
        assert ids[0] == min(ids) and by[0] == [0, 0]
        p, q, r = (image(places[id], offset, lattice) for id, offset in zip(ids, by))
        doubled = cross(minus(q, p), minus(r, p))
        assert doubled >= 0  # points may be collinear at this time
        area += doubled
        for i, j in ((0, 1), (1, 2), (2, 0)):
            sides.append(named(ids[i], ids[j], by[j][0] - by[i][0], by[j][1] - by[i][1]))
        for id in visible:
            x, y = nearest_copy(places[id], p, lattice)
            for k, l in itertools.product(range(x - reach, x + reach + 1), range(y - reach, y + reach + 1)):
                assert in_circle(p, q, r, image(places[id], (k, l), lattice)) <= 0
    assert area == 2 * cross(*lattice)
    assert sorted(sides) == sorted(2 * edges_of(kd))
    check_neighbors(kd, places, lattice)


def check_neighbors(kd, places, lattice):
    ends = {id: [] for id in places}
    for a, b, k, l in edges_of(kd):
        ends[a].append((b, k, l))
        ends[b].append((a, -k, -l))
    for id in places:
        found = [(other, *by) for other, by in zip(kd.neighbors(id).tolist(), kd.neighbor_offsets(id).tolist())]
        coincident = kd.coincident_points(id).tolist()
        if id in kd.hidden_points():
            coincident = [min(coincident)]
        around = found[:len(found) - len(coincident)]
        assert sorted(around) == sorted(ends[id])
        assert around[:1] == sorted(around)[:1]
        vectors = [minus(image(places[other], (k, l), lattice), places[id]) for other, k, l in around]
        for here, then in zip(vectors, vectors[1:] + vectors[:1]):
            assert cross(here, then) >= 0  # counterclockwise
        for other, k, l in found[len(around):]:
            assert image(places[other], (k, l), lattice) == places[id]
        assert [other for other, _, _ in found[len(around):]] == coincident


# ---- runs ----

@pytest.mark.parametrize("box", BOXES)
@pytest.mark.parametrize("n", range(1, 7))
def test_it_is_that_of_copies_in_the_plane(n, box):
    kd = triangulation(n, 10 * n, box)
    assert kd.box == box
    check_against_copies(kd)
    edges = set(edges_of(kd))
    happened = 0
    for time in (0.25, 1, Fraction(7, 3), 4):
        events = kd.record(until=time)
        happened += len(events)
        assert events.dtype == kinetri.periodic_event_dtype
        for event in events:
            for edge, change in (("removed", edges.remove), ("added", edges.add)):
                if event[edge][0] != kinetri.NO_POINT:
                    name = (*event[edge].tolist(), *event[f"{edge}_offset"].tolist())
                    assert (name in edges) == (edge == "removed")
                    change(name)
                else:
                    assert event[f"{edge}_offset"].tolist() == [0, 0]
        assert sorted(edges) == edges_of(kd)
        check_against_copies(kd)
        assert kd.audit()
    assert happened > 0 or n == 1


@pytest.mark.parametrize("box", [kinetri.Box((10, 10)), kinetri.Box.shear(10, 8, 0.25)])
def test_it_is_that_of_scipy_with_copies_of_fifty_points(box):
    rng = np.random.default_rng(3)
    places, velocities = rng.uniform(0, 10, (50, 2)), rng.uniform(-4, 4, (50, 2))
    kd = kinetri.KineticDelaunay(places, velocities, box=box)
    for time in (0, 0.5, 1, 2.5):
        kd.advance_to(time)
        lattice = box.vectors_at(time)
        wrapped = kd.positions(wrapped=True)
        moved = np.rint(np.linalg.solve(lattice.T, (wrapped - kd.positions()).T).T).astype(int)
        cells = [np.array(cell) for cell in itertools.product(range(-2, 3), repeat=2)]
        cells.sort(key=lambda cell: abs(cell).sum())  # the box itself first
        found = set()
        simplices = Delaunay(np.concatenate([wrapped + cell @ lattice for cell in cells])).simplices
        for a, b in itertools.chain(*(itertools.permutations(corners, 2) for corners in simplices.tolist())):
            if a < 50:
                offset = cells[b // 50] + moved[b % 50] - moved[a]
                found.add(named(a, b % 50, *offset.tolist()))
        assert sorted(found) == edges_of(kd)
    assert kd.statistics()["events"]["flip"] > 100


def test_the_present_and_the_next_event_are_exact():
    kd = kinetri.KineticDelaunay([[0.5, 0.5]], [[0, 0]], box=kinetri.Box.shear(1, 1, 1))
    assert kd.next_event_time() == 1 and kd.advance_to(0.5) == 0
    (event,) = kd.events(until=1)
    assert (event.removed, event.removed_offset, event.added, event.added_offset) == ((0, 0), (0, 1), (0, 0), (2, -1))
    assert repr(event).endswith("removed=(0, 0), removed_offset=(0, 1), added=(0, 0), added_offset=(2, -1)>")
    assert kd.time == 1 and kd.step(until=1.5) == 0 and kd.step() == 1 and kd.time == 2
    assert kd.triangles().tolist() == [[0, 0, 0]] * 2 and kd.triangle_offsets().shape == (2, 3, 2)
    assert repr(kd) == "<KineticDelaunay of 1 points at t = 2>"


def test_a_box_begins_at_its_epoch():
    kd = kinetri.KineticDelaunay([[0, 0]], [[0, 0]], start=5, box=kinetri.Box.shear(2, 2, 0.5, epoch=3))
    assert kd.box.vectors_at(kd.time).tolist() == [[2, 0], [2, 2]]
    check_against_copies(kd)


def test_without_points_there_is_nothing():
    kd = kinetri.KineticDelaunay(np.empty((0, 2)), np.empty((0, 2)), box=(1, 1))
    assert kd.edges().shape == kd.edge_offsets().shape == (0, 2)
    assert kd.triangles().shape == (0, 3) and kd.triangle_offsets().shape == (0, 3, 2)
    assert kd.positions(wrapped=True).shape == (0, 2) and kd.next_event_time() is None and kd.audit()


def test_positions_are_wrapped_exactly():
    for seed, box in enumerate(BOXES):
        kd = triangulation(20, seed, box)
        kd.erase(3)
        for time in (0, Fraction(1, 3), 2):
            kd.advance_to(time)
            places, lattice = exact(kd)
            wrapped = kd.positions(wrapped=True)
            assert np.isnan(wrapped[3]).all() and np.isnan(kd.positions()[3]).all()
            for id, place in places.items():
                assert kd.positions()[id].tolist() == [float(x) for x in place]
                area = cross(*lattice)
                back = (-math.floor(cross(place, lattice[1]) / area), -math.floor(cross(lattice[0], place) / area))
                assert wrapped[id].tolist() == [float(x) for x in image(place, back, lattice)]


def test_a_point_just_below_a_side_is_in_the_box():
    kd = kinetri.KineticDelaunay([[-1e-30, 2], [1, 1]], [[0, 0], [0, 1]], box=(2, 2))
    assert kd.positions(wrapped=True).tolist() == [[2, 0], [1, 1]]  # the first is rounded up
    kd.advance_to(1)
    assert kd.positions(wrapped=True)[1].tolist() == [1, 0]
    with pytest.raises(kinetri.PeriodicBoxError, match="2\\^31 or more lattice vectors away"):
        kinetri.KineticDelaunay([[1e10, 0]], [[0, 0]], box=(1, 1)).positions(wrapped=True)


def test_an_offset_that_is_too_great_ends_a_run():
    kd = kinetri.KineticDelaunay([[0, 0], [2147483000.5, 0.25]], [[0, 0], [1000, 0]], box=(1, 1))
    with pytest.raises(kinetri.PeriodicOffsetError, match="expected less than 2\\^31 of each") as raised:
        kd.advance_to(2)
    assert raised.value.ids == (0, 1) and 0.6 < raised.value.time < 0.7
    assert not isinstance(raised.value, kinetri.PeriodicBoxError) and isinstance(raised.value, kinetri.Error)
    with pytest.raises(kinetri.PreconditionError):
        kd.advance_to(2)
    with pytest.raises(kinetri.PeriodicOffsetError) as raised:
        kinetri.KineticDelaunay([[0, 0], [1.5e9, 0.5], [-1.5e9, 0.25]], np.zeros((3, 2)), start=3, box=(1, 1))
    assert raised.value.ids == (1, 2) and raised.value.time == 3


# ---- changes ----

def test_points_turn_jump_come_and_go():
    kd = triangulation(6, 1, kinetri.Box.shear(6, 5, 0.25))
    kd.advance_to(0.5)
    changes = [
        lambda: kd.set_velocities(-kd.velocities()),
        lambda: kd.set_velocities([1, 2], [2, 0]),
        lambda: kd.set_positions([0], [[20, -7]]),
        lambda: kd.insert([[1, 2], [9, 9.5]], [[0, 1], [1, 1]]),
        lambda: kd.erase([2, 3]),
        lambda: kd.set_motions([0, 7], [[1, 0.5], [3, -3]], [[0, 1], [1, 0]]),
        lambda: kd.set_positions(kd.positions() + 0.25),
        lambda: kd.advance_through(kd.positions() + [1, -2], 0.25),
    ]
    for i, change in enumerate(changes):
        change()
        check_against_copies(kd)
        assert kd.audit(), i
        kd.advance_to(float(kd.time) + 0.25)
        check_against_copies(kd)
    assert kd.ids.tolist() == [0, 1, 4, 5, 6, 7]


def test_a_way_to_positions_at_which_the_box_has_no_area_is_refused():
    kd = kinetri.KineticDelaunay([[1, 1], [2, 3]], [[3, 1], [-1, 2]], box=kinetri.Box((4, 4), rates=(-1, 0)))
    before = kd.snapshot()
    with pytest.raises(kinetri.PeriodicBoxError, match="no area at time 4"):
        kd.advance_through([[0, 0], [1, 1]], 4.5)
    assert kd.snapshot() == before
    kd.advance_through([[0, 0], [9, 1]], 3)
    assert kd.time == 3 and kd.positions().tolist() == [[0, 0], [9, 1]] and kd.audit()


def test_points_that_are_images_of_others_are_hidden():
    box = kinetri.Box((4, 4), rates=[[0, 0], [1, 0]])
    places, velocities = [[1, 1], [1, 9], [2, 3], [1, 5]], [[0, 1], [2, 1], [0, 0], [0, 1]]
    kd = kinetri.KineticDelaunay(places, velocities, box=box)
    assert kd.hidden_points().tolist() == [1] and kd.coincident_points(0).tolist() == [1]
    assert kd.neighbors(1).tolist() == [0] and kd.neighbor_offsets(1).tolist() == [[0, 2]]
    assert kd.neighbors(0)[-1] == 1 and kd.neighbor_offsets(0)[-1].tolist() == [0, -2]
    check_against_copies(kd)
    with pytest.raises(kinetri.CoincidentTrajectoriesError) as raised:
        kinetri.KineticDelaunay(places, velocities, box=box, coincident="refuse")
    assert raised.value.ids == (0, 1)


# ---- reversal, copies ----

def test_it_runs_back_and_the_box_with_it():
    box = kinetri.Box.shear(5, 4, 0.5, epoch=0.25)
    kd = triangulation(8, 4, box)
    before = edges_of(kd)
    assert kd.advance_to(2) > 0
    kd.reverse()
    assert kd.box == kinetri.Box.shear(5, 4, -0.5, epoch=-0.25) and kd.time == -2
    kd.advance_to(0)
    kd.reverse()
    assert kd.box == box and edges_of(kd) == before and kd.audit()


def test_copies_go_on_alike():
    kd = triangulation(9, 2, kinetri.Box((5, 4), rates=(0.1, 0), epoch=1))
    kd.advance_to(0.5)
    for other in (copy.copy(kd), pickle.loads(pickle.dumps(kd)), kd.snapshot().restore()):
        assert type(other) is kinetri.KineticDelaunay and other.box == kd.box
        assert other.snapshot() == kd.snapshot() and edges_of(other) == edges_of(kd)
        expected = copy.copy(kd).record(until=2)
        assert len(expected) > 0 and other.record(until=2).tobytes() == expected.tobytes()
    another = kinetri.KineticDelaunay([[0, 0]], [[0, 0]], box=(1, 1))
    assert another.snapshot() != kinetri.KineticDelaunay([[0, 0]], [[0, 0]], box=(1, 2)).snapshot()


@pytest.mark.parametrize("box", BOXES)
def test_a_file_has_the_box(tmp_path, box):
    kd = triangulation(7, 1, box)
    kd.advance_to(0.25)
    kd.save(tmp_path / "state")
    assert (tmp_path / "state").read_bytes() == kd.snapshot().state
    for other in (kinetri.KineticDelaunay.load(tmp_path / "state"), kinetri.Simulation.load(tmp_path / "state")):
        assert other.box == box and edges_of(other) == edges_of(kd)
        expected = copy.copy(kd).record(until=1)
        assert len(expected) > 0 and other.record(until=1).tobytes() == expected.tobytes()
    with pytest.raises(kinetri.SnapshotError, match="KineticDelaunay"):
        kinetri.KineticRegular.load(tmp_path / "state")


def test_a_box_of_vectors_with_two_epochs_is_refused():
    snapshot = triangulation(3, 1, kinetri.Box((4, 4), rates=(0.5, 0))).snapshot()
    line, old = snapshot.state.split(b"\n", 1)[0], b"[4.0,0.0,0.5,0.0,0.0]"
    text = snapshot.state[:snapshot.state.rindex(b"checksum")].replace(old, b"[4.0,0.0,0.5,0.0,1.0]")
    assert line.startswith(b"kinetri checkpoint") and old in snapshot.state
    snapshot.state = text + b"checksum %08x\n" % zlib.crc32(text)
    with pytest.raises(kinetri.SnapshotError, match="different epochs; expected one"):
        snapshot.restore()


# ---- what is not possible ----

@pytest.mark.parametrize("call", [
    lambda kd: kd.hull(),
    lambda kd: kd.voronoi_areas((0, 0, 1, 1)),
    lambda kd: kd.gabriel_edges(),
    lambda kd: kd.relative_neighbor_edges(),
    lambda kd: kd.play(1),
    lambda kd: kd.insert([1, 1], [0, 0], acceleration=[0, 1]),
    lambda kd: kd.set_motions(0, [1, 1], [0, 0], jerk=[0, 1]),
    lambda kd: kinetri.KineticDelaunay([[0, 0]], [[0, 0]], acceleration=[[0, 1]], box=(1, 1)),
])
def test_what_is_not_possible_in_a_box_says_so(call):
    kd = triangulation(4, 3, BOXES[2])
    before = kd.snapshot()
    with pytest.raises(kinetri.PreconditionError, match=r"^[\w', -]+ (is|are) not possible in a periodic box"):
        call(kd)
    assert kd.snapshot() == before


@pytest.mark.parametrize("call", [
    lambda kd: kd.edge_offsets(), lambda kd: kd.triangle_offsets(), lambda kd: kd.neighbor_offsets(0),
    lambda kd: kd.positions(wrapped=True)])
def test_without_a_box_there_are_no_offsets(call):
    kd = kinetri.KineticDelaunay([[0, 0], [1, 0], [0, 1]], [[0, 0]] * 3)
    assert kd.box is None and kd.record(until=1).dtype == kinetri.event_dtype
    with pytest.raises(kinetri.PreconditionError, match="expected an object in a periodic box"):
        call(kd)


# ---- tables, pictures ----

def test_tables_have_the_offsets():
    kd = kinetri.KineticDelaunay([[0.5, 0.5]], [[0, 0]], box=kinetri.Box.shear(1, 1, 1))
    table = kinetri.to_dataframe(kd.record(until=1, kinds="flip"))
    assert table.columns.tolist()[-4:] == ["removed_k", "removed_l", "added_k", "added_l"]
    assert table.iloc[0, -4:].tolist() == [0, 1, 2, -1]
    rows = np.zeros(1, kinetri.periodic_event_dtype)
    rows["removed"] = 3, 4
    rows["added"] = kinetri.NO_POINT
    assert kinetri.to_dataframe(rows).isna().iloc[0].tolist() == [False] * 6 + [True] * 2 + [False] * 4 + [True] * 2


def test_a_picture_has_each_edge_at_an_image_in_the_box():
    pytest.importorskip("matplotlib").use("Agg")
    kd = triangulation(5, 8, BOXES[1])
    lines = kd.plot().collections[0].get_segments()
    places, lattice = exact(kd)
    wrapped = kd.positions(wrapped=True).tolist()
    for line, (a, b, k, l) in zip(lines, edges_of(kd), strict=True):
        assert line[0].tolist() == wrapped[a]
        assert (line[1] - line[0]).tolist() == minus(image(places[b], (k, l), lattice), places[a])
