// SPDX-License-Identifier: GPL-3.0-or-later
//
// Isolation of real roots by Descartes' rule of signs, after Vincent, Collins and Akritas.
#ifndef KINETRI_SRC_ALGEBRA_ROOT_ISOLATION_H
#define KINETRI_SRC_ALGEBRA_ROOT_ISOLATION_H

#include <cstddef>
#include <limits>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/polynomial.h"

namespace kinetri {

/// The roots of `q` greater than `from` in ascending order; of more than `most` only the first
/// ones. Precondition: `q` is square-free.
///
/// Cost, with the degree n: n^2 additions, and as many multiplications by an end, for each interval
/// that is examined. Their number hardly depends on the magnitudes and distances of the roots.
std::vector<Algebraic_number> roots_beyond(
    const Polynomial& q, const Rational& from,
    std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_ROOT_ISOLATION_H
