// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter never contradicts exact arithmetic: every verdict on random, nearly degenerate and
// wild certificates is checked against exact failure times. And it decides what it is there for.
#include "kinetri/kinetic/linear_filter.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <random>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/motions.h"

namespace kinetri {
namespace {

// Certificates of every flavor on which a filter could be wrong.
class Certificates {
 public:
  explicit Certificates(unsigned seed) : random_(seed) {}

  static constexpr int flavors = 9;
  static const char* name(int flavor) {
    constexpr const char* names[flavors] = {
        "random",         "tiny integers",   "nearly cocircular",
        "wild magnitude", "common velocity", "far-away epochs",
        "cancellation",   "nearly touching", "subnormal"};
    return names[flavor];
  }

  std::array<Linear_motion_2, 4> next(int flavor) {
    std::array<Linear_motion_2, 4> m;
    for (Linear_motion_2& motion : m) motion = {{real(), real()}, {real(), real()}, 0};
    switch (flavor) {
      case 0:
        break;
      case 1:
        for (auto& a : m) a = {{small(), small()}, {small(), small()}, 0};
        break;
      case 2:
        // On a circle, but for a few units in the last place, and hardly moving.
        for (auto& a : m) {
          const double angle = real();
          const double radius = 1 + std::ldexp(small(), -50);
          a.position = {7 + radius * std::cos(angle), -5 + radius * std::sin(angle)};
          a.velocity.x *= 1e-14;
          a.velocity.y *= 1e-14;
        }
        break;
      case 3: {
        const int places = 50 * integer_(random_);
        const int speeds = 50 * integer_(random_);
        for (auto& a : m) {
          a.position = {std::ldexp(real(), places + integer_(random_)), std::ldexp(real(), places)};
          a.velocity = {std::ldexp(real(), speeds + integer_(random_)), std::ldexp(real(), speeds)};
        }
        break;
      }
      case 4: {
        const Vector_2 common = {1e6 * real(), 1e6 * real()};
        for (auto& a : m) {
          a.velocity = {common.x + std::ldexp(small(), -20), common.y + std::ldexp(small(), -20)};
        }
        break;
      }
      case 5:
        for (auto& a : m) a.epoch = 1e5 * small() + real();
        break;
      case 6: {
        // A unit square that moves fast, from places far apart: its coordinates cancel, but for the
        // rounding of the places.
        const Vector_2 common = {1e6 * real(), 1e6 * real()};
        constexpr std::array<Vector_2, 4> square = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        for (std::size_t i = 0; i < m.size(); ++i) {
          const double epoch = real();
          m[i] = {{common.x * epoch + square[i].x, common.y * epoch + square[i].y}, common, epoch};
          if (integer_(random_) > 0) m[i].velocity.x += 1e-6 * real();
        }
        break;
      }
      case 7:
        // A point passes a resting circle along a tangent, but for some units in the last place.
        m = {{{{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {}}};
        m[3] = {{small() - 4 + real() / 32, 1 + std::ldexp(small(), -52 + 4 * integer_(random_))},
                {1, std::ldexp(small(), -40)},
                0};
        break;
      default:
        for (auto& a : m) {
          a.position = {5e-324 * std::round(1000 * real()), 5e-324 * std::round(1000 * real())};
          a.velocity = {std::ldexp(real(), -1000), std::ldexp(real(), -1040)};
        }
    }
    return m;
  }

  double time(int flavor) {
    if (flavor == 1 || flavor == 7) return small();
    return flavor == 5 ? 1e5 * real() : real();
  }

 private:
  double real() { return real_(random_); }
  double small() { return integer_(random_); }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> real_{-10, 10};
  std::uniform_int_distribution<int> integer_{-3, 3};
};

// Whether `verdict` from `after` on is true of the certificate with the polynomial `p`; the root at
// `after`, if the certificate vanishes there, does not count.
void expect_true(const Filter_verdict& verdict, const Polynomial& p,
                 const Algebraic_number& after) {
  if (verdict.kind == Filter_verdict::Kind::unknown) return;
  // Strictly positive: no root at all, not even a touch, before the end.
  ASSERT_FALSE(p.is_zero());
  ASSERT_EQ(sign_just_after(p, after), CGAL::POSITIVE);
  const auto root = first_root_after(p, after);
  if (verdict.kind != Filter_verdict::Kind::fails) {
    if (verdict.kind == Filter_verdict::Kind::holds_for_ever) {
      ASSERT_FALSE(root) << "fails, but was said to hold for ever";
    } else if (root) {
      ASSERT_GT(root->value, Algebraic_number(verdict.bounds.upper));
    }
    return;
  }
  ASSERT_TRUE(root) << "never fails, but was said to";
  ASSERT_EQ(root->multiplicity, 1);
  ASSERT_GT(root->value, Algebraic_number(verdict.bounds.lower));
  ASSERT_LT(root->value, Algebraic_number(verdict.bounds.upper));
  const auto next = first_root_after(p, root->value);
  if (next) {
    ASSERT_GT(next->value, Algebraic_number(verdict.bounds.upper)) << "two roots in one bracket";
  }
}

// What `filter` says in a rounding mode, which it leaves as it is.
template <class Filter>
Filter_verdict in_mode(int mode, const Filter& filter) {
  std::fesetround(mode);
  const Filter_verdict verdict = filter();
  EXPECT_EQ(std::fegetround(), mode);
  std::fesetround(FE_TONEAREST);
  return verdict;
}

class Linear_filter : public testing::TestWithParam<int> {};

TEST_P(Linear_filter, never_contradicts_exact_arithmetic) {
  constexpr unsigned seed = 314;
  Certificates source(seed);
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
      const Filter_verdict verdict = in_mode(mode, [&] {
        return filter_in_circle(a, b, m[2], m[3], {t, t}, false);
      });
      expect_true(verdict, circle, t);
      if (HasFatalFailure()) return;
      decided += verdict.kind != Filter_verdict::Kind::unknown;

      // After its failure, the negated certificate goes on from a root.
      if (verdict.kind == Filter_verdict::Kind::fails) {
        ++failures;
        const auto root = first_root_after(circle, t);
        ASSERT_TRUE(root);
        const Filter_verdict beyond =
            in_mode(mode, [&] { return filter_in_circle(b, a, m[2], m[3], verdict.bounds, true); });
        expect_true(beyond, -circle, root->value);
        if (HasFatalFailure()) return;
      }

      Polynomial turn = orientation_polynomial(p, q, r);
      if (is_negated) turn = -turn;
      const Filter_verdict turn_verdict = in_mode(mode, [&] {
        return filter_orientation(a, b, m[2], {t, t}, false);
      });
      expect_true(turn_verdict, turn, t);
      if (HasFatalFailure()) return;
      if (turn_verdict.kind == Filter_verdict::Kind::fails) {
        const auto root = first_root_after(turn, t);
        ASSERT_TRUE(root);
        expect_true(filter_orientation(b, a, m[2], turn_verdict.bounds, true), -turn, root->value);
        if (HasFatalFailure()) return;
      }
    }
    if (certainly_never_coincide(m[0], m[1])) {
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

INSTANTIATE_TEST_SUITE_P(Flavors, Linear_filter, testing::Range(0, Certificates::flavors),
                         [](const auto& instance) {
                           std::string name = Certificates::name(instance.param);
                           std::ranges::replace_if(
                               name, [](char c) { return c == ' ' || c == '-'; }, '_');
                           return name;
                         });

TEST(Linear_filter, knows_nothing_where_numbers_overflow) {
  const double huge = std::numeric_limits<double>::max();
  const Filter_verdict verdict =
      filter_in_circle({{-huge, 0}, {0, 0}, 0}, {{0, -huge}, {0, 0}, 0}, {{huge, 0}, {0, 0}, 0},
                       {{0, huge}, {huge, huge}, 0}, {0, 0}, false);
  EXPECT_EQ(verdict.kind, Filter_verdict::Kind::unknown);
}

}  // namespace
}  // namespace kinetri
