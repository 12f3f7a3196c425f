// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers in messages.
#ifndef KINETRI_SRC_SIMULATION_SHORTEST_TEXT_H
#define KINETRI_SRC_SIMULATION_SHORTEST_TEXT_H

#include <array>
#include <charconv>
#include <string>

#include "kinetri/algebra/algebraic_number.h"

namespace kinetri::detail {

/// The shortest text that reads back as `x`.
inline std::string text(double x) {
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
  return std::string(buffer.data(), end);
}
/// The same for the binary64 number nearest to `x`.
inline std::string text(const Algebraic_number& x) {
  return text(x.to_double());
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_SHORTEST_TEXT_H
