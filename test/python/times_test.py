# SPDX-License-Identifier: GPL-3.0-or-later
"""Times: exact values, their order, equal hashes, copies; and what is no time."""
import copy
import itertools
import math
import pickle
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, strategies as st
from support import few, uniform

import kinetri
from kinetri import Time

numbers = st.one_of(st.integers(), st.floats(allow_nan=False, allow_infinity=False), st.fractions(),
                    st.integers(-2**200, 2**200))


def falling_point(gravity=1):
    """The flip of points 0 and 1 is where s^2 = 2 / gravity: irrational for most gravities."""
    return kinetri.KineticDelaunay([[0, 0], [2, 0], [0, 2], [2, 3]], [[0, 0]] * 4,
                                   acceleration=[[0, 0]] * 3 + [[0, -gravity]])


def event_time(gravity=1):
    return next(falling_point(gravity).events()).time


@few
@given(numbers)
def test_a_time_is_the_number_it_was_made_of(value):
    time = Time(value)
    assert time == value and value == time and not time != value
    assert time.fraction == Fraction(value)
    assert hash(time) == hash(value)
    assert time.lower <= Fraction(value) <= time.upper if abs(value) < 2.0**1000 else True
    if abs(value) < 2**1000:
        assert float(time) == float(Fraction(value))
        assert (time.lower == time.upper) == (Fraction(float(time)) == value)
        assert math.nextafter(time.lower, math.inf) >= time.upper
    for copied in (pickle.loads(pickle.dumps(time)), copy.copy(time), copy.deepcopy(time), Time(time)):
        assert copied == time and repr(copied) == repr(time)


@few
@given(numbers, numbers)
def test_times_are_ordered_as_numbers(a, b):
    for left, right in itertools.product((a, Time(a)), (b, Time(b))):
        assert (left < right) == (Fraction(a) < Fraction(b))
        assert (left <= right) == (Fraction(a) <= Fraction(b))
        assert (left > right) == (Fraction(a) > Fraction(b))
        assert (left >= right) == (Fraction(a) >= Fraction(b))
        assert (left == right) == (Fraction(a) == Fraction(b))
        assert (left != right) == (Fraction(a) != Fraction(b))


@pytest.mark.parametrize("value", [
    np.float64(0.5), np.float32(0.5), np.float16(0.5), np.longdouble(0.5), Decimal("0.5"),
    Fraction(1, 2)])
def test_scalars_of_every_kind(value):
    assert Time(value) == 0.5 and Time(0.25) < value and value > Time(0.25) and value <= Time(0.5)
    kd = kinetri.KineticDelaunay(*uniform(5, 1))
    kd.advance_to(value)
    assert kd.time == 0.5


@pytest.mark.parametrize("value", [np.int8(3), np.uint64(3), np.int64(3), True + 2])
def test_integers_of_every_kind(value):
    assert Time(value) == 3 and value == Time(3) and Time(value).fraction == 3


def test_a_long_double_is_taken_exactly():
    value = np.longdouble(1) + np.longdouble(2) ** -60
    assert Time(value).fraction == 1 + Fraction(1, 2**60)


def test_any_number_of_digits():
    big = Fraction(10**6000 + 1, 3)
    assert Time(big).fraction == big
    assert pickle.loads(pickle.dumps(Time(-big))) == -big
    assert Time(big) > Time(10**5000) > 1e308 and float(Time(big)) == math.inf
    assert Time(1 / big) > 0 and float(Time(1 / big)) == 0
    assert repr(Time(1 / big)) == "<Time between 0.0 and 5e-324>"


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan, np.float32("inf"), np.float32("nan"),
                                   np.longdouble("-inf"), Decimal("Infinity"), Decimal("NaN")])
def test_what_is_not_finite_is_no_time_but_can_be_compared(value):
    with pytest.raises(kinetri.PreconditionError, match="infinity or a NaN"):
        Time(value)
    number = float(value)
    assert (Time(1) < value) == (1 < number) and (Time(1) > value) == (1 > number)
    assert (Time(10**400) < value) == (0 < number)
    assert Time(1) != value and not Time(1) == value


@pytest.mark.parametrize("value", ["1", None, [1], np.array([0.5]), 1j, object(), np.bool_(True)])
def test_what_is_no_number_is_refused_everywhere(value):
    kd = kinetri.KineticDelaunay(*uniform(5, 1))
    sim = kinetri.Simulation(*uniform(5, 1))
    for call in (lambda: Time(value), lambda: kd.advance_to(value), lambda: kd.record(value),
                 lambda: kd.play(value), lambda: sim.schedule_erase(value, 0),
                 lambda: sim.schedule_motion(value, 0, [0, 0], [0, 0]),
                 lambda: sim.schedule_insert(value, [0, 0], [0, 0]),
                 lambda: kinetri.KineticDelaunay(*uniform(5, 1), start=value),
                 lambda: kinetri.KineticRegular(*uniform(5, 1), start=value),
                 lambda: kinetri.Simulation(*uniform(5, 1), start=value)):
        with pytest.raises(kinetri.PreconditionError, match="expected a float, an int"):
            call()
    assert Time(2) != value
    with pytest.raises(TypeError):
        Time(1) < "a"
    assert kd.time == 0 and sim.time == 0


def test_an_irrational_time_is_exact():
    time = event_time(1)  # the root of 2 s = s^2 / 2 ... s^2 = 2
    assert time.fraction is None
    assert time.lower < time.upper == math.nextafter(time.lower, 3)
    assert Fraction(time.lower) ** 2 < 2 < Fraction(time.upper) ** 2
    assert time.lower < time < time.upper and float(time) in (time.lower, time.upper)
    assert time == event_time(1) and hash(time) == hash(event_time(1))
    # 4 s^2 = 2 * 4 has the same root as another polynomial.
    again = pickle.loads(pickle.dumps(time))
    assert again == time and again != float(time) and hash(again) == hash(time)
    # Convergents of the square root of 2, on both sides.
    a, b = 1, 1
    for i in range(80):
        a, b = a + 2 * b, a + b
        assert (time < Fraction(a, b)) == (a * a > 2 * b * b)
    assert repr(time) == f"<Time between {time.lower!r} and {time.upper!r}>"
    assert repr(Time(2.5)) == "Time(2.5)"


def test_a_root_that_is_rational_is_known_to_be():
    time = event_time(18)  # s^2 = 1 / 9
    assert time.fraction == Fraction(1, 3)
    assert time == Fraction(1, 3) and hash(time) == hash(Fraction(1, 3))
    assert time in {Fraction(1, 3): None} and Fraction(1, 3) in {time: None}


def test_exact_times_go_in_again():
    kd = falling_point()
    time = kd.next_event_time()
    kd.advance_to(time.lower)
    assert kd.edges().tolist() == falling_point().edges().tolist()
    assert kd.advance_to(time) == 1 and kd.time == time
    before = falling_point()
    assert before.record(until=time)["time"].tolist() == [float(time)]
    with pytest.raises(kinetri.PreconditionError, match="past"):
        kd.advance_to(time.lower)
    assert kd.time == time and kd.advance_to(time.upper) == 0
    started = kinetri.KineticDelaunay([[0, 0], [1, 0]], [[1, 0], [1, 1]], start=time)
    assert started.time == time


def test_iterating_goes_to_the_time_that_is_given():
    kd = falling_point()
    assert [event.kind for event in kd.events(until=1.25)] == [] and kd.time == 1.25
    assert [event.kind for event in kd.events(until=1.5)] == ["flip"] and kd.time == 1.5
    assert kd.step(until=1.75) == 0 and kd.time == 1.5


def test_the_past_is_refused_and_nothing_changes():
    for kd in (kinetri.KineticDelaunay(*uniform(30, 2), start=1),
               kinetri.Simulation(*uniform(30, 2), start=1, radius=0.1, collisions="elastic")):
        expected = kd.snapshot().restore().record(until=2)
        for call in (lambda: kd.advance_to(0.5), lambda: kd.record(0), lambda: kd.play(-1),
                     lambda: list(kd.events(0.999))):
            with pytest.raises(kinetri.PreconditionError, match="past"):
                call()
        assert kd.step(0.5) == 0
        assert np.array_equal(kd.record(until=2), expected) and len(expected) > 0


def test_lower_and_upper_are_those_of_the_array():
    kd = kinetri.KineticDelaunay(*uniform(60, 4), acceleration=uniform(60, 5)[1])
    events = kd.snapshot().restore().record(until=1)
    exact = [event.time for event in kd.events(until=1)]
    assert len(exact) > 40 and sorted(exact) == exact
    assert events["time"].tolist() == [float(time) for time in exact]
    assert events["time_lo"].tolist() == [time.lower for time in exact]
    assert events["time_hi"].tolist() == [time.upper for time in exact]
    assert np.all(events["time_hi"] - events["time_lo"] <= 2.0**-48)


def test_a_run_begins_where_it_is_told():
    positions, velocities = uniform(40, 6)
    start = Fraction(1, 4)
    kd = kinetri.KineticDelaunay(positions, velocities, start=start)
    assert kd.time == start and np.array_equal(kd.positions(), positions)
    other = kinetri.KineticDelaunay(positions, velocities)
    events, expected = kd.record(until=2.25), other.record(until=2)
    assert np.array_equal(events["removed"], expected["removed"]) and len(events) > 10
    assert np.allclose(events["time"], expected["time"] + 0.25, rtol=0, atol=1e-12)
