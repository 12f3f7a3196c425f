// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filters of discs never contradict exact arithmetic: centers of every flavor, with radii and
// weights of every kind.
#include "kinetic/filter/disc_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <random>
#include <type_traits>

#include "kinetic/exact_certificates.h"
#include "kinetic/filter/filter.h"
#include "kinetic/filter/precise_filter.h"
#include "kinetic/rounded_places.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/disc_certificates.h"
#include "support/discs.h"
#include "support/filter_results.h"
#include "support/on_failure.h"

namespace kinetri::disc_filter_test {
namespace {

using enum test::Kind_of_radii;

template <class Disc>
using Source = test::Disc_certificates<Disc>;

class Disc_filter : public testing::TestWithParam<int> {};

template <class Disc>
void expect_true_circles(int flavor, int cases) {
  for (int kind = 0; kind < kinds; ++kind) {
    Source<Disc> source(flavor, 100 + static_cast<unsigned>(kind));
    test::Decided decided;
    int pairs = 0;
    test::Decided_after_flips counts;
    for (int i = 0; i < cases; ++i) {
      const double t = source.time();
      const auto m = source.next(kind, t);
      const auto n = source.next(kind, t);
      const test::On_failure trace(
          [&] { return test::describe_discs(m) + test::describe_discs(n); });
      const int mode = test::rounding_mode(i);
      test::expect_true_certificates(m, t, mode, decided);
      if (testing::Test::HasFatalFailure()) return;
      test::expect_true_pair(m, n, t, mode, pairs);
      if (testing::Test::HasFatalFailure()) return;
      test::expect_true_after_flip(m, n, t, mode, counts);
      if (testing::Test::HasFatalFailure()) return;
    }
    if (flavor == 0 && kind < touching) {
      EXPECT_GT(decided.all, cases * 98 / 100) << "of the certificates, half hold at the start";
      EXPECT_GT(pairs, cases * (std::same_as<Disc, Disc_motion_2> ? 80 : 40) / 100);
      EXPECT_GE(decided.failures, cases / 100) << kind;
      EXPECT_GE(counts.flips, cases / 100) << kind;
      // Where the sizes differ much, one bound for all of the five is too large for some.
      EXPECT_GE(counts.decided, counts.positive * (kind == ratios ? 50 : 90) / 100);
    }
  }
}

TEST_P(Disc_filter, of_power_circles_never_contradicts_exact_arithmetic) {
  expect_true_circles<Disc_motion_2>(GetParam(), test::cases(125));
}
TEST_P(Disc_filter, of_power_circles_of_curves_never_contradicts_exact_arithmetic) {
  expect_true_circles<Polynomial_disc_motion_2>(GetParam(), test::cases(50));
}

// As near to a root of `p` in the bracket, at whose ends the signs differ, as two numbers are.
struct Near_root {
  double high;
  double low;
};
Near_root near_root(const Polynomial& p, const Double_interval& bracket) {
  Rational lower = to_rational(bracket.lower);
  Rational upper = to_rational(bracket.upper);
  const Sign sign = p.sign_at(lower);
  for (int i = 0; i < 130; ++i) {
    const Rational middle = (lower + upper) / 2;
    (p.sign_at(middle) == sign ? lower : upper) = middle;
  }
  const double high = to_double(lower);
  return {high, to_double(lower - to_rational(high))};
}

// What is computed in twice the precision, where it is nearly zero.
template <class Value>
void expect_true_near_root(const Polynomial& p, const Filter_result& failure, const Value& value) {
  if (failure.kind != Filter_result::Kind::fails) return;
  const auto [high, low] = near_root(p, failure.bounds);
  for (const double factor : {1.0, 1 - 0x1p-52, 1 + 0x1p-50, 1 - 0x1p-46}) {
    const double result = value(high, low * factor);
    if (result == 0) continue;
    ASSERT_EQ(CGAL::sign(result), p.sign_at(to_rational(high) + to_rational(low * factor)));
  }
}

// Each sign that is certain, at both ends of an interval and between them.
template <class Disc>
void expect_true_signs(int flavor, int cases) {
  using Point = Basic_moving_point_2<Disc>;
  int decided = 0;
  int all = 0;
  for (int i = 0; i < cases; ++i) {
    const int kind = i % kinds;
    Source<Disc> source(flavor, 1000 + static_cast<unsigned>(i));
    const double t = source.time();
    const auto m = source.next(kind, t);
    const test::On_failure trace([&] { return test::describe_discs(m); });
    const double width = i % 3 == 0 ? 0 : i % 3 == 1 ? 0x1p-40 : 1;
    const Double_interval interval = {t, t + width};
    const int mode = test::rounding_mode(i);
    const Point p(m[0], 0);
    const Point q(m[1], 1);
    const Point r(m[2], 2);
    const Point s(m[3], 3);
    const auto expect_sign = [&](const auto& filter, const Polynomial& polynomial) {
      const Sign sign = test::in_mode(mode, filter);
      if (width < 1 && kind < touching) ++all;
      if (sign == CGAL::ZERO) return;
      if (width < 1 && kind < touching) ++decided;
      for (const double time : {interval.lower, interval.lower + width / 2, interval.upper}) {
        ASSERT_EQ(sign, polynomial.sign_at(to_rational(time)));
      }
    };
    expect_sign([&] { return certain_in_circle(m[0], m[1], m[2], m[3], interval); },
                in_circle_polynomial(p, q, r, s));
    expect_sign([&] { return certain_power_distance_order(m[0], m[1], m[2], interval); },
                power_distance_difference(p, q, r));
    if (kind != equal) {
      expect_sign([&] { return certain_weight_order(m[0], m[1], interval); },
                  weight_difference(p, q));
    }
    const double diameter = kind == touching || i % 2 == 0 ? 0 : std::abs(m[0].radius) / 2;
    const Polynomial gap = contact_polynomial(p, q, diameter);
    expect_sign([&] { return certain_gap(m[0], m[1], diameter, interval); }, gap);
    expect_sign([&] { return certain_distance_slope(m[0], m[1], interval); },
                derivative(contact_polynomial(p, q, 0)));
    // At one time, in twice the precision.
    const auto expect_precise = [&](double value, const Polynomial& polynomial) {
      if (value == 0) return;
      ASSERT_EQ(CGAL::sign(value), polynomial.sign_at(to_rational(t) + to_rational(t * 0x1p-54)));
    };
    expect_precise(precise_in_circle(m[0], m[1], m[2], m[3], t, t * 0x1p-54),
                   in_circle_polynomial(p, q, r, s));
    expect_precise(precise_contact(m[0], m[1], diameter, t, t * 0x1p-54), gap);
    expect_true_near_root(in_circle_polynomial(p, q, r, s),
                          filter_in_circle(m[0], m[1], m[2], m[3], {t, t}, false),
                          [&](double high, double low) {
                            return precise_in_circle(m[0], m[1], m[2], m[3], high, low);
                          });
    expect_true_near_root(
        gap, filter_contact(m[0], m[1], diameter, {t, t}),
        [&](double high, double low) { return precise_contact(m[0], m[1], diameter, high, low); });
    if (testing::Test::HasFatalFailure()) return;
    // All places at once.
    const std::array points = {p, q, r, s};
    const Rounded_places places(points, Algebraic_number(t));
    const Sign side = places.side_of_oriented_circle(0, 1, 2, 3);
    if (side != CGAL::ZERO) {
      ASSERT_EQ(side, in_circle_polynomial(p, q, r, s).sign_at(to_rational(t)));
    }
    if (testing::Test::HasFatalFailure()) return;
  }
  if (flavor == 0) {
    EXPECT_GT(decided, all * 97 / 100);
  }
}

TEST_P(Disc_filter, of_signs_never_contradicts_exact_arithmetic) {
  expect_true_signs<Disc_motion_2>(GetParam(), test::cases(750));
}
TEST_P(Disc_filter, of_signs_of_curves_never_contradicts_exact_arithmetic) {
  expect_true_signs<Polynomial_disc_motion_2>(GetParam(), test::cases(300));
}

// Whether what the filter says is true of the certificate whose exact failure is given. Returns
// whether it says anything.
bool expect_true_contact(const Filter_result& result, const Certificate& exact,
                         const Double_interval& after) {
  using Kind = Filter_result::Kind;
  const bool fails = exact.kind == Certificate::Kind::fails;
  if (result.kind == Kind::unknown) return false;
  if (result.kind == Kind::never_fails) {
    EXPECT_FALSE(fails) << "a contact, but none was found";
  } else if (result.kind == Kind::fails) {
    EXPECT_TRUE(fails) << "no contact, but one was found";
    EXPECT_GT(result.bounds.lower, after.upper);
    if (fails) {
      EXPECT_LE(Algebraic_number(result.bounds.lower), *exact.failure);
      EXPECT_GE(Algebraic_number(result.bounds.upper), *exact.failure);
    }
  } else if (fails) {
    EXPECT_GT(*exact.failure, Algebraic_number(result.bounds.upper));
  }
  return true;
}

template <class Disc>
void expect_true_contacts(int flavor, int cases) {
  using Point = Basic_moving_point_2<Disc>;
  int decided = 0;
  int contacts = 0;
  int rounded = 0;
  for (int i = 0; i < cases; ++i) {
    const int kind = i % kinds;
    Source<Disc> source(flavor, 5000 + static_cast<unsigned>(i));
    const double t = source.time();
    const auto m = source.next(kind, t);
    const test::On_failure trace([&] { return test::describe_discs(std::array{m[0], m[1]}); });
    const double diameter = kind == touching || i % 2 == 0 ? 0 : std::abs(m[2].radius) / 2;
    const int mode = test::rounding_mode(i);
    const Point p(m[0]);
    const Point q(m[1]);
    const Double_interval now = {t, t};
    const Filter_result result =
        test::in_mode(mode, [&] { return filter_contact(m[0], m[1], diameter, now); });
    const Polynomial gap = contact_polynomial(p, q, diameter);
    decided += expect_true_contact(result, exact_contact_certificate(gap, t), now);
    if (result.kind != Filter_result::Kind::unknown && !result.may_be_zero) {
      EXPECT_EQ(gap.sign_at(to_rational(t)), CGAL::POSITIVE);
    }
    if (result.kind == Filter_result::Kind::fails) {
      ++contacts;
      if constexpr (std::same_as<Disc, Disc_motion_2>) {
        const auto root = first_root_after(gap, t);
        const auto nearest = rounded_contact(m[0], m[1], diameter, result.bounds);
        rounded += nearest.has_value();
        if (nearest && root) {
          EXPECT_EQ(nearest->nearest, root->value.to_double());
          EXPECT_LT(nearest->bounds.lower, root->value);
          EXPECT_GT(nearest->bounds.upper, root->value);
        }
      }
    }
    for (const auto side :
         {Wall_2::Side::left, Wall_2::Side::right, Wall_2::Side::bottom, Wall_2::Side::top}) {
      const Vector_2 there = rounded_place(m[0], t + 1);
      const Wall_2 wall = {side, side < Wall_2::Side::bottom ? there.x : there.y,
                           i % 3 == 0 ? 0 : diameter, i % 5 != 0};
      const Polynomial inside = wall_polynomial(p, wall);
      const Filter_result at_wall =
          test::in_mode(mode, [&] { return filter_wall_contact(m[0], wall, now); });
      expect_true_contact(at_wall, exact_contact_certificate(inside, t), now);
      const Double_interval interval = {t, t + 0x1p-20};
      if (test::in_mode(mode, [&] { return certainly_inside(m[0], wall, interval); })) {
        EXPECT_EQ(inside.sign_at(to_rational(t)), CGAL::POSITIVE);
        EXPECT_EQ(inside.sign_at(to_rational(interval.upper)), CGAL::POSITIVE);
      }
    }
    if (testing::Test::HasFailure()) return;
  }
  if (flavor == 0) {
    EXPECT_GT(decided, cases * 60 / 100) << "all but the discs that overlap and approach";
    EXPECT_GT(contacts, cases / (std::same_as<Disc, Disc_motion_2> ? 30 : 100));
    if constexpr (std::same_as<Disc, Disc_motion_2>) {
      EXPECT_GT(rounded, contacts * 75 / 100);
    }
  }
}

TEST_P(Disc_filter, of_contacts_never_contradicts_exact_arithmetic) {
  expect_true_contacts<Disc_motion_2>(GetParam(), test::cases(1000));
}
TEST_P(Disc_filter, of_contacts_of_curves_never_contradicts_exact_arithmetic) {
  expect_true_contacts<Polynomial_disc_motion_2>(GetParam(), test::cases(600));
}

INSTANTIATE_TEST_SUITE_P(Flavors, Disc_filter, testing::Range(0, test::Certificates::flavors),
                         test::flavor_name);

// What equal constant radii make of a filter's result is what it is without them, bit for bit.
TEST(Disc_filter, of_equal_radii_gives_what_that_of_points_gives) {
  test::Certificates source(77);
  for (int i = 0; i < test::cases(1000); ++i) {
    const auto lines = source.next(i % test::Certificates::flavors);
    const double t = source.time(i % test::Certificates::flavors);
    std::array<Disc_motion_2, 4> m;
    for (std::size_t k = 0; k < 4; ++k) m[k] = {lines[k], 0.75, 0, 0.1};
    const auto expect_same = [](const Filter_result& a, const Filter_result& b) {
      EXPECT_EQ(a.kind, b.kind);
      EXPECT_EQ(a.bounds, b.bounds);
      EXPECT_EQ(a.may_be_zero, b.may_be_zero);
      EXPECT_EQ(a.is_refined, b.is_refined);
    };
    expect_same(filter_in_circle(m[0], m[1], m[2], m[3], {t, t}, false),
                filter_in_circle(lines[0], lines[1], lines[2], lines[3], {t, t}, false));
    expect_same(filter_contact(m[0], m[1], 0, {t, t}),
                filter_contact(lines[0], lines[1], 1.5, {t, t}));
    if (HasFailure()) return;
  }
}

// The radii grow at one rate, from epochs of their own, where they are rounded: what is computed of
// the differences of the weights is zero for some, but not exactly.
TEST(Disc_filter, does_not_take_weights_that_differ_by_roundings_for_one) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> number(0.1, 4);
  test::Decided decided;
  for (int i = 0; i < test::cases(400); ++i) {
    const double radius = number(random);
    const double growth = number(random);
    std::array<Disc_motion_2, 4> m;
    for (std::size_t k = 0; k < 4; ++k) {
      m[k].epoch = static_cast<double>(k) / 3;
      m[k].growth = growth;
      m[k].radius = radius + growth * m[k].epoch;
    }
    m[1].position = {1, 0};
    m[2].position = {0, 1};
    m[3].position = {1, 1.5};
    const test::On_failure trace([&] { return test::describe_discs(m); });
    test::expect_true_certificates(m, 1 + 0.1 * (i % 5), test::rounding_mode(i), decided);
    if (HasFatalFailure()) return;
  }
}

TEST(Disc_filter, knows_that_discs_at_rest_that_grow_change) {
  std::array<Disc_motion_2, 4> m;
  m[0].position = {1, 0};
  m[1].position = {0, 1};
  m[2].position = {-1, 0};
  m[3].position = {0, -1.5};
  for (Disc_motion_2& disc : m) disc.radius = 0.25;
  const auto kind = [&] { return filter_in_circle(m[0], m[1], m[2], m[3], {0, 0}, false).kind; };
  EXPECT_EQ(kind(), Filter_result::Kind::never_fails);
  m[3].growth = 0.5;
  EXPECT_NE(kind(), Filter_result::Kind::never_fails);
  EXPECT_NE(kind(), Filter_result::Kind::unknown);
  EXPECT_NE(filter_contact(m[0], m[3], 0, {0, 0}).kind, Filter_result::Kind::never_fails);
  EXPECT_EQ(filter_contact(m[0], m[1], 0, {0, 0}).kind, Filter_result::Kind::never_fails);
}

TEST(Disc_filter, knows_nothing_where_numbers_overflow) {
  std::array<Disc_motion_2, 4> m;
  m[0].position = {1, 0};
  m[1].position = {0, 1};
  m[2].position = {-1, 0};
  m[3].position = {0, -1.5};
  m[2].radius = 1e300;
  for (const double growth : {0.0, 1e300}) {
    m[3].growth = growth;
    for (const double radius : {0.0, 1e300, -1e300}) {
      m[0].radius = radius;
      EXPECT_EQ(filter_in_circle(m[0], m[1], m[2], m[3], {0, 0}, false).kind,
                Filter_result::Kind::unknown);
      EXPECT_EQ(certain_in_circle(m[0], m[1], m[2], m[3], {0, 0}), CGAL::ZERO);
      EXPECT_EQ(precise_in_circle(m[0], m[1], m[2], m[3], 0, 0), 0);
    }
  }
}

// A point passes a growing disc, of which the radius is a small difference of large numbers, just
// so that it touches the rim or does not.
TEST(Disc_filter, of_discs_that_pass_at_a_touch_never_contradicts_exact_arithmetic) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(0.1, 0.5);
  int decided = 0;
  for (int i = 0; i < test::cases(3000); ++i) {
    Disc_motion_2 p;
    p.epoch = -std::ldexp(1 + share(random), 24);
    p.growth = share(random);
    p.radius = 1 + share(random) + p.growth * p.epoch;
    const double growth = p.growth;
    const double radius = to_double(test::radius_at(p, 0));
    const double off = std::ldexp(share(random), -14 - i % 32) * (i % 2 == 0 ? 1 : -1);
    const double y = (radius + 10 * growth) / std::sqrt(1 - growth * growth) * (1 + off);
    const Disc_motion_2 q = {{{-10, y}, {1, 0}, 0}, 0, 0, 0};
    const test::On_failure trace([&] { return test::describe_discs(std::array{p, q}); });
    const Filter_result result = filter_contact(p, q, 0, {0, 0});
    decided += expect_true_contact(
        result,
        exact_contact_certificate(contact_polynomial(Moving_disc_2(p), Moving_disc_2(q), 0), 0.0),
        {0, 0});
    if (HasFailure()) return;
  }
  EXPECT_GT(decided, test::cases(100));
}

// As Rounded_contact of points, with a disc that grows.
TEST(Disc_filter, rounds_a_contact_beside_the_middle_of_two_numbers_to_the_nearest_or_not_at_all) {
  int decided = 0;
  int cases = 0;
  for (int exponent = -40; exponent <= 0; exponent += 4) {
    const double diameter = std::ldexp(1.0, exponent);
    for (int k = 1; k <= 52; ++k) {
      for (const double sign : {-1.0, 0.0, 1.0}) {
        // They touch at 1 + late.
        const double late = 0x1p-53 * (1 + sign * std::ldexp(1.0, -k));
        const Disc_motion_2 p = {{{-diameter, 0}, {0, 0}, 0}, 0.25 * diameter, 0, 0};
        const Disc_motion_2 q = {{{late, 0}, {-0.5, 0}, 1}, 0.75 * diameter, 0.5, 0};
        const auto rounded = rounded_contact(p, q, 0, {1 - 0x1p-50, 1 + 0x1p-50});
        ++cases;
        decided += rounded.has_value();
        if (rounded) {
          ASSERT_EQ(rounded->nearest, to_double(1 + to_rational(late))) << late << ", " << diameter;
        }
      }
    }
  }
  EXPECT_GT(decided, cases / 5);
}

}  // namespace
}  // namespace kinetri::disc_filter_test
