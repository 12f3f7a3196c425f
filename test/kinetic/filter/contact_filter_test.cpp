// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filters of contacts, and of predicates at an instant, never contradict exact arithmetic.
#include "kinetic/filter/filter.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>

#include "kinetic/filter/precise_filter.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/certificates.h"
#include "support/motions.h"
#include "support/on_failure.h"

namespace kinetri::contact_filter_test {
namespace {

// The first time from `t` on at which the certificate is not positive and falls, straight from the
// definition.
std::optional<Algebraic_number> first_contact(const Polynomial& certificate,
                                              const Algebraic_number& t) {
  if (sign_at(derivative(certificate), t) != CGAL::NEGATIVE) return std::nullopt;
  if (sign_at(certificate, t) != CGAL::POSITIVE) return t;
  const auto root = first_root_after(certificate, t);
  if (!root || sign_at(derivative(certificate), root->value) != CGAL::NEGATIVE) return std::nullopt;
  return root->value;
}

// Returns whether the result was more than nothing.
bool expect_true(const Filter_result& result, const Polynomial& certificate, double t) {
  if (result.kind == Filter_result::Kind::unknown) return false;
  const auto contact = first_contact(certificate, Algebraic_number(t));
  if (result.kind == Filter_result::Kind::fails) {
    EXPECT_TRUE(contact) << "no contact, but one was found";
    if (!contact) return true;
    EXPECT_GT(result.bounds.lower, t);
    EXPECT_LE(Algebraic_number(result.bounds.lower), *contact);
    EXPECT_GE(Algebraic_number(result.bounds.upper), *contact);
  } else {
    EXPECT_EQ(result.kind, Filter_result::Kind::never_fails);
    EXPECT_FALSE(contact) << "a contact, but none was found";
  }
  return true;
}

// Returns whether the discs are certainly apart at the start.
bool expect_apart(const Filter_result& result, const Polynomial& gap,
                  const Double_interval& after) {
  if (result.kind == Filter_result::Kind::unknown || result.may_be_zero) return false;
  EXPECT_EQ(gap.sign_at(to_rational(after.lower)), CGAL::POSITIVE);
  EXPECT_EQ(gap.sign_at(to_rational(after.upper)), CGAL::POSITIVE);
  return true;
}

// In each rounding mode in turn.
template <class Function>
auto in_mode(int i, const Function& function) {
  constexpr std::array<int, 4> modes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  std::fesetround(modes[static_cast<std::size_t>(i) % modes.size()]);
  const auto result = function();
  std::fesetround(FE_TONEAREST);
  return result;
}

class Contact_filter : public testing::TestWithParam<int> {};

TEST_P(Contact_filter, never_contradicts_exact_arithmetic) {
  test::Certificates source(271);
  std::mt19937_64 random(828);
  int decided = 0;
  int contacts = 0;
  int signs = 0;
  int apart = 0;
  int overlapping = 0;
  const int cases = test::cases(2000);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe({m.begin(), m.begin() + 2}); });
    const double t = source.time(GetParam());
    const double later = t + 1;
    const Moving_point_2 p(m[0]);
    const Moving_point_2 q(m[1]);
    // A diameter of the size of the distance at some time, at times exactly a distance.
    const Vector_2 a = rounded_place(m[0], t + 1);
    const Vector_2 b = rounded_place(m[1], t + 1);
    const double diameter = std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) *
                            std::ldexp(1.0, static_cast<int>(random() % 5) - 3);
    const Filter_result result = in_mode(i, [&] {
      return filter_contact(m[0], m[1], diameter, {t, t});
    });
    const Polynomial distance = contact_polynomial(p, q, diameter);
    decided += expect_true(result, distance, t);
    apart += expect_apart(result, distance, {t, t});
    overlapping += distance.sign_at(to_rational(t)) == CGAL::NEGATIVE;
    for (const double width : {0x1p-40, 1.0}) {
      const Double_interval after = {t, t + width};
      expect_apart(in_mode(i, [&] { return filter_contact(m[0], m[1], diameter, after); }),
                   distance, after);
    }
    contacts += result.kind == Filter_result::Kind::fails;
    if (HasFailure()) return;
    for (const Double_interval interval : {Double_interval{t, t}, Double_interval{t, later}}) {
      const auto expect_sign = [&](Sign sign, const Polynomial& polynomial) {
        if (sign == CGAL::ZERO) return;
        signs += interval.upper == t;
        ASSERT_EQ(polynomial.sign_at(to_rational(interval.lower)), sign);
        ASSERT_EQ(polynomial.sign_at(to_rational(interval.upper)), sign);
      };
      expect_sign(in_mode(i, [&] { return certain_distance_slope(m[0], m[1], interval); }),
                  derivative(distance));
      expect_sign(in_mode(i, [&] { return certain_gap(m[0], m[1], diameter, interval); }),
                  distance);
    }
    if (HasFailure()) return;

    for (const auto side :
         {Wall_2::Side::left, Wall_2::Side::right, Wall_2::Side::bottom, Wall_2::Side::top}) {
      const Wall_2 wall = {side, side < Wall_2::Side::bottom ? a.x : b.y,
                           i % 3 == 0 ? 0 : diameter};
      const Polynomial inside = wall_polynomial(p, wall);
      expect_true(in_mode(i, [&] { return filter_wall_contact(m[0], wall, {t, t}); }), inside, t);
      if (in_mode(i, [&] { return certainly_inside(m[0], wall, {t, later}); })) {
        ASSERT_EQ(inside.sign_at(to_rational(t)), CGAL::POSITIVE);
        ASSERT_EQ(inside.sign_at(to_rational(later)), CGAL::POSITIVE);
      }
      if (HasFailure()) return;
    }
  }
  if (GetParam() == 0) {
    EXPECT_GT(decided, cases * 85 / 100) << "all but the discs that overlap and approach";
    EXPECT_GT(contacts, cases / 20);
    EXPECT_GT(signs, 2 * cases * 99 / 100);
    EXPECT_GT(apart, (cases - overlapping) * 95 / 100);
    EXPECT_GT(overlapping, cases / 10);
  }
}

TEST_P(Contact_filter, of_signs_at_an_instant_never_contradicts_exact_arithmetic) {
  test::Certificates source(272);
  int decided = 0;
  int surrounded = 0;
  const int cases = test::cases(750);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe({m.begin(), m.end()}); });
    const double t = source.time(GetParam());
    const Moving_point_2 p(m[0]);
    const Moving_point_2 q(m[1]);
    const Moving_point_2 r(m[2]);
    const Moving_point_2 s(m[3]);
    const Double_interval interval = {t, t + 0x1p-40};
    const auto expect_sign = [&](Sign sign, const Polynomial& polynomial) {
      if (sign == CGAL::ZERO) return;
      ++decided;
      EXPECT_EQ(sign, polynomial.sign_at(to_rational(t)));
      EXPECT_EQ(sign, polynomial.sign_at(to_rational(interval.upper)));
    };
    const Linear_motion_2& a = m[0];
    const Linear_motion_2& b = m[1];
    const Linear_motion_2& c = m[2];
    const Linear_motion_2& d = m[3];
    expect_sign(in_mode(i, [&] { return certain_scalar_product(a, b, c, interval); }),
                scalar_product_polynomial(p, q, r));
    expect_sign(in_mode(i, [&] { return certain_distance_order(a, b, c, interval); }),
                distance_difference(p, q, r));
    expect_sign(in_mode(i, [&] { return certain_orientation(a, b, c, interval); }),
                orientation_polynomial(p, q, r));
    expect_sign(in_mode(i, [&] { return certain_in_circle(a, b, c, d, interval); }),
                in_circle_polynomial(p, q, r, s));
    const std::array<const Linear_motion_2*, 3> around = {&b, i % 2 == 0 ? &c : &d,
                                                          i % 2 == 0 ? &d : &c};
    if (in_mode(i, [&] { return certainly_surrounded<Linear_motion_2>(a, around, interval); })) {
      ++surrounded;
      for (std::size_t k = 0; k < 3; ++k) {
        const Polynomial turn = orientation_polynomial(p, Moving_point_2(*around[k]),
                                                       Moving_point_2(*around[(k + 1) % 3]));
        EXPECT_EQ(CGAL::POSITIVE, turn.sign_at(to_rational(t)));
        EXPECT_EQ(CGAL::POSITIVE, turn.sign_at(to_rational(interval.upper)));
      }
    }
    expect_sign(in_mode(i, [&] { return certain_x_order(a, b, interval); }), x_difference(p, q));
    expect_sign(in_mode(i, [&] { return certain_y_order(a, b, interval); }), y_difference(p, q));
    if (HasFailure()) return;
  }
  if (GetParam() == 0) {
    EXPECT_GT(decided, 6 * cases * 99 / 100);
    EXPECT_GT(surrounded, cases / 100);
  }
}

// The step of Newton's method errs, the more the smaller the discs are: beside the middle of two
// binary64 numbers it may be on the wrong side.
TEST(Rounded_contact, beside_the_middle_of_two_numbers_is_the_nearest_or_unknown) {
  constexpr int least = -40;
  int decided = 0;
  int cases = 0;
  for (int exponent = least; exponent <= 0; exponent += 4) {
    const double diameter = std::ldexp(1.0, exponent);
    for (int k = 1; k <= 52; ++k) {
      for (const double sign : {-1.0, 0.0, 1.0}) {
        // They touch at 1 + late.
        const double late = 0x1p-53 * (1 + sign * std::ldexp(1.0, -k));
        const Linear_motion_2 p = {{-diameter, 0}, {0, 0}, 0};
        const Linear_motion_2 q = {{late, 0}, {-1, 0}, 1};
        const Rational time = 1 + to_rational(late);
        const auto rounded = rounded_contact(p, q, diameter, {1 - 0x1p-50, 1 + 0x1p-50});
        ++cases;
        decided += rounded.has_value();
        if (rounded) {
          ASSERT_EQ(rounded->nearest, to_double(time)) << late << ", " << diameter;
          ASSERT_LT(rounded->bounds.lower, Algebraic_number(time));
          ASSERT_GT(rounded->bounds.upper, Algebraic_number(time));
        }
        const Linear_kinetic_traits_2 traits;
        const Algebraic_number contact = traits.contact_failure(
            Moving_point_2(p), Moving_point_2(q), diameter, {1 - 0x1p-50, 1 + 0x1p-50});
        ASSERT_EQ(contact.to_double(), to_double(time)) << late << ", " << diameter;
        ASSERT_EQ(contact, Algebraic_number(time));
      }
    }
  }
  EXPECT_GT(decided, cases / 5);
}

INSTANTIATE_TEST_SUITE_P(Flavors, Contact_filter, testing::Range(0, test::Certificates::flavors),
                         test::flavor_name);

}  // namespace
}  // namespace kinetri::contact_filter_test
