// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a plane triangulation that has moved, and on which side of each other they are.
#ifndef KINETRI_SRC_TRIANGULATION_MOVED_POINTS_H
#define KINETRI_SRC_TRIANGULATION_MOVED_POINTS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "kinetic/certain_signs.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "kinetri/impl/triangulation/topology.h"

namespace kinetri::detail {

/// Decides by rounded positions and, if these are too uncertain, by the predicates of the
/// triangulation, at their instant. Precondition of all but set(): set() has been called, and
/// are_known().
template <class Traits>
class Kinetic_types<Traits>::Moved_points {
 public:
  /// `time` is that of the predicates. The topology must outlive this object.
  Moved_points(Topology& topology, const Time& time)
      : topology_(topology),
        triangulation_(topology.triangulation()),
        time_(time.to_double()),
        times_(time.interval()) {}

  /// Gives points, which are there, their motions. O(n), on all threads of oneTBB's arena.
  void set(std::span<const Change> changes);
  /// Whether all rounded positions and weights are finite.
  bool are_known() const { return std::isfinite(errors_.place) && std::isfinite(errors_.weight); }

  /// The rounded position of a finite vertex.
  Vector_2 place(Vertex_handle v) const { return rounded_place(v->point().motion(), time_); }
  /// The error of each coordinate of place().
  double error() const { return errors_.place; }

  /// The orientation of three finite vertices, if it is certain by place(); else ZERO.
  Sign certain_turn(Vertex_handle a, Vertex_handle b, Vertex_handle c) const {
    return certain_orientation(place(a), place(b), place(c), errors_.place);
  }
  /// The orientation of three finite vertices.
  Sign turn(Vertex_handle a, Vertex_handle b, Vertex_handle c) const {
    const Sign known = certain_turn(a, b, c);
    if (known != CGAL::ZERO) return known;
    return triangulation_.geom_traits().orientation_2_object()(a->point(), b->point(), c->point());
  }
  /// Of infinite triangles too, which cannot turn over.
  bool is_left_turn(Vertex_handle a, Vertex_handle b, Vertex_handle c) const {
    return is_infinite(a) || is_infinite(b) || is_infinite(c) || turn(a, b, c) == CGAL::POSITIVE;
  }
  bool is_left_turn(Face_handle face) const {
    return is_left_turn(face->vertex(0), face->vertex(1), face->vertex(2));
  }

  /// Whether a finite vertex is in (POSITIVE) or outside of the circle of a finite face, if it is
  /// certain by place(); else ZERO. With weights, the power circle.
  Sign certain_side(Face_handle face, Vertex_handle v) const {
    const std::array corners = {face->vertex(0), face->vertex(1), face->vertex(2)};
    const auto& [a, b, c] = corners;
    if constexpr (is_weighted) {
      if (!topology_.are_weights_equal()) {
        return certain_side_of_oriented_circle(
            place(a), place(b), place(c), place(v), errors_.place,
            {{weight(a), weight(b), weight(c), weight(v)}, errors_.weight});
      }
    }
    return certain_side_of_oriented_circle(place(a), place(b), place(c), place(v), errors_.place);
  }
  /// Whether a finite vertex is in the circle of a finite face.
  bool is_in_circle(Face_handle face, Vertex_handle v) const;

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
  double weight(Vertex_handle v) const { return rounded_weight(v->point().motion(), time_); }
  bool is_infinite(Vertex_handle v) const { return triangulation_.is_infinite(v); }

  Topology& topology_;
  const Triangulation& triangulation_;
  const double time_;
  const Double_interval times_;
  Errors errors_;
};

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
  add(errors.place, x + y, place_error(motion, time_, times_));
  if constexpr (is_weighted) {
    add(errors.weight, rounded_weight(motion, time_), weight_error(motion, time_, times_));
  }
}

template <class Traits>
bool Kinetic_types<Traits>::Moved_points::is_in_circle(Face_handle face, Vertex_handle v) const {
  const Sign known = certain_side(face, v);
  if (known != CGAL::ZERO) return known == CGAL::POSITIVE;
  const auto side = [&] {
    if constexpr (is_weighted) {
      return triangulation_.geom_traits().power_side_of_oriented_power_circle_2_object();
    } else {
      return triangulation_.geom_traits().side_of_oriented_circle_2_object();
    }
  }();
  return side(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point(),
              v->point()) == CGAL::ON_POSITIVE_SIDE;
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_MOVED_POINTS_H
