// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sturm sequences in binary64, with signs that are certain or unknown.
#ifndef KINETRI_SRC_KINETIC_FILTER_APPROXIMATE_STURM_SEQUENCE_H
#define KINETRI_SRC_KINETIC_FILTER_APPROXIMATE_STURM_SEQUENCE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "algebra/sturm_terms.h"
#include "approximate_number.h"
#include "error_bounds.h"
#include "kinetri/impl/algebra/sign.h"

namespace kinetri {

/// The Sturm sequence of all polynomials of degree M - 1, 2 to 4, whose coefficients differ from
/// given ones by at most `error` each: known signs hold for all of them. Rounding errors:
/// docs/MATH.md, section 7.
template <std::size_t M>
class Approximate_sturm_sequence {
  static_assert(M >= 3 && M <= 5);

 public:
  /// By ascending power. Cost: some 17 products of Approximate_number.
  Approximate_sturm_sequence(const std::array<double, M>& coefficients, double error) {
    double size = 0;
    for (const double c : coefficients) size = std::max(size, std::abs(c));
    // Scaled so that coefficients are at most 1 and errors do not underflow.
    const Approximate_number scale = {1 / size, 0};
    const double least_error = std::max(error, unit_roundoff * size);
    auto& f = terms_[0];
    for (std::size_t i = 0; i < M; ++i)
      f[i] = Approximate_number{coefficients[i], least_error} * scale;
    for (std::size_t i = 1; i < M; ++i) terms_[1][i - 1] = f[i] * static_cast<int>(i);
    add_last_terms();
  }

  /// Whether all these polynomials have degree M - 1, no multiple root, and equal leading signs.
  bool is_certain() const {
    for (std::size_t k = 0; k < M; ++k) {
      if (certain_sign(terms_[k][M - 1 - k]) == CGAL::ZERO) return false;
    }
    return true;
  }

  /// V(w), the number of sign changes at w; none if a sign is not certain. Preconditions:
  /// `is_certain`; 0 <= w <= 1.
  std::optional<int> changes_at(double w) const {
    Changes changes(leading_sign());
    for (std::size_t k = 0; k < M; ++k) {
      const auto& term = terms_[k];
      Approximate_number value = term[M - 1 - k];
      for (std::size_t i = M - 1 - k; i-- > 0;) value = value * Approximate_number{w, 0} + term[i];
      if (!changes.add(k, certain_sign(value))) return std::nullopt;
    }
    return changes.number;
  }
  /// The same at zero.
  std::optional<int> changes_at_zero() const {
    Changes changes(leading_sign());
    for (std::size_t k = 0; k < M; ++k) {
      if (!changes.add(k, certain_sign(terms_[k][0]))) return std::nullopt;
    }
    return changes.number;
  }
  /// V(infinity). Precondition: `is_certain`.
  int changes_at_infinity() const {
    Changes changes(leading_sign());
    for (std::size_t k = 0; k < M; ++k) changes.add(k, certain_sign(terms_[k][M - 1 - k]));
    return changes.number;
  }

 private:
  struct Changes {
    explicit Changes(Sign leading_sign) : of_last_terms(leading_sign) {}
    // Adds the sign of the k-th term. Returns whether it is certain.
    bool add(std::size_t k, Sign sign) {
      // The closed forms of the last terms lack the sign of the leading coefficient.
      if (k >= 2) sign = sign * of_last_terms;
      if (k > 0 && sign == -previous) ++number;
      previous = sign;
      return sign != CGAL::ZERO;
    }

    Sign of_last_terms;
    Sign previous = CGAL::ZERO;
    int number = 0;
  };

  Sign leading_sign() const { return certain_sign(terms_[0][M - 1]); }

  void add_last_terms() {
    const auto& f = terms_[0];
    if constexpr (M == 3) {
      terms_[2][0] = f[1] * f[1] - f[2] * f[0] * 4;
    } else if constexpr (M == 4) {
      const Sturm_terms_of_cubic<Approximate_number> terms(f);
      terms_[2][0] = terms.q;
      terms_[2][1] = terms.p * 2;
      terms_[3][0] = terms.s0(f);
    } else {
      const Sturm_terms_of_quartic<Approximate_number> terms(f);
      const auto last = terms.last(f);
      terms_[2][0] = terms.r;
      terms_[2][1] = terms.q;
      terms_[2][2] = terms.p;
      terms_[3][0] = last.at_zero;
      terms_[3][1] = last.slope;
      terms_[4][0] = last.s0();
    }
  }

  // Of degrees M - 1, M - 2, ...
  std::array<std::array<Approximate_number, M>, M> terms_;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_APPROXIMATE_STURM_SEQUENCE_H
