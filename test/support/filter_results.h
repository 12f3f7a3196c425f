// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks results of the filters by exact arithmetic.
#ifndef KINETRI_TEST_SUPPORT_FILTER_RESULTS_H
#define KINETRI_TEST_SUPPORT_FILTER_RESULTS_H

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cstddef>
#include <utility>

#include "kinetic/filter/disc_filter.h"
#include "kinetic/filter/filter.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri::test {

/// Expects that `result`, from `after` on, is true of the certificate with the polynomial `p`. A
/// root at `after` does not count.
inline void expect_true(const Filter_result& result, const Polynomial& p,
                        const Algebraic_number& after) {
  if (result.kind == Filter_result::Kind::unknown) return;
  // Strictly positive: no root before the end, not even a touch.
  ASSERT_FALSE(p.is_zero());
  ASSERT_EQ(sign_just_after(p, after), CGAL::POSITIVE);
  const auto root = first_root_after(p, after);
  if (result.kind != Filter_result::Kind::fails) {
    if (result.kind == Filter_result::Kind::never_fails) {
      ASSERT_FALSE(root) << "fails, but was said to hold for ever";
    } else if (root) {
      ASSERT_GT(root->value, Algebraic_number(result.bounds.upper));
    }
    return;
  }
  ASSERT_TRUE(root) << "never fails, but was said to";
  ASSERT_EQ(root->multiplicity, 1);
  ASSERT_GT(root->value, Algebraic_number(result.bounds.lower));
  ASSERT_LT(root->value, Algebraic_number(result.bounds.upper));
  const auto next = first_root_after(p, root->value);
  if (next) {
    ASSERT_GT(next->value, Algebraic_number(result.bounds.upper)) << "two roots in one bracket";
  }
}

/// The rounding modes, by turns.
inline int rounding_mode(int number_of_case) {
  constexpr std::array<int, 4> modes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  return modes[static_cast<std::size_t>(number_of_case) % modes.size()];
}

/// The result of `filter` in a rounding mode, which it must not change.
template <class Filter>
auto in_mode(int mode, const Filter& filter) {
  std::fesetround(mode);
  const auto result = filter();
  EXPECT_EQ(std::fegetround(), mode);
  std::fesetround(FE_TONEAREST);
  return result;
}

/// The number of in-circle certificates that a filter decided, and of those that fail.
struct Decided {
  int all = 0;
  int failures = 0;
};

/// Checks the filters in a rounding mode on the certificates of four points from `t` on, on their
/// negations, and on the negations after a failure.
template <class Motion>
void expect_true_certificates(const std::array<Motion, 4>& m, double t, int mode,
                              Decided& decided) {
  using Point = Basic_moving_point_2<Motion>;
  const Polynomial in_circle =
      in_circle_polynomial(Point(m[0]), Point(m[1]), Point(m[2]), Point(m[3]));
  const Polynomial orientation = orientation_polynomial(Point(m[0]), Point(m[1]), Point(m[2]));
  const auto expect = [&](const Polynomial& certificate, const auto& filter) {
    const Filter_result result = in_mode(mode, [&] {
      return filter(false, Double_interval{t, t}, false);
    });
    expect_true(result, certificate, t);
    if (testing::Test::HasFatalFailure() || result.kind != Filter_result::Kind::fails) {
      return result.kind;
    }
    // After a failure the negated certificate starts at a root.
    const auto root = first_root_after(certificate, t);
    EXPECT_TRUE(root);
    if (root) {
      expect_true(in_mode(mode, [&] { return filter(true, result.bounds, true); }), -certificate,
                  root->value);
    }
    return result.kind;
  };
  for (const bool is_negated : {false, true}) {
    const auto circle = [&](bool again, const Double_interval& after, bool vanishes) {
      const bool is_swapped = is_negated != again;
      return filter_in_circle(m[is_swapped ? 1 : 0], m[is_swapped ? 0 : 1], m[2], m[3], after,
                              vanishes);
    };
    const auto turn = [&](bool again, const Double_interval& after, bool vanishes) {
      const bool is_swapped = is_negated != again;
      return filter_orientation(m[is_swapped ? 1 : 0], m[is_swapped ? 0 : 1], m[2], after,
                                vanishes);
    };
    const auto kind = expect(is_negated ? in_circle : -in_circle, circle);
    if (testing::Test::HasFatalFailure()) return;
    decided.all += kind != Filter_result::Kind::unknown;
    decided.failures += kind == Filter_result::Kind::fails;
    expect(is_negated ? -orientation : orientation, turn);
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// Checks the filter in a rounding mode on two in-circle certificates at once, from `t` on. Adds
/// the number of decided ones to `decided`.
template <class Motion>
void expect_true_pair(const std::array<Motion, 4>& m, const std::array<Motion, 4>& n, double t,
                      int mode, int& decided) {
  using Point = Basic_moving_point_2<Motion>;
  const std::array<Quadruple<Motion>, 2> both = {
      {{&m[0], &m[1], &m[2], &m[3]}, {&n[0], &n[1], &n[2], &n[3]}}};
  const auto results = in_mode(mode, [&] { return filter_in_circles(both, {t, t}); });
  for (std::size_t k = 0; k < 2; ++k) {
    const auto [p, q, r, s] = both[k];
    const Polynomial certificate =
        -in_circle_polynomial(Point(*p), Point(*q), Point(*r), Point(*s));
    expect_true(results[k], certificate, t);
    if (testing::Test::HasFatalFailure()) return;
    decided += results[k].kind != Filter_result::Kind::unknown;
  }
}

/// The number of failed certificates; of the five after each flip, the number that hold, and of
/// these the number that a filter decided.
struct Decided_after_flips {
  int flips = 0;
  int positive = 0;
  int decided = 0;
};

/// Checks the filter in a rounding mode on the five certificates after a flip of the points `m`,
/// with the points `beyond`, at the bracket of the first failure from `t` on.
template <class Motion>
void expect_true_after_flip(std::array<Motion, 4> m, const std::array<Motion, 4>& beyond, double t,
                            int mode, Decided_after_flips& counts) {
  using Point = Basic_moving_point_2<Motion>;
  Filter_result failure = filter_in_circle(m[0], m[1], m[2], m[3], {t, t}, false);
  if (failure.kind == Filter_result::Kind::unknown) {
    std::swap(m[0], m[1]);
    failure = filter_in_circle(m[0], m[1], m[2], m[3], {t, t}, false);
  }
  if (failure.kind != Filter_result::Kind::fails) return;
  ++counts.flips;
  // Two corners are swapped, so that the failed certificate is positive from then on.
  const Flip_neighborhood<Motion> around = {{&m[1], &m[0], &m[2], &m[3]},
                                            {&beyond[0], &beyond[1], &beyond[2], &beyond[3]}};
  const auto results = in_mode(mode, [&] { return filter_after_flip(around, failure.bounds); });
  for (std::size_t k = 0; k < results.size(); ++k) {
    const auto [p, q, r, s] = around.certificate(k);
    const Polynomial certificate =
        -in_circle_polynomial(Point(*p), Point(*q), Point(*r), Point(*s));
    Algebraic_number after(failure.bounds.lower);
    if (k == 4) after = first_root_after(certificate, t).value().value;
    expect_true(results[k], certificate, after);
    if (testing::Test::HasFatalFailure()) return;
    if (sign_just_after(certificate, after) == CGAL::POSITIVE) {
      ++counts.positive;
      counts.decided += results[k].kind != Filter_result::Kind::unknown;
    }
  }
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_FILTER_RESULTS_H
