// SPDX-License-Identifier: GPL-3.0-or-later
//
// The places of moving points in doubles: their errors, and the signs that they make certain.
#include "kinetic/rounded_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/instantaneous_traits_2.h"
#include "support/certificates.h"
#include "support/motions.h"

namespace kinetri::rounded_places_test {
namespace {

using test::Certificates;

Linear_motion_2 as(const Linear_motion_2& motion, Linear_motion_2 /*kind*/) {
  return motion;
}

// Accelerated as much as it moves, in the other direction.
Polynomial_motion_2 as(const Linear_motion_2& m, Polynomial_motion_2 /*kind*/) {
  return {m.position, m.velocity, {-m.velocity.x, m.velocity.y}, {m.velocity.y, 0}, m.epoch};
}

template <class Motion>
class Rounded_places_of : public testing::Test {
 protected:
  static std::vector<Basic_moving_point_2<Motion>> points(Certificates& source, int flavor) {
    std::vector<Basic_moving_point_2<Motion>> result;
    for (const Linear_motion_2& m : source.next(flavor)) {
      result.emplace_back(as(m, Motion()), static_cast<Point_id>(3 + result.size()));
    }
    return result;
  }
};

using Motions = testing::Types<Linear_motion_2, Polynomial_motion_2>;
TYPED_TEST_SUITE(Rounded_places_of, Motions);

TYPED_TEST(Rounded_places_of, any_flavor_are_as_near_as_their_error_says) {
  for (int flavor = 0; flavor < Certificates::flavors; ++flavor) {
    SCOPED_TRACE(Certificates::name(flavor));
    Certificates source(41);
    for (int i = 0; i < test::cases(500); ++i) {
      const double t = source.time(flavor);
      const Double_interval times = {t, t + std::abs(t) * 0x1p-40};
      for (const auto& point : this->points(source, flavor)) {
        const Vector_2 place = rounded_place(point.motion(), t);
        const double error = place_error(point.motion(), t, times);
        if (!std::isfinite(error)) continue;
        for (const double at : {times.lower, times.upper}) {
          const test::Static_point exact = test::place_at(point.motion(), to_rational(at));
          ASSERT_LE(abs(exact.x() - to_rational(place.x)), to_rational(error));
          ASSERT_LE(abs(exact.y() - to_rational(place.y)), to_rational(error));
        }
      }
    }
  }
}

TYPED_TEST(Rounded_places_of, any_flavor_make_certain_only_what_is_so) {
  using Traits = Basic_instantaneous_traits_2<TypeParam>;
  int certain = 0;
  for (int flavor = 0; flavor < Certificates::flavors; ++flavor) {
    SCOPED_TRACE(Certificates::name(flavor));
    Certificates source(43);
    for (int i = 0; i < test::cases(500); ++i) {
      const Algebraic_number time(source.time(flavor));
      const auto p = this->points(source, flavor);
      const Rounded_places places(p, time);
      const Traits exact(Instant{time, Time_side::at}, Arithmetic::exact_only);
      const Sign turn = places.orientation(3, 4, 5);
      const Sign side = places.side_of_oriented_circle(3, 4, 5, 6);
      if (turn != CGAL::ZERO) {
        ASSERT_EQ(turn, exact.orientation_2_object()(p[0], p[1], p[2]));
        ++certain;
      }
      if (side != CGAL::ZERO) {
        ASSERT_EQ(side, exact.side_of_oriented_circle_2_object()(p[0], p[1], p[2], p[3]));
        ++certain;
      }
    }
  }
  EXPECT_GT(certain, test::cases(500));
}

TEST(Rounded_places, of_an_irrational_time_make_certain_what_is_so_just_after) {
  const Polynomial two({-2, 0, 1});
  const Algebraic_number time = first_root_after(two, Algebraic_number(0.0))->value;
  const Instantaneous_traits_2 exact(Instant{time, Time_side::after}, Arithmetic::exact_only);
  for (unsigned seed = 1; seed <= test::cases(50u); ++seed) {
    std::vector<Moving_point_2> p;
    for (const Linear_motion_2& m : test::random_motions(4, 10, 5, seed)) {
      p.emplace_back(m, static_cast<Point_id>(p.size()));
    }
    const Rounded_places places(p, time);
    ASSERT_EQ(places.orientation(0, 1, 2), exact.orientation_2_object()(p[0], p[1], p[2]));
    ASSERT_EQ(places.side_of_oriented_circle(0, 1, 2, 3),
              exact.side_of_oriented_circle_2_object()(p[0], p[1], p[2], p[3]));
  }
}

TEST(Rounded_places, too_large_or_none_make_nothing_certain) {
  const double huge = std::numeric_limits<double>::max();
  std::vector<Moving_point_2> p;
  for (const Vector_2& place : {Vector_2{0, 0}, {huge, 0}, {0, huge}, {huge, huge}}) {
    p.emplace_back(Linear_motion_2{place, {huge, 0}, -1}, static_cast<Point_id>(p.size()));
  }
  const Rounded_places places(p, Algebraic_number(0.0));
  EXPECT_FALSE(places.are_finite());
  EXPECT_EQ(places.orientation(0, 1, 2), CGAL::ZERO);
  EXPECT_EQ(places.side_of_oriented_circle(0, 1, 2, 3), CGAL::ZERO);
  EXPECT_EQ(Rounded_places().orientation(0, 1, 2), CGAL::ZERO);
  EXPECT_EQ(Rounded_places().side_of_oriented_circle(0, 1, 2, 3), CGAL::ZERO);
}

}  // namespace
}  // namespace kinetri::rounded_places_test
