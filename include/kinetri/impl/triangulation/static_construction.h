// SPDX-License-Identifier: GPL-3.0-or-later
//
// The construction of the triangulation at a time.
#ifndef KINETRI_IMPL_TRIANGULATION_STATIC_CONSTRUCTION_H
#define KINETRI_IMPL_TRIANGULATION_STATIC_CONSTRUCTION_H

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/kinetic/rounded_places.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/insertion_order.h"
#include "kinetri/impl/triangulation/static_delaunay.h"
#include "kinetri/impl/triangulation/topology.h"
#include "kinetri/impl/triangulation/torus_triangulation.h"

namespace kinetri::detail {

/// Builds triangulations of points at one instant.
template <class Traits>
class Kinetic_types<Traits>::Static_construction {
 public:
  /// The triangulation at the instant of `now`, which is just after `time`. If points have the same
  /// trajectory (and weight), appends some pairs of them to `coincident`, at least one; then the
  /// result has no use. Expected O(n log n).
  static Triangulation build(std::span<const Point_2> points, const Time& time,
                             const Instantaneous_traits& now, std::vector<Edge_ids>& coincident);

  /// Whether all triangles turn left, and the hull is convex, at the instant of the triangulation's
  /// traits, to which the positions are near.
  static bool is_embedded(const Triangulation& triangulation, const Rounded_places& places);

 private:
  static Triangulation build_in_plane(std::span<const Point_2> points, const Time& time,
                                      const Instantaneous_traits& now,
                                      std::vector<Edge_ids>& coincident);
  static void find_coincident(std::span<const Point_2> points, const Time& time,
                              std::vector<Edge_ids>& coincident);
  static void find_coincident_in_faces(const Triangulation& triangulation,
                                       std::vector<Edge_ids>& coincident);
  static void find_all_coincident(std::vector<const Point_2*> points,
                                  const Instantaneous_traits& traits,
                                  std::vector<Edge_ids>& coincident);
  static Triangulation build_regular(std::span<const Point_2> points,
                                     const Instantaneous_traits& traits,
                                     std::vector<Edge_ids>& coincident);
  static bool build_from_places(std::span<const Point_2> points, const Rounded_places& places,
                                Triangulation& result);
  static bool is_embedded_in_plane(const Triangulation& triangulation,
                                   const Rounded_places& places);
  static bool is_left_turn(const Triangulation& triangulation, const Rounded_places& places,
                           Vertex_handle a, Vertex_handle b, Vertex_handle c);
  static bool is_hull_convex(const Triangulation& triangulation, const Rounded_places& places);
  static bool flip_until_delaunay(Triangulation& triangulation, const Rounded_places& places);
};

template <class Traits>
auto Kinetic_types<Traits>::Static_construction::build(std::span<const Point_2> points,
                                                       const Time& time,
                                                       const Instantaneous_traits& now,
                                                       std::vector<Edge_ids>& coincident)
    -> Triangulation {
  if constexpr (is_periodic) {
    return triangulation_of_torus(points, time.to_double(), now, coincident);
  } else {
    return build_in_plane(points, time, now, coincident);
  }
}

// The triangulation at the instant of the traits, which is just after `time`. The triangulation of
// the rounded positions is nearly the same and fast to make: mostly a few flips repair it.
// Otherwise CGAL inserts the points.
template <class Traits>
auto Kinetic_types<Traits>::Static_construction::build_in_plane(std::span<const Point_2> points,
                                                                const Time& time,
                                                                const Instantaneous_traits& traits,
                                                                std::vector<Edge_ids>& coincident)
    -> Triangulation {
  Triangulation result(traits);
  if constexpr (HasRoundedPlace<Motion>) {
    constexpr std::size_t few = 16;  // for so few, insertion is as fast
    const Rounded_places places(points, time);
    if (points.size() >= few && places.are_finite()) {
      if (build_from_places(points, places, result)) {
        find_coincident_in_faces(result, coincident);
        return result;
      }
      result.clear();
      find_coincident(points, time, coincident);
      if (!coincident.empty()) return result;
    }
  }
  if constexpr (is_weighted) {
    if (!Kinetic_types<Traits>::Topology::have_equal_weights(points))
      return build_regular(points, traits, coincident);
  }
  const auto insert_all = [&](auto& triangulation) {
    std::vector<Point_2> in_order(points.begin(), points.end());
    sort_for_insertion(in_order, traits);
    // CGAL keeps one vertex for points at one position. Points that coincide just after a time
    // coincide at all times.
    const auto note = [&coincident](Vertex_handle v, const Point_2& point) {
      const Point_id kept = v->point().id();
      if (kept != point.id()) coincident.push_back(edge_ids(kept, point.id()));
    };
    insert_in_order(triangulation, in_order, std::identity(), note);
  };
  if constexpr (is_weighted) {
    result.as_delaunay(insert_all);
  } else {
    insert_all(result);
  }
  return result;
}

// Finds points with the same trajectory and weight among those that are certainly inside of faces:
// these are in one face.
template <class Traits>
void Kinetic_types<Traits>::Static_construction::find_coincident_in_faces(
    const Triangulation& triangulation, std::vector<Edge_ids>& coincident) {
  if constexpr (is_weighted) {
    if (triangulation.number_of_hidden_vertices() < 2) return;
    for (const Face_handle face : triangulation.finite_face_handles()) {
      std::vector<const Point_2*> inside;
      for (const Vertex_handle v : face->vertex_list()) inside.push_back(&v->point());
      find_all_coincident(std::move(inside), triangulation.geom_traits(), coincident);
    }
  }
}

// Appends pairs that connect all points with the same trajectory and weight. Points that coincide
// just after a time coincide at all times, and so are next to each other in the order by position.
template <class Traits>
void Kinetic_types<Traits>::Static_construction::find_all_coincident(
    std::vector<const Point_2*> points, const Instantaneous_traits& traits,
    std::vector<Edge_ids>& coincident) {
  const auto compare = traits.compare_xy_2_object();
  std::ranges::sort(points, [&](const Point_2* p, const Point_2* q) {
    const auto order = compare(*p, *q);
    return order == CGAL::SMALLER || (order == CGAL::EQUAL && p->id() < q->id());
  });
  std::vector<const Point_2*> here;  // at the present position, one for each weight
  for (const Point_2* const point : points) {
    if (!here.empty() && compare(*here.front(), *point) != CGAL::EQUAL) here.clear();
    const auto same = std::ranges::find_if(here, [&](const Point_2* other) {
      return same_trajectory(other->motion(), point->motion());
    });
    if (same == here.end()) {
      here.push_back(point);
    } else {
      coincident.push_back(edge_ids((*same)->id(), point->id()));
    }
  }
}

// Appends pairs of points with the same trajectory, mostly all that there are, but for some whose
// motions are represented differently: those next to each other in the order of rounded positions
// at two times.
template <class Traits>
void Kinetic_types<Traits>::Static_construction::find_coincident(
    std::span<const Point_2> points, const Time& time, std::vector<Edge_ids>& coincident) {
  struct Place {
    std::array<std::uint64_t, 4> key;  // bits, which are in order also if one is not a number
    const Point_2* point;
  };
  std::vector<Place> places;
  places.reserve(points.size());
  const double now = time.to_double();
  for (const Point_2& point : points) {
    const Vector_2 here = rounded_place(point.motion(), now);
    const Vector_2 later = rounded_place(point.motion(), now + 1);
    const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
    places.push_back({{bits(here.x), bits(here.y), bits(later.x), bits(later.y)}, &point});
  }
  std::ranges::sort(places, {}, [](const Place& p) { return std::pair(p.key, p.point->id()); });
  for (std::size_t k = 1; k < places.size(); ++k) {
    const Point_2& p = *places[k - 1].point;
    const Point_2& q = *places[k].point;
    if (places[k - 1].key == places[k].key && same_trajectory(p.motion(), q.motion())) {
      coincident.push_back(edge_ids(p.id(), q.id()));
    }
  }
}

// The regular triangulation at the instant of the traits. CGAL keeps one vertex for points with the
// same trajectory and weight if one of them is not hidden.
template <class Traits>
auto Kinetic_types<Traits>::Static_construction::build_regular(std::span<const Point_2> points,
                                                               const Instantaneous_traits& traits,
                                                               std::vector<Edge_ids>& coincident)
    -> Triangulation {
  Triangulation result(traits);
  if constexpr (is_weighted) {
    std::vector<Point_2> sorted(points.begin(), points.end());
    sort_for_insertion(sorted, traits);
    insert_in_order(result, sorted, std::identity(), [](Vertex_handle, const Point_2&) {});
    std::vector<const Point_2*> suspects;
    const bool are_all_there = result.tds().number_of_vertices() - 1 == points.size();
    if (are_all_there) {
      for (const Vertex_handle v : result.hidden_vertex_handles()) suspects.push_back(&v->point());
    } else {
      for (const Point_2& point : points) suspects.push_back(&point);
    }
    find_all_coincident(std::move(suspects), traits, coincident);
    KINETRI_ASSERT(are_all_there || !coincident.empty(), "every point has a vertex");
  }
  return result;
}

// Makes `result`, which is empty, the triangulation of the points at the instant of its traits,
// from that of their rounded positions. Returns false, and leaves `result` in any state, if the
// rounded positions have another hull or a triangle that turns over, or if too many of them are
// cocircular.
template <class Traits>
bool Kinetic_types<Traits>::Static_construction::build_from_places(std::span<const Point_2> points,
                                                                   const Rounded_places& places,
                                                                   Triangulation& result) {
  std::vector<Vector_2> in_order;
  std::vector<double> weights_in_order;
  in_order.reserve(points.size());
  for (const Point_2& point : points) {
    in_order.push_back(places[point.id()]);
    if (places.weights().empty()) continue;
    weights_in_order.push_back(places.weights()[point.id() - places.first()]);
    if (!std::isfinite(weights_in_order.back())) return false;
  }
  const Static_points rounded = {in_order, weights_in_order, places.error(),
                                 places.error_of_weights()};
  const Static_delaunay found = static_delaunay(rounded);
  if (found.faces.empty()) return false;
  auto& tds = result.tds();
  tds.faces().clear();
  tds.set_dimension(2);
  std::vector<Vertex_handle> vertices(points.size());
  for (const Point_id i : found.order) {
    vertices[i] = tds.create_vertex();
    vertices[i]->set_point(points[i]);
  }
  std::vector<Face_handle> faces;
  faces.reserve(found.faces.size());
  for (const auto& face : found.faces) {
    const auto vertex = [&](std::size_t i) {
      const Point_id id = face.vertices[i];
      return id == no_point ? result.infinite_vertex() : vertices[id];
    };
    faces.push_back(tds.create_face(vertex(0), vertex(1), vertex(2)));
    for (std::size_t i = 0; i < 3; ++i) vertex(i)->set_face(faces.back());
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [a, b, c] = found.faces[f].neighbors;
    faces[f]->set_neighbors(faces[a], faces[b], faces[c]);
  }
  if constexpr (is_weighted) {
    for (const auto& [point, face] : found.hidden) result.hide(vertices[point], faces[face]);
  }
  if (is_certainly_delaunay(found, rounded)) return is_hull_convex(result, places);
  if (!places.weights().empty()) return false;
  return is_embedded(result, places) && flip_until_delaunay(result, places);
}

// Then a triangulation whose faces form a sphere is embedded: the hull goes around once, so the
// angles at each inner vertex add up to 2 pi at most (Gauss and Bonnet), and no position is covered
// twice.
template <class Traits>
bool Kinetic_types<Traits>::Static_construction::is_embedded(const Triangulation& triangulation,
                                                             const Rounded_places& places) {
  if constexpr (is_periodic) {
    return std::ranges::all_of(triangulation.finite_face_handles(), [&](Face_handle face) {
      return triangulation.orientation(face) == CGAL::LEFT_TURN;
    });
  } else {
    return is_embedded_in_plane(triangulation, places);
  }
}

template <class Traits>
bool Kinetic_types<Traits>::Static_construction::is_embedded_in_plane(
    const Triangulation& triangulation, const Rounded_places& places) {
  return std::ranges::all_of(triangulation.finite_face_handles(),
                             [&](Face_handle face) {
                               return is_left_turn(triangulation, places, face->vertex(0),
                                                   face->vertex(1), face->vertex(2));
                             }) &&
         is_hull_convex(triangulation, places);
}

// Whether the points make a left turn at the instant of the triangulation's traits, to which the
// positions are near.
template <class Traits>
bool Kinetic_types<Traits>::Static_construction::is_left_turn(const Triangulation& triangulation,
                                                              const Rounded_places& places,
                                                              Vertex_handle a, Vertex_handle b,
                                                              Vertex_handle c) {
  const Sign known = places.orientation(a->point().id(), b->point().id(), c->point().id());
  if (known != CGAL::ZERO) return known == CGAL::POSITIVE;
  const auto orientation = triangulation.geom_traits().orientation_2_object();
  return orientation(a->point(), b->point(), c->point()) == CGAL::LEFT_TURN;
}

// Whether the hull makes a left turn at each vertex and goes around once.
template <class Traits>
bool Kinetic_types<Traits>::Static_construction::is_hull_convex(const Triangulation& triangulation,
                                                                const Rounded_places& places) {
  const Instantaneous_traits& now = triangulation.geom_traits();
  const auto is_less = [&](Vertex_handle v, Vertex_handle w) {
    const auto by_x = now.compare_x_2_object()(v->point(), w->point());
    return by_x == CGAL::SMALLER ||
           (by_x == CGAL::EQUAL &&
            now.compare_y_2_object()(v->point(), w->point()) == CGAL::SMALLER);
  };
  // Around the infinite vertex the hull vertices are clockwise.
  std::vector<Vertex_handle> hull;
  for_each_neighbor(triangulation, triangulation.infinite_vertex(),
                    [&](Vertex_handle v) { hull.push_back(v); });
  std::size_t least_vertices = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vertex_handle next = hull[k];
    const Vertex_handle here = hull[(k + 1) % hull.size()];
    const Vertex_handle previous = hull[(k + 2) % hull.size()];
    if (!is_left_turn(triangulation, places, previous, here, next)) return false;
    if (is_less(here, previous) && is_less(here, next)) ++least_vertices;
  }
  return least_vertices == 1;
}

// Flips edges until the triangulation, which is embedded, is Delaunay. [Lawson 1977] Returns false
// if there are more flips than faces: for cocircular points there may be n^2, and insertion by CGAL
// is faster.
template <class Traits>
bool Kinetic_types<Traits>::Static_construction::flip_until_delaunay(Triangulation& triangulation,
                                                                     const Rounded_places& places) {
  const auto exact_side = triangulation.geom_traits().side_of_oriented_circle_2_object();
  const auto side = [&](Face_handle face, const Point_2& s) {
    const Point_2& p = face->vertex(0)->point();
    const Point_2& q = face->vertex(1)->point();
    const Point_2& r = face->vertex(2)->point();
    const Sign known = places.side_of_oriented_circle(p.id(), q.id(), r.id(), s.id());
    return known != CGAL::ZERO ? known : exact_side(p, q, r, s);
  };
  std::size_t flips_left = triangulation.tds().number_of_faces();
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (const Face_handle face : triangulation.finite_face_handles()) {
      for (int i = 0; i < 3; ++i) {
        if (!Kinetic_types<Traits>::Topology::is_chosen_side(Edge(face, i))) continue;
        const Face_handle beyond = face->neighbor(i);
        if (triangulation.is_infinite(beyond)) continue;
        const Vertex_handle opposite = beyond->vertex(triangulation.tds().mirror_index(face, i));
        const auto where = side(face, opposite->point());
        if (where != CGAL::ON_POSITIVE_SIDE) continue;
        if (flips_left-- == 0) return false;
        triangulation.tds().flip(face, i);
        is_changed = true;
      }
    }
  }
  return true;
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_STATIC_CONSTRUCTION_H
