// SPDX-License-Identifier: GPL-3.0-or-later
//
// Basic_instantaneous_traits_2 for moving points with weights: a model of CGAL's
// RegularTriangulationTraits_2. CGAL::Regular_triangulation_2 on top of it works on discs at one
// instant, which may be one-sided.
#ifndef KINETRI_KINETIC_WEIGHTED_INSTANTANEOUS_TRAITS_2_H
#define KINETRI_KINETIC_WEIGHTED_INSTANTANEOUS_TRAITS_2_H

#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/instantaneous_traits_2.h"

namespace kinetri {

/// The traits: a model of RegularTriangulationTraits_2 too, as CGAL 5.5 to 6.1 document and use it.
/// Weighted_point_2 and Point_2 are the same type; predicates of points without weights ignore the
/// weights. All predicates are exact, with CGAL's signs.
template <HasWeight Motion>
class Basic_weighted_instantaneous_traits_2 : public Basic_instantaneous_traits_2<Motion> {
  using Base = Basic_instantaneous_traits_2<Motion>;
  using Predicate = typename Base::Predicate;

 public:
  using Point_2 = typename Base::Point_2;  ///< a moving point
  using Weighted_point_2 = Point_2;        ///< the same
  /// A radical axis has the positions with equal powers to `first` and `second`; see the base
  /// class.
  using Line_2 = typename Base::Line_2;
  using FT = double;  ///< of weights; CGAL requires the type only

  using Base::Base;

  /// The side of a power circle on which a weighted point is.
  struct Power_side_of_oriented_power_circle_2 : Predicate {
    using Predicate::Predicate;
    /// On which side of the power circle of p, q, r the point s is: the positive one if p, q, r
    /// make a left turn and s, lifted by x^2 + y^2 - weight, is below their plane. Just before and
    /// just after a time see Side_of_oriented_circle_2.
    CGAL::Oriented_side operator()(const Weighted_point_2& p, const Weighted_point_2& q,
                                   const Weighted_point_2& r, const Weighted_point_2& s) const {
      return this->in_circle(p, q, r, s);
    }
    /// The same on the line through p and q: positive if s is below the lifted line. Precondition:
    /// p, q, s are collinear, and p and q do not coincide.
    CGAL::Oriented_side operator()(const Weighted_point_2& p, const Weighted_point_2& q,
                                   const Weighted_point_2& s) const {
      return this->below_segment(p, s, q);
    }
    /// The same at one position: positive if s has the greater weight. Precondition: p and s
    /// coincide.
    CGAL::Oriented_side operator()(const Weighted_point_2& p, const Weighted_point_2& s) const {
      return this->weight_order(s, p);
    }
  };
  /// Compares powers.
  struct Compare_power_distance_2 : Predicate {
    using Predicate::Predicate;
    /// How the power of the position p to q compares with that to r.
    Comparison_result operator()(const Point_2& p, const Weighted_point_2& q,
                                 const Weighted_point_2& r) const {
      return this->power_distance_order(p, q, r);
    }
  };
  /// Compares weights; beyond CGAL's concept.
  struct Compare_weight_2 : Predicate {
    using Predicate::Predicate;
    /// How the weight of p compares with that of q.
    Comparison_result operator()(const Weighted_point_2& p, const Weighted_point_2& q) const {
      return this->weight_order(p, q);
    }
  };

  /// The point itself.
  struct Construct_weighted_point_2 {
    /// p.
    const Weighted_point_2& operator()(const Weighted_point_2& p) const { return p; }
  };
  /// Makes the radical axis of two points.
  struct Construct_radical_axis_2 {
    /// The positions with equal powers to p and q, with p on its left. Precondition: the two do not
    /// coincide.
    Line_2 operator()(const Weighted_point_2& p, const Weighted_point_2& q) const { return {p, q}; }
  };
  /// Makes the center of a power circle.
  struct Construct_weighted_circumcenter_2 {
    /// The position with equal powers to p, q and r, at every time at which they are not collinear.
    /// Precondition: they are not collinear at all times.
    Point_2 operator()(const Weighted_point_2& p, const Weighted_point_2& q,
                       const Weighted_point_2& r) const {
      return Point_2(weighted_circumcenter_trajectory(p, q, r));
    }
  };

  /// @{
  /// The function object of the concept, at the instant of these traits.
  Power_side_of_oriented_power_circle_2 power_side_of_oriented_power_circle_2_object() const {
    return Power_side_of_oriented_power_circle_2(*this);
  }
  Compare_power_distance_2 compare_power_distance_2_object() const {
    return Compare_power_distance_2(*this);
  }
  Compare_weight_2 compare_weight_2_object() const { return Compare_weight_2(*this); }
  Construct_weighted_point_2 construct_weighted_point_2_object() const { return {}; }
  Construct_radical_axis_2 construct_radical_axis_2_object() const { return {}; }
  Construct_weighted_circumcenter_2 construct_weighted_circumcenter_2_object() const { return {}; }
  /// @}
};

/// The traits at an instant of discs whose centers are in linear motion.
using Weighted_instantaneous_traits_2 = Basic_weighted_instantaneous_traits_2<Disc_motion_2>;

}  // namespace kinetri

#endif  // KINETRI_KINETIC_WEIGHTED_INSTANTANEOUS_TRAITS_2_H
