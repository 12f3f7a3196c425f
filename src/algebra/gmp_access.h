// SPDX-License-Identifier: GPL-3.0-or-later
//
// The GMP numbers inside the algebra's integers, for inner loops that work in place.
#ifndef KINETRI_SRC_ALGEBRA_GMP_ACCESS_H
#define KINETRI_SRC_ALGEBRA_GMP_ACCESS_H

#include "kinetri/algebra/number_types.h"
#include "kinetri/algebra/polynomial.h"

namespace kinetri {

inline mpz_ptr raw(Integer& x) {
  return x.backend().data();
}
inline mpz_srcptr raw(const Integer& x) {
  return x.backend().data();
}

/// The number of binary digits of |x|; 0 for 0.
inline long bit_length(mpz_srcptr x) {
  return mpz_sgn(x) == 0 ? 0 : static_cast<long>(mpz_sizeinbase(x, 2));
}
inline long bit_length(const Integer& x) {
  return bit_length(raw(x));
}

/// Whether p is q or -q, without making -q.
inline bool equal_up_to_sign(const Polynomial& p, const Polynomial& q) {
  if (p.degree() != q.degree()) return false;
  if (p == q) return true;
  for (int i = p.degree(); i >= 0; --i) {
    if (mpz_cmpabs(raw(p[i]), raw(q[i])) != 0 || p[i].sign() != -q[i].sign()) return false;
  }
  return true;
}

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_GMP_ACCESS_H
