// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificates of distances: those of exact arithmetic against what is known by construction
// and against the definition at rational times; those with filters against the exact ones.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <concepts>
#include <optional>
#include <random>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/disc_certificates.h"
#include "support/discs.h"
#include "support/motions.h"
#include "support/on_failure.h"

namespace kinetri::distance_certificates_test {
namespace {

using Kind = Certificate::Kind;
using Time = Algebraic_number;

// The failure time at the end of the certificates, each of which must hold as far as it says.
// Counts how many of the certificates exact arithmetic has decided.
struct Counts {
  int certificates = 0;
  int exact = 0;
};
template <class Certificate_after, class Failure_in>
std::optional<Time> failure_of(const Certificate_after& certificate_after,
                               const Failure_in& failure_in, Time time, Counts& counts) {
  for (;;) {
    const Certificate certificate = certificate_after(time);
    ++counts.certificates;
    counts.exact += certificate.means == Certificate::Means::exact;
    if (certificate.kind == Kind::never_fails) return std::nullopt;
    if (certificate.kind == Kind::holds) {
      EXPECT_EQ(certificate.bounds.lower, certificate.bounds.upper);
      EXPECT_LT(time, Time(certificate.bounds.lower));
      time = certificate.bounds.lower;
      continue;
    }
    EXPECT_EQ(certificate.kind, Kind::fails);
    return certificate.failure ? *certificate.failure : failure_in(certificate.bounds);
  }
}

template <class Motion>
class Failures {
 public:
  using Point = Basic_moving_point_2<Motion>;
  using Traits = Basic_kinetic_traits_2<Motion>;

  explicit Failures(Arithmetic arithmetic) : traits_(arithmetic) {}

  std::optional<Time> apart(const Point& p, const Point& q, double range, const Time& t) {
    return failure_of(
        [&](const Time& after) { return traits_.apart_certificate(p, q, range, after); },
        [&](const Double_interval& in) { return traits_.contact_failure(p, q, range, in); }, t,
        counts_);
  }
  // Precondition: they part at t.
  std::optional<Time> next_apart(const Point& p, const Point& q, double range, const Time& t) {
    return failure_of(
        [&](const Time& after) {
          return after == t ? traits_.next_apart_certificate(p, q, range, after)
                            : traits_.apart_certificate(p, q, range, after);
        },
        [&](const Double_interval& in) { return traits_.contact_failure(p, q, range, in); }, t,
        counts_);
  }
  std::optional<Time> near(const Point& p, const Point& q, double range, const Time& t) {
    return failure_of(
        [&](const Time& after) { return traits_.near_certificate(p, q, range, after); },
        [&](const Double_interval& in) { return traits_.contact_failure(p, q, range, in); }, t,
        counts_);
  }
  std::optional<Time> closer(const Point& p, const Point& q, const Point& r, const Point& s,
                             const Time& t) {
    return failure_of(
        [&](const Time& after) { return traits_.closer_certificate(p, q, r, s, after); },
        [&](const Double_interval& in) { return traits_.closer_failure(p, q, r, s, in); }, t,
        counts_);
  }
  const Counts& counts() const { return counts_; }

 private:
  Traits traits_;
  Counts counts_;
};

// ---- by construction ----

class Distance_certificates : public testing::TestWithParam<Arithmetic> {
 protected:
  static Moving_point_2 moving(double x, double y, double vx, double vy) {
    return Moving_point_2(Linear_motion_2{{x, y}, {vx, vy}, 0});
  }

  Failures<Linear_motion_2> of{GetParam()};
  const Moving_point_2 origin = moving(0, 0, 0, 0);
  // At a distance of 5 at the times 6 and 14, of 3 at 10.
  const Moving_point_2 passing = moving(-10, 3, 1, 0);
};

TEST_P(Distance_certificates, of_a_point_that_passes_fail_when_it_comes_and_when_it_goes) {
  EXPECT_EQ(of.apart(origin, passing, 5, 0.0), Time(6.0));
  EXPECT_EQ(of.near(origin, passing, 5, 6.0), Time(14.0));
  EXPECT_EQ(of.near(origin, passing, 5, 10.0), Time(14.0));
  EXPECT_EQ(of.near(origin, passing, 5, 0.0), Time(0.0)) << "violated already";
  EXPECT_EQ(of.near(origin, passing, 5, 14.0), Time(14.0)) << "violated from now on";
  EXPECT_EQ(of.near(origin, passing, 5, 20.0), Time(20.0));
  EXPECT_EQ(of.apart(origin, passing, 5, 6.0), Time(6.0)) << "a touch now";
  EXPECT_EQ(of.apart(origin, passing, 5, 10.0), Time(10.0)) << "near already";
  EXPECT_EQ(of.apart(origin, passing, 5, 14.0), Time(14.0)) << "the last touch";
  EXPECT_EQ(of.apart(origin, passing, 5, 15.0), std::nullopt);
  EXPECT_EQ(of.next_apart(origin, passing, 5, 14.0), std::nullopt);
}

TEST_P(Distance_certificates, of_a_touch_of_no_duration_begin_and_end_with_it) {
  EXPECT_EQ(of.apart(origin, passing, 3, 0.0), Time(10.0));
  EXPECT_EQ(of.near(origin, passing, 3, 10.0), Time(10.0));
  EXPECT_EQ(of.apart(origin, passing, 3, 10.0), Time(10.0));
  EXPECT_EQ(of.apart(origin, passing, 3, 11.0), std::nullopt);
  EXPECT_EQ(of.apart(origin, passing, std::nextafter(3, 0), 0.0), std::nullopt);
  EXPECT_LT(*of.apart(origin, passing, std::nextafter(3, 4), 0.0), Time(10.0));
}

TEST_P(Distance_certificates, of_points_at_rest_hold_for_ever_or_are_violated) {
  const Moving_point_2 other = moving(3, 4, 0, 0);
  EXPECT_EQ(of.apart(origin, other, 4.5, 1.0), std::nullopt);
  EXPECT_EQ(of.apart(origin, other, 5, 1.0), Time(1.0));
  EXPECT_EQ(of.near(origin, other, 5, 1.0), std::nullopt);
  EXPECT_EQ(of.near(origin, other, 6, 1.0), std::nullopt);
  EXPECT_EQ(of.near(origin, other, 4.5, 1.0), Time(1.0));
  EXPECT_EQ(of.near(passing, passing, 0, 1.0), std::nullopt);
  EXPECT_EQ(of.closer(origin, other, origin, moving(4, 3, 0, 0), 1.0), std::nullopt) << "equal";
  EXPECT_EQ(of.closer(origin, other, origin, moving(4, 4, 0, 0), 1.0), std::nullopt);
  EXPECT_EQ(of.closer(origin, other, origin, moving(4, 2, 0, 0), 1.0), Time(1.0));
}

TEST_P(Distance_certificates, of_points_that_meet_have_the_range_zero) {
  const Moving_point_2 head_on = moving(-2, 4, 1, -2);
  EXPECT_EQ(of.apart(origin, head_on, 0, 0.0), Time(2.0));
  EXPECT_EQ(of.near(origin, head_on, 0, 2.0), Time(2.0));
}

TEST_P(Distance_certificates, of_two_pairs_fail_when_one_distance_becomes_greater) {
  // From the origin: 5 and at the times 6 and 14; of the other pair it is always 5.
  const Moving_point_2 far = moving(4, 3, 0, 0);
  EXPECT_EQ(of.closer(origin, passing, origin, far, 6.0), Time(14.0));
  EXPECT_EQ(of.closer(origin, passing, origin, far, 10.0), Time(14.0));
  EXPECT_EQ(of.closer(origin, far, origin, passing, 0.0), Time(6.0));
  EXPECT_EQ(of.closer(origin, far, origin, passing, 7.0), Time(7.0));
  EXPECT_EQ(of.closer(origin, far, origin, passing, 14.0), std::nullopt);
  EXPECT_EQ(of.closer(origin, passing, origin, passing, 0.0), std::nullopt) << "the same";
  // Both from a third point, with one velocity: of degree one.
  const Moving_point_2 from = moving(0, 0, 1, 0);
  EXPECT_EQ(of.closer(from, moving(2, 0, 0, 0), from, moving(6, 0, 0, 0), 0.0), Time(4.0));
  EXPECT_EQ(of.closer(from, moving(6, 0, 0, 0), from, moving(2, 0, 0, 0), 4.0), std::nullopt);
}

TEST_P(Distance_certificates, of_accelerated_points_find_each_touch) {
  using Point = Basic_moving_point_2<Polynomial_motion_2>;
  Failures<Polynomial_motion_2> of_curves(GetParam());
  const Point at_rest(Polynomial_motion_2{});
  // (t - 3)^2 + 2: at most 6 from 1 to 5, and 2 at 3.
  const Point thrown(Polynomial_motion_2{{11, 0}, {-6, 0}, {2, 0}, {0, 0}, 0});
  EXPECT_EQ(of_curves.apart(at_rest, thrown, 6, 0.0), Time(1.0));
  EXPECT_EQ(of_curves.near(at_rest, thrown, 6, 1.0), Time(5.0));
  EXPECT_EQ(of_curves.near(at_rest, thrown, 6, 4.0), Time(5.0));
  EXPECT_EQ(of_curves.apart(at_rest, thrown, 2, 0.0), Time(3.0));
  EXPECT_EQ(of_curves.near(at_rest, thrown, 2, 3.0), Time(3.0));
  EXPECT_EQ(of_curves.apart(at_rest, thrown, 1, 0.0), std::nullopt);
  EXPECT_EQ(of_curves.apart(at_rest, thrown, 6, 6.0), std::nullopt);
  EXPECT_EQ(of_curves.next_apart(at_rest, thrown, 6, 5.0), std::nullopt);
  // (t - 1) (t - 3) (t - 5): they meet three times; and it is 15 at 0 and at 6.
  const Point back_and_forth(Polynomial_motion_2{{-15, 0}, {23, 0}, {-18, 0}, {6, 0}, 0});
  EXPECT_EQ(of_curves.apart(at_rest, back_and_forth, 0, 0.0), Time(1.0));
  EXPECT_EQ(of_curves.near(at_rest, back_and_forth, 0, 1.0), Time(1.0));
  EXPECT_EQ(of_curves.next_apart(at_rest, back_and_forth, 0, 1.0), Time(3.0));
  EXPECT_EQ(of_curves.next_apart(at_rest, back_and_forth, 0, 3.0), Time(5.0));
  EXPECT_EQ(of_curves.next_apart(at_rest, back_and_forth, 0, 5.0), std::nullopt);
  // 3 at 2 and at (7 -+ sqrt 13) / 2, -3 at 4 and at (5 -+ sqrt 13) / 2.
  const std::optional<Time> end = of_curves.near(at_rest, back_and_forth, 3, 1.0);
  ASSERT_TRUE(end && *end > Time(1.69) && *end < Time(1.7));
  EXPECT_EQ(of_curves.next_apart(at_rest, back_and_forth, 3, *end), Time(2.0));
  EXPECT_EQ(of_curves.near(at_rest, back_and_forth, 3, 2.0), Time(4.0));
  const std::optional<Time> again = of_curves.next_apart(at_rest, back_and_forth, 3, 4.0);
  ASSERT_TRUE(again && *again > Time(4.3) && *again < Time(4.31));
  const std::optional<Time> last = of_curves.near(at_rest, back_and_forth, 3, *again);
  ASSERT_TRUE(last && *last > Time(5.3) && *last < Time(5.31));
  EXPECT_EQ(of_curves.next_apart(at_rest, back_and_forth, 3, *last), std::nullopt);
  const Point far(Polynomial_motion_2{{0, 6}, {0, 0}, {0, 0}, {0, 0}, 0});
  EXPECT_EQ(of_curves.closer(at_rest, far, at_rest, thrown, 0.0), Time(1.0));
  EXPECT_EQ(of_curves.closer(at_rest, thrown, at_rest, far, 1.0), Time(5.0));
}

TEST_P(Distance_certificates, of_discs_are_about_their_rims) {
  using Point = Basic_moving_point_2<Disc_motion_2>;
  Failures<Disc_motion_2> of_discs(GetParam());
  const auto disc = [](double x, double vx, double radius, double growth) {
    return Point(Disc_motion_2{Linear_motion_2{{x, 0}, {vx, 0}, 0}, radius, growth, 0});
  };
  EXPECT_EQ(of_discs.apart(disc(0, 0, 1, 0), disc(10, -1, 2, 0), 3, 0.0), Time(4.0));
  EXPECT_EQ(of_discs.near(disc(0, 0, 1, 0), disc(10, -1, 2, 0), 3, 4.0), Time(16.0));
  // Growing faster than they move apart, as fast, and less fast.
  EXPECT_EQ(of_discs.apart(disc(0, 0, 1, 2), disc(10, 1, 2, 0), 3, 0.0), Time(4.0));
  EXPECT_EQ(of_discs.near(disc(0, 0, 1, 2), disc(10, 1, 2, 0), 3, 4.0), std::nullopt);
  EXPECT_EQ(of_discs.apart(disc(0, 0, 1, 1), disc(10, 1, 2, 0), 3, 0.0), std::nullopt);
  EXPECT_EQ(of_discs.near(disc(0, 0, 1, 0), disc(5, 3, 2, 1), 4, 0.0), Time(1.0));
  // The centers decide.
  EXPECT_EQ(
      of_discs.closer(disc(0, 0, 9, 5), disc(1, 1, 9, 5), disc(0, 0, 0, 0), disc(3, 0, 0, 0), 0.0),
      Time(2.0));
}

INSTANTIATE_TEST_SUITE_P(Arithmetics, Distance_certificates,
                         testing::Values(Arithmetic::filtered, Arithmetic::exact_only),
                         [](const auto& instance) {
                           return instance.param == Arithmetic::filtered ? "filtered" : "exact";
                         });

// ---- the definition, at rational times ----

template <class Motion>
Rational reach_at(const Motion& p, const Motion& q, double range, const Rational& t) {
  Rational reach = to_rational(range);
  if constexpr (HasWeight<Motion>) reach += test::radius_at(p, t) + test::radius_at(q, t);
  return reach;
}
// The squared distance less that of the reach.
template <class Motion>
Rational excess_at(const Motion& p, const Motion& q, double range, const Rational& t) {
  const Rational reach = reach_at(p, q, range, t);
  return CGAL::squared_distance(test::place_at(center(p), t), test::place_at(center(q), t)) -
         reach * reach;
}

// The condition must hold from t on up to the failure, looked at at many times, and be violated
// just after it; or, of a `touch`, be violated at it but for how exactly the time is known.
template <class Value_at>
void expect_first_failure(const std::optional<Time>& failure, const Value_at& value_at, double t,
                          bool is_strict) {
  const Rational from = to_rational(t);
  const auto holds_at = [&](const Rational& time) {
    return is_strict ? value_at(time) > 0 : value_at(time) >= 0;
  };
  const Rational step(1, 1 << 20);
  if (!failure) {
    for (int k = 0; k < 200; ++k) ASSERT_TRUE(holds_at(from + Rational(k * k, 97)));
    return;
  }
  ASSERT_GE(*failure, Time(t));
  failure->refine_to(step / 1024);
  const Rational before = failure->lower();
  if (*failure > Time(t)) {
    for (int k = 0; k < 40; ++k) ASSERT_TRUE(holds_at(from + (before - from) * k / 40)) << k;
  }
  if (is_strict) {
    // A root, be it double: the value is small there, or negative beside it.
    ASSERT_TRUE(value_at(failure->upper() + step) <= 0 || value_at(before) < Rational(1, 1000));
  } else {
    ASSERT_LT(value_at(failure->upper() + step), 0);
  }
}

template <class Motion>
void expect_definition(const std::vector<Motion>& m, unsigned seed, int& failures) {
  using Point = Basic_moving_point_2<Motion>;
  Failures<Motion> of(Arithmetic::exact_only);
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i + 3 < m.size(); i += 4) {
    const double range = static_cast<double>(random() % 7);
    const double t = static_cast<double>(random() % 5);
    const std::array points = {Point(m[i]), Point(m[i + 1]), Point(m[i + 2]), Point(m[i + 3])};
    const auto& [p, q, r, s] = points;
    const test::On_failure trace([&] {
      return testing::Message() << points[0] << '\n'
                                << points[1] << "\nrange " << range << ", time " << t;
    });
    const auto excess = [&](const Rational& time) {
      return excess_at(m[i], m[i + 1], range, time);
    };
    const auto apart = of.apart(p, q, range, t);
    expect_first_failure(apart, excess, t, true);
    if (testing::Test::HasFatalFailure()) return;
    expect_first_failure(
        of.near(p, q, range, t), [&](const Rational& time) { return Rational(-excess(time)); }, t,
        false);
    if (testing::Test::HasFatalFailure()) return;
    const auto comparison = [&](const Rational& time) {
      return Rational(excess_at(center(m[i + 2]), center(m[i + 3]), 0, time) -
                      excess_at(center(m[i]), center(m[i + 1]), 0, time));
    };
    const auto closer = of.closer(p, q, r, s, t);
    expect_first_failure(closer, comparison, t, false);
    if (testing::Test::HasFatalFailure()) return;
    failures += apart.has_value() + closer.has_value();
  }
}

TEST(Exact_distance_certificates, are_those_of_the_definition) {
  constexpr std::size_t n = 400;
  int failures = 0;
  for (int run = 0; run < test::cases(1); ++run) {
    const auto seed = [run](unsigned k) { return k + 100 * static_cast<unsigned>(run); };
    expect_definition(test::grid_motions(n, 12, 3, seed(41)), seed(51), failures);
    if (HasFatalFailure()) return;
    expect_definition(test::polynomial_grid_motions(n, 12, 3, 3, seed(42)), seed(52), failures);
    if (HasFatalFailure()) return;
    std::vector<Disc_motion_2> discs;
    std::mt19937_64 random(seed(43));
    for (const Linear_motion_2& line : test::grid_motions(n, 12, 3, seed(44))) {
      discs.push_back(
          {line, static_cast<double>(random() % 4), static_cast<double>(random() % 3), 0});
    }
    expect_definition(discs, seed(53), failures);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(failures, test::cases(static_cast<int>(n) / 4));
}

// ---- the filters ----

struct Compared {
  int all = 0;
  int failures = 0;
};

// Both ways of arithmetic, from the time on, and after each failure what follows.
template <class Motion>
class Both {
 public:
  using Point = Basic_moving_point_2<Motion>;

  void expect_equal_ranges(const Point& p, const Point& q, double range, const Time& t) {
    // Apart, near, apart; and from the same time on, near, apart, near.
    for (const int first : {0, 1}) {
      std::optional<Time> time = t;
      bool has_parted = false;
      for (int k = first; k < first + 3 && time; ++k) {
        const Time since = *time;
        const auto failure = [&](auto& of) {
          if (k % 2 == 1) return of.near(p, q, range, since);
          return has_parted ? of.next_apart(p, q, range, since) : of.apart(p, q, range, since);
        };
        time = expect_equal(failure(filtered_), failure(exact_));
        if (testing::Test::HasFatalFailure()) return;
        has_parted = k % 2 == 1 && time && *time > since;
      }
    }
  }
  void expect_equal_comparisons(const Point& p, const Point& q, const Point& r, const Point& s,
                                const Time& t) {
    std::optional<Time> time = t;
    for (int k = 0; k < 4 && time; ++k) {
      time = expect_equal(
          k % 2 == 0 ? filtered_.closer(p, q, r, s, *time) : filtered_.closer(r, s, p, q, *time),
          k % 2 == 0 ? exact_.closer(p, q, r, s, *time) : exact_.closer(r, s, p, q, *time));
      if (testing::Test::HasFatalFailure()) return;
    }
  }

  const Counts& counts() const { return filtered_.counts(); }
  int failures() const { return failures_; }

 private:
  std::optional<Time> expect_equal(const std::optional<Time>& filtered,
                                   const std::optional<Time>& exact) {
    EXPECT_EQ(filtered.has_value(), exact.has_value());
    if (!filtered || !exact) return std::nullopt;
    ++failures_;
    // First what is rounded from the bracket, before a comparison makes the exact number.
    EXPECT_EQ(filtered->to_double(), exact->to_double());
    EXPECT_EQ(filtered->tight_interval(), exact->tight_interval());
    EXPECT_EQ(*filtered, *exact);
    if (testing::Test::HasFailure()) {
      [] { FAIL(); }();
    }
    return filtered;
  }

  Failures<Motion> filtered_{Arithmetic::filtered};
  Failures<Motion> exact_{Arithmetic::exact_only};
  int failures_ = 0;
};

// Four motions, for certificates from t on.
template <class Motion>
std::array<Motion, 4> next(test::Certificates& lines, test::Disc_certificates<Disc_motion_2>& discs,
                           test::Disc_certificates<Polynomial_disc_motion_2>& curved,
                           std::mt19937_64& random, int flavor, int i, double t) {
  if constexpr (std::same_as<Motion, Linear_motion_2>) return lines.next(flavor);
  if constexpr (std::same_as<Motion, Polynomial_motion_2>) {
    return test::bent(lines.next(flavor), random);
  }
  if constexpr (std::same_as<Motion, Disc_motion_2>) return discs.next(i % test::kinds, t);
  if constexpr (std::same_as<Motion, Polynomial_disc_motion_2>) {
    return curved.next(i % test::kinds, t);
  }
}

template <class Motion>
void expect_same_as_exact(int flavor, int cases, int greatest_exact_share) {
  using Point = Basic_moving_point_2<Motion>;
  test::Certificates lines(601);
  test::Disc_certificates<Disc_motion_2> discs(flavor, 602);
  test::Disc_certificates<Polynomial_disc_motion_2> curved(flavor, 603);
  std::mt19937_64 random(604);
  Both<Motion> ranges;
  Both<Motion> comparisons;
  for (int i = 0; i < cases; ++i) {
    const double t = lines.time(flavor);
    auto m = next<Motion>(lines, discs, curved, random, flavor, i, t);
    if (i % 3 == 1) m[2] = m[0];
    if (i % 8 == 3) m[3].velocity = m[1].velocity;
    const test::On_failure trace([&] {
      return testing::Message() << test::describe_discs(m) << "case " << i << ", time " << t;
    });
    const Vector_2 a = rounded_place(center(m[0]), i % 4 == 0 ? t : t + 1);
    const Vector_2 b = rounded_place(center(m[1]), i % 4 == 0 ? t : t + 1);
    double range = std::abs(a.x - b.x);
    if (i % 2 == 1) range *= std::ldexp(1.0, static_cast<int>(random() % 5) - 2);
    if (!std::isfinite(range)) continue;
    const std::array points = {Point(m[0], 0), Point(m[1], 1), Point(m[2], 2), Point(m[3], 3)};
    const auto& [p, q, r, s] = points;
    ranges.expect_equal_ranges(p, q, range, t);
    if (testing::Test::HasFatalFailure()) return;
    comparisons.expect_equal_comparisons(p, q, r, s, t);
    if (testing::Test::HasFatalFailure()) return;
  }
  if (flavor == 0) {
    EXPECT_GT(ranges.failures(), cases / 2);
    EXPECT_GT(comparisons.failures(), cases / 2);
    for (const Counts& counts : {ranges.counts(), comparisons.counts()}) {
      // Among them those at a root, after a failure.
      EXPECT_LE(counts.exact, counts.certificates * greatest_exact_share / 100)
          << counts.certificates;
    }
  }
}

class Filtered_distance_certificates : public testing::TestWithParam<int> {};

TEST_P(Filtered_distance_certificates, are_those_of_exact_arithmetic) {
  expect_same_as_exact<Linear_motion_2>(GetParam(), test::cases(200), 60);
}
TEST_P(Filtered_distance_certificates, of_curves_are_those_of_exact_arithmetic) {
  expect_same_as_exact<Polynomial_motion_2>(GetParam(), test::cases(50), 60);
}
TEST_P(Filtered_distance_certificates, of_discs_are_those_of_exact_arithmetic) {
  expect_same_as_exact<Disc_motion_2>(GetParam(), test::cases(240), 70);
}
TEST_P(Filtered_distance_certificates, of_curved_discs_are_those_of_exact_arithmetic) {
  expect_same_as_exact<Polynomial_disc_motion_2>(GetParam(), test::cases(40), 100);
}

INSTANTIATE_TEST_SUITE_P(Flavors, Filtered_distance_certificates,
                         testing::Range(0, test::Certificates::flavors), test::flavor_name);

}  // namespace
}  // namespace kinetri::distance_certificates_test
