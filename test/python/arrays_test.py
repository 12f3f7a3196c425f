# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays as arguments: every dtype, order and stride; empty ones; what is refused, and the message."""
import fractions

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra import numpy as hnp
from support import few, uniform

import kinetri

SQUARE = [[0, 0], [4, 0], [0, 3], [5, 4]]
REST = [[0, 0]] * 4


def triangulation(positions, velocities=REST, **options):
    return kinetri.KineticDelaunay(positions, velocities, **options)


EXPECTED = triangulation(SQUARE).triangles().tolist()


@pytest.mark.parametrize("dtype", ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f2", "f4", "f8", "g",
                                   ">f8", ">i4", ">f4"])
def test_every_dtype_whose_numbers_float64_has_gives_the_same_points(dtype):
    kd = triangulation(np.array(SQUARE, dtype=dtype), np.array(REST, dtype=dtype))
    assert kd.positions().tolist() == SQUARE
    assert kd.positions().dtype == np.float64
    assert kd.triangles().tolist() == EXPECTED


def strided(array):
    big = np.full((2 * array.shape[0], 3 * array.shape[1]), np.nan)
    big[::2, ::3] = array
    return big[::2, ::3]


LAYOUTS = {
    "lists": lambda a: a.tolist(),
    "tuples": lambda a: tuple(map(tuple, a.tolist())),
    "rows as arrays": list,
    "C order": np.ascontiguousarray,
    "Fortran order": np.asfortranarray,
    "transposed": lambda a: np.ascontiguousarray(a.T).T,
    "with gaps": strided,
    "backwards": lambda a: a[::-1, ::-1].copy()[::-1, ::-1],
    "not aligned": lambda a: np.frombuffer(b"x" + a.tobytes(), dtype=np.uint8)[1:].view(
        np.float64).reshape(a.shape),
    "read only": lambda a: np.frombuffer(a.tobytes()).reshape(a.shape),
    "broadcast": lambda a: np.broadcast_to(a[None], (2, *a.shape))[1],
    "matrix subclass": lambda a: a.view(type("Sub", (np.ndarray,), {})),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_layout_gives_the_same_events(layout):
    positions, velocities = uniform(40, 1)
    expected = kinetri.KineticDelaunay(positions, velocities).record(until=2)
    change = LAYOUTS[layout]
    events = kinetri.KineticDelaunay(change(positions), change(velocities)).record(until=2)
    assert len(expected) > 20
    assert events.tobytes() == expected.tobytes()


def test_arguments_are_not_changed_and_not_kept():
    positions, velocities = uniform(30, 2)
    before = positions.copy(), velocities.copy()
    kd = kinetri.KineticDelaunay(positions, velocities)
    expected = kinetri.KineticDelaunay(*before).record(until=2)
    positions[:] = velocities[:] = np.nan
    assert np.array_equal(kd.record(until=2), expected)
    assert np.array_equal(kd.positions(), before[0] + 2 * before[1]) or kd.audit()


def test_results_belong_to_the_caller():
    kd = triangulation(SQUARE)
    for name in ("positions", "velocities", "radii", "edges", "triangles", "hull"):
        first = getattr(kd, name)()
        expected = first.copy()
        first[...] = 7
        assert np.array_equal(getattr(kd, name)(), expected), name
    events = kd.record(until=1)
    assert events.flags.writeable


@few
@given(hnp.arrays(np.float64, st.tuples(st.integers(0, 8), st.just(2)),
                  elements=st.floats(-2.0**100, 2.0**100), unique=True))
def test_positions_come_back_as_they_are(positions):
    n = len(positions)
    velocities = np.column_stack((np.arange(n), np.arange(n) ** 2.0))
    kd = kinetri.KineticDelaunay(positions, velocities)
    assert np.array_equal(kd.positions(), positions)
    assert np.array_equal(kd.velocities(), velocities)
    assert kd.audit()


@pytest.mark.parametrize("empty", [[], np.empty((0, 2)), np.empty((0, 2), dtype=int), ()])
def test_no_points(empty):
    kd = kinetri.KineticDelaunay(empty, empty)
    assert len(kd) == 0 and kd.next_id == 0 and kd.ids.tolist() == []
    assert kd.positions().shape == (0, 2) and kd.edges().shape == (0, 2)
    assert kd.triangles().shape == (0, 3) and kd.hull().shape == (0,)
    assert kd.advance_to(3) == 0 and kd.time == 3
    assert kd.record(until=4).shape == (0,)
    assert kd.nearest_vertex((0, 0)) is None and kd.closest_pair() is None
    assert kd.locate((0, 0)) == ("outside_convex_hull", ())
    assert kd.nearest_neighbors().ids.shape == (0,)
    assert kd.nearest_neighbors(k=3).ids.shape == kd.nearest_neighbors(k=3).distances.shape == (0, 3)
    kd.set_velocities([])
    kd.set_velocities(kd.velocities())
    assert kd.voronoi_areas((0, 0, 1, 1)).shape == (0,)
    assert kd.next_event_time() is None and kd.audit()
    assert list(kd.events()) == []
    assert kd.insert([1, 2], [3, 4]).tolist() == [0]


def test_one_point():
    kd = kinetri.KineticDelaunay([[1, 2]], [[3, 4]])
    assert kd.advance_to(2) == 0
    assert kd.positions().tolist() == [[7, 10]]
    assert kd.hull().tolist() == [0] and kd.edges().shape == (0, 2)
    ids, distances = kd.nearest_neighbors()
    assert ids.tolist() == [kinetri.NO_POINT] and np.isnan(distances[0])
    ids, distances = kd.nearest_neighbors(k=2)
    assert ids.tolist() == [[kinetri.NO_POINT] * 2] and np.isnan(distances).all() and distances.shape == (1, 2)
    assert kd.nearest_vertex((0, 0)) == 0
    assert kd.locate((7, 10)) == ("vertex", (0,))
    assert kd.voronoi_areas((0, 0, 2, 3)).tolist() == [6]
    cell = kd.voronoi_cell(0)
    assert len(cell.neighbors) == 0 and not cell.is_empty
    assert kd.neighbors(0).tolist() == []


def test_two_points():
    kd = kinetri.KineticDelaunay([[0, 0], [2, 0]], [[0, 0], [1, 0]])
    assert kd.edges().tolist() == [[0, 1]] and kd.hull().tolist() == [0, 1]
    cell = kd.voronoi_cell(0)
    assert cell.neighbors.tolist() == [1] and cell.vertices.shape == (0, 2)
    assert cell.rays.shape == (2, 2)
    assert kd.voronoi_areas((0, 0, 2, 1)).tolist() == [1, 1]


@pytest.mark.parametrize("positions, velocities, message", [
    ([1, 2, 3], REST, "positions has the shape (3,); expected (n, 2)"),
    (np.zeros((4, 3)), REST, "positions has the shape (4, 3); expected (n, 2)"),
    (np.zeros((2, 2, 2)), REST, "positions has the shape (2, 2, 2); expected (n, 2)"),
    (3.0, REST, "positions has the shape (); expected (n, 2)"),
    (SQUARE, REST[:3], "velocities has the shape (3, 2); expected (4, 2)"),
    (SQUARE, [0, 0], "velocities has the shape (2,); expected (4, 2)"),
    (SQUARE, [], "velocities has the shape (0,); expected (4, 2)"),
    (SQUARE, np.zeros((4, 0)), "velocities has the shape (4, 0); expected (4, 2)"),
    (np.zeros((3, 0)), REST, "positions has the shape (3, 0); expected (n, 2)"),
    ([[0, 0], [1]], REST, "positions is no array of numbers; expected real numbers of shape (n, 2)"),
    ("abc", REST, "positions is an array of <U3; expected real numbers of shape (n, 2)"),
    (None, REST, "positions is an array of object; expected real numbers of shape (n, 2)"),
    (np.array(SQUARE, dtype=complex), REST,
     "positions is an array of complex128; expected real numbers of shape (n, 2)"),
    (np.array(SQUARE, dtype=bool), REST,
     "positions is an array of bool; expected real numbers of shape (n, 2)"),
    (np.array(SQUARE, dtype="M8[s]"), REST,
     "positions is an array of datetime64[s]; expected real numbers of shape (n, 2)"),
    ([[0, 0], [1, np.nan], [2, 2], [3, 3]], REST, "positions[1, 1] is nan; expected finite numbers"),
    ([[0, 0], [1, 0], [np.inf, 2], [3, 3]], REST, "positions[2, 0] is inf; expected finite numbers"),
    (SQUARE, [[0, 0], [0, -np.inf], [0, 0], [0, 0]],
     "velocities[1, 1] is -inf; expected finite numbers"),
    (np.array(SQUARE, dtype="f4") * np.float32("nan"), REST,
     "positions[0, 0] is nan; expected finite numbers"),
    ([[0, 0], [1, 2**53 + 1], [0, 1], [1, 1]], REST,
     "positions[1, 1] is 9007199254740993, which float64 rounds; expected numbers that are exact in "
     "float64"),
    (np.array(SQUARE, dtype="g") + np.longdouble(2) ** -60, REST, None),
    (np.array([[0, 0], [1, 2**64 - 1], [0, 1], [1, 1]], dtype=np.uint64), REST, None),
    (np.full((4, 2), np.longdouble(2) ** 5000), REST, None),
    (np.ma.masked_equal(SQUARE, 3), REST, "positions is masked at [2, 1]; expected no masked values"),
    (np.ma.masked_equal(np.array(SQUARE, dtype=float), 3), REST,
     "positions is masked at [2, 1]; expected no masked values"),
])
def test_a_bad_array_is_refused_with_the_shape_or_the_numbers_expected(positions, velocities, message):
    with pytest.raises(kinetri.PreconditionError) as raised:
        triangulation(positions, velocities)
    if message is None:
        assert "which float64 rounds" in str(raised.value)
    else:
        assert str(raised.value) == message
    assert isinstance(raised.value, kinetri.Error) and isinstance(raised.value, ValueError)


def test_a_masked_array_without_masked_numbers_is_an_array():
    assert triangulation(np.ma.array(SQUARE, mask=False)).positions().tolist() == SQUARE


def test_columns_of_tables_are_arrays():
    import pandas as pd

    table = pd.DataFrame({"x": [0, 4, 0, 5], "y": [0.0, 0, 3, 4], "vx": 0, "vy": 0})
    kd = triangulation(table[["x", "y"]], table[["vx", "vy"]])
    assert kd.triangles().tolist() == EXPECTED


def test_what_float64_has_is_taken_from_any_type():
    big = 2**53
    kd = kinetri.KineticDelaunay(np.array([[big, -big], [0, 1]]), np.zeros((2, 2), dtype=np.int8))
    assert kd.positions().tolist() == [[big, -big], [0, 1]]
    tiny = np.array([[5e-324, 0], [1, np.nextafter(1, 2)]], dtype=np.longdouble)
    assert kinetri.KineticDelaunay(tiny, np.zeros((2, 2))).positions().tolist() == tiny.tolist()


@pytest.mark.parametrize("ids, message", [
    ([0.5], "ids is an array of float64 of shape (1,); expected ids: integers of shape (n,)"),
    ([[0, 1]], "ids is an array of int64 of shape (1, 2); expected ids: integers of shape (n,)"),
    ([True], "ids is a mask of shape (1,); expected one bool for each id: shape (4,)"),
    (True, "ids is a mask of shape (1,); expected one bool for each id: shape (4,)"),
    (np.ones((4, 1), dtype=bool), "ids is a mask of shape (4, 1); expected one bool for each id: shape (4,)"),
    (slice("a", 2), "ids is slice('a', 2, None); expected a slice of ids: slice indices must be integers or "
                    "None or have an __index__ method"),
    (slice(0, 2, 0), "ids is slice(0, 2, 0); expected a slice of ids: slice step cannot be zero"),
    ("a", "ids is an array of <U1 of shape (1,); expected ids: integers of shape (n,)"),
    ([1, -1], "ids[1] is -1; expected ids from 0 to 4294967294"),
    (2**32, "ids[0] is 4294967296; expected ids from 0 to 4294967294"),
    (np.array([1, 2**64 - 1], dtype=np.uint64),
     "ids[1] is 18446744073709551615; expected ids from 0 to 4294967294"),
    ([0, [1]], "ids is no array of numbers; expected ids: integers of shape (n,)"),
    (None, "ids is an array of object of shape (1,); expected ids: integers of shape (n,)"),
])
def test_bad_ids_are_refused(ids, message):
    with pytest.raises(kinetri.PreconditionError) as raised:
        triangulation(SQUARE).erase(ids)
    assert str(raised.value) == message


@pytest.mark.parametrize("dtype", ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", ">i4"])
def test_ids_of_every_integer_dtype(dtype):
    kd = triangulation(SQUARE)
    kd.erase(np.array([2, 0], dtype=dtype)[::-1])
    assert kd.ids.tolist() == [1, 3]
    assert 2 not in kd and 1 in kd
    assert np.isnan(kd.positions()[[0, 2]]).all() and kd.next_id == 4


def test_no_ids_change_nothing():
    kd = triangulation(SQUARE)
    for none in ([], np.empty(0), ()):
        kd.erase(none)
        kd.set_velocities(none, np.empty((0, 2)))
        kd.set_motions(none, [], [])
        assert kd.insert([], []).tolist() == []
    assert len(kd) == 4 and kd.edges().tolist() == triangulation(SQUARE).edges().tolist()


@pytest.mark.parametrize("call, message", [
    (lambda kd: kd.neighbors(4), "no point 4"),
    (lambda kd: kd.motion(4), "no point 4"),
    (lambda kd: kd.voronoi_cell(4), "no point 4"),
    (lambda kd: kd.erase(4), "no point 4"),
    (lambda kd: kd.set_velocities(4, [0, 0]), "no point 4"),
    (lambda kd: kd.set_motions(4, [[0, 0]], [[0, 0]]), "no point 4"),
    (lambda kd: kd.erase([1, 1]), "twice"),
    (lambda kd: kd.set_velocities([1, 1], [1, 0]), "twice"),
    (lambda kd: kd.set_motions([1, 1], [[7, 7]] * 2, [[1, 0]] * 2), "twice"),
    (lambda kd: kd.neighbors(-1), "id is -1; expected an id from 0 to 4294967294"),
    (lambda kd: kd.neighbors(1.0), "id is 1.0; expected the id of a point: an integer"),
    (lambda kd: kd.neighbors(True), "id is True; expected the id of a point: an integer"),
    (lambda kd: kd.nearest_neighbors(k=0), "k is 0; expected a whole number from 1 to 4294967295"),
    (lambda kd: kd.nearest_neighbors(k=2**32), "k is 4294967296; expected a whole number from 1 to 4294967295"),
    (lambda kd: kd.nearest_neighbors(k=2.0), "k is 2.0; expected a whole number"),
    (lambda kd: kd.record(9, kinds="flips"),
     "kinds has 'flips', which is not a kind of event; expected one or more of 'rebuild', 'hull_insert', "),
    (lambda kd: kd.record(9, kinds=["flip", None]), "kinds has None, which is not a kind of event; expected"),
    (lambda kd: kd.record(9, kinds=3), "kinds is 3; expected one or more of 'rebuild', "),
    (lambda kd: kd.set_velocities([[1, 0]]), "velocities has the shape (1, 2); expected (4, 2)"),
    (lambda kd: kd.set_velocities(None), "velocities is None; expected two numbers for each point"),
    (lambda kd: kd.set_velocities([[1, 0]] * 3 + [[np.nan, 0]]),
     "velocities[3, 0] is nan; expected finite numbers"),
    (lambda kd: kd.set_velocities(slice(1, 3), [[1, 0]]), "velocities has the shape (1, 2); expected (2, 2)"),
    (lambda kd: kd.set_velocities([True, False, True, False], [[1, 0]] * 4),
     "velocities has the shape (4, 2); expected (2, 2)"),
    (lambda kd: kd.neighbors("a"), "id is 'a'; expected the id of a point: an integer"),
    (lambda kd: kd.set_velocities([0, 1], [[1, 0]]),
     "velocities has the shape (1, 2); expected (2, 2)"),
    (lambda kd: kd.set_velocities(0, [np.nan, 0]), "velocities[0, 0] is nan; expected finite numbers"),
    (lambda kd: kd.set_motions([0, 1], [[1, 0]], [[1, 0]]),
     "positions has the shape (1, 2); expected (2, 2)"),
    (lambda kd: kd.insert([[1, 0]], [[1, 0]] * 2), "velocities has the shape (2, 2); expected (1, 2)"),
    (lambda kd: kd.nearest_vertex([1, 2, 3]), "place has the shape (3,); expected (2,)"),
    (lambda kd: kd.nearest_vertex([np.inf, 0]), "place[0] is inf; expected finite numbers"),
    (lambda kd: kd.locate("ab"), "place is an array of <U2; expected real numbers of shape (2,)"),
    (lambda kd: kd.voronoi_areas((0, 0, 1)), "clip has the shape (3,); expected (4,)"),
    (lambda kd: kd.voronoi_areas((0, 0, 0, 1)),
     "clip is (0.0, 0.0, 0.0, 1.0); expected (xmin, ymin, xmax, ymax) with xmin < xmax and ymin < ymax"),
    (lambda kd: kd.voronoi_areas([[0, 0], [1, 1]]), "polygon"),
    (lambda kd: kd.voronoi_areas([[0, 0], [2, 2], [2, 0], [0, 2]]), "polygon"),
    (lambda kd: kd.audit("all"), "level is 'all'; expected 'links', 'embedding', 'delaunay', "
                                 "'reference' or 'certificates'"),
    (lambda kd: kd.audit(3), "level is '3'; expected"),
    (lambda kd: kd.insert([[1, 1]], [[0, 0]], acceleration=[[1, 1]]), "acceleration"),
    (lambda kd: kd.play(1, most_events=-1), "most_events is -1; expected"),
    (lambda kd: kinetri.scenario("circle"), "the scenario is 'circle'; expected one of 'uniform'"),
    (lambda kd: kinetri.scenario("uniform", -1), "points is -1; expected"),
    (lambda kd: kinetri.scenario("uniform", 1.5), "points is 1.5; expected a whole number"),
    (lambda kd: kinetri.scenario("lattice", 9, movers="few"), "movers is 'few'; expected one of"),
    (lambda kd: kinetri.scenario("uniform", 10, side=0), "side"),
    (lambda kd: kinetri.scenario("uniform", 10, side=np.nan), "side[0] is nan"),
])
def test_a_bad_call_is_refused_and_changes_nothing(call, message):
    kd = triangulation(SQUARE)
    before = kd.snapshot()
    with pytest.raises(kinetri.PreconditionError) as raised:
        call(kd)
    assert message in str(raised.value)
    assert kd.snapshot() == before


def test_points_in_one_place_at_all_times_are_named():
    with pytest.raises(kinetri.CoincidentTrajectoriesError) as raised:
        triangulation([[0, 0], [1, 1], [2, 2], [1, 1]], coincident="refuse")
    assert raised.value.ids == (1, 3)
    kd = triangulation(SQUARE, coincident="refuse")
    before = kd.snapshot()
    for call in (lambda: kd.set_motions([0, 1], [[9, 9]] * 2, [[1, 1]] * 2),
                 lambda: kd.insert([[9, 9], [4, 0]], [[0, 0]] * 2)):
        with pytest.raises(kinetri.CoincidentTrajectoriesError):
            call()
        assert np.array_equal(kd.edges(), triangulation(SQUARE).edges())
        assert kd.audit()
    assert kd.snapshot().restore().record(until=1).tobytes() == before.restore().record(until=1).tobytes()


def test_a_row_may_stand_for_one_point():
    kd = triangulation(SQUARE)
    assert kd.insert([9, 9], [1, 0]).tolist() == [4]
    kd.set_motions(4, [8, 9], [0, 1])
    assert kd.motion(4)["position"] == (8, 9) and kd.motion(4)["velocity"] == (0, 1)
    kd.set_velocities([0, 4], [2, 3])
    assert kd.velocities()[[0, 4]].tolist() == [[2, 3]] * 2
    accelerated = kinetri.KineticDelaunay(SQUARE, REST, acceleration=REST)
    accelerated.insert([9, 9], [1, 0], acceleration=[0, 1])
    assert accelerated.motion(4)["acceleration"] == (0, 1)


def test_a_number_stands_for_all_points():
    kr = kinetri.KineticRegular(SQUARE, REST, radius=2, growth=np.float32(0.5), weight=[1, 2, 3, 4])
    assert kr.radii().tolist() == [2] * 4
    assert [kr.motion(id)["growth"] for id in range(4)] == [0.5] * 4
    assert [kr.motion(id)["weight"] for id in range(4)] == [1, 2, 3, 4]
    with pytest.raises(kinetri.PreconditionError, match=r"radius has the shape \(2,\); expected \(4,\)"):
        kinetri.KineticRegular(SQUARE, REST, radius=[1, 2])
    with pytest.raises(kinetri.PreconditionError, match="radius is an array of <U1"):
        kinetri.KineticRegular(SQUARE, REST, radius="a")
    with pytest.raises(kinetri.PreconditionError, match=r"weight\[0\] is nan"):
        kinetri.KineticRegular(SQUARE, REST, weight=np.nan)


def test_the_number_that_is_refused_is_shown_in_full():
    number = np.longdouble(4) + np.longdouble(2) ** -60
    with pytest.raises(kinetri.PreconditionError, match=r"positions\[0, 0\] is 4\.0000000000000000"):
        triangulation(np.array([[number, 1]]), [[0, 0]])


def test_fractions_are_not_rounded_in_silence():
    with pytest.raises(kinetri.PreconditionError, match="array of object"):
        triangulation([[fractions.Fraction(1, 3), 0]], [[0, 0]])


def test_a_message_of_the_library_says_what_is_wrong_and_nothing_of_its_code():
    kd = kinetri.KineticDelaunay([[0, 0]], [[0, 0]])
    kd.advance_to(1)
    with pytest.raises(kinetri.PreconditionError) as caught:
        kd.advance_to(0)
    assert str(caught.value) == ("the time to advance to is in the past; take the present one or a later "
                                 "one, or call reverse first")
