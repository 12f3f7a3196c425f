// SPDX-License-Identifier: GPL-3.0-or-later
//
// The representation of an algebraic number that is not a binary64 number: a rational, or a
// square-free polynomial and an isolating interval; algebraic_number.h says how threads share it.
// The ends of the interval are dyadic, over a common power of two, so that refinement and
// evaluation use integers only.
#ifndef KINETRI_SRC_ALGEBRA_REPRESENTATION_H
#define KINETRI_SRC_ALGEBRA_REPRESENTATION_H

#include <mutex>
#include <optional>

#include "kinetri/algebra/algebraic_number.h"

namespace kinetri::detail {

/// The result of a comparison from its sign.
inline Comparison_result comparison(int order) {
  return static_cast<Comparison_result>(order < 0 ? -1 : order > 0 ? 1 : 0);
}

/// The isolating interval from a / 2^e to b / 2^e. Invariant: a < b, the polynomial has opposite
/// signs, not zero, at the two ends, exactly one root between them, and zero is not strictly
/// between them.
struct Isolation {
  Integer a;
  Integer b;
  unsigned long e = 0;
  // 2^(e n) times the values of the polynomial, of degree n, at the ends.
  Integer value_a;
  Integer value_b;
  // The next quadratic step divides the interval into 2^k parts.
  unsigned long k = 2;

  bool is_narrower_than_bits(long bits) const;
};

/// Only the thread that has a Root_access may call member functions.
struct Root_representation {
  explicit Root_representation(Rational number) : lower(std::move(number)) {}
  Root_representation(const Polynomial& p, const Rational& first, const Rational& last) {
    isolate(p, first, last);
  }

  bool is_rational() const { return !isolation; }
  const Polynomial& polynomial();
  const Rational& lower_end();
  const Rational& upper_end();
  Double_interval double_interval();

  void isolate(const Polynomial& p, const Rational& first, const Rational& last);
  void isolate_between_dyadic_ends(const Rational& first, const Rational& last);
  void become_rational(Rational number);
  void use_factor(Polynomial factor);
  void set_ends(Integer a, Integer b, unsigned long e);
  void narrow_to(const Rational& m, Sign side);

  void quadratic_step(unsigned long k_max);
  void halve();
  void refine_to(const Rational& width);
  void refine_to_bits(long bits);

  Double_interval tight_interval();

  Comparison_result compare_with(const Rational& m);
  static bool changes_sign_over_intersection(const Polynomial& p, Root_representation& x,
                                             Root_representation& y);
  static Comparison_result compare(Root_representation& x, Root_representation& y);
  static Comparison_result compare_roots_of_one_polynomial(Root_representation& x,
                                                           Root_representation& y);
  static bool are_equal(Root_representation& x, Root_representation& y);

  // Signs of polynomials at the number and beside it.
  bool is_root_of(const Polynomial& p);
  Sign sign_of(const Polynomial& p);
  std::optional<Sign> sign_of_own_polynomial_beside(const Polynomial& p, Sign side);

  std::mutex mutex;
  std::optional<Isolation> isolation;  // empty if the number is known to be rational
  // The number itself if it is known to be rational; else the ends of the isolation, computed on
  // demand.
  Rational lower;
  Rational upper;
  bool ends_are_current = false;
  bool bounds_are_published = false;
  Polynomial own_polynomial;
  bool linear_is_made = false;  // own_polynomial is that of a number known to be rational
};

/// Exclusive access to a representation. The destructor publishes the binary64 bounds of the
/// number, if they have changed.
class Root_access {
 public:
  Root_access(Shared_bounds& bounds, Root_representation& representation)
      : bounds_(bounds), representation_(representation), lock_(representation.mutex) {}
  /// Access that std::lock grants.
  Root_access(Shared_bounds& bounds, Root_representation& representation, std::defer_lock_t defer)
      : bounds_(bounds), representation_(representation), lock_(representation.mutex, defer) {}
  ~Root_access();
  Root_access(const Root_access&) = delete;
  Root_access& operator=(const Root_access&) = delete;

  /// @{
  /// As std::lock requires.
  void lock() { lock_.lock(); }
  bool try_lock() { return lock_.try_lock(); }
  void unlock() { lock_.unlock(); }
  /// @}

  Root_representation& operator*() const { return representation_; }
  Root_representation* operator->() const { return &representation_; }

 private:
  Shared_bounds& bounds_;
  Root_representation& representation_;
  std::unique_lock<std::mutex> lock_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_ALGEBRA_REPRESENTATION_H
