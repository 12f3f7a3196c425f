// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model of CGAL's DelaunayTriangulationTraits_2 whose points move and whose predicates are
// evaluated, exactly, at one instant. CGAL::Delaunay_triangulation_2 on top of it inserts, removes,
// locates and dualises moving points as they stand at that instant, one-sided instants included.
#ifndef KINETRI_KINETIC_INSTANTANEOUS_TRAITS_2_H
#define KINETRI_KINETIC_INSTANTANEOUS_TRAITS_2_H

#include <memory>
#include <utility>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/instant.h"
#include "kinetri/kinetic/moving_point_2.h"

namespace kinetri {

/// The traits. Copies share the instant, so that a triangulation, which copies its traits, follows
/// when the instant is set through any copy.
///
/// Predicates are exact at every instant. The constructions give moving points or pairs of them:
/// circumcenter is a point whose coordinates are rational functions of time; a line is the bisector
/// of two points; a ray is a source and a line.
class Instantaneous_traits_2 {
 public:
  using Point_2 = Moving_point_2;
  struct Segment_2 {
    Point_2 source;
    Point_2 target;
  };
  struct Triangle_2 {
    Point_2 first;
    Point_2 second;
    Point_2 third;
  };
  /// The points as far from `first` as from `second`, directed so that `first` is on its left.
  struct Line_2 {
    Point_2 first;
    Point_2 second;
  };
  /// From `source` in the direction of `line`, on which the source lies.
  struct Ray_2 {
    Point_2 source;
    Line_2 line;
  };

  /// The instant 0, at it.
  Instantaneous_traits_2() : instant_(std::make_shared<Instant>()) {}
  explicit Instantaneous_traits_2(Instant instant)
      : instant_(std::make_shared<Instant>(std::move(instant))) {}

  const Instant& instant() const { return *instant_; }
  /// Moves this object and all its copies to another instant. Cost: none. What was built on the
  /// traits stays right only if no certificate failed on the way.
  void set_instant(Instant instant) const { *instant_ = std::move(instant); }

  /// Base of the predicates: they read the shared instant.
  class Predicate {
   public:
    explicit Predicate(const Instant& instant) : instant_(&instant) {}

   protected:
    Sign sign(const Polynomial& p) const { return sign_at(p, *instant_); }

   private:
    const Instant* instant_;
  };

  struct Compare_x_2 : Predicate {
    using Predicate::Predicate;
    Comparison_result operator()(const Point_2& p, const Point_2& q) const {
      return sign(x_difference(p, q));
    }
  };
  struct Compare_y_2 : Predicate {
    using Predicate::Predicate;
    Comparison_result operator()(const Point_2& p, const Point_2& q) const {
      return sign(y_difference(p, q));
    }
  };
  struct Less_x_2 : Predicate {
    using Predicate::Predicate;
    bool operator()(const Point_2& p, const Point_2& q) const {
      return sign(x_difference(p, q)) == CGAL::NEGATIVE;
    }
  };
  struct Less_y_2 : Predicate {
    using Predicate::Predicate;
    bool operator()(const Point_2& p, const Point_2& q) const {
      return sign(y_difference(p, q)) == CGAL::NEGATIVE;
    }
  };
  struct Orientation_2 : Predicate {
    using Predicate::Predicate;
    CGAL::Orientation operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return sign(orientation_polynomial(p, q, r));
    }
  };
  struct Side_of_oriented_circle_2 : Predicate {
    using Predicate::Predicate;
    CGAL::Oriented_side operator()(const Point_2& p, const Point_2& q, const Point_2& r,
                                   const Point_2& s) const {
      return sign(in_circle_polynomial(p, q, r, s));
    }
  };
  struct Compare_distance_2 : Predicate {
    using Predicate::Predicate;
    Comparison_result operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return sign(distance_difference(p, q, r));
    }
  };
  /// Whether `q` lies strictly between `p` and `r`. Precondition: the three are collinear at the
  /// instant.
  struct Collinear_are_strictly_ordered_along_line_2 : Predicate {
    using Predicate::Predicate;
    bool operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return sign(scalar_product_polynomial(p, q, r)) == CGAL::NEGATIVE;
    }
  };

  struct Construct_point_2 {
    const Point_2& operator()(const Point_2& p) const { return p; }
  };
  struct Construct_segment_2 {
    Segment_2 operator()(const Point_2& p, const Point_2& q) const { return {p, q}; }
  };
  struct Construct_triangle_2 {
    Triangle_2 operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return {p, q, r};
    }
  };
  struct Construct_bisector_2 {
    Line_2 operator()(const Point_2& p, const Point_2& q) const { return {p, q}; }
  };
  struct Construct_ray_2 {
    Ray_2 operator()(const Point_2& p, const Line_2& l) const { return {p, l}; }
  };
  struct Construct_circumcenter_2 {
    Point_2 operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return Point_2(circumcenter_trajectory(p, q, r));
    }
  };

  Compare_x_2 compare_x_2_object() const { return Compare_x_2(*instant_); }
  Compare_y_2 compare_y_2_object() const { return Compare_y_2(*instant_); }
  Less_x_2 less_x_2_object() const { return Less_x_2(*instant_); }
  Less_y_2 less_y_2_object() const { return Less_y_2(*instant_); }
  Orientation_2 orientation_2_object() const { return Orientation_2(*instant_); }
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const {
    return Side_of_oriented_circle_2(*instant_);
  }
  Compare_distance_2 compare_distance_2_object() const { return Compare_distance_2(*instant_); }
  Collinear_are_strictly_ordered_along_line_2 collinear_are_strictly_ordered_along_line_2_object()
      const {
    return Collinear_are_strictly_ordered_along_line_2(*instant_);
  }
  Construct_point_2 construct_point_2_object() const { return {}; }
  Construct_segment_2 construct_segment_2_object() const { return {}; }
  Construct_triangle_2 construct_triangle_2_object() const { return {}; }
  Construct_bisector_2 construct_bisector_2_object() const { return {}; }
  Construct_ray_2 construct_ray_2_object() const { return {}; }
  Construct_circumcenter_2 construct_circumcenter_2_object() const { return {}; }

 private:
  std::shared_ptr<Instant> instant_;
};

}  // namespace kinetri

#endif  // KINETRI_KINETIC_INSTANTANEOUS_TRAITS_2_H
