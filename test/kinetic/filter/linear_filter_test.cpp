// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter never contradicts exact arithmetic: every result on random, nearly degenerate and
// wild certificates is checked against exact failure times. And it decides what it is there for.
#include "kinetic/filter/filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <limits>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/filter_results.h"
#include "support/motions.h"

namespace kinetri {
namespace {

class Linear_filter : public testing::TestWithParam<int> {};

TEST_P(Linear_filter, never_contradicts_exact_arithmetic) {
  constexpr unsigned seed = 314;
  test::Certificates source(seed);
  test::Decided decided;
  const int cases = 1500 * test::multiplier();
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    SCOPED_TRACE(test::describe({m.begin(), m.end()}));
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
  const int cases = 1500 * test::multiplier();
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const auto n = source.next(GetParam());
    SCOPED_TRACE(test::describe({m.begin(), m.end()}) + test::describe({n.begin(), n.end()}));
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
  const int cases = 1500 * test::multiplier();
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const auto beyond = source.next(GetParam());
    SCOPED_TRACE(test::describe({m.begin(), m.end()}) +
                 test::describe({beyond.begin(), beyond.end()}));
    test::expect_true_after_flip(m, beyond, source.time(GetParam()), test::rounding_mode(i),
                                 counts);
    if (HasFatalFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(counts.flips, cases / 30);
    EXPECT_GT(counts.decided, counts.positive * 99 / 100);
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

}  // namespace
}  // namespace kinetri
