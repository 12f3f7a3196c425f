// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model of CGAL's TriangulationTraits_2 and DelaunayTriangulationTraits_2 whose points move and
// whose predicates are evaluated, exactly, at one instant. CGAL::Delaunay_triangulation_2 on top of
// it works on the points at that instant, which may be one-sided. The same for points with weights
// and CGAL::Regular_triangulation_2.
#ifndef KINETRI_KINETIC_INSTANTANEOUS_TRAITS_2_H
#define KINETRI_KINETIC_INSTANTANEOUS_TRAITS_2_H

#include <memory>
#include <utility>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/instant.h"
#include "kinetri/kinetic/moving_point_2.h"

namespace kinetri {

/// How predicates and certificates are computed. The results are the same.
enum class Arithmetic {
  filtered,    ///< floating point, and exact arithmetic if that does not decide
  exact_only,  ///< exact arithmetic only: slow, for tests and audits
};

template <HasWeight Motion>
class Basic_weighted_instantaneous_traits_2;

/// The traits: a model of TriangulationTraits_2 and DelaunayTriangulationTraits_2, as CGAL 5.5 to
/// 6.2 document and use them. Their instant is fixed, or that of a clock; copies, also those in a
/// triangulation, share it. Several threads may use the traits and their copies at once, but not
/// while one sets the clock.
///
/// Predicates are exact at every instant. The constructions give moving points or pairs of them: a
/// circumcenter is a point whose coordinates are rational functions of time; a line is the bisector
/// of two points; a ray is a source and a line. A predicate is valid as long as the traits, a copy
/// of them or the clock exists. Cost of a predicate: tens to hundreds of floating-point operations
/// if the filter decides, else the signs of one polynomial (certificate_polynomials.h) at the
/// instant.
template <class Motion>
class Basic_instantaneous_traits_2 {
 public:
  using Point_2 = Basic_moving_point_2<Motion>;  ///< the points
  /// The segment between two moving points.
  struct Segment_2 {
    Point_2 source;  ///< where it begins
    Point_2 target;  ///< where it ends
  };
  /// The triangle of three moving points, in the order in which they were given.
  struct Triangle_2 {
    Point_2 first;   ///< a corner
    Point_2 second;  ///< the next one
    Point_2 third;   ///< and the last one
  };
  /// The points as far from `first` as from `second`, directed so that `first` is on its left.
  struct Line_2 {
    Point_2 first;   ///< to the left of the line
    Point_2 second;  ///< to the right of it
  };
  /// From `source` in the direction of `line`, on which the source lies.
  struct Ray_2 {
    Point_2 source;  ///< where it begins
    Line_2 line;     ///< where it goes
  };

  /// At time 0.
  Basic_instantaneous_traits_2() : Basic_instantaneous_traits_2(Instant{}) {}
  /// At the given instant, in the given arithmetic.
  explicit Basic_instantaneous_traits_2(Instant instant,
                                        Arithmetic arithmetic = Arithmetic::filtered)
      : instant_(std::make_shared<const Instant>(std::move(instant))), arithmetic_(arithmetic) {}
  /// At the present instant of the clock, also after it changes. The traits may outlive the clock.
  explicit Basic_instantaneous_traits_2(const Instant_clock& clock,
                                        Arithmetic arithmetic = Arithmetic::filtered)
      : instant_(clock.shared_instant()), arithmetic_(arithmetic) {}

  /// The instant of the predicates.
  const Instant& instant() const { return *instant_; }

 private:
  template <HasWeight MotionWithWeight>
  friend class Basic_weighted_instantaneous_traits_2;

  // Base of the predicates: they read the shared instant.
  class Predicate {
   public:
    explicit Predicate(const Basic_instantaneous_traits_2& traits)
        : instant_(traits.instant_.get()), arithmetic_(traits.arithmetic_) {}

   protected:
    Sign x_order(const Point_2& p, const Point_2& q) const;
    Sign y_order(const Point_2& p, const Point_2& q) const;
    Sign orientation(const Point_2& p, const Point_2& q, const Point_2& r) const;
    Sign in_circle(const Point_2& p, const Point_2& q, const Point_2& r, const Point_2& s) const;
    Sign distance_order(const Point_2& p, const Point_2& q, const Point_2& r) const;
    Sign scalar_product(const Point_2& p, const Point_2& q, const Point_2& r) const;
    Sign weight_order(const Point_2& p, const Point_2& q) const;
    Sign power_distance_order(const Point_2& p, const Point_2& q, const Point_2& r) const;
    Sign below_segment(const Point_2& p, const Point_2& q, const Point_2& r) const;

   private:
    // The sign that `filter` computes from the motions of the points or, if it does not know, that
    // of the polynomial that `formula` computes from their trajectories.
    template <class Filter, class Formula, class... Points>
    Sign sign(const Filter& filter, const Formula& formula, const Points&... points) const;
    template <class Filter, class Formula, class... Points>
    Sign lifted_sign(const Filter& filter, const Formula& formula, const Points&... points) const;

    const Instant* instant_;
    Arithmetic arithmetic_;
  };

 public:
  /// Compares x coordinates.
  struct Compare_x_2 : Predicate {
    using Predicate::Predicate;
    /// How x(p) compares with x(q).
    Comparison_result operator()(const Point_2& p, const Point_2& q) const {
      return this->x_order(p, q);
    }
  };
  /// Compares y coordinates.
  struct Compare_y_2 : Predicate {
    using Predicate::Predicate;
    /// How y(p) compares with y(q).
    Comparison_result operator()(const Point_2& p, const Point_2& q) const {
      return this->y_order(p, q);
    }
  };
  /// Compares points lexicographically.
  struct Compare_xy_2 : Predicate {
    using Predicate::Predicate;
    /// How x(p) compares with x(q) or, if they are equal, y(p) with y(q).
    Comparison_result operator()(const Point_2& p, const Point_2& q) const {
      const Sign s = this->x_order(p, q);
      return s != CGAL::ZERO ? s : this->y_order(p, q);
    }
  };
  /// Compares positions.
  struct Equal_2 : Predicate {
    using Predicate::Predicate;
    /// Whether p and q coincide.
    bool operator()(const Point_2& p, const Point_2& q) const {
      return this->x_order(p, q) == CGAL::ZERO && this->y_order(p, q) == CGAL::ZERO;
    }
  };
  /// Orders points by x.
  struct Less_x_2 : Predicate {
    using Predicate::Predicate;
    /// Whether x(p) < x(q).
    bool operator()(const Point_2& p, const Point_2& q) const {
      return this->x_order(p, q) == CGAL::NEGATIVE;
    }
  };
  /// Orders points by y.
  struct Less_y_2 : Predicate {
    using Predicate::Predicate;
    /// Whether y(p) < y(q).
    bool operator()(const Point_2& p, const Point_2& q) const {
      return this->y_order(p, q) == CGAL::NEGATIVE;
    }
  };
  /// The orientation of three points.
  struct Orientation_2 : Predicate {
    using Predicate::Predicate;
    /// Whether p, q, r make a left turn, a right turn, or are collinear.
    CGAL::Orientation operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return this->orientation(p, q, r);
    }
  };
  /// The side of a circle on which a point is.
  struct Side_of_oriented_circle_2 : Predicate {
    using Predicate::Predicate;
    /// On which side of the circle through p, q, r the point s is: the positive one is to the left
    /// of the circle as it goes from p to q to r. If all four are collinear, s is on the boundary.
    /// With weights the circle is the power circle (in_circle_polynomial). Just before and just
    /// after a time the sign is that of perturbed_in_circle_polynomial: s is on the boundary only
    /// if all four are collinear, or two are the same.
    CGAL::Oriented_side operator()(const Point_2& p, const Point_2& q, const Point_2& r,
                                   const Point_2& s) const {
      return this->in_circle(p, q, r, s);
    }
  };
  /// Compares distances from a point.
  struct Compare_distance_2 : Predicate {
    using Predicate::Predicate;
    /// How the distance from p to q compares with that from p to r.
    Comparison_result operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return this->distance_order(p, q, r);
    }
  };
  /// Whether `q` lies strictly between `p` and `r`. Precondition: the three are collinear at the
  /// instant.
  struct Collinear_are_strictly_ordered_along_line_2 : Predicate {
    using Predicate::Predicate;
    /// Whether the scalar product of the vectors from q to the other two is negative.
    bool operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return this->scalar_product(p, q, r) == CGAL::NEGATIVE;
    }
  };

  /// The point itself.
  struct Construct_point_2 {
    /// p.
    const Point_2& operator()(const Point_2& p) const { return p; }
  };
  /// Makes a segment.
  struct Construct_segment_2 {
    /// From p to q.
    Segment_2 operator()(const Point_2& p, const Point_2& q) const { return {p, q}; }
  };
  /// Makes a triangle.
  struct Construct_triangle_2 {
    /// With the corners p, q, r.
    Triangle_2 operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return {p, q, r};
    }
  };
  /// Makes the bisector of two points.
  struct Construct_bisector_2 {
    /// With p on its left. Precondition: the two do not coincide.
    Line_2 operator()(const Point_2& p, const Point_2& q) const { return {p, q}; }
  };
  /// Makes a ray.
  struct Construct_ray_2 {
    /// From p in the direction of l. Precondition: p lies on l.
    Ray_2 operator()(const Point_2& p, const Line_2& l) const { return {p, l}; }
  };
  /// Makes the center of a circle.
  struct Construct_circumcenter_2 {
    /// The center of the circle through p, q, r, at every time at which they are not collinear.
    /// Precondition: they are not collinear at all times.
    Point_2 operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return Point_2(circumcenter_trajectory(p, q, r));
    }
  };

  /// @{
  /// The function object of the concept, at the instant of these traits.
  Compare_x_2 compare_x_2_object() const { return Compare_x_2(*this); }
  Compare_y_2 compare_y_2_object() const { return Compare_y_2(*this); }
  Compare_xy_2 compare_xy_2_object() const { return Compare_xy_2(*this); }
  Equal_2 equal_2_object() const { return Equal_2(*this); }
  Less_x_2 less_x_2_object() const { return Less_x_2(*this); }
  Less_y_2 less_y_2_object() const { return Less_y_2(*this); }
  Orientation_2 orientation_2_object() const { return Orientation_2(*this); }
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const {
    return Side_of_oriented_circle_2(*this);
  }
  Compare_distance_2 compare_distance_2_object() const { return Compare_distance_2(*this); }
  Collinear_are_strictly_ordered_along_line_2 collinear_are_strictly_ordered_along_line_2_object()
      const {
    return Collinear_are_strictly_ordered_along_line_2(*this);
  }
  Construct_point_2 construct_point_2_object() const { return {}; }
  Construct_segment_2 construct_segment_2_object() const { return {}; }
  Construct_triangle_2 construct_triangle_2_object() const { return {}; }
  Construct_bisector_2 construct_bisector_2_object() const { return {}; }
  Construct_ray_2 construct_ray_2_object() const { return {}; }
  Construct_circumcenter_2 construct_circumcenter_2_object() const { return {}; }
  /// @}

 private:
  std::shared_ptr<const Instant> instant_;
  Arithmetic arithmetic_;
};

extern template class Basic_instantaneous_traits_2<Linear_motion_2>;
extern template class Basic_instantaneous_traits_2<Polynomial_motion_2>;
extern template class Basic_instantaneous_traits_2<Disc_motion_2>;
extern template class Basic_instantaneous_traits_2<Polynomial_disc_motion_2>;

/// The traits at an instant of points in linear motion.
using Instantaneous_traits_2 = Basic_instantaneous_traits_2<Linear_motion_2>;

/// The traits: a model of RegularTriangulationTraits_2 too, as CGAL 5.5 to 6.2 document and use it.
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

#endif  // KINETRI_KINETIC_INSTANTANEOUS_TRAITS_2_H
