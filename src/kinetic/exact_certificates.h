// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificates by exact arithmetic: for linear motion by Sturm counts with numbers on the stack
// (count_failure.h); if these do not decide, and for other motions, by general algebraic numbers.
#ifndef KINETRI_SRC_KINETIC_EXACT_CERTIFICATES_H
#define KINETRI_SRC_KINETIC_EXACT_CERTIFICATES_H

#include <optional>

#include "algebra/count_failure.h"
#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/polynomial.h"
#include "kinetri/kinetic/certificate.h"

namespace kinetri {

/// The certificate that fails at `failure`; never, if it is empty.
Certificate exact_certificate(std::optional<Algebraic_number> failure, bool is_root_solved);

/// @{ The certificate p >= 0 from t on. counted_certificate returns nothing if Sturm counts do not
/// decide; if it does, p nowhere becomes zero without changing its sign.
Certificate exact_certificate(const Polynomial& p, const Algebraic_number& t);
std::optional<Certificate> counted_certificate(const Narrow_polynomial& p,
                                               const Algebraic_number& t, Certificate_state state);
/// @}

/// The certificate p >= 0 from t on, with Certificate::failure if it fails.
std::optional<Certificate> counted_certificate_with_time(const Narrow_polynomial& p,
                                                         const Algebraic_number& t);

/// The certificate p > 0 strictly after t, given that p is not negative just after t and not zero.
Certificate exact_root_certificate(const Polynomial& p, const Algebraic_number& t);

/// The certificate p > 0 strictly after t, and p >= 0 just after t: a touch is a failure too. The
/// zero polynomial never fails. By Sturm counts, use counted_certificate.
Certificate exact_touch_certificate(const Polynomial& p, const Algebraic_number& t);

/// @{
/// The certificate p > 0 at t and after it.
Certificate exact_apart_certificate(const Polynomial& p, const Algebraic_number& t);
std::optional<Certificate> counted_apart_certificate(const Narrow_polynomial& p,
                                                     const Algebraic_number& t);
/// @}

/// @{ The certificate that fails at the first time from t on at which the distance p is not
/// positive and decreases.
Certificate exact_contact_certificate(const Polynomial& p, const Algebraic_number& t);
std::optional<Certificate> counted_contact_certificate(const Narrow_polynomial& p,
                                                       const Algebraic_number& t);
/// @}

/// The first time strictly after t at which both coordinates of a difference, and the difference of
/// the weights, are zero.
std::optional<Algebraic_number> coincidence_time(const Polynomial& x, const Polynomial& y,
                                                 const Polynomial& weight,
                                                 const Algebraic_number& t);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_EXACT_CERTIFICATES_H
