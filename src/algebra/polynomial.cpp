// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polynomials with integer coefficients: arithmetic, signs and division. The inner loops call GMP
// directly, to work in place.
#include "kinetri/algebra/polynomial.h"

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <utility>

#include "gmp_access.h"
#include "kinetri/impl/base/check.h"

namespace kinetri {
namespace {

// A positive denominator d whose powers multiply the coefficients when a polynomial is evaluated
// without fractions. A power of two, as of a binary64 number, costs shifts only.
class Denominator {
 public:
  explicit Denominator(mpz_srcptr d)
      : is_power_of_two_(mpz_scan1(d, 0) + 1 == mpz_sizeinbase(d, 2)), shift_(mpz_scan1(d, 0)) {
    if (is_power_of_two_) return;
    mpz_set(raw(value_), d);
    power_ = 1;
  }

  // result += c * d^k; call it with k = 1, 2, 3, ... in this order.
  void add_scaled(Integer& result, const Integer& c, unsigned k) {
    if (is_power_of_two_) {
      mpz_mul_2exp(raw(power_), raw(c), shift_ * k);
      result += power_;
      return;
    }
    power_ *= value_;
    mpz_addmul(raw(result), raw(c), raw(power_));
  }

 private:
  bool is_power_of_two_;
  mp_bitcnt_t shift_;
  Integer value_;
  Integer power_;  // d^k, or a scratch value if d is a power of two
};

// d^n p(num / d), where n is the degree: an integer with the sign of p(num / d).
Integer homogeneous_value(std::span<const Integer> coefficients, const Rational& t) {
  mpz_srcptr numerator = mpq_numref(t.backend().data());
  Denominator denominator(mpq_denref(t.backend().data()));
  Integer result = coefficients.back();
  for (std::size_t i = coefficients.size() - 1; i-- > 0;) {
    mpz_mul(raw(result), raw(result), numerator);
    denominator.add_scaled(result, coefficients[i],
                           static_cast<unsigned>(coefficients.size() - 1 - i));
  }
  return result;
}

// [low, high] *= [a, b], with exact ends.
void multiply_interval(Integer& low, Integer& high, const Integer& a, const Integer& b) {
  if (a.sign() >= 0) {
    low *= low.sign() >= 0 ? a : b;
    high *= high.sign() >= 0 ? b : a;
  } else if (b.sign() <= 0) {
    Integer least = high * (high.sign() >= 0 ? a : b);
    high = low * (low.sign() >= 0 ? b : a);
    low = std::move(least);
  } else {
    Integer least = std::min(low * b, high * a);
    high = std::max(low * a, high * b);
    low = std::move(least);
  }
}

// The quotient of p's coefficients by a positive integer that divides them all.
void divide_exactly(std::vector<Integer>& coefficients, const Integer& divisor) {
  if (divisor == 1) return;
  for (Integer& c : coefficients) mpz_divexact(raw(c), raw(c), raw(divisor));
}

// --- Polynomials modulo a prime ---------------------------------------------------------------

// Below 2^32, so that a product of two residues fits a 64-bit word.
constexpr std::uint64_t prime = 4294967291U;

std::vector<std::uint64_t> residues(const Polynomial& p) {
  std::vector<std::uint64_t> result;
  result.reserve(p.coefficients().size());
  for (const Integer& c : p.coefficients()) result.push_back(mpz_fdiv_ui(raw(c), prime));
  return result;
}

void drop_zeros(std::vector<std::uint64_t>& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

// a becomes a multiple, by a unit, of its remainder modulo b.
void reduce(std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  while (a.size() >= b.size()) {
    const std::uint64_t minus_lead = prime - a.back();
    a.pop_back();
    for (std::uint64_t& c : a) c = c * b.back() % prime;
    const std::size_t shift = a.size() + 1 - b.size();
    for (std::size_t i = 0; i + 1 < b.size(); ++i) {
      a[shift + i] = (a[shift + i] + minus_lead * b[i] % prime) % prime;
    }
    drop_zeros(a);
  }
}

// If true, a and b have no common factor. The leading coefficient of a common factor g of positive
// degree divides those of a and b; if one of these does not vanish modulo the prime, g keeps its
// degree modulo the prime, and divides both images.
bool certainly_coprime(const Polynomial& a, const Polynomial& b) {
  std::vector<std::uint64_t> x = residues(a);
  std::vector<std::uint64_t> y = residues(b);
  if (x.back() == 0 && y.back() == 0) return false;
  drop_zeros(x);
  drop_zeros(y);
  if (x.size() < y.size()) std::swap(x, y);
  while (!y.empty()) {
    reduce(x, y);
    std::swap(x, y);
  }
  return x.size() == 1;
}

}  // namespace

// --- The class --------------------------------------------------------------------------------

Polynomial::Polynomial(std::vector<Integer> coefficients) : coefficients_(std::move(coefficients)) {
  drop_leading_zeros();
}

Polynomial::Polynomial(std::initializer_list<Integer> coefficients) : coefficients_(coefficients) {
  drop_leading_zeros();
}

void Polynomial::drop_leading_zeros() {
  while (!coefficients_.empty() && coefficients_.back().is_zero()) coefficients_.pop_back();
}

Rational Polynomial::operator()(const Rational& t) const {
  if (is_zero()) return 0;
  const Integer scale = boost::multiprecision::pow(boost::multiprecision::denominator(t),
                                                   static_cast<unsigned>(degree()));
  return Rational(homogeneous_value(coefficients_, t), scale);
}

Sign Polynomial::sign_at(const Rational& t) const {
  if (is_zero()) return CGAL::ZERO;
  if (degree() == 0 || t.is_zero()) return sign(coefficients_.front());
  return sign(homogeneous_value(coefficients_, t));
}

std::optional<Sign> Polynomial::sign_on(const Rational& lower, const Rational& upper) const {
  KINETRI_PRECONDITION(lower <= upper, "the ends of the interval are not in order");
  if (is_zero()) return CGAL::ZERO;

  // Both ends over one denominator, a / d and b / d.
  Integer d;
  mpz_lcm(raw(d), mpq_denref(lower.backend().data()), mpq_denref(upper.backend().data()));
  Integer a;
  Integer b;
  mpz_divexact(raw(a), raw(d), mpq_denref(lower.backend().data()));
  mpz_mul(raw(a), raw(a), mpq_numref(lower.backend().data()));
  mpz_divexact(raw(b), raw(d), mpq_denref(upper.backend().data()));
  mpz_mul(raw(b), raw(b), mpq_numref(upper.backend().data()));

  Denominator denominator(raw(d));
  Integer low = coefficients_.back();
  Integer high = low;
  Integer term;
  for (std::size_t i = coefficients_.size() - 1; i-- > 0;) {
    multiply_interval(low, high, a, b);
    term = 0;
    denominator.add_scaled(term, coefficients_[i],
                           static_cast<unsigned>(coefficients_.size() - 1 - i));
    low += term;
    high += term;
  }
  if (low.sign() > 0) return CGAL::POSITIVE;
  if (high.sign() < 0) return CGAL::NEGATIVE;
  return std::nullopt;
}

Sign Polynomial::sign_at_plus_infinity() const {
  return is_zero() ? CGAL::ZERO : sign(coefficients_.back());
}

Sign Polynomial::sign_at_minus_infinity() const {
  const Sign at_plus_infinity = sign_at_plus_infinity();
  return degree() % 2 == 0 ? at_plus_infinity : -at_plus_infinity;
}

Polynomial& Polynomial::operator+=(const Polynomial& other) {
  if (other.degree() > degree()) coefficients_.resize(other.coefficients_.size());
  for (std::size_t i = 0; i < other.coefficients_.size(); ++i) {
    coefficients_[i] += other.coefficients_[i];
  }
  drop_leading_zeros();
  return *this;
}

Polynomial& Polynomial::operator-=(const Polynomial& other) {
  if (other.degree() > degree()) coefficients_.resize(other.coefficients_.size());
  for (std::size_t i = 0; i < other.coefficients_.size(); ++i) {
    coefficients_[i] -= other.coefficients_[i];
  }
  drop_leading_zeros();
  return *this;
}

Polynomial& Polynomial::operator*=(const Integer& factor) {
  if (factor.is_zero()) {
    coefficients_.clear();
    return *this;
  }
  // The factor may be one of the coefficients.
  const Integer copy = factor;  // NOLINT(performance-unnecessary-copy-initialization)
  for (Integer& c : coefficients_) c *= copy;
  return *this;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Integer> product(a.coefficients_.size() + b.coefficients_.size() - 1);
  for (std::size_t i = 0; i < a.coefficients_.size(); ++i) {
    for (std::size_t j = 0; j < b.coefficients_.size(); ++j) {
      mpz_addmul(raw(product[i + j]), raw(a.coefficients_[i]), raw(b.coefficients_[j]));
    }
  }
  return Polynomial(std::move(product));
}

Polynomial operator-(Polynomial a) {
  for (Integer& c : a.coefficients_) mpz_neg(raw(c), raw(c));
  return a;
}

std::ostream& operator<<(std::ostream& out, const Polynomial& p) {
  if (p.is_zero()) return out << "0";
  for (int i = p.degree(); i >= 0; --i) {
    const Integer& c = p[i];
    if (c.is_zero()) continue;
    if (i == p.degree()) {
      if (c.sign() < 0) out << '-';
    } else {
      out << (c.sign() < 0 ? " - " : " + ");
    }
    const Integer magnitude = boost::multiprecision::abs(c);
    if (i == 0 || magnitude != 1) out << magnitude.str();
    if (i > 0 && magnitude != 1) out << '*';
    if (i > 0) out << 't';
    if (i > 1) out << '^' << i;
  }
  return out;
}

// --- Primitive polynomials --------------------------------------------------------------------

Polynomial primitive_polynomial(std::span<const Rational> coefficients) {
  Integer common = 1;
  for (const Rational& c : coefficients) {
    mpz_lcm(raw(common), raw(common), mpq_denref(c.backend().data()));
  }
  std::vector<Integer> integers(coefficients.size());
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    mpz_divexact(raw(integers[i]), raw(common), mpq_denref(coefficients[i].backend().data()));
    mpz_mul(raw(integers[i]), raw(integers[i]), mpq_numref(coefficients[i].backend().data()));
  }
  return primitive_part(Polynomial(std::move(integers)));
}

Polynomial derivative(const Polynomial& p) {
  if (p.degree() < 1) return {};
  std::vector<Integer> result(static_cast<std::size_t>(p.degree()));
  for (std::size_t i = 0; i < result.size(); ++i) {
    mpz_mul_ui(raw(result[i]), raw(p.coefficients()[i + 1]), i + 1);
  }
  return Polynomial(std::move(result));
}

Integer content(const Polynomial& p) {
  Integer result;
  for (const Integer& c : p.coefficients()) {
    mpz_gcd(raw(result), raw(result), raw(c));
    if (result == 1) break;
  }
  return result;
}

Polynomial primitive_part(Polynomial p) {
  if (p.is_zero()) return p;
  divide_exactly(p.coefficients_, content(p));
  return p;
}

// --- Division ---------------------------------------------------------------------------------

Polynomial positive_pseudo_remainder(const Polynomial& a, const Polynomial& b) {
  KINETRI_PRECONDITION(!b.is_zero(), "the divisor is zero");
  const std::size_t n = b.coefficients().size() - 1;
  const Integer multiplier = boost::multiprecision::abs(b.leading_coefficient());
  const bool negate = b.leading_coefficient().sign() < 0;

  std::vector<Integer> r(a.coefficients().begin(), a.coefficients().end());
  while (r.size() > n) {
    Integer top = std::move(r.back());
    r.pop_back();
    if (top.is_zero()) continue;
    if (negate) mpz_neg(raw(top), raw(top));
    // r = |lead b| r - sign(lead b) top t^k b: the leading terms cancel, and the multiplier of r is
    // positive whatever the signs.
    if (multiplier != 1) {
      for (Integer& c : r) c *= multiplier;
    }
    for (std::size_t i = 0; i < n; ++i) {
      mpz_submul(raw(r[r.size() - n + i]), raw(top), raw(b.coefficients()[i]));
    }
  }
  return Polynomial(std::move(r));
}

Polynomial exact_quotient(const Polynomial& a, const Polynomial& b) {
  KINETRI_PRECONDITION(!b.is_zero(), "the divisor is zero");
  if (a.is_zero()) return {};
  KINETRI_PRECONDITION(a.degree() >= b.degree(), "the divisor leaves a remainder");
  const std::size_t n = b.coefficients().size() - 1;

  std::vector<Integer> r(a.coefficients().begin(), a.coefficients().end());
  std::vector<Integer> quotient(r.size() - n);
  for (std::size_t k = quotient.size(); k-- > 0;) {
    mpz_divexact(raw(quotient[k]), raw(r[k + n]), raw(b.leading_coefficient()));
    for (std::size_t i = 0; i <= n; ++i) {
      mpz_submul(raw(r[k + i]), raw(quotient[k]), raw(b.coefficients()[i]));
    }
  }
  KINETRI_PRECONDITION(
      std::all_of(r.begin(), r.end(), [](const Integer& c) { return c.is_zero(); }),
      "the divisor leaves a remainder");
  return Polynomial(std::move(quotient));
}

Polynomial gcd(const Polynomial& a, const Polynomial& b) {
  if (!a.is_zero() && !b.is_zero() && certainly_coprime(a, b)) return Polynomial{1};
  Polynomial x = primitive_part(a);
  Polynomial y = primitive_part(b);
  if (x.degree() < y.degree()) std::swap(x, y);
  while (!y.is_zero()) {
    if (y.degree() == 0) return Polynomial{1};
    Polynomial remainder = primitive_part(positive_pseudo_remainder(x, y));
    x = std::move(y);
    y = std::move(remainder);
  }
  if (!x.is_zero() && x.leading_coefficient().sign() < 0) x = -std::move(x);
  return x;
}

}  // namespace kinetri
