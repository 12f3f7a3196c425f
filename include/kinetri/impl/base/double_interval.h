// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed interval between binary64 bounds. It is in the lowest layer so that headers that need
// only bounds do not include the exact number types.
#ifndef KINETRI_IMPL_BASE_DOUBLE_INTERVAL_H
#define KINETRI_IMPL_BASE_DOUBLE_INTERVAL_H

#include "kinetri/base/platform.h"

namespace kinetri {

/// A closed interval of real numbers between binary64 bounds, either of which may be infinite.
struct Double_interval {
  double lower = 0;  ///< at most `upper`
  double upper = 0;  ///< at least `lower`; both bounds belong to the interval

  friend bool operator==(const Double_interval&, const Double_interval&) = default;
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_BASE_DOUBLE_INTERVAL_H
