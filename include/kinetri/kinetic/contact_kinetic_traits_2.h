// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concept ContactKineticTraits_2: what walls, colliding discs and ranges require of a model of
// motion, beyond KineticTraits_2.
#ifndef KINETRI_KINETIC_CONTACT_KINETIC_TRAITS_2_H
#define KINETRI_KINETIC_CONTACT_KINETIC_TRAITS_2_H

#include <concepts>

#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// A model of KineticTraits_2 with certificates of contacts and of distances. A *contact*: two
/// discs, or a point and a wall, touch or overlap *and* approach each other. So the certificate of
/// a contact fails at `t` itself if the two touch or overlap at `t` while they approach; it does
/// not matter on which side of a contact the rounding of a response has put them. A touch without
/// approach is not a contact: for example, two discs pass each other at exactly their diameter.
///
/// | Function | Result |
/// |---|---|
/// | `contact_certificate(p, q, diameter, t)` | fails at the contact of the discs about p and q |
/// | `next_contact_certificate(p, q, diameter, t)` | fails at the next contact after they part |
/// | `wall_certificate(p, wall, t)` | fails at the contact of p and the bound of the wall |
/// | `contact_failure(p, q, diameter, bounds)` | the failure time, from a certificate's bounds |
/// | `wall_failure(p, wall, bounds)` | the failure time, from a certificate's bounds |
/// | `do_approach(p, q, t)` | whether the distance of p and q decreases just after t |
/// | `has_approach_speed(p, q, t)` | whether the derivative of their squared distance is negative |
/// | `has_approach_speed(p, wall, t)` | whether p has a velocity at t that is outward |
/// | `do_touch(p, q, diameter, t)` | whether their distance at t is at most the diameter |
/// | `may_overlap(p, q, diameter, t)` | whether it is less just after t; true if unsure; fast |
/// | `is_inside(p, wall, t)` | whether p is on the inner side of the bound at t, or at it |
///
/// Points that are discs themselves (HasWeight) add their radii at each time to `diameter`, which
/// is then usually 0, and to the clearance of a wall with `rim_touches`. They approach if their
/// boundaries do: if the squared distance of p and q minus the square of the sum of diameter and
/// radii decreases. Precondition: the sum of diameter and radii is not negative at the times of
/// interest; the caller checks for radii that reach zero.
///
/// A contact certificate of two discs that are certainly apart just after t has `may_be_zero`
/// unset.
///
/// Only the first contact of a pair matters. For discs that a response has left in contact,
/// `next_contact_certificate` gives the first contact after they have been apart.
///
/// Certificates of distances tell which points are near. "At most `range` apart" includes equality.
/// The distance of discs with radii is the gap between their boundaries.
///
/// | Function | Result |
/// |---|---|
/// | `apart_certificate(p, q, range, t)` | fails when they are at most `range` apart |
/// | `next_apart_certificate(p, q, range, t)` | the same for two that separate at t |
/// | `near_certificate(p, q, range, t)` | fails when they are farther apart |
/// | `contact_failure(p, q, range, bounds)` | the failure time of all three, from bounds |
/// | `closer_certificate(p, q, r, s, t)` | fails when pq is longer than rs |
/// | `closer_failure(p, q, r, s, bounds)` | the failure time, from bounds |
///
/// Unlike the others, `apart_certificate` fails as soon as its polynomial is zero, even if only for
/// a moment, and at `t` itself if the two are at most `range` apart at `t`.
/// `next_apart_certificate` is for two that are `range` apart at `t` and farther apart just after
/// it: it fails at the next such time. The others fail at the infimum of the times after t at which
/// their condition is violated. `closer_certificate` ignores radii.
///
/// Responses to contacts need these functions of a motion, with binary64 numbers (see
/// Linear_motion_2): `rounded_place(motion, t)`, `rounded_velocity(motion, t)`,
/// `with_velocity_at(motion, velocity, t)`, `at_rest_at(motion, t)`, `is_at_rest(motion)`, and
/// `clamped_inside(motion, wall, times)`.
template <class Traits>
concept ContactKineticTraits_2 = KineticTraits_2<Traits> &&
    MotionWithVelocity_2<typename Traits::Motion> &&
    requires(const Traits traits, const typename Traits::Motion motion,
             const typename Traits::Point_2 p, const Algebraic_number t, const Wall_2 wall,
             const Double_interval bounds) {
  { traits.contact_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.next_contact_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.wall_certificate(p, wall, t) } -> std::same_as<Certificate>;
  { traits.contact_failure(p, p, 1.0, bounds) } -> std::same_as<Algebraic_number>;
  { traits.apart_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.next_apart_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.near_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.closer_certificate(p, p, p, p, t) } -> std::same_as<Certificate>;
  { traits.closer_failure(p, p, p, p, bounds) } -> std::same_as<Algebraic_number>;
  { traits.wall_failure(p, wall, bounds) } -> std::same_as<Algebraic_number>;
  { traits.do_approach(p, p, t) } -> std::same_as<bool>;
  { traits.has_approach_speed(p, p, t) } -> std::same_as<bool>;
  { traits.has_approach_speed(p, wall, t) } -> std::same_as<bool>;
  { traits.do_touch(p, p, 1.0, t) } -> std::same_as<bool>;
  { traits.may_overlap(p, p, 1.0, t) } -> std::same_as<bool>;
  { traits.is_inside(p, wall, t) } -> std::same_as<bool>;
  { rounded_place(motion, 1.0) } -> std::same_as<Vector_2>;
  { rounded_velocity(motion, 1.0) } -> std::same_as<Vector_2>;
  { at_rest_at(motion, 1.0) } -> std::same_as<typename Traits::Motion>;
  { is_at_rest(motion) } -> std::same_as<bool>;
  { clamped_inside(motion, wall, bounds) } -> std::same_as<typename Traits::Motion>;
};

}  // namespace kinetri

#endif  // KINETRI_KINETIC_CONTACT_KINETIC_TRAITS_2_H
