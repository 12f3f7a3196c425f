# SPDX-License-Identifier: GPL-3.0-or-later
"""Points in periodic boxes: compared with copies in the plane, by fractions and by SciPy."""
import copy
import itertools
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial import Delaunay

import kinetri

BOXES = [
    kinetri.Box((6, 5)),
    kinetri.Box([[6, 1], [-2, 5]]),
    kinetri.Box.shear(5, 4, 0.5),
    kinetri.Box((4, 6), rates=(0.25, -0.5)),
    kinetri.Box([5, 0], [1, 4], rates=[[0.5, 0.25], [-0.25, 0.5]], epoch=1),
]


def triangulation(n, seed, box, spread=12):
    rng = np.random.default_rng(seed)
    return kinetri.KineticDelaunay(rng.integers(-spread, spread, (n, 2)), rng.integers(-3, 4, (n, 2)), box=box)


# ---- oracles ----

def exact(kd):
    """At the present time, a fraction: the positions by id, and the lattice vectors, in fractions."""
    now = kd.time.fraction
    places = {}
    for id in kd.ids.tolist():
        motion = kd.motion(id)
        since = now - Fraction(motion["epoch"])
        places[id] = [Fraction(p) + Fraction(v) * since for p, v in zip(motion["position"], motion["velocity"])]
    since = now - Fraction(kd.box.epoch)
    lattice = [[Fraction(x) + Fraction(r) * since for x, r in zip(*rows)] for rows in zip(
        kd.box.vectors.tolist(), kd.box.rates.tolist())]
    return places, lattice


def image(place, offset, lattice):
    return [p + int(offset[0]) * a + int(offset[1]) * b for p, a, b in zip(place, *lattice)]


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def minus(a, b):
    return [a[0] - b[0], a[1] - b[1]]


def in_circle(p, q, r, s):
    """Positive if s is in the circle of p, q, r, which turn left."""
    a, b, c = (minus(corner, s) for corner in (p, q, r))
    lift = [x * x + y * y for x, y in (a, b, c)]
    return lift[0] * cross(b, c) + lift[1] * cross(c, a) + lift[2] * cross(a, b)


def edges_of(kd):
    """The edges with offsets, as they are named."""
    return [(*ids, *by) for ids, by in zip(kd.edges().tolist(), kd.edge_offsets().tolist())]


def named(a, b, k, l):
    """The name of an edge: the smaller id first, of an edge from a point to its image the greater offset."""
    return max((a, b, k, l), (b, a, -k, -l)) if a == b else (a, b, k, l) if a < b else (b, a, -k, -l)


def integers(kd, others=()):
    """The same times a common denominator; and other positions times it."""
    places, lattice = exact(kd)
    others = [[Fraction(x) for x in row] for row in others]
    scale = math.lcm(*(x.denominator for row in [*places.values(), *lattice, *others] for x in row))

    def whole(row):
        return [int(x * scale) for x in row]

    return {id: whole(row) for id, row in places.items()}, [whole(row) for row in lattice], [
        whole(row) for row in others]


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


def nearest_copy(place, other, lattice):
    """About how often the vectors must be added to a place to come to another one."""
    away, area = minus(other, place), cross(*lattice)
    return cross(away, lattice[1]) // area, cross(lattice[0], away) // area


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


def test_no_file_is_read_without_its_box(tmp_path):
    kd = triangulation(3, 1, BOXES[0])
    with pytest.raises(kinetri.PreconditionError, match="files of states are not possible in a periodic box"):
        kd.save(tmp_path / "state")
    assert not list(tmp_path.iterdir())
    (tmp_path / "state").write_bytes(kd.snapshot().state)
    with pytest.raises(kinetri.InputError):
        kinetri.KineticDelaunay.load(tmp_path / "state")


# ---- boxes ----

class FreudBox:
    """With the attributes that a box of freud has."""

    def __init__(self, Lx, Ly, xy=0.0, is2D=True, periodic=(True, True, True)):
        self.Lx, self.Ly, self.xy, self.is2D, self.periodic = Lx, Ly, xy, is2D, np.array(periodic)
        self.dimensions = 2 if is2D else 3

    def __repr__(self):
        return "freud.box.Box(...)"


class Cell:
    """Like a cell of ASE: an array of three vectors."""

    def __init__(self, rows):
        self.rows = rows

    def __array__(self, dtype=None, copy=None):
        return np.array(self.rows, dtype=dtype or float)


class Atoms:
    def __init__(self, cell, pbc):
        self.cell, self.pbc = Cell(cell), np.array(pbc)

    def __repr__(self):
        return "Atoms(...)"


@pytest.mark.parametrize("given", [
    [[4, 0], [1, 3]], np.array([[4, 0], [1, 3]]), kinetri.Box([4, 0], [1, 3]), Cell([[4, 0, 0], [1, 3, 0], [0, 0, 9]]),
    [[4, 0, 0], [1, 3, 0], [0, 0, 0]], Atoms([[4, 0, 0], [1, 3, 0], [0, 0, 1]], [True, True, False]),
    FreudBox(4.0, 3.0, 1 / 3),
])
def test_what_others_have_is_taken_as_it_is(given):
    kd = kinetri.KineticDelaunay([[0, 0]], [[0, 0]], box=given)
    assert kd.box.vectors.tolist() == [[4, 0], [1, 3]] and kd.box == kinetri.Box(given)
    assert not kd.box.rates.any() and kd.box.epoch == 0
    assert len({kd.box, kinetri.Box([[4, 0], [1, 3]])}) == 1


@pytest.mark.parametrize("make, message", [
    (lambda: kinetri.Box((1, 2, 3)), "box has the shape (3,); expected a kinetri.Box, two lengths (Lx, Ly), two "),
    (lambda: kinetri.Box((0, 0, 1, 1)), "walls (xmin, ymin, xmax, ymax) are for a Simulation"),
    (lambda: kinetri.Box(3.0), "box has the shape (); expected"),
    (lambda: kinetri.Box("ab"), "box is 'ab'; expected a kinetri.Box, two lengths"),
    (lambda: kinetri.Box({"Lx": 1}), "box is {'Lx': 1}; expected"),
    (lambda: kinetri.Box([[1, 2], [3]]), "box is [[1, 2], [3]]; expected"),
    (lambda: kinetri.Box((np.nan, 1)), "box[0] is nan; expected finite numbers"),
    (lambda: kinetri.Box((2**53 + 1, 1)), "which float64 rounds"),
    (lambda: kinetri.Box([1, 0], [0, 1, 0]), "second has the shape (3,); expected (2,)"),
    (lambda: kinetri.Box((1, 1), rates=(1, 2, 3)), "rates has the shape (3,); expected two numbers, or shape (2, 2)"),
    (lambda: kinetri.Box((1, 1), epoch=np.inf), "epoch[0] is inf"),
    (lambda: kinetri.Box([[1, 0, 0], [0, 1, 0.5], [0, 0, 1]]), "and whose third one is along z"),
    (lambda: kinetri.Box([[1, 0, 0], [0, 1, 0], [0, 1, 1]]), "and whose third one is along z"),
    (lambda: kinetri.Box(Atoms(np.eye(3), [True, False, True])), "Atoms(...), which is not periodic along both"),
    (lambda: kinetri.Box(Atoms(np.eye(3), False)), "which is not periodic"),
    (lambda: kinetri.Box(FreudBox(1, 1, periodic=(False, True, True))), "which is not periodic"),
    (lambda: kinetri.Box(FreudBox(1, 1, is2D=False)), "freud.box.Box(...), which is 3-dimensional; expected a box in"),
    (lambda: kinetri.Box(kinetri.Box.shear(1, 1, 1)), "box is a Box whose vectors change"),
    (lambda: kinetri.Tracks.from_arrays([0, 1], [0, 0], [0, 1], [0, 0]).simulation(box=kinetri.Box((1, 1))),
     "a periodic box, which is for a KineticDelaunay or a Simulation"),
])
def test_what_is_no_box_is_refused(make, message):
    with pytest.raises(kinetri.PreconditionError) as raised:
        make()
    assert message in str(raised.value)


def test_a_box_has_an_area():
    with pytest.raises(kinetri.PeriodicBoxError, match="with the area 0.0; expected a second vector to the left"):
        kinetri.Box([[1, 2], [2, 4]])
    with pytest.raises(kinetri.PeriodicBoxError, match="with the area -1.0; .*: swap the two"):
        kinetri.Box([[0, 1], [1, 0]])
    box = kinetri.Box([[2, 0], [0, 1]], rates=[[0, 1], [1, 0]], epoch=3)  # 2 - (t - 3)^2
    assert [box.area(t) for t in (3, 4, Fraction(7, 2), 5)] == [2, 1, 1.75, -2]
    assert float(box.collapse_time) == pytest.approx(3 + math.sqrt(2)) and box.collapse_time.fraction is None
    assert box.area(box.collapse_time) == pytest.approx(0, abs=1e-14)
    assert kinetri.Box((2, 2)).collapse_time is None and kinetri.Box.shear(1, 2, 3).area(9) == 2
    assert kinetri.Box((1e200, 1e200)).area(0) == math.inf
    assert repr(box) == "Box([[2.0, 0.0], [0.0, 1.0]], rates=[[0.0, 1.0], [1.0, 0.0]], epoch=3.0)"
    assert repr(kinetri.Box((2, 1))) == "Box([[2.0, 0.0], [0.0, 1.0]])"
    assert pickle.loads(pickle.dumps(box)) == box != kinetri.Box((2, 1)) and box != 3


def test_time_ends_before_a_box_has_no_area():
    kd = kinetri.KineticDelaunay([[1, 1], [2, 3]], [[3, 1], [-1, 2]], box=kinetri.Box((4, 4), rates=(-1, 0)))
    assert kd.advance_to(3) > 0
    before = kd.snapshot()
    with pytest.raises(kinetri.PeriodicBoxError, match="the periodic box has no area at time 4; stop before"):
        kd.advance_to(4)
    assert kd.snapshot() == before and kd.time == 3
    for _ in range(20):
        assert kd.step() > 0 and kd.time < 4
    with pytest.raises(kinetri.PeriodicBoxError, match="has no area at time 4"):
        kinetri.KineticDelaunay([[1, 1]], [[0, 0]], start=4, box=kinetri.Box((4, 4), rates=(-1, 0)))


# ---- queries ----

def images_near(place, places, lattice, number, reach=9):
    """The nearest images to a place, as (squared distance, id, k, l), in order."""
    found = []
    for id, p in places.items():
        x, y = nearest_copy(p, place, lattice)
        for k, l in itertools.product(range(x - reach, x + reach + 1), range(y - reach, y + reach + 1)):
            away = minus(image(p, (k, l), lattice), place)
            found.append((away[0] ** 2 + away[1] ** 2, id, k, l))
    found.sort()
    # All other images are more than `reach` - 1 vectors away from the line of the other vector.
    widest = max(a * a + b * b for a, b in lattice)
    assert found[number - 1][0] * widest < ((reach - 1) * cross(*lattice)) ** 2
    return found[:number]


def check_location(kd, location, place, places, lattice, nearest):
    """That the place is on the image, between the ends of the edge, or in the triangle: exactly."""
    assert len(location.points) == len(location.offsets)
    images = list(zip(location.points, location.offsets))
    corners = [image(places[id], by, lattice) for id, by in images]
    if location.kind == "vertex":
        assert nearest[0] == 0 and images == [(nearest[1], nearest[2:])]
        return
    assert nearest[0] != 0
    first = images[0][1]
    against = [(by[0] - first[0], by[1] - first[1]) for _, by in images]
    if location.kind == "edge":
        a, b = (minus(corner, place) for corner in corners)
        assert images == sorted(images) and cross(a, b) == 0 and a[0] * b[0] + a[1] * b[1] < 0
        assert named(*location.points, *against[1]) in edges_of(kd)
    else:
        assert location.kind == "face" and images[0] == min(images)
        for p, q in zip(corners, corners[1:] + corners[:1]):
            assert cross(minus(q, p), minus(place, p)) > 0
        turns = [[(id, (by[0] - start[0], by[1] - start[1])) for id, by in images[i:] + images[:i]]
                 for i, (_, start) in enumerate(images)]
        faces = [list(zip(ids, map(tuple, by))) for ids, by in zip(kd.triangles().tolist(),
                                                                  kd.triangle_offsets().tolist())]
        assert any(turn in faces for turn in turns)


@pytest.mark.parametrize("box", BOXES)
@pytest.mark.parametrize("n", range(1, 7))
def test_queries_are_those_of_all_images(n, box):
    kd = triangulation(n, 7 * n, box)
    kinds = set()
    for time in (0, 1, Fraction(7, 3)):
        kd.advance_to(time)
        rng = np.random.default_rng(n)
        queries = [*(rng.integers(-20, 20, (6, 2)) / 2).tolist(), kd.positions()[0].tolist()]
        places, lattice, scaled = integers(kd, queries)
        for query, place in zip(queries, scaled):
            (nearest,) = images_near(place, places, lattice, 1)
            assert (kd.nearest_vertex(query), kd.nearest_vertex_offset(query)) == (nearest[1], nearest[2:])
            location = kd.locate(query)
            check_location(kd, location, place, places, lattice, nearest)
            kinds.add(location.kind)
        closest = []
        for k in (None, 1, 6):
            nearest = kd.nearest_neighbors(k)
            ids, distances = nearest
            assert ids.shape == distances.shape == ((n,) if k is None else (n, k))
            assert nearest.offsets.dtype == np.int32 and nearest.offsets.shape == (*ids.shape, 2)
            exact_places, exact_lattice = exact(kd)
            for id in range(n):
                near = images_near(places[id], places, lattice, n + (k or 1))  # others may be there too
                near = [found for found in near if found[1:] != (id, 0, 0)][:k or 1]
                assert list(zip(ids.reshape(n, -1)[id].tolist(), map(tuple, nearest.offsets.reshape(n, -1, 2)[id].tolist()))
                            ) == [(other, (i, j)) for _, other, i, j in near]
                closest.append((near[0][0], named(id, *near[0][1:])))
                for found, (_, other, i, j) in zip(distances.reshape(n, -1)[id].tolist(), near):
                    here, there = (np.array([float(x) for x in p]) for p in (
                        exact_places[id], image(exact_places[other], (i, j), exact_lattice)))
                    assert found == np.hypot(*(there - here))
        assert (*kd.closest_pair(), *kd.closest_pair_offset()) == min(closest)[1]
    assert "vertex" in kinds and len(kinds) > 1


@pytest.mark.parametrize("box", BOXES)
@pytest.mark.parametrize("n", [1, 3, 6])
def test_cells_are_those_of_all_images(n, box):
    kd = triangulation(n, 5 * n, box)
    for time in (0, Fraction(7, 3)):
        kd.advance_to(time)
        places, lattice = exact(kd)
        scaled, scaled_lattice, _ = integers(kd)
        (scale,) = {Fraction(b, 1) / a for a, b in zip(lattice[0] + lattice[1], scaled_lattice[0] + scaled_lattice[1])
                    if a != 0}
        total = 0
        for id, place in places.items():
            is_first = images_near(scaled[id], scaled, scaled_lattice, 1)[0][1] == id  # of those at this position
            neighbors, vertices, rays, is_empty = cell = kd.voronoi_cell(id)
            assert rays is None and not is_empty and len(neighbors) == len(vertices) == len(cell.offsets) >= 4
            images = [image(places[other], by, lattice) for other, by in zip(neighbors.tolist(), cell.offsets.tolist())]
            corners = [center(place, a, b) for a, b in zip(images, images[1:] + images[:1])]
            assert vertices.tolist() == [[float(x) for x in corner] for corner in corners]
            for corner, then in zip(corners, corners[1:] + corners[:1]):
                turn = cross(minus(corner, place), minus(then, place))
                assert turn > 0  # sides have a length
                total += turn / 2 if is_first else 0
                # No image is nearer to the corner than the point: in integers.
                scaled_corner = [scale * x for x in corner]
                w = math.lcm(*(x.denominator for x in scaled_corner))
                (least,) = images_near([int(w * x) for x in scaled_corner],
                                       {other: [w * x for x in p] for other, p in scaled.items()},
                                       [[w * x for x in vector] for vector in scaled_lattice], 1, reach=7)
                assert least[0] == sum((w * (scale * p - c)) ** 2 for p, c in zip(place, scaled_corner))
        assert total == cross(*lattice)


def center(p, a, b):
    """The center of the circle through three points."""
    (ax, ay), (bx, by) = minus(a, p), minus(b, p)
    of_a, of_b, doubled = ax * ax + ay * ay, bx * bx + by * by, 2 * (ax * by - ay * bx)
    return [p[0] + (of_a * by - of_b * ay) / doubled, p[1] + (of_b * ax - of_a * bx) / doubled]


def test_queries_about_few_points():
    empty = kinetri.KineticDelaunay(np.empty((0, 2)), np.empty((0, 2)), box=(1, 1))
    assert empty.nearest_vertex([0, 0]) is None and empty.nearest_vertex_offset([0, 0]) is None
    assert empty.closest_pair() is None and empty.closest_pair_offset() is None
    location = empty.locate([0, 0])
    assert location == ("outside_convex_hull", ()) and location.offsets == ()
    nearest = empty.nearest_neighbors(2)
    assert nearest.ids.shape == (0, 2) and nearest.offsets.shape == (0, 2, 2)
    kd = kinetri.KineticDelaunay([[0, 0], [9, 2]], [[0, 0], [0, 0]], box=(4, 8))
    kd.erase(0)
    nearest = kd.nearest_neighbors(k=3)
    assert nearest.ids.tolist() == [[kinetri.NO_POINT] * 3, [1] * 3]
    assert nearest.offsets.tolist() == [[[0, 0]] * 3, [[-1, 0], [1, 0], [-2, 0]]]
    assert np.isnan(nearest.distances[0]).all() and nearest.distances[1].tolist() == [4, 4, 8]
    assert kd.closest_pair() == (1, 1) and kd.closest_pair_offset() == (1, 0)
    assert kd.locate([1, 2]) == ("vertex", (1,)) and kd.locate([1, 2]).offsets == ((-2, 0),)


def test_queries_know_points_that_coincide_for_a_while():
    kd = kinetri.KineticDelaunay([[1, 1], [9, 1], [2, 1]], [[1, 0]] * 3, box=(4, 4))
    assert kd.hidden_points().tolist() == [1]
    nearest = kd.nearest_neighbors(k=2)
    assert nearest.ids.tolist() == [[1, 2], [0, 2], [0, 1]]
    assert nearest.offsets.tolist() == [[[-2, 0], [0, 0]], [[2, 0], [2, 0]], [[0, 0], [-2, 0]]]
    assert nearest.distances.tolist() == [[0, 1], [0, 1], [1, 1]]
    assert kd.closest_pair() == (0, 1) and kd.closest_pair_offset() == (-2, 0)
    assert kd.nearest_vertex([9, 1]) == 0 and kd.nearest_vertex_offset([9, 1]) == (2, 0)
    # Each about its own position.
    assert (kd.voronoi_cell(1).vertices - [8, 0]).tolist() == kd.voronoi_cell(0).vertices.tolist()


def test_answers_are_tuples_with_offsets_beside_them():
    kd = triangulation(4, 3, BOXES[1])
    for answer in (kd.locate([1, 2]), kd.nearest_neighbors(), kd.nearest_neighbors(2), kd.voronoi_cell(2)):
        other = pickle.loads(pickle.dumps(answer))
        assert type(other) is type(answer) and repr(other) == repr(answer)
        assert np.array_equal(other.offsets, answer.offsets)
    ids, distances = kd.nearest_neighbors()
    kind, points = kd.locate([1, 2])
    plane = kinetri.KineticDelaunay([[0, 0], [1, 0], [0, 1]], [[0, 0]] * 3)
    for answer in (plane.locate([1, 2]), plane.nearest_neighbors(), plane.nearest_neighbors(2), plane.voronoi_cell(2)):
        assert answer.offsets is None
    for call in (lambda: plane.nearest_vertex_offset([0, 0]), plane.closest_pair_offset):
        with pytest.raises(kinetri.PreconditionError, match="expected an object in a periodic box"):
            call()


def test_queries_far_away_are_refused():
    kd = triangulation(4, 3, BOXES[0])
    for call in (kd.nearest_vertex, kd.nearest_vertex_offset, kd.locate):
        with pytest.raises(kinetri.PeriodicBoxError, match="a position is 2\\^31 or more lattice vectors away from point"):
            call([1e11, 0])
    with pytest.raises(kinetri.PreconditionError, match="there is no point 4"):
        kd.voronoi_cell(4)


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


# ---- areas ----

@pytest.mark.parametrize("box", BOXES)
def test_areas_of_cells_have_the_sum_of_the_box(box):
    kd = triangulation(6, 5, box)
    for time in (0, 0.125, 0.25):
        kd.advance_to(time)
        areas = kd.voronoi_areas()
        assert areas.shape == (6,) and areas.sum() == pytest.approx(kd.box.area(kd.time), rel=1e-14)
    kd.erase(2)
    assert kd.voronoi_areas()[2] == 0
    assert kd.voronoi_areas().sum() == pytest.approx(kd.box.area(kd.time), rel=1e-14)


def test_area_of_a_point_alone_is_that_of_the_box():
    kd = kinetri.KineticDelaunay([[7, 3]], [[1, 0]], box=kinetri.Box.shear(2, 3, 1))
    kd.advance_to(1.5)
    assert kd.voronoi_areas().tolist() == pytest.approx([6.0])


def test_areas_in_the_plane_need_a_polygon():
    kd = kinetri.KineticDelaunay([[0, 0]], [[0, 0]])
    with pytest.raises(kinetri.PreconditionError, match="voronoi_areas has no clip; expected a box or a polygon"):
        kd.voronoi_areas()


# ---- what is not possible ----

@pytest.mark.parametrize("call", [
    lambda kd: kd.hull(),
    lambda kd: kd.voronoi_areas((0, 0, 1, 1)),
    lambda kd: kd.cell_areas(cutoff=1),
    lambda kd: kd.areas([0.5, 1.0], cutoff=1),
    lambda kd: kd.mean_areas(until=1, cutoff=1),
    lambda kd: kd.gabriel_edges(),
    lambda kd: kd.relative_neighbor_edges(),
    lambda kd: kd.encounters(1.0, until=1),
    lambda kd: kd.components(1.0, until=1),
    lambda kd: kd.connected(0, 1, 1.0, until=1),
    lambda kd: kd.spanning_tree(until=1),
    lambda kd: kd.neighbor_lives(until=1),
    lambda kd: kd.exchanges(until=1),
    lambda kd: kd.nearest_neighbor_changes(until=1),
    lambda kd: kd.certificates(until=1),
    lambda kd: kd.watch("closest", number=1),
    lambda kd: kd.play(1),
    lambda kd: setattr(kd, "threads", 2),
    lambda kd: kd.insert([1, 1], [0, 0], acceleration=[0, 1]),
    lambda kd: kd.set_motions(0, [1, 1], [0, 0], jerk=[0, 1]),
    lambda kd: kinetri.KineticDelaunay([[0, 0]], [[0, 0]], acceleration=[[0, 1]], box=(1, 1)),
])
def test_what_is_not_possible_in_a_box_says_so(call):
    kd = triangulation(4, 3, BOXES[2])
    before = kd.snapshot()
    with pytest.raises(kinetri.PreconditionError, match=r"^[\w', -]+ (is|are) not possible in a periodic box"):
        call(kd)
    assert kd.snapshot() == before and kd.threads == 1


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
