# SPDX-License-Identifier: GPL-3.0-or-later
"""Sturm sequences against fractions: terms by division, counts of roots that are known; and wrong arguments."""
import copy
import itertools
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, strategies as st
from support import few

import kinetri

CLOSED = {"right": (False, True), "left": (True, False), "both": (True, True), "neither": (False, False)}
small = st.fractions(-4, 4, max_denominator=4)


def product(*factors):
    result = [Fraction(1)]
    for factor in factors:
        longer = [Fraction(0)] * (len(result) + len(factor) - 1)
        for (i, a), (j, b) in itertools.product(enumerate(result), enumerate(factor)):
            longer[i + j] += a * b
        result = longer
    return result


def remainder(a, b):
    a = list(a)
    while len(a) >= len(b):
        factor = a[-1] / b[-1]
        for k, c in enumerate(b):
            a[len(a) - len(b) + k] -= factor * c
        a.pop()
    return without_zeros(a)


def without_zeros(p):
    p = list(p)
    while p and p[-1] == 0:
        p.pop()
    return p


def euclid(p):
    """The Sturm sequence, by division of fractions."""
    terms = [without_zeros(map(Fraction, p))]
    following = without_zeros([k * c for k, c in enumerate(terms[0])][1:])
    while following:
        terms.append(following)
        following = [-c for c in remainder(terms[-2], following)]
    return terms


def value(p, t):
    return sum(c * Fraction(t)**k for k, c in enumerate(p))


def sign(x):
    return (x > 0) - (x < 0)


@few
@given(st.lists(st.one_of(st.integers(-9, 9), small, st.floats(-1e300, 1e300)), min_size=1, max_size=8)
       .filter(any))
def test_terms_are_those_of_euclid(coefficients):
    expected = euclid(coefficients)
    sequence = kinetri.sturm_sequence(coefficients)
    assert len(sequence.terms) == len(expected)
    for term, of_euclid in zip(sequence.terms, expected):
        assert all(type(c) is int for c in term) and math.gcd(*term) == 1
        ratio = term[-1] / of_euclid[-1]
        assert ratio > 0 and list(term) == [ratio * c for c in of_euclid]
    for t in (-2, Fraction(1, 3), 0.1, 10**40):
        assert sequence.signs(t) == tuple(sign(value(term, t)) for term in expected)
    assert sequence.signs(math.inf) == tuple(sign(term[-1]) for term in expected)
    assert sequence.signs(-math.inf) == tuple(sign(term[-1] * (-1)**(len(term) - 1)) for term in expected)


rational_roots = st.dictionaries(small, st.integers(1, 3), max_size=4)
#: Roots a + sqrt(c) and a - sqrt(c), by a and c.
pairs = st.dictionaries(st.integers(-2, 2), st.tuples(st.sampled_from([2, 3, 5]), st.integers(1, 2)), max_size=2)


def known(rational, irrational, factor):
    """A polynomial with these roots; those, each as a function that compares it with a number: -1, 0 or 1."""
    p = [Fraction(factor)]
    for root, multiplicity in rational.items():
        p = product(p, *[[-root, Fraction(1)]] * multiplicity)
    for a, (c, multiplicity) in irrational.items():
        p = product(p, *[[Fraction(a * a - c), Fraction(-2 * a), Fraction(1)]] * multiplicity)

    def beside(a, c, side):
        # side sqrt(c) against t - a
        return lambda t: (side if (t - a) * side <= 0 else sign(side * (c - (t - a)**2)))

    roots = [(lambda t, root=root: sign(root - t), m) for root, m in rational.items()]
    roots += [(beside(a, c, side), m) for a, (c, m) in irrational.items() for side in (-1, 1)]
    return p, roots


@few
@given(rational_roots, pairs, st.sampled_from([1, -1, Fraction(-7, 3)]), small, small)
def test_counts_are_those_of_known_roots(rational, irrational, factor, a, b):
    p, roots = known(rational, irrational, factor)
    sequence = kinetri.sturm_sequence(p)
    ends = [min(a, b), max(a, b), *rational]
    for (lower, upper), (closed, (low, high)) in itertools.product(
            itertools.product([None, *ends], [None, *ends]), CLOSED.items()):
        if None not in (lower, upper) and lower > upper:
            continue
        inside = [root for root, _ in roots
                  if (lower is None or root(lower) > (-1 if low else 0))
                  and (upper is None or root(upper) < (1 if high else 0))]
        assert sequence.count(lower, upper, closed=closed) == len(inside), (p, lower, upper, closed)
    for t in ends:
        assert sequence.count(upper=t) == (
            sequence.sign_changes(-math.inf) - sequence.sign_changes(t))
    found = sequence.roots()
    assert [root.value for root in found] == sorted(root.value for root in found)
    assert len(found) == len(roots) and sum(m for _, m in found) == sum(m for _, m in roots)
    for root in found:
        assert root.multiplicity == next(m for compare, m in roots if same(root.value, compare))
        if root.value.fraction is not None:
            assert root.multiplicity == rational[root.value.fraction]


def same(time, compare):
    """Whether the time is the root: no number that is tried is between them."""
    trials = [time.lower, time.upper] if time.fraction is None else [time.fraction]
    return all(compare(Fraction(t)) == (time > t) - (time < t) for t in trials)


def test_an_end_may_be_irrational():
    # Roots: -sqrt 2, sqrt 2 (both double), 3/2, and two that are nearer to sqrt 2 than doubles are.
    near = Fraction(math.isqrt(2 * 10**80), 10**40)
    p = product([-2, 0, 1], [-2, 0, 1], [Fraction(-3, 2), 1], [-near, 1], [-near - Fraction(1, 10**40), 1])
    sequence = kinetri.sturm_sequence(p)
    roots = sequence.roots()
    assert [m for _, m in roots] == [2, 1, 2, 1, 1]
    times = [root.value for root in roots]
    assert times[0] < -1 < times[1] < times[2] < times[3] < times[4] == 1.5
    for (i, lower), (j, upper) in itertools.combinations_with_replacement(enumerate(times), 2):
        for closed, (low, high) in CLOSED.items():
            expected = j - i + 1 - (not low) - (not high) if i < j else int(low and high)
            assert sequence.count(lower, upper, closed=closed) == expected
    for i, time in enumerate(times):
        assert sequence.count(upper=time) == i + 1 and sequence.count(time) == 4 - i
        assert sequence.sign_changes(time) == 5 - (i + 1)
        assert sequence.signs(time)[0] == 0
    # Ends that are no roots of it, and as near to one another.
    other = kinetri.sturm_sequence([-1, 0, 7])
    assert [other.count(a, b) for a, b in itertools.pairwise(times[:4])] == [2, 0, 0]
    assert other.signs(times[2]) == (1, 1, 1) and other.sign_changes(times[2]) == 0


def test_the_singular_cases_of_certificates():
    touch = kinetri.sturm_sequence([4, -4, 1])
    assert touch.terms == ((4, -4, 1), (-2, 1)) and touch.roots() == [(2, 2)]
    assert touch.signs(2) == (0, 0) and touch.sign_changes(2) == 0 and touch.sign_changes(1.5) == 1
    triple = kinetri.sturm_sequence([1, -3, 3, -1])
    assert triple.terms == ((1, -3, 3, -1), (-1, 2, -1)) and triple.roots() == [(1, 3)]
    with pytest.raises(kinetri.PreconditionError, match="every number is a root of the zero polynomial"):
        kinetri.sturm_sequence([0, 0.0, Fraction(0)])
    constant = kinetri.sturm_sequence([-5, 0])
    assert constant.terms == ((-1,),) and constant.roots() == [] and constant.count() == 0


@pytest.mark.parametrize("coefficients", [
    np.array([-2, 0, 1]), np.array([-2.0, 0, 1]), np.array([-2, 0, 1], dtype=np.float32), (-2, 0, 1),
    [Fraction(-2), 0.0, np.int64(1)], (c for c in (-2, 0, 1)), range(-2, 0)])
def test_coefficients_of_every_kind(coefficients):
    sequence = kinetri.sturm_sequence(coefficients)
    assert sequence == kinetri.sturm_sequence([-2, -1] if isinstance(coefficients, range) else [-4, 0, 2])


def test_floats_are_taken_exactly():
    tenth = kinetri.sturm_sequence([-0.1, 1])
    assert tenth.count(upper=0.1) == 1 and tenth.count(upper=Fraction(1, 10)) == 0
    assert tenth.roots()[0].value.fraction == Fraction(0.1)
    assert kinetri.sturm_sequence([5e-324, 1.7e308]).roots()[0].value == -Fraction(5e-324) / Fraction(1.7e308)


def test_it_is_a_value():
    sequence = kinetri.sturm_sequence([Fraction(-1, 2), 0, 1])
    assert repr(sequence) == "sturm_sequence([-1, 0, 2])"
    assert eval(repr(sequence), {"sturm_sequence": kinetri.sturm_sequence}) == sequence
    assert sequence != kinetri.sturm_sequence([1, 0, -2]) and sequence != [-1, 0, 2]
    for copied in (pickle.loads(pickle.dumps(sequence)), copy.copy(sequence), copy.deepcopy(sequence)):
        assert copied == sequence and hash(copied) == hash(sequence) and copied.terms == sequence.terms


@pytest.mark.parametrize("coefficients, message", [
    ([], "there are no coefficients; expected numbers by ascending power"),
    (3, "coefficients are 3; expected numbers by ascending power"),
    (None, "coefficients are None; expected"),
    (np.array(3.0), r"coefficients are array\(3\.\); expected"),
    ("123", "coefficients are '123'; expected"),
    ({1, 2}, "coefficients are {1, 2}; expected"),
    ({1: 2}, "coefficients are {1: 2}; expected"),
    ([1, math.nan], r"coefficients\[1\] is nan; expected a finite number"),
    ([1, 2, -math.inf], r"coefficients\[2\] is -inf; expected a finite number"),
    ([np.float32("nan")], r"coefficients\[0\] is .*nan.*; expected a finite number"),
    ([1, "2"], r"coefficients\[1\] is '2'; expected an int, a float or a fractions.Fraction"),
    ([1, None], r"coefficients\[1\] is None; expected an int"),
    ([1j], r"coefficients\[0\] is 1j; expected an int"),
    ([[1, 2]], r"coefficients\[0\] is \[1, 2\]; expected an int"),
    ([kinetri.Time(1)], r"coefficients\[0\] is Time\(1.0\); expected an int"),
    (np.zeros(4), "coefficients are all 0; expected a polynomial that is not zero"),
])
def test_wrong_coefficients(coefficients, message):
    with pytest.raises(kinetri.PreconditionError, match=f"^{message}"):
        kinetri.sturm_sequence(coefficients)


def test_infinite_ends_are_no_ends():
    sequence = kinetri.sturm_sequence([-2, 0, 1])
    infinity = math.inf
    assert sequence.count(-infinity, infinity, closed="both") == sequence.count(None, None) == 2
    assert sequence.count(-infinity, 0) == sequence.count(upper=0) == 1
    assert sequence.count(0, np.float32("inf")) == 1
    assert sequence.count(infinity, infinity, closed="both") == 0
    with pytest.raises(kinetri.PreconditionError, match="lower is inf and upper is 0; expected lower <= upper"):
        sequence.count(infinity, 0)
    with pytest.raises(kinetri.PreconditionError, match="lower is 0 and upper is -inf"):
        sequence.count(0, -infinity)


def test_wrong_intervals():
    sequence = kinetri.sturm_sequence([-2, 0, 1])
    with pytest.raises(kinetri.PreconditionError, match="^lower is 3 and upper is 1; expected lower <= upper"):
        sequence.count(3, 1)
    for call, name in ((lambda t: sequence.count(t, 1), "lower"), (lambda t: sequence.count(0, t), "upper"),
                       (sequence.signs, "t"), (sequence.sign_changes, "t")):
        for wrong in (math.nan, "1", [0], 1j):
            with pytest.raises(kinetri.PreconditionError, match=f"^{name} is .*; expected a float, an int"):
                call(wrong)
    for wrong in ("open", None, True, ["right"]):
        with pytest.raises(kinetri.PreconditionError, match="; expected one of 'right', 'left', 'both', 'neither'"):
            sequence.count(0, 1, closed=wrong)
    with pytest.raises(TypeError):
        sequence.count(0, 1, "right")


def test_events_are_its_roots():
    # The edge between the first two points: the certificate of lesson 16 of the guide.
    kd = kinetri.KineticDelaunay([[0, 1], [0, -1], [1.5, 0], [-0.5, 1]], [[0, 0], [0, 0], [-0.5, 0], [-0.5, -1]])
    event = next(kd.events())
    sequence = kinetri.sturm_sequence([2, -5, 4, -1])
    assert sequence.roots() == [(1, 2), (event.time, 1)]
    assert sequence.count(0, event.time) == 2 and sequence.count(0, event.time, closed="left") == 1
