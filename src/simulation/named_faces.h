// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges of a kinetic triangulation by their names, with the corners of the faces beside them,
// in the plane and in a periodic box.
#ifndef KINETRI_SRC_SIMULATION_NAMED_FACES_H
#define KINETRI_SRC_SIMULATION_NAMED_FACES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "kinetri/events/event.h"
#include "kinetri/impl/triangulation/edge_changes.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"
#include "triangulation/image_names.h"

namespace kinetri::detail {

/// Finds names and edges. In the plane there are infinite edges and corners: the infinite vertex
/// has the id no_point. In a periodic box a corner is named by its image, as another corner sees
/// it. Precondition of all functions: the dimension is 2.
template <class Traits>
class Named_faces {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;
  using Cgal = typename Triangulation::Triangulation;
  using Face_handle = typename Cgal::Face_handle;
  using Edge = typename Triangulation::Edge;
  static constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;
  using Edge_name = std::conditional_t<is_periodic, Periodic_edge, Edge_ids>;
  using Neighbor = std::conditional_t<is_periodic, Periodic_image, Point_id>;
  using Sides = std::array<Neighbor, 2>;
  using Triple = std::array<Neighbor, 3>;

  /// Of a triangulation that must outlive this object.
  explicit Named_faces(const Triangulation& triangulation) : triangulation_(triangulation) {}

  static Edge_name name(const Edge& edge) {
    const auto& [face, i] = edge;
    return pair_of(id(face, Cgal::cw(i)), corner(face, Cgal::cw(i), Cgal::ccw(i)));
  }

  /// The points opposite the edge, as its first end sees them: left and right of it, directed from
  /// its first end to the second. So an inverted triangle is a different one.
  Sides opposite(const Edge& edge) const {
    const auto& [face, i] = edge;
    const bool is_left = is_first(id(face, Cgal::ccw(i)), corner(face, Cgal::ccw(i), Cgal::cw(i)));
    const int first = is_left ? Cgal::ccw(i) : Cgal::cw(i);
    const Neighbor apex = corner(face, first, i);
    const Neighbor beyond = corner_beyond(edge, first);
    return is_left ? Sides{apex, beyond} : Sides{beyond, apex};
  }

  /// The edge of that name, if there is one.
  std::optional<Edge> find(const Edge_name& name) const {
    const auto& [a, b] = ids_of(name);
    if (!is_visible(a) || !is_visible(b)) return std::nullopt;
    const Cgal& triangulation = triangulation_.triangulation();
    std::optional<Edge> result;
    if constexpr (is_periodic) {
      const Neighbor second = second_of(name);
      for_each_face_at(triangulation, triangulation_.vertex(a), [&](Face_handle face, int i) {
        if (corner(face, i, Cgal::ccw(i)) == second) result = Edge(face, Cgal::cw(i));
      });
    } else {
      const auto vertex = [&](Point_id id) {
        return id == no_point ? triangulation.infinite_vertex() : triangulation_.vertex(id);
      };
      Edge edge;
      if (triangulation.is_edge(vertex(a), vertex(b), edge.first, edge.second)) result = edge;
    }
    return result;
  }

  /// Calls `function` with each edge of the triangles of a visible point.
  template <class Function>
  void for_each_edge_around(Point_id id, Function function) const {
    for_each_face_at(triangulation_.triangulation(), triangulation_.vertex(id),
                     [&](Face_handle face, int i) {
                       function(Edge(face, i));
                       function(Edge(face, Cgal::cw(i)));
                     });
  }

  /// The neighbor of a visible point with the least name; an infinite one has the greatest.
  Neighbor least_neighbor(Point_id id) const {
    std::optional<Neighbor> result;
    for_each_face_at(triangulation_.triangulation(), triangulation_.vertex(id),
                     [&](Face_handle face, int i) {
                       const Neighbor other = corner(face, i, Cgal::ccw(i));
                       if (!result || other < *result) result = other;
                     });
    return *result;
  }

  /// The corners of the triangle that hides a point, as that sees them, counterclockwise, the least
  /// name first.
  Triple hiding_triangle(Point_id id) const {
    const auto v = triangulation_.vertex(id);
    const Face_handle face = v->face();
    Triple result;
    for (int i = 0; i < 3; ++i) {
      Neighbor& named = result[static_cast<std::size_t>(i)];
      if constexpr (is_periodic) {
        named = {face->vertex(i)->point().id(), sum(face->offset(i), reversed(v->offset()))};
      } else {
        named = face->vertex(i)->point().id();
      }
    }
    std::rotate(result.begin(), std::ranges::min_element(result), result.end());
    return result;
  }

 private:
  static Point_id id(Face_handle face, int i) { return face->vertex(i)->point().id(); }

  // Corner `to` of a face, as corner `from` sees it.
  static Neighbor corner(Face_handle face, [[maybe_unused]] int from, int to) {
    if constexpr (is_periodic) {
      return {id(face, to), Cgal::offset(face, from, to)};
    } else {
      return id(face, to);
    }
  }
  // The corner opposite the edge in its other face, as corner `from` of this one sees it, which is
  // an end of the edge.
  Neighbor corner_beyond(const Edge& edge, [[maybe_unused]] int from) const {
    const auto& [face, i] = edge;
    if constexpr (is_periodic) {
      const auto [beyond, j] = Cgal::mirror(edge);
      return {id(beyond, j), *Cgal::offset_beyond(edge, from)};
    } else {
      return triangulation_.triangulation().mirror_vertex(face, i)->point().id();
    }
  }
  bool is_visible(Point_id id) const {
    return id == no_point || (triangulation_.contains(id) && !triangulation_.is_hidden(id));
  }

  const Triangulation& triangulation_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_NAMED_FACES_H
