// SPDX-License-Identifier: GPL-3.0-or-later
//
// The signs of polynomials at algebraic numbers and beside them.
#include <optional>

#include "gmp_access.h"
#include "kinetri/algebra/algebraic_number.h"
#include "representation.h"

namespace kinetri {

// The gcd has the number as a root where it changes sign over the isolating interval: as a divisor
// of polynomial() it has no other root there, and a simple one only.
bool Root_source::Representation::is_root_of(const Polynomial& p) {
  if (p.is_zero()) return true;
  if (is_rational()) return p.sign_at(lower) == CGAL::ZERO;
  if (equal_up_to_sign(p, own_polynomial)) return true;
  Polynomial common = gcd(p, own_polynomial);
  if (common.degree() == 0) return false;
  if (common.sign_at(lower_end()) == common.sign_at(upper_end())) return false;
  use_factor(std::move(common));
  return true;
}

Sign Root_source::Representation::sign_of(const Polynomial& p) {
  if (!is_rational() && equal_up_to_sign(p, own_polynomial)) return CGAL::ZERO;
  for (long bits = 0;; bits = bits == 0 ? 24 : 2 * bits) {
    if (bits != 0) refine_to_bits(bits);
    if (is_rational()) return p.sign_at(lower);
    if (const std::optional<Sign> s = p.sign_on(lower_end(), upper_end())) return *s;
    // Tested once, between 24 bits and 48: nearly all that is not zero has been told by then.
    if (bits == 24 && is_root_of(p)) return CGAL::ZERO;
  }
}

// The end of the isolating interval on that side is as good as beside the number where p has no
// other root up to it. So it is after a flip, where p is minus the polynomial that made the number.
std::optional<Sign> Root_source::Representation::sign_of_own_polynomial_beside(const Polynomial& p,
                                                                               Sign side) {
  if (is_rational() || !equal_up_to_sign(p, own_polynomial)) return std::nullopt;
  return p.sign_at(side == CGAL::POSITIVE ? upper_end() : lower_end());
}

bool Algebraic_number::is_root_of(const Polynomial& p) const {
  if (is_binary64()) return p.is_zero() || p.sign_at(binary64_value()) == CGAL::ZERO;
  return access()->is_root_of(p);
}

Sign sign_at(const Polynomial& p, const Algebraic_number& t) {
  if (p.degree() <= 0) return p.sign_at(0);
  if (t.is_binary64()) return p.sign_at(t.binary64_value());
  return t.access()->sign_of(p);
}

// The sign beside the number, on the side towards which odd powers have the sign `side`.
Sign Algebraic_number::sign_beside(const Polynomial& p, Sign side) const {
  if (!is_binary64()) {
    if (const auto s = access()->sign_of_own_polynomial_beside(p, side)) return *s;
  }
  Polynomial q = p;
  for (Sign factor = CGAL::POSITIVE; !q.is_zero(); factor = factor * side) {
    const Sign s = sign_at(q, *this);
    if (s != CGAL::ZERO) return s * factor;
    q = derivative(q);
  }
  return CGAL::ZERO;
}

Sign sign_just_before(const Polynomial& p, const Algebraic_number& t) {
  return t.sign_beside(p, CGAL::NEGATIVE);
}

Sign sign_just_after(const Polynomial& p, const Algebraic_number& t) {
  return t.sign_beside(p, CGAL::POSITIVE);
}

}  // namespace kinetri
