// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an algebraic number that is not a binary64 number is known by: a rational, or a square-free
// polynomial and an isolating interval. It changes while the number stays the same;
// algebraic_number.h says how threads share it. An isolating interval has dyadic ends over a common
// power of two, so that refinement and evaluation work on integers alone.
#ifndef KINETRI_SRC_ALGEBRA_REPRESENTATION_H
#define KINETRI_SRC_ALGEBRA_REPRESENTATION_H

#include <mutex>
#include <optional>

#include "kinetri/algebra/algebraic_number.h"

namespace kinetri {

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

/// Its member functions are called by one thread at a time: the one that has an Access to it.
struct Root_source::Representation {
  explicit Representation(Rational number) : lower(std::move(number)) {}
  Representation(const Polynomial& p, const Rational& first, const Rational& last) {
    isolate(p, first, last);
  }

  bool is_rational() const { return !isolation; }
  const Polynomial& polynomial();
  const Rational& lower_end();
  const Rational& upper_end();
  Double_interval double_interval();

  // representation.cpp
  void isolate(const Polynomial& p, const Rational& first, const Rational& last);
  void isolate_between_dyadic_ends(const Rational& first, const Rational& last);
  void become_rational(Rational number);
  void use_factor(Polynomial factor);
  void set_ends(Integer a, Integer b, unsigned long e);
  void narrow_to(const Rational& m, Sign side);

  // refine_algebraic_number.cpp
  void quadratic_step(unsigned long k_max);
  void halve();
  void refine_to(const Rational& width);
  void refine_to_bits(long bits);

  // round_algebraic_number.cpp
  Double_interval tight_interval();

  // compare_algebraic_numbers.cpp
  Comparison_result compare_with(const Rational& m);
  static bool changes_sign_over_intersection(const Polynomial& p, Representation& x,
                                             Representation& y);
  static Comparison_result compare(Representation& x, Representation& y);
  static Comparison_result compare_roots_of_one_polynomial(Representation& x, Representation& y);
  static bool are_equal(Representation& x, Representation& y);

  // sign_at_algebraic_number.cpp
  bool is_root_of(const Polynomial& p);
  Sign sign_of(const Polynomial& p);
  std::optional<Sign> sign_of_own_polynomial_beside(const Polynomial& p, Sign side);

  std::mutex mutex;
  std::optional<Isolation> isolation;  // none where the number is known to be rational
  // The number itself where it is known to be rational; else the ends of the isolation, made when
  // they are asked for.
  Rational lower;
  Rational upper;
  bool ends_are_current = false;
  bool bounds_are_published = false;
  Polynomial own_polynomial;
  bool linear_is_made = false;  // own_polynomial is that of a number known to be rational
};

/// A representation that no other thread uses as long as this object is there. At its end the
/// binary64 bounds of the number are published, if they have changed.
class Root_source::Access {
 public:
  Access(Root_source& source, Representation& representation)
      : source_(source), representation_(representation), lock_(representation.mutex) {}
  /// Access that is yet to be given, by std::lock.
  Access(Root_source& source, Representation& representation, std::defer_lock_t defer)
      : source_(source), representation_(representation), lock_(representation.mutex, defer) {}
  ~Access();
  Access(const Access&) = delete;
  Access& operator=(const Access&) = delete;

  /// @{
  /// What std::lock asks for.
  void lock() { lock_.lock(); }
  bool try_lock() { return lock_.try_lock(); }
  void unlock() { lock_.unlock(); }
  /// @}

  Representation& operator*() const { return representation_; }
  Representation* operator->() const { return &representation_; }

 private:
  Root_source& source_;
  Representation& representation_;
  std::unique_lock<std::mutex> lock_;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_REPRESENTATION_H
