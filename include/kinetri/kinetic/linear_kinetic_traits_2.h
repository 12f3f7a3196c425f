// SPDX-License-Identifier: GPL-3.0-or-later
//
// The default model of KineticTraits_2: points that move along straight lines with constant
// velocity.
#ifndef KINETRI_KINETIC_LINEAR_KINETIC_TRAITS_2_H
#define KINETRI_KINETIC_LINEAR_KINETIC_TRAITS_2_H

#include <optional>
#include <utility>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/kinetic/contact_kinetic_traits_2.h"
#include "kinetri/kinetic/instantaneous_traits_2.h"
#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/moving_point_2.h"

namespace kinetri {

/// Certificates of linear motion; see KineticTraits_2 for their contracts. In-circle certificates
/// are polynomials of degree at most 4 in time, orientation of degree at most 2, coincidence of
/// degree 1. Every failure time is exact. Cost: some hundred floating-point operations where the
/// filter decides (kinetri/kinetic/linear_filter.h), else exact arithmetic, a thousand times that.
class Linear_kinetic_traits_2 {
 public:
  using Motion = Linear_motion_2;
  using Point_2 = Moving_point_2;
  using Time = Algebraic_number;
  using Instantaneous_traits = Instantaneous_traits_2;

  Linear_kinetic_traits_2() = default;
  explicit Linear_kinetic_traits_2(Arithmetic arithmetic) : arithmetic_(arithmetic) {}

  Outlook<Time> in_circle_outlook(const Point_2& p, const Point_2& q, const Point_2& r,
                                  const Point_2& s, const Time& t, Certificate_state state,
                                  Certificate_counters& counters) const;
  Outlook<Time> orientation_outlook(const Point_2& p, const Point_2& q, const Point_2& r,
                                    const Time& t, Certificate_state state,
                                    Certificate_counters& counters) const;
  Time in_circle_failure(const Point_2& p, const Point_2& q, const Point_2& r, const Point_2& s,
                         const Double_interval& bounds) const;
  Time orientation_failure(const Point_2& p, const Point_2& q, const Point_2& r,
                           const Double_interval& bounds) const;
  /// The coincidence time of linear motions is rational.
  std::optional<Time> coincidence_time(const Point_2& p, const Point_2& q, const Time& t,
                                       Certificate_counters& counters) const;

  /// Contacts; see ContactKineticTraits_2. Polynomials of degree 2 (discs) and 1 (walls).
  Outlook<Time> contact_outlook(const Point_2& p, const Point_2& q, double diameter, const Time& t,
                                Certificate_counters& counters) const;
  Outlook<Time> wall_outlook(const Point_2& p, const Wall_2& wall, const Time& t,
                             Certificate_counters& counters) const;
  Time contact_failure(const Point_2& p, const Point_2& q, double diameter,
                       const Double_interval& bounds) const;
  Time wall_failure(const Point_2& p, const Wall_2& wall, const Double_interval& bounds) const;
  bool do_approach(const Point_2& p, const Point_2& q, const Time& t) const;
  bool do_overlap(const Point_2& p, const Point_2& q, double diameter, const Time& t) const;
  bool is_inside(const Point_2& p, const Wall_2& wall, const Time& t) const;

  /// The predicates at an instant, in the same arithmetic.
  Instantaneous_traits instantaneous_traits(Instant instant) const {
    return Instantaneous_traits(std::move(instant), arithmetic_);
  }

  /// Traits that decide everything exactly.
  static Linear_kinetic_traits_2 exact() { return Linear_kinetic_traits_2(Arithmetic::exact_only); }

 private:
  Arithmetic arithmetic_ = Arithmetic::filtered;
};

static_assert(ContactKineticTraits_2<Linear_kinetic_traits_2>);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_LINEAR_KINETIC_TRAITS_2_H
