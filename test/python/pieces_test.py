# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in pieces: byte for byte the events of one run."""
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, strategies as st
from support import few, uniform

import kinetri
from kinetri import pieces


@pytest.fixture(autouse=True)
def in_this_process(monkeypatch, request):
    """Pieces are computed here, but where a test is about processes."""
    if "processes" not in request.node.name:
        monkeypatch.setattr(pieces, "map_tasks", lambda function, runs, client, workers: [
            function(**run) for run in runs])


def same(expected, events):
    return events.dtype == expected.dtype and events.tobytes() == expected.tobytes()


def one_run(positions, velocities, until, **motion):
    return kinetri.KineticDelaunay(positions, velocities, **motion).record(until)


@pytest.mark.parametrize("count", [1, 2, 3, 7, 40])
def test_random_points(count):
    points = uniform(120, count)
    expected = one_run(*points, 2)
    assert len(expected) > 200
    assert same(expected, kinetri.run_in_pieces(*points, 2, count))


@pytest.mark.parametrize("count", [2, 5])
def test_points_that_accelerate(count):
    positions, velocities = uniform(50, 3)
    motion = {"acceleration": uniform(50, 4)[1], "jerk": uniform(50, 5)[1] / 3, "start": 0.5}
    expected = one_run(positions, velocities, 2.5, **motion)
    assert len(expected) > 100
    assert same(expected, kinetri.run_in_pieces(positions, velocities, 2.5, count, **motion))


def test_processes():
    points = uniform(150, 6)
    expected = one_run(*points, 2)
    assert same(expected, kinetri.run_in_pieces(*points, 2, 3, workers=2))


@pytest.mark.parametrize("movers", ["one", "columns", "all"])
@pytest.mark.parametrize("count", [2, 3, 8])
def test_lattices_with_many_events_at_one_time(movers, count):
    """Borders are times of events, and points are cocircular at the borders and for a while."""
    positions, velocities = kinetri.scenario("lattice", 36, seed=2, spacing=4, speed=2, movers=movers)
    velocities = np.round(velocities)
    expected = one_run(positions, velocities, 8)
    assert len(expected) > 20 and len(np.unique(expected["time"])) < len(expected)
    assert same(expected, kinetri.run_in_pieces(positions, velocities, 8, count))


@few
@given(st.integers(0, 2**32 - 1))
def test_small_integers(seed):
    """Degenerate in every way: points that meet, on lines and circles at all times or for a moment."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(0, 9))
    points = rng.integers(0, 4, (n, 2)), rng.integers(-1, 2, (n, 2))
    until, count = int(rng.integers(1, 5)), int(rng.integers(1, 6))
    assert same(one_run(*points, until), kinetri.run_in_pieces(*points, until, count))
    try:
        one_run(*points, until, coincident="refuse")
    except kinetri.CoincidentTrajectoriesError:
        with pytest.raises(kinetri.CoincidentTrajectoriesError):
            kinetri.run_in_pieces(*points, until, count, coincident="refuse")


def test_a_square_that_a_point_has_passed_through():
    """Its corners rest, so that they are cocircular at the border; the point 4 has left them before."""
    positions = np.array([[0, 0], [4, 0], [4, 4], [0, 4], [-3, 2.5], [100, 100], [-100, 90]])
    velocities = np.array([[0, 0]] * 4 + [[2, -0.5], [0, 0], [0, 0]])
    for mirror in (1, -1):
        p, v = positions * [mirror, 1], velocities * [mirror, 1]
        for count in (2, 5):
            assert same(one_run(p, v, 40), kinetri.run_in_pieces(p, v, 40, count))


def test_pieces_shorter_than_the_numbers_and_no_time_at_all():
    points = uniform(30, 8)
    assert same(one_run(*points, 0), kinetri.run_in_pieces(*points, 0, 3))
    end = np.nextafter(1, 2)
    assert same(one_run(*points, end, start=1.0), kinetri.run_in_pieces(*points, end, 10, start=1))
    assert same(one_run([], [], 1), kinetri.run_in_pieces([], [], 1, 2))
    assert same(one_run([[0, 0]], [[1, 1]], 1), kinetri.run_in_pieces([[0, 0]], [[1, 1]], 1, 2))


@pytest.mark.parametrize("arguments, message", [
    ((kinetri.Simulation(*uniform(3, 1)), 1, 2), "a simulation was given; expected motions"),
    ((kinetri.KineticDelaunay(*uniform(3, 1)), 1, 2), "a KineticDelaunay was given; expected positions"),
    ((uniform(3, 1)[0],), "velocities and until are needed"),
    ((*uniform(3, 1), -1, 2), "until is -1.0; expected at least start, which is 0.0"),
    ((*uniform(3, 1), 1, 0), "pieces is 0; expected at least 1"),
    ((*uniform(3, 1), 1, 1.5), "pieces is 1.5; expected a whole number"),
    ((*uniform(3, 1), np.inf, 2), r"until\[0\] is inf; expected finite|until is inf"),
    ((*uniform(3, 1), "a", 2), "until is"),
    ((uniform(3, 1)[0], uniform(4, 1)[1], 1, 2), r"velocities has the shape \(4, 2\); expected \(3, 2\)"),
])
def test_what_is_refused(arguments, message):
    with pytest.raises(kinetri.PreconditionError, match=message):
        kinetri.run_in_pieces(*arguments)


def test_borders_are_exact():
    # An event at the border itself belongs to the piece before it, once.
    positions = [[0, 0], [2, 0], [1, 2], [1, -3]]
    velocities = [[0, 0], [0, 0], [0, 0], [0, 1]]
    expected = one_run(positions, velocities, 5)
    assert expected["time"].tolist() == [2.5, 3]
    assert next(kinetri.KineticDelaunay(positions, velocities).events()).time == Fraction(5, 2)
    assert same(expected, kinetri.run_in_pieces(positions, velocities, 5, 2))
