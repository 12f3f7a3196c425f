# SPDX-License-Identifier: GPL-3.0-or-later
"""Sturm sequences: how many roots a certificate has, where, and which of them are events."""
import math
from fractions import Fraction

import kinetri


def row(sequence, t):
    """The signs of the terms at t, and V, the number of their changes."""
    signs = " ".join("-0+"[sign + 1] for sign in sequence.signs(t))
    return f"{t!s:>4}: {signs}   V = {sequence.sign_changes(t)}"


def counts():
    """t^4 - 10 t^2 + 1 has four irrational roots. Coefficients are by ascending power."""
    sequence = kinetri.sturm_sequence([1, 0, -10, 0, 1])
    print(*sequence.terms)
    for t in (-math.inf, 0, 1, 4, math.inf):
        print(row(sequence, t))
    print("in (0, 1]:", sequence.count(0, 1), "  above 1:", sequence.count(lower=1))
    third = kinetri.sturm_sequence([Fraction(-1, 3), 1])
    print("third:", third.count(0, Fraction(1, 3)), third.count(0, Fraction(1, 3), closed="left"))


def touch_and_flip():
    """The edge between the first two points: a touch at 1, a flip at 2."""
    kd = kinetri.KineticDelaunay([[0, 1], [0, -1], [1.5, 0], [-0.5, 1]],
                                 [[0, 0], [0, 0], [-0.5, 0], [-0.5, -1]])
    certificate = kinetri.sturm_sequence([2, -5, 4, -1])
    for t in (0, 1, 1.5, 2):
        print(row(certificate, t))
    print("roots:", [(float(root.value), root.multiplicity) for root in certificate.roots()])
    print("events:", [(event.kind, float(event.time)) for event in kd.events(until=2.5)])
    print("last term:", certificate.terms[-1])


def always_cocircular():
    """A square that grows: the certificate is zero at all times."""
    square = [[0, 1], [0, -1], [1, 0], [-1, 0]]
    print("events:", len(kinetri.KineticDelaunay(square, square).record(until=9)))
    try:
        kinetri.sturm_sequence([0, 0, 0])
    except kinetri.PreconditionError as error:
        print(error)


def triple_root():
    """A root of multiplicity 3 is an event: the certificate changes its sign."""
    kd = kinetri.KineticDelaunay([[1, 1], [0, -1], [1, -1], [-1, 0]],
                                 [[-1, 0], [0, 0], [0, 1], [0, 0]])
    certificate = kinetri.sturm_sequence([2, -6, 6, -2])
    print("roots:", [(float(root.value), root.multiplicity) for root in certificate.roots()])
    print("events:", [(event.kind, float(event.time)) for event in kd.events(until=2.5)])


counts()
touch_and_flip()
always_cocircular()
triple_root()
