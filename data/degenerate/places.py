# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases that are about where many points are together: lattices, lines, meetings, hulls."""
from case import RING, Case, at, kite, lattice, moved, resting


def cases():
    return lattices() + polygons() + lines() + meetings() + dimensions() + hulls()


def mixed(x, y):
    """A lattice velocity for each place, none of them more frequent than others."""
    return ((7 * x + 3 * y + x * y) % 3 - 1, (5 * x + 2 * y + x * x) % 3 - 1)


def lattices():
    return [
        Case("lattice_row_along", "One row of a lattice moves along itself by three spacings.",
             ["Whole rows of cells become cocircular together, last at exactly the end."],
             lattice(10, 10, lambda x, y: (1, 0) if y == 5 else (0, 0)), 3),
        Case("lattice_row_across", "One row of a lattice moves through the rows above.",
             ["Eight pairs of points meet at each whole time, while their rows become one."],
             lattice(8, 6, lambda x, y: (0, 1) if y == 2 else (0, 0)), 4.5),
        Case("lattice_hull_row", "The lowest row of a lattice moves up and through it.",
             ["Its points leave the hull together and come out of it on the other side."],
             lattice(5, 4, lambda x, y: (0, 1) if y == 0 else (0, 0)), 5),
        Case("lattice_column_along", "One column of a lattice moves along itself.",
             ["It slides past its neighbors and comes out of the hull, still collinear."],
             lattice(6, 6, lambda x, y: (0, 1) if x == 2 else (0, 0)), 7.5),
        Case("lattice_half_slides", "The upper half of a lattice slides along the lower one.",
             ["All the cells of one row change together; all the others are identically zero."],
             lattice(7, 6, lambda x, y: (1, 0) if y >= 3 else (0, 0)), 3),
        Case("lattice_half_moves", "Every second point of a lattice moves by two spacings.",
             ["Half of all points meet the other half at t = 1."],
             lattice(6, 6, lambda x, y: (1, 0) if (x + y) % 2 else (0, 0)), 2),
        Case("lattice_all_move", "Every point of a lattice has its own lattice velocity.",
             ["Several clusters of several points meet at whole and half times."],
             lattice(6, 6, mixed), 2),
        Case("lattice_all_move_small", "Every point of a small lattice has its own lattice velocity.",
             ["As lattice_all_move, and small enough for the brute-force simulator."],
             lattice(4, 2, mixed)),
        Case("lattice_sheared", "A lattice that is sheared.",
             ["Rows stay rows; cells are cocircular again at every whole time, all of them at once."],
             lattice(6, 6, lambda x, y: (y, 0)), 2),
        Case("lattice_bowed", "A lattice whose bowed rows become straight at t = 1 and bow back.",
             ["All rows become collinear with the hull at once; inner rows are flat, without an",
              "event of the hull, at the same time."],
             at(1, lattice(6, 5, lambda x, y: (0, x * (5 - x) / 8))), 2),
        Case("lattice_bowed_small", "Two bowed rows that become straight at t = 1 and bow back.",
             ["Both sides of the hull are flat together; small enough for the brute-force simulator."],
             at(1, lattice(4, 2, lambda x, y: (0, x * (3 - x) / 8)))),
        Case("lattice_squeezed", "A lattice whose rows fall onto one line at t = 1.",
             ["Rectangles all the time, so all certificates of cells are identically zero. At t = 1 whole",
              "columns meet, everything is collinear, and the lattice comes out upside down."],
             lattice(4, 4, lambda x, y: (0, -y)), 2),
        Case("lattice_squeezed_small", "Two rows of four that fall onto one line at t = 1.",
             ["As lattice_squeezed, and small enough for the brute-force simulator."],
             lattice(4, 2, lambda x, y: (0, -y))),
    ]


def polygons():
    outer = [(x, y, -y, x) for x, y in RING[::3]]
    inner = [(x, y, -2 * y, 2 * x) for x, y in [(3, 3), (-3, 3), (-3, -3), (3, -3)]]
    turned = [(3, 0), (0, 3), (-3, 0), (0, -3)]
    return [
        Case("turning_squares", "Two squares turn at different speeds, all cocircular at one instant.",
             ["The inner one grows faster. Two circles become one at t = sqrt(7/47), for all eight",
              "points together, and a vertex of each leaves and enters the hull."], outer + inner),
        Case("turning_octagon_touch", "Points of a circle that move along tangents at different speeds.",
             ["At t = 1 all eight are cocircular, and every in-circle certificate has a double root: the",
              "distances from the center are of second order. Nothing happens then."],
             at(1, [(x, y, -y * w, x * w) for (x, y), w in
                    zip(RING[:8], [1, 0.5, -0.25, 2, 1, -1, 0.5, 0.25])])),
        Case("octagon_through_circle", "Eight points that go through one circle at t = 1, turning.",
             ["Some go in and some go out: all are cocircular together, and many edges flip at once."],
             at(1, [(x, y, x * u - y, y * u + x) for (x, y), u in
                    zip(RING[:8], [0.5, -0.5, 0.25, -1, 0.5, 0, -0.25, 1])])),
        Case("rings_pass_through", "Two concentric squares: one shrinks through the other one.",
             ["They are collinear side by side, then cocircular, then meet in one place."],
             [(x, y, 0, 0) for x, y in turned] + [(2 * x, 2 * y, -x, -y) for x, y in turned]),
    ]


def lines():
    speeds = [0, 3, -1, 2, -2, 1, -3]
    chain = [(i, 2 * i + 1, v, 2 * v) for i, v in enumerate(speeds)]
    level = [(2 * i, 0, v, 0) for i, v in enumerate([1, 0, -1, 2, -2, 0])]
    return [
        Case("chain", "Seven points that stay on one line and pass through one another.",
             ["Never two-dimensional; three pass at once at some times."], chain),
        Case("chain_upright", "Six points on a vertical line that pass through one another.",
             ["As chain; order by x does not tell them apart."],
             [(4, i, 0, v) for i, v in enumerate([1, -1, 2, -2, 0, -1])]),
        Case("chain_through_one_place", "Five points on a line that all meet at t = 1.",
             ["Their order is reversed in one instant."],
             at(1, [(3, 6, v, 2 * v) for v in [-2, -1, 0, 1, 3]])),
        Case("chain_in_a_triangulation", "Six points that stay on a line, one point on each side.",
             ["Orientation is identically zero for most triples; they pass through one another."],
             level + resting([(3, 7), (5, -6)])),
        Case("chain_on_the_hull", "Six points that stay on a hull edge, passing one another.",
             ["Hull vertices that stay collinear and meet on the hull."], level + resting([(3, 7), (6, 9)])),
    ]


def meetings():
    frame = [(-4, -3), (5, -4), (4, 5), (-5, 4)]
    pairs = [(0, 0), (6, 1), (1, 7), (8, 9)]
    wind = [((1, 0), (-1, 1)), ((0, 2), (1, -1)), ((-1, -1), (2, 1)), ((0, 1), (0, -1))]
    star = [(1, 0), (-1, 2), (-2, -1), (0, -3)]
    return [
        Case("two_pass", "Two points pass through each other inside.",
             ["At t = 1 they are one point; nothing may depend on which one is in front."],
             resting(frame) + at(1, [(0, 0, 1, 1), (0, 0, -1, 2)])),
        Case("two_pass_head_on", "Two points pass through each other on one line.",
             ["The edge between them has length zero for an instant and its direction is reversed."],
             resting(frame) + at(1, [(0, 0, 2, 1), (0, 0, -2, -1)])),
        Case("three_meet", "Three points meet inside at t = 1.",
             ["Their triangle becomes a point and turns over or not."],
             resting(frame) + at(1, [(0, 0, *v) for v in star[:3]])),
        Case("four_meet", "Four points meet inside at t = 1.",
             ["The edges inside the cluster vanish together, with those to the others between them."],
             resting(frame) + at(1, [(0, 0, *v) for v in star])),
        Case("three_meet_in_line", "Three points of one moving line meet inside at t = 1.",
             ["The cluster is collinear just before and just after it is a point."],
             resting(frame) + at(1, [(0, 0, 1, 2), (0, 0, -1, -2), (0, 0, 2, 4)])),
        Case("cocircular_meet", "Four points that stay cocircular meet inside at t = 1.",
             ["The cluster's own certificate is identically zero."],
             resting(frame) + at(1, [(0, 0, x, y) for x, y in RING[::3]])),
        Case("two_meet_on_hull_edge", "Two points meet on a hull edge at t = 1, one from each side.",
             ["A flat hull triangle and a coincidence at one time; one enters the hull, one leaves."],
             resting([(-4, 0), (4, 0), (1, 6)]) + at(1, [(0, 0, 1, 1), (0, 0, 0, -1)])),
        Case("two_meet_at_hull_vertex", "Two points pass through a hull vertex at t = 1.",
             ["A vertex of the hull is three points for an instant."],
             resting([(0, 0), (6, 1), (2, 6), (-1, 5)]) + at(1, [(0, 0, 1, 1), (0, 0, -2, 1)])),
        Case("hull_vertex_is_hit", "A point comes from outside, through a hull vertex, to the inside.",
             ["The hull vertex leaves the hull, and enters it again, through one place."],
             resting([(0, 0), (6, 1), (2, 6), (-1, 5), (3, 3)]) + at(1, [(0, 0, 1, 1)])),
        Case("clusters_at_once", "Four pairs of points meet in four places at t = 1.",
             ["All points coincide with another one at the same time."],
             at(1, [(*p, *v) for p, both in zip(pairs, wind) for v in both])),
        Case("large_clusters_at_once", "Nine clusters of four points meet at t = 1.",
             ["On the hull and inside, in a lattice that has no other points."],
             at(1, [(8 * i, 8 * j, vx + j, vy - i) for i in range(3) for j in range(3)
                    for vx, vy in star])),
        Case("same_place_again", "Points meet in one place at t = 1, others there at t = 2, and at t = 3.",
             ["Nothing may be kept of a place that was resolved once."],
             at(1, [(0, 0, 1, 0), (0, 0, -1, 1)]) + at(2, [(0, 0, 0, 1), (0, 0, 2, -1)]) +
             at(3, [(0, 0, 1, 1), (0, 0, -1, -2)]) + resting([(0, 0), (9, 2)])),
        Case("same_points_meet_others", "One point meets another one at each whole time.",
             ["Each time with a different one, always at rest."],
             resting([(1, 0), (2, 0), (3, 0), (4, 0), (0, 3), (2, -3)]) + [(0, 0, 1, 0)]),
        Case("meeting_and_flips", "Two points meet, four flip and three touch, all at t = 1.",
             ["A coincidence settles everything at its time, also what is far away."],
             resting(frame) + at(1, [(0, 0, 1, 1), (0, 0, -1, 2)]) + moved(kite(2, 1), 20, 0) +
             moved(at(1, [(0, 1, 0, 0), (0, -1, 0, 0), (-1, 0, 0, 0), (1, 0, 0, 1)]), 0, 20)),
    ]


def dimensions():
    return [
        Case("flat_for_an_instant", "Seven points that are on a line at t = 1, and only then.",
             ["Two-dimensional, one-dimensional, two-dimensional again: every triangle turns over."],
             at(1, [(i, 0, 0, v) for i, v in enumerate([1, -2, 0, 3, -1, 2, 1])])),
        Case("flat_slanting", "Six points on a slanting line at t = 1 that move along it as well.",
             ["As flat_for_an_instant, with velocities that are not parallel."],
             at(1, [(i, 3 * i, vx, vy) for i, (vx, vy) in
                    enumerate([(1, 0), (0, 1), (-1, 2), (2, 2), (0, -3), (1, 3)])])),
        Case("flat_with_meetings", "Seven points on a line at t = 1, some of them in one place.",
             ["Both degenerate situations at one time."],
             at(1, [(x, 0, vx, vy) for x, vx, vy in
                    [(0, 1, 1), (0, -1, 2), (2, 0, -1), (3, 0, 1), (3, 1, 0), (3, -1, -1), (5, 0, 2)]])),
        Case("flat_touch", "Four points on a line at t = 1, turning back: no triangle turns over.",
             ["A double root of every orientation; the triangulation has no area for an instant."],
             at(1, [(0, 0, 0, 0), (1, 0, 0, 0.25), (2, 0, 0.25, 0.5), (4, 0, 1.5, 1)])),
        Case("flat_twice", "Seven points on a vertical line at t = 1 and on a level one at t = 2.",
             ["Squeezed in x, turned over, squeezed in y: orientations are multiples of (t - 1)(t - 2)."],
             [(-x, -2 * y, x, y) for x, y in [(0, 0), (1, 2), (2, -1), (3, 3), (-1, 1), (-2, -2), (4, 1)]]),
        Case("one_place", "Eight points that are all in one place at t = 1.",
             ["Zero-dimensional for an instant; each one goes on where the opposite one came from."],
             at(1, [(2, 3, *v) for v in [(1, 0), (0, 1), (-2, 1), (3, 2), (-1, -3), (2, -2), (0, 0), (4, 1)]])),
        Case("one_place_then_flat", "Six points in one place at t = 1, five of them on a moving line.",
             ["The collinear ones stay so; the sixth point makes all the triangles."],
             at(1, [(0, 0, v, 2 * v) for v in [-2, -1, 1, 2, 3]]) + at(1, [(0, 0, 1, 0)])),
    ]


def hulls():
    parabola = [(i, i * i / 4, 0, v) for i, v in
                enumerate([0, 0.125, -0.125, 0.25, 0, -0.25, 0.125, 0])]
    swapped = at(1, [(-1, 0, 0, -1), (1, 0, 0, 1)])
    corners = [(0, 0), (8, 0), (8, 8), (0, 8)]
    sides = [(4, 0, 0, -1), (8, 4, -1, 0), (4, 8, 0, 1), (0, 4, 1, 0)]
    return [
        Case("hull_of_all", "Eight points on a parabola, all of them hull vertices.",
             ["They move up and down: the hull's certificates are the ones that fail."], parabola),
        Case("hull_swap_on_one_edge", "One point leaves the hull and one enters it, through one edge at once.",
             ["At t = 1 both are on the edge, with its ends: four collinear hull points."],
             resting([(-3, 0), (3, 0), (0, 9)]) + swapped),
        Case("hull_swap_on_all_sides", "On each side of a square a point goes through the hull at t = 1.",
             ["Two go out and two come in, all at one time; the sides are flat together."],
             resting(corners) + at(1, sides)),
        Case("hull_row_bends", "A hull row of six becomes straight at t = 1, every point in its own way.",
             ["Some go out and some come in: which ones are on the hull after it is Graham's scan."],
             at(1, [(i, 0, 0, v) for i, v in enumerate([1, -1, 2, 0, -2, 1])]) +
             resting([(0, 9), (5, 7)])),
        Case("hull_large_row_bends", "Two hull rows of sixteen become straight at t = 1.",
             ["As hull_row_bends, on both sides, and with more levels of flat triangles."],
             at(1, [(i, 16 * j, 0, (i * i * 5 + 3 * j * i) % 11 - 5) for j in range(2) for i in range(16)])),
    ]
