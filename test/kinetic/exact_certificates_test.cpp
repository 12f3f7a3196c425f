// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificates and signs of linear motion by Sturm counts in numbers on the stack: against what
// general algebraic numbers say of the same polynomials on the heap.
#include "kinetic/exact_certificates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "kinetic/certificate_formulas.h"
#include "kinetic/polynomial_on_stack.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/disc_certificates.h"
#include "support/multiplier.h"

namespace kinetri::exact_certificates_test {
namespace {

using Kind = Certificate::Kind;
using Time = Algebraic_number;
using test::Disc_certificates;

constexpr auto gap_formula = [](const auto&... all) { return contact_of(all...); };

// ---- the polynomials ----

// Up to a positive factor.
void expect_same(const std::optional<Narrow_polynomial>& on_stack, const Polynomial& on_heap) {
  if (on_stack) {
    EXPECT_EQ(primitive_part(to_polynomial(*on_stack)), primitive_part(on_heap));
  }
}

std::vector<Wall_2> walls(bool rim) {
  using Side = Wall_2::Side;
  return {{Side::left, -10.25, 0.5, rim},
          {Side::right, 10.25, 0.125, rim},
          {Side::bottom, -11, 0, rim},
          {Side::top, 1e-3, 3, rim}};
}

class Polynomials_on_stack : public testing::TestWithParam<int> {};

TEST_P(Polynomials_on_stack, are_those_on_the_heap) {
  int made = 0;
  int asked = 0;
  Disc_certificates<Disc_motion_2> source(GetParam(), 31);
  for (int i = 0; i < test::cases(40 * test::Kind_of_radii::kinds); ++i) {
    const auto m = source.next(i % test::Kind_of_radii::kinds, source.time());
    const std::array<Moving_disc_2, 4> d = {Moving_disc_2(m[0]), Moving_disc_2(m[1]),
                                            Moving_disc_2(m[2]), Moving_disc_2(m[3])};
    const double diameter = std::ldexp(i % 5, i % 7 - 5);
    const auto contact = polynomial_on_stack(gap_formula, center(m[0]), center(m[1]),
                                             touching_distance(m[0], m[1], diameter));
    expect_same(contact, contact_polynomial(d[0], d[1], diameter));
    made += contact.has_value();
    ++asked;
    for (const bool rim : {false, true}) {
      for (const Wall_2& wall : walls(rim)) {
        const auto inside = [&](const auto&... all) { return wall_of(wall, all...); };
        expect_same(polynomial_on_stack(inside, center(m[0]), bound_of(wall, m[0])),
                    wall_polynomial(d[0], wall));
      }
    }
    const auto comparison = [](const auto&... all) { return distance_comparison_of(all...); };
    expect_same(
        polynomial_on_stack(comparison, center(m[0]), center(m[1]), center(m[2]), center(m[3])),
        distance_comparison_polynomial(d[0], d[1], d[2], d[3]));
    if (HasFailure()) return;
  }
  // Those of flavor 3 and 8 are too wide, mostly, and so are the wild radii.
  if (GetParam() < 3) {
    EXPECT_GT(made, asked * 3 / 4);
  }
}

INSTANTIATE_TEST_SUITE_P(Flavors, Polynomials_on_stack,
                         testing::Range(0, test::Certificates::flavors), test::flavor_name);

TEST(Polynomials_on_stack, are_not_made_of_numbers_that_are_too_wide) {
  const Linear_motion_2 origin;
  const Linear_motion_2 far = {{0x1p130, 0}, {0, 0x1p-130}, 0};
  EXPECT_FALSE(
      polynomial_on_stack(gap_formula, origin, far, touching_distance(origin, far, 1)).has_value());
  // The length has the widest number.
  const Linear_motion_2 near = {{1, 0}, {0, 1}, 0};
  EXPECT_FALSE(polynomial_on_stack(gap_formula, origin, near,
                                   touching_distance(origin, near, std::ldexp(1, -260))));
  // As wide as is possible, with the greatest length: its polynomial is right.
  const Disc_motion_2 p = {{{-0x1.fffffffffffffp124, 0x1p-72}, {0x1p-72, 0}, 0}, 0x1p124, 0x1p124};
  const Disc_motion_2 q = {{{0x1.fffffffffffffp123, 0}, {0, -0x1p123}, 0}, 0x1p124, -0x1p-72};
  const auto widest =
      polynomial_on_stack(gap_formula, center(p), center(q), touching_distance(p, q, 0x1p124));
  ASSERT_TRUE(widest);
  expect_same(widest, contact_polynomial(Moving_disc_2(p), Moving_disc_2(q), 0x1p124));
  EXPECT_FALSE(
      polynomial_on_stack(gap_formula, Polynomial_motion_2(), Polynomial_motion_2(), Length()));
}

// ---- the certificates ----

// How many certificates the counts have decided, by kind.
struct Decided {
  int all = 0;
  int never_fails = 0;
  int at_once = 0;
  int fails = 0;
};

// The certificate by counts, if there is one, says what the other one says. `p` is the polynomial.
void expect_same(const std::optional<Certificate>& counted, const Certificate& expected,
                 const Polynomial& p, const Time& t, Decided& decided) {
  ++decided.all;
  if (!counted) return;
  ASSERT_EQ(counted->kind, expected.kind) << p << " from " << t;
  EXPECT_EQ(counted->means, Certificate::Means::exact);
  if (!counted->may_be_zero) {
    EXPECT_EQ(sign_just_after(p, t), CGAL::POSITIVE) << p << " from " << t;
  }
  if (counted->kind == Kind::never_fails) {
    ++decided.never_fails;
    return;
  }
  ASSERT_NE(expected.failure, nullptr);
  const Time& time = *expected.failure;
  if (counted->failure) {
    ++decided.at_once;
    EXPECT_EQ(*counted->failure, time) << p << " from " << t;
    return;
  }
  ++decided.fails;
  // A number of these bounds checks that the signs differ; that its polynomial has one root there
  // is checked here.
  const auto [lower, upper] = counted->bounds;
  ASSERT_LT(lower, upper);
  EXPECT_TRUE(Time(lower) < time && time < Time(upper)) << p << " from " << t;
  EXPECT_EQ(Time(odd_part(p), to_rational(lower), to_rational(upper)), time) << p;
}

// From times at which something happens to the polynomial, and others.
std::vector<Time> times_of(const Polynomial& p, double t) {
  std::vector<Time> result = {t};
  for (const Polynomial& q : {p, derivative(p)}) {
    if (q.degree() < 1) continue;
    for (const Real_root& root : real_roots(q)) {
      result.push_back(root.value);
      if (std::isfinite(root.value.to_double())) result.emplace_back(root.value.to_double());
    }
  }
  return result;
}

class Counted_certificates : public testing::TestWithParam<int> {
 protected:
  void expect_contacts(const std::optional<Narrow_polynomial>& on_stack, const Polynomial& p,
                       double time) {
    if (!on_stack) return;
    for (const Time& t : times_of(p, time)) {
      expect_same(counted_contact_certificate(*on_stack, t), exact_contact_certificate(p, t), p, t,
                  contacts);
      expect_same(counted_apart_certificate(*on_stack, t), exact_apart_certificate(p, t), p, t,
                  apart);
      expect_same(counted_certificate(*on_stack, t, Certificate_state::any),
                  exact_certificate(p, t), p, t, failures);
      const auto timed = counted_certificate_with_time(*on_stack, t);
      if (timed && timed->kind == Kind::fails) {
        ASSERT_NE(timed->failure, nullptr);
        EXPECT_EQ(*timed->failure, *failure_time(p, t));
      }
      if (HasFailure()) return;
    }
  }

  Decided contacts;
  Decided apart;
  Decided failures;
};

TEST_P(Counted_certificates, are_those_of_general_algebraic_numbers) {
  Disc_certificates<Disc_motion_2> source(GetParam(), 32);
  for (int i = 0; i < test::cases(30 * test::Kind_of_radii::kinds); ++i) {
    const double t = source.time();
    const auto m = source.next(i % test::Kind_of_radii::kinds, t);
    const std::array<Moving_disc_2, 4> d = {Moving_disc_2(m[0]), Moving_disc_2(m[1]),
                                            Moving_disc_2(m[2]), Moving_disc_2(m[3])};
    expect_contacts(polynomial_on_stack(gap_formula, center(m[0]), center(m[1]),
                                        touching_distance(m[0], m[1], 0)),
                    contact_polynomial(d[0], d[1], 0), t);
    for (const Wall_2& wall : walls(i % 2 == 0)) {
      const auto inside = [&](const auto&... all) { return wall_of(wall, all...); };
      expect_contacts(polynomial_on_stack(inside, center(m[0]), bound_of(wall, m[0])),
                      wall_polynomial(d[0], wall), t);
    }
    if (HasFailure()) return;
  }
  if (GetParam() == 0) {
    for (const Decided& decided : {contacts, apart, failures}) {
      EXPECT_GT(decided.never_fails, decided.all / 20);
      EXPECT_GT(decided.at_once, decided.all / 20);
      EXPECT_GT(decided.fails, decided.all / 20);
    }
    EXPECT_GT(contacts.never_fails + contacts.at_once + contacts.fails, contacts.all / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Flavors, Counted_certificates,
                         testing::Range(0, test::Certificates::flavors), test::flavor_name);

std::optional<Time> failure_of(const std::optional<Certificate>& certificate) {
  return certificate && certificate->failure ? std::optional(*certificate->failure) : std::nullopt;
}

TEST(Counted_certificates, of_contacts_wait_for_an_approach) {
  const auto contact = [](std::initializer_list<long> c, double t) {
    Narrow_polynomial p;
    for (int i = 0; const long x : c) {
      Narrow_polynomial term{Stack_integer<16>(x)};
      for (int k = 0; k < i; ++k) term = term * Narrow_polynomial{0, 1};
      p = p + term;
      ++i;
    }
    return counted_contact_certificate(p, t);
  };
  // They part: never, though they overlap, touch, or have just touched.
  EXPECT_EQ(contact({-1, 1}, 0)->kind, Kind::never_fails);
  EXPECT_TRUE(contact({-1, 1}, 0)->may_be_zero);
  EXPECT_EQ(contact({0, 1}, 0)->kind, Kind::never_fails);
  EXPECT_EQ(contact({0, 0, 1}, 0)->kind, Kind::never_fails) << "a touch";
  EXPECT_EQ(contact({-1, 0, 1}, 0)->kind, Kind::never_fails);
  EXPECT_EQ(contact({-1, 0, 1}, 1)->kind, Kind::never_fails);
  // They approach while they touch or overlap.
  EXPECT_EQ(failure_of(contact({-1, -1}, 3)), Time(3.0));
  EXPECT_EQ(failure_of(contact({0, -1}, 0)), Time(0.0));
  EXPECT_EQ(failure_of(contact({-1, 0, 1}, -0.5)), Time(-0.5));
  EXPECT_TRUE(contact({-1, 0, 1}, -0.5)->may_be_zero);
  EXPECT_EQ(failure_of(contact({-1, 0, -1}, 0)), Time(0.0)) << "just after 0";
  // They are apart, and approach.
  const auto later = contact({3, -1}, 0);
  EXPECT_EQ(later->kind, Kind::fails);
  EXPECT_FALSE(later->may_be_zero);
  EXPECT_TRUE(later->bounds.lower < 3 && later->bounds.upper > 3);
  // They do not move against each other.
  EXPECT_EQ(contact({-1}, 0)->kind, Kind::never_fails);
  EXPECT_TRUE(contact({-1}, 0)->may_be_zero);
  EXPECT_FALSE(contact({1}, 0)->may_be_zero);
  EXPECT_EQ(contact({0}, 0)->kind, Kind::never_fails);
  EXPECT_TRUE(contact({0}, 0)->may_be_zero);
  // They overlap, and part before they approach: that is left to others.
  EXPECT_FALSE(contact({-1, 4, -1}, 0));
}

TEST(Counted_certificates, of_distances_fail_at_a_touch_now) {
  const Narrow_polynomial rising{0, 1};
  EXPECT_EQ(failure_of(counted_apart_certificate(rising, 0.0)), Time(0.0));
  EXPECT_EQ(counted_apart_certificate(rising, 1.0)->kind, Kind::never_fails);
  EXPECT_EQ(failure_of(counted_apart_certificate(rising, -1.0)), Time(-1.0));
  EXPECT_EQ(failure_of(counted_apart_certificate(Narrow_polynomial(), 2.0)), Time(2.0));
  const Narrow_polynomial touch{1, -2, 1};
  EXPECT_FALSE(counted_apart_certificate(touch, 0.0)) << "a touch is not an odd root";
}

// ---- the traits ----

// In exact arithmetic alone; whether the counts decide makes no difference.
class Exact_traits : public testing::TestWithParam<int> {};

TEST_P(Exact_traits, decide_as_the_polynomials_on_the_heap) {
  const Disc_kinetic_traits_2 traits = Disc_kinetic_traits_2::exact();
  constexpr Double_interval for_ever = {-std::numeric_limits<double>::infinity(),
                                        std::numeric_limits<double>::infinity()};
  Disc_certificates<Disc_motion_2> source(GetParam(), 33);
  const auto expect_time = [](const Certificate& certificate, const std::optional<Time>& expected,
                              const auto& failure) {
    ASSERT_EQ(certificate.kind == Kind::fails, expected.has_value());
    if (!expected) return;
    EXPECT_EQ(certificate.failure ? *certificate.failure : failure(certificate.bounds), *expected);
  };
  const auto timed = [](const Double_interval&) -> Time {
    ADD_FAILURE() << "without Certificate::failure";
    return {};
  };
  for (int i = 0; i < test::cases(6 * test::Kind_of_radii::kinds); ++i) {
    const double start = source.time();
    const auto m = source.next(i % test::Kind_of_radii::kinds, start);
    const Moving_disc_2 p(m[0]);
    const Moving_disc_2 q(m[1]);
    const Moving_disc_2 r(m[2]);
    const Moving_disc_2 s(m[3]);
    const Polynomial gap = contact_polynomial(p, q, 0);
    const Polynomial slope = derivative(gap);
    for (const Time& t : times_of(gap, start)) {
      EXPECT_EQ(traits.do_touch(p, q, 0, t), sign_at(gap, t) != CGAL::POSITIVE);
      EXPECT_EQ(traits.may_overlap(p, q, 0, t), sign_just_after(gap, t) == CGAL::NEGATIVE);
      EXPECT_EQ(traits.do_approach(p, q, t), sign_just_after(slope, t) == CGAL::NEGATIVE);
      EXPECT_EQ(traits.has_approach_speed(p, q, t), sign_at(slope, t) == CGAL::NEGATIVE);
      expect_time(
          traits.contact_certificate(p, q, 0, t),
          [&] {
            const Certificate expected = exact_contact_certificate(gap, t);
            return expected.failure ? std::optional(*expected.failure) : std::nullopt;
          }(),
          [&](const auto& in) { return traits.contact_failure(p, q, 0, in); });
      expect_time(traits.near_certificate(p, q, 0, t), failure_time(-gap, t),
                  [&](const auto& in) { return traits.contact_failure(p, q, 0, in); });
      expect_time(traits.weight_certificate(p, q, t), failure_time(weight_difference(p, q), t),
                  timed);
      expect_time(traits.segment_certificate(p, q, r, t),
                  failure_time(segment_polynomial(p, q, r), t), timed);
      expect_time(traits.hiding_certificate(p, q, r, t),
                  failure_time(-segment_polynomial(p, q, r), t), timed);
      expect_time(traits.meeting_certificate(p, q, t, for_ever),
                  coincidence_time(x_difference(p, q), y_difference(p, q), {}, t), timed);
      expect_time(
          traits.coincidence_certificate(p, q, t, for_ever),
          coincidence_time(x_difference(p, q), y_difference(p, q), weight_difference(p, q), t),
          timed);
      if (HasFailure()) return;
    }
    const Polynomial comparison = distance_comparison_polynomial(p, q, r, s);
    for (const Time& t : times_of(comparison, start)) {
      expect_time(traits.closer_certificate(p, q, r, s, t), failure_time(comparison, t),
                  [&](const auto& in) { return traits.closer_failure(p, q, r, s, in); });
    }
    const Polynomial turn = orientation_polynomial(p, q, r);
    for (const Time& t : times_of(turn, start)) {
      const Certificate expected = exact_touch_certificate(turn, t);
      expect_time(traits.flatness_certificate(p, q, r, t, Certificate_state::any),
                  expected.failure ? std::optional(*expected.failure) : std::nullopt,
                  [&](const auto& in) { return traits.orientation_failure(p, q, r, in); });
    }
    for (const Wall_2& wall : walls(i % 2 == 0)) {
      const Polynomial inside = wall_polynomial(p, wall);
      for (const Time& t : times_of(inside, start)) {
        EXPECT_EQ(traits.is_inside(p, wall, t), sign_at(inside, t) != CGAL::NEGATIVE);
      }
    }
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Flavors, Exact_traits, testing::Range(0, test::Certificates::flavors),
                         test::flavor_name);

}  // namespace
}  // namespace kinetri::exact_certificates_test
