# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulations: responses, masses, growth, walls, scheduled changes, and errors with their ids."""
import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, strategies as st
from support import few

import kinetri

HEAD_ON = ([[0, 0], [10, 0]], [[1, 0], [-1, 0]])


def grid_of_discs(seed, n=36):
    rng = np.random.default_rng(seed)
    places = np.stack(np.meshgrid(np.arange(6), np.arange(6)), -1).reshape(-1, 2)[:n] * 10.0 + 5
    return {"positions": places, "velocities": rng.uniform(-8, 8, (n, 2)),
            "radius": rng.uniform(0.5, 4, n), "mass": rng.uniform(0.1, 9, n), "box": (0, 0, 60, 60)}


def overlaps(sim):
    """The pairs whose discs overlap by more than rounding."""
    places, radii = sim.positions(), sim.radii()
    return [(a, b) for a, b in itertools.combinations(sim.ids.tolist(), 2)
            if np.hypot(*(places[a] - places[b])) < (radii[a] + radii[b]) * (1 - 1e-9)]


# ---- built-in responses ----

@pytest.mark.parametrize("collisions, velocities", [
    (None, [[1, 0], [-1, 0]]), ("none", [[1, 0], [-1, 0]]), ("log", [[1, 0], [-1, 0]]),
    ("swap", [[-1, 0], [1, 0]]), ("elastic", [[-1, 0], [1, 0]]), ("stop", [[0, 0], [0, 0]]),
    ("remove", None)])
def test_built_in_responses(collisions, velocities):
    sim = kinetri.Simulation(*HEAD_ON, radius=1, collisions=collisions)
    events = sim.record(until=5)
    assert sim.collisions == collisions
    touched = events[events["kind"] == "collision"]
    if collisions in (None, "none"):
        assert len(touched) == 0
    else:
        assert touched["time"].tolist() == [4] and touched["points"].tolist() == [[0, 1]]
    if velocities is None:
        assert len(sim) == 0 and np.isnan(sim.velocities()).all() and sim.energy() == 0
    else:
        assert sim.velocities().tolist() == velocities


@pytest.mark.parametrize("name", ["log", "swap", "elastic", "stop", "remove"])
@pytest.mark.parametrize("case", ["equal", "any size", "accelerated"])
def test_a_function_that_calls_a_built_in_response_gives_its_run(name, case):
    arguments = grid_of_discs(3)
    if case != "any size":
        arguments["radius"] = 2
    if case == "accelerated":
        arguments["acceleration"] = np.random.default_rng(5).uniform(-1, 1, (36, 2))
    expected = kinetri.Simulation(**arguments, collisions=name)
    sim = kinetri.Simulation(**arguments, collisions=lambda contact: kinetri.respond(name, contact))
    events = expected.record(until=1.5)
    assert (events["kind"] == "collision").sum() > 2
    assert sim.record(until=1.5).tobytes() == events.tobytes()
    assert np.array_equal(sim.positions(), expected.positions(), equal_nan=True)


def test_none_as_response_lets_discs_pass():
    arguments = grid_of_discs(4)
    expected = kinetri.Simulation(**arguments, collisions="log").record(until=1)
    sim = kinetri.Simulation(**arguments, collisions=lambda contact: None)
    assert sim.record(until=1).tobytes() == expected.tobytes()


# ---- responses of the user ----

def test_what_a_contact_says():
    seen = []

    def response(contact):
        seen.append((contact.time, contact.ids, contact.separation, contact.velocity_a, contact.velocity_b,
                     contact.mass_a, contact.mass_b, contact.growth_a, contact.growth_b,
                     contact.is_pressed, contact.would_approach([1, 0], [0, 0]),
                     contact.would_approach([-1, 0], [1, 0])))
        return [-1, 0], [1, 0]

    sim = kinetri.Simulation([[0, 0], [10, 0]], [[1, 0], [-1, 0]], radius=[1, 2], growth=[0.5, 0],
                             mass=[3, 4], collisions=response)
    sim.advance_to(4)
    # 10 - 2 t = 3 + t / 2
    assert [float(x) for x in seen[0][:1]] == [2.8] and len(seen) == 1
    assert seen[0][1] == (0, 1) and np.allclose(seen[0][2], [4.4, 0])
    assert seen[0][3:] == ([1, 0], [-1, 0], 3, 4, 0.5, 0, False, True, False)
    assert sim.velocities().tolist() == [[-1, 0], [1, 0]]


@pytest.mark.parametrize("result, velocities", [
    (kinetri.Response(), [[1, 0], [-1, 0]]),
    (([0, 1], [0, -1]), [[0, 1], [0, -1]]),
    (np.array([[0, 1], [0, -1]]), [[0, 1], [0, -1]]),
    ([None, (2, 0)], [[1, 0], [2, 0]]),
    (kinetri.Response(velocity_a=(np.float32(-2), 1)), [[-2, 1], [-1, 0]]),
    (kinetri.Response(stops_a=True), [[0, 0], [-1, 0]]),
    (kinetri.Response(stops_b=True, velocity_a=(-1, 0)), [[-1, 0], [0, 0]]),
    (kinetri.Response(erases_a=True), [[np.nan] * 2, [-1, 0]]),
    (kinetri.Response(erases_b=True, stops_a=True), [[0, 0], [np.nan] * 2]),
    (kinetri.Response(erases_a=True, erases_b=True), [[np.nan] * 2] * 2),
])
@pytest.mark.parametrize("radius", [1, [1, 1.5]])
def test_results_of_a_response(result, velocities, radius):
    sim = kinetri.Simulation(*HEAD_ON, radius=radius, collisions=lambda contact: result)
    sim.advance_to(4.25)
    assert np.array_equal(sim.velocities(), velocities, equal_nan=True)
    assert sim.audit()


@pytest.mark.parametrize("result, error, message", [
    (3, kinetri.PreconditionError,
     "the response gave 3; expected None, a kinetri.Response, or two velocities"),
    ([1, 2, 3], kinetri.PreconditionError, "expected None, a kinetri.Response, or two"),
    ([1, 2], kinetri.PreconditionError, r"velocity_a has the shape \(\); expected \(2,\)"),
    (([0, 0, 0], None), kinetri.PreconditionError, r"velocity_a has the shape \(3,\); expected \(2,\)"),
    ((None, [np.nan, 0]), kinetri.PreconditionError, r"velocity_b\[0\] is nan; expected finite"),
    ("ab", kinetri.PreconditionError, "velocity_a is an array of <U1|velocity_a has the shape"),
])
def test_a_bad_result_of_a_response_is_refused(result, error, message):
    sim = kinetri.Simulation(*HEAD_ON, radius=1, collisions=lambda contact: result)
    with pytest.raises(error, match=message):
        sim.advance_to(5)
    # Two discs touch and have not been told what to do: nothing can follow.
    with pytest.raises(kinetri.PreconditionError, match="between two events of one time"):
        sim.advance_to(6)
    assert "between two events" in repr(sim)


def test_an_error_of_a_response_comes_out_with_the_events_before():
    def response(contact):
        raise LookupError("no idea")

    sim = kinetri.Simulation([[0, 0], [10, 0], [5, 5]], [[1, 0], [-1, 0], [0, -3]], radius=1,
                             collisions=response)
    snapshot = sim.snapshot()
    with pytest.raises(LookupError, match="no idea") as raised:
        sim.record(until=6)
    assert raised.value.events.dtype == kinetri.event_dtype
    assert snapshot.restore().step(until=0.1) == 0


def test_a_simulation_without_points_at_first():
    for radius, growth, later in ((1, None, {}), (1, 0, {}), ([], None, {"radius": 1}),
                                  (2, 0.5, {"radius": 1}), ([], [], {"radius": 1})):
        sim = kinetri.Simulation([], [], radius=radius, growth=growth, collisions="elastic")
        assert len(sim) == 0 and sim.energy() == 0 and sim.radii().shape == (0,)
        sim.insert(*HEAD_ON, **later)
        assert sim.radii().tolist() == [1, 1]
        sim.advance_to(5)
        assert sim.velocities().tolist() == [[-1, 0], [1, 0]]
    with pytest.raises(kinetri.PreconditionError, match="radius is 0"):
        kinetri.Simulation([], [], collisions="elastic")


def test_radii_are_not_negative():
    with pytest.raises(kinetri.PreconditionError, match=r"radius\[1\] is -1.0; expected at least 0"):
        kinetri.Simulation(*HEAD_ON, radius=[1, -1])
    sim = kinetri.Simulation(*HEAD_ON, radius=[1, 2])
    with pytest.raises(kinetri.PreconditionError, match=r"radius\[0\] is -1.0; expected at least 0"):
        sim.insert([50, 50], [0, 0], radius=-1)


@pytest.mark.parametrize("collisions, message", [
    ("bounce", "collisions is 'bounce'; expected 'none', 'log', 'swap', 'elastic', 'stop', 'remove', None "
               "or a function"),
    (3, "collisions is 3; expected a name such as 'elastic', None, or a function of a contact")])
def test_an_unknown_response_is_refused(collisions, message):
    with pytest.raises(kinetri.PreconditionError) as raised:
        kinetri.Simulation(*HEAD_ON, radius=1, collisions=collisions)
    assert str(raised.value) == message
    with pytest.raises(kinetri.PreconditionError, match="name is 'bounce'; expected 'log', 'swap', "):
        kinetri.Simulation(*HEAD_ON, radius=1,
                           collisions=lambda c: kinetri.respond("bounce", c)).advance_to(5)


def test_a_response_that_leaves_discs_approaching_passes_them_through_once():
    count = []
    sim = kinetri.Simulation(*HEAD_ON, radius=1, collisions=lambda contact: count.append(contact.ids))
    sim.advance_to(100)
    assert count == [(0, 1)]


# ---- masses and energy ----

def test_masses_and_energy():
    sim = kinetri.Simulation(*HEAD_ON, radius=[1, 2], mass="area", collisions="elastic")
    assert sim.masses().tolist() == [1, 4] and sim.energy() == 2.5
    assert kinetri.Simulation(*HEAD_ON).masses().tolist() == [1, 1]
    assert kinetri.Simulation(*HEAD_ON, mass=3).energy() == 3
    sim.advance_to(4)
    velocities = sim.velocities()
    # One dimension: v_a' = v_a - 2 m_b / (m_a + m_b) (v_a - v_b).
    assert np.allclose(velocities, [[1 - 1.6 * 2, 0], [-1 + 0.4 * 2, 0]], atol=1e-14)
    sim.set_masses(1, 8)
    sim.set_masses([0], [2])
    assert sim.masses().tolist() == [2, 8]
    sim.erase(0)
    assert sim.masses().tolist() == [1, 8] or sim.masses().tolist() == [2, 8]
    assert np.isclose(sim.energy(), 4 * velocities[1, 0] ** 2)
    assert sim.insert([50, 50], [1, 1], radius=1, mass=6).tolist() == [2]
    assert sim.masses()[2] == 6


@pytest.mark.parametrize("masses, message", [
    ([1, 0], "mass"), ([1, -1], "mass"), ([1, np.nan], r"mass\[1\] is nan"), ([1], r"expected \(2,\)"),
    ("weight", "mass is 'weight'; expected numbers, or 'area'"),
    ("area", "mass='area' without radius; expected radii")])
def test_bad_masses(masses, message):
    with pytest.raises(kinetri.PreconditionError, match=message):
        kinetri.Simulation(*HEAD_ON, mass=masses)


@pytest.mark.parametrize("ids, masses, message", [
    ([0, 1], [5, 0], "the mass of point 1 is 0.0*; expected one greater than 0"),
    ([0, 7], [5, 5], "no point 7"), ([0, 1], [5], r"masses has the shape \(1,\); expected \(2,\)")])
def test_masses_are_set_all_or_none(ids, masses, message):
    sim = kinetri.Simulation(*HEAD_ON)
    with pytest.raises(kinetri.PreconditionError, match=message):
        sim.set_masses(ids, masses)
    assert sim.masses().tolist() == [1, 1]


@pytest.mark.parametrize("seed", range(3))
def test_energy_and_momentum_are_kept_and_discs_do_not_overlap(seed):
    arguments = grid_of_discs(seed)
    arguments["box"] = None
    sim = kinetri.Simulation(**arguments, collisions="elastic")
    energy, momentum = sim.energy(), sim.masses() @ sim.velocities()
    collided = 0
    for time in np.arange(0.25, 3, 0.25):
        collided += (sim.record(until=time)["kind"] == "collision").sum()
        assert overlaps(sim) == []
        assert np.isclose(sim.energy(), energy, rtol=1e-12)
        assert np.allclose(sim.masses() @ sim.velocities(), momentum, rtol=1e-11, atol=1e-9)
    assert collided > 5 and sim.audit()


def test_growing_discs_do_not_overlap():
    arguments = {**grid_of_discs(5), "growth": 0.25}
    arguments["radius"] = np.linspace(0.5, 2, 36)
    sim = kinetri.Simulation(**arguments, rim=True, collisions="elastic")
    assert sim.motion(3)["growth"] == 0.25
    for time in (1, 2, 3):
        sim.advance_to(time)
        assert np.allclose(sim.radii(), arguments["radius"] + 0.25 * time)
        assert overlaps(sim) == []
        places, radii = sim.positions(), sim.radii()[:, None]
        assert np.all(places - radii >= -1e-9) and np.all(places + radii <= 60 + 1e-9)
    assert sim.audit()


# ---- brute force ----

@few
@given(st.integers(0, 2**32 - 1))
def test_first_contacts_are_those_of_all_pairs(seed):
    """Small integers: contacts in rational arithmetic, many of them at one time or touching only."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 7))
    positions = rng.choice(25, n, replace=False)
    positions = np.column_stack((positions % 5, positions // 5)) * 8
    velocities = rng.integers(-3, 4, (n, 2))
    radii = rng.integers(1, 4, n)
    until = Fraction(6)
    sim = kinetri.Simulation(positions, velocities, radius=radii, collisions="log")
    logged = {tuple(event["points"].tolist()): event for event in sim.record(until=until)
              if event["kind"] == "collision"}
    for a, b in itertools.combinations(range(n), 2):
        p = [int(x) for x in positions[b] - positions[a]]
        v = [int(x) for x in velocities[b] - velocities[a]]
        reach = int(radii[a] + radii[b])
        # |p + v t|^2 = reach^2: the smaller root, where they come nearer.
        A, B, C = v[0]**2 + v[1]**2, p[0]*v[0] + p[1]*v[1], p[0]**2 + p[1]**2 - reach**2
        discriminant = B * B - A * C
        meets = A > 0 and B < 0 and C > 0 and discriminant > 0
        root = (-B - discriminant**0.5) / A if meets else np.inf
        if root <= until:
            assert (a, b) in logged, (a, b, root)
            assert abs(logged[a, b]["time"] - root) <= 1e-12 * max(1, root)
        else:
            assert (a, b) not in logged


# ---- walls ----

@few
@given(st.integers(0, 2**32 - 1))
def test_points_stay_in_the_box_and_turn_where_they_must(seed):
    rng = np.random.default_rng(seed)
    box = (0, 0, 16, 8)
    n = 4
    positions = rng.integers(1, [16, 8], (n, 2)) + np.arange(n)[:, None] / 8
    velocities = rng.integers(-3, 4, (n, 2)).astype(float)
    sim = kinetri.Simulation(positions, velocities, box=box)
    assert sim.box == box
    sim.advance_to(5)
    # Unfolded: a triangle wave of the straight line. Binary fractions: hardly anything is rounded.
    for axis, size in ((0, 16.0), (1, 8.0)):
        unfolded = (positions[:, axis] + 5 * velocities[:, axis]) % (2 * size)
        expected = np.minimum(unfolded, 2 * size - unfolded)
        assert np.allclose(sim.positions()[:, axis], expected, atol=1e-12)
    assert np.array_equal(np.abs(sim.velocities()), np.abs(velocities))
    assert sim.audit()


def test_rim_and_center():
    for rim, time in ((False, 10), (True, 8)):
        sim = kinetri.Simulation([[0, 0]], [[1, 0]], radius=2, box=(-5, -5, 10, 5), rim=rim)
        events = sim.record(until=11)
        assert events["kind"].tolist() == ["wall"] and events["time"].tolist() == [time]
        assert events["points"].tolist() == [[0, kinetri.NO_POINT]]


# ---- changes ----

def test_scheduled_changes():
    sim = kinetri.Simulation([[0, 0], [10, 0], [0, 10]], [[1, 0], [0, 0], [0, 0]])
    assert sim.schedule_insert(2, [3, 3], [0, 1], mass=4) == 3
    sim.schedule_erase(Fraction(5, 2), 1)
    sim.schedule_motion(1.5, 2, [1, 11], [-1, 0])
    assert sim.next_id == 4 and 3 not in sim and len(sim) == 3
    events = sim.record(until=3)
    kinds = [(kind, time) for kind, time in events[["kind", "time"]].tolist()
             if kind in ("insert", "erase", "trajectory")]
    assert kinds == [("trajectory", 1.5), ("insert", 2), ("erase", 2.5)]
    assert sim.ids.tolist() == [0, 2, 3]
    assert sim.positions()[[0, 2, 3]].tolist() == [[3, 0], [-0.5, 11], [3, 4]]
    assert sim.masses()[3] == 4
    with pytest.raises(kinetri.PreconditionError, match="past"):
        sim.schedule_erase(2.75, 0)
    with pytest.raises(kinetri.PreconditionError, match=r"position has the shape \(1, 2\)|expected \(2,\)"):
        sim.schedule_insert(4, [[1, 1]], [0, 0])
    with pytest.raises(kinetri.PreconditionError, match="mass"):
        sim.schedule_insert(4, [1, 1], [0, 0], mass=-1)


def test_a_scheduled_change_that_is_impossible_is_dropped_and_raises_once():
    sim = kinetri.Simulation([[1, 1], [2, 2]], [[0, 0], [0, 0]], box=(0, 0, 4, 4), coincident="refuse")
    sim.schedule_motion(1, 0, [9, 9], [0, 0])
    sim.schedule_motion(1, 1, [3, 3], [0, 0])
    sim.schedule_insert(2, [1, 1], [0, 0])
    with pytest.raises(kinetri.OutsideBoxError) as raised:
        sim.advance_to(3)
    assert raised.value.id == 0
    with pytest.raises(kinetri.CoincidentTrajectoriesError) as raised:
        sim.advance_to(3)
    assert raised.value.ids == (0, 2) and sim.time == 2
    assert sim.positions()[:2].tolist() == [[1, 1], [3, 3]]
    sim.advance_to(3)
    assert sim.time == 3 and len(sim) == 2 and sim.audit()


def test_a_dropped_change_does_not_hide_what_follows():
    sim = kinetri.Simulation([[0, 0], [10, 0], [50, 50]], [[1, 0], [-1, 0], [0, 0]], radius=1,
                             collisions="elastic")
    for time in (1, 1.5, 2):
        sim.schedule_erase(time, 2)
    sim.erase(2)
    assert [(event.kind, event.time) for event in sim.events(until=5)] == [("collision", 4)]
    assert sim.velocities()[:2].tolist() == [[-1, 0], [1, 0]]


def test_insertion_is_all_or_nothing():
    sim = kinetri.Simulation([[1, 1], [2, 2]], [[0, 0], [0, 0]], box=(0, 0, 4, 4))
    with pytest.raises(kinetri.OutsideBoxError, match="^point 3 is outside of the box at t = 0: ") as raised:
        sim.insert([[3, 3], [5, 5]], [[0, 0]] * 2)
    assert raised.value.id == 3 and len(sim) == 2 and sim.ids.tolist() == [0, 1]
    assert sim.insert([[3, 3], [3.5, 3]], [[0, 0]] * 2, mass=[2, 3]).tolist() == list(
        range(sim.next_id - 2, sim.next_id))
    assert len(sim) == 4 and sim.audit()
    with pytest.raises(kinetri.OutsideBoxError):
        sim.set_motions([0, 1], [[3, 1], [9, 9]], [[0, 0]] * 2)
    assert sim.positions()[:2].tolist() == [[1, 1], [2, 2]]


def test_sizes_of_discs_stay_unless_they_are_given():
    sim = kinetri.Simulation([[0, 0], [20, 0]], [[0, 0]] * 2, radius=[1, 2], growth=[0, 0.5])
    sim.advance_to(2)
    sim.set_motions([0, 1], [[0, 5], [20, 5]], [[0, 1]] * 2)
    assert sim.radii().tolist() == [1, 3]
    sim.set_motions(1, [20, 5], [0, 0], radius=4, growth=0)
    sim.set_velocities([0, 1], [1, 1])
    sim.advance_to(3)
    assert sim.radii().tolist() == [1, 4]
    uniform_discs = kinetri.Simulation([[0, 0], [20, 0]], [[0, 0]] * 2, radius=2)
    assert uniform_discs.motion(0)["radius"] == 2
    with pytest.raises(kinetri.PreconditionError, match="no radii of their own"):
        uniform_discs.set_motions(1, [20, 5], [0, 0], radius=4)
    with pytest.raises(kinetri.PreconditionError, match="straight lines"):
        uniform_discs.set_motions(1, [20, 5], [0, 0], acceleration=[1, 1])


# ---- errors ----

@pytest.mark.parametrize("arguments, error, attributes", [
    ({"box": (0, 0, 5, 5)}, "OutsideBoxError", {"id": 1}),
    ({"radius": [3, 8], "collisions": "elastic"}, "OverlappingDiscsError", {"pairs": [[0, 1]]}),
    ({"radius": 5, "collisions": "elastic", "refuse_overlaps": True}, None, {}),
    ({"radius": 6, "collisions": "elastic", "refuse_overlaps": True}, "OverlappingDiscsError",
     {"pairs": [[0, 1]]}),
    ({"radius": [3, 8], "collisions": "elastic", "refuse_overlaps": False}, None, {}),
    ({"radius": [3, 8], "collisions": "log"}, None, {}),
    ({"radius": -1}, "PreconditionError", {}),
    ({"radius": [1, -1]}, "PreconditionError", {}),
    ({"radius": [1, np.inf]}, "PreconditionError", {}),
    ({"growth": 1}, "PreconditionError", {}),
    ({"box": (0, 0, 0, 5)}, "PreconditionError", {}),
    ({"box": [1, 2]}, "PreconditionError", {}),
    ({"box": (0, 0, np.inf, 5)}, "PreconditionError", {}),
])
def test_an_impossible_start(arguments, error, attributes):
    call = lambda: kinetri.Simulation([[0, 0], [10, 0]], [[1, 0], [-1, 0]], **arguments)  # noqa: E731
    if error is None:
        assert len(call()) == 2
        return
    with pytest.raises(getattr(kinetri, error)) as raised:
        call()
    for name, value in attributes.items():
        assert getattr(raised.value, name) == value
        assert str(value if name == "id" else value[0][0]) in str(raised.value)


def test_a_radius_that_vanishes_names_disc_and_time_and_can_be_mended():
    sim = kinetri.Simulation([[0, 0], [10, 0]], [[0, 0]] * 2, radius=[1, 2], growth=[0, -0.5])
    sim.advance_to(4)
    assert sim.radii().tolist() == [1, 0]
    with pytest.raises(kinetri.NegativeRadiusError, match="1") as raised:
        sim.advance_to(5)
    assert raised.value.id == 1 and raised.value.time == 4
    sim.set_motions(1, [10, 0], [0, 0], radius=0, growth=0)
    sim.advance_to(5)
    assert sim.time == 5


def test_the_time_of_the_next_event():
    sim = kinetri.Simulation(*HEAD_ON, radius=1, collisions="elastic", box=(-3, -9, 13, 99))
    assert sim.next_event_time() == 4 and sim.time == 0  # the discs touch
    sim.schedule_insert(Fraction(7, 3), [5, 50], [0, 0])
    assert sim.next_event_time() == Fraction(7, 3)
    sim.advance_to(4)
    assert sim.velocities()[0, 0] == -1 and sim.next_event_time() == 11  # at the walls
    falling = kinetri.Simulation([[0, 0], [0, 1.5]], [[0, 0]] * 2, acceleration=[[0, 0], [0, -1]], radius=0.25,
                                 collisions="log")
    digits = 14142135623730950  # of the square root of 2
    assert Fraction(digits, 10**16) < falling.next_event_time() < Fraction(digits + 1, 10**16)
    shrinking = kinetri.Simulation([[0, 0], [9, 0]], [[0, 0]] * 2, radius=[1, 2], growth=[-0.25, 0])
    assert shrinking.next_event_time() == 4
    assert kinetri.Simulation([[0, 0], [9, 0]], [[0, 0]] * 2).next_event_time() is None


@pytest.mark.parametrize("collisions", [None, "elastic", "remove"])
def test_the_next_event_comes_at_its_time(collisions):
    sim = kinetri.Simulation(**grid_of_discs(5), collisions=collisions)
    for _ in range(60):
        before, expected = sim.time, sim.next_event_time()
        assert sim.time == before < expected
        # Points that meet, and triangles that hide a point, are no event of their own.
        sim.step(until=expected)
        assert sim.time <= expected
        sim.advance_to(expected)
        assert sim.next_event_time() > expected


def test_contacts_without_end():
    # The discs touch and are pressed together.
    sim = kinetri.Simulation([[0, 0], [2, 0]], [[0, 0]] * 2, radius=1, collisions="elastic",
                             acceleration=[[1, 0], [-1, 0]])
    with pytest.raises(kinetri.EndlessContactsError) as raised:
        sim.advance_to(1)
    assert raised.value.id in (0, 1) and isinstance(raised.value, kinetri.ContactError)


def test_what_a_simulation_cannot_do_is_said():
    sim = kinetri.Simulation(*HEAD_ON)
    assert not hasattr(sim, "reverse")
    discs = kinetri.Simulation(*HEAD_ON, radius=[1, 2])
    for call in (discs.nearest_neighbors, lambda: discs.nearest_neighbors(k=2), discs.closest_pair):
        with pytest.raises(kinetri.PreconditionError, match="regular triangulation"):
            call()
    with pytest.raises(TypeError, match="expected a KineticDelaunay"):
        kinetri.MovingPoints()


def test_velocities_of_points_that_accelerate():
    sim = kinetri.Simulation([[0, 0], [9, 9]], [[1, 0]] * 2, acceleration=[[0, 1], [0, 0]],
                             jerk=[[1, 0], [0, 0]], start=1)
    sim.advance_to(3)
    assert sim.velocities().tolist() == [[3, 2], [1, 0]]
    assert np.allclose(sim.positions(), [[2 + 8 / 6, 2], [11, 9]])
    sim.set_velocities(0, [5, 5])
    assert sim.motion(0)["acceleration"] == (2, 1) and sim.motion(0)["velocity"] == (5, 5)


def test_after_contacts_without_end_the_state_can_be_had_and_the_run_goes_on():
    # Two balls that touch at rest, and accelerate toward each other.
    simulation = kinetri.Simulation([[0, 0], [0, 2]], [[0, 0], [0, 0]], acceleration=[[0, 0], [0, -1]],
                                    radius=1.0, collisions="elastic")
    with pytest.raises(kinetri.EndlessContactsError, match="points 0 and 1 accelerate toward each other at t = 0"):
        simulation.advance_to(1)
    assert simulation.time == 0
    assert simulation.positions().tolist() == [[0, 0], [0, 2]]
    simulation.set_motions(1, [0, 2], [0, 0], acceleration=[0, 1])
    simulation.advance_to(2)
    assert simulation.positions().tolist() == [[0, 0], [0, 4]]


def test_jammed_discs_end_the_run():
    # Four radii are the width of the box at t = 2.
    run = kinetri.Simulation([[2, 4], [6, 4]], [[1, 0], [-1, 0]], radius=1, growth=0.5, box=(0, 0, 8, 8), rim=True,
                             collisions="swap")
    assert len(run.record(until=1.9)) > 0
    with pytest.raises(kinetri.EndlessContactsError, match="contacts without end before about t = "):
        run.advance_to(5)
    assert 1.9 < run.time < 2.001
    run.erase(0)
    run.advance_to(5)


def test_after_contacts_without_end_the_events_before_them_can_be_had():
    # Two balls touch at rest, until one of them begins to accelerate toward the other; a third one bounces.
    def simulation():
        result = kinetri.Simulation([[2, 2], [2, 4], [5, 5]], [[0, 0], [0, 0], [1, 0]], acceleration=[[0, 0]] * 3,
                                    box=(0, 0, 8, 8), radius=1.0, collisions="elastic")
        result.schedule_motion(3.5, 1, [2, 4], [0, 0], acceleration=[0, -1])
        return result

    expected = simulation().record(until=3)
    assert len(expected) > 0 and "wall" in expected["kind"]
    run = simulation()
    with pytest.raises(kinetri.EndlessContactsError, match="accelerate toward each other at t = 3.5") as raised:
        run.record(until=9)
    assert run.time == 3.5
    events = raised.value.events
    assert events.dtype == kinetri.event_dtype
    assert events[:len(expected)].tobytes() == expected.tobytes() and np.all(events["time"] <= 3.5)
    assert run.positions()[2].tolist() == [7.5, 5]
    only = simulation()
    with pytest.raises(kinetri.EndlessContactsError) as raised:
        only.record(until=9, kinds="wall")
    assert set(raised.value.events["kind"]) == {"wall"}
