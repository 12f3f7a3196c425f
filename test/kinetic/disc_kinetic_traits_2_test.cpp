// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificates of discs: by hand, and against CGAL's static predicates at many times.
#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "support/discs.h"
#include "support/on_failure.h"

namespace kinetri::disc_kinetic_traits_2_test {
namespace {

using test::disc_at;
using test::Disc_source;
using test::radius_at;
using test::weight_at;
using Kind = Certificate::Kind;

constexpr Double_interval for_ever = {-std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::infinity()};

Moving_disc_2 disc(double x, double y, double vx, double vy, double radius, double growth = 0,
                   double weight = 0) {
  return Moving_disc_2({{{x, y}, {vx, vy}, 0}, radius, growth, weight});
}

// The failure time at the end of the certificates, each of which must hold as far as it says.
template <class Certificate_after, class Failure_in>
std::optional<Algebraic_number> failure_of(const Certificate_after& certificate_after,
                                           const Failure_in& failure_in, Algebraic_number time) {
  Certificate certificate = certificate_after(time);
  while (certificate.kind == Kind::holds) {
    EXPECT_LT(time, Algebraic_number(certificate.bounds.lower));
    time = certificate.bounds.lower;
    certificate = certificate_after(time);
  }
  if (certificate.kind == Kind::never_fails) return std::nullopt;
  return certificate.failure ? *certificate.failure : failure_in(certificate.bounds);
}

class Disc_kinetic_traits : public testing::TestWithParam<Arithmetic> {
 protected:
  std::optional<Algebraic_number> contact(const Moving_disc_2& p, const Moving_disc_2& q,
                                          double t = 0) {
    return failure_of(
        [&](const Algebraic_number& after) { return traits.contact_certificate(p, q, 0, after); },
        [&](const Double_interval& bounds) { return traits.contact_failure(p, q, 0, bounds); }, t);
  }
  std::optional<Algebraic_number> wall_contact(const Moving_disc_2& p, const Wall_2& wall,
                                               double t = 0) {
    return failure_of(
        [&](const Algebraic_number& after) { return traits.wall_certificate(p, wall, after); },
        [&](const Double_interval& bounds) { return traits.wall_failure(p, wall, bounds); }, t);
  }
  std::optional<Algebraic_number> coincidence(const Moving_disc_2& p, const Moving_disc_2& q,
                                              double t = 0) {
    return failure_of(
        [&](const Algebraic_number& after) {
          return traits.coincidence_certificate(p, q, after, for_ever);
        },
        [&](const Double_interval&) { return Algebraic_number(); }, t);
  }

  const Disc_kinetic_traits_2 traits{GetParam()};
};

TEST_P(Disc_kinetic_traits, of_a_power_circle_fail_when_the_lifted_point_passes_the_plane) {
  // The middle of a circle of radius 5, of the weight (2 - t)^2 - 26 in place of -25.
  const Moving_disc_2 p = disc(5, 0, 0, 0, 0);
  const Moving_disc_2 q = disc(-3, 4, 0, 0, 0);
  const Moving_disc_2 r = disc(-3, -4, 0, 0, 0);
  const Moving_disc_2 s = disc(0, 0, 0, 0, 2, -1, -26);
  const auto failure = [&](double t) {
    return failure_of(
        [&](const Algebraic_number& after) {
          return traits.in_circle_certificate(p, q, r, s, after, Certificate_state::any);
        },
        [&](const Double_interval& bounds) { return traits.in_circle_failure(p, q, r, s, bounds); },
        t);
  };
  EXPECT_EQ(failure(0), Algebraic_number(0.0));
  EXPECT_EQ(failure(1), Algebraic_number(3.0));
  EXPECT_EQ(failure(1.5), Algebraic_number(3.0));
}

TEST_P(Disc_kinetic_traits, of_contacts_fail_when_the_rims_touch) {
  const Moving_disc_2 small = disc(0, 0, 0, 0, 1);
  EXPECT_EQ(contact(small, disc(10, 0, -1, 0, 3)), Algebraic_number(6.0));
  EXPECT_EQ(contact(small, disc(10, 0, 0, 0, 3)), std::nullopt);
  // Both at rest, and one grows.
  EXPECT_EQ(contact(small, disc(10, 0, 0, 0, 3, 0.5)), Algebraic_number(12.0));
  // The centers part more slowly than the radius grows.
  EXPECT_EQ(contact(small, disc(10, 0, 1, 0, 3, 2)), Algebraic_number(6.0));
  // The centers approach as fast as the radius shrinks.
  EXPECT_EQ(contact(small, disc(10, 0, -1, 0, 9, -1)), std::nullopt);
  // A disc that passes through another one: the first contact is when it comes.
  EXPECT_EQ(contact(disc(-10, 0, 1, 0, 0), disc(0, 0, 0, 0, 5)), Algebraic_number(5.0));
  // Inside of the other one, and on the way out: no contact.
  EXPECT_EQ(contact(disc(0, 0, 1, 0, 0), disc(0, 0, 0, 0, 5)), std::nullopt);
}

TEST_P(Disc_kinetic_traits, on_straight_lines_never_touch_again_after_they_have_parted) {
  // The distance of the rims is convex.
  const Moving_disc_2 p = disc(0, 0, 0, 0, 4, -0.25);
  const Moving_disc_2 q = disc(3, 1, 1, -1, 0.25);
  EXPECT_EQ(traits.next_contact_certificate(p, q, 0, 0.0).kind, Kind::never_fails);
}

TEST_P(Disc_kinetic_traits, of_walls_for_rims_keep_the_radius) {
  const Wall_2 right = {Wall_2::Side::right, 10, 0.5, true};
  const Wall_2 left = {Wall_2::Side::left, -10, 0, true};
  const Moving_disc_2 p = disc(0, 0, 1, 0, 1);
  EXPECT_EQ(wall_contact(p, right), Algebraic_number(8.5));
  EXPECT_EQ(wall_contact(p, left), std::nullopt);
  EXPECT_EQ(wall_contact(disc(0, 0, 1, 0, 1, 1), right), Algebraic_number(4.25));
  // It moves away from the wall, but its rim comes.
  const Moving_disc_2 growing = disc(0, 0, 1, 0, 1, 2);
  EXPECT_EQ(wall_contact(growing, left), Algebraic_number(9.0));
  EXPECT_TRUE(traits.has_approach_speed(growing, left, 1.0));
  EXPECT_FALSE(traits.has_approach_speed(disc(0, 0, 2, 0, 1, 2), left, 1.0));
  EXPECT_FALSE(traits.has_approach_speed(p, left, 1.0));
  EXPECT_TRUE(traits.has_approach_speed(disc(0, 0, -1, 0, 1, 2), right, 1.0));
  EXPECT_FALSE(traits.has_approach_speed(disc(0, 0, -2, 0, 1, 2), right, 1.0));
  EXPECT_TRUE(traits.is_inside(growing, left, 9.0));
  EXPECT_FALSE(traits.is_inside(growing, left, 9.0625));
  // About centers it is as for points.
  const Wall_2 about_centers = {Wall_2::Side::right, 10, 0.5};
  EXPECT_EQ(wall_contact(disc(0, 0, 1, 0, 1, 1), about_centers), Algebraic_number(9.5));
  EXPECT_FALSE(traits.has_approach_speed(disc(0, 0, 0, 0, 1, 1), about_centers, 1.0));
}

TEST_P(Disc_kinetic_traits, of_discs_approach_if_their_rims_do) {
  const Moving_disc_2 p = disc(0, 0, 0, 0, 1);
  const Moving_disc_2 q = disc(4, 0, 1, 0, 1, 2);  // the rims touch at t = 2
  EXPECT_TRUE(traits.do_approach(p, q, 2.0));
  EXPECT_TRUE(traits.has_approach_speed(p, q, 2.0));
  EXPECT_TRUE(traits.do_touch(p, q, 0, 2.0));
  EXPECT_FALSE(traits.do_touch(p, q, 0, 1.75));
  EXPECT_TRUE(traits.may_overlap(p, q, 0, 2.0));
  EXPECT_FALSE(traits.may_overlap(p, q, 0, 1.75));
  // The speed of the rims is zero.
  const Moving_disc_2 even = disc(2, 0, 2, 0, 1, 2);
  EXPECT_FALSE(traits.do_approach(p, even, 0.0));
  EXPECT_FALSE(traits.has_approach_speed(p, even, 0.0));
}

TEST_P(Disc_kinetic_traits, of_coincidences_are_about_place_and_weight) {
  const Moving_disc_2 p = disc(0, 0, 1, 1, 1);
  EXPECT_EQ(coincidence(p, disc(3, 3, 0, 0, 1)), Algebraic_number(3.0));
  EXPECT_EQ(coincidence(p, disc(3, 3, 0, 0, 2)), std::nullopt);
  EXPECT_EQ(coincidence(p, disc(3, 3, 0, 0, 4, -1)), Algebraic_number(3.0));
  EXPECT_EQ(coincidence(p, disc(3, 3, 0, 0, 0, 0, 1)), Algebraic_number(3.0));
  EXPECT_EQ(coincidence(p, disc(3, 3, 0, 0, 1), 3), std::nullopt);
  // In one place at all times.
  EXPECT_EQ(coincidence(p, disc(0, 0, 1, 1, 3, -1)), Algebraic_number(2.0));
  EXPECT_EQ(coincidence(p, disc(0, 0, 1, 1, 3, -1), 2), Algebraic_number(4.0));  // a radius of -1
  EXPECT_EQ(coincidence(p, disc(0, 0, 1, 1, 1)), std::nullopt);
  EXPECT_EQ(coincidence(p, disc(0, 0, 1, 1, 2)), std::nullopt);
  EXPECT_EQ(coincidence(p, disc(1, 0, 1, 1, 3, -1)), std::nullopt);
  const Moving_disc_2 later(Disc_motion_2{{{7, 7}, {1, 1}, 7}, -4, -1});
  EXPECT_EQ(coincidence(p, later), Algebraic_number(2.0));
}

TEST_P(Disc_kinetic_traits, of_weights_fail_when_the_order_changes) {
  const Moving_disc_2 p = disc(0, 0, 0, 0, 2);
  const Certificate certificate = traits.weight_certificate(p, disc(5, 5, 1, 0, 1, 0.5), 0.0);
  ASSERT_EQ(certificate.kind, Kind::fails);
  EXPECT_EQ(*certificate.failure, Algebraic_number(2.0));
  EXPECT_EQ(traits.weight_certificate(p, disc(0, 0, 0, 0, 2), 0.0).kind, Kind::never_fails);
  EXPECT_EQ(traits.weight_certificate(p, disc(0, 0, 0, 0, 1, 0, 3), 0.0).kind, Kind::never_fails);
  EXPECT_EQ(*traits.weight_certificate(p, disc(0, 0, 0, 0, 1, 0, 3.5), 7.0).failure,
            Algebraic_number(7.0));
}

TEST_P(Disc_kinetic_traits, of_segments_fail_when_the_middle_is_hidden) {
  const Moving_disc_2 p = disc(-1, 0, 0, 0, 0);
  const Moving_disc_2 r = disc(1, 0, 0, 0, 0);
  // Hidden if its weight is less than -1.
  const Moving_disc_2 q = disc(0, 0, 0, 0, 2, -1, -2);
  EXPECT_EQ(*traits.segment_certificate(p, q, r, 0.0).failure, Algebraic_number(1.0));
  EXPECT_EQ(*traits.segment_certificate(r, q, p, 0.0).failure, Algebraic_number(1.0));
  EXPECT_EQ(*traits.segment_certificate(p, q, r, 2.0).failure, Algebraic_number(2.0));
  EXPECT_EQ(traits.segment_certificate(p, q, r, 3.0).kind, Kind::never_fails);
}

INSTANTIATE_TEST_SUITE_P(Arithmetics, Disc_kinetic_traits,
                         testing::Values(Arithmetic::filtered, Arithmetic::exact_only),
                         [](const auto& instance) {
                           return instance.param == Arithmetic::filtered ? "filtered" : "exact";
                         });

// Whether the sign that a predicate has at rational times is as a certificate says: not negative
// from t up to the failure, and negative just after it.
template <class Sign_at>
void expect_signs(const std::optional<Algebraic_number>& failure, const Sign_at& sign_at,
                  const Rational& t) {
  constexpr int samples = 40;
  const Rational end = failure ? to_rational(failure->interval().lower) : Rational(t + 20);
  for (int k = 1; k < samples && end > t; ++k) {
    const Rational s = t + (end - t) * k / samples;
    ASSERT_NE(sign_at(s), CGAL::NEGATIVE) << "at " << s << ", before the failure";
  }
  if (failure) {
    const Rational s = to_rational(failure->interval().upper) + Rational(1, 1 << 30);
    ASSERT_EQ(sign_at(s), CGAL::NEGATIVE) << "at " << s << ", after the failure";
  }
}

template <class Disc>
class Certificates_of_discs : public testing::Test {};
using Discs = testing::Types<Disc_motion_2, Polynomial_disc_motion_2>;
TYPED_TEST_SUITE(Certificates_of_discs, Discs);

TYPED_TEST(Certificates_of_discs, agree_with_static_predicates_at_many_times) {
  using Point = Basic_moving_point_2<TypeParam>;
  const Basic_kinetic_traits_2<TypeParam> traits;
  const test::Static_kernel kernel;
  constexpr unsigned seed = 17;
  SCOPED_TRACE(seed);
  Disc_source source(seed);
  int circles = 0;
  int contacts = 0;
  for (int i = 0; i < test::cases(150); ++i) {
    const int flavor = i % 3 == 0 ? 0 : i % 3 == 1 ? 4 : 5;
    std::array<TypeParam, 4> m;
    std::array<Point, 4> p;
    const Rational t = to_rational(to_double(source.time(0)));
    const Algebraic_number time(t);
    for (std::size_t k = 0; k < 4; ++k) {
      m[k] = source.next<TypeParam>(flavor);
      if (m[k].growth < 0) m[k].growth = -m[k].growth;
      p[k] = Point(m[k]);
    }
    const test::On_failure trace([&] { return test::describe_discs(m) + "t = " + t.str(); });
    const auto circle = failure_of(
        [&](const Algebraic_number& after) {
          return traits.in_circle_certificate(p[0], p[1], p[2], p[3], after,
                                              Certificate_state::any);
        },
        [&](const Double_interval& bounds) {
          return traits.in_circle_failure(p[0], p[1], p[2], p[3], bounds);
        },
        time);
    circles += circle ? 1 : 0;
    expect_signs(
        circle,
        [&](const Rational& s) {
          return -kernel.power_side_of_oriented_power_circle_2_object()(
              disc_at(m[0], s), disc_at(m[1], s), disc_at(m[2], s), disc_at(m[3], s));
        },
        t);
    // Contacts of discs that are apart, as long as no radius is negative.
    for (const std::size_t k : {0U, 1U, 2U}) {
      const auto gap = [&](const Rational& s) {
        const Rational reach = radius_at(m[k], s) + radius_at(m[k + 1], s);
        return CGAL::compare(CGAL::squared_distance(test::place_at(center(m[k]), s),
                                                    test::place_at(center(m[k + 1]), s)),
                             reach * reach);
      };
      if (gap(t) != CGAL::POSITIVE || radius_at(m[k], t) < 0 || radius_at(m[k + 1], t) < 0)
        continue;
      const auto contact = failure_of(
          [&](const Algebraic_number& after) {
            return traits.contact_certificate(p[k], p[k + 1], 0, after);
          },
          [&](const Double_interval& bounds) {
            return traits.contact_failure(p[k], p[k + 1], 0, bounds);
          },
          time);
      contacts += contact ? 1 : 0;
      expect_signs(contact, gap, t);
    }
    const auto lighter = traits.weight_certificate(p[0], p[1], time);
    expect_signs(
        lighter.failure ? std::optional(*lighter.failure) : std::nullopt,
        [&](const Rational& s) { return CGAL::compare(weight_at(m[0], s), weight_at(m[1], s)); },
        t);
    if (this->HasFatalFailure()) return;
  }
  EXPECT_GT(circles, 20);
  EXPECT_GT(contacts, 2);
}

}  // namespace
}  // namespace kinetri::disc_kinetic_traits_2_test
