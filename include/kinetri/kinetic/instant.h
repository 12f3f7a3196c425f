// SPDX-License-Identifier: GPL-3.0-or-later
//
// An instant: a time and a side of it. "Just after t" means: throughout some open interval that
// begins at t. A structure that is right just after t is right until its next certificate fails.
#ifndef KINETRI_KINETIC_INSTANT_H
#define KINETRI_KINETIC_INSTANT_H

#include "kinetri/algebra/algebraic_number.h"

namespace kinetri {

/// A side of a time, or the time itself.
enum class Time_side {
  before,  ///< throughout some open interval that ends at the time
  at,      ///< at the time
  after,   ///< throughout some open interval that begins at the time
};

/// A time, and on which side of it.
struct Instant {
  Algebraic_number time;           ///< exact
  Time_side side = Time_side::at;  ///< of the time
};

/// The sign of `p` at the instant. Exact. On one side of a root it is the sign of the first
/// derivative that does not vanish; zero there only for the zero polynomial.
Sign sign_at(const Polynomial& p, const Instant& instant);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_INSTANT_H
