// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concept KineticTraits_2: what the kinetic triangulation asks of a model of motion.
#ifndef KINETRI_KINETIC_KINETIC_TRAITS_2_H
#define KINETRI_KINETIC_KINETIC_TRAITS_2_H

#include <concepts>
#include <cstdint>
#include <optional>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/instant.h"

namespace kinetri {

/// How many certificates were made, and which stage decided each.
struct Certificate_counters {
  std::uint64_t created = 0;         ///< certificates for which a failure time was asked
  std::uint64_t root_solves = 0;     ///< of these, the ones for which a root was looked for
  std::uint64_t filter_decided = 0;  ///< decided by floating point with a proved error bound
  std::uint64_t exact_decided = 0;   ///< decided by exact arithmetic

  friend bool operator==(const Certificate_counters&, const Certificate_counters&) = default;
};

/// What is known of a certificate from some time on. A certificate of which it is known that it
/// never fails has no outlook.
template <class Time>
struct Outlook {
  Time time;
  bool is_failure = true;  ///< it fails at `time`; else it certainly holds up to and at `time`, and
                           ///< is to be looked at again then
};

/// What is known of the time after which an outlook is asked for.
enum class Certificate_state {
  any,       ///< nothing
  vanishes,  ///< the certificate vanishes at that time, at which its negation has failed: the edge
             ///< has just been flipped
};

/// A model has the types
///
///   Motion                 a trajectory
///   Point_2                a moving point: built from a Motion and a Point_id
///   Time                   an event time; totally ordered, exactly
///   Instantaneous_traits   a model of CGAL's DelaunayTriangulationTraits_2 on Point_2 at an
///   instant
///
/// and three certificates, each given by its outlook from `t` on. The *failure time* is the infimum
/// of the times after `t` at which the certificate is violated: `t` itself if it is violated just
/// after `t`, and none if it is never violated. An outlook may stop short of it where that saves
/// work.
///
///   in_circle_outlook(p, q, r, s, t, state)   s is not inside the circle through p, q, r
///   orientation_outlook(p, q, r, t, state)    p, q, r do not make a right turn
///   coincidence_time(p, q, t)                 the first time *strictly* after t at which p and q
///   are
///                                             in one place; none if they never or always are
template <class Traits>
concept KineticTraits_2 = requires(Traits traits, const Traits const_traits,
                                   const typename Traits::Motion motion,
                                   const typename Traits::Point_2 p, const typename Traits::Time t,
                                   Certificate_state state) {
  typename Traits::Instantaneous_traits;
  requires std::totally_ordered<typename Traits::Time>;
  typename Traits::Point_2;
  requires std::constructible_from<typename Traits::Point_2, typename Traits::Motion, Point_id>;
  {
    traits.in_circle_outlook(p, p, p, p, t, state)
    } -> std::same_as<std::optional<Outlook<typename Traits::Time>>>;
  {
    traits.orientation_outlook(p, p, p, t, state)
    } -> std::same_as<std::optional<Outlook<typename Traits::Time>>>;
  { traits.coincidence_time(p, p, t) } -> std::same_as<std::optional<typename Traits::Time>>;
  { const_traits.counters() } -> std::convertible_to<Certificate_counters>;
};

}  // namespace kinetri

#endif  // KINETRI_KINETIC_KINETIC_TRAITS_2_H
