// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter never contradicts exact arithmetic: every verdict on random, nearly degenerate and
// wild certificates is checked against exact failure times. And it decides what it is there for.
#include "kinetri/kinetic/linear_filter.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/motions.h"
#include "support/verdicts.h"

namespace kinetri {
namespace {

class Linear_filter : public testing::TestWithParam<int> {};

TEST_P(Linear_filter, never_contradicts_exact_arithmetic) {
  constexpr unsigned seed = 314;
  test::Certificates source(seed);
  int decided = 0;
  int failures = 0;
  const int cases = 1500 * test::multiplier();
  constexpr std::array<int, 4> modes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  for (int i = 0; i < cases; ++i) {
    const int mode = modes[static_cast<std::size_t>(i) % modes.size()];
    const auto m = source.next(GetParam());
    SCOPED_TRACE(test::describe({m.begin(), m.end()}));
    const double t = source.time(GetParam());
    const Moving_point_2 p(m[0]);
    const Moving_point_2 q(m[1]);
    const Moving_point_2 r(m[2]);
    const Moving_point_2 s(m[3]);
    for (const bool is_negated : {false, true}) {
      const Linear_motion_2& a = m[is_negated ? 1 : 0];
      const Linear_motion_2& b = m[is_negated ? 0 : 1];
      Polynomial circle = in_circle_polynomial(p, q, r, s);
      if (!is_negated) circle = -circle;
      const Filter_verdict verdict = test::in_mode(mode, [&] {
        return filter_in_circle(a, b, m[2], m[3], {t, t}, false);
      });
      test::expect_true(verdict, circle, t);
      if (HasFatalFailure()) return;
      decided += verdict.kind != Filter_verdict::Kind::unknown;

      // After its failure, the negated certificate goes on from a root.
      if (verdict.kind == Filter_verdict::Kind::fails) {
        ++failures;
        const auto root = first_root_after(circle, t);
        ASSERT_TRUE(root);
        const Filter_verdict beyond = test::in_mode(
            mode, [&] { return filter_in_circle(b, a, m[2], m[3], verdict.bounds, true); });
        test::expect_true(beyond, -circle, root->value);
        if (HasFatalFailure()) return;
      }

      Polynomial turn = orientation_polynomial(p, q, r);
      if (is_negated) turn = -turn;
      const Filter_verdict turn_verdict = test::in_mode(mode, [&] {
        return filter_orientation(a, b, m[2], {t, t}, false);
      });
      test::expect_true(turn_verdict, turn, t);
      if (HasFatalFailure()) return;
      if (turn_verdict.kind == Filter_verdict::Kind::fails) {
        const auto root = first_root_after(turn, t);
        ASSERT_TRUE(root);
        test::expect_true(filter_orientation(b, a, m[2], turn_verdict.bounds, true), -turn,
                          root->value);
        if (HasFatalFailure()) return;
      }
    }
    if (certainly_apart(m[0], m[1], {t, t})) {
      const Polynomial x = x_difference(p, q);
      const Polynomial y = y_difference(p, q);
      // A common root would be one of the gcd.
      ASSERT_LE(gcd(x, y).degree(), 0) << "they meet, but were said not to";
    }
  }
  if (GetParam() == 0) {
    EXPECT_GT(decided, cases * 99 / 100) << "of the certificates, half hold at the start";
    EXPECT_GT(failures, cases / 30);
  }
}

INSTANTIATE_TEST_SUITE_P(Flavors, Linear_filter, testing::Range(0, test::Certificates::flavors),
                         test::flavor_name);

TEST(Linear_filter, knows_nothing_where_numbers_overflow) {
  const double huge = std::numeric_limits<double>::max();
  const Filter_verdict verdict =
      filter_in_circle({{-huge, 0}, {0, 0}, 0}, {{0, -huge}, {0, 0}, 0}, {{huge, 0}, {0, 0}, 0},
                       {{0, huge}, {huge, huge}, 0}, {0, 0}, false);
  EXPECT_EQ(verdict.kind, Filter_verdict::Kind::unknown);
}

}  // namespace
}  // namespace kinetri
