// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/basic_kinetic_traits_2.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/motions.h"
#include "support/on_failure.h"

namespace kinetri::basic_kinetic_traits_2_test {
namespace {

Moving_point_2 moving(double x, double y, double vx, double vy, double epoch = 0) {
  return Moving_point_2(Linear_motion_2{{x, y}, {vx, vy}, epoch});
}
Moving_point_2 resting(double x, double y) {
  return moving(x, y, 0, 0);
}

using Kind = Certificate::Kind;

constexpr Double_interval for_ever = {-std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::infinity()};

// The failure time at the end of the certificates, each of which must hold as far as it says.
template <class Certificate_after, class Failure_in>
std::optional<Algebraic_number> failure_of(const Certificate_after& certificate_after,
                                           const Failure_in& failure_in, Algebraic_number time) {
  Certificate certificate = certificate_after(time);
  while (certificate.kind == Kind::holds) {
    EXPECT_EQ(certificate.bounds.lower, certificate.bounds.upper);
    EXPECT_LT(time, Algebraic_number(certificate.bounds.lower));
    time = certificate.bounds.lower;
    certificate = certificate_after(time);
  }
  if (certificate.kind == Kind::never_fails) return std::nullopt;
  return certificate.failure ? *certificate.failure : failure_in(certificate.bounds);
}

std::optional<Algebraic_number> in_circle_failure_time(const Linear_kinetic_traits_2& traits,
                                                       const Moving_point_2& p,
                                                       const Moving_point_2& q,
                                                       const Moving_point_2& r,
                                                       const Moving_point_2& s, double t) {
  return failure_of(
      [&](const Algebraic_number& after) {
        return traits.in_circle_certificate(p, q, r, s, after, Certificate_state::any);
      },
      [&](const Double_interval& bounds) { return traits.in_circle_failure(p, q, r, s, bounds); },
      t);
}

// The two certificates of a batch are unknown, or those of each alone.
template <class Point>
int expect_certificates_of_two_as_of_each(
    const Basic_kinetic_traits_2<typename Point::Motion>& traits,
    const std::array<Quadruple<Point>, 2>& both, double t) {
  const auto certificates = traits.in_circle_certificates(both, t);
  int known = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    if (certificates[k].kind == Kind::unknown) continue;
    ++known;
    const auto& [p, q, r, s] = both[k];
    const auto alone = traits.in_circle_certificate(*p, *q, *r, *s, t, Certificate_state::any);
    EXPECT_EQ(certificates[k].kind, alone.kind);
    EXPECT_EQ(certificates[k].bounds, alone.bounds);
    EXPECT_EQ(certificates[k].may_be_zero, alone.may_be_zero);
    EXPECT_EQ(certificates[k].means, alone.means);
    EXPECT_EQ(certificates[k].is_root_solved, alone.is_root_solved);
    EXPECT_EQ(certificates[k].failure == nullptr, alone.failure == nullptr);
  }
  return known;
}

class Linear_kinetic_traits_2_test : public testing::TestWithParam<Arithmetic> {
 protected:
  std::optional<Algebraic_number> in_circle_failure_time(const Moving_point_2& p,
                                                         const Moving_point_2& q,
                                                         const Moving_point_2& r,
                                                         const Moving_point_2& s, double t) {
    return basic_kinetic_traits_2_test::in_circle_failure_time(traits, p, q, r, s, t);
  }
  std::optional<Algebraic_number> orientation_failure_time(const Moving_point_2& p,
                                                           const Moving_point_2& q,
                                                           const Moving_point_2& r, double t) {
    return failure_of(
        [&](const Algebraic_number& after) {
          return traits.orientation_certificate(p, q, r, after, Certificate_state::any);
        },
        [&](const Double_interval& bounds) { return traits.orientation_failure(p, q, r, bounds); },
        t);
  }
  std::optional<Algebraic_number> coincidence_time(const Moving_point_2& p, const Moving_point_2& q,
                                                   double t) {
    const Certificate certificate = traits.coincidence_certificate(p, q, t, for_ever);
    if (certificate.kind == Kind::never_fails) return std::nullopt;
    return *certificate.failure;
  }

  const Linear_kinetic_traits_2 traits{GetParam()};
  const Moving_point_2 west = resting(-1, 0);
  const Moving_point_2 south = resting(0, -1);
  const Moving_point_2 east = resting(1, 0);
};

TEST_P(Linear_kinetic_traits_2_test, in_circle_fails_when_the_point_enters_the_circle) {
  const Moving_point_2 entering = moving(0, 3, 0, -1);
  EXPECT_EQ(in_circle_failure_time(west, south, east, entering, 0.0), Algebraic_number(2.0));
  EXPECT_EQ(in_circle_failure_time(west, south, east, entering, 1.5), Algebraic_number(2.0));
}

TEST_P(Linear_kinetic_traits_2_test, in_circle_violated_just_after_fails_at_once) {
  const Moving_point_2 entering = moving(0, 3, 0, -1);
  EXPECT_EQ(in_circle_failure_time(west, south, east, entering, 2.0), Algebraic_number(2.0));
  EXPECT_EQ(in_circle_failure_time(west, south, east, entering, 3.0), Algebraic_number(3.0));
}

TEST_P(Linear_kinetic_traits_2_test, in_circle_of_a_leaving_point_fails_when_it_comes_back) {
  // It leaves through the bottom at t = 4 and is outside for ever.
  const Moving_point_2 entering = moving(0, 3, 0, -1);
  EXPECT_EQ(in_circle_failure_time(west, south, east, entering, 4.0), std::nullopt);
}

TEST_P(Linear_kinetic_traits_2_test, in_circle_that_is_only_touched_never_fails) {
  const Moving_point_2 tangential = moving(-5, 1, 1, 0);
  EXPECT_EQ(in_circle_failure_time(west, south, east, tangential, 0.0), std::nullopt);
}

// The determinant with x y is zero, too. That with x^2 is 4.
TEST_P(Linear_kinetic_traits_2_test, in_circle_that_is_zero_for_ever_fails_at_once_or_never) {
  const Moving_point_2 north = resting(0, 1);
  EXPECT_EQ(in_circle_failure_time(west, south, east, north, 0.0), Algebraic_number(0.0));
  EXPECT_EQ(in_circle_failure_time(south, east, north, west, 0.0), std::nullopt);
}

TEST_P(Linear_kinetic_traits_2_test, in_circle_failure_times_may_be_irrational) {
  // |(t - 3, t - 3)| = 1 first at t = 3 - sqrt(1/2).
  const Moving_point_2 entering = moving(-3, -3, 1, 1);
  const auto time = in_circle_failure_time(east, resting(0, 1), west, entering, 0.0);
  ASSERT_TRUE(time);
  const Algebraic_number root_of_a_half(Polynomial{17, -12, 2}, Rational(2), Rational(3));
  EXPECT_EQ(*time, root_of_a_half);
}

TEST_P(Linear_kinetic_traits_2_test, orientation_fails_when_the_turn_becomes_right) {
  EXPECT_EQ(orientation_failure_time(west, east, moving(0, 3, 0, -1), 0.0), Algebraic_number(3.0));
  EXPECT_EQ(orientation_failure_time(west, east, moving(0, 3, 0, 1), 0.0), std::nullopt);
  EXPECT_EQ(orientation_failure_time(west, east, moving(0, 0, 1, 0), 0.0), std::nullopt);
}

TEST_P(Linear_kinetic_traits_2_test, coincidence_is_found_only_strictly_later) {
  const Moving_point_2 a = moving(0, 0, 1, 2);
  const Moving_point_2 b = moving(3, 6, 0, 0);
  EXPECT_EQ(coincidence_time(a, b, 0.0), Algebraic_number(3.0));
  EXPECT_EQ(coincidence_time(b, a, 0.0), Algebraic_number(3.0));
  EXPECT_EQ(coincidence_time(a, b, 3.0), std::nullopt);
  EXPECT_EQ(coincidence_time(a, moving(3, 6.0000001, 0, 0), 0.0), std::nullopt);
  EXPECT_EQ(coincidence_time(a, moving(1, 0, 1, 2), 0.0), std::nullopt);
  EXPECT_EQ(coincidence_time(a, moving(-1, -2, 1, 2, -1), 0.0), std::nullopt) << "the same";
  // Only the y coordinates move against each other.
  EXPECT_EQ(coincidence_time(moving(1, 0, 1, 1), moving(1, 1, 1, 0), 0.0), Algebraic_number(1.0));
  EXPECT_EQ(coincidence_time(moving(1, 0, 1, 1), moving(2, 1, 1, 0), 0.0), std::nullopt);
}

TEST_P(Linear_kinetic_traits_2_test, coincidence_time_need_not_be_a_binary64_number) {
  const auto time = coincidence_time(moving(0, 0, 3, 3), resting(1, 1), 0.0);
  EXPECT_EQ(time, Algebraic_number(Rational(1, 3)));
}

INSTANTIATE_TEST_SUITE_P(Arithmetics, Linear_kinetic_traits_2_test,
                         testing::Values(Arithmetic::filtered, Arithmetic::exact_only),
                         [](const auto& instance) {
                           return instance.param == Arithmetic::filtered ? "filtered" : "exact";
                         });

// Which stage decides chosen cases.
class Deciding_stage : public testing::Test {
 protected:
  void expect_stage(std::uint64_t filtered, std::uint64_t exact, std::uint64_t solved) const {
    EXPECT_EQ(counters.created, filtered + exact);
    EXPECT_EQ(counters.filter_decided, filtered);
    EXPECT_EQ(counters.exact_decided, exact);
    EXPECT_EQ(counters.root_solves, solved);
  }

  Certificate counted(Certificate certificate) {
    counters.count(certificate);
    return certificate;
  }

  // The certificate from time 0 of the circle through the three points below.
  Certificate certificate(const Moving_point_2& s) {
    return counted(traits.in_circle_certificate(west, south, east, s, 0.0, Certificate_state::any));
  }

  const Linear_kinetic_traits_2 traits{};
  Certificate_counters counters;
  const Moving_point_2 west = resting(-1, 0);
  const Moving_point_2 south = resting(0, -1);
  const Moving_point_2 east = resting(1, 0);
};

TEST_F(Deciding_stage, of_a_certificate_that_holds_for_now_is_the_filter) {
  EXPECT_EQ(certificate(moving(0, 30, 0, -1)).kind, Kind::holds);
  expect_stage(1, 0, 0);
  EXPECT_EQ(counters.refined_decided, 0u);
}

TEST_F(Deciding_stage, of_a_simple_root_near_by_is_the_filter) {
  EXPECT_EQ(certificate(moving(0.1, 1.1, 0, -1)).kind, Kind::fails);
  expect_stage(1, 0, 1);
  EXPECT_EQ(counters.refined_decided, 1u);
}

TEST_F(Deciding_stage, of_a_certificate_that_never_fails_is_the_filter) {
  // The whole plane is dilated: the predicates are multiplied by a power of 1 + t.
  const auto dilated = [](double x, double y) { return moving(x, y, x, y); };
  EXPECT_EQ(counted(traits.in_circle_certificate(dilated(-1, 0), dilated(0, -1), dilated(1, 0),
                                                 dilated(0.5, 2), 0.0, Certificate_state::any))
                .kind,
            Kind::never_fails);
  EXPECT_EQ(counted(traits.orientation_certificate(dilated(-1, 0), dilated(1, 0), dilated(0, 1),
                                                   0.0, Certificate_state::any))
                .kind,
            Kind::never_fails);
  EXPECT_EQ(certificate(resting(0, 2)).kind, Kind::never_fails);
  EXPECT_EQ(counted(traits.coincidence_certificate(west, moving(0, 0, 0, 1), 0.0, for_ever)).kind,
            Kind::never_fails);
  expect_stage(4, 0, 0);
}

TEST_F(Deciding_stage, of_a_violation_already_is_the_filter) {
  const auto violated = certificate(moving(0, 0.5, 0, -1));
  ASSERT_TRUE(violated.failure);
  EXPECT_EQ(*violated.failure, Algebraic_number(0.0));
  expect_stage(1, 0, 0);
}

TEST_F(Deciding_stage, of_a_violation_that_begins_now_is_exact) {
  const auto violated = certificate(moving(0, 1, 0, -1));
  ASSERT_TRUE(violated.failure);
  EXPECT_EQ(*violated.failure, Algebraic_number(0.0));
  expect_stage(0, 1, 1);
}

TEST_F(Deciding_stage, of_points_cocircular_for_ever_is_exact_without_looking_for_roots) {
  EXPECT_EQ(counted(traits.in_circle_certificate(south, east, resting(0, 1), west, 0.0,
                                                 Certificate_state::any))
                .kind,
            Kind::never_fails);
  expect_stage(0, 1, 0);
}

TEST_F(Deciding_stage, of_a_touch_is_exact) {
  EXPECT_EQ(certificate(moving(-0.125, 1, 1, 0)).kind, Kind::never_fails);
  expect_stage(0, 1, 1);
}

TEST_F(Deciding_stage, of_the_root_after_a_known_one_is_the_filter) {
  // The point has entered at t = 1/8 and leaves at the bottom much later: its edge was flipped.
  const Moving_point_2 through = moving(0.1, 1.1, 0, -1);
  const auto entering = certificate(through);
  ASSERT_EQ(entering.kind, Kind::fails);
  const Algebraic_number entered =
      traits.in_circle_failure(west, south, east, through, entering.bounds);
  const auto leaving = counted(traits.in_circle_certificate(south, west, east, through, entered,
                                                            Certificate_state::vanishes));
  EXPECT_GT(leaving.bounds.lower, entering.bounds.upper);
  expect_stage(2, 0, leaving.kind == Kind::fails ? 2 : 1);
}

TEST_F(Deciding_stage, of_magnitudes_beyond_the_filter_is_exact) {
  const Moving_point_2 p = resting(-0x1p300, 0);
  const Moving_point_2 q = resting(0, -0x1p300);
  const Moving_point_2 r = resting(0x1p300, 0);
  const Moving_point_2 s = moving(0, 3 * 0x1p300, 0, -0x1p300);
  const auto distant =
      counted(traits.in_circle_certificate(p, q, r, s, 0.0, Certificate_state::any));
  ASSERT_EQ(distant.kind, Certificate::Kind::fails);
  EXPECT_EQ(traits.in_circle_failure(p, q, r, s, distant.bounds), Algebraic_number(2.0));
  expect_stage(0, 1, 1);
}

// Failure times from the filter's brackets are rounded without their polynomials; as the roots of
// these are.
class Rounded_failure_times : public testing::TestWithParam<int> {};

TEST_P(Rounded_failure_times, are_those_of_the_exact_roots) {
  const Linear_kinetic_traits_2 traits;
  test::Certificates source(99);
  int compared = 0;
  for (int i = 0; i < test::cases(1500); ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe({m.begin(), m.end()}); });
    const Algebraic_number t(source.time(GetParam()));
    const Moving_point_2 p(m[0]);
    const Moving_point_2 q(m[1]);
    const Moving_point_2 r(m[2]);
    const Moving_point_2 s(m[3]);
    const auto expect_same = [&](const Certificate& certificate, const Algebraic_number& rounded,
                                 const Polynomial& polynomial) {
      if (certificate.failure) return;
      const auto root = first_root_after(polynomial, t);
      ASSERT_TRUE(root);
      ++compared;
      EXPECT_EQ(rounded.to_double(), root->value.to_double());  // first: it may narrow the number
      EXPECT_EQ(rounded.tight_interval(), root->value.tight_interval());
      EXPECT_EQ(rounded, root->value);
    };
    const auto circle = traits.in_circle_certificate(p, q, r, s, t, Certificate_state::any);
    if (circle.kind == Kind::fails) {
      expect_same(circle, traits.in_circle_failure(p, q, r, s, circle.bounds),
                  in_circle_polynomial(p, q, r, s));
    }
    const auto turn = traits.orientation_certificate(p, q, r, t, Certificate_state::any);
    if (turn.kind == Kind::fails) {
      expect_same(turn, traits.orientation_failure(p, q, r, turn.bounds),
                  orientation_polynomial(p, q, r));
    }
    const double diameter = 0.5 + 0.25 * (i % 8);
    const auto contact = traits.contact_certificate(p, q, diameter, t);
    if (contact.kind == Kind::fails) {
      expect_same(contact, traits.contact_failure(p, q, diameter, contact.bounds),
                  contact_polynomial(p, q, diameter));
    }
    if (HasFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(compared, test::cases(80));
  }
}

INSTANTIATE_TEST_SUITE_P(Flavors, Rounded_failure_times,
                         testing::Range(0, test::Certificates::flavors), test::flavor_name);

TEST(Linear_kinetic_traits_2, random_failure_times_are_where_the_static_predicate_turns) {
  constexpr unsigned seed = 11;
  int failures = 0;
  for (unsigned i = 0; i < test::cases(300u); ++i) {
    const auto m = test::random_motions(4, 10, 5, seed + i);
    const test::On_failure trace([&] { return test::describe(m); });
    const Moving_point_2 p(m[0]);
    const Moving_point_2 q(m[1]);
    const Moving_point_2 r(m[2]);
    const Moving_point_2 s(m[3]);
    const auto side = [&](const Rational& t) {
      return CGAL::side_of_oriented_circle(test::place_at(m[0], t), test::place_at(m[1], t),
                                           test::place_at(m[2], t), test::place_at(m[3], t));
    };
    const auto time = in_circle_failure_time(Linear_kinetic_traits_2(), p, q, r, s, 0.0);
    const Rational just_before_everything(1, 1000000000);
    if (!time) {
      for (int t = 0; t < 20; ++t) ASSERT_NE(side(Rational(t)), CGAL::ON_POSITIVE_SIDE);
      continue;
    }
    ++failures;
    const Rational width = just_before_everything / 1000;
    time->refine_to(width);
    ASSERT_EQ(side(time->upper() + width), CGAL::ON_POSITIVE_SIDE);
    if (*time == Algebraic_number(0.0)) continue;
    for (int k = 1; k < 20; ++k) {
      ASSERT_NE(side(time->lower() * k / 20), CGAL::ON_POSITIVE_SIDE) << k;
    }
  }
  EXPECT_GT(failures, 100);
}

// To the last bit: which two are certified together makes no difference.
TEST_P(Linear_kinetic_traits_2_test, two_certificates_at_once_are_those_of_each) {
  test::Certificates source(97);
  int known = 0;
  for (int i = 0; i < test::cases(700); ++i) {
    const int flavor = i % test::Certificates::flavors;
    std::vector<Moving_point_2> points;
    for (const auto& motions : {source.next(flavor), source.next(flavor)}) {
      for (const Linear_motion_2& motion : motions) points.emplace_back(motion);
    }
    known += expect_certificates_of_two_as_of_each<Moving_point_2>(
        Linear_kinetic_traits_2(GetParam()),
        {{{&points[0], &points[1], &points[2], &points[3]},
          {&points[4], &points[5], &points[6], &points[7]}}},
        source.time(flavor));
    if (HasFailure()) return;
  }
  if (GetParam() == Arithmetic::filtered) {
    EXPECT_GT(known, 400);
  } else {
    EXPECT_EQ(known, 0);
  }
}

// The diagonal from south to north has just come, as the four points were cocircular.
TEST_P(Linear_kinetic_traits_2_test, after_a_flip_says_what_floating_point_knows) {
  const Moving_point_2 north = moving(0, 1, 0, -1);
  const std::array beyond = {resting(4, -4), resting(4, 4), resting(-4, 4), resting(-4, -4)};
  const Flip_neighborhood<Moving_point_2> around = {
      {&south, &east, &north, &west}, {&beyond[0], &beyond[1], &beyond[2], &beyond[3]}};
  for (const Certificate& certificate : traits.certificates_after_flip(around, {0, 0})) {
    if (GetParam() == Arithmetic::exact_only) {
      EXPECT_EQ(certificate.kind, Kind::unknown);
      EXPECT_EQ(certificate.means, Certificate::Means::none);
    } else {
      EXPECT_NE(certificate.kind, Kind::unknown);
      EXPECT_NE(certificate.means, Certificate::Means::none);
    }
  }
}

// Of accelerated points, some of which have a jerk or move straight on.
TEST_P(Linear_kinetic_traits_2_test, two_certificates_of_polynomial_motions_are_those_of_each) {
  using Point = Polynomial_kinetic_traits_2::Point_2;
  test::Certificates source(98);
  int known = 0;
  for (int i = 0; i < test::cases(700); ++i) {
    const int flavor = i % test::Certificates::flavors;
    std::vector<Point> points;
    for (const int kind : {i % 4, i / 4 % 4}) {
      for (const Linear_motion_2& m : source.next(flavor)) {
        Polynomial_motion_2 motion = polynomial_motion(m);
        if (kind > 0) motion.acceleration = {-m.velocity.x, m.velocity.y};
        if (kind > 1) motion.jerk = {m.velocity.y, 0};
        points.emplace_back(motion);
      }
    }
    known += expect_certificates_of_two_as_of_each<Point>(
        Polynomial_kinetic_traits_2(GetParam()),
        {{{&points[0], &points[1], &points[2], &points[3]},
          {&points[4], &points[5], &points[6], &points[7]}}},
        source.time(flavor));
    if (HasFailure()) return;
  }
  if (GetParam() == Arithmetic::filtered) {
    EXPECT_GT(known, 200);
  } else {
    EXPECT_EQ(known, 0);
  }
}

// Traits that override a certificate do not inherit batches that know nothing of it.
struct Derived_traits : Linear_kinetic_traits_2 {
  static Derived_traits exact() { return {}; }
};
static_assert(KineticTraits_2<Derived_traits>);
static_assert(!BatchKineticTraits_2<Derived_traits>);

}  // namespace
}  // namespace kinetri::basic_kinetic_traits_2_test
