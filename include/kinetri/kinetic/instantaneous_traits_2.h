// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model of CGAL's DelaunayTriangulationTraits_2 whose points move and whose predicates are
// evaluated, exactly, at one instant. CGAL::Delaunay_triangulation_2 on top of it inserts, removes,
// locates and dualises moving points as they stand at that instant, one-sided instants included.
#ifndef KINETRI_KINETIC_INSTANTANEOUS_TRAITS_2_H
#define KINETRI_KINETIC_INSTANTANEOUS_TRAITS_2_H

#include <initializer_list>
#include <memory>
#include <utility>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/instant.h"
#include "kinetri/kinetic/moving_point_2.h"

namespace kinetri {

/// Whether decisions are left to floating point where it is certain, or always made exactly. The
/// decisions are the same.
enum class Arithmetic { filtered, exact_only };

/// The traits. Copies share the instant, so that a triangulation, which copies its traits, follows
/// when the instant is set through any copy.
///
/// Predicates are exact at every instant. The constructions give moving points or pairs of them:
/// circumcenter is a point whose coordinates are rational functions of time; a line is the bisector
/// of two points; a ray is a source and a line.
template <class Motion>
class Basic_instantaneous_traits_2 {
 public:
  using Point_2 = Basic_moving_point_2<Motion>;
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
  Basic_instantaneous_traits_2() : Basic_instantaneous_traits_2(Instant{}) {}
  explicit Basic_instantaneous_traits_2(Instant instant,
                                        Arithmetic arithmetic = Arithmetic::filtered)
      : state_(std::make_shared<State>(State{std::move(instant), arithmetic})) {}

  const Instant& instant() const { return state_->instant; }
  /// Moves this object and all its copies to another instant. Cost: none. What was built on the
  /// traits stays right only if no certificate failed on the way.
  void set_instant(Instant instant) const { state_->instant = std::move(instant); }

 private:
  struct State {
    Instant instant;
    Arithmetic arithmetic;
  };

  // Base of the predicates: they read the shared state.
  class Predicate {
   public:
    explicit Predicate(const State& state) : state_(&state) {}

   protected:
    Sign x_order(const Point_2& p, const Point_2& q) const;
    Sign y_order(const Point_2& p, const Point_2& q) const;
    Sign orientation(const Point_2& p, const Point_2& q, const Point_2& r) const;
    Sign in_circle(const Point_2& p, const Point_2& q, const Point_2& r, const Point_2& s) const;
    Sign distance_order(const Point_2& p, const Point_2& q, const Point_2& r) const;
    Sign scalar_product(const Point_2& p, const Point_2& q, const Point_2& r) const;

   private:
    // The interval of the time, if a filter may be asked about these points.
    const Double_interval* filtered_interval(std::initializer_list<const Point_2*> points) const;

    const State* state_;
  };

 public:
  struct Compare_x_2 : Predicate {
    using Predicate::Predicate;
    Comparison_result operator()(const Point_2& p, const Point_2& q) const {
      return this->x_order(p, q);
    }
  };
  struct Compare_y_2 : Predicate {
    using Predicate::Predicate;
    Comparison_result operator()(const Point_2& p, const Point_2& q) const {
      return this->y_order(p, q);
    }
  };
  struct Less_x_2 : Predicate {
    using Predicate::Predicate;
    bool operator()(const Point_2& p, const Point_2& q) const {
      return this->x_order(p, q) == CGAL::NEGATIVE;
    }
  };
  struct Less_y_2 : Predicate {
    using Predicate::Predicate;
    bool operator()(const Point_2& p, const Point_2& q) const {
      return this->y_order(p, q) == CGAL::NEGATIVE;
    }
  };
  struct Orientation_2 : Predicate {
    using Predicate::Predicate;
    CGAL::Orientation operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return this->orientation(p, q, r);
    }
  };
  struct Side_of_oriented_circle_2 : Predicate {
    using Predicate::Predicate;
    CGAL::Oriented_side operator()(const Point_2& p, const Point_2& q, const Point_2& r,
                                   const Point_2& s) const {
      return this->in_circle(p, q, r, s);
    }
  };
  struct Compare_distance_2 : Predicate {
    using Predicate::Predicate;
    Comparison_result operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return this->distance_order(p, q, r);
    }
  };
  /// Whether `q` lies strictly between `p` and `r`. Precondition: the three are collinear at the
  /// instant.
  struct Collinear_are_strictly_ordered_along_line_2 : Predicate {
    using Predicate::Predicate;
    bool operator()(const Point_2& p, const Point_2& q, const Point_2& r) const {
      return this->scalar_product(p, q, r) == CGAL::NEGATIVE;
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

  Compare_x_2 compare_x_2_object() const { return Compare_x_2(*state_); }
  Compare_y_2 compare_y_2_object() const { return Compare_y_2(*state_); }
  Less_x_2 less_x_2_object() const { return Less_x_2(*state_); }
  Less_y_2 less_y_2_object() const { return Less_y_2(*state_); }
  Orientation_2 orientation_2_object() const { return Orientation_2(*state_); }
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const {
    return Side_of_oriented_circle_2(*state_);
  }
  Compare_distance_2 compare_distance_2_object() const { return Compare_distance_2(*state_); }
  Collinear_are_strictly_ordered_along_line_2 collinear_are_strictly_ordered_along_line_2_object()
      const {
    return Collinear_are_strictly_ordered_along_line_2(*state_);
  }
  Construct_point_2 construct_point_2_object() const { return {}; }
  Construct_segment_2 construct_segment_2_object() const { return {}; }
  Construct_triangle_2 construct_triangle_2_object() const { return {}; }
  Construct_bisector_2 construct_bisector_2_object() const { return {}; }
  Construct_ray_2 construct_ray_2_object() const { return {}; }
  Construct_circumcenter_2 construct_circumcenter_2_object() const { return {}; }

 private:
  std::shared_ptr<State> state_;
};

extern template class Basic_instantaneous_traits_2<Linear_motion_2>;
extern template class Basic_instantaneous_traits_2<Polynomial_motion_2>;

using Instantaneous_traits_2 = Basic_instantaneous_traits_2<Linear_motion_2>;

}  // namespace kinetri

#endif  // KINETRI_KINETIC_INSTANTANEOUS_TRAITS_2_H
