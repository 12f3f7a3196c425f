// SPDX-License-Identifier: GPL-3.0-or-later
//
// The result of the filter of certificates.
#ifndef KINETRI_SRC_KINETIC_FILTER_FILTER_RESULT_H
#define KINETRI_SRC_KINETIC_FILTER_FILTER_RESULT_H

#include <cstdint>

#include "kinetri/impl/base/double_interval.h"

namespace kinetri {

/// What the filter knows about a certificate from some time on.
struct Filter_result {
  enum class Kind : std::uint8_t {
    unknown,      ///< nothing is known
    never_fails,  ///< the certificate is positive
    holds,        ///< positive up to bounds.upper, which is bounds.lower
    fails,        ///< positive up to bounds.lower; then, up to bounds.upper, one simple root
  };
  Kind kind = Kind::unknown;    ///< how much is known
  Double_interval bounds = {};  ///< of `holds` and `fails`
  bool is_refined = false;      ///< by subdivision, or by narrowing a root
  bool may_be_zero = false;     ///< of contacts: the discs may touch or overlap at the start
};

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_FILTER_RESULT_H
