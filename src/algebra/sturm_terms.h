// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last terms of the Sturm sequences of cubics and quartics in closed form: those of the signed
// remainder sequence, up to a factor with the sign of the leading coefficient (MATH.md, section 3).
// For exact integers and for approximate numbers alike: a Number has +, - and *, also by an int.
#ifndef KINETRI_SRC_ALGEBRA_STURM_TERMS_H
#define KINETRI_SRC_ALGEBRA_STURM_TERMS_H

namespace kinetri {

/// For f = b t^3 + c t^2 + d t + e:
///     p = c^2 - 3 b d     q = c d - 9 b e     S1 = 2 p t + q     S0 = 4 p (d^2 - 3 c e) - q^2
/// These are identities: -rem(f, f') = S1 / (9 b), and, if p is not zero, -rem(f', S1) =
/// (3 b / (4 p^2)) S0.
template <class Number>
struct Sturm_terms_of_cubic {
  template <class Polynomial>
  explicit Sturm_terms_of_cubic(const Polynomial& f)
      : p(f[2] * f[2] - f[3] * f[1] * 3), q(f[2] * f[1] - f[3] * f[0] * 9) {}

  /// S0.
  template <class Polynomial>
  Number s0(const Polynomial& f) const {
    return p * (f[1] * f[1] - f[2] * f[0] * 3) * 4 - q * q;
  }

  Number p;  ///< half of the slope of S1
  Number q;  ///< the value of S1 at zero
};

/// For f = a t^4 + b t^3 + c t^2 + d t + e:
///     P = 3 b^2 - 8 a c     Q = 2 b c - 12 a d     R = b d - 16 a e
///     I = 12 a e - 3 b d + c^2     J = c (72 a e + 9 b d - 2 c^2) - 27 (a d^2 + e b^2)
///     S2 = P t^2 + Q t + R     S1 = 2 (P I + 2 a J) t + (I Q + b J)     S0 = 4 I^3 - J^2
/// These are identities: -rem(f, f') = S2 / (16 a), -rem(f', S2) = (16 a / (3 P^2)) S1, and, if S1
/// has degree 1, -rem(S2, S1) = (P^2 / (12 (P I + 2 a J)^2)) S0.
template <class Number>
struct Sturm_terms_of_quartic {
  template <class Polynomial>
  explicit Sturm_terms_of_quartic(const Polynomial& f)
      : p(f[3] * f[3] * 3 - f[4] * f[2] * 8),
        q(f[3] * f[2] * 2 - f[4] * f[1] * 12),
        ae(f[4] * f[0]),
        bd(f[3] * f[1]),
        r(bd - ae * 16) {}

  /// S1, the value at zero and the slope, and S0.
  struct Last {
    Number i;        ///< I
    Number j;        ///< J
    Number at_zero;  ///< I Q + b J
    Number slope;    ///< 2 (P I + 2 a J)

    Number s0() const { return i * i * i * 4 - j * j; }  ///< S0
  };
  template <class Polynomial>
  Last last(const Polynomial& f) const {
    const Number cc = f[2] * f[2];
    const Number i = ae * 12 - bd * 3 + cc;
    const Number j =
        f[2] * (ae * 72 + bd * 9 - cc * 2) - (f[4] * f[1] * f[1] + f[0] * f[3] * f[3]) * 27;
    return {i, j, i * q + f[3] * j, (p * i + f[4] * j * 2) * 2};
  }

  Number p;   ///< P
  Number q;   ///< Q
  Number ae;  ///< a e
  Number bd;  ///< b d
  Number r;   ///< R
};

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_STURM_TERMS_H
