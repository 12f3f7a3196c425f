// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models of PeriodicKineticTraits_2: points in linear motion in a periodic box, and discs whose
// centers are.
#ifndef KINETRI_KINETIC_PERIODIC_KINETIC_TRAITS_2_H
#define KINETRI_KINETIC_PERIODIC_KINETIC_TRAITS_2_H

#include <memory>
#include <utility>

#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/kinetic/instantaneous_traits_2.h"
#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/kinetic/periodic_box_2.h"

namespace kinetri {

/// The predicates of images of points, or of discs, at one instant, exact, as those of
/// Basic_instantaneous_traits_2 and Basic_weighted_instantaneous_traits_2.
template <class Motion>
class Basic_periodic_instantaneous_traits_2
    : private Instantaneous_traits_of<Image_motion_of<Motion>> {
  using Base = Instantaneous_traits_of<Image_motion_of<Motion>>;

 public:
  using Point_2 = Basic_moving_point_2<Motion>;                   ///< what vertices store
  using Weighted_point_2 = Point_2;                               ///< the same
  using Image_2 = Basic_moving_point_2<Image_motion_of<Motion>>;  ///< a point with an offset

  /// At time 0 and without a box, for triangulations without points.
  Basic_periodic_instantaneous_traits_2() = default;
  /// In a box, at an instant or at the present instant of a clock, as the base class.
  template <class Instant_or_clock>
  Basic_periodic_instantaneous_traits_2(std::shared_ptr<const Periodic_box_2> box,
                                        Instant_or_clock&& when, Arithmetic arithmetic)
      : Base(std::forward<Instant_or_clock>(when), arithmetic), box_(std::move(box)) {}

  using Base::instant;
  /// @{
  /// The predicate, or the construction, of images.
  using Base::collinear_are_strictly_ordered_along_line_2_object;
  using Base::compare_distance_2_object;
  using Base::compare_x_2_object;
  using Base::compare_y_2_object;
  using Base::construct_circumcenter_2_object;
  using Base::orientation_2_object;
  using Base::side_of_oriented_circle_2_object;
  using typename Base::Orientation_2;
  using typename Base::Side_of_oriented_circle_2;
  /// @}
  /// @{
  /// The same of images of discs.
  auto power_side_of_oriented_power_circle_2_object() const requires HasWeight<Motion> {
    return Base::power_side_of_oriented_power_circle_2_object();
  }
  auto compare_power_distance_2_object() const requires HasWeight<Motion> {
    return Base::compare_power_distance_2_object();
  }
  auto compare_weight_2_object() const requires HasWeight<Motion> {
    return Base::compare_weight_2_object();
  }
  /// @}

  /// The box. Precondition: there is one.
  const Periodic_box_2& box() const { return *box_; }
  /// An image of a point, valid as long as the box.
  Image_2 image(const Point_2& point, const Lattice_offset_2& offset) const {
    return Image_2(image_of(point.motion(), offset, box_.get()), point.id());
  }

 private:
  std::shared_ptr<const Periodic_box_2> box_;
};

/// The traits of points, or of discs, in a periodic box, which may leave it: only their positions
/// modulo the lattice matter. The certificates are those of Basic_kinetic_traits_2, exact, and have
/// the same degrees, since the lattice vectors are linear in time.
template <class MotionType>
class Basic_periodic_kinetic_traits_2
    : private Basic_kinetic_traits_2<Image_motion_of<MotionType>> {
  using Base = Basic_kinetic_traits_2<Image_motion_of<MotionType>>;

 public:
  /// @{
  /// A type of the concept.
  using Motion = MotionType;
  using Point_2 = Basic_moving_point_2<Motion>;
  using Image_2 = typename Base::Point_2;
  using Time = Algebraic_number;
  using Instantaneous_traits = Basic_periodic_instantaneous_traits_2<Motion>;
  using Batches_of = Basic_periodic_kinetic_traits_2;
  /// @}

  /// In this box, with the given arithmetic; the decisions are the same.
  explicit Basic_periodic_kinetic_traits_2(const Periodic_box_2& box,
                                           Arithmetic arithmetic = Arithmetic::filtered)
      : Basic_periodic_kinetic_traits_2(std::make_shared<const Periodic_box_2>(box), arithmetic) {}

  /// The box.
  const Periodic_box_2& box() const { return *box_; }
  /// An image of a point, valid as long as these traits or a copy of them.
  Image_2 image(const Point_2& point, const Lattice_offset_2& offset) const {
    return Image_2(image_of(point.motion(), offset, box_.get()), point.id());
  }

  /// @{
  /// As KineticTraits_2, BatchKineticTraits_2 and DistanceKineticTraits_2 say, of images.
  using Base::apart_certificate;
  using Base::certificates_after_flip;
  using Base::closer_certificate;
  using Base::closer_failure;
  using Base::coincidence_certificate;
  using Base::contact_failure;
  using Base::do_touch;
  using Base::flatness_certificate;
  using Base::in_circle_certificate;
  using Base::in_circle_certificates;
  using Base::in_circle_failure;
  using Base::is_surrounded;
  using Base::near_certificate;
  using Base::next_apart_certificate;
  using Base::orientation_certificate;
  using Base::orientation_failure;
  /// @}

  /// @{
  /// As PeriodicContactKineticTraits_2 says: of two images, the contacts of discs about them.
  using Base::contact_certificate;
  using Base::do_approach;
  using Base::has_approach_speed;
  using Base::may_overlap;
  using Base::next_contact_certificate;
  /// @}

  /// @{
  /// As WeightedKineticTraits_2 says, of images, for motions with weights.
  using Base::certain_turn;
  using Base::hiding_certificate;
  using Base::meeting_certificate;
  using Base::segment_certificate;
  using Base::weight_certificate;
  /// @}

  /// @{
  /// The predicates at an instant, or at the present instant of a clock, in the same arithmetic.
  Instantaneous_traits instantaneous_traits(Instant instant) const {
    return Instantaneous_traits(box_, std::move(instant), arithmetic_);
  }
  Instantaneous_traits instantaneous_traits(const Instant_clock& clock) const {
    return Instantaneous_traits(box_, clock, arithmetic_);
  }
  /// @}

  /// These traits, which decide everything exactly.
  Basic_periodic_kinetic_traits_2 exact() const {
    return Basic_periodic_kinetic_traits_2(box_, Arithmetic::exact_only);
  }
  /// These traits, with the mirrored box.
  Basic_periodic_kinetic_traits_2 mirrored() const {
    return Basic_periodic_kinetic_traits_2(kinetri::mirrored(*box_), arithmetic_);
  }

 private:
  Basic_periodic_kinetic_traits_2(std::shared_ptr<const Periodic_box_2> box, Arithmetic arithmetic)
      : Base(arithmetic), box_(std::move(box)), arithmetic_(arithmetic) {}

  std::shared_ptr<const Periodic_box_2> box_;
  Arithmetic arithmetic_;
};

/// The traits of points in linear motion in a periodic box.
using Periodic_kinetic_traits_2 = Basic_periodic_kinetic_traits_2<Linear_motion_2>;
/// The traits of discs, or other points with weights, in a periodic box, whose centers are in
/// linear motion. A disc does not hide its own images, which have its weight.
using Periodic_disc_kinetic_traits_2 = Basic_periodic_kinetic_traits_2<Disc_motion_2>;

static_assert(PeriodicKineticTraits_2<Periodic_kinetic_traits_2>);
static_assert(BatchKineticTraits_2<Periodic_kinetic_traits_2>);
static_assert(PeriodicContactKineticTraits_2<Periodic_kinetic_traits_2>);
static_assert(!WeightedKineticTraits_2<Periodic_kinetic_traits_2>);
static_assert(PeriodicKineticTraits_2<Periodic_disc_kinetic_traits_2>);
static_assert(BatchKineticTraits_2<Periodic_disc_kinetic_traits_2>);
static_assert(PeriodicContactKineticTraits_2<Periodic_disc_kinetic_traits_2>);
static_assert(WeightedKineticTraits_2<Periodic_disc_kinetic_traits_2>);
static_assert(DistanceKineticTraits_2<Periodic_kinetic_traits_2>);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_PERIODIC_KINETIC_TRAITS_2_H
