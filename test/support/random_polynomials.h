// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random numbers, and polynomials built from known roots and multiplicities: the oracle of the
// algebra tests.
#ifndef KINETRI_TEST_SUPPORT_RANDOM_POLYNOMIALS_H
#define KINETRI_TEST_SUPPORT_RANDOM_POLYNOMIALS_H

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/mpfr.hpp>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/number_types.h"
#include "kinetri/algebra/polynomial.h"
#include "kinetri/algebra/real_roots.h"
#include "support/multiplier.h"

namespace kinetri::test {

/// Random numbers that do not depend on the standard library, as its distributions do.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// Uniform enough in [low, high].
  long integer(long low, long high) {
    return low + static_cast<long>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool coin() { return (engine_() >> 63) != 0; }
  /// A random element.
  template <class T>
  const T& pick(const std::vector<T>& from) {
    return from[static_cast<std::size_t>(engine_() % from.size())];
  }

  /// An integer of up to `bits` bits and either sign.
  Integer big_integer(unsigned bits) {
    Integer result = 0;
    for (unsigned done = 0; done < bits; done += 64) {
      result <<= 64;
      result += engine_();
    }
    result >>= (64 - bits % 64) % 64;
    return coin() ? result : Integer(-result);
  }
  Integer big_integer_not_zero(unsigned bits) {
    const Integer result = big_integer(bits);
    return result.is_zero() ? Integer(1) : result;
  }
  /// A rational with numerator and denominator of up to `bits` bits.
  Rational rational(unsigned bits) {
    const Integer denominator = boost::multiprecision::abs(big_integer_not_zero(bits));
    return Rational(big_integer(bits), denominator);
  }
  /// An integer of up to `bits` bits times a power of two with an exponent in [low, high].
  Rational dyadic(unsigned bits, long low, long high) {
    return scaled_by_power_of_two(Rational(big_integer(bits)), integer(low, high));
  }
  /// A rational of one of several kinds: small integer, small fraction, dyadic, large fraction.
  Rational any_rational() {
    switch (integer(0, 3)) {
      case 0:
        return integer(-9, 9);
      case 1:
        return Rational(integer(-30, 30), integer(1, 12));
      case 2:
        return dyadic(30, -40, 4);
      default:
        return rational(60);
    }
  }
  /// A polynomial of exactly this degree with coefficients of up to `bits` bits.
  Polynomial polynomial(int degree, unsigned bits) {
    std::vector<Integer> c;
    for (int i = 0; i < degree; ++i) c.push_back(big_integer(bits));
    c.push_back(big_integer_not_zero(bits));
    return Polynomial(std::move(c));
  }

 private:
  std::mt19937_64 engine_;
};

/// An MPFR number whose precision is chosen per value.
using Big_float = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<0>,
                                                boost::multiprecision::et_off>;

/// Far more bits than any test needs to distinguish two roots.
inline constexpr mpfr_prec_t oracle_precision = 6000;

inline Big_float oracle_value(const Rational& x) {
  Big_float result;
  mpfr_set_prec(result.backend().data(), oracle_precision);
  mpfr_set_q(result.backend().data(), x.backend().data(), MPFR_RNDN);
  return result;
}

/// a + sqrt(c), or a - sqrt(c). Precondition: c > 0 is not a square.
inline Big_float oracle_value(const Rational& a, const Rational& c, bool plus) {
  Big_float result = oracle_value(c);
  mpfr_sqrt(result.backend().data(), result.backend().data(), MPFR_RNDN);
  if (!plus) mpfr_neg(result.backend().data(), result.backend().data(), MPFR_RNDN);
  mpfr_add_q(result.backend().data(), result.backend().data(), a.backend().data(), MPFR_RNDN);
  return result;
}

/// The dyadic rational with `bits` bits nearest to `x`.
inline Rational rounded(const Big_float& x, unsigned bits) {
  Big_float shorter;
  mpfr_set_prec(shorter.backend().data(), static_cast<mpfr_prec_t>(bits));
  mpfr_set(shorter.backend().data(), x.backend().data(), MPFR_RNDN);
  Rational result;
  mpfr_get_q(result.backend().data(), shorter.backend().data());
  return result;
}

/// A root that a polynomial has by construction.
struct Known_root {
  Big_float value;
  int multiplicity = 0;
  std::optional<Rational> rational;  // empty: irrational
  Polynomial minimal;                // the irreducible polynomial with this root
};

/// den * t - num.
inline Polynomial linear_factor(const Rational& root) {
  return Polynomial{Integer(-boost::multiprecision::numerator(root)),
                    boost::multiprecision::denominator(root)};
}

/// A primitive multiple of (t - a)^2 - c.
inline Polynomial quadratic_factor(const Rational& a, const Rational& c) {
  return primitive_polynomial(std::vector<Rational>{a * a - c, -2 * a, 1});
}

/// A product of factors, with its real roots in ascending order.
class Known_polynomial {
 public:
  explicit Known_polynomial(Integer constant = 1) : polynomial_{std::move(constant)} {}

  const Polynomial& polynomial() const { return polynomial_; }
  const std::vector<Known_root>& roots() const { return roots_; }
  int degree() const { return polynomial_.degree(); }

  bool has_root(const Big_float& value) const {
    return std::any_of(roots_.begin(), roots_.end(),
                       [&](const Known_root& r) { return r.value == value; });
  }

  /// Multiplies by (t - root)^multiplicity, up to a positive factor. No effect if it is a root
  /// already.
  void add_rational(const Rational& root, int multiplicity) {
    const Big_float value = oracle_value(root);
    if (has_root(value)) return;
    const Polynomial factor = linear_factor(root);
    multiply(factor, multiplicity);
    insert({value, multiplicity, root, factor});
  }

  /// Multiplies by ((t - a)^2 - c)^multiplicity, up to a positive factor; both roots are
  /// irrational. Precondition: c > 0 is not the square of a rational. No effect if they are roots
  /// already.
  void add_irrational_pair(const Rational& a, const Rational& c, int multiplicity) {
    const Big_float value = oracle_value(a, c, true);
    if (has_root(value)) return;
    const Polynomial factor = quadratic_factor(a, c);
    multiply(factor, multiplicity);
    insert({value, multiplicity, std::nullopt, factor});
    insert({oracle_value(a, c, false), multiplicity, std::nullopt, factor});
  }

  /// Multiplies by a factor that is positive everywhere.
  void add_rootless(const Rational& a, const Rational& c, int multiplicity) {
    multiply(quadratic_factor(a, -boost::multiprecision::abs(c) - Rational(1, 7)), multiplicity);
  }

  void negate() { polynomial_ = -polynomial_; }

 private:
  void multiply(const Polynomial& factor, int multiplicity) {
    for (int i = 0; i < multiplicity; ++i) polynomial_ = polynomial_ * factor;
  }
  void insert(Known_root root) {
    const auto place = std::find_if(roots_.begin(), roots_.end(),
                                    [&](const Known_root& r) { return r.value > root.value; });
    roots_.insert(place, std::move(root));
  }

  Polynomial polynomial_;
  std::vector<Known_root> roots_;
};

/// `root` of the square-free polynomial `p` as an algebraic number with an isolating interval of
/// random width. A rational root is not recognizable if the degree of `p` is more than 1.
/// Precondition: all multiplicities are 1.
inline Algebraic_number isolated_root(const Known_polynomial& p, const Known_root& root,
                                      Random& random) {
  // 2^-exponent is at most half the distance of the nearest other root.
  long exponent = 0;
  for (const Known_root& other : p.roots()) {
    if (other.value == root.value) continue;
    Big_float distance = root.value;
    mpfr_sub(distance.backend().data(), root.value.backend().data(), other.value.backend().data(),
             MPFR_RNDN);
    exponent = std::max(exponent, 2 - static_cast<long>(mpfr_get_exp(distance.backend().data())));
  }
  const auto radius = [&] {
    const long narrower = random.coin() ? 0 : random.integer(0, 100);
    const Rational scale = random.coin() ? Rational(1) : Rational(random.integer(5, 9), 10);
    return scaled_by_power_of_two(scale, -exponent - narrower);
  };
  // Fewer digits suffice, since the ends are far from the root.
  const Rational center = root.rational ? *root.rational : rounded(root.value, 2000);
  return Algebraic_number(square_free_part(p.polynomial()), center - radius(), center + radius());
}

/// Whether the number is the known one. For an irrational: the minimal polynomial divides the
/// number's, and the isolating interval contains the known value.
inline testing::AssertionResult is_the_number(const Algebraic_number& number,
                                              const Known_root& truth) {
  if (truth.rational) {
    if (compare(number, *truth.rational) == CGAL::EQUAL) return testing::AssertionSuccess();
    return testing::AssertionFailure() << number << " is not " << truth.rational->str();
  }
  const auto failure = [&](const char* reason) {
    return testing::AssertionFailure()
           << number << " is not the root of " << truth.minimal << " near "
           << mpfr_get_d(truth.value.backend().data(), MPFR_RNDN) << ": " << reason;
  };
  if (number.is_known_rational()) return failure("it is rational");
  if (!positive_pseudo_remainder(number.polynomial(), truth.minimal).is_zero()) {
    return failure("its polynomial has no such root");
  }
  const Polynomial& p = number.polynomial();
  if (p.sign_at(number.lower()) == CGAL::ZERO ||
      p.sign_at(number.lower()) != -p.sign_at(number.upper())) {
    return failure("its interval shows no change of sign");
  }
  if (mpfr_cmp_q(truth.value.backend().data(), number.lower().backend().data()) <= 0 ||
      mpfr_cmp_q(truth.value.backend().data(), number.upper().backend().data()) >= 0) {
    return failure("it is elsewhere");
  }
  return testing::AssertionSuccess();
}

/// Whether these are the known roots, in order and with their multiplicities.
inline testing::AssertionResult are_the_roots(const std::vector<Real_root>& found,
                                              const std::vector<Known_root>& truth) {
  if (found.size() != truth.size()) {
    return testing::AssertionFailure()
           << found.size() << " roots found, " << truth.size() << " expected";
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    const testing::AssertionResult same = is_the_number(found[i].value, truth[i]);
    if (!same) return same;
    if (found[i].multiplicity != truth[i].multiplicity) {
      return testing::AssertionFailure()
             << "multiplicity " << found[i].multiplicity << " of " << found[i].value
             << ", expected " << truth[i].multiplicity;
    }
  }
  return testing::AssertionSuccess();
}

/// A small integer that is not a square, so that its square root is irrational.
inline long random_non_square(Random& random) {
  static const std::vector<long> candidates = {2, 3, 5, 6, 7, 10, 11, 12, 13, 17, 18, 20, 23};
  return random.pick(candidates);
}

/// A polynomial of degree up to `max_degree` with random rational, irrational and complex roots of
/// random multiplicities up to `max_multiplicity`.
inline Known_polynomial random_known_polynomial(Random& random, int max_degree,
                                                int max_multiplicity) {
  Known_polynomial result(random.big_integer_not_zero(8));
  const long factors = random.integer(0, 5);
  for (long i = 0; i < factors; ++i) {
    const int multiplicity = static_cast<int>(random.integer(1, max_multiplicity));
    const int room = max_degree - result.degree();
    const Rational a = random.coin() ? Rational(random.integer(-3, 3)) : random.any_rational();
    const long kind = random.integer(0, 3);
    if (kind <= 1 && multiplicity <= room) {
      result.add_rational(a, multiplicity);
    } else if (kind == 2 && 2 * multiplicity <= room) {
      const Rational scale = random.coin() ? Rational(1) : random.rational(8) + Rational(1, 3);
      if (!scale.is_zero()) {
        result.add_irrational_pair(a, scale * scale * random_non_square(random), multiplicity);
      }
    } else if (kind == 3 && 2 * multiplicity <= room) {
      result.add_rootless(a, random.rational(8), multiplicity);
    }
  }
  return result;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_RANDOM_POLYNOMIALS_H
