// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real algebraic numbers: a square-free polynomial and an interval that holds exactly one of its
// roots; rationals are kept as such. All decisions are exact; the binary64 interval of each number
// decides most comparisons; only if two of them overlap are the isolating intervals refined.
//
// Several threads may share a number. An Algebraic_number is a handle: it holds a binary64 interval
// and refers to a Root_source, which its copies share. Const functions change the Root_source only:
//   - The representation (polynomial and isolating interval) is made once, when it is first needed.
//     A thread that reads or refines it holds its mutex.
//   - Binary64 bounds of the number are atomic, read without a lock, and only ever move toward the
//     number. Hence a lower and an upper bound that were published at different times enclose it
//     too.
//   - Numbers that were found equal share an identity, an atomic number that is never reused. Hence
//     two numbers with the same identity are equal.
// So nearly every comparison, since intervals or identities decide it, takes no lock.
#ifndef KINETRI_ALGEBRA_ALGEBRAIC_NUMBER_H
#define KINETRI_ALGEBRA_ALGEBRAIC_NUMBER_H

#include <algorithm>
#include <atomic>
#include <cmath>
#include <compare>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <memory>
#include <optional>

#include "kinetri/algebra/polynomial.h"
#include "kinetri/impl/base/check.h"

namespace kinetri {

/// A number, rounded.
struct Rounding {
  double nearest = 0;      ///< the nearest binary64 number, ties to even
  Double_interval bounds;  ///< enclose the number: each is `nearest` or a binary64 neighbor of it
};

namespace detail {

struct Root_representation;
class Root_access;

/// Binary64 bounds of one number, for several threads. Invariant: they enclose the number, and only
/// ever move toward it.
class Shared_bounds {
 public:
  /// @{
  /// A thread that reads a bound of the representation also sees the representation (acquire).
  double lower() const { return lower_.load(std::memory_order_acquire); }
  double upper() const { return upper_.load(std::memory_order_acquire); }
  /// @}
  /// Takes each bound that is tighter.
  void narrow(const Double_interval& interval);

 private:
  std::atomic<double> lower_ = -std::numeric_limits<double>::infinity();
  std::atomic<double> upper_ = std::numeric_limits<double>::infinity();
};

}  // namespace detail

/// The polynomial of which a number is a root. It is only made when it is needed: if binary64
/// intervals decide all comparisons, never. Each object belongs to one number. Several threads may
/// call the functions at once.
class Root_source {
 public:
  virtual ~Root_source();
  Root_source(const Root_source&) = delete;
  Root_source& operator=(const Root_source&) = delete;

  /// A polynomial of which the number is a root; not zero.
  virtual Polynomial polynomial() const = 0;

  /// An approximation of the value of that polynomial, or of a positive multiple of it, at
  /// high + low. Its sign is certainly that of the value. Zero if that sign is not known without
  /// making the polynomial. Used to round the number.
  virtual double certain_value_at(double high, double low) const;

  /// The number rounded, given that it is strictly between the bounds of `bracket`, which are
  /// finite. None if that is not certain without making the polynomial. The number is strictly
  /// between the bounds of the result, each of which is `nearest` or a neighbor of it.
  virtual std::optional<Rounding> rounded(const Double_interval& bracket) const;

 protected:
  Root_source();

 private:
  friend class Algebraic_number;

  static void share_identity(Root_source& a, Root_source& b);

  detail::Shared_bounds bounds_;
  std::atomic<detail::Root_representation*> representation_ = nullptr;  // owned
  std::atomic<std::uint64_t> identity_ = 0;                             // 0: none yet
};

/// An interval of rational numbers: a single number, or an open interval.
struct Rational_interval {
  Rational lower;  ///< at most `upper`
  Rational upper;  ///< at least `lower`

  /// Whether it is a single number.
  bool is_point() const { return lower == upper; }
};

/// A real algebraic number. Copies share one representation, and so each refinement. The value
/// never changes; only the interval around it shrinks. Several threads may call const functions of
/// one number, or of copies of it, at once.
class Algebraic_number {
 public:
  /// Zero.
  Algebraic_number() = default;
  /// A binary64 number, taken exactly. Precondition: finite.
  // NOLINTNEXTLINE(google-explicit-constructor): times are written 10.0
  Algebraic_number(double value) {
    KINETRI_PRECONDITION(std::isfinite(value), "an infinity or a NaN is no number");
    const double bound = value == 0 ? 0 : value;  // the one zero
    bounds_ = {bound, bound};
  }
  /// A rational number, exactly.
  Algebraic_number(const Rational& value);  // NOLINT(google-explicit-constructor)

  /// The only root of `p` between `lower` and `upper`, ends not included.
  /// Precondition: `p` is square-free and has opposite signs, not zero, at the two ends (checked),
  /// and exactly one root between them (not checked).
  Algebraic_number(const Polynomial& p, const Rational& lower, const Rational& upper);

  /// The only root of the polynomial of `source` between the bounds of `bracket`, ends not
  /// included. Precondition: the polynomial has opposite signs, not zero, at the two ends (checked
  /// when it is made), and exactly one root between them, of odd multiplicity (not checked).
  Algebraic_number(std::shared_ptr<Root_source> source, const Double_interval& bracket);

  /// The same number with its own representation, so that threads that refine it do not wait for
  /// each other.
  Algebraic_number detached() const;

  /// The negative of the number. Makes the polynomial of the number if it has not been made.
  Algebraic_number operator-() const;

  /// Whether the number is *known* to be rational: constructed as one, or found to be one while it
  /// was refined. If false, the number may still be rational.
  bool is_known_rational() const;
  /// The number itself. Precondition: is_known_rational().
  Rational rational() const;

  /// A square-free primitive polynomial of which this number is a root. A comparison may replace it
  /// by one of lower degree.
  Polynomial polynomial() const;

  /// The present isolating interval: the number alone if that is known to be rational, else
  /// lower < number < upper, and polynomial() has opposite signs, not zero, at the two. Zero is
  /// never inside.
  Rational_interval isolating_interval() const;
  /// @{
  /// The ends of the present isolating interval. It may shrink between the two calls.
  Rational lower() const { return isolating_interval().lower; }
  Rational upper() const { return isolating_interval().upper; }
  /// @}

  /// A binary64 interval that contains the number: the outward rounding of the isolating interval,
  /// or, if the polynomial has not been made, a bracket.
  Double_interval interval() const {
    if (source_ == nullptr) return bounds_;
    return {std::max(bounds_.lower, source_->bounds_.lower()),
            std::min(bounds_.upper, source_->bounds_.upper())};
  }

  /// The tightest binary64 interval that contains the number: both bounds are the number if it
  /// is a binary64 number, else its two neighbors. Does not depend on how far the number was
  /// refined.
  Double_interval tight_interval() const;

  /// The nearest binary64 number, ties to even.
  double to_double() const;

  /// Makes the isolating interval at most `width` wide. Precondition: width > 0. Quadratic interval
  /// refinement: about log log(1/width) evaluations beyond the first few.
  /// Source: J. Abbott, Quadratic interval refinement for real roots, ISSAC 2006 (poster).
  void refine_to(const Rational& width) const;

  /// Refines until the width of the isolating interval is at most 2^-`bits` times the absolute
  /// value of its end nearer to zero: `bits` bits of the number are known, however small it is.
  void refine_to_bits(unsigned bits) const;

  /// Makes the isolating interval at least two times narrower.
  void refine() const;

  /// Whether `p` vanishes at the number. Exact, by the gcd of `p` and polynomial().
  bool is_root_of(const Polynomial& p) const;

  /// @{
  /// Exact comparison, a total order of the reals: first by the binary64 intervals, then by those
  /// of the numbers rounded, if sources know these, then by refinement. Equal roots of different
  /// polynomials are recognized by the gcd of the polynomials.
  friend Comparison_result compare(const Algebraic_number& a, const Algebraic_number& b);
  friend Comparison_result compare(const Algebraic_number& a, const Rational& b);
  friend std::strong_ordering operator<=>(const Algebraic_number& a, const Algebraic_number& b);
  friend bool operator==(const Algebraic_number& a, const Algebraic_number& b);
  /// @}

  /// Human-readable: the rational, or `root of P in (lower, upper)` with binary64 bounds.
  friend std::ostream& operator<<(std::ostream& out, const Algebraic_number& a);

  /// @{
  /// See below.
  friend Sign sign_at(const Polynomial& p, const Algebraic_number& t);
  friend Sign sign_just_before(const Polynomial& p, const Algebraic_number& t);
  friend Sign sign_just_after(const Polynomial& p, const Algebraic_number& t);
  /// @}

 private:
  using Representation = detail::Root_representation;
  using Access = detail::Root_access;

  bool is_binary64() const { return source_ == nullptr; }
  Rational binary64_value() const { return to_rational(bounds_.lower); }
  void adopt(std::unique_ptr<Representation> representation);
  Representation& representation() const;
  Access access() const;
  static Comparison_result compare_exactly(const Algebraic_number& a, const Algebraic_number& b);
  Sign sign_beside(const Polynomial& p, Sign side) const;
  void narrow_by_source() const;
  std::optional<Double_interval> tighten_by_source() const;

  // Contains the number; the source may know tighter bounds.
  Double_interval bounds_;
  // Null for a binary64 number, which bounds_ holds.
  std::shared_ptr<Root_source> source_;
};

/// Exact comparison of two numbers, the same as the operators of Algebraic_number.
Comparison_result compare(const Algebraic_number& a, const Algebraic_number& b);
/// Exact comparison of a number with a rational number.
Comparison_result compare(const Algebraic_number& a, const Rational& b);

/// The sign of `p` at the number `t`. Exact. Cost: an evaluation on the isolating interval, if
/// that decides; else refinements of `t`, and a gcd if `p` is, or nearly is, zero there.
Sign sign_at(const Polynomial& p, const Algebraic_number& t);

/// @{
/// The sign of `p` in a sufficiently small open interval that ends, or begins, at `t`: the sign of
/// the first derivative that does not vanish at `t`, negated for just before if its order is odd.
/// Zero for the zero polynomial only. Exact. Cost: one sign_at for each of these derivatives.
Sign sign_just_before(const Polynomial& p, const Algebraic_number& t);
Sign sign_just_after(const Polynomial& p, const Algebraic_number& t);
/// @}

/// The same number for every representation of `a` and `b`: the dyadic rational k / 2^e strictly
/// between them with the least e (e may be negative) and, for that e, the least |k|.
/// Precondition: a < b.
Rational simplest_between(const Algebraic_number& a, const Algebraic_number& b);

}  // namespace kinetri

#endif  // KINETRI_ALGEBRA_ALGEBRAIC_NUMBER_H
