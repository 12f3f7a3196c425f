// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/instant.h"

namespace kinetri {

Sign sign_at(const Polynomial& p, const Instant& instant) {
  switch (instant.side) {
    case Side::before:
      return sign_just_before(p, instant.time);
    case Side::at:
      return sign_at(p, instant.time);
    case Side::after:
      break;
  }
  return sign_just_after(p, instant.time);
}

}  // namespace kinetri
