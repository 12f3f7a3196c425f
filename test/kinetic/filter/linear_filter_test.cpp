// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter never contradicts exact arithmetic: every result on random, nearly degenerate and
// wild certificates is checked against exact failure times. And it decides what it is there for.
#include "kinetic/filter/filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <limits>
#include <utility>

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
  constexpr std::array<int, 4> modes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    SCOPED_TRACE(test::describe({m.begin(), m.end()}));
    const double t = source.time(GetParam());
    test::expect_true_certificates(m, t, modes[static_cast<std::size_t>(i) % modes.size()],
                                   decided);
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
  constexpr std::array<int, 4> modes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const auto n = source.next(GetParam());
    SCOPED_TRACE(test::describe({m.begin(), m.end()}) + test::describe({n.begin(), n.end()}));
    const double t = source.time(GetParam());
    const std::array<Quadruple<Linear_motion_2>, 2> both = {
        {{&m[0], &m[1], &m[2], &m[3]}, {&n[0], &n[1], &n[2], &n[3]}}};
    std::fesetround(modes[static_cast<std::size_t>(i) % modes.size()]);
    const auto results = filter_in_circles(both, {t, t});
    std::fesetround(FE_TONEAREST);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto [p, q, r, s] = both[k];
      const Polynomial certificate = -in_circle_polynomial(Moving_point_2(*p), Moving_point_2(*q),
                                                           Moving_point_2(*r), Moving_point_2(*s));
      test::expect_true(results[k], certificate, t);
      if (HasFatalFailure()) return;
      decided += results[k].kind != Filter_result::Kind::unknown;
    }
  }
  if (GetParam() == 0) {
    EXPECT_GT(decided, cases * 99 / 100) << "of the certificates, half hold at the start";
  }
}

// Of the five certificates after a flip, at the bracket of its time.
TEST_P(Linear_filter, after_a_flip_never_contradicts_exact_arithmetic) {
  constexpr unsigned seed = 315;
  test::Certificates source(seed);
  int positive = 0;
  int decided = 0;
  int flips = 0;
  const int cases = 1500 * test::multiplier();
  constexpr std::array<int, 4> modes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  for (int i = 0; i < cases; ++i) {
    auto m = source.next(GetParam());
    const auto beyond = source.next(GetParam());
    SCOPED_TRACE(test::describe({m.begin(), m.end()}) +
                 test::describe({beyond.begin(), beyond.end()}));
    const double t = source.time(GetParam());
    Filter_result failure = filter_in_circle(m[0], m[1], m[2], m[3], {t, t}, false);
    if (failure.kind == Filter_result::Kind::unknown) {
      std::swap(m[0], m[1]);
      failure = filter_in_circle(m[0], m[1], m[2], m[3], {t, t}, false);
    }
    if (failure.kind != Filter_result::Kind::fails) continue;
    ++flips;
    // Two corners have changed places, so that what has failed is positive from then on.
    const Flip_neighborhood<Linear_motion_2> around = {
        {&m[1], &m[0], &m[2], &m[3]}, {&beyond[0], &beyond[1], &beyond[2], &beyond[3]}};
    std::fesetround(modes[static_cast<std::size_t>(i) % modes.size()]);
    const auto results = filter_after_flip(around, failure.bounds);
    std::fesetround(FE_TONEAREST);
    for (std::size_t k = 0; k < results.size(); ++k) {
      const auto [p, q, r, s] = around.certificate(k);
      const Polynomial certificate = -in_circle_polynomial(Moving_point_2(*p), Moving_point_2(*q),
                                                           Moving_point_2(*r), Moving_point_2(*s));
      Algebraic_number after(failure.bounds.lower);
      if (k == 4) after = first_root_after(certificate, t).value().value;
      test::expect_true(results[k], certificate, after);
      if (HasFatalFailure()) return;
      if (sign_just_after(certificate, after) == CGAL::POSITIVE) {
        ++positive;
        decided += results[k].kind != Filter_result::Kind::unknown;
      }
    }
  }
  if (GetParam() == 0) {
    EXPECT_GT(flips, cases / 30);
    EXPECT_GT(decided, positive * 99 / 100);
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

}  // namespace
}  // namespace kinetri
