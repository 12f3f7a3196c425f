// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of points in a periodic box: their positions, and the polynomials of their predicates, by
// definition and on the stack.
#include "kinetri/kinetic/image_motion_2.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "kinetic/certificate_formulas.h"
#include "kinetic/polynomial_on_stack.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/filter_results.h"
#include "support/images.h"
#include "support/on_failure.h"

namespace kinetri::image_motion_2_test {
namespace {

constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();

std::array<Moving_image_2, 4> points(const std::array<Image_motion_2, 4>& m) {
  return {Moving_image_2(m[0]), Moving_image_2(m[1]), Moving_image_2(m[2]), Moving_image_2(m[3])};
}

class Images_of_points : public testing::TestWithParam<int> {};

// Up to a positive factor.
void expect_same(const Polynomial& p, const Polynomial& expected) {
  EXPECT_EQ(primitive_part(p), primitive_part(expected));
}

TEST_P(Images_of_points, have_the_polynomials_of_their_definition) {
  test::Images source(41);
  int made = 0;
  const int cases = test::cases(100);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe(m); });
    const auto [p, q, r, s] = points(m);
    const auto paths = test::paths_of(m);
    expect_same(x_difference(p, q), paths[0][0] - paths[1][0]);
    expect_same(y_difference(p, q), paths[0][1] - paths[1][1]);
    expect_same(orientation_polynomial(p, q, r), test::turn_of(paths[0], paths[1], paths[2]));
    const Polynomial in_circle = test::lifted_determinant(0, m);
    expect_same(in_circle_polynomial(p, q, r, s), in_circle);
    expect_same(perturbed_in_circle_polynomial(p, q, r, s), test::perturbed_determinant(m));
    // At a time, from positions.
    const Rational t = to_rational(source.time());
    const test::Static_point place = test::place_at(m[0], t);
    const Exact_position_2 position = p.position(t);
    EXPECT_EQ(position.x, place.x());
    EXPECT_EQ(position.y, place.y());
    EXPECT_EQ(sign_at(in_circle_polynomial(p, q, r, s), Algebraic_number(t)),
              CGAL::side_of_oriented_circle(place, test::place_at(m[1], t), test::place_at(m[2], t),
                                            test::place_at(m[3], t)));
    // On the stack.
    const auto formula = [](const auto&... all) {
      return in_circle_of(Lifting::paraboloid, all...);
    };
    if (const auto on_stack = polynomial_on_stack(formula, m[0], m[1], m[2], m[3])) {
      ++made;
      expect_same(to_polynomial(*on_stack), in_circle);
    }
    if (HasFailure()) return;
  }
  if (GetParam() < 8) {
    EXPECT_EQ(made, cases) << "the numbers have less than 250 bits";
  }
}

TEST_P(Images_of_points, depend_on_differences_of_offsets_alone) {
  test::Images source(42);
  for (int i = 0; i < test::cases(100); ++i) {
    auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe(m); });
    const auto [p, q, r, s] = points(m);
    const int dx = source.integer(9) - 4;
    const int dy = source.integer(9) - 4;
    if (GetParam() == 7) continue;  // no room
    for (Image_motion_2& image : m) {
      image.offset.x += dx;
      image.offset.y += dy;
    }
    const auto [a, b, c, d] = points(m);
    expect_same(perturbed_in_circle_polynomial(a, b, c, d),
                perturbed_in_circle_polynomial(p, q, r, s));
    expect_same(orientation_polynomial(a, b, c), orientation_polynomial(p, q, r));
    expect_same(x_difference(a, b), x_difference(p, q));
    if (HasFailure()) return;
  }
}

TEST_P(Images_of_points, are_within_the_error_of_their_rounded_places) {
  test::Images source(43);
  for (int i = 0; i < test::cases(300); ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe(m); });
    const double t = source.time();
    const Double_interval times = {t, t + std::ldexp(1, -source.integer(60))};
    for (const Image_motion_2& image : m) {
      const auto rounded = [&] { return rounded_place(image, t); };
      const Vector_2 place = test::in_mode(test::rounding_mode(i), rounded);
      const double error =
          test::in_mode(test::rounding_mode(i), [&] { return place_error(image, t, times); });
      ASSERT_TRUE(std::isfinite(error));
      for (const double time : {times.lower, times.upper}) {
        const test::Static_point exact = test::place_at(image, to_rational(time));
        EXPECT_LE(abs(Rational(exact.x() - to_rational(place.x))), to_rational(error));
        EXPECT_LE(abs(Rational(exact.y() - to_rational(place.y))), to_rational(error));
      }
    }
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Images_of_points, testing::Range(0, test::Images::kinds),
                         test::kind_name);

TEST(Image_motion_2, with_the_offset_zero_is_the_point) {
  const Periodic_box_2 box({{3, 1}, {0.1, 0.2}, 5}, {{-1, 3}, {0.3, 0.7}, -2});
  for (const Linear_motion_2& m : test::random_motions(50, 10, 3, 7)) {
    for (const Periodic_box_2* of : {&box, static_cast<const Periodic_box_2*>(nullptr)}) {
      const Image_motion_2 image = {m, {}, of};
      EXPECT_EQ(rounded_place(image, 0.3), rounded_place(m, 0.3));
      EXPECT_EQ(place_error(image, 0.3, {0.2, 0.4}), place_error(m, 0.3, {0.2, 0.4}));
      const Trajectory_2 path = trajectory(image);
      EXPECT_EQ(path.x, trajectory(m).x);
      EXPECT_EQ(path.y, trajectory(m).y);
      EXPECT_EQ(path.w, trajectory(m).w);
      EXPECT_TRUE(is_finite(image));
    }
  }
  EXPECT_FALSE(is_finite(Image_motion_2{{{0, NAN}, {0, 0}, 0}, {}, nullptr}));
}

TEST(Image_motion_2, of_the_greatest_offsets_is_exact) {
  const Periodic_box_2 box({{0.1, 0}, {0.3, 0}, 0.7}, {{0, 1e300}, {0, 0}, 0});
  const Image_motion_2 image = {{{1, 2}, {0, 0}, 0}, {least, most}, &box};
  const Rational t(1, 3);
  const Exact_position_2 place = Moving_image_2(image).position(t);
  EXPECT_EQ(place.x, 1 - Rational(2147483648) *
                             (to_rational(0.1) + to_rational(0.3) * (t - to_rational(0.7))));
  EXPECT_EQ(place.y, 2 + Rational(2147483647) * to_rational(1e300));
}

TEST(Image_motion_2, has_the_trajectory_of_another_image_or_not) {
  const Periodic_box_2 box({{4, 0}, {0, 0}, 0}, {{0, 4}, {1, 0}, 0});
  const Image_motion_2 image = {{{1, 2}, {0, 0}, 0}, {2, 0}, &box};
  EXPECT_TRUE(same_trajectory(image, Image_motion_2{{{9, 2}, {0, 0}, 0}, {}, &box}));
  EXPECT_TRUE(same_trajectory(image, Image_motion_2{{{5, -2}, {-1, 0}, 0}, {1, 1}, &box}));
  EXPECT_FALSE(same_trajectory(image, Image_motion_2{{{5, -2}, {0, 0}, 0}, {1, 1}, &box}));
  EXPECT_FALSE(same_trajectory(image, Image_motion_2{{{1, 2}, {0, 0}, 0}, {2, 1}, &box}));
}

// The position, in multiples of the lattice vectors, decides: that of an image in the box is from 0
// to less than 1.
TEST(Image_motion_2, that_is_wrapped_is_in_the_box) {
  std::size_t on_sides = 0;
  std::mt19937 random(6);
  const auto integer = [&](int range) {
    return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * range + 1)) -
                               range);
  };
  for (int i = 0; i < test::cases(300); ++i) {
    const Periodic_box_2 box({{5 + integer(1), integer(2)}, {integer(1), integer(1)}, 1},
                             {{integer(2), 5 + integer(1)}, {integer(1), 0}, 0});
    const Linear_motion_2 motion = {{integer(20), integer(20)}, {integer(3), integer(3)}, 0};
    const Rational t(static_cast<int>(integer(2)), 1 + i % 3);
    if (box.area(t) <= 0) continue;
    const Image_motion_2 image = wrapped(motion, box, Algebraic_number(t));
    EXPECT_EQ(image.motion, motion);
    const Exact_position_2 p = Moving_image_2(image).position(t);
    const Exact_position_2 a = Moving_point_2(box.first()).position(t);
    const Exact_position_2 b = Moving_point_2(box.second()).position(t);
    const Rational area = a.x * b.y - a.y * b.x;
    const Rational of_first = (p.x * b.y - p.y * b.x) / area;
    const Rational of_second = (a.x * p.y - a.y * p.x) / area;
    EXPECT_TRUE(0 <= of_first && of_first < 1) << of_first;
    EXPECT_TRUE(0 <= of_second && of_second < 1) << of_second;
    if (of_first == 0 || of_second == 0) ++on_sides;
    const Vector_2 rounded = rounded_position(image, Algebraic_number(t));
    EXPECT_EQ(rounded.x, p.x.convert_to<double>());
    EXPECT_EQ(rounded.y, p.y.convert_to<double>());
    const Vector_2 unmoved = rounded_position({motion, {}, nullptr}, Algebraic_number(t));
    const Exact_position_2 place = Moving_point_2(motion).position(t);
    EXPECT_EQ(unmoved, (Vector_2{place.x.convert_to<double>(), place.y.convert_to<double>()}));
    if (HasFailure()) return;
  }
  EXPECT_GT(on_sides, 20u);
}

TEST(Image_motion_2, is_wrapped_at_irrational_times_and_next_to_a_side) {
  const Periodic_box_2 box({{2, 0}, {0, 0}, 0}, {{0, 2}, {0, 0}, 0});
  const Algebraic_number root_of_2({-2, 0, 1}, 1, 2);
  const Image_motion_2 image = wrapped({{0, 0}, {3, -1}, 0}, box, root_of_2);
  EXPECT_EQ(image.offset, (Lattice_offset_2{-2, 1}));
  EXPECT_EQ(rounded_position(image, root_of_2),
            (Vector_2{0.24264068711928514641, 0.58578643762690495120}));
  // The quotient is rounded to an integer.
  const double below = std::nextafter(2.0, 0.0);
  EXPECT_EQ(wrapped({{-1e-30, below}, {0, 0}, 0}, box, 0.0).offset, (Lattice_offset_2{1, 0}));
  EXPECT_EQ(wrapped({{2 - 1e-300, 2}, {0, 0}, 0}, box, 0.0).offset, (Lattice_offset_2{-1, -1}));
  EXPECT_THROW(wrapped({{1e10, 0}, {0, 0}, 0}, box, 0.0), Periodic_box_error);
}

TEST(Moving_image_2, prints_its_offset) {
  const Periodic_box_2 box({{4, 0}, {0, 0}, 0}, {{0, 4}, {1, 0}, 0});
  std::ostringstream out;
  out << Moving_image_2({{{1, 2}, {0, 0.5}, 3}, {-1, 7}, &box}, 12);
  EXPECT_EQ(out.str(), "point 12 (1, 2) at time 3, velocity (0, 0.5), offset (-1, 7)");
}

}  // namespace
}  // namespace kinetri::image_motion_2_test
