// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a triangulation that has moved, and on which side of each other they are.
#ifndef KINETRI_SRC_TRIANGULATION_MOVED_POINTS_H
#define KINETRI_SRC_TRIANGULATION_MOVED_POINTS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "kinetic/certain_signs.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "kinetri/impl/triangulation/topology.h"

namespace kinetri::detail {

/// Decides by rounded positions and, if these are too uncertain, by the predicates of the
/// triangulation, at their instant. Precondition of all functions that need positions: set() has
/// been called, and are_known().
template <class Traits>
class Kinetic_types<Traits>::Moved_points {
 public:
  /// An image of a vertex, against some corner of its face.
  struct Image_of_vertex {
    Vertex_handle vertex;
    Lattice_offset_2 offset;
    friend bool operator==(const Image_of_vertex&, const Image_of_vertex&) = default;
  };
  /// In the plane a vertex, in a periodic box an image of one.
  using Vertex = std::conditional_t<is_periodic, Image_of_vertex, Vertex_handle>;

  /// `time` is that of the predicates. The topology must outlive this object.
  Moved_points(Topology& topology, const Time& time);

  /// @{
  /// The corners of a face.
  static Vertex corner(Face_handle face, int i, [[maybe_unused]] int against = 0) {
    if constexpr (is_periodic) {
      return {face->vertex(i), Triangulation::offset(face, against, i)};
    } else {
      return face->vertex(i);
    }
  }
  static std::array<Vertex, 3> corners(Face_handle face) {
    return {corner(face, 0), corner(face, 1), corner(face, 2)};
  }
  /// @}
  /// The corners of the edge's quadrilateral, counterclockwise from corner i of the face on.
  static std::array<Vertex, 4> quadrilateral(const Edge& edge);
  static Vertex_handle handle(const Vertex& v) {
    if constexpr (is_periodic) {
      return v.vertex;
    } else {
      return v;
    }
  }

  /// Gives points, which are there, their motions. O(n), on all threads of oneTBB's arena.
  void set(std::span<const Change> changes);
  /// Whether all rounded positions and weights are finite.
  bool are_known() const { return std::isfinite(errors_.place) && std::isfinite(errors_.weight); }

  /// The rounded position of a finite vertex.
  Vector_2 place(const Vertex& v) const;
  /// The error of each coordinate of their places.
  template <class... Vertices>
  double error([[maybe_unused]] const Vertices&... vertices) const;

  /// The orientation of three finite vertices, if it is certain by place(); else ZERO.
  Sign certain_turn(const Vertex& a, const Vertex& b, const Vertex& c) const {
    return certain_orientation(place(a), place(b), place(c), error(a, b, c));
  }
  /// The orientation of three finite vertices.
  Sign turn(const Vertex& a, const Vertex& b, const Vertex& c) const {
    const Sign known = certain_turn(a, b, c);
    if (known != CGAL::ZERO) return known;
    return triangulation_.geom_traits().orientation_2_object()(point(a), point(b), point(c));
  }
  /// Of infinite triangles too, which cannot turn over.
  bool is_left_turn(const Vertex& a, const Vertex& b, const Vertex& c) const {
    return is_infinite(a) || is_infinite(b) || is_infinite(c) || turn(a, b, c) == CGAL::POSITIVE;
  }
  bool is_left_turn(Face_handle face) const {
    return is_left_turn(corner(face, 0), corner(face, 1), corner(face, 2));
  }

  /// Whether d is in (POSITIVE) or outside of the circle of a, b, c, if it is certain by place();
  /// else ZERO. All are finite. With weights, the power circle.
  Sign certain_side(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) const {
    if constexpr (is_weighted) {
      if (!topology_.are_weights_equal()) {
        return certain_side_of_oriented_circle(
            place(a), place(b), place(c), place(d), error(a, b, c, d),
            {{weight(a), weight(b), weight(c), weight(d)}, errors_.weight});
      }
    }
    return certain_side_of_oriented_circle(place(a), place(b), place(c), place(d),
                                           error(a, b, c, d));
  }
  /// Whether d is in the circle of a, b, c.
  bool is_in_circle(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) const;

 private:
  // Bounds; infinite if a number is not finite.
  struct Errors {
    double place = 0;   // of each coordinate
    double weight = 0;  // of each weight
  };
  struct Block {
    std::span<const Change> changes;
    Errors errors;
  };

  void add_errors(const Motion& motion, Errors& errors) const;
  double weight(const Vertex& v) const {
    return rounded_weight(handle(v)->point().motion(), time_);
  }
  bool is_infinite(const Vertex& v) const { return triangulation_.is_infinite(handle(v)); }
  decltype(auto) point(const Vertex& v) const {
    if constexpr (is_periodic) {
      return triangulation_.geom_traits().image(v.vertex->point(), v.offset);
    } else {
      return (v->point());
    }
  }

  Topology& topology_;
  const Triangulation& triangulation_;
  const double time_;
  const Double_interval times_;
  // The lattice vectors of a periodic box; the error of each coordinate of their sum.
  std::array<Vector_2, 2> lattice_ = {};
  double error_of_lattice_ = 0;
  Errors errors_;
};

template <class Traits>
Kinetic_types<Traits>::Moved_points::Moved_points(Topology& topology, const Time& time)
    : topology_(topology),
      triangulation_(topology.triangulation()),
      time_(time.to_double()),
      times_(time.interval()) {
  if constexpr (is_periodic) {
    const Periodic_box_2& box = triangulation_.geom_traits().box();
    lattice_ = {rounded_place(box.first(), time_), rounded_place(box.second(), time_)};
    error_of_lattice_ =
        place_error(box.first(), time_, times_) + place_error(box.second(), time_, times_);
  }
}

template <class Traits>
inline auto Kinetic_types<Traits>::Moved_points::quadrilateral(const Edge& edge)
    -> std::array<Vertex, 4> {
  const auto& [face, i] = edge;
  const Face_handle beyond = face->neighbor(i);
  const int left = Triangulation::cw(i);
  const int j = Topology::mirror_index(face, i);
  return {corner(face, i, left), corner(face, Triangulation::ccw(i), left),
          corner(beyond, j, Triangulation::ccw(j)), corner(face, left, left)};
}

// As rounded_place of an image, and the bound as that of place_error, for all offsets.
template <class Traits>
inline Vector_2 Kinetic_types<Traits>::Moved_points::place(const Vertex& v) const {
  Vector_2 result = rounded_place(handle(v)->point().motion(), time_);
  if constexpr (is_periodic) {
    if (v.offset == Lattice_offset_2{}) return result;
    const auto& [a, b] = lattice_;
    result.x += v.offset.x * a.x;
    result.y += v.offset.x * a.y;
    result.x += v.offset.y * b.x;
    result.y += v.offset.y * b.y;
  }
  return result;
}

template <class Traits>
template <class... Vertices>
double Kinetic_types<Traits>::Moved_points::error(
    [[maybe_unused]] const Vertices&... vertices) const {
  if constexpr (is_periodic) {
    double greatest = 0;
    const auto add = [&](const Lattice_offset_2& offset) {
      if (offset == Lattice_offset_2{}) return;
      greatest = std::max({greatest, std::abs(static_cast<double>(offset.x)),
                           std::abs(static_cast<double>(offset.y))});
    };
    (add(vertices.offset), ...);
    return errors_.place + greatest * error_of_lattice_;
  } else {
    return errors_.place;
  }
}

template <class Traits>
void Kinetic_types<Traits>::Moved_points::set(std::span<const Change> changes) {
  std::vector<Block> blocks;
  for (const auto& some : blocks_of(changes)) blocks.push_back({some, {}});
  for_each_in_parallel(blocks, [&](Block& block) {
    constexpr std::size_t ahead = 8;
    for (std::size_t k = 0; k < block.changes.size(); ++k) {
      if (k + ahead < block.changes.size()) {
        prefetch(topology_.vertex(block.changes[k + ahead].point));
      }
      topology_.set_point(block.changes[k]);
      add_errors(*block.changes[k].motion, block.errors);
    }
  });
  for (const Block& block : blocks) {
    errors_.place = std::max(errors_.place, block.errors.place);
    errors_.weight = std::max(errors_.weight, block.errors.weight);
  }
  if (changes.size() == topology_.number_of_vertices()) return;
  for (const Vertex_handle v : topology_.vertices()) {
    if (v != Vertex_handle()) add_errors(v->point().motion(), errors_);
  }
}

template <class Traits>
void Kinetic_types<Traits>::Moved_points::add_errors(const Motion& motion, Errors& errors) const {
  const auto add = [](double& bound, double number, double error) {
    const bool is_finite = std::isfinite(number) && std::isfinite(error);
    bound = is_finite ? std::max(bound, error) : std::numeric_limits<double>::infinity();
  };
  const auto [x, y] = rounded_place(motion, time_);
  add(errors.place, x + y + error_of_lattice_, place_error(motion, time_, times_));
  if constexpr (is_weighted) {
    add(errors.weight, rounded_weight(motion, time_), weight_error(motion, time_, times_));
  }
}

template <class Traits>
bool Kinetic_types<Traits>::Moved_points::is_in_circle(const Vertex& a, const Vertex& b,
                                                       const Vertex& c, const Vertex& d) const {
  const Sign known = certain_side(a, b, c, d);
  if (known != CGAL::ZERO) return known == CGAL::POSITIVE;
  const auto side = [&] {
    if constexpr (is_weighted && !is_periodic) {
      return triangulation_.geom_traits().power_side_of_oriented_power_circle_2_object();
    } else {
      return triangulation_.geom_traits().side_of_oriented_circle_2_object();
    }
  }();
  return side(point(a), point(b), point(c), point(d)) == CGAL::ON_POSITIVE_SIDE;
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_MOVED_POINTS_H
