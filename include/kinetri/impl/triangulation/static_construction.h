// SPDX-License-Identifier: GPL-3.0-or-later
//
// The construction of the triangulation at a time.
#ifndef KINETRI_IMPL_TRIANGULATION_STATIC_CONSTRUCTION_H
#define KINETRI_IMPL_TRIANGULATION_STATIC_CONSTRUCTION_H

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/edge_changes.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/insertion_order.h"
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
  /// traits, which is at or just after `time`.
  static bool is_embedded(const Triangulation& triangulation, const Time& time);
  /// The same in the plane; is_left_turn(u, v, w) tells how vertices turn.
  template <class Is_left_turn>
  static bool is_embedded_in_plane(const Triangulation& triangulation,
                                   const Is_left_turn& is_left_turn);
  /// Whether the hull makes a left turn at each vertex and goes around once.
  template <class Is_left_turn>
  static bool is_hull_convex(const Triangulation& triangulation, const Is_left_turn& is_left_turn);

  /// Appends pairs that connect all points with the same trajectory and weight, at the instant of
  /// the traits.
  static void find_all_coincident(std::vector<const Point_2*> points,
                                  const Instantaneous_traits& traits,
                                  std::vector<Edge_ids>& coincident);

 private:
  static Triangulation build_in_plane(std::span<const Point_2> points, const Time& time,
                                      const Instantaneous_traits& now,
                                      std::vector<Edge_ids>& coincident);
  static Triangulation build_regular(std::span<const Point_2> points,
                                     const Instantaneous_traits& traits,
                                     std::vector<Edge_ids>& coincident);
};

/// What rounded positions make faster, in the plane. Defined in src/triangulation, in
/// rounded_construction.h and repair.h, for the library's own points and predicates.
template <class Traits>
struct From_places : Kinetic_types<Traits> {
  using typename Kinetic_types<Traits>::Change;
  using typename Kinetic_types<Traits>::Point_2;
  using typename Kinetic_types<Traits>::Time;
  using typename Kinetic_types<Traits>::Topology;
  using typename Kinetic_types<Traits>::Triangulation;

  /// Makes `result`, which is empty, the triangulation of the points at the instant of its traits,
  /// which is just after `time`. Appends pairs of points with the same trajectory (and weight) to
  /// `coincident`; if there are any, `result` may have no use. Returns false, and leaves `result`
  /// empty, if points must be inserted one by one.
  static bool build(std::span<const Point_2> points, const Time& time, Triangulation& result,
                    std::vector<Edge_ids>& coincident);
  /// As Static_construction::is_embedded.
  static bool is_embedded(const Triangulation& triangulation, const Time& time);
  /// As Repair::move.
  static bool move(Topology& topology, Change_notes<Edge_ids>& notes, const Time& time,
                   std::span<const Change> changes);
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
  if constexpr (has_library_geometry) {
    if (From_places<Geometry>::build(points, time, result, coincident)) return result;
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

// Points that coincide just after a time coincide at all times, and so are next to each other in
// the order by position.
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

// Then a triangulation whose faces form a sphere is embedded: the hull goes around once, so the
// angles at each inner vertex add up to 2 pi at most (Gauss and Bonnet), and no position is covered
// twice.
template <class Traits>
bool Kinetic_types<Traits>::Static_construction::is_embedded(const Triangulation& triangulation,
                                                             const Time& time) {
  if constexpr (is_periodic) {
    return std::ranges::all_of(triangulation.finite_face_handles(), [&](Face_handle face) {
      return triangulation.orientation(face) == CGAL::LEFT_TURN;
    });
  } else if constexpr (has_library_geometry) {
    return From_places<Geometry>::is_embedded(triangulation, time);
  } else {
    const auto turn = triangulation.geom_traits().orientation_2_object();
    return is_embedded_in_plane(
        triangulation, [&](Vertex_handle u, Vertex_handle v, Vertex_handle w) {
          return turn(u->point(), v->point(), w->point()) == CGAL::LEFT_TURN;
        });
  }
}

template <class Traits>
template <class Is_left_turn>
bool Kinetic_types<Traits>::Static_construction::is_embedded_in_plane(
    const Triangulation& triangulation, const Is_left_turn& is_left_turn) {
  return std::ranges::all_of(triangulation.finite_face_handles(),
                             [&](Face_handle face) {
                               return is_left_turn(face->vertex(0), face->vertex(1),
                                                   face->vertex(2));
                             }) &&
         is_hull_convex(triangulation, is_left_turn);
}

template <class Traits>
template <class Is_left_turn>
bool Kinetic_types<Traits>::Static_construction::is_hull_convex(const Triangulation& triangulation,
                                                                const Is_left_turn& is_left_turn) {
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
    if (!is_left_turn(previous, here, next)) return false;
    if (is_less(here, previous) && is_less(here, next)) ++least_vertices;
  }
  return least_vertices == 1;
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_STATIC_CONSTRUCTION_H
