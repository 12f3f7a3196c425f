// SPDX-License-Identifier: GPL-3.0-or-later
//
// Integers of bounded width without allocation, for the exact stage of certificates; GMP's own
// integers are used only if these are too narrow.
#ifndef KINETRI_SRC_ALGEBRA_STACK_INTEGER_H
#define KINETRI_SRC_ALGEBRA_STACK_INTEGER_H

#include <gmp.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "gmp_access.h"
#include "kinetri/algebra/number_types.h"
#include "kinetri/impl/base/check.h"

namespace kinetri {

/// An integer of at most `Limbs` times 64 bits: sign and magnitude, in words of GMP. Precondition
/// of each operation, asserted: the result fits. Callers use a bound of the bits
/// (`Static_sturm_sequence::bits_needed`).
template <std::size_t Limbs>
class Stack_integer {
  static constexpr int word_bits = GMP_NUMB_BITS;
  static_assert(word_bits == 64 || word_bits == 32);
  static constexpr std::size_t most_words = Limbs * (64 / word_bits);

 public:
  /// The most binary digits.
  static constexpr long capacity = static_cast<long>(64 * Limbs);

  Stack_integer() noexcept = default;  ///< zero
  // NOLINTNEXTLINE(google-explicit-constructor): factors are written 2
  Stack_integer(std::int64_t x) noexcept {
    auto magnitude = x < 0 ? -static_cast<std::uint64_t>(x) : static_cast<std::uint64_t>(x);
    while (magnitude != 0) {
      words_[size_++] = static_cast<mp_limb_t>(magnitude);
      magnitude = word_bits == 64 ? 0 : magnitude >> 32;
    }
    if (x < 0) size_ = -size_;
  }
  explicit Stack_integer(const Integer& x) : size_(static_cast<int>(mpz_size(raw(x)))) {
    reserve(size_);
    mpn_copyi(words_, mpz_limbs_read(raw(x)), size_);
    if (x.sign() < 0) size_ = -size_;
  }
  /// A narrower number.
  template <std::size_t Fewer>
  requires(Fewer < Limbs) explicit Stack_integer(const Stack_integer<Fewer>& x) noexcept
      : size_(x.size_) {
    copy(x);
  }
  Stack_integer(const Stack_integer& x) noexcept : size_(x.size_) { copy(x); }
  Stack_integer& operator=(const Stack_integer& x) noexcept {
    if (this == &x) return *this;
    size_ = x.size_;
    copy(x);
    return *this;
  }
  ~Stack_integer() = default;

  explicit operator Integer() const {
    Integer result;
    mpz_t view;
    mpz_set(raw(result), mpz_roinit_n(view, words_, size_));
    return result;
  }

  int sign() const { return (size_ > 0) - (size_ < 0); }
  bool is_zero() const { return size_ == 0; }  ///< whether it is 0
  /// The number of binary digits of the absolute value; 0 for 0.
  long bit_length() const {
    const int n = count();
    return n == 0 ? 0 : static_cast<long>(word_bits) * n - std::countl_zero(words_[n - 1]);
  }

  /// The number as m * 2^exponent, where m is the result: rounded with an error less than two units
  /// in the last place.
  double approximation(long& exponent) const {
    // The words that have the first 64 digits, at least.
    constexpr int words = 64 / word_bits + 1;
    const int last = std::max(count() - words, 0);
    exponent = static_cast<long>(word_bits) * last;
    double result = 0;
    for (int i = count() - 1; i >= last; --i) {
      result = result * (word_bits == 64 ? 0x1p64 : 0x1p32) + static_cast<double>(words_[i]);
    }
    return size_ < 0 ? -result : result;
  }

  Stack_integer& operator+=(const Stack_integer& x) { return add(x, x.size_); }
  Stack_integer& operator-=(const Stack_integer& x) { return add(x, -x.size_); }
  friend Stack_integer operator+(Stack_integer a, const Stack_integer& b) {
    a += b;
    return a;
  }
  friend Stack_integer operator-(Stack_integer a, const Stack_integer& b) {
    a -= b;
    return a;
  }
  friend Stack_integer operator-(Stack_integer a) {
    a.size_ = -a.size_;
    return a;
  }
  friend Stack_integer operator*(const Stack_integer& a, const Stack_integer& b) {
    Stack_integer result;
    const Stack_integer* x = &a;
    const Stack_integer* y = &b;
    if (x->count() < y->count()) std::swap(x, y);
    const int m = x->count();
    const int n = y->count();
    if (n == 0) return result;
    reserve(m + n);
    mp_limb_t high;
#ifdef __SIZEOF_INT128__
    if (word_bits == 64 && m == 2 && n == 2) {
      // For so few words GMP's functions are several times slower.
      high = multiply_pairs(x->words_, y->words_, result.words_);
    } else
#endif
        if (n == 1) {
      high = result.words_[m] = mpn_mul_1(result.words_, x->words_, m, y->words_[0]);
    } else {
      high = mpn_mul(result.words_, x->words_, m, y->words_, n);
    }
    result.size_ = m + n - (high == 0 ? 1 : 0);
    if ((a.size_ < 0) != (b.size_ < 0)) result.size_ = -result.size_;
    return result;
  }
  /// Times 2^bits.
  friend Stack_integer operator<<(const Stack_integer& a, unsigned long bits) {
    Stack_integer result;
    const int n = a.count();
    if (n == 0) return result;
    const int whole = static_cast<int>(bits / word_bits);
    const auto rest = static_cast<unsigned>(bits % word_bits);
    reserve(n + whole);
    mpn_zero(result.words_, whole);
    int size = n + whole;
    if (rest == 0) {
      mpn_copyi(result.words_ + whole, a.words_, n);
    } else {
      const mp_limb_t carry = mpn_lshift(result.words_ + whole, a.words_, n, rest);
      if (carry != 0) {
        reserve(size + 1);
        result.words_[size++] = carry;
      }
    }
    result.size_ = a.size_ < 0 ? -size : size;
    return result;
  }

 private:
  template <std::size_t Other>
  friend class Stack_integer;

  int count() const {
    return size_ < 0 ? -size_ : size_;
  }
  static void reserve([[maybe_unused]] int words) {
    KINETRI_ASSERT(words <= static_cast<int>(most_words), "an integer is wider than its bound");
  }
  template <std::size_t Other>
  void copy(const Stack_integer<Other>& x) {
    for (int i = 0, n = count(); i < n; ++i) words_[i] = x.words_[i];
  }

#ifdef __SIZEOF_INT128__
  // The product of numbers of two words of 64 bits; its highest word.
  static mp_limb_t multiply_pairs(const mp_limb_t* x, const mp_limb_t* y, mp_limb_t* result) {
    __extension__ using Pair = unsigned __int128;
    const Pair low = static_cast<Pair>(x[0]) * y[0];
    const Pair high = static_cast<Pair>(x[1]) * y[1];
    const Pair middle = static_cast<Pair>(x[0]) * y[1] + static_cast<std::uint64_t>(low >> 64);
    const Pair other = static_cast<Pair>(x[1]) * y[0] + static_cast<std::uint64_t>(middle);
    const Pair top =
        high + static_cast<std::uint64_t>(middle >> 64) + static_cast<std::uint64_t>(other >> 64);
    result[0] = static_cast<mp_limb_t>(low);
    result[1] = static_cast<mp_limb_t>(other);
    result[2] = static_cast<mp_limb_t>(top);
    result[3] = static_cast<mp_limb_t>(top >> 64);
    return result[3];
  }
#endif

  // Adds x, where the sign of x is that of `size_of_x`.
  Stack_integer& add(const Stack_integer& x, int size_of_x) {
    const int m = count();
    const int n = x.count();
    if (n == 0) return *this;
    int size = std::max(m, n);
    bool is_negative = size_ < 0;
    if (m == 0) {
      is_negative = size_of_x < 0;
      size_ = n;
      copy(x);
    } else if (is_negative == (size_of_x < 0)) {
      const mp_limb_t carry = m >= n ? mpn_add(words_, words_, m, x.words_, n)
                                     : mpn_add(words_, x.words_, n, words_, m);
      if (carry != 0) {
        reserve(size + 1);
        words_[size++] = carry;
      }
    } else {
      if (m > n || (m == n && mpn_cmp(words_, x.words_, m) >= 0)) {
        mpn_sub(words_, words_, m, x.words_, n);
      } else {
        mpn_sub(words_, x.words_, n, words_, m);
        is_negative = !is_negative;
      }
      while (size > 0 && words_[size - 1] == 0) --size;
    }
    size_ = is_negative ? -size : size;
    return *this;
  }

  int size_ = 0;                 // as many words are in use; negative for a negative number
  mp_limb_t words_[most_words];  // NOLINT(modernize-avoid-c-arrays): those not in use have no value
};

template <std::size_t Limbs>
Sign sign(const Stack_integer<Limbs>& x) {
  return static_cast<Sign>(x.sign());
}
template <std::size_t Limbs>
long bit_length(const Stack_integer<Limbs>& x) {
  return x.bit_length();
}

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_STACK_INTEGER_H
