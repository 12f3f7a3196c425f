// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of points in periodic boxes for which the filter's certificates are difficult, and what
// their polynomials are by definition, in rational arithmetic.
#ifndef KINETRI_TEST_SUPPORT_IMAGES_H
#define KINETRI_TEST_SUPPORT_IMAGES_H

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "kinetri/kinetic/image_motion_2.h"
#include "support/motions.h"

namespace kinetri::test {

/// The position of an image at time `t`, by its definition.
inline Static_point place_at(const Image_motion_2& image, const Rational& t) {
  const Static_point point = place_at(image.motion, t);
  Rational x = point.x();
  Rational y = point.y();
  const auto add = [&](std::int32_t times, const Linear_motion_2& vector) {
    const Static_point there = place_at(vector, t);
    x += times * there.x();
    y += times * there.y();
  };
  if (image.offset.x != 0) add(image.offset.x, image.box->first());
  if (image.offset.y != 0) add(image.offset.y, image.box->second());
  return {x, y};
}

/// The trajectories of images as polynomials with integer coefficients, times a common positive
/// number: the line through the positions at the times 0 and 1.
template <std::size_t N>
std::array<std::array<Polynomial, 2>, N> paths_of(const std::array<Image_motion_2, N>& images) {
  std::array<std::array<std::array<Rational, 2>, 2>, N> coefficients;
  Integer denominator_of_all = 1;
  for (std::size_t i = 0; i < N; ++i) {
    const Static_point at_0 = place_at(images[i], 0);
    const Static_point at_1 = place_at(images[i], 1);
    coefficients[i] = {{{at_0.x(), at_1.x() - at_0.x()}, {at_0.y(), at_1.y() - at_0.y()}}};
    // Denominators are powers of two.
    for (const auto& coordinate : coefficients[i]) {
      for (const Rational& c : coordinate) {
        denominator_of_all = std::max(denominator_of_all, Integer(denominator(c)));
      }
    }
  }
  std::array<std::array<Polynomial, 2>, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto& [constant, slope] = coefficients[i][axis];
      result[i][axis] = Polynomial{numerator(Rational(constant * denominator_of_all)),
                                   numerator(Rational(slope * denominator_of_all))};
    }
  }
  return result;
}

inline Polynomial turn_of(const std::array<Polynomial, 2>& p, const std::array<Polynomial, 2>& q,
                          const std::array<Polynomial, 2>& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// The forms by which points are lifted, in the order in which they decide.
inline Polynomial form(int number, const Polynomial& x, const Polynomial& y) {
  switch (number) {
    case 0:
      return x * x + y * y;
    case 1:
      return x * y;
    case 2:
      return x * x;
    default:
      return y * y;
  }
}

/// The determinant of four images, of the rows (x, y, form, 1), expanded by the lifted column: in
/// another way than the library does. Positive if the last one is inside of the circle through the
/// others, if these make a left turn.
inline Polynomial lifted_determinant(int number, const std::array<Image_motion_2, 4>& images) {
  const auto paths = paths_of(images);
  const auto& [p, q, r, s] = paths;
  const auto lift = [&](const std::array<Polynomial, 2>& a) { return form(number, a[0], a[1]); };
  return lift(p) * turn_of(q, r, s) - lift(q) * turn_of(p, r, s) + lift(r) * turn_of(p, q, s) -
         lift(s) * turn_of(p, q, r);
}

/// The first of the four determinants that is not zero.
inline Polynomial perturbed_determinant(const std::array<Image_motion_2, 4>& images) {
  Polynomial result;
  for (int number = 0; number < 4 && result.is_zero(); ++number) {
    result = lifted_determinant(number, images);
  }
  return result;
}

/// Four images of every kind: of boxes at rest, sheared, growing, with large rates; near the points
/// and far from them; and at last of very small and very large numbers.
class Images {
 public:
  explicit Images(unsigned seed) : random_(seed) {}

  static constexpr int kinds = 12;
  static const char* name(int kind) {
    constexpr const char* names[kinds] = {"at_rest",        "sheared",           "growing",
                                          "integers",       "rates_of_1e6",      "rates_of_1e15",
                                          "offsets_of_1e5", "greatest_offsets",  "tiny_numbers",
                                          "huge_numbers",   "nearly_cocircular", "nearly_parallel"};
    return names[kind];
  }

  /// The box exists as long as this object, or until the next call.
  std::array<Image_motion_2, 4> next(int kind) {
    const bool is_far = kind == 6 || kind == 10;
    const std::int64_t far = is_far ? 100000 : kind == 7 ? (std::int64_t{1} << 31) - 4 : 0;
    double rate = 0;
    if (kind > 0) rate = kind == 4 ? 1e6 : kind == 5 ? 1e15 : kind == 7 ? 1e-6 : 1;
    // Up to the rounding of the numbers, on a circle.
    const bool is_on_circle = kind >= 10;
    // As after a long shear: multiples of the two lattice vectors cancel.
    const bool is_oblique = kind == 11;
    constexpr int strain = 1 << 28;
    if (is_oblique) rate = 0.1;
    if (is_on_circle) rate = 1e-20;
    double scale = 1;
    if (kind == 8) scale = std::ldexp(1, -60 * (1 + integer(5)) - integer(3));
    if (kind == 9) scale = std::ldexp(1, 40 * (1 + integer(5)) + integer(3));
    if (kind == 3) {
      // Most are degenerate.
      box_ =
          std::make_unique<Periodic_box_2>(Linear_motion_2{{4.0, small()}, {small(), small()}, 0},
                                           Linear_motion_2{{small(), 3.0}, {small(), small()}, 0});
    } else {
      const bool have_epochs = kind != 4 && kind != 5 && integer(3) == 0;
      const auto vector = [&](double x, double y) {
        Vector_2 change = {rate * real(), rate * real()};
        if (kind == 1) change = {y == 0 ? 0 : rate * real(), 0};
        if (kind == 2) change = {x * rate / 8, y * rate / 8};
        return Linear_motion_2{
            {scale * x, scale * y}, {scale * change.x, scale * change.y}, have_epochs ? real() : 0};
      };
      const bool is_square = integer(2) == 0;
      const Linear_motion_2 first = vector(10, kind == 1 || is_square ? 0 : real());
      Linear_motion_2 second = vector(is_square ? 0 : 5 * real(), 10);
      if (is_oblique) {
        second.position.x += strain * first.position.x;
        second.position.y += strain * first.position.y;
        second.velocity.x += strain * first.velocity.x;
        second.velocity.y += strain * first.velocity.y;
        second.epoch = first.epoch;
      }
      box_ = std::make_unique<Periodic_box_2>(first, second);
    }
    time_ = kind == 3 ? small() : kind == 4 || kind == 5 ? 0 : 2 * std::abs(real());
    std::array<Image_motion_2, 4> result;
    for (Image_motion_2& image : result) {
      const auto offset = [&] {
        const std::int64_t near = integer(7) - 3;
        if (far == 0) return static_cast<std::int32_t>(near);
        const std::int64_t side = integer(2) == 0 ? -1 : 1;
        return static_cast<std::int32_t>(side * far + near - (side < 0 ? 1 : 0));
      };
      image = {{}, {offset(), offset()}, box_.get()};
      if (is_oblique) image.offset.x -= image.offset.y * strain;
      if (kind == 3) {
        image.motion = {{small(), small()}, {small(), small()}, 0};
        continue;
      }
      // So that the image is at the place at the time, up to rounding; mostly it has the velocity.
      const double epoch = integer(5) == 0 && rate <= 1 ? real() : 0;
      image.motion = {{}, {}, epoch};
      const Vector_2 shift = rounded_place(image, time_);
      const double speed = is_on_circle ? 1e-14 : scale;
      const Vector_2 velocity = {speed * real(), speed * real()};
      Vector_2 place = {scale * 10 * std::abs(real()), scale * 10 * std::abs(real())};
      if (is_on_circle) {
        const double angle = 4 * real();
        place = {5 + 4 * std::cos(angle), 5 + 4 * std::sin(angle)};
      }
      if (integer(2) == 0) {
        const Vector_2 a = box_->first().velocity;
        const Vector_2 b = box_->second().velocity;
        image.motion.velocity = {velocity.x - image.offset.x * a.x - image.offset.y * b.x,
                                 velocity.y - image.offset.x * a.y - image.offset.y * b.y};
      } else {
        image.motion.velocity = velocity;
      }
      const double elapsed = time_ - epoch;
      image.motion.position = {place.x - shift.x - image.motion.velocity.x * elapsed,
                               place.y - shift.y - image.motion.velocity.y * elapsed};
    }
    return result;
  }

  /// A time at which the images are near each other.
  double time() const { return time_; }
  const Periodic_box_2& box() const { return *box_; }
  int integer(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

 private:
  double real() { return real_(random_); }
  double small() { return static_cast<double>(random_() % 7) - 3; }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> real_{-1, 1};
  std::unique_ptr<Periodic_box_2> box_;
  double time_ = 0;
};

/// The numbers of images, for messages.
inline std::string describe(const std::array<Image_motion_2, 4>& images) {
  std::vector<Linear_motion_2> motions = {images[0].box->first(), images[0].box->second()};
  std::string offsets = "offsets";
  for (const Image_motion_2& image : images) {
    motions.push_back(image.motion);
    offsets += " (" + std::to_string(image.offset.x) + ", " + std::to_string(image.offset.y) + ")";
  }
  std::string epochs = "\nepochs";
  for (const Linear_motion_2& m : motions) epochs += " " + std::to_string(m.epoch);
  return "lattice vectors and points:\n" + describe(motions) + offsets + epochs;
}

/// The name of a test's kind.
inline std::string kind_name(const testing::TestParamInfo<int>& instance) {
  return Images::name(instance.param);
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_IMAGES_H
