// SPDX-License-Identifier: GPL-3.0-or-later
//
// An instant: a time and a side of it. "Just after t" means: throughout some open interval that
// begins at t. A structure that is right just after t is right until its next certificate fails.
#ifndef KINETRI_KINETIC_INSTANT_H
#define KINETRI_KINETIC_INSTANT_H

#include "kinetri/algebra/algebraic_number.h"

namespace kinetri {

enum class Side { before, at, after };

struct Instant {
  Algebraic_number time;
  Side side = Side::at;
};

/// The sign of `p` at the instant. Exact. On one side of a root it is the sign of the first
/// derivative that does not vanish; zero there only for the zero polynomial.
Sign sign_at(const Polynomial& p, const Instant& instant);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_INSTANT_H
