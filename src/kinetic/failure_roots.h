// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polynomials of failures that the filter or Sturm counts have bracketed, computed when an
// exact decision needs them.
#ifndef KINETRI_SRC_KINETIC_FAILURE_ROOTS_H
#define KINETRI_SRC_KINETIC_FAILURE_ROOTS_H

#include <array>
#include <concepts>
#include <optional>

#include "filter/disc_filter.h"
#include "filter/precise_filter.h"
#include "filter/weighted_differences.h"
#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "polynomial_on_stack.h"

namespace kinetri {

/// What the motions of a root refer to, which may exist for a shorter time than the root: for
/// images a copy of their box.
template <class Motion>
struct Kept {
  const Motion& operator()(const Motion& motion) const { return motion; }
};
template <class Image>
requires std::same_as<Center_motion_of<Image>, Image_motion_2>
struct Kept<Image> {
  Image operator()(const Image& image) {
    if (image.box == nullptr) return image;
    if (!box) box = *image.box;
    KINETRI_PRECONDITION(*image.box == *box, "the images of a certificate have different boxes");
    Image result = image;
    result.box = &*box;
    return result;
  }
  std::optional<Periodic_box_2> box;
};

template <class Motion>
struct In_circle_root : Root_source {
  using Point = Basic_moving_point_2<Motion>;
  In_circle_root(const Point& a, const Point& b, const Point& c, const Point& d)
      : p(kept(a.motion())), q(kept(b.motion())), r(kept(c.motion())), s(kept(d.motion())) {}
  Polynomial polynomial() const override {
    return perturbed_in_circle_polynomial(Point(p), Point(q), Point(r), Point(s));
  }
  double certain_value_at(double high, double low) const override {
    return precise_in_circle(p, q, r, s, high, low);
  }
  std::optional<Rounding> rounded(const Double_interval& bracket) const override {
    if constexpr (is_linear<Motion>) {
      if constexpr (HasWeight<Motion>) {
        if (!have_same_weight_numbers(std::array{&p, &q, &r, &s})) return std::nullopt;
      }
      return rounded_in_circle(center(p), center(q), center(r), center(s), bracket);
    } else {
      return std::nullopt;
    }
  }
  [[no_unique_address]] Kept<Motion> kept = {};
  Motion p, q, r, s;
};

template <class Motion>
struct Orientation_root : Root_source {
  using Point = Basic_moving_point_2<Motion>;
  Orientation_root(const Point& a, const Point& b, const Point& c)
      : p(kept(a.motion())), q(kept(b.motion())), r(kept(c.motion())) {}
  Polynomial polynomial() const override {
    return orientation_polynomial(Point(p), Point(q), Point(r));
  }
  double certain_value_at(double high, double low) const override {
    return precise_orientation(p, q, r, high, low);
  }
  [[no_unique_address]] Kept<Motion> kept = {};
  Motion p, q, r;
};

template <class Motion>
struct Contact_root : Root_source {
  using Point = Basic_moving_point_2<Motion>;
  Contact_root(const Point& a, const Point& b, double d)
      : p(kept(a.motion())), q(kept(b.motion())), diameter(d) {}
  Polynomial polynomial() const override {
    return contact_polynomial(Point(p), Point(q), diameter);
  }
  double certain_value_at(double high, double low) const override {
    return precise_contact(p, q, diameter, high, low);
  }
  std::optional<Rounding> rounded(const Double_interval& bracket) const override {
    if constexpr (is_linear<Motion>) {
      return rounded_contact(p, q, diameter, bracket);
    } else {
      return std::nullopt;
    }
  }
  [[no_unique_address]] Kept<Motion> kept = {};
  Motion p, q;
  double diameter;
};

template <class Motion>
struct Distance_root : Root_source {
  using Point = Basic_moving_point_2<Motion>;
  Distance_root(const Point& a, const Point& b, const Point& c, const Point& d)
      : p(kept(a.motion())), q(kept(b.motion())), r(kept(c.motion())), s(kept(d.motion())) {}
  Polynomial polynomial() const override {
    return distance_comparison_polynomial(Point(p), Point(q), Point(r), Point(s));
  }
  double certain_value_at(double high, double low) const override {
    return precise_distance_comparison(center(p), center(q), center(r), center(s), high, low);
  }
  std::optional<Rounding> rounded(const Double_interval& bracket) const override {
    if constexpr (is_linear<Motion> && !std::same_as<Center_motion_of<Motion>, Image_motion_2>) {
      return rounded_distance_comparison(center(p), center(q), center(r), center(s), bracket);
    } else {
      return std::nullopt;
    }
  }
  [[no_unique_address]] Kept<Motion> kept = {};
  Motion p, q, r, s;
};

/// For polynomial motion, whose contact times with a wall need not be rational.
template <class Motion>
struct Wall_root : Root_source {
  using Point = Basic_moving_point_2<Motion>;
  Wall_root(const Point& a, const Wall_2& w) : p(a.motion()), wall(w) {}
  Polynomial polynomial() const override { return wall_polynomial(Point(p), wall); }
  Motion p;
  Wall_2 wall;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FAILURE_ROOTS_H
