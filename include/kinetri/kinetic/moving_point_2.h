// SPDX-License-Identifier: GPL-3.0-or-later
//
// The moving point: what a vertex of the triangulation holds, and what the predicates at an instant
// take. Usually an input point with its linear motion; the constructions of the traits
// (circumcenter) give points whose coordinates are rational functions of time.
#ifndef KINETRI_KINETIC_MOVING_POINT_2_H
#define KINETRI_KINETIC_MOVING_POINT_2_H

#include <array>
#include <boost/smart_ptr/intrusive_ptr.hpp>
#include <boost/smart_ptr/intrusive_ref_counter.hpp>
#include <utility>

#include "kinetri/algebra/polynomial.h"
#include "kinetri/base/ids.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// A trajectory in homogeneous coordinates: the place at time t is (x(t) / w(t), y(t) / w(t)).
/// It is undefined where w vanishes.
struct Trajectory_2 : boost::intrusive_ref_counter<Trajectory_2> {
  Trajectory_2() = default;
  Trajectory_2(Polynomial x_, Polynomial y_, Polynomial w_)
      : x(std::move(x_)), y(std::move(y_)), w(std::move(w_)) {}

  Polynomial x;
  Polynomial y;
  Polynomial w;
};

/// A place in the plane, exact.
struct Exact_position_2 {
  Rational x;
  Rational y;
};

/// A moving point. A value; equality is not defined, since equal places at an instant are a
/// question for the predicates (`Instantaneous_traits_2`).
class Moving_point_2 {
 public:
  /// A point at rest at the origin.
  Moving_point_2() = default;
  /// The point `id` of an input sequence. A query point has no id.
  explicit Moving_point_2(const Linear_motion_2& motion, Point_id id = no_point)
      : motion_(motion), id_(id) {}
  /// A constructed point. Precondition: trajectory.w is not the zero polynomial.
  explicit Moving_point_2(Trajectory_2 trajectory);

  Point_id id() const noexcept { return id_; }

  /// Whether the point moves by a linear motion, and that motion.
  bool is_linear() const noexcept { return constructed_ == nullptr; }
  /// Precondition: is_linear().
  const Linear_motion_2& motion() const noexcept { return motion_; }

  /// Its trajectory as polynomials; for linear motion w is a positive constant.
  Trajectory_2 trajectory() const;

  /// Its exact place at time `t`. Precondition: w does not vanish at `t`.
  Exact_position_2 position(const Rational& t) const;

 private:
  Linear_motion_2 motion_;
  boost::intrusive_ptr<const Trajectory_2> constructed_;
  Point_id id_ = no_point;
};

/// The trajectories of several points, each in a form that serves predicates which do not change
/// when the whole plane is scaled: if all the points are linear, x and y are scaled by one common
/// power of two to integer polynomials and w is 1; else each is as `trajectory()` gives it.
template <std::size_t N>
std::array<Trajectory_2, N> common_trajectories(const std::array<const Moving_point_2*, N>& points);

extern template std::array<Trajectory_2, 2> common_trajectories<2>(
    const std::array<const Moving_point_2*, 2>&);
extern template std::array<Trajectory_2, 3> common_trajectories<3>(
    const std::array<const Moving_point_2*, 3>&);
extern template std::array<Trajectory_2, 4> common_trajectories<4>(
    const std::array<const Moving_point_2*, 4>&);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_MOVING_POINT_2_H
