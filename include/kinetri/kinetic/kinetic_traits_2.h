// SPDX-License-Identifier: GPL-3.0-or-later
//
// The concepts KineticTraits_2, what the kinetic triangulation requires of a model of motion;
// BatchKineticTraits_2, several certificates in one call, for speed; WeightedKineticTraits_2,
// points with weights, such as discs; PeriodicKineticTraits_2, points in a periodic box;
// DistanceKineticTraits_2, what ranges and nearest points require; ContactKineticTraits_2, what
// walls and colliding discs require; and PeriodicContactKineticTraits_2, what colliding discs in a
// periodic box require.
#ifndef KINETRI_KINETIC_KINETIC_TRAITS_2_H
#define KINETRI_KINETIC_KINETIC_TRAITS_2_H

#include <array>
#include <concepts>
#include <span>

#include "kinetri/base/ids.h"
#include "kinetri/impl/kinetic/flip_neighborhood.h"
#include "kinetri/kinetic/certificate.h"
#include "kinetri/kinetic/instant.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// A motion whose velocity can be changed: `with_velocity_at(motion, velocity, t)` is the motion
/// from then on, as for Linear_motion_2.
template <class Motion>
concept MotionWithVelocity_2 = requires(const Motion motion, const Vector_2 velocity) {
  { with_velocity_at(motion, velocity, 1.0) } -> std::same_as<Motion>;
};

/// A motion that can be put at rest: `at_rest_in(motion, place)` is the motion whose point, of a
/// disc its center, is at the position at all times, exactly, as for Linear_motion_2.
template <class Motion>
concept MotionWithPosition_2 = requires(const Motion motion, const Vector_2 place) {
  { at_rest_in(motion, place) } -> std::same_as<Motion>;
};

/// What certificates are about: in a periodic box images of points, Traits::Image_2, else points.
template <class Traits>
struct Certified_type {
  using type = typename Traits::Point_2;  ///< points
};
/// The same in a periodic box.
template <class Traits>
requires requires {
  typename Traits::Image_2;
}
struct Certified_type<Traits> {
  using type = typename Traits::Image_2;  ///< images
};
/// The type that Certified_type has.
template <class Traits>
using Certified_point_2 = typename Certified_type<Traits>::type;

/// What the kinetic triangulation requires of a model of motion. The model has these types:
///
/// | Type | What it is |
/// |---|---|
/// | `Motion` | a trajectory, for which there are `is_finite` and `mirrored` |
/// | `Point_2` | a moving point: constructed from a Motion and a Point_id, and returns both |
/// | `Instantaneous_traits` | a model of CGAL's DelaunayTriangulationTraits_2 on `Point_2` |
///
/// (In a periodic box PeriodicKineticTraits_2 has more, and the certificates are about images.)
///
/// `mirrored(motion)` is the motion with -t in place of t. For audits, `point.position(t)` is the
/// position at a Rational time. Times are of type Algebraic_number.
///
/// These functions give certificates from the time `t` on; see Certificate. A certificate may stop
/// short of the failure (Certificate::Kind::holds) if that saves work. For `...` read `t,
/// state`, where `state` is a Certificate_state:
///
/// | Function | Condition |
/// |---|---|
/// | `in_circle_certificate(p, q, r, s, ...)` | s is not inside the circle through p, q, r |
/// | `orientation_certificate(p, q, r, ...)` | p, q, r do not make a right turn |
/// | `flatness_certificate(p, q, r, ...)` | p, q, r make a left turn strictly after t |
/// | `coincidence_certificate(p, q, t, among)` | p and q are apart strictly after t |
///
/// The failure of a flatness certificate is the first time after t at which p, q and r are
/// collinear or make a right turn, and there is none if p, q, r are collinear at all times. The
/// failure of a coincidence certificate is the first time *strictly* after t at which p and q are
/// at one position, and there is none if p and q are at one position at all times. The caller knows
/// that p and q are apart between t and `among.lower`, and ignores failures after `among.upper`. A
/// coincidence certificate never fails, or has Certificate::failure.
///
/// | Function | Result |
/// |---|---|
/// | `in_circle_failure(p, q, r, s, bounds)` | the failure time, from a certificate's bounds |
/// | `orientation_failure(p, q, r, bounds)` | the failure time, from bounds; for flatness too |
/// | `instantaneous_traits(instant)` | the predicates at an instant, in the same arithmetic |
/// | `instantaneous_traits(clock)` | the same at the present instant of an Instant_clock |
/// | `exact()` | these traits in exact arithmetic, for audits |
///
/// The functions `..._failure` are called only for certificates without Certificate::failure.
///
/// In-circle certificates, and CGAL's predicate just before and just after a time, perturb: while
/// four points are cocircular and not collinear, s is inside or outside the circle, as if points
/// were lifted by a little more than x^2 + y^2 (perturbed_in_circle_polynomial). Both must use the
/// same lifting for all points. Then the triangulation is a function of motions and time.
///
/// Several threads use a traits object at once.
template <class Traits>
concept KineticTraits_2 = requires(const Traits traits, const typename Traits::Motion motion,
                                   const typename Traits::Point_2 point,
                                   const Certified_point_2<Traits> p, const Algebraic_number t,
                                   const Double_interval bounds, const Instant instant,
                                   const Instant_clock& clock, Certificate_state state) {
  { traits.instantaneous_traits(instant) } -> std::same_as<typename Traits::Instantaneous_traits>;
  { traits.instantaneous_traits(clock) } -> std::same_as<typename Traits::Instantaneous_traits>;
  { traits.exact() } -> std::same_as<Traits>;
  { mirrored(motion) } -> std::same_as<typename Traits::Motion>;
  { is_finite(motion) } -> std::same_as<bool>;
  { point.id() } -> std::same_as<Point_id>;
  { point.motion() } -> std::convertible_to<typename Traits::Motion>;
  requires std::constructible_from<typename Traits::Point_2, typename Traits::Motion, Point_id>;
  { traits.in_circle_certificate(p, p, p, p, t, state) } -> std::same_as<Certificate>;
  { traits.orientation_certificate(p, p, p, t, state) } -> std::same_as<Certificate>;
  { traits.flatness_certificate(p, p, p, t, state) } -> std::same_as<Certificate>;
  { traits.coincidence_certificate(p, p, t, bounds) } -> std::same_as<Certificate>;
  { traits.in_circle_failure(p, p, p, p, bounds) } -> std::same_as<Algebraic_number>;
  { traits.orientation_failure(p, p, p, bounds) } -> std::same_as<Algebraic_number>;
};

/// Traits that make several certificates in one call, at less cost. The triangulation uses these
/// functions if the traits have them:
///
/// | Function | Result |
/// |---|---|
/// | `in_circle_certificates(two, t)` | the certificates of two quadruples, of any state |
/// | `certificates_after_flip(around, now)` | the five certificates after a flip |
/// | `is_surrounded(p, around, now)` | whether p makes left turns with all points around it |
///
/// The polynomial of the last of the five, the flipped edge, vanishes at the time of the flip,
/// which is within `now`. Each certificate is that of `in_circle_certificate`, or unknown
/// (Certificate::Kind::unknown); the triangulation then calls `in_circle_certificate`.
///
/// `is_surrounded` concerns p and every two successive points of `around`, the last and the first
/// included, throughout `now`. False means unknown.
///
/// `Traits::Batches_of` must be `Traits`. So a derived class, which may redefine
/// `in_circle_certificate`, does not inherit the batches of its base.
template <class Traits>
concept BatchKineticTraits_2 = KineticTraits_2<Traits> &&
    std::same_as<typename Traits::Batches_of, Traits> &&
    requires(const Traits traits, const Algebraic_number t,
             const std::array<Quadruple<Certified_point_2<Traits>>, 2> two,
             const Flip_neighborhood<Certified_point_2<Traits>> around, const Double_interval now,
             const Certified_point_2<Traits> p,
             const std::span<const Certified_point_2<Traits>* const> points) {
  { traits.in_circle_certificates(two, t) } -> std::same_as<std::array<Certificate, 2>>;
  { traits.certificates_after_flip(around, now) } -> std::same_as<std::array<Certificate, 5>>;
  { traits.is_surrounded(p, points, now) } -> std::same_as<bool>;
};

/// Traits of points with weights, such as discs, for regular triangulations. The
/// Instantaneous_traits are a model of CGAL's RegularTriangulationTraits_2 with Weighted_point_2 =
/// Point_2 (Basic_weighted_instantaneous_traits_2), an in-circle certificate concerns the power
/// circle, and two points *coincide* if they have the same position and the same weight. (In a
/// periodic box these functions are about images, as in KineticTraits_2.)
/// `have_equal_weights(motion, motion)` says whether two weights are equal at all times. There are
/// four more certificates, which never stop short of the failure, and have Certificate::failure if
/// they fail:
///
/// | Function | Condition |
/// |---|---|
/// | `segment_certificate(p, q, r, t)` | q is not hidden by p and r |
/// | `hiding_certificate(p, q, r, t)` | q is hidden by p and r |
/// | `weight_certificate(p, q, t)` | the weight of p is not less than that of q |
/// | `meeting_certificate(p, q, t, among)` | p and q have different positions strictly after t |
///
/// An in-circle certificate of points whose weights differ fails at touches as well, with
/// Certificate::failure: a triangle may turn over there, if its corners, lifted, are on one line.
///
/// `certain_turn(p, q, r, now)` is the orientation of the points throughout the interval `now` and
/// just after it, or COLLINEAR if that is not certain; fast.
///
/// The points p, q, r of a segment or hiding certificate are collinear at all times, and q is
/// between p and r; `among` is that of a coincidence certificate. The first holds as long as q is
/// not above the segment from p to r, each lifted by x^2 + y^2 - weight (and a little more, as
/// above, if all three are on one lifted line), the second as long as it is not below.
template <class Traits>
concept WeightedKineticTraits_2 = KineticTraits_2<Traits> &&
    requires(const Traits traits, const Certified_point_2<Traits> p, const Algebraic_number t,
             const typename Traits::Motion motion,
             const typename Traits::Instantaneous_traits at_instant) {
  { traits.segment_certificate(p, p, p, t) } -> std::same_as<Certificate>;
  { traits.hiding_certificate(p, p, p, t) } -> std::same_as<Certificate>;
  { traits.weight_certificate(p, p, t) } -> std::same_as<Certificate>;
  { traits.meeting_certificate(p, p, t, t.interval()) } -> std::same_as<Certificate>;
  { have_equal_weights(motion, motion) } -> std::same_as<bool>;
  { traits.certain_turn(p, p, p, t.interval()) } -> std::same_as<Sign>;
  requires std::same_as<typename Traits::Instantaneous_traits::Weighted_point_2,
                        typename Traits::Point_2>;
  at_instant.power_side_of_oriented_power_circle_2_object();
  at_instant.compare_power_distance_2_object();
};

/// Traits of points in a periodic box, for triangulations of the flat torus, the plane modulo the
/// lattice of the box. Certificates and predicates are about *images* of points, of type Image_2,
/// whose offsets are against the point as it was given; they depend on differences of offsets only.
/// The Instantaneous_traits have `Point_2`, `Image_2`, `image`, and of CGAL's predicates
/// Orientation_2 and Side_of_oriented_circle_2, on images. There is no hull: so flatness
/// certificates are not used, and those of orientation for hidden points only. The triangulation is
/// compiled for Periodic_kinetic_traits_2 and Periodic_disc_kinetic_traits_2: it accepts no others.
///
/// | Function | Result |
/// |---|---|
/// | `image(point, offset)` | that image of the point, valid as long as the traits or a copy |
/// | `box()` | the box |
/// | `mirrored()` | the traits with the mirrored box |
template <class Traits>
concept PeriodicKineticTraits_2 = KineticTraits_2<Traits> &&
    requires(const Traits traits, const typename Traits::Instantaneous_traits at_instant,
             const typename Traits::Point_2 point, const Lattice_offset_2 offset) {
  { traits.image(point, offset) } -> std::same_as<typename Traits::Image_2>;
  { at_instant.image(point, offset) } -> std::same_as<typename Traits::Image_2>;
  { traits.box() } -> std::same_as<const Periodic_box_2&>;
  { traits.mirrored() } -> std::same_as<Traits>;
};

/// Traits of points in the plane, not in a periodic box. What has no meaning in a periodic box, or
/// is not made for one, requires them: so the compiler says it.
template <class Traits>
concept PlanarKineticTraits_2 = KineticTraits_2<Traits> && !PeriodicKineticTraits_2<Traits>;

/// A model of KineticTraits_2 with certificates of distances, which tell which points are near; in
/// a periodic box, which images of points. "At most `range` apart" includes equality. The distance
/// of discs with radii is the gap between their boundaries.
///
/// | Function | Result |
/// |---|---|
/// | `apart_certificate(p, q, range, t)` | fails when they are at most `range` apart |
/// | `next_apart_certificate(p, q, range, t)` | the same for two that separate at t |
/// | `near_certificate(p, q, range, t)` | fails when they are farther apart |
/// | `contact_failure(p, q, range, bounds)` | the failure time of all three, from bounds |
/// | `closer_certificate(p, q, r, s, t)` | fails when pq is longer than rs |
/// | `closer_failure(p, q, r, s, bounds)` | the failure time, from bounds |
/// | `do_touch(p, q, range, t)` | whether their distance at t is at most the range |
///
/// Unlike the others, `apart_certificate` fails as soon as its polynomial is zero, even if only for
/// a moment, and at `t` itself if the two are at most `range` apart at `t`.
/// `next_apart_certificate` is for two that are `range` apart at `t` and farther apart just after
/// it: it fails at the next such time. The others fail at the infimum of the times after t at which
/// their condition is violated. `closer_certificate` ignores radii.
template <class Traits>
concept DistanceKineticTraits_2 = KineticTraits_2<Traits> &&
    requires(const Traits traits, const Certified_point_2<Traits> p, const Algebraic_number t,
             const Double_interval bounds) {
  { traits.apart_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.next_apart_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.near_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.contact_failure(p, p, 1.0, bounds) } -> std::same_as<Algebraic_number>;
  { traits.closer_certificate(p, p, p, p, t) } -> std::same_as<Certificate>;
  { traits.closer_failure(p, p, p, p, bounds) } -> std::same_as<Algebraic_number>;
  { traits.do_touch(p, p, 1.0, t) } -> std::same_as<bool>;
};

/// A model of DistanceKineticTraits_2 with certificates of contacts. A *contact*: two discs, or a
/// point and a wall, touch or overlap *and* approach each other. So the certificate of a contact
/// fails at `t` itself if the two touch or overlap at `t` while they approach; it does not matter
/// on which side of a contact the rounding of a response has put them. A touch without approach is
/// not a contact: for example, two discs pass each other at exactly their diameter.
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
/// | `may_overlap(p, q, diameter, t)` | whether they overlap just after t, or perhaps; fast |
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
/// Responses to contacts need these functions of a motion, with binary64 numbers (see
/// Linear_motion_2): `rounded_place(motion, t)`, `rounded_velocity(motion, t)`,
/// `with_velocity_at(motion, velocity, t)`, `at_rest_at(motion, t)`, `is_at_rest(motion)`, and
/// `clamped_inside(motion, wall, times)`.
template <class Traits>
concept ContactKineticTraits_2 = PlanarKineticTraits_2<Traits> && DistanceKineticTraits_2<Traits> &&
    MotionWithVelocity_2<typename Traits::Motion> &&
    requires(const Traits traits, const typename Traits::Motion motion,
             const typename Traits::Point_2 p, const Algebraic_number t, const Wall_2 wall,
             const Double_interval bounds) {
  { traits.contact_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.next_contact_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.wall_certificate(p, wall, t) } -> std::same_as<Certificate>;
  { traits.wall_failure(p, wall, bounds) } -> std::same_as<Algebraic_number>;
  { traits.do_approach(p, p, t) } -> std::same_as<bool>;
  { traits.has_approach_speed(p, p, t) } -> std::same_as<bool>;
  { traits.has_approach_speed(p, wall, t) } -> std::same_as<bool>;
  { traits.may_overlap(p, p, 1.0, t) } -> std::same_as<bool>;
  { traits.is_inside(p, wall, t) } -> std::same_as<bool>;
  { rounded_place(motion, 1.0) } -> std::same_as<Vector_2>;
  { rounded_velocity(motion, 1.0) } -> std::same_as<Vector_2>;
  { at_rest_at(motion, 1.0) } -> std::same_as<typename Traits::Motion>;
  { is_at_rest(motion) } -> std::same_as<bool>;
  { clamped_inside(motion, wall, bounds) } -> std::same_as<typename Traits::Motion>;
};

/// A model of PeriodicKineticTraits_2 with the certificates and predicates of contacts of two
/// discs, as ContactKineticTraits_2 has them, about images: there are no walls in a periodic box.
/// Two images of one point are discs like others. Responses need the same functions of a motion.
template <class Traits>
concept PeriodicContactKineticTraits_2 = PeriodicKineticTraits_2<Traits> &&
    DistanceKineticTraits_2<Traits> && MotionWithVelocity_2<typename Traits::Motion> &&
    requires(const Traits traits, const typename Traits::Motion motion,
             const typename Traits::Image_2 p, const Algebraic_number t) {
  { traits.contact_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.next_contact_certificate(p, p, 1.0, t) } -> std::same_as<Certificate>;
  { traits.do_approach(p, p, t) } -> std::same_as<bool>;
  { traits.has_approach_speed(p, p, t) } -> std::same_as<bool>;
  { traits.may_overlap(p, p, 1.0, t) } -> std::same_as<bool>;
  { rounded_place(motion, 1.0) } -> std::same_as<Vector_2>;
  { rounded_velocity(motion, 1.0) } -> std::same_as<Vector_2>;
  { at_rest_at(motion, 1.0) } -> std::same_as<typename Traits::Motion>;
  { is_at_rest(motion) } -> std::same_as<bool>;
};

/// What a simulation requires: of motions in the plane, or in a periodic box.
template <class Traits>
concept SimulationKineticTraits_2 =
    ContactKineticTraits_2<Traits> || PeriodicContactKineticTraits_2<Traits>;

}  // namespace kinetri

#endif  // KINETRI_KINETIC_KINETIC_TRAITS_2_H
