// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filters of distances never contradict exact arithmetic: from a time, throughout an interval,
// and after a root of their own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <concepts>
#include <random>
#include <type_traits>

#include "kinetic/filter/filter.h"
#include "kinetic/filter/precise_filter.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/disc_certificates.h"
#include "support/discs.h"
#include "support/filter_results.h"
#include "support/on_failure.h"

namespace kinetri::distance_filter_test {
namespace {

using Kind = Filter_result::Kind;

// Four motions of every kind, for certificates from t on.
template <class Motion>
class Source {
 public:
  Source(int flavor, unsigned seed) : flavor_(flavor), lines_(seed), discs_(flavor, seed) {}

  double time() { return lines_.time(flavor_); }
  std::array<Motion, 4> next(int i, double t) {
    if constexpr (HasWeight<Motion>) {
      return discs_.next(i % test::kinds, t);
    } else if constexpr (std::same_as<Motion, Linear_motion_2>) {
      return lines_.next(flavor_);
    } else {
      return test::bent(lines_.next(flavor_), random_);
    }
  }

 private:
  using Disc = std::conditional_t<HasWeight<Motion>, Motion, Disc_motion_2>;
  int flavor_;
  test::Certificates lines_;
  test::Disc_certificates<Disc> discs_;
  std::mt19937_64 random_{17};
};

// Of the size of their distance at some time, or just the distance at the time itself.
template <class Motion>
double range_of(const Motion& p, const Motion& q, double t, int i) {
  const bool is_touch = i % 7 == 5;
  const Vector_2 a = rounded_place(p, is_touch ? t : t + 1);
  const Vector_2 b = rounded_place(q, is_touch ? t : t + 1);
  if (is_touch) return std::hypot(a.x - b.x, a.y - b.y);
  return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) * std::ldexp(1.0, i % 5 - 3);
}

struct Counts {
  int all = 0;
  int decided = 0;
  int fails = 0;
  int after_root = 0;  // after a failure
  int decided_after_root = 0;
};

// Checks what `filter` says of p. Returns what it says from the time on.
template <class Filter>
Filter_result expect_true(const Polynomial& p, double t, int mode, const Filter& filter,
                          Counts& counts) {
  Filter_result from_time;
  for (const double width : {0.0, 0x1p-40, 1.0}) {
    const Double_interval after = {t, t + width};
    const Filter_result result = test::in_mode(mode, [&] { return filter(after); });
    for (const double time : {after.lower, after.lower + width / 3, after.upper}) {
      test::expect_true(result, p, time);
      if (result.kind != Kind::unknown) {
        EXPECT_EQ(p.sign_at(to_rational(time)), CGAL::POSITIVE);
      }
    }
    if (result.kind == Kind::fails) {
      EXPECT_GT(result.bounds.lower, after.upper);
      EXPECT_EQ(p.sign_at(to_rational(result.bounds.lower)), CGAL::POSITIVE);
      EXPECT_EQ(p.sign_at(to_rational(result.bounds.upper)), CGAL::NEGATIVE);
    }
    if (width == 0 && p.sign_at(to_rational(t)) == CGAL::POSITIVE) {
      ++counts.all;
      counts.decided += result.kind != Kind::unknown;
      counts.fails += result.kind == Kind::fails;
    }
    if (width == 0) from_time = result;
    if (testing::Test::HasFailure()) break;
  }
  return from_time;
}

// Checks what `reverse` says of -p after a failure of p.
template <class Reverse>
void expect_true_after(const Filter_result& failure, const Polynomial& p, int mode,
                       const Reverse& reverse, Counts& counts) {
  if (failure.kind != Kind::fails) return;
  const Filter_result next = test::in_mode(mode, [&] { return reverse(failure.bounds); });
  const auto root = first_root_after(p, Algebraic_number(failure.bounds.lower));
  ASSERT_TRUE(root);
  test::expect_true(next, -p, root->value);
  ++counts.after_root;
  counts.decided_after_root += next.kind != Kind::unknown;
}

class Distance_filter : public testing::TestWithParam<int> {};

template <class Motion>
Counts expect_true_ranges(int flavor, int cases) {
  using Point = Basic_moving_point_2<Motion>;
  Source<Motion> source(flavor, 310);
  Counts counts;
  Counts of_touches;
  for (int i = 0; i < cases; ++i) {
    const double t = source.time();
    const auto m = source.next(i, t);
    const double range = range_of(m[0], m[1], t, i);
    if (!std::isfinite(range)) continue;
    const test::On_failure trace([&] {
      return testing::Message() << test::describe_discs(std::array{m[0], m[1]}) << "range " << range
                                << ", time " << t;
    });
    const int mode = test::rounding_mode(i);
    const Polynomial distance = contact_polynomial(Point(m[0]), Point(m[1]), range);
    const auto near = [&](const Double_interval& after, bool vanishes_at) {
      return filter_near(m[0], m[1], range, after, vanishes_at);
    };
    Counts& of_case = i % 7 == 5 || i % test::kinds == test::touching ? of_touches : counts;
    const Filter_result begin = expect_true(
        distance, t, mode,
        [&](const Double_interval& after) { return filter_apart(m[0], m[1], range, after, false); },
        of_case);
    expect_true_after(
        begin, distance, mode, [&](const Double_interval& at) { return near(at, true); }, of_case);
    const Filter_result end = expect_true(
        -distance, t, mode, [&](const Double_interval& after) { return near(after, false); },
        of_case);
    if constexpr (!std::same_as<Center_motion_of<Motion>, Linear_motion_2>) {
      expect_true_after(
          end, -distance, mode,
          [&](const Double_interval& at) { return filter_apart(m[0], m[1], range, at, true); },
          of_case);
    }
    if (testing::Test::HasFailure()) return counts;
  }
  return counts;
}

// The other two as the mirror images of the first two, but for some units in the last place, so
// that both distances are nearly, or just, the same all the time.
template <class Motion>
void mirror(std::array<Motion, 4>& m, int i) {
  const auto mirrored = [](const Vector_2& v) { return Vector_2{v.y, v.x}; };
  for (std::size_t k = 0; k < 2; ++k) {
    m[k + 2] = m[k];
    m[k + 2].position = mirrored(m[k].position);
    m[k + 2].velocity = mirrored(m[k].velocity);
  }
  m[2].position.x *= 1 + std::ldexp(i % 3 - 1, -52);
  m[3].position.y *= 1 + std::ldexp(i % 5 - 2, -51);
  m[3].velocity.x *= 1 + std::ldexp(i % 9 - 4, -52);
}

template <class Motion>
Counts expect_true_comparisons(int flavor, int cases) {
  using Point = Basic_moving_point_2<Motion>;
  Source<Motion> source(flavor, 311);
  Counts counts;
  Counts of_near_ties;
  for (int i = 0; i < cases; ++i) {
    const double t = source.time();
    auto m = source.next(i, t);
    if (i % 4 == 1) m[2] = m[0];  // one point in both pairs
    if (i % 8 == 3) m[2] = m[1];  // on the other side
    if (i % 16 == 5) m[3].velocity = m[1].velocity;
    const bool are_nearly_equal = i % 7 == 6;
    if (are_nearly_equal) mirror(m, i);
    const test::On_failure trace(
        [&] { return testing::Message() << test::describe_discs(m) << "time " << t; });
    const int mode = test::rounding_mode(i);
    const Polynomial p =
        distance_comparison_polynomial(Point(m[0]), Point(m[1]), Point(m[2]), Point(m[3]));
    const Filter_result failure = expect_true(
        p, t, mode,
        [&](const Double_interval& after) {
          return filter_closer(m[0], m[1], m[2], m[3], after, false);
        },
        are_nearly_equal ? of_near_ties : counts);
    expect_true_after(
        failure, p, mode,
        [&](const Double_interval& at) { return filter_closer(m[2], m[3], m[0], m[1], at, true); },
        counts);
    for (const double width : {0.0, 0x1p-40, 1.0}) {
      const Sign sign = test::in_mode(mode, [&] {
        return certain_distance_comparison(m[0], m[1], m[2], m[3], {t, t + width});
      });
      if (sign == CGAL::ZERO) continue;
      for (const double time : {t, t + width / 3, t + width}) {
        EXPECT_EQ(p.sign_at(to_rational(time)), sign);
      }
    }
    if (testing::Test::HasFailure()) return counts;
  }
  return counts;
}

// Cases in which nothing is special, from the time itself on: all but few are decided.
void expect_most_decided(const Counts& counts, int share, int share_after_root) {
  EXPECT_GT(counts.fails, 0);
  EXPECT_GE(counts.decided, counts.all * share / 100);
  EXPECT_GE(counts.decided_after_root, counts.after_root * share_after_root / 100);
}

TEST_P(Distance_filter, of_ranges_never_contradicts_exact_arithmetic) {
  const Counts counts = expect_true_ranges<Linear_motion_2>(GetParam(), test::cases(1000));
  if (GetParam() == 0) expect_most_decided(counts, 99, 99);
}
TEST_P(Distance_filter, of_ranges_of_curves_never_contradicts_exact_arithmetic) {
  const Counts counts = expect_true_ranges<Polynomial_motion_2>(GetParam(), test::cases(250));
  if (GetParam() == 0) expect_most_decided(counts, 95, 60);
}
TEST_P(Distance_filter, of_ranges_of_discs_never_contradicts_exact_arithmetic) {
  const Counts counts = expect_true_ranges<Disc_motion_2>(GetParam(), test::cases(800));
  if (GetParam() == 0) expect_most_decided(counts, 85, 60);
}
TEST_P(Distance_filter, of_ranges_of_curved_discs_never_contradicts_exact_arithmetic) {
  expect_true_ranges<Polynomial_disc_motion_2>(GetParam(), test::cases(200));
}

TEST_P(Distance_filter, of_comparisons_never_contradicts_exact_arithmetic) {
  const Counts counts = expect_true_comparisons<Linear_motion_2>(GetParam(), test::cases(1000));
  if (GetParam() == 0) expect_most_decided(counts, 98, 95);
}
TEST_P(Distance_filter, of_comparisons_of_curves_never_contradicts_exact_arithmetic) {
  const Counts counts = expect_true_comparisons<Polynomial_motion_2>(GetParam(), test::cases(250));
  if (GetParam() == 0) expect_most_decided(counts, 95, 60);
}
TEST_P(Distance_filter, of_comparisons_of_discs_is_about_centers) {
  expect_true_comparisons<Disc_motion_2>(GetParam(), test::cases(200));
}

INSTANTIATE_TEST_SUITE_P(Flavors, Distance_filter, testing::Range(0, test::Certificates::flavors),
                         test::flavor_name);

}  // namespace
}  // namespace kinetri::distance_filter_test
