// SPDX-License-Identifier: GPL-3.0-or-later
//
// The moving point, which vertices store and predicates take: usually an input point with its
// motion; circumcenters are points whose coordinates are rational functions of time.
#ifndef KINETRI_KINETIC_MOVING_POINT_2_H
#define KINETRI_KINETIC_MOVING_POINT_2_H

#include <array>
#include <boost/smart_ptr/intrusive_ptr.hpp>
#include <boost/smart_ptr/intrusive_ref_counter.hpp>
#include <iosfwd>
#include <utility>

#include "kinetri/algebra/polynomial.h"
#include "kinetri/base/ids.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri {

/// A trajectory in homogeneous coordinates: the position at time t is (x(t) / w(t), y(t) / w(t)),
/// and the weight there is weight(t) / w(t)^2. It is undefined when w vanishes.
struct Trajectory_2 : boost::intrusive_ref_counter<Trajectory_2> {
  /// Undefined: w is the zero polynomial.
  Trajectory_2() = default;
  /// The trajectory (x_ / w_, y_ / w_), of a point with the weight weight_ / w_^2.
  Trajectory_2(Polynomial x_, Polynomial y_, Polynomial w_, Polynomial weight_ = {})
      : x(std::move(x_)), y(std::move(y_)), w(std::move(w_)), weight(std::move(weight_)) {}

  Polynomial x;       ///< w times the x coordinate
  Polynomial y;       ///< w times the y coordinate
  Polynomial w;       ///< the common denominator, of either sign
  Polynomial weight;  ///< w^2 times the weight; zero for points without one
};

/// A position in the plane, exact.
struct Exact_position_2 {
  Rational x;  ///< to the right
  Rational y;  ///< up
};

/// The trajectory of a motion as polynomials in time, exactly; w is a positive constant.
/// Precondition: the numbers of the motion are finite.
Trajectory_2 trajectory(const Linear_motion_2& motion);
/// The trajectory of a polynomial motion; w is a positive constant too.
Trajectory_2 trajectory(const Polynomial_motion_2& motion);
/// @{
/// The trajectory of the center of a disc, with the weight of the disc; w is a positive constant
/// too.
Trajectory_2 trajectory(const Disc_motion_2& motion);
Trajectory_2 trajectory(const Polynomial_disc_motion_2& motion);
/// @}

/// A moving point. It has no operator==: predicates compare positions at an instant
/// (`Basic_instantaneous_traits_2`).
template <class MotionType>
class Basic_moving_point_2 {
 public:
  using Motion =
      MotionType;  ///< Linear_motion_2, Polynomial_motion_2, a disc about such, or an image

  /// A point at rest at the origin.
  Basic_moving_point_2() = default;
  /// The point `id` of an input sequence. A query point has no id.
  explicit Basic_moving_point_2(const Motion& motion, Point_id id = no_point)
      : motion_(motion), id_(id) {}
  /// A constructed point. Precondition: trajectory.w is not the zero polynomial.
  explicit Basic_moving_point_2(Trajectory_2 trajectory);

  /// The id as given to the constructor; no_point of a query point and of a constructed one.
  Point_id id() const noexcept { return id_; }

  /// Whether the point was made from a motion.
  bool has_motion() const noexcept { return constructed_ == nullptr; }
  /// The motion as given to the constructor. Precondition: has_motion().
  const Motion& motion() const noexcept { return motion_; }

  /// Its trajectory as polynomials; of a motion w is a positive constant.
  Trajectory_2 trajectory() const;

  /// Its position at time `t`, exactly, in rational arithmetic. Precondition: w does not vanish at
  /// `t`.
  Exact_position_2 position(const Rational& t) const;

  /// Its weight at time `t`, exactly: zero without one. Precondition: w does not vanish at `t`.
  Rational weight(const Rational& t) const;

 private:
  Motion motion_ = {};
  boost::intrusive_ptr<const Trajectory_2> constructed_;
  Point_id id_ = no_point;
};

/// Human-readable, for messages: the id and the motion, or the trajectory of a constructed point.
/// Binary64 numbers are printed with 17 digits.
template <class Motion>
std::ostream& operator<<(std::ostream& out, const Basic_moving_point_2<Motion>& point);

extern template class Basic_moving_point_2<Linear_motion_2>;
extern template class Basic_moving_point_2<Polynomial_motion_2>;
extern template class Basic_moving_point_2<Disc_motion_2>;
extern template class Basic_moving_point_2<Polynomial_disc_motion_2>;
extern template std::ostream& operator<<(std::ostream& out,
                                         const Basic_moving_point_2<Linear_motion_2>& point);
extern template std::ostream& operator<<(std::ostream& out,
                                         const Basic_moving_point_2<Polynomial_motion_2>& point);
extern template std::ostream& operator<<(std::ostream& out,
                                         const Basic_moving_point_2<Disc_motion_2>& point);
extern template std::ostream& operator<<(
    std::ostream& out, const Basic_moving_point_2<Polynomial_disc_motion_2>& point);

/// A point in linear motion.
using Moving_point_2 = Basic_moving_point_2<Linear_motion_2>;
/// A disc whose center is in linear motion.
using Moving_disc_2 = Basic_moving_point_2<Disc_motion_2>;

/// The trajectories of several points, in a form for predicates that do not change if the whole
/// plane is scaled: if all the points have motions, x and y are scaled by one common positive
/// number to integer polynomials, weights by its square, and w is 1; else each is as `trajectory()`
/// gives it.
template <std::size_t N, class Motion>
std::array<Trajectory_2, N> common_trajectories(
    const std::array<const Basic_moving_point_2<Motion>*, N>& points);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_MOVING_POINT_2_H
