// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/instant.h"

namespace kinetri {

Sign sign_at(const Polynomial& p, const Instant& instant) {
  switch (instant.side) {
    case Time_side::before:
      return sign_just_before(p, instant.time);
    case Time_side::at:
      return sign_at(p, instant.time);
    case Time_side::after:
      break;
  }
  return sign_just_after(p, instant.time);
}

}  // namespace kinetri
