// SPDX-License-Identifier: GPL-3.0-or-later
//
// The construction of the triangulation of points in the plane from that of their rounded
// positions, which is nearly the same.
#ifndef KINETRI_SRC_TRIANGULATION_ROUNDED_CONSTRUCTION_H
#define KINETRI_SRC_TRIANGULATION_ROUNDED_CONSTRUCTION_H

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinetic/rounded_places.h"
#include "kinetri/impl/triangulation/static_construction.h"
#include "triangulation/static_delaunay.h"

namespace kinetri::detail {

/// A triangulation and the rounded positions of its points.
template <class Traits>
class Kinetic_types<Traits>::Rounded_construction {
 public:
  /// The positions are near those at the instant of the triangulation's traits. The others must
  /// outlive this object.
  Rounded_construction(Triangulation& triangulation, const Rounded_places& places)
      : triangulation_(triangulation), places_(places) {}

  /// Makes the triangulation, which is empty, that of the points. Returns false, and leaves it in
  /// any state, if the rounded positions have another hull or a triangle that turns over, or if too
  /// many of them are cocircular.
  bool build(std::span<const Point_2> points);
  /// Finds points with the same trajectory and weight among those that are certainly inside of
  /// faces: these are in one face.
  void find_coincident_in_faces(std::vector<Edge_ids>& coincident) const;
  /// Appends pairs of points with the same trajectory, mostly all that there are, but for some
  /// whose motions are represented differently.
  static void find_coincident(std::span<const Point_2> points, const Time& time,
                              std::vector<Edge_ids>& coincident);
  /// The function that tells whether vertices make a left turn at the instant of the
  /// triangulation's traits, to which the positions are near.
  static auto left_turn(const Triangulation& triangulation, const Rounded_places& places) {
    const auto orientation = triangulation.geom_traits().orientation_2_object();
    return [orientation, &places](Vertex_handle a, Vertex_handle b, Vertex_handle c) {
      const Sign known = places.orientation(a->point().id(), b->point().id(), c->point().id());
      if (known != CGAL::ZERO) return known == CGAL::POSITIVE;
      return orientation(a->point(), b->point(), c->point()) == CGAL::LEFT_TURN;
    };
  }

 private:
  bool flip_until_delaunay();

  Triangulation& triangulation_;
  const Rounded_places& places_;
};

template <class Traits>
bool Kinetic_types<Traits>::Rounded_construction::build(std::span<const Point_2> points) {
  std::vector<Vector_2> in_order;
  std::vector<double> weights_in_order;
  in_order.reserve(points.size());
  for (const Point_2& point : points) {
    in_order.push_back(places_[point.id()]);
    if (places_.weights().empty()) continue;
    weights_in_order.push_back(places_.weights()[point.id() - places_.first()]);
    if (!std::isfinite(weights_in_order.back())) return false;
  }
  const Static_points rounded = {in_order, weights_in_order, places_.error(),
                                 places_.error_of_weights()};
  const Static_delaunay found = static_delaunay(rounded);
  if (found.faces.empty()) return false;
  auto& tds = triangulation_.tds();
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
      return id == no_point ? triangulation_.infinite_vertex() : vertices[id];
    };
    faces.push_back(tds.create_face(vertex(0), vertex(1), vertex(2)));
    for (std::size_t i = 0; i < 3; ++i) vertex(i)->set_face(faces.back());
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [a, b, c] = found.faces[f].neighbors;
    faces[f]->set_neighbors(faces[a], faces[b], faces[c]);
  }
  if constexpr (is_weighted) {
    for (const auto& [point, face] : found.hidden)
      triangulation_.hide(vertices[point], faces[face]);
  }
  const auto is_left_turn = left_turn(triangulation_, places_);
  if (is_certainly_delaunay(found, rounded)) {
    return Static_construction::is_hull_convex(triangulation_, is_left_turn);
  }
  if (!places_.weights().empty()) return false;
  return Static_construction::is_embedded_in_plane(triangulation_, is_left_turn) &&
         flip_until_delaunay();
}

template <class Traits>
void Kinetic_types<Traits>::Rounded_construction::find_coincident_in_faces(
    std::vector<Edge_ids>& coincident) const {
  if constexpr (is_weighted) {
    if (triangulation_.number_of_hidden_vertices() < 2) return;
    for (const Face_handle face : triangulation_.finite_face_handles()) {
      std::vector<const Point_2*> inside;
      for (const Vertex_handle v : face->vertex_list()) inside.push_back(&v->point());
      Static_construction::find_all_coincident(std::move(inside), triangulation_.geom_traits(),
                                               coincident);
    }
  }
}

// Those next to each other in the order of rounded positions at two times.
template <class Traits>
void Kinetic_types<Traits>::Rounded_construction::find_coincident(
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

// Flips edges until the triangulation, which is embedded, is Delaunay. [Lawson 1977] Returns false
// if there are more flips than faces: for cocircular points there may be n^2, and insertion by CGAL
// is faster.
template <class Traits>
bool Kinetic_types<Traits>::Rounded_construction::flip_until_delaunay() {
  const auto exact_side = triangulation_.geom_traits().side_of_oriented_circle_2_object();
  const auto side = [&](Face_handle face, const Point_2& s) {
    const Point_2& p = face->vertex(0)->point();
    const Point_2& q = face->vertex(1)->point();
    const Point_2& r = face->vertex(2)->point();
    const Sign known = places_.side_of_oriented_circle(p.id(), q.id(), r.id(), s.id());
    return known != CGAL::ZERO ? known : exact_side(p, q, r, s);
  };
  std::size_t flips_left = triangulation_.tds().number_of_faces();
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (const Face_handle face : triangulation_.finite_face_handles()) {
      for (int i = 0; i < 3; ++i) {
        if (!Topology::is_chosen_side(Edge(face, i))) continue;
        const Face_handle beyond = face->neighbor(i);
        if (triangulation_.is_infinite(beyond)) continue;
        const Vertex_handle opposite = beyond->vertex(triangulation_.tds().mirror_index(face, i));
        const auto where = side(face, opposite->point());
        if (where != CGAL::ON_POSITIVE_SIDE) continue;
        if (flips_left-- == 0) return false;
        triangulation_.tds().flip(face, i);
        is_changed = true;
      }
    }
  }
  return true;
}

template <class Traits>
bool From_places<Traits>::build(std::span<const Point_2> points, const Time& time,
                                Triangulation& result, std::vector<Edge_ids>& coincident) {
  constexpr std::size_t few = 16;  // for so few, insertion is as fast
  const Rounded_places places(points, time);
  if (points.size() < few || !places.are_finite()) return false;
  typename Kinetic_types<Traits>::Rounded_construction construction(result, places);
  if (construction.build(points)) {
    construction.find_coincident_in_faces(coincident);
    return true;
  }
  result.clear();
  construction.find_coincident(points, time, coincident);
  return !coincident.empty();
}

template <class Traits>
bool From_places<Traits>::is_embedded(const Triangulation& triangulation, const Time& time) {
  const auto point_of = [](auto v) -> const Point_2& { return v->point(); };
  const Rounded_places places(triangulation.finite_vertex_handles(), time, point_of);
  return Kinetic_types<Traits>::Static_construction::is_embedded_in_plane(
      triangulation, Kinetic_types<Traits>::Rounded_construction::left_turn(triangulation, places));
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_ROUNDED_CONSTRUCTION_H
