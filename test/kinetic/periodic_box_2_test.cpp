// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/periodic_box_2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "support/message_of.h"
#include "support/motions.h"
#include "support/precondition_error.h"

namespace kinetri::periodic_box_2_test {
namespace {

const Linear_motion_2 right = {{2, 0}, {0, 0}, 0};
const Linear_motion_2 up = {{0, 1}, {0, 0}, 0};

std::string problem(const Linear_motion_2& first, const Linear_motion_2& second) {
  return test::message_of<Periodic_box_error>([&] { Periodic_box_2(first, second); });
}
std::string problem(const Periodic_box_2& box, const Algebraic_number& from,
                    const Algebraic_number& until) {
  return test::message_of<Periodic_box_error>([&] { box.require_area(from, until); });
}

TEST(Periodic_box_2, of_numbers_that_are_not_finite_is_refused) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string rest =
      " lattice vector of a periodic box has a number that is not finite; expected a finite "
      "vector, "
      "rate and epoch";
  EXPECT_EQ(problem({{inf, 0}, {0, 0}, 0}, up), "the first" + rest);
  EXPECT_EQ(problem(right, {{0, 1}, {0, nan}, 0}), "the second" + rest);
  EXPECT_EQ(problem(right, {{0, 1}, {0, 0}, -inf}), "the second" + rest);
  EXPECT_EQ(problem(right, up), "");
}

TEST(Periodic_box_2, that_never_has_an_area_is_refused) {
  const std::string parallel =
      "the periodic box has no area at time 0; expected lattice vectors that are not parallel";
  EXPECT_EQ(problem(right, {{-1, 0}, {0, 0}, 0}), parallel);
  EXPECT_EQ(problem(right, {{0, 0}, {0, 0}, 0}), parallel);
  EXPECT_EQ(problem({{0, 0}, {0, 0}, 0}, {{0, 0}, {0, 0}, 0}), parallel);
  // Parallel and longer all the time.
  EXPECT_EQ(problem({{1, 2}, {1, 2}, 0}, {{2, 4}, {-2, -4}, 0}), parallel);
  EXPECT_EQ(problem(up, right),
            "the periodic box has a negative area at time 0; the second lattice vector is to the "
            "right of the first: swap the two");
  // Nearly parallel vectors have an area.
  EXPECT_EQ(problem({{1, 1}, {0, 0}, 0}, {{1, 1 + 0x1p-52}, {0, 0}, 0}), "");
  EXPECT_EQ(problem({{0x1p-1074, 0}, {0, 0}, 0}, {{0, 0x1p-1074}, {0, 0}, 0}), "");
}

TEST(Periodic_box_2, that_vanishes_is_refused_with_the_time) {
  // The second vector sinks.
  const Periodic_box_2 box(right, {{0, 1}, {0, -0.25}, 0});
  EXPECT_EQ(problem(box, 0.0, 3.5), "");
  EXPECT_EQ(problem(box, 0.0, 4.0),
            "the periodic box has no area at time 4; stop before that time, or change the rates of "
            "the lattice vectors");
  EXPECT_EQ(problem(box, 0.0, 1000.0), problem(box, 0.0, 4.0));
  EXPECT_EQ(problem(box, 4.0, 4.0),
            "the periodic box has no area at time 4; expected lattice vectors that are not "
            "parallel");
  EXPECT_EQ(problem(box, 4.5, 5.0),
            "the periodic box has a negative area at time 4.5; the second lattice vector is to the "
            "right of the first: swap the two");
  EXPECT_EQ(problem(box, -100.0, 3.0), "");
  // From parallel vectors on it has an area, but not at that time.
  const Periodic_box_2 opens(right, {{1, 0}, {0, 1}, 2});
  EXPECT_EQ(problem(opens, 2.0, 3.0),
            "the periodic box has no area at time 2; expected lattice vectors that are not "
            "parallel");
  EXPECT_EQ(problem(opens, 2.5, 1e300), "");
}

TEST(Periodic_box_2, vanishes_at_an_exact_time) {
  // (1 - t, t) and (t, 1 + t): 1 - 2 t^2.
  const Periodic_box_2 box({{1, 0}, {-1, 1}, 0}, {{0, 1}, {1, 1}, 0});
  const std::optional<Algebraic_number> collapse = box.collapse_after(0.0);
  ASSERT_TRUE(collapse);
  EXPECT_EQ(*collapse, Algebraic_number(Polynomial{-1, 0, 2}, Rational(0), Rational(1)));
  EXPECT_EQ(problem(box, 0.0, *collapse).substr(0, 57),
            "the periodic box has no area at time 0.70710678118654757;");
  EXPECT_EQ(problem(box, 0.0, collapse->interval().lower), "");
  EXPECT_FALSE(mirrored(box).collapse_after(0.0) == std::nullopt);
  // A touch counts: (2 - t)^2.
  const Periodic_box_2 touches({{2, 0}, {-1, 0}, 0}, {{0, 2}, {0, -1}, 0});
  EXPECT_EQ(touches.collapse_after(-5.0), Algebraic_number(2.0));
  EXPECT_FALSE(touches.collapse_after(2.5));
  EXPECT_EQ(problem(touches, 1.0, 3.0).substr(0, 40), "the periodic box has no area at time 2; ");
  EXPECT_FALSE(Periodic_box_2(right, up).collapse_after(0.0));
  // Shear alone never ends it.
  EXPECT_FALSE(Periodic_box_2(right, {{0, 1}, {1e300, 0}, -1e300}).collapse_after(0.0));
  EXPECT_PRECONDITION_ERROR(touches.collapse_after(2.0),
                            "the area of a periodic box is not positive");
}

TEST(Periodic_box_2, has_the_area_of_its_vectors_at_each_time_also_mirrored) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> real(-1, 1);
  const auto vector = [&](Vector_2 about) {
    const double scale = std::ldexp(1, static_cast<int>(random() % 200) - 100);
    return Linear_motion_2{{scale * (about.x + real(random)), scale * (about.y + real(random))},
                           {scale * real(random), scale * real(random)},
                           real(random)};
  };
  for (int i = 0; i < test::cases(200); ++i) {
    const Periodic_box_2 box(vector({3, 0}), vector({0, 3}));
    const Periodic_box_2 other_way = mirrored(box);
    EXPECT_EQ(mirrored(other_way), box);
    for (const double time : {0.0, 0.5, -3.0, 1e10}) {
      const Rational t = to_rational(time);
      const test::Static_point a = test::place_at(box.first(), t);
      const test::Static_point b = test::place_at(box.second(), t);
      const Rational area = a.x() * b.y() - a.y() * b.x();
      ASSERT_EQ(box.area(t), area);
      ASSERT_EQ(sign_at(box.area_polynomial(), Algebraic_number(time)), sign(area));
      ASSERT_EQ(other_way.area(-t), area);
    }
    const std::optional<Algebraic_number> collapse = box.collapse_after(0.0);
    if (!collapse) continue;
    // It is positive before it, and zero at it.
    EXPECT_EQ(sign_at(box.area_polynomial(), *collapse), CGAL::ZERO);
    EXPECT_EQ(sign_just_before(box.area_polynomial(), *collapse), CGAL::POSITIVE);
  }
}

}  // namespace
}  // namespace kinetri::periodic_box_2_test
