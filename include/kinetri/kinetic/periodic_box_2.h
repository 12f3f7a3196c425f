// SPDX-License-Identifier: GPL-3.0-or-later
//
// A periodic box: the plane modulo a lattice, whose two vectors may be linear in time.
#ifndef KINETRI_KINETIC_PERIODIC_BOX_2_H
#define KINETRI_KINETIC_PERIODIC_BOX_2_H

#include <optional>
#include <string>
#include <utility>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/polynomial.h"
#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// The lattice vectors of a periodic box cannot be used, or not at a time.
class Periodic_box_error : public Error {
 public:
  using Error::Error;
};

/// An edge of a triangulation in a periodic box would get an offset of 2^31 or more: points or the
/// box have moved too far. Kinetic_triangulation_2 says what can be done then.
class Periodic_offset_error : public Error {
 public:
  /// About an edge between images of the points at the time, with the message that what() gives.
  Periodic_offset_error(Point_id first, Point_id second, Algebraic_number time,
                        const std::string& message)
      : Error(message), first_(first), second_(second), time_(std::move(time)) {}
  /// @{
  /// The ends of the edge, as given to the constructor: the smaller id first, and twice the same id
  /// for an edge from a point to its own image.
  Point_id first() const noexcept { return first_; }
  Point_id second() const noexcept { return second_; }
  /// @}
  /// The time, exactly.
  const Algebraic_number& time() const noexcept { return time_; }

 private:
  Point_id first_;
  Point_id second_;
  Algebraic_number time_;
};

/// A parallelogram that is repeated all over the plane, spanned by two *lattice vectors*. Each is a
/// Linear_motion_2: the vector `position` at the epoch, which changes at the rate `velocity`. With
/// (L, 0) and (0, L) at rest it is a square box; with the rate (g L, 0) of the second one it is
/// sheared; with rates in proportion to the vectors it grows. All numbers are exact.
///
/// A box can be used at the times at which its area, the determinant of the two vectors, is
/// positive: then the second vector is to the left of the first. Immutable.
class Periodic_box_2 {
 public:
  /// With these lattice vectors. Throws Periodic_box_error if a number is not finite, or if the
  /// area never changes and is not positive.
  Periodic_box_2(const Linear_motion_2& first, const Linear_motion_2& second);

  /// @{
  /// The lattice vectors, as given to the constructor.
  const Linear_motion_2& first() const noexcept { return first_; }
  const Linear_motion_2& second() const noexcept { return second_; }
  /// @}

  /// A positive multiple of the area, as a polynomial in time of degree 2 at most; negative while
  /// the second vector is to the right of the first.
  Polynomial area_polynomial() const;

  /// The area at time `t`, exactly, with that sign.
  Rational area(const Rational& t) const;

  /// The flow of the box: the velocity, at time t, of a place that keeps its coordinates with
  /// respect to the lattice vectors. In a box at rest it is zero; under simple shear it is (rate y,
  /// 0). Images of a point differ in velocity as the flow at their places does. Rounded.
  /// Precondition: the area is positive at t.
  Vector_2 flow_at(Vector_2 place, double t) const;

  /// The first time after `t` at which the area is zero, exactly; none if there is none.
  /// Precondition: the area is positive at `t`. Cost: the roots of a quadratic polynomial.
  std::optional<Algebraic_number> collapse_after(const Algebraic_number& t) const;

  /// Throws Periodic_box_error, with the time, unless the area is positive at all times from `from`
  /// to `until`, both included. Precondition: from <= until.
  void require_area(const Algebraic_number& from, const Algebraic_number& until) const;

  /// Equality of the representations.
  friend bool operator==(const Periodic_box_2&, const Periodic_box_2&) = default;

 private:
  Linear_motion_2 first_;
  Linear_motion_2 second_;
};

/// The box at -t in place of t, exactly.
inline Periodic_box_2 mirrored(const Periodic_box_2& box) {
  return {mirrored(box.first()), mirrored(box.second())};
}

}  // namespace kinetri

#endif  // KINETRI_KINETIC_PERIODIC_BOX_2_H
