// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order numbers of binary64 numbers.
#ifndef KINETRI_SRC_ALGEBRA_BINARY64_ORDINAL_H
#define KINETRI_SRC_ALGEBRA_BINARY64_ORDINAL_H

#include <bit>
#include <cstdint>
#include <limits>

namespace kinetri {

/// The position of the number: neighbors differ by one, both zeros are 0.
inline std::int64_t ordinal(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits;
}

inline double from_ordinal(std::int64_t n) {
  return std::bit_cast<double>(n >= 0 ? n : std::numeric_limits<std::int64_t>::min() - n);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_BINARY64_ORDINAL_H
