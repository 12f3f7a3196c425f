// SPDX-License-Identifier: GPL-3.0-or-later
//
// The gap between two discs: the distance of their centres minus both radii. Of points, which are
// discs of radius 0, it is the distance.
#ifndef KINETRI_IMPL_OBSERVERS_GAP_OF_PAIR_H
#define KINETRI_IMPL_OBSERVERS_GAP_OF_PAIR_H

#include <optional>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/disc_motion_2.h"

namespace kinetri::detail {

/// The disc of that radius about the point, or the disc itself, which has a radius of its own.
template <class Motion>
auto disc_about(const Motion& motion, double radius) {
  if constexpr (HasWeight<Motion>) {
    return motion;
  } else {
    return Basic_disc_motion_2<Motion>{motion, radius, 0, 0};
  }
}

/// The gap of two discs at a time, exactly. `Disc` is Disc_motion_2 or Polynomial_disc_motion_2.
template <class Disc>
class Gap_of_pair {
 public:
  /// At that time; whether the gap of the two motions `is_minimal` then, of all times. Precondition
  /// of the latter: points in linear motion.
  Gap_of_pair(const Disc& p, const Disc& q, Algebraic_number time, bool is_minimal = false);

  const Algebraic_number& time() const { return time_; }
  /// Contain the gap.
  const Double_interval& bounds() const { return bounds_; }
  /// The distance of the centres, rounded to the nearest binary64 number, ties to even; infinite on
  /// overflow.
  double rounded_distance() const;
  /// The gap, rounded in the same way.
  double rounded() const;

  /// Compares the gap with another one, exactly; by the bounds where these decide.
  Comparison_result compare(const Gap_of_pair& other) const;

 private:
  const Algebraic_number& exact() const;
  std::optional<double> certainly_rounded() const;
  std::optional<Rational> rational_square() const;

  Disc p_;
  Disc q_;
  Algebraic_number time_;
  bool is_minimal_;
  Double_interval bounds_;
  mutable std::optional<Algebraic_number> exact_;  // made where the bounds do not decide
};

/// The least gap from `since` to `until`, at the first time at which it is least. Exact.
/// Precondition: since <= until.
template <class Disc>
Gap_of_pair<Disc> least_gap(const Disc& p, const Disc& q, const Algebraic_number& since,
                            const Algebraic_number& until);

/// Contain that least gap. Cost: some hundred floating-point operations.
template <class Disc>
Double_interval least_gap_bounds(const Disc& p, const Disc& q, const Algebraic_number& since,
                                 const Algebraic_number& until);

extern template class Gap_of_pair<Disc_motion_2>;
extern template class Gap_of_pair<Polynomial_disc_motion_2>;

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_OBSERVERS_GAP_OF_PAIR_H
