// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filters of polynomial motion never contradict exact arithmetic: as for linear motion, every
// result on random, nearly degenerate and wild certificates is checked. And they decide what they
// are there for.
#include "kinetic/filter/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/filter_results.h"
#include "support/motions.h"
#include "support/on_failure.h"

namespace kinetri::polynomial_filter_test {
namespace {

using Point = Basic_moving_point_2<Polynomial_motion_2>;
using Motions = std::array<Polynomial_motion_2, 4>;

using test::bent;

class Polynomial_filter : public testing::TestWithParam<int> {
 protected:
  Motions next() { return bent(source_.next(GetParam()), random_); }
  double time() { return source_.time(GetParam()); }

 private:
  test::Certificates source_{314};
  std::mt19937_64 random_{41};
};

TEST_P(Polynomial_filter, never_contradicts_exact_arithmetic) {
  test::Decided decided;
  const int cases = test::cases(500);
  for (int i = 0; i < cases; ++i) {
    const Motions m = next();
    const test::On_failure trace([&] { return test::describe(m); });
    test::expect_true_certificates(m, time(), test::rounding_mode(i), decided);
    if (HasFatalFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(decided.all, cases * 99 / 100) << "of the certificates, half hold at the start";
    EXPECT_GT(decided.failures, cases / 50);
  }
}

TEST_P(Polynomial_filter, two_at_once_never_contradict_exact_arithmetic) {
  int decided = 0;
  const int cases = test::cases(150);
  for (int i = 0; i < cases; ++i) {
    const Motions m = next();
    const Motions n = next();
    const test::On_failure trace([&] { return test::describe(m) + test::describe(n); });
    test::expect_true_pair(m, n, time(), test::rounding_mode(i), decided);
    if (HasFatalFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(decided, cases / 2) << "half hold at the start; two are of one degree or unknown";
  }
}

TEST_P(Polynomial_filter, after_a_flip_never_contradicts_exact_arithmetic) {
  test::Decided_after_flips counts;
  const int cases = test::cases(600);
  for (int i = 0; i < cases; ++i) {
    const Motions m = next();
    const Motions beyond = next();
    const test::On_failure trace([&] { return test::describe(m) + test::describe(beyond); });
    test::expect_true_after_flip(m, beyond, time(), test::rounding_mode(i), counts);
    if (HasFatalFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(counts.flips, cases / 50);
    EXPECT_GT(counts.decided, counts.positive * 95 / 100);
  }
}

// Checks a certain sign of `p` in the middle of the interval and at its ends.
void expect_sign(Sign sign, const Polynomial& p, const Double_interval& interval) {
  if (sign == CGAL::ZERO) return;
  const Rational lower = to_rational(interval.lower);
  const Rational upper = to_rational(interval.upper);
  for (const Rational& t : {lower, Rational((lower + upper) / 2), upper}) {
    EXPECT_EQ(p.sign_at(t), sign);
  }
}

TEST_P(Polynomial_filter, has_right_signs_at_instants) {
  const int cases = test::cases(500);
  int certain = 0;
  for (int i = 0; i < cases; ++i) {
    const int mode = test::rounding_mode(i);
    const Motions m = next();
    const test::On_failure trace([&] { return test::describe(m); });
    const double t = time();
    const Double_interval interval = {t, i % 3 == 0 ? t : t + std::abs(t) * 0x1p-52};
    const Point p(m[0]);
    const Point q(m[1]);
    const Point r(m[2]);
    const Point s(m[3]);
    const auto sign = [&](const auto& filter) {
      std::fesetround(mode);
      const Sign result = filter();
      std::fesetround(FE_TONEAREST);
      certain += result != CGAL::ZERO;
      return result;
    };
    expect_sign(sign([&] { return certain_x_order(m[0], m[1], interval); }), x_difference(p, q),
                interval);
    expect_sign(sign([&] { return certain_y_order(m[0], m[1], interval); }), y_difference(p, q),
                interval);
    expect_sign(sign([&] { return certain_orientation(m[0], m[1], m[2], interval); }),
                orientation_polynomial(p, q, r), interval);
    expect_sign(sign([&] { return certain_in_circle(m[0], m[1], m[2], m[3], interval); }),
                in_circle_polynomial(p, q, r, s), interval);
    expect_sign(sign([&] { return certain_scalar_product(m[0], m[1], m[2], interval); }),
                scalar_product_polynomial(p, q, r), interval);
    expect_sign(sign([&] { return certain_distance_order(m[0], m[1], m[2], interval); }),
                distance_difference(p, q, r), interval);
    if (HasFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(certain, 6 * cases * 99 / 100);
  }
}

// The first time from `t` on at which the distance is not positive and falls: looked for among all
// roots of the distance and of its derivative.
std::optional<Algebraic_number> first_contact(const Polynomial& distance,
                                              const Algebraic_number& t) {
  std::vector<Algebraic_number> candidates = {t};
  for (const Polynomial& p : {distance, derivative(distance)}) {
    if (p.is_zero()) continue;
    for (const Real_root& root : real_roots(p)) candidates.push_back(root.value);
  }
  std::ranges::sort(candidates);
  for (const Algebraic_number& time : candidates) {
    if (time >= t && sign_at(distance, time) != CGAL::POSITIVE &&
        sign_just_after(derivative(distance), time) == CGAL::NEGATIVE) {
      return time;
    }
  }
  return std::nullopt;
}

// Returns whether the result was more than nothing.
bool expect_contact(const Filter_result& result, const Polynomial& distance, double t) {
  const auto contact = first_contact(distance, Algebraic_number(t));
  switch (result.kind) {
    case Filter_result::Kind::unknown:
      return false;
    case Filter_result::Kind::never_fails:
      EXPECT_FALSE(contact) << "a contact, but none was found";
      return true;
    case Filter_result::Kind::holds:
      EXPECT_GT(result.bounds.lower, t);
      if (contact) {
        EXPECT_GT(*contact, Algebraic_number(result.bounds.lower));
      }
      return true;
    default:
      EXPECT_TRUE(contact) << "no contact, but one was found";
      if (!contact) return true;
      EXPECT_GT(result.bounds.lower, t);
      EXPECT_LE(Algebraic_number(result.bounds.lower), *contact);
      EXPECT_GE(Algebraic_number(result.bounds.upper), *contact);
      return true;
  }
}

TEST_P(Polynomial_filter, never_contradicts_exact_contacts) {
  const int cases = test::cases(250);
  int decided = 0;
  int signs = 0;
  int apart = 0;
  const Polynomial_kinetic_traits_2 exact = Polynomial_kinetic_traits_2::exact();
  for (int i = 0; i < cases; ++i) {
    const int mode = test::rounding_mode(i);
    const Motions m = next();
    const test::On_failure trace([&] { return test::describe(m); });
    const double t = time();
    const Point p(m[0]);
    const Point q(m[1]);
    // Of the size of the distance now, at times just that: as after a contact.
    const Vector_2 a = rounded_place(m[0], t);
    const Vector_2 b = rounded_place(m[1], t);
    const double diameter = std::hypot(a.x - b.x, a.y - b.y) * (i % 4 < 2 ? 1 : 0.3 * (i % 4));
    if (!std::isfinite(diameter)) continue;
    const Polynomial distance = contact_polynomial(p, q, diameter);
    const Filter_result result = test::in_mode(mode, [&] {
      return filter_contact(m[0], m[1], diameter, {t, t});
    });
    decided += expect_contact(result, distance, t);
    if (result.kind != Filter_result::Kind::unknown && !result.may_be_zero) {
      ++apart;
      EXPECT_EQ(distance.sign_at(to_rational(t)), CGAL::POSITIVE);
    }
    const auto side = static_cast<Wall_2::Side>(i % 4);
    const Wall_2 wall = {side, (side < Wall_2::Side::bottom ? a.x : a.y) + (i % 3 == 0 ? 0 : b.x),
                         i % 5 == 0 ? 0.1 : 0};
    if (!std::isfinite(wall.position)) continue;
    const Polynomial inside = wall_polynomial(p, wall);
    decided += expect_contact(test::in_mode(mode,
                                            [&] {
                                              return filter_wall_contact(m[0], wall, {t, t});
                                            }),
                              inside, t);
    if (certainly_inside(m[0], wall, {t, t})) {
      EXPECT_EQ(inside.sign_at(to_rational(t)), CGAL::POSITIVE);
    }
    const auto expect_certain = [&](Sign sign, const Polynomial& polynomial) {
      if (sign == CGAL::ZERO) return;
      ++signs;
      EXPECT_EQ(polynomial.sign_at(to_rational(t)), sign);
    };
    expect_certain(test::in_mode(mode,
                                 [&] {
                                   return certain_distance_slope(m[0], m[1], {t, t});
                                 }),
                   derivative(distance));
    expect_certain(test::in_mode(mode,
                                 [&] {
                                   return certain_gap(m[0], m[1], diameter, {t, t});
                                 }),
                   distance);
    // What exact arithmetic says is the same.
    const auto expect_exact = [&](const Certificate& certificate, const Polynomial& d) {
      const auto contact = first_contact(d, Algebraic_number(t));
      ASSERT_EQ(certificate.failure != nullptr, contact.has_value());
      if (contact) {
        ASSERT_EQ(*certificate.failure, *contact);
      }
    };
    expect_exact(exact.contact_certificate(p, q, diameter, t), distance);
    expect_exact(exact.wall_certificate(p, wall, t), inside);
    if (HasFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(decided, cases * 12 / 10);
    EXPECT_GT(apart, cases / 20);
    EXPECT_GT(signs, cases * 14 / 10) << "half of the gaps vanish, but for rounding";
  }
}

// A motion that goes on from another epoch, where it is rounded, shifted.
Polynomial_motion_2 restarted(const Polynomial_motion_2& m, double epoch, const Vector_2& shift) {
  const Vector_2 place = rounded_place(m, epoch);
  const double elapsed = epoch - m.epoch;
  return {{place.x + shift.x, place.y + shift.y},
          rounded_velocity(m, epoch),
          {m.acceleration.x + m.jerk.x * elapsed, m.acceleration.y + m.jerk.y * elapsed},
          m.jerk,
          epoch};
}

// The points move relative to each other by roundings alone. What is computed of that is zero for
// some of them, but not exactly: certificates fail long after.
TEST(Polynomial_filter, does_not_take_motions_that_differ_by_roundings_for_one) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> number(-4, 4);
  const auto vector = [&] { return Vector_2{number(random), number(random)}; };
  test::Decided decided;
  for (int i = 0; i < test::cases(400); ++i) {
    Polynomial_motion_2 first = {vector(), vector(), vector(), vector()};
    if (i % 2 == 0) first.jerk = {};
    const Motions m = {first, restarted(first, 1 + 0.1 * (i % 7), {2, 0}),
                       restarted(first, 1.5, {0, 1}), restarted(first, 2, {2, 2})};
    const test::On_failure trace([&] { return test::describe(m); });
    const double t = 2 + 0.1 * (i % 5);
    test::expect_true_certificates(m, t, test::rounding_mode(i), decided);
    if (HasFatalFailure()) return;
    for (const double diameter : {1.0, 2.0, 3.0}) {
      expect_contact(filter_contact(m[0], m[1], diameter, {t, t}),
                     contact_polynomial(Point(m[0]), Point(m[1]), diameter), t);
      if (HasFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Flavors, Polynomial_filter, testing::Range(0, test::Certificates::flavors),
                         test::flavor_name);

// x = t + t^2 reaches 6 at t = 2.
TEST(Polynomial_filter, knows_where_points_are_apart) {
  const Polynomial_motion_2 moving = {
      .position = {0, 0}, .velocity = {1, 0}, .acceleration = {2, 0}, .jerk = {0, 0}, .epoch = 0};
  const auto resting = [](double x, double y) {
    Polynomial_motion_2 m;
    m.position = {x, y};
    return m;
  };
  EXPECT_TRUE(certainly_apart(moving, resting(6, 0), {1, 1}));
  EXPECT_TRUE(certainly_apart(moving, resting(6, 1), {2, 2}));
  EXPECT_TRUE(certainly_apart(resting(0, 0), resting(0, 1), {2, 2}));
  EXPECT_FALSE(certainly_apart(moving, resting(6, 0), {2, 2}));
  EXPECT_FALSE(
      certainly_apart(moving, resting(6, 0), {std::nextafter(2, 1), std::nextafter(2, 3)}));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(certainly_apart(moving, resting(6, 0), {1, infinity}));
}

// Half of the least number, and a third of it, are rounded to zero; but the time is long.
TEST(Polynomial_filter, has_right_signs_where_numbers_underflow) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const Polynomial_motion_2 accelerated = {
      .position = {-0x1p-80, 0}, .acceleration = {least, 0}, .jerk = {0, 0}, .epoch = 0};
  const Polynomial_motion_2 jerked = {
      .position = {-0x1p-80, 0}, .acceleration = {0, 0}, .jerk = {2 * least, 0}, .epoch = 0};
  const Polynomial_motion_2 resting = {.position = {0, 0}};
  const auto check = [&](const Polynomial_motion_2& motion, double time) {
    const Polynomial difference = x_difference(Point(motion), Point(resting));
    ASSERT_EQ(difference.sign_at(to_rational(time)), CGAL::POSITIVE);
    EXPECT_NE(certain_x_order(motion, resting, {time, time}), CGAL::NEGATIVE);
  };
  check(accelerated, 0x1p500);
  check(jerked, 0x1p340);
}

TEST(Polynomial_filter, rounds_failures_as_exact_arithmetic_does) {
  std::mt19937_64 random(99);
  test::Certificates source(100);
  const Polynomial_kinetic_traits_2 traits;
  int rounded = 0;
  for (int i = 0; i < test::cases(2000); ++i) {
    const Motions m = bent(source.next(0), random);
    const Point p(m[0]);
    const Point q(m[1]);
    const Point r(m[2]);
    const Point s(m[3]);
    const Filter_result result = filter_in_circle(m[0], m[1], m[2], m[3], {0, 0}, false);
    if (result.kind != Filter_result::Kind::fails) continue;
    ++rounded;
    const auto root = first_root_after(in_circle_polynomial(p, q, r, s), Algebraic_number());
    ASSERT_TRUE(root);
    const Algebraic_number failure = traits.in_circle_failure(p, q, r, s, result.bounds);
    EXPECT_EQ(failure.to_double(), root->value.to_double());
    EXPECT_EQ(failure.tight_interval(), root->value.tight_interval());
    EXPECT_EQ(failure, root->value);
  }
  EXPECT_GT(rounded, test::cases(40));
}

}  // namespace
}  // namespace kinetri::polynomial_filter_test
