# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases that are about one certificate's roots, and about times."""
from case import RING, Case, at, kite, lattice, moved, resting

DOUBLE = at(1, [(0, 1, 0, 0), (0, -1, 0, 0), (-1, 0, 0, 0), (1, 0, 0, 1)])
TRIPLE = at(1, [(-1, 0, 0, -1), (0, -1, 1, 0), (1, 0, 0, 0), (0, 1, 0, 0)])
QUADRUPLE = at(1, [(0, 0, -1, 0), (2, 0, 0, -3), (2, 2, 3, -1), (0, 2, 0, 0)])
# Three points whose orientation is a square: (0, 0), (1, s), (2 + s, 2 s) at s = (t - 1) / 4.
LINE = at(1, [(0, 0, 0, 0), (1, 0, 0, 0.25), (2, 0, 0.25, 0.5)])


def cases():
    return multiplicities() + vanishing() + degrees() + times() + magnitudes()


def multiplicities():
    return [
        Case("touch_double_root", "A point touches the circle of three others at t = 1 and stays outside.",
             ["The in-circle polynomial is a multiple of (t - 1)^2: no event."], DOUBLE, 2, 0),
        Case("touch_irrational_double_root", "Four points are cocircular at t = sqrt 2 for an instant.",
             ["The in-circle polynomial is -2 (t^2 - 2)^2. A double root that is rational would come",
              "out of the derivative; this one does only out of the square-free part."],
             [(1, -1, 1, 1), (3, -1, -2, 0), (3, 1, -1, 0), (0, 0, 0, 0)]),
        Case("touch_quadruple_root", "Four points are cocircular at t = 1: a root of multiplicity four.",
             ["The in-circle polynomial is 30 (t - 1)^4: it does not change its sign."], QUADRUPLE),
        Case("flip_at_triple_root", "One flip at t = 1, a root of multiplicity three.",
             ["The in-circle polynomial is a multiple of (t - 1)^3. Divided by t - 1 once, as a flip",
              "may do to find the next root, it vanishes at t = 1 still."], TRIPLE),
        Case("quadruple_root_in_one_place", "Four points meet in one place at t = 1, going apart again.",
             ["All certificates vanish there together: in-circle with multiplicity four, orientation",
              "with two."], at(1, [(0, 0, 2, 1), (0, 0, -1, 3), (0, 0, -2, -1), (0, 0, 1, -2)])),
        Case("hull_touch_from_inside", "An inner point touches a hull edge at t = 1 and goes back.",
             ["Orientation is a multiple of (t - 1)^2; a triangle is flat for an instant and does not",
              "turn over: no event."], LINE + resting([(1, 5)]), 1.5, 0),
        Case("hull_touch_from_outside", "A hull vertex lies between its neighbors at t = 1, then out again.",
             ["It is on their line for an instant and never inside: no event."],
             LINE + resting([(1, -5)]), 1.5, 0),
        Case("touches_and_flips_together", "Roots of multiplicities 1, 2, 3 and 4 and hull touches, all at t = 1.",
             ["The flips are to be done and the touches are to be left, in one batch."],
             DOUBLE + moved(TRIPLE, 64, 3) + moved(QUADRUPLE, 31, 50) + moved(LINE, 20, -40) +
             moved(kite(2, 1), -40, 12)),
        Case("two_simple_roots_at_one_flip", "A flip whose new certificate fails again a little later.",
             ["A point crosses a circle near its rim: in at t = 1 - 2^-20, out at t = 1 + 2^-20. The",
              "root at hand is to be skipped, and the next one not."],
             resting([(-1, 1), (1, 1), (0, 2)]) + at(1, [(0, (2.0**-41), 1, 0)]), 3),
    ]


def vanishing():
    ring = [(x, y, 1, 2) for x, y in RING]
    return [
        Case("translated_lattice", "A lattice that moves as a whole.",
             ["Every in-circle certificate inside is identically zero, and so is every one of the hull."],
             lattice(6, 6, lambda x, y: (3, -2)), 10, 0),
        Case("translated_ring", "Twelve cocircular points that move as a whole.",
             ["The in-circle determinant of every diagonal is identically zero: the infinitely small terms",
              "of the lifting choose, always alike."], ring, 10, 0),
        Case("growing_ring", "Twelve points that move away from the center of their circle.",
             ["Always cocircular, with different velocities."],
             [(x, y, x, y) for x, y in RING], 10, 0),
        Case("turning_ring", "Eight points that move along the tangents of their circle.",
             ["They look as if they rotated, and stay cocircular on a circle that grows. The diagonals",
              "depend on the axes, from which the points turn away."],
             [(x, y, -y, x) for x, y in RING[:8]], 10, 6),
        Case("turning_square_is_left", "A point leaves a turning square just before its diagonals change.",
             ["The diagonals change at t = 1/3, and the point passes the circle some 2^-57 before. Then a",
              "diagonal that is wrong already is flipped: its polynomial has its root ahead, in the same",
              "interval of binary64 numbers."],
             [(1, 3, -3, 1), (-3, 1, -1, -3), (-1, -3, 3, -1), (3, -1, 1, 3), (2, 2, 2.0**-55, 2)], 0.5),
        Case("turning_ring_with_centre", "Six points of a circle that move along tangents, and its center.",
             ["The orientation of opposite points and the center is identically zero."],
             [(x, y, -y, x) for x, y in RING[::2]] + resting([(0, 0)]), 10),
        Case("ring_through_one_place", "Eight cocircular points that meet in the center at t = 1.",
             ["All certificates are identically zero, and at t = 1 the circle is a point. Then each point",
              "is opposite to where it was."], [(x, y, -x, -y) for x, y in RING[:8]]),
        Case("dilated_lattice", "A lattice that grows from its corner.",
             ["Squares stay squares: always cocircular."], lattice(4, 4, lambda x, y: (x, y)), 10, 0),
    ]


def degrees():
    speeds = [(5, 0), (3, 4), (-4, 3), (-5, 0), (0, -5), (4, -3), (-3, -4), (0, 5)]
    places = [(0, 0), (7, 1), (12, 9), (20, 4), (3, 14), (9, -5), (15, 12), (5, 5)]
    unit = [(0, 0), (1, 0), (0, 1), (1, 1), (1, 0), (0, 1), (1, 1), (0, 0)]
    small = [(0, 0), (2, 0), (4, 0), (0, 2), (4, 2), (1, 4), (3, 4)]
    return [
        Case("equal_speeds", "Eight points with one speed.",
             ["The velocities are cocircular, so the term of t^4 of every in-circle certificate is",
              "exactly zero."], [(*p, *v) for p, v in zip(places, speeds)]),
        Case("lattice_velocities", "Eight points whose velocities are the corners of a square.",
             ["Degree 3 or less, and less still where velocities are equal."],
             [(*p, *v) for p, v in zip(places, unit)]),
        Case("one_mover", "One point moves through seven that rest, in a symmetric place.",
             ["In-circle certificates have degree 2, orientation 1; it crosses the edges of its",
              "neighbors and the lines of others at the same times."],
             resting(small) + [(2, -3, 0, 1)]),
        Case("one_mover_through_lattice", "A point moves along the diagonal of a lattice.",
             ["It passes through points that rest, one at each whole time, and is cocircular with",
              "four of them half way between."], lattice(7, 7) + [(-1, -1, 1, 1)], 8),
        Case("one_mover_between_columns", "A point moves up between two columns of a lattice.",
             ["Cocircular with whole cells, and always on a line of symmetry."],
             lattice(6, 6) + [(2.5, -1, 0, 1)], 8),
    ]


def times():
    diamonds = [p for i in range(4) for j in range(4)
                for p in moved(kite(2 + j, 1 + j), 10 * i, 13 * j)]
    # Circles of power 2 k m through (-w, 0) and (w, 0) with heights k t and m t: w^2 = 2 k m.
    roots = [((1, 2), 2), ((2, 1), 2), ((1, 8), 4), ((8, 1), 4), ((4, 2), 4), ((2, 4), 4)]
    sides = [moved([(-w, 0, 0, 0), (0, 0, 0, -k), (w, 0, 0, 0), (0, 0, 0, m)], 40 * i, 0)
             for i, ((k, m), w) in enumerate(roots)]
    return [
        Case("many_flips_at_once", "Sixteen kites that all flip at t = 1.",
             ["They fall at different speeds, so their certificates are different polynomials with",
              "one root in common."], diamonds, 2),
        Case("many_flips_at_irrational_time", "Six kites that all flip at t = sqrt 2.",
             ["No binary64 number tells that the times are equal; their polynomials do."],
             [p for side in sides for p in side], 3),
        Case("events_at_start_and_end", "A flip exactly at the start and one exactly at the end.",
             ["The first has happened before anything is reported, the second is to be reported."],
             kite(1, 0.25) + moved(kite(3, 1), 10, 0), 2),
        Case("hull_events_at_start_and_end", "Points on hull edges exactly at the start and at the end.",
             ["At t = 0 one leaves the hull and one comes out of it; at t = 2 the same on other sides."],
             resting([(0, 0), (12, 0), (12, 12), (0, 12)]) +
             [(5, 0, 0, 1), (5, 12, 0, 1), (-2, 5, 1, 0), (10, 7, 1, 0)], 2),
        Case("start_in_one_place", "Seven points in one place at the start.",
             ["They go apart in different directions, two of them in the same one."],
             [(1, 1, *v) for v in [(1, 0), (2, 0), (-1, 1), (0, -2), (-1, -1), (1, 2), (0, 0)]]),
        Case("start_on_a_line", "Seven points on a line at the start.",
             ["The triangulation just after the start has triangles, that of the start has none."],
             [(i, 2 * i, 0, v) for i, v in enumerate([0, 2, -1, 1, -2, 3, 0])]),
        Case("start_as_lattice", "A lattice at the start, in which every point moves in its own way.",
             ["Everything that is cocircular or collinear at t = 0 is decided by derivatives."],
             lattice(4, 2, lambda x, y: ((3 * x + 5 * y) % 5 - 2, (2 * x + y * y) % 3 - 1))),
    ]


def magnitudes():
    tiny, huge, nano = 2.0**-200, 2.0**-400, 1e9
    low = 5e-324
    corner = [(-1, 0), (1, 1), (2, -1), (0, 0)]
    circle = resting([(-1, 1), (1, 1), (0, 2)])
    return [
        Case("magnitudes_together", "Coordinates of 1e-100 and of 1e100 in one file.",
             ["Two kites that flip at t = 1 (up to the rounding of the decimal numbers), one within",
              "the other's rounding error; sums of these numbers need 660 bits."],
             [tuple(c * 1e-100 for c in p) for p in kite(2, 1)] +
             [tuple(c * 1e100 for c in p) for p in kite(3, 2)]),
        Case("magnitudes_of_speeds", "Points of 1e100 that move at 1e-100, and the other way round.",
             ["Events at 1e-200, at 1 and at 1e200."],
             [(x * 1e100, y * 1e100, y * 1e-100, -2 * x * 1e-100) for x, y in corner] +
             [(x * 1e-100, y * 1e-100 + 1e-101, -y * 1e100, x * 1e100) for x, y in corner]),
        Case("times_near_1e-300", "Events at times near 1e-300.",
             ["What a step of time of fixed size, however small, would miss."],
             [(x, y, vx * 1e300, vy * 1e300) for x, y, vx, vy in kite(3, 2)] +
             [(x + 10, y, vx * 1e300, vy * 3e299) for x, y, vx, vy in kite(2, 1)]),
        Case("times_near_1e300", "Events at times near 1e300.",
             ["Velocities of 1e-300 that do matter."],
             [(x, y, vx, vy * 1e-300) for x, y, vx, vy in kite(3, 2) + moved(kite(2, 1), 10, 0)]),
        Case("subnormal", "Seven points whose coordinates are the smallest numbers of binary64.",
             ["Every product of two coordinates underflows."],
             [(x * low, y * low, vx * low, vy * low)
              for x, y, vx, vy in kite(3, 1) + moved(kite(2, 1), 1, 3)[:3]]),
        Case("events_1e-18_apart", "Two flips 1e-18 apart.",
             ["At t = 1 + 1e-9 and at t = 1 + 1 / (1e9 - 1): the same binary64 number."],
             kite(2 + nano, nano) + moved(kite(1 + nano, nano - 1), 8, 0)),
        Case("events_2^-200_apart", "Two points come to a hull edge each, 2^-200 apart in time.",
             ["At t = 3 and at t = 3 - 2^-200: one line is as much higher than the other."],
             [(-1, 0, 0, 0), (1, 0, 0, 0), (0, 3, 0, -1), (0, 9, 0, 0),
              (20, tiny, 0, 0), (22, tiny, 0, 0), (21, 3, 0, -1)]),
        Case("events_2^-1074_apart", "Hull events that differ by the smallest number of binary64.",
             ["At t = 3 and at t = 3 - 2^-1074; any separating time has more than a thousand bits."],
             [(-1, 0, 0, 0), (1, 0, 0, 0), (0, 3, 0, -1), (0, 9, 0, 0),
              (20, low, 0, 0), (22, low, 0, 0), (21, 3, 0, -1)]),
        Case("near_touch_inside", "A point is inside a circle for 2^-198 units of time.",
             ["Two flips at t = 1 -+ 2^-199; with the point 2^-400 lower there would be none."],
             circle + at(1, [(0, huge, 1, 0)])),
        Case("near_touch_outside", "A point misses a circle by 2^-400.",
             ["The in-circle certificate has two complex roots next to the real axis."],
             circle + at(1, [(0, -huge, 1, 0)])),
        Case("near_miss", "Two points pass each other at a distance of 2^-1000.",
             ["Nearly a coincidence, and none: the edge between them turns about within no time."],
             at(1, [(0, 0, 1, 0), (0, 2.0**-1000, -1, 0)]) + resting([(-3, 2), (3, 2), (0, -3)])),
        Case("nearly_flat", "Seven points within some 2^-1074 of a line.",
             ["Triangles that are flat for every purpose but the exact one, and turn over at t = 1."],
             [(i, low * (h - v), 0, low * v) for i, (h, v) in
              enumerate([(0, 0), (1, 1), (0, -1), (-1, 2), (0, 1), (1, -2), (0, 0)])]),
    ]
