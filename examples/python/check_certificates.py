# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks a file of kinetri's --certificates with fractions alone: python3 check_certificates.py FILE"""
import functools
import json
import sys
from fractions import Fraction

POINTS = {"flip": (4,), "hull_insert": (3,), "hull_remove": (3,), "hide": (3, 4), "reveal": (3, 4), "wall": (1,),
          "collision": (2,)}


def value(p, t):  # p by ascending power
    return functools.reduce(lambda sum_, c: sum_ * t + c, reversed(p), 0)


def derivative(p):
    return tuple(i * c for i, c in enumerate(p))[1:]


def divided(a, b):  # quotient and remainder
    quotient, a = [], list(a)
    while len(a) >= len(b):
        quotient.insert(0, a[-1] / b[-1])
        a = [c - (quotient[0] * b[i - len(a) + len(b)] if i >= len(a) - len(b) else 0) for i, c in enumerate(a[:-1])]
    return quotient, a[:max((i + 1 for i, c in enumerate(a) if c), default=0)]


@functools.lru_cache
def sturm(p):
    terms = [p, derivative(p)]
    while terms[-1]:
        rest = divided(terms[-2], terms[-1])[1]
        terms.append(tuple(-c / abs(rest[-1]) for c in rest))  # a positive factor: the same signs, of shorter numbers
    return terms[:-1]


def signs(terms, t):
    return [(v > 0) - (v < 0) for v in (value(term, t) for term in terms)]


def roots(p, lower, upper):  # the number of distinct ones in (lower, upper]; in [lower, lower] if both are equal
    if lower == upper:
        return int(value(p, lower) == 0)
    common = sturm(p)[-1]  # with the derivative
    simple = sturm(tuple(divided(p, common)[0]) if len(common) > 1 else p)
    rows = [[s for s in signs(simple, t) if s] for t in (lower, upper)]
    return sum(s != t for s, t in zip(rows[0], rows[0][1:])) - sum(s != t for s, t in zip(rows[1], rows[1][1:]))


def multiplicity(p, lower, upper):  # of the only root there
    assert roots(p, lower, upper) == 1, "an interval of a root has not one root"
    q = sturm(p)[-1]
    return 1 + (multiplicity(q, lower, upper) if len(q) > 1 and roots(q, lower, upper) else 0)


def check(row):
    if row["polynomial"] is None:
        at_once = row["kind"] == "flip" and row["reason"].endswith("which is this time")  # after a flip of the same time
        kinds = ("insert", "erase", "trajectory", "rebuild", "hide", "reveal", "collision")
        assert at_once or row["kind"] in kinds, "a polynomial is missing"
        assert row["reason"] and row.keys() == {"event", "kind", "points", "polynomial", "reason"}, "no reason"
        return
    points = list(zip(row["points"], map(tuple, row.get("offsets", [()] * len(row["points"])))))  # in a box, images
    assert len(set(points)) == len(row["points"]) in POINTS[row["kind"]], "points of another kind of event"
    p = tuple(Fraction(int(c)) for c in row["polynomial"])
    start, lower, upper, *touches = (int(m) * Fraction(2)**e for m, e in (
        row["from"], row["lower"], row["upper"], *(end for touch in row["touches"] for end in touch)))
    assert len(p) > 1 and p[-1] and row["signs"] == [signs(sturm(p), t) for t in (start, lower, upper)], "signs"
    assert sorted([start, *touches, lower, upper]) == [start, *touches, lower, upper], "numbers out of order"
    assert multiplicity(p, lower, upper) == row["multiplicity"], "the multiplicity"
    assert lower == upper or value(p, lower) and value(p, upper), "an end is a root"
    after = p
    for _ in range(row["multiplicity"] if lower == upper else 0):
        after = derivative(after)
    assert value(after, upper) < 0, "it is not negative after the event"
    if value(p, start) <= 0:  # it fails at the start time
        assert start == lower and not touches, "it has failed before"
        return
    assert row["multiplicity"] % 2 and roots(p, start, upper) == 1 + len(row["touches"]), "other roots before the event"
    for ends in zip(touches[::2], touches[1::2]):
        assert multiplicity(p, *ends) % 2 == 0, "a touch that is none"


def main():
    number, event = 0, None
    try:
        with open(sys.argv[1], encoding="ascii") as lines:
            for number, line in enumerate(lines, 1):
                row = json.loads(line)
                check(row)
                assert event in (None, row["event"] - 1), "an event is missing"
                event = row["event"]
    except (AssertionError, ArithmeticError, LookupError, TypeError, ValueError) as error:
        sys.exit(f"{sys.argv[1]}, line {number}: {error}")
    print(f"{number} certificates are right")


if __name__ == "__main__":
    main()
