// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models of KineticTraits_2: points in linear motion, the default; points whose coordinates are
// polynomials of degree at most 3 in time; and discs whose centers move in either way.
#ifndef KINETRI_KINETIC_BASIC_KINETIC_TRAITS_2_H
#define KINETRI_KINETIC_BASIC_KINETIC_TRAITS_2_H

#include <array>
#include <optional>
#include <span>
#include <utility>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/instantaneous_traits_2.h"
#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri {

/// The predicates at an instant of one kind of motion; with weights, also those of regular
/// triangulations.
template <class Motion>
struct Instantaneous_traits_type {
  using type = Basic_instantaneous_traits_2<Motion>;  ///< without weights
};
/// The same for motions with weights.
template <HasWeight Motion>
struct Instantaneous_traits_type<Motion> {
  using type = Basic_weighted_instantaneous_traits_2<Motion>;  ///< with weights
};
/// The type that Instantaneous_traits_type has.
template <class Motion>
using Instantaneous_traits_of = typename Instantaneous_traits_type<Motion>::type;

/// Certificates of one kind of motion; see KineticTraits_2 for their contracts. With motions of
/// degree d (linear: 1, polynomial: at most 3) they are polynomials in time: in-circle of degree at
/// most 4d, orientation 2d, coincidence d; of discs, coincidence 2d at most. Every failure time is
/// exact. Cost: some hundred floating-point operations (polynomial: a thousand) if the filter
/// (src/kinetic/filter) decides, else exact arithmetic, which costs about a thousand times as much.
template <class MotionType>
class Basic_kinetic_traits_2 {
 public:
  /// @{
  /// A type of the concept.
  using Motion = MotionType;
  using Point_2 = Basic_moving_point_2<Motion>;
  using Time = Algebraic_number;
  using Instantaneous_traits = Instantaneous_traits_of<Motion>;
  /// @}

  /// Traits with the filter.
  Basic_kinetic_traits_2() = default;
  /// Traits with the given arithmetic; the decisions are the same.
  explicit Basic_kinetic_traits_2(Arithmetic arithmetic) : arithmetic_(arithmetic) {}

  /// @{
  /// As KineticTraits_2 says. The failure time of a coincidence certificate of linear motions is
  /// rational. In-circle and coincidence certificates of discs are as WeightedKineticTraits_2 says.
  Certificate in_circle_certificate(const Point_2& p, const Point_2& q, const Point_2& r,
                                    const Point_2& s, const Time& t, Certificate_state state) const;
  Certificate orientation_certificate(const Point_2& p, const Point_2& q, const Point_2& r,
                                      const Time& t, Certificate_state state) const;
  Certificate flatness_certificate(const Point_2& p, const Point_2& q, const Point_2& r,
                                   const Time& t, Certificate_state state) const;
  Certificate coincidence_certificate(const Point_2& p, const Point_2& q, const Time& t,
                                      const Double_interval& among) const;
  Time in_circle_failure(const Point_2& p, const Point_2& q, const Point_2& r, const Point_2& s,
                         const Double_interval& bounds) const;
  Time orientation_failure(const Point_2& p, const Point_2& q, const Point_2& r,
                           const Double_interval& bounds) const;
  /// @}

  /// @{
  /// As BatchKineticTraits_2 says.
  using Batches_of = Basic_kinetic_traits_2;
  std::array<Certificate, 2> in_circle_certificates(
      const std::array<Quadruple<Point_2>, 2>& certificates, const Time& t) const;
  std::array<Certificate, 5> certificates_after_flip(const Flip_neighborhood<Point_2>& around,
                                                     const Double_interval& now) const;
  bool is_surrounded(const Point_2& p, std::span<const Point_2* const> around,
                     const Double_interval& now) const;
  /// @}

  /// @{
  /// As WeightedKineticTraits_2 says, for motions with weights. Polynomials of degree 4d (segment,
  /// hiding), 2 (weight) and d (meeting).
  Certificate segment_certificate(const Point_2& p, const Point_2& q, const Point_2& r,
                                  const Time& t) const requires HasWeight<Motion>;
  Certificate hiding_certificate(const Point_2& p, const Point_2& q, const Point_2& r,
                                 const Time& t) const requires HasWeight<Motion>;
  Certificate weight_certificate(const Point_2& p, const Point_2& q,
                                 const Time& t) const requires HasWeight<Motion>;
  Certificate meeting_certificate(const Point_2& p, const Point_2& q, const Time& t,
                                  const Double_interval& among) const requires HasWeight<Motion>;
  Sign certain_turn(const Point_2& p, const Point_2& q, const Point_2& r,
                    const Double_interval& now) const requires HasWeight<Motion>;
  /// @}

  /// @{
  /// As ContactKineticTraits_2 says. Polynomials of degree 2d (discs, distances) and d (walls).
  Certificate contact_certificate(const Point_2& p, const Point_2& q, double diameter,
                                  const Time& t) const;
  Certificate next_contact_certificate(const Point_2& p, const Point_2& q, double diameter,
                                       const Time& t) const;
  Certificate wall_certificate(const Point_2& p, const Wall_2& wall, const Time& t) const;
  Time contact_failure(const Point_2& p, const Point_2& q, double diameter,
                       const Double_interval& bounds) const;
  Time wall_failure(const Point_2& p, const Wall_2& wall, const Double_interval& bounds) const;
  Certificate apart_certificate(const Point_2& p, const Point_2& q, double range,
                                const Time& t) const;
  Certificate next_apart_certificate(const Point_2& p, const Point_2& q, double range,
                                     const Time& t) const;
  Certificate near_certificate(const Point_2& p, const Point_2& q, double range,
                               const Time& t) const;
  Certificate closer_certificate(const Point_2& p, const Point_2& q, const Point_2& r,
                                 const Point_2& s, const Time& t) const;
  Time closer_failure(const Point_2& p, const Point_2& q, const Point_2& r, const Point_2& s,
                      const Double_interval& bounds) const;
  bool do_approach(const Point_2& p, const Point_2& q, const Time& t) const;
  bool has_approach_speed(const Point_2& p, const Point_2& q, const Time& t) const;
  bool has_approach_speed(const Point_2& p, const Wall_2& wall, const Time& t) const;
  bool do_touch(const Point_2& p, const Point_2& q, double diameter, const Time& t) const;
  bool may_overlap(const Point_2& p, const Point_2& q, double diameter, const Time& t) const;
  bool is_inside(const Point_2& p, const Wall_2& wall, const Time& t) const;
  /// @}

  /// @{
  /// The predicates at an instant, or at the instant of a clock, in the same arithmetic.
  Instantaneous_traits instantaneous_traits(Instant instant) const {
    return Instantaneous_traits(std::move(instant), arithmetic_);
  }
  Instantaneous_traits instantaneous_traits(const Instant_clock& clock) const {
    return Instantaneous_traits(clock, arithmetic_);
  }
  /// @}

  /// Traits that decide everything exactly.
  static Basic_kinetic_traits_2 exact() { return Basic_kinetic_traits_2(Arithmetic::exact_only); }

 private:
  std::optional<Certificate> filtered_orientation(const Point_2& p, const Point_2& q,
                                                  const Point_2& r, const Time& t,
                                                  Certificate_state state) const;

  Arithmetic arithmetic_ = Arithmetic::filtered;
};

extern template class Basic_kinetic_traits_2<Linear_motion_2>;
extern template class Basic_kinetic_traits_2<Polynomial_motion_2>;
extern template class Basic_kinetic_traits_2<Disc_motion_2>;
extern template class Basic_kinetic_traits_2<Polynomial_disc_motion_2>;

/// The traits of points in linear motion.
using Linear_kinetic_traits_2 = Basic_kinetic_traits_2<Linear_motion_2>;
/// The traits of points that accelerate; linear ones may be among them, at more cost.
using Polynomial_kinetic_traits_2 = Basic_kinetic_traits_2<Polynomial_motion_2>;
/// The traits of discs, or other points with weights, whose centers are in linear motion.
using Disc_kinetic_traits_2 = Basic_kinetic_traits_2<Disc_motion_2>;
/// The traits of discs whose centers accelerate; linear ones may be among them, at more cost.
using Polynomial_disc_kinetic_traits_2 = Basic_kinetic_traits_2<Polynomial_disc_motion_2>;

static_assert(ContactKineticTraits_2<Linear_kinetic_traits_2>);
static_assert(ContactKineticTraits_2<Polynomial_kinetic_traits_2>);
static_assert(ContactKineticTraits_2<Disc_kinetic_traits_2>);
static_assert(ContactKineticTraits_2<Polynomial_disc_kinetic_traits_2>);
static_assert(BatchKineticTraits_2<Linear_kinetic_traits_2>);
static_assert(BatchKineticTraits_2<Polynomial_kinetic_traits_2>);
static_assert(BatchKineticTraits_2<Disc_kinetic_traits_2>);
static_assert(BatchKineticTraits_2<Polynomial_disc_kinetic_traits_2>);
static_assert(WeightedKineticTraits_2<Disc_kinetic_traits_2>);
static_assert(WeightedKineticTraits_2<Polynomial_disc_kinetic_traits_2>);
static_assert(!WeightedKineticTraits_2<Linear_kinetic_traits_2>);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_BASIC_KINETIC_TRAITS_2_H
