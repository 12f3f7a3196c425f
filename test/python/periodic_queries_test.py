# SPDX-License-Identifier: GPL-3.0-or-later
"""Queries and areas of cells in periodic boxes: compared with all images of the points, in integers and fractions."""
import itertools
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest
from periodic_support import BOXES, cross, edges_of, exact, image, integers, minus, named, nearest_copy, triangulation

import kinetri


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
