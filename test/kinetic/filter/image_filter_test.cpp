// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter of images of points in a periodic box never contradicts exact arithmetic. The
// polynomials are those of support/images.h, which shares no code with the library's.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "kinetic/filter/filter.h"
#include "kinetic/filter/precise_filter.h"
#include "kinetri/algebra/real_roots.h"
#include "support/brute_force_simulator.h"
#include "support/filter_results.h"
#include "support/images.h"
#include "support/on_failure.h"

namespace kinetri::image_filter_test {
namespace {

class Image_filter : public testing::TestWithParam<int> {};

// A range, and the polynomials of certificates of distances of four images. The sign is that of:
struct Distances {
  double range = 0;
  Polynomial gap;     // |pq|^2 - range^2
  Polynomial closer;  // |rs|^2 - |pq|^2
};

// The range is zero, or about a multiple of the distance at the time.
Distances distances_of(const std::array<Image_motion_2, 4>& m, double t, int multiple) {
  Distances result;
  const Vector_2 p = rounded_place(m[0], t);
  const Vector_2 q = rounded_place(m[1], t);
  const double range = 0.5 * multiple * std::hypot(p.x - q.x, p.y - q.y);
  if (std::isfinite(range)) result.range = range;
  // The range, as an image at rest.
  const auto [a, b, c, d, e] = test::paths_of(std::array<Image_motion_2, 5>{
      m[0], m[1], m[2], m[3], Image_motion_2{{{result.range, 0}, {0, 0}, 0}, {}, m[0].box}});
  const auto square = [](const auto& u, const auto& v) {
    return (u[0] - v[0]) * (u[0] - v[0]) + (u[1] - v[1]) * (u[1] - v[1]);
  };
  result.gap = square(a, b) - e[0] * e[0];
  result.closer = square(c, d) - square(a, b);
  return result;
}

struct Decided_distances {
  int decided = 0;
  int undecided = 0;
};

// Checks a certificate of a distance from `t` on, and after its failure that of the negation.
template <class Filter, class Filter_of_negation>
void expect_true_distance(const Polynomial& p, double t, int mode, const Filter& filter,
                          const Filter_of_negation& filter_of_negation, Decided_distances& counts) {
  const Filter_result result = test::in_mode(mode, [&] {
    return filter(Double_interval{t, t}, false);
  });
  test::expect_true(result, p, t);
  const bool is_decided = result.kind != Filter_result::Kind::unknown;
  counts.decided += is_decided;
  counts.undecided += !is_decided && sign_just_after(p, t) == CGAL::POSITIVE;
  if (testing::Test::HasFatalFailure() || result.kind != Filter_result::Kind::fails) return;
  test::expect_true(test::in_mode(mode, [&] { return filter_of_negation(result.bounds, true); }),
                    -p, first_root_after(p, t).value().value);
}

// That two are farther apart than the range, by `gap`, or nearer.
template <class Motion>
void expect_true_range(const Motion& p, const Motion& q, double range, const Polynomial& gap,
                       double t, int mode, Decided_distances& counts) {
  const auto apart = [&](const Double_interval& after, bool vanishes) {
    return filter_apart(p, q, range, after, vanishes);
  };
  const auto near = [&](const Double_interval& after, bool vanishes) {
    return filter_near(p, q, range, after, vanishes);
  };
  expect_true_distance(gap, t, mode, apart, near, counts);
  expect_true_distance(-gap, t, mode, near, apart, counts);
}

TEST_P(Image_filter, never_contradicts_exact_arithmetic) {
  test::Images source(51);
  test::Decided decided;
  int undecided = 0;
  Decided_distances distances;
  const int cases = test::cases(600);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe(m); });
    const double t = source.time();
    const int mode = test::rounding_mode(i);
    test::expect_true_certificates(m, t, mode, decided);
    if (HasFatalFailure()) return;
    // Once more, against polynomials of another source.
    const Polynomial in_circle = test::lifted_determinant(0, m);
    const auto paths = test::paths_of(m);
    const Polynomial turn = test::turn_of(paths[0], paths[1], paths[2]);
    const auto circle = test::in_mode(mode, [&] {
      return filter_in_circle(m[0], m[1], m[2], m[3], {t, t}, false);
    });
    test::expect_true(circle, -in_circle, t);
    if (circle.kind == Filter_result::Kind::unknown &&
        sign_just_after(in_circle, t) == CGAL::NEGATIVE) {
      ++undecided;
    }
    test::expect_true(test::in_mode(mode,
                                    [&] {
                                      return filter_orientation(m[0], m[1], m[2], {t, t}, false);
                                    }),
                      turn, t);
    if (HasFatalFailure()) return;
    // Signs throughout an interval.
    const Double_interval interval = {t, t + std::ldexp(1, -10 - source.integer(50))};
    const auto expect_sign = [&](const auto& certain, const Polynomial& p) {
      const Sign sign = test::in_mode(mode, certain);
      if (sign == CGAL::ZERO) return;
      ASSERT_EQ(sign_at(p, Algebraic_number(t)), sign);
      const auto root = first_root_after(p, t);
      ASSERT_TRUE(!root || root->value > Algebraic_number(interval.upper));
    };
    expect_sign([&] { return certain_x_order(m[0], m[1], interval); }, paths[0][0] - paths[1][0]);
    expect_sign([&] { return certain_y_order(m[0], m[1], interval); }, paths[0][1] - paths[1][1]);
    expect_sign([&] { return certain_orientation(m[0], m[1], m[2], interval); }, turn);
    expect_sign([&] { return certain_in_circle(m[0], m[1], m[2], m[3], interval); }, in_circle);
    if (HasFatalFailure()) return;
    const Distances of_images = distances_of(m, t, source.integer(4));
    const auto& [range, gap, closer] = of_images;
    expect_sign([&, range = range] { return certain_gap(m[0], m[1], range, interval); }, gap);
    expect_sign([&] { return certain_distance_comparison(m[0], m[1], m[2], m[3], interval); },
                closer);
    expect_true_range(m[0], m[1], range, gap, t, mode, distances);
    expect_true_distance(
        closer, t, mode,
        [&](const Double_interval& after, bool vanishes) {
          return filter_closer(m[0], m[1], m[2], m[3], after, vanishes);
        },
        [&](const Double_interval& after, bool vanishes) {
          return filter_closer(m[2], m[3], m[0], m[1], after, vanishes);
        },
        distances);
    if (HasFatalFailure()) return;
    if (test::in_mode(mode, [&] { return certainly_apart(m[0], m[1], interval); })) {
      // A common root would be one of the gcd.
      ASSERT_LE(gcd(paths[0][0] - paths[1][0], paths[0][1] - paths[1][1]).degree(), 0)
          << "they meet, but were said not to";
    }
    const std::array<const Image_motion_2*, 3> around = {&m[0], &m[1], &m[2]};
    if (test::in_mode(
            mode, [&] { return certainly_surrounded<Image_motion_2>(m[3], around, interval); })) {
      for (const std::size_t k : {0U, 1U, 2U}) {
        const Polynomial left = test::turn_of(paths[3], paths[k], paths[(k + 1) % 3]);
        ASSERT_EQ(sign_at(left, Algebraic_number(interval.lower)), CGAL::POSITIVE);
        ASSERT_EQ(sign_at(left, Algebraic_number(interval.upper)), CGAL::POSITIVE);
      }
    }
  }
  if (GetParam() < 3) {
    EXPECT_GT(decided.all, cases * 98 / 100) << "of the certificates, half hold at the start";
    EXPECT_GT(decided.failures, cases / 30);
    EXPECT_LT(undecided, cases / 50);
    EXPECT_GT(distances.decided, cases);
    EXPECT_LT(distances.undecided, cases / 3) << "a quarter begin at about the range";
  }
}

TEST_P(Image_filter, of_several_certificates_never_contradicts_exact_arithmetic) {
  test::Images source(52);
  test::Decided_after_flips counts;
  int decided = 0;
  const int cases = test::cases(350);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe(m); });
    // Others of the same box, near by.
    std::array<Image_motion_2, 4> beyond = m;
    for (std::size_t k = 0; k < 4; ++k) {
      beyond[k].offset = m[(k + 1) % 4].offset;
      beyond[k].motion.velocity = m[(k + 2) % 4].motion.velocity;
    }
    test::expect_true_pair(m, beyond, source.time(), test::rounding_mode(i), decided);
    if (HasFatalFailure()) return;
    test::expect_true_after_flip(m, beyond, source.time(), test::rounding_mode(i), counts);
    if (HasFatalFailure()) return;
  }
  if (GetParam() < 3) {
    EXPECT_GT(counts.flips, cases / 30);
    EXPECT_GT(counts.decided, counts.positive * 9 / 10);
    EXPECT_GT(decided, cases / 2);
  }
}

// The two numbers whose sum is about as near to the root as is possible.
std::array<double, 2> nearest_sum(const Algebraic_number& root) {
  const double high = root.to_double();
  if (!std::isfinite(high)) return {high, 0};
  Rational low = -to_rational(std::abs(high)) / (Integer(1) << 52);
  Rational step = -2 * low;
  for (int i = 0; i < 54; ++i) {
    step = step / 2;
    if (root > Algebraic_number(Rational(to_rational(high) + low + step))) low += step;
  }
  return {high, to_double(low)};
}

TEST_P(Image_filter, of_twice_the_precision_has_the_signs_of_exact_arithmetic_or_none) {
  test::Images source(53);
  int asked = 0;
  int known = 0;
  int rounded = 0;
  int failures = 0;
  const int cases = test::cases(600);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe(m); });
    const double t = source.time();
    const Polynomial in_circle = test::lifted_determinant(0, m);
    const auto paths = test::paths_of(m);
    const Polynomial turn = test::turn_of(paths[0], paths[1], paths[2]);
    const auto expect_sign = [&](double value, const Polynomial& p, double high, double low) {
      ++asked;
      if (value == 0) return;
      ++known;
      EXPECT_EQ(value > 0 ? CGAL::POSITIVE : CGAL::NEGATIVE,
                p.sign_at(to_rational(high) + to_rational(low)));
    };
    const auto [range, gap, closer] = distances_of(m, t, source.integer(4));
    const auto expect_signs = [&, range = range, &gap = gap, &closer = closer](double high,
                                                                               double low) {
      expect_sign(precise_contact(m[0], m[1], range, high, low), gap, high, low);
      expect_sign(precise_distance_comparison(m[0], m[1], m[2], m[3], high, low), closer, high,
                  low);
      expect_sign(precise_in_circle(m[0], m[1], m[2], m[3], high, low), in_circle, high, low);
      expect_sign(precise_orientation(m[0], m[1], m[2], high, low), turn, high, low);
    };
    expect_signs(t, 0);
    expect_signs(t, t * 0x1p-60);
    // At a root of either and as near to it as two numbers can be, where signs are difficult.
    for (const Polynomial& p : {in_circle, turn, gap, closer}) {
      if (p.is_zero()) continue;
      const auto root = first_root_after(p, t);
      if (!root) continue;
      const auto [high, low] = nearest_sum(root->value);
      if (std::isfinite(high)) expect_signs(high, low);
    }
    if (HasFailure()) return;
    const Filter_result result = filter_in_circle(m[0], m[1], m[2], m[3], {t, t}, false);
    if (result.kind != Filter_result::Kind::fails) continue;
    ++failures;
    const auto rounding = rounded_in_circle(m[0], m[1], m[2], m[3], result.bounds);
    if (!rounding) continue;
    ++rounded;
    const Algebraic_number time = first_root_after(in_circle, t).value().value;
    EXPECT_EQ(rounding->nearest, time.to_double());
    EXPECT_LT(rounding->bounds.lower, time);
    EXPECT_GT(rounding->bounds.upper, time);
    if (HasFailure()) return;
  }
  if (GetParam() < 3) {
    EXPECT_GT(known, asked / 2);
    EXPECT_GT(failures, cases / 100);
    EXPECT_GT(rounded, failures / 2);
  }
}

// ---- contacts ----

// The first time from t on at which the gap of two discs is not positive and falls. Boundaries that
// are not apart at a time do not meet later.
std::optional<Algebraic_number> first_contact(const Polynomial& gap, const Algebraic_number& t) {
  if (sign_at(gap, t) != CGAL::POSITIVE) {
    return sign_just_after(derivative(gap), t) == CGAL::NEGATIVE ? std::optional(t) : std::nullopt;
  }
  const auto root = first_root_after(gap, t);
  if (!root || root->multiplicity > 1) return std::nullopt;
  return root->value;
}

struct Decided_contacts {
  int all = 0;
  int contacts = 0;
  int rounded = 0;
};

// Expects that all that the filter says of a contact from t on is true. Points have the diameter,
// and the diameter of discs with radii of their own is 0.
template <class Motion>
void expect_true_contacts(const Motion& p, const Motion& q, double diameter, const Polynomial& gap,
                          const Double_interval& interval, int mode, Decided_contacts& decided) {
  const double t = interval.lower;
  const Filter_result result = test::in_mode(mode, [&] {
    return filter_contact(p, q, diameter, {t, t});
  });
  if (result.kind != Filter_result::Kind::unknown) {
    ++decided.all;
    const auto contact = first_contact(gap, t);
    ASSERT_EQ(contact.has_value(), result.kind == Filter_result::Kind::fails);
    if (contact) {
      ++decided.contacts;
      ASSERT_GT(*contact, Algebraic_number(result.bounds.lower));
      ASSERT_LT(*contact, Algebraic_number(result.bounds.upper));
      if (const auto rounding = rounded_contact(p, q, diameter, result.bounds)) {
        ++decided.rounded;
        ASSERT_EQ(rounding->nearest, contact->to_double());
      }
      // As near to the root as two numbers can be, where the sign is difficult.
      const auto [high, low] = nearest_sum(*contact);
      if (std::isfinite(high)) {
        const double value = precise_contact(p, q, diameter, high, low);
        const Sign expected = gap.sign_at(to_rational(high) + to_rational(low));
        if (value != 0) {
          ASSERT_EQ(value > 0 ? CGAL::POSITIVE : CGAL::NEGATIVE, expected);
        }
      }
    }
  }
  const auto expect_sign = [&](const auto& certain, const Polynomial& polynomial) {
    const Sign sign = test::in_mode(mode, certain);
    if (sign == CGAL::ZERO) return;
    ASSERT_EQ(sign_at(polynomial, Algebraic_number(t)), sign);
    const auto root = first_root_after(polynomial, t);
    ASSERT_TRUE(!root || root->value > Algebraic_number(interval.upper));
  };
  expect_sign([&] { return certain_gap(p, q, diameter, interval); }, gap);
  expect_sign([&] { return certain_distance_slope(p, q, interval); }, derivative(gap));
  const Filter_result later =
      test::in_mode(mode, [&] { return filter_contact(p, q, diameter, interval); });
  if (later.kind != Filter_result::Kind::unknown && !later.may_be_zero) {
    expect_sign([] { return CGAL::POSITIVE; }, gap);
  }
}

TEST_P(Image_filter, of_contacts_never_contradicts_exact_arithmetic) {
  test::Images source(54);
  Decided_contacts decided;
  const int cases = test::cases(600);
  for (int i = 0; i < cases; ++i) {
    const auto m = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe(m); });
    const double t = source.time();
    const Image_motion_2& p = m[0];
    const Image_motion_2& q = m[1];
    // Of the size of a distance soon; at times exactly a coordinate of a difference.
    const Vector_2 a = rounded_place(p, t + std::ldexp(1, -source.integer(20)));
    const Vector_2 b = rounded_place(q, t);
    const double diameter =
        std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) * std::ldexp(1, source.integer(4) - 3);
    if (!std::isfinite(diameter)) continue;
    const Polynomial gap = test::interpolate(2, [&](const Rational& time) {
      return Rational(CGAL::squared_distance(test::place_at(p, time), test::place_at(q, time)) -
                      to_rational(diameter) * to_rational(diameter));
    });
    const Double_interval interval = {t, t + std::ldexp(1, -10 - source.integer(50))};
    expect_true_contacts(p, q, diameter, gap, interval, test::rounding_mode(i), decided);
    if (HasFatalFailure()) return;
  }
  if (GetParam() < 3) {
    EXPECT_GT(decided.all, cases / 2);
    EXPECT_GT(decided.contacts, cases / 40);
    EXPECT_GT(decided.rounded, decided.contacts / 2);
  }
}

// ---- discs ----

// Discs about the images, of about the size of their distances at the time: of equal or different
// radii, which may grow, and with weights of either sign.
std::array<Image_disc_motion_2, 4> discs_about(const std::array<Image_motion_2, 4>& centers,
                                               double time, test::Images& source) {
  const auto share = [&] { return source.integer(2001) / 1000.0 - 1; };
  const auto distance = [&](const Image_motion_2& p, const Image_motion_2& q) {
    const Vector_2 a = rounded_place(p, time);
    const Vector_2 b = rounded_place(q, time);
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
  };
  const double size = distance(centers[0], centers[1]);
  const bool are_equal = source.integer(6) == 0;
  const bool do_grow = source.integer(2) == 0;
  const bool have_weights = source.integer(3) == 0;
  const double radius = size * std::abs(share());
  std::array<Image_disc_motion_2, 4> result;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = {centers[i], are_equal ? radius : size * std::abs(share()),
                 do_grow ? size * share() : 0,
                 have_weights && !are_equal ? 4 * size * size * share() : 0};
  }
  return result;
}

// The sign of the determinant of in_circle_polynomial by its definition.
Sign sign_of_power_circle(const std::array<Image_disc_motion_2, 4>& discs, const Rational& t) {
  std::array<std::array<Rational, 3>, 4> rows;  // x, y, lift
  for (std::size_t i = 0; i < 4; ++i) {
    const Image_disc_motion_2& d = discs[i];
    const test::Static_point place = test::place_at(center(d), t);
    const Rational radius =
        to_rational(d.radius) + to_rational(d.growth) * (t - to_rational(d.motion.epoch));
    rows[i] = {
        place.x(), place.y(),
        place.x() * place.x() + place.y() * place.y() - radius * radius - to_rational(d.weight)};
  }
  const auto turn = [&](std::size_t i, std::size_t j, std::size_t k) -> Rational {
    return (rows[j][0] - rows[i][0]) * (rows[k][1] - rows[i][1]) -
           (rows[j][1] - rows[i][1]) * (rows[k][0] - rows[i][0]);
  };
  const Rational determinant = rows[0][2] * turn(1, 2, 3) - rows[1][2] * turn(0, 2, 3) +
                               rows[2][2] * turn(0, 1, 3) - rows[3][2] * turn(0, 1, 2);
  return CGAL::sign(determinant.sign());
}

TEST_P(Image_filter, of_discs_never_contradicts_exact_arithmetic) {
  using Point = Moving_image_disc_2;
  test::Images source(57);
  test::Decided decided;
  test::Decided_after_flips counts;
  int pairs = 0;
  const int cases = test::cases(250);
  for (int i = 0; i < cases; ++i) {
    const auto centers = source.next(GetParam());
    const test::On_failure trace([&] { return test::describe(centers); });
    const double t = source.time();
    const auto m = discs_about(centers, t, source);
    auto beyond = discs_about(centers, t, source);
    for (std::size_t k = 0; k < 4; ++k) beyond[k].offset = centers[(k + 1) % 4].offset;
    const int mode = test::rounding_mode(i);
    const Polynomial in_circle =
        in_circle_polynomial(Point(m[0]), Point(m[1]), Point(m[2]), Point(m[3]));
    for (const Rational& time : {to_rational(t), Rational(to_rational(t) + 1), Rational(-7, 3)}) {
      ASSERT_EQ(in_circle.sign_at(time), sign_of_power_circle(m, time));
    }
    test::expect_true_certificates(m, t, mode, decided);
    if (HasFatalFailure()) return;
    test::expect_true_pair(m, beyond, t, mode, pairs);
    if (HasFatalFailure()) return;
    test::expect_true_after_flip(m, beyond, t, mode, counts);
    if (HasFatalFailure()) return;
    // Signs throughout an interval.
    const Double_interval interval = {t, t + std::ldexp(1, -10 - source.integer(50))};
    const auto expect_sign = [&](const auto& certain, const Polynomial& p) {
      const Sign sign = test::in_mode(mode, certain);
      if (sign == CGAL::ZERO) return;
      ASSERT_EQ(sign_at(p, Algebraic_number(t)), sign);
      const auto root = first_root_after(p, t);
      ASSERT_TRUE(!root || root->value > Algebraic_number(interval.upper));
    };
    expect_sign([&] { return certain_in_circle(m[0], m[1], m[2], m[3], interval); }, in_circle);
    expect_sign([&] { return certain_power_distance_order(m[0], m[1], m[2], interval); },
                power_distance_difference(Point(m[0]), Point(m[1]), Point(m[2])));
    expect_sign([&] { return certain_weight_order(m[0], m[1], interval); },
                weight_difference(Point(m[0]), Point(m[1])));
    if (HasFatalFailure()) return;
    if (test::in_mode(mode, [&] { return certainly_apart(m[0], m[1], interval); })) {
      const Polynomial x = x_difference(Point(m[0]), Point(m[1]));
      const Polynomial y = y_difference(Point(m[0]), Point(m[1]));
      ASSERT_TRUE(!x.is_zero() || !y.is_zero()) << "they have one position for ever";
      ASSERT_LE(gcd(x, y).degree(), 0) << "they meet, but were said not to";
    }
    // Twice the precision, also as near to a root as two numbers can be.
    const auto expect_precise = [&](double high, double low) {
      const double value = precise_in_circle(m[0], m[1], m[2], m[3], high, low);
      if (value == 0) return;
      ASSERT_EQ(CGAL::sign(value), in_circle.sign_at(to_rational(high) + to_rational(low)));
    };
    expect_precise(t, t * 0x1p-60);
    if (in_circle.is_zero()) continue;
    if (const auto root = first_root_after(in_circle, t)) {
      const auto [high, low] = nearest_sum(root->value);
      if (std::isfinite(high)) expect_precise(high, low);
    }
    if (HasFatalFailure()) return;
  }
  if (GetParam() < 3) {
    EXPECT_GT(decided.all, cases * 95 / 100) << "of the certificates, half hold at the start";
    EXPECT_GT(decided.failures, cases / 30);
    EXPECT_GT(pairs, cases / 2);
    EXPECT_GT(counts.flips, cases / 30);
  }
}

// Radii that grow faster than the centers move, or as fast, make gaps that are not convex.
TEST_P(Image_filter, of_distances_of_discs_never_contradicts_exact_arithmetic) {
  test::Images source(58);
  Decided_contacts decided;
  Decided_distances distances;
  const int cases = test::cases(300);
  for (int i = 0; i < cases; ++i) {
    const auto centers = source.next(GetParam());
    SCOPED_TRACE(test::describe(centers));
    const double t = source.time();
    auto m = discs_about(centers, t, source);
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector_2& velocity = centers[k].motion.velocity;
      m[k].weight = 0;
      m[k].radius *= std::ldexp(1, -source.integer(4));
      if (m[k].growth != 0) {
        m[k].growth = source.integer(2) == 0 ? std::abs(m[k].growth) : std::abs(velocity.x);
      }
    }
    const Image_disc_motion_2& p = m[0];
    const Image_disc_motion_2& q = m[1];
    if (!std::isfinite(p.radius + p.growth + q.radius + q.growth)) continue;
    const auto reach = [&](const Rational& time) {
      Rational result = 0;
      for (const Image_disc_motion_2* disc : {&p, &q}) {
        result += to_rational(disc->radius) +
                  to_rational(disc->growth) * (time - to_rational(epoch_of(*disc)));
      }
      return result;
    };
    if (reach(to_rational(t)) < 0) continue;
    const auto gap_beyond = [&](double range) {
      return test::interpolate(2, [&](const Rational& time) {
        const Rational sum = reach(time) + to_rational(range);
        return Rational(CGAL::squared_distance(test::place_at(center(p), time),
                                               test::place_at(center(q), time)) -
                        sum * sum);
      });
    };
    const Double_interval interval = {t, t + std::ldexp(1, -10 - source.integer(50))};
    const int mode = test::rounding_mode(i);
    expect_true_contacts(p, q, 0, gap_beyond(0), interval, mode, decided);
    if (HasFatalFailure()) return;
    const double range = distances_of(centers, t, source.integer(4)).range;
    expect_true_range(p, q, range, gap_beyond(range), t, mode, distances);
    if (HasFatalFailure()) return;
  }
  if (GetParam() < 3) {
    EXPECT_GT(decided.all, cases / 3);
    EXPECT_GT(decided.contacts, cases / 40);
    EXPECT_GT(decided.rounded, decided.contacts / 2);
    EXPECT_GT(distances.decided, cases / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Image_filter, testing::Range(0, test::Images::kinds),
                         test::kind_name);

void expect_equal(const Filter_result& a, const Filter_result& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.bounds.lower, b.bounds.lower);
  EXPECT_EQ(a.bounds.upper, b.bounds.upper);
  EXPECT_EQ(a.is_refined, b.is_refined);
  EXPECT_EQ(a.may_be_zero, b.may_be_zero);
}

// Bit for bit, with any equal offsets.
TEST(Image_filter, of_equal_offsets_has_the_results_of_points) {
  const Periodic_box_2 box({{3, 1}, {0.1, 1e10}, 5}, {{-1, 3}, {0.3, 0.7}, -2});
  std::mt19937_64 random(54);
  std::uniform_real_distribution<double> real(-10, 10);
  constexpr std::array<Lattice_offset_2, 3> offsets = {
      {{0, 0}, {-5, 3}, {2147483647, -2147483648}}};
  for (int i = 0; i < test::cases(3000); ++i) {
    std::array<Linear_motion_2, 8> m;
    const bool is_coarse = i % 4 == 0;
    const auto number = [&] { return is_coarse ? std::round(real(random) / 3) : real(random); };
    for (Linear_motion_2& a : m) {
      a = {{number(), number()}, {number(), number()}, i % 3 == 0 ? number() : 0};
    }
    const double t = number();
    std::array<Image_motion_2, 8> n;
    const Lattice_offset_2 offset = offsets[static_cast<std::size_t>(i) % offsets.size()];
    for (std::size_t k = 0; k < m.size(); ++k) n[k] = {m[k], offset, &box};
    const Double_interval after = {t, i % 2 == 0 ? t : t + 1e-12};
    const auto circle = filter_in_circle(m[0], m[1], m[2], m[3], after, i % 5 == 0);
    expect_equal(filter_in_circle(n[0], n[1], n[2], n[3], after, i % 5 == 0), circle);
    expect_equal(filter_orientation(n[0], n[1], n[2], after, false),
                 filter_orientation(m[0], m[1], m[2], after, false));
    const Flip_neighborhood<Linear_motion_2> around = {{&m[0], &m[1], &m[2], &m[3]},
                                                       {&m[4], &m[5], &m[6], &m[7]}};
    const Flip_neighborhood<Image_motion_2> around_images = {{&n[0], &n[1], &n[2], &n[3]},
                                                             {&n[4], &n[5], &n[6], &n[7]}};
    const auto five = filter_after_flip(around, after);
    const auto five_of_images = filter_after_flip(around_images, after);
    for (std::size_t k = 0; k < five.size(); ++k) expect_equal(five_of_images[k], five[k]);
    // Positions of images are rounded one by one.
    if (offset == Lattice_offset_2()) {
      EXPECT_EQ(certain_in_circle(n[0], n[1], n[2], n[3], after),
                certain_in_circle(m[0], m[1], m[2], m[3], after));
      EXPECT_EQ(certain_orientation(n[0], n[1], n[2], after),
                certain_orientation(m[0], m[1], m[2], after));
    }
    EXPECT_EQ(certainly_apart(n[0], n[1], after), certainly_apart(m[0], m[1], after));
    EXPECT_EQ(precise_in_circle(n[0], n[1], n[2], n[3], t, 0),
              precise_in_circle(m[0], m[1], m[2], m[3], t, 0));
    EXPECT_EQ(precise_orientation(n[0], n[1], n[2], t, 0),
              precise_orientation(m[0], m[1], m[2], t, 0));
    if (circle.kind == Filter_result::Kind::fails) {
      const auto rounding = rounded_in_circle(m[0], m[1], m[2], m[3], circle.bounds);
      const auto of_images = rounded_in_circle(n[0], n[1], n[2], n[3], circle.bounds);
      ASSERT_EQ(of_images.has_value(), rounding.has_value());
      if (rounding) {
        EXPECT_EQ(of_images->nearest, rounding->nearest);
      }
    }
    if (testing::Test::HasFailure()) return;
  }
}

// Velocities that cancel those of the lattice vectors up to rounding: slopes computed as zero, or
// as small as their errors, are not zero.
TEST(Image_filter, takes_no_small_slope_for_what_it_is) {
  const double rate = 1e12;
  const Periodic_box_2 box({{10, 0}, {rate / 3, 0}, 0}, {{0, 10}, {0, rate / 7}, 0});
  std::mt19937_64 random(55);
  std::uniform_real_distribution<double> real(0, 10);
  int rounded_to_zero = 0;
  for (int i = 0; i < test::cases(2000); ++i) {
    std::array<Image_motion_2, 4> m;
    for (Image_motion_2& image : m) {
      image = {{}, {static_cast<int>(random() % 7) - 3, static_cast<int>(random() % 7) - 3}, &box};
      const auto [k, l] = image.offset;
      image.motion = {{real(random) - 10 * k, real(random) - 10 * l},
                      {-k * box.first().velocity.x, -l * box.second().velocity.y},
                      0};
    }
    const Polynomial in_circle = test::lifted_determinant(0, m);
    const auto paths = test::paths_of(m);
    const Filter_result result = filter_in_circle(m[0], m[1], m[2], m[3], {0, 0}, false);
    test::expect_true(result, -in_circle, 0.0);
    test::expect_true(filter_orientation(m[0], m[1], m[2], {0, 0}, false),
                      test::turn_of(paths[0], paths[1], paths[2]), 0.0);
    if (certainly_apart(m[0], m[1], {0, 0})) {
      ASSERT_LE(gcd(paths[0][0] - paths[1][0], paths[0][1] - paths[1][1]).degree(), 0);
    }
    rounded_to_zero += in_circle.degree() > 0;
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(rounded_to_zero, test::cases(1000)) << "the images move, by what has been rounded";
}

// The rounded slope has another direction than the exact one, along which they meet.
TEST(Image_filter, does_not_say_that_images_are_apart_whose_slopes_cancel) {
  std::mt19937_64 random(56);
  std::uniform_real_distribution<double> real(1e12, 2e12);
  for (int i = 0; i < 500; ++i) {
    const Vector_2 rate = {real(random), real(random)};
    const Periodic_box_2 box({{1, 0}, rate, 0}, {{0, 1}, {0, 0}, 0});
    // A velocity that cancels that of the image up to some units in the last place, and what is
    // left, exactly.
    const auto velocity = [&](double x) {
      return -3 * x + static_cast<double>(i % 7 + 1) * 0x1p-11;
    };
    const Vector_2 v = {velocity(rate.x), -3 * rate.y + 0x1p-11};
    const Vector_2 slope = {std::fma(3, rate.x, v.x), std::fma(3, rate.y, v.y)};
    const double time = i % 5 + 1;
    const Image_motion_2 p = {{{-time * slope.x - 3, -time * slope.y}, v, 0}, {3, 0}, &box};
    const Image_motion_2 q = {{}, {0, 0}, &box};
    ASSERT_EQ(test::place_at(p, to_rational(time)), test::Static_point(0, 0));
    EXPECT_FALSE(certainly_apart(p, q, {0, 0}));
  }
}

}  // namespace
}  // namespace kinetri::image_filter_test
