// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concept KineticTraits_2: what the kinetic triangulation asks of a model of motion.
#ifndef KINETRI_KINETIC_KINETIC_TRAITS_2_H
#define KINETRI_KINETIC_KINETIC_TRAITS_2_H

#include <array>
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/flip_neighborhood.h"
#include "kinetri/kinetic/instant.h"

namespace kinetri {

/// How many certificates were made, and which stage decided each.
struct Certificate_counters {
  std::uint64_t created = 0;          ///< certificates for which a failure time was asked
  std::uint64_t root_solves = 0;      ///< of these, the ones for which a root was looked for
  std::uint64_t filter_decided = 0;   ///< decided by floating point with a proved error bound
  std::uint64_t refined_decided = 0;  ///< of these, where it had to subdivide or to narrow a root
  std::uint64_t exact_decided = 0;    ///< decided by exact arithmetic

  /// Adds the counts of `other`.
  Certificate_counters& operator+=(const Certificate_counters& other);

  friend bool operator==(const Certificate_counters&, const Certificate_counters&) = default;
};

inline Certificate_counters& Certificate_counters::operator+=(const Certificate_counters& other) {
  created += other.created;
  root_solves += other.root_solves;
  filter_decided += other.filter_decided;
  refined_decided += other.refined_decided;
  exact_decided += other.exact_decided;
  return *this;
}

/// What is known of a certificate from some time on.
template <class Time>
struct Outlook {
  /// How much is known.
  enum class Kind : std::uint8_t {
    holds_for_ever,  ///< it never fails
    holds,           ///< it certainly holds up to and at the binary64 number bounds.lower, which is
                     ///< bounds.upper, and is to be looked at again then
    fails,           ///< it fails, at a time within `bounds`
    unknown,         ///< floating point does not decide; only of outlooks_after_flip
  };
  Kind kind = Kind::holds_for_ever;  ///< how much is known
  Double_interval bounds = {};       ///< of `holds` and `fails`
  /// The time of the failure, where it had to be made already. Else the certificate changes its
  /// sign there, and has no other root within `bounds`.
  std::unique_ptr<Time> failure = nullptr;
  /// Else the certificate is certainly positive from just after then on until it fails.
  bool may_vanish = false;
};

/// What is known of the time after which an outlook is asked for.
enum class Certificate_state {
  any,       ///< nothing
  vanishes,  ///< the certificate vanishes at that time, at which its negation has failed: the edge
             ///< has just been flipped
};

/// What the kinetic triangulation asks of a model of motion. It has these types:
///
/// | Type | What it is |
/// |---|---|
/// | `Motion` | a trajectory, for which there are `is_finite` and `mirrored` |
/// | `Point_2` | a moving point: made of a Motion and a Point_id, and gives both back |
/// | `Time` | an event time |
/// | `Instantaneous_traits` | a model of CGAL's DelaunayTriangulationTraits_2 on `Point_2` |
///
/// `mirrored(motion)` is the one with -t in place of t. A `Time` is totally ordered, exactly, and
/// made from a binary64 number; it has a negative, a binary64 `interval()` around it, and
/// `detached()`, the same time for use in another thread. An Instant holds it: so far it is
/// Algebraic_number. The place of a `Point_2` at a Rational time, by `position`, is for audits.
///
/// A certificate is given by its outlook from `t` on, and counted in `counters`. The *failure time*
/// is the infimum of the times after `t` at which the certificate is violated: `t` itself if it is
/// violated just after `t`, and none if it is never violated. It is exact. An outlook may stop
/// short of it where that saves work. For `...` read `t, state, counters`:
///
/// | Function | Certificate |
/// |---|---|
/// | `in_circle_outlook(p, q, r, s, ...)` | s is not inside the circle through p, q, r |
/// | `orientation_outlook(p, q, r, ...)` | p, q, r do not make a right turn |
/// | `flatness_outlook(p, q, r, ...)` | likewise, and strictly after t they are not collinear |
/// | `in_circle_outlooks(two, t, counters)` | two in-circle ones, of unknown state |
/// | `outlooks_after_flip(around, now, counters)` | the five in-circle ones after a flip |
///
/// After a flip the certificate of the flipped edge, the last one, vanishes at that time, of which
/// only an interval `now` is given: an outlook that asks for more is unknown, and not counted.
///
/// | Function | Result |
/// |---|---|
/// | `in_circle_failure(p, q, r, s, bounds)` | the failure time, made from an outlook's bounds |
/// | `orientation_failure(p, q, r, bounds)` | likewise, also of flatness; both are seldom needed |
/// | `coincidence_time(p, q, t, among, counters)` | when p and q are in one place |
/// | `instantaneous_traits(instant)` | the predicates at an instant, decided by the same means |
/// | `exact()` | these traits, but deciding everything exactly; for audits |
///
/// `coincidence_time` is the first time *strictly* after t at which p and q are in one place; none
/// if they never or always are. There is none before among.lower, and one after among.upper is of
/// no interest.
///
/// A traits object is used from several threads at once.
template <class Traits>
concept KineticTraits_2 = requires(const Traits traits, const typename Traits::Motion motion,
                                   const typename Traits::Point_2 p, const typename Traits::Time t,
                                   const std::array<Quadruple<typename Traits::Point_2>, 2> two,
                                   const Flip_neighborhood<typename Traits::Point_2> around,
                                   const Double_interval bounds, const Instant instant,
                                   Certificate_state state, Certificate_counters& counters) {
  { traits.instantaneous_traits(instant) } -> std::same_as<typename Traits::Instantaneous_traits>;
  { traits.exact() } -> std::same_as<Traits>;
  requires std::totally_ordered<typename Traits::Time>;
  requires std::constructible_from<typename Traits::Time, double>;
  { t.interval() } -> std::convertible_to<Double_interval>;
  { t.detached() } -> std::same_as<typename Traits::Time>;
  { -t } -> std::same_as<typename Traits::Time>;
  { mirrored(motion) } -> std::same_as<typename Traits::Motion>;
  { is_finite(motion) } -> std::same_as<bool>;
  { p.id() } -> std::same_as<Point_id>;
  { p.motion() } -> std::convertible_to<typename Traits::Motion>;
  requires std::constructible_from<typename Traits::Point_2, typename Traits::Motion, Point_id>;
  {
    traits.in_circle_outlook(p, p, p, p, t, state, counters)
    } -> std::same_as<Outlook<typename Traits::Time>>;
  {
    traits.orientation_outlook(p, p, p, t, state, counters)
    } -> std::same_as<Outlook<typename Traits::Time>>;
  {
    traits.flatness_outlook(p, p, p, t, state, counters)
    } -> std::same_as<Outlook<typename Traits::Time>>;
  {
    traits.in_circle_outlooks(two, t, counters)
    } -> std::same_as<std::array<Outlook<typename Traits::Time>, 2>>;
  {
    traits.outlooks_after_flip(around, bounds, counters)
    } -> std::same_as<std::array<Outlook<typename Traits::Time>, 5>>;
  { traits.in_circle_failure(p, p, p, p, bounds) } -> std::same_as<typename Traits::Time>;
  { traits.orientation_failure(p, p, p, bounds) } -> std::same_as<typename Traits::Time>;
  {
    traits.coincidence_time(p, p, t, bounds, counters)
    } -> std::same_as<std::optional<typename Traits::Time>>;
};

}  // namespace kinetri

#endif  // KINETRI_KINETIC_KINETIC_TRAITS_2_H
