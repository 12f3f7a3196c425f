// SPDX-License-Identifier: GPL-3.0-or-later
//
// The gap between two discs, or their images in a periodic box: the distance of their centers minus
// both radii. Points are discs of radius 0.
#ifndef KINETRI_SRC_OBSERVERS_GAP_OF_PAIR_H
#define KINETRI_SRC_OBSERVERS_GAP_OF_PAIR_H

#include <optional>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/image_motion_2.h"

namespace kinetri::detail {

/// The disc itself if it has a radius of its own, else the disc of that radius about the point.
template <class Motion>
auto disc_about(const Motion& motion, [[maybe_unused]] double radius) {
  if constexpr (HasWeight<Motion>) {
    return motion;
  } else {
    return Basic_disc_motion_2<Motion>{motion, radius, 0, 0};
  }
}

/// The gap of two discs at a time, exactly. `Disc` is Disc_motion_2, Polynomial_disc_motion_2 or
/// Image_disc_motion_2, whose box must exist as long as this object.
template <class Disc>
class Gap_of_pair {
 public:
  /// The gap at that time. `is_minimal` says that it is the least of all times; then the discs are
  /// points in linear motion.
  Gap_of_pair(const Disc& p, const Disc& q, Algebraic_number time, bool is_minimal = false);

  const Algebraic_number& time() const { return time_; }
  /// Bounds of the gap.
  const Double_interval& bounds() const { return bounds_; }
  /// The distance of the centers, rounded to the nearest binary64 number, ties to even; infinite on
  /// overflow.
  double rounded_distance() const;
  /// The gap, rounded in the same way.
  double rounded() const;

  /// Compares the gap with another one, exactly; by the bounds if these decide.
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
  mutable std::optional<Algebraic_number> exact_;  // computed if the bounds do not decide
};

/// The least gap from `since` to `until`, at the first time at which it is least. Exact.
/// Precondition: since <= until.
template <class Disc>
Gap_of_pair<Disc> least_gap(const Disc& p, const Disc& q, const Algebraic_number& since,
                            const Algebraic_number& until);

/// Bounds of that least gap. Cost: some hundred floating-point operations.
template <class Disc>
Double_interval least_gap_bounds(const Disc& p, const Disc& q, const Algebraic_number& since,
                                 const Algebraic_number& until);

extern template class Gap_of_pair<Disc_motion_2>;
extern template class Gap_of_pair<Polynomial_disc_motion_2>;
extern template class Gap_of_pair<Image_disc_motion_2>;

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_GAP_OF_PAIR_H
