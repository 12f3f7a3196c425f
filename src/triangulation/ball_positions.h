// SPDX-License-Identifier: GPL-3.0-or-later
//
// The positions of points at one time in ball arithmetic, which decides most comparisons of
// distances (also of equal ones, if there is no rounding), and rounds most positions.
#ifndef KINETRI_SRC_TRIANGULATION_BALL_POSITIONS_H
#define KINETRI_SRC_TRIANGULATION_BALL_POSITIONS_H

#include <optional>

#include "triangulation/ball.h"
#include "triangulation/triangulation_at_time.h"

namespace kinetri::detail {

/// How the two numbers compare; none if that is not certain.
inline std::optional<Comparison_result> compare(const Ball& a, const Ball& b) {
  const Ball difference = a - b;
  if (difference.is_positive()) return CGAL::LARGER;
  if ((-difference).is_positive()) return CGAL::SMALLER;
  if (difference.is_zero()) return CGAL::EQUAL;
  return std::nullopt;
}

/// Both coordinates rounded, if that is certain.
inline std::optional<Vector_2> rounded(const Ball_2& position) {
  const auto x = position.x.rounded();
  const auto y = position.y.rounded();
  return x && y ? std::optional(Vector_2{*x, *y}) : std::nullopt;
}

/// Positions and distances at one time in ball arithmetic. Exact predicates decide what it leaves
/// open.
template <KineticTraits_2 Traits>
class Ball_positions {
 public:
  using At_time = Triangulation_at_time<Traits>;
  using Vertex = typename At_time::Vertex;

  struct Neighbor {
    Vertex vertex;
    Ball_2 vector;  ///< from the point
    Ball squared_distance;
  };

  /// The triangulation must outlive this object.
  explicit Ball_positions(const At_time& at) : at_(at), t_(ball_of(at.time())) {}

  const At_time& at() const { return at_; }
  Ball_2 position(Vertex v) const { return ball_place(center(at_.point(v).motion()), t_); }
  /// Cheaper, with a bound of its error.
  Approximate_place approximate(Vertex v) const {
    if (!is_known_well(t_)) return {};
    return approximate_place(center(at_.point(v).motion()), t_.high);
  }
  Ball weight(Vertex v) const { return ball_weight(at_.point(v).motion(), t_); }
  Vector_2 rounded_position(Vertex v) const {
    const auto known = rounded(position(v));
    return known ? *known : at_.rounded_position(at_.point(v).trajectory());
  }

  /// A neighbor of the point that is `here`.
  Neighbor neighbor(const Ball_2& here, Vertex u) const {
    const Ball_2 vector = position(u) - here;
    return {u, vector, squared_length(vector)};
  }
  /// Of two neighbors of `v`. Exact.
  Comparison_result compare_distance(Vertex v, const Neighbor& a, const Neighbor& b) const {
    const auto order = compare(a.squared_distance, b.squared_distance);
    return order ? *order : at_.compare_distance(v, a.vertex, b.vertex);
  }
  /// The center, rounded, of the circle through `v`, whose position is `here`, and two neighbors;
  /// `center` is the vector to it, if known.
  Vector_2 rounded_center(Vertex v, const Ball_2& here, const Neighbor& a, const Neighbor& b,
                          const std::optional<Ball_2>& center) const {
    if (center) {
      if (const auto known = rounded(Ball_2{here.x + center->x, here.y + center->y})) return *known;
    }
    return at_.rounded_position(at_.center(v, a.vertex, b.vertex));
  }

 private:
  const At_time& at_;
  Ball t_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_BALL_POSITIONS_H
