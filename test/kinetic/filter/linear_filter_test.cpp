// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter never contradicts exact arithmetic: every result on random, nearly degenerate and
// wild certificates is checked against exact failure times. And it decides what it is there for.
#include "kinetic/filter/filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <limits>

#include "kinetic/filter/precise_filter.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/filter_results.h"
#include "support/motions.h"
#include "support/on_failure.h"

namespace kinetri::linear_filter_test {
namespace {

class Linear_filter : public testing::TestWithParam<int> {};

TEST_P(Linear_filter, never_contradicts_exact_arithmetic) {
  constexpr unsigned seed = 314;
  test::Certificates source(seed);
  test::Decided decided;
  const int cases = test::cases(750);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe({m.begin(), m.end()}); });
    const double t = source.time(GetParam());
    test::expect_true_certificates(m, t, test::rounding_mode(i), decided);
    if (HasFatalFailure()) return;
    if (certainly_apart(m[0], m[1], {t, t})) {
      const Polynomial x = x_difference(Moving_point_2(m[0]), Moving_point_2(m[1]));
      const Polynomial y = y_difference(Moving_point_2(m[0]), Moving_point_2(m[1]));
      // A common root would be one of the gcd.
      ASSERT_LE(gcd(x, y).degree(), 0) << "they meet, but were said not to";
    }
  }
  if (GetParam() == 0) {
    EXPECT_GT(decided.all, cases * 99 / 100) << "of the certificates, half hold at the start";
    EXPECT_GT(decided.failures, cases / 30);
  }
}

// Of two certificates at once, at any time.
TEST_P(Linear_filter, two_at_once_never_contradict_exact_arithmetic) {
  constexpr unsigned seed = 316;
  test::Certificates source(seed);
  int decided = 0;
  const int cases = test::cases(750);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const auto n = source.next(GetParam());
    const test::On_failure trace([&] {
      return test::describe({m.begin(), m.end()}) + test::describe({n.begin(), n.end()});
    });
    test::expect_true_pair(m, n, source.time(GetParam()), test::rounding_mode(i), decided);
    if (HasFatalFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(decided, cases * 99 / 100) << "of the certificates, half hold at the start";
  }
}

// Of the five certificates after a flip, at the bracket of its time.
TEST_P(Linear_filter, after_a_flip_never_contradicts_exact_arithmetic) {
  constexpr unsigned seed = 315;
  test::Certificates source(seed);
  test::Decided_after_flips counts;
  const int cases = test::cases(1500);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const auto beyond = source.next(GetParam());
    const test::On_failure trace([&] {
      return test::describe({m.begin(), m.end()}) + test::describe({beyond.begin(), beyond.end()});
    });
    test::expect_true_after_flip(m, beyond, source.time(GetParam()), test::rounding_mode(i),
                                 counts);
    if (HasFatalFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(counts.flips, cases / 30);
    EXPECT_GT(counts.decided, counts.positive * 99 / 100);
  }
}

// The exact failure time is what it is rounded to, or the rounding says nothing.
void expect_true_rounding(const Rounding& rounding, const Algebraic_number& time) {
  EXPECT_EQ(rounding.nearest, time.to_double());
  EXPECT_LT(rounding.bounds.lower, time);
  EXPECT_GT(rounding.bounds.upper, time);
  EXPECT_TRUE(rounding.bounds.lower == rounding.nearest ||
              std::nextafter(rounding.bounds.lower, time.interval().upper + 1) == rounding.nearest);
  EXPECT_TRUE(rounding.bounds.upper == rounding.nearest ||
              std::nextafter(rounding.bounds.upper, time.interval().lower - 1) == rounding.nearest);
}

TEST_P(Linear_filter, rounds_a_failure_time_to_what_it_is_exactly_or_not_at_all) {
  constexpr unsigned seed = 317;
  test::Certificates source(seed);
  int failures = 0;
  int rounded = 0;
  const int cases = test::cases(3000);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe({m.begin(), m.end()}); });
    const double t = source.time(GetParam());
    const Filter_result result = filter_in_circle(m[0], m[1], m[2], m[3], {t, t}, false);
    if (result.kind != Filter_result::Kind::fails) continue;
    const auto exact =
        first_root_after(in_circle_polynomial(Moving_point_2(m[0]), Moving_point_2(m[1]),
                                              Moving_point_2(m[2]), Moving_point_2(m[3])),
                         t);
    ASSERT_TRUE(exact);
    ++failures;
    const auto rounding = test::in_mode(test::rounding_mode(i), [&] {
      return rounded_in_circle(m[0], m[1], m[2], m[3], result.bounds);
    });
    if (!rounding) continue;
    ++rounded;
    expect_true_rounding(*rounding, exact->value);
    if (HasFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(failures, cases / 100);
    EXPECT_GT(rounded, failures / 5) << "one of four rounding modes is the one it knows";
  }
}

INSTANTIATE_TEST_SUITE_P(Flavors, Linear_filter, testing::Range(0, test::Certificates::flavors),
                         test::flavor_name);

TEST(Linear_filter, knows_nothing_where_numbers_overflow) {
  const double huge = std::numeric_limits<double>::max();
  const Filter_result result =
      filter_in_circle(Linear_motion_2{{-huge, 0}, {0, 0}, 0}, {{0, -huge}, {0, 0}, 0},
                       {{huge, 0}, {0, 0}, 0}, {{0, huge}, {huge, huge}, 0}, {0, 0}, false);
  EXPECT_EQ(result.kind, Filter_result::Kind::unknown);
}

// The common part of the coordinates is in no error, also where only some points have turned.
TEST(Linear_filter, decides_far_from_the_origin_where_epochs_differ) {
  const double far = 0x1p45;
  const auto result = [&](double epoch) {
    return filter_in_circle(Linear_motion_2{{far, far}, {1, 0}, 0}, {{far + 8, far}, {0, 1}, epoch},
                            {{far + 8, far + 8}, {0, 0}, 0}, {{far, far + 16}, {0, -1}, epoch},
                            {1, 1}, false);
  };
  EXPECT_EQ(result(0).kind, Filter_result::Kind::holds);
  EXPECT_EQ(result(0.5).kind, Filter_result::Kind::holds);
}

// The step of Newton's method errs, the more the smaller the circle is: beside the middle of two
// binary64 numbers, and beside one of them, it may be on the wrong side.
TEST(Rounded_in_circle, beside_the_middle_of_two_numbers_and_beside_a_number_is_true_or_unknown) {
  int decided = 0;
  int tight = 0;
  int cases = 0;
  for (int exponent = -40; exponent <= 0; exponent += 4) {
    const double d = std::ldexp(1.0, exponent);
    for (int k = 1; k <= 60; ++k) {
      for (const double part : {0x1p-53, 0x1p-52}) {
        for (const double sign : {-1.0, 0.0, 1.0}) {
          // The last one comes to the circle about (-d, 0) at the time 1 + late, in the origin.
          const double late = part * (1 + sign * std::ldexp(1.0, -k));
          const std::array<Linear_motion_2, 4> m = {{{{-d, d}, {0, 0}, 0},
                                                     {{-2 * d, 0}, {0, 0}, 0},
                                                     {{-d, -d}, {0, 0}, 0},
                                                     {{late, 0}, {-1, 0}, 1}}};
          const Algebraic_number time(1 + to_rational(late));
          const auto rounding =
              rounded_in_circle(m[0], m[1], m[2], m[3], {1 - 0x1p-50, 1 + 0x1p-50});
          ++cases;
          if (!rounding) continue;
          ++decided;
          tight += rounding->bounds.lower == rounding->nearest ||
                   rounding->bounds.upper == rounding->nearest;
          SCOPED_TRACE(testing::Message() << late << ", " << d);
          expect_true_rounding(*rounding, time);
          if (HasFailure()) return;
        }
      }
    }
  }
  EXPECT_GT(decided, cases / 5);
  EXPECT_GT(tight, cases / 10);
}

}  // namespace
}  // namespace kinetri::linear_filter_test
