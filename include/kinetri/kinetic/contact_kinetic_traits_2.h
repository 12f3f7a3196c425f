// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concept ContactKineticTraits_2: what walls and colliding discs ask of a model of motion,
// beyond KineticTraits_2.
#ifndef KINETRI_KINETIC_CONTACT_KINETIC_TRAITS_2_H
#define KINETRI_KINETIC_CONTACT_KINETIC_TRAITS_2_H

#include <concepts>

#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// A model of KineticTraits_2 with two certificates more, given by their outlooks. They fail at a
/// *contact*: two discs, or a point and a wall, that touch or overlap *and* approach each other. So
/// a certificate fails at `t` itself if the two touch or overlap at `t` while they approach; then
/// it makes no difference on which side of a contact the rounding of a response has put them.
/// A touch without approach (two discs that pass at just the distance of their diameter) is none.
/// For `...` read `t, counters`:
///
/// | Function | Result |
/// |---|---|
/// | `contact_outlook(p, q, diameter, ...)` | of discs about p and q |
/// | `next_contact_outlook(p, q, diameter, ...)` | likewise, once the two have been apart |
/// | `wall_outlook(p, wall, ...)` | of p and the bound of the wall |
/// | `contact_failure(p, q, diameter, bounds)` | the failure time, made from an outlook's bounds |
/// | `wall_failure(p, wall, bounds)` | likewise |
/// | `do_approach(p, q, t)` | whether their distance decreases at t |
/// | `do_overlap(p, q, diameter, t)` | whether their distance at t is at most the diameter |
/// | `is_inside(p, wall, t)` | whether p is on the inner side of the bound at t, or at it |
///
/// Of the contacts of a pair only the first one is of interest. That of `next_contact_outlook` is
/// the first one after the two have been apart once, from t on: for those that a response has left
/// in contact.
///
/// And what responses need of a motion, with binary64 numbers (see Linear_motion_2):
/// `rounded_place(motion, t)`, `rounded_velocity(motion, t)`, `turned(motion, velocity, t)`, and
/// `kept_inside(motion, wall, times)`.
template <class Traits>
concept ContactKineticTraits_2 = KineticTraits_2<Traits> &&
    requires(const Traits traits, const typename Traits::Motion motion,
             const typename Traits::Point_2 p, const typename Traits::Time t, const Wall_2 wall,
             const Vector_2 velocity, const Double_interval bounds,
             Certificate_counters& counters) {
  {
    traits.contact_outlook(p, p, 1.0, t, counters)
    } -> std::same_as<Outlook<typename Traits::Time>>;
  {
    traits.next_contact_outlook(p, p, 1.0, t, counters)
    } -> std::same_as<Outlook<typename Traits::Time>>;
  { traits.wall_outlook(p, wall, t, counters) } -> std::same_as<Outlook<typename Traits::Time>>;
  { traits.contact_failure(p, p, 1.0, bounds) } -> std::same_as<typename Traits::Time>;
  { traits.wall_failure(p, wall, bounds) } -> std::same_as<typename Traits::Time>;
  { traits.do_approach(p, p, t) } -> std::same_as<bool>;
  { traits.do_overlap(p, p, 1.0, t) } -> std::same_as<bool>;
  { traits.is_inside(p, wall, t) } -> std::same_as<bool>;
  { rounded_place(motion, 1.0) } -> std::same_as<Vector_2>;
  { rounded_velocity(motion, 1.0) } -> std::same_as<Vector_2>;
  { turned(motion, velocity, 1.0) } -> std::same_as<typename Traits::Motion>;
  { kept_inside(motion, wall, bounds) } -> std::same_as<typename Traits::Motion>;
};

}  // namespace kinetri

#endif  // KINETRI_KINETIC_CONTACT_KINETIC_TRAITS_2_H
