// SPDX-License-Identifier: GPL-3.0-or-later
#include "count_failure.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "kinetri/impl/base/check.h"
#include "static_sturm_sequence.h"

namespace kinetri {
namespace {

using Wide = Stack_integer<64>;
using Wide_polynomial = Static_polynomial<Wide>;
using Point = Dyadic_point<Wide>;
using Kind = Counted_failure::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();

// A binary64 number as a dyadic point, and the binary digits that it needs.
struct Point_of_double {
  std::int64_t mantissa = 0;  // odd, or 0
  int exponent = 0;           // x = mantissa 2^exponent

  explicit Point_of_double(double x) {
    if (x == 0) return;
    constexpr int digits = std::numeric_limits<double>::digits;
    mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), digits));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    mantissa >>= zeros;
    exponent += zeros - digits;
  }
  long bits() const { return exponent > 0 ? 64 + exponent : std::max(64, -exponent); }
  Point point() const {
    if (exponent <= 0) return {Wide(mantissa), static_cast<unsigned long>(-exponent)};
    return {Wide(mantissa) << static_cast<unsigned long>(exponent), 0};
  }
};

// p((m + y) / d) times d^n, as a polynomial of y, where `times_power(c, k)` is c d^k, by repeated
// Horner schemes.
template <class Times_power>
Wide_polynomial expanded(const Wide_polynomial& p, const Wide& m, const Times_power& times_power) {
  std::array<Wide, Wide_polynomial::most + 1> c;
  const int n = p.degree();
  const auto at = [&](int i) -> Wide& { return c[static_cast<std::size_t>(i)]; };
  for (int i = 0; i <= n; ++i) at(i) = times_power(p[i], n - i);
  for (int first = 0; first < n; ++first) {
    for (int i = n - 1; i >= first; --i) at(i) += at(i + 1) * m;
  }
  return Wide_polynomial(c, n);
}

Wide_polynomial expanded_at(const Wide_polynomial& p, const Point& from) {
  return expanded(p, from.numerator, [&](const Wide& c, int k) {
    return c << (from.exponent * static_cast<unsigned long>(k));
  });
}

// A polynomial of z in binary64 numbers, up to a positive factor, where y = 2^scale z. Its roots
// are nearly those of the exact one, and at most 4.
struct Approximation {
  std::array<double, 5> c = {};
  int degree = 0;
  long scale = 0;

  explicit Approximation(const Wide_polynomial& p) : degree(p.degree()) {
    std::array<long, 5> exponents = {};
    for (int i = 0; i <= degree; ++i) {
      at(i) = p[i].approximation(exponents[static_cast<std::size_t>(i)]);
    }
    // M. Fujiwara's bound of the roots, to a power of two.
    scale = std::numeric_limits<long>::min();
    const long lead = p[degree].bit_length();
    for (int i = 0; i < degree; ++i) {
      if (p[i].is_zero()) continue;
      const long excess = p[i].bit_length() - lead + 1;
      const long n = degree - i;
      scale = std::max(scale, excess >= 0 ? (excess + n - 1) / n : -(-excess / n));
    }
    if (scale == std::numeric_limits<long>::min()) scale = 0;
    long greatest = std::numeric_limits<long>::min();
    for (int i = 0; i <= degree; ++i) {
      if (!p[i].is_zero()) greatest = std::max(greatest, p[i].bit_length() + i * scale);
    }
    for (int i = 0; i <= degree; ++i) {
      const long shift = exponents[static_cast<std::size_t>(i)] + i * scale - greatest;
      at(i) = shift < -4000 ? 0 : std::ldexp(at(i), static_cast<int>(shift));
    }
  }
  double& at(int i) { return c[static_cast<std::size_t>(i)]; }
  double operator[](int i) const { return c[static_cast<std::size_t>(i)]; }

  double value(double z) const {
    double result = c[static_cast<std::size_t>(degree)];
    for (int i = degree - 1; i >= 0; --i) result = result * z + (*this)[i];
    return result;
  }
  Approximation derivative() const {
    Approximation result = *this;
    --result.degree;
    for (int i = 0; i <= result.degree; ++i) result.at(i) = (i + 1) * (*this)[i + 1];
    return result;
  }
};

// The root between two numbers at which the values have opposite signs, or are 0: Newton's method,
// with bisection if a step leaves the interval or converges slowly.
double root_between(const Approximation& f, const Approximation& slope, double low, double high) {
  const bool rises = f.value(low) < 0 || f.value(high) > 0;
  double z = (low + high) / 2;
  double last = high - low;
  for (int step = 0; step < 80; ++step) {
    const double value = f.value(z);
    if (value == 0) return z;
    ((value < 0) == rises ? low : high) = z;
    double next = z - value / slope.value(z);
    double move = std::abs(next - z);
    if (!(next > low && next < high) || move > last / 2) {
      next = (low + high) / 2;
      move = (high - low) / 2;
    }
    last = move;
    if (next == z || move <= std::abs(z) * 0x1p-52) return next;
    z = next;
  }
  return z;
}

// Approximations of the positive roots in ascending order; at most `most`.
class Positive_roots {
 public:
  Positive_roots(const Approximation& f, int most) { find(f, most); }
  int size() const { return size_; }
  double operator[](int i) const { return roots_[static_cast<std::size_t>(i)]; }

 private:
  void add(double z) { roots_[static_cast<std::size_t>(size_++)] = z; }

  void find(const Approximation& f, int most) {
    if (f.degree < 1) return;
    if (f.degree == 1) {
      const double z = -f[0] / f[1];
      if (z > 0 && std::isfinite(z)) add(z);
      return;
    }
    // f is monotone between two successive ones.
    const Approximation slope = f.derivative();
    const Positive_roots turns(slope, 4);
    double low = 0;
    double value_low = f[0];
    for (int i = 0; i <= turns.size() && size_ < most; ++i) {
      const double high = i < turns.size() ? turns[i] : bound;
      if (!(high > low)) continue;
      const double value_high = f.value(high);
      if ((value_low < 0) != (value_high < 0)) add(root_between(f, slope, low, high));
      low = high;
      value_low = value_high;
    }
  }

  static constexpr double bound = 8;
  std::array<double, 4> roots_ = {};
  int size_ = 0;
};

// An approximation of the first positive root, if there are `count`.
std::optional<double> guess_first_root(const Approximation& f, int count) {
  if (count == 1) {
    constexpr double bound = 8;
    if ((f[0] < 0) == (f.value(bound) < 0)) return std::nullopt;
    return root_between(f, f.derivative(), 0, bound);
  }
  const Positive_roots roots(f, 1);
  if (roots.size() == 0) return std::nullopt;
  return roots[0];
}

// The first nonzero sign of the terms, that of degree k times side^k: the sign of the polynomial
// just before or after the number at which it has the expansion `f`.
Sign sign_beside(const Wide_polynomial& f, Sign side) {
  Sign factor = CGAL::POSITIVE;
  for (int i = 0; i <= f.degree(); ++i, factor = factor * side) {
    if (!f[i].is_zero()) return sign(f[i]) * factor;
  }
  return CGAL::ZERO;
}

// Whether the k-th derivative certainly has no root in [lower, upper], given the expansion `f` at
// `from`, the point upper: its value at upper exceeds the change by the other terms, by their
// numbers of binary digits.
bool keeps_sign(const Wide_polynomial& f, int k, const Double_interval& interval,
                const Point& from) {
  if (f[k].is_zero()) return false;
  int width = 0;
  std::frexp(std::nextafter(interval.upper - interval.lower, infinity), &width);
  const long distance = width + static_cast<long>(from.exponent);
  long change = std::numeric_limits<long>::min();
  for (int i = k + 1; i <= f.degree(); ++i) {
    if (!f[i].is_zero()) change = std::max(change, f[i].bit_length() + (i - k) * distance);
  }
  // At most four terms, with binomial coefficients less than 8.
  return f[k].bit_length() - 1 > change + 5;
}

// Whether the terms of the sequence can be evaluated at x without overflow.
bool has_room(long coefficient_bits, double x) {
  return std::isfinite(x) &&
         4 * (coefficient_bits + Point_of_double(x).bits()) + 32 <= Wide::capacity;
}

// The failure of a polynomial whose coefficients have at most the given number of binary digits.
class Failure_search {
 public:
  Failure_search(const Wide_polynomial& p, long coefficient_bits)
      : p_(p), sequence_(p), coefficient_bits_(coefficient_bits) {}

  Counted_failure failure_after(const Double_interval& now, bool vanishes) const;

 private:
  bool can_evaluate_at(double x) const { return has_room(coefficient_bits_, x); }
  int changes_at(double x) const { return sequence_.changes_at(Point_of_double(x).point()); }
  Sign sign_at(double x) const { return sign(scaled_value(p_, Point_of_double(x).point())); }

  // V at the number at which p has the expansion `f`: the first two terms have its signs.
  int changes_at(const Point& from, const Wide_polynomial& f) const {
    int k = -1;
    return sequence_.changes([&](const Wide_polynomial& term) {
      ++k;
      return k < 2 ? sign(f[k]) : sign(scaled_value(term, from));
    });
  }

  const Wide_polynomial& p_;
  Static_sturm_sequence<Wide> sequence_;
  long coefficient_bits_;
};

Counted_failure Failure_search::failure_after(const Double_interval& now, bool vanishes) const {
  if (!can_evaluate_at(now.lower) || !can_evaluate_at(now.upper)) return {};
  if (!sequence_.is_square_free()) return {};
  const Point from = Point_of_double(now.upper).point();
  const Wide_polynomial f = expanded_at(p_, from);
  const int at_from = changes_at(from, f);
  if (now.lower != now.upper) {
    // In `now` there may be no root but t itself, which is one if `vanishes`.
    if (f[0].is_zero()) return {};
    if (!keeps_sign(f, vanishes ? 1 : 0, now, from) &&
        (sign_at(now.lower) == CGAL::ZERO ||
         changes_at(now.lower) - at_from != (vanishes ? 1 : 0))) {
      return {};
    }
  }
  if (sign_beside(f, CGAL::POSITIVE) == CGAL::NEGATIVE) return {Kind::at_once, {}};
  const int roots = at_from - sequence_.changes_at_plus_infinity();
  if (roots == 0) return {Kind::never_fails, {}};

  const Approximation approximation(f);
  const std::optional<double> z = guess_first_root(approximation, roots);
  if (!z) return {};
  const long exponent = approximation.scale - static_cast<long>(from.exponent);
  if (std::abs(exponent) > 2000) return {};
  const double distance = std::ldexp(*z, static_cast<int>(exponent));
  const double guess = now.upper + distance;
  if (!std::isfinite(guess)) return {};
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  double margin = 2 * epsilon * std::abs(guess) + 4 * epsilon * distance +
                  std::numeric_limits<double>::denorm_min();
  for (int attempt = 0; attempt < 4; ++attempt, margin *= 256) {
    const double lower = std::max(guess - margin, now.upper);
    const double upper = guess + margin;
    if (lower == now.upper && f[0].is_zero()) return {};
    if (!can_evaluate_at(lower) || !can_evaluate_at(upper)) return {};
    // The sign changes between the two, and there is one root up to the greater one: it is between
    // them.
    if (sign_at(lower) == CGAL::POSITIVE && sign_at(upper) == CGAL::NEGATIVE &&
        (roots == 1 || changes_at(upper) == at_from - 1)) {
      return {Kind::fails, {lower, upper}};
    }
  }
  return {};
}

}  // namespace

Counted_failure count_failure(const Narrow_polynomial& p, const Double_interval& now,
                              bool vanishes) {
  KINETRI_ASSERT(!p.is_zero(), "the zero polynomial is nowhere positive, and never fails");
  if (p.degree() == 0) {
    return {sign(p[0]) == CGAL::POSITIVE ? Kind::never_fails : Kind::at_once, {}};
  }
  const long bits = p.coefficient_bits();
  if (Static_sturm_sequence<Wide>::bits_needed(p.degree(), bits) > Wide::capacity) return {};
  const Wide_polynomial wide(p);
  return Failure_search(wide, bits).failure_after(now, vanishes);
}

std::optional<Sign> count_sign(const Narrow_polynomial& p, const Double_interval& now, Sign side) {
  if (p.degree() < 1) return p.is_zero() ? CGAL::ZERO : sign(p[0]);
  if (!has_room(p.coefficient_bits(), now.upper)) return std::nullopt;
  const Point from = Point_of_double(now.upper).point();
  const Wide_polynomial f = expanded_at(Wide_polynomial(p), from);
  if (now.lower == now.upper) return side == CGAL::ZERO ? sign(f[0]) : sign_beside(f, side);
  if (!f[0].is_zero() && keeps_sign(f, 0, now, from)) return sign(f[0]);
  return std::nullopt;
}

std::optional<Sign> count_sign(const Narrow_polynomial& p, const Rational& t, Sign side) {
  if (p.degree() < 1) return p.is_zero() ? CGAL::ZERO : sign(p[0]);
  const Integer numerator = boost::multiprecision::numerator(t);
  const Integer denominator = boost::multiprecision::denominator(t);
  const long bits = std::max(bit_length(numerator), bit_length(denominator));
  // A product temporarily takes up to two more words.
  constexpr long spare = 128;
  if (p.coefficient_bits() + p.degree() * (bits + 2) + spare > Wide::capacity) return std::nullopt;
  const Wide d(denominator);
  const auto times_power = [&](Wide c, int k) {
    for (; k > 0; --k) c = c * d;
    return c;
  };
  const Wide_polynomial f = expanded(Wide_polynomial(p), Wide(numerator), times_power);
  return side == CGAL::ZERO ? sign(f[0]) : sign_beside(f, side);
}

}  // namespace kinetri
