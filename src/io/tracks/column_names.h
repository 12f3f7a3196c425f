// SPDX-License-Identifier: GPL-3.0-or-later
//
// The names of columns of a table in Track_columns.
#ifndef KINETRI_SRC_IO_TRACKS_COLUMN_NAMES_H
#define KINETRI_SRC_IO_TRACKS_COLUMN_NAMES_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinetri/impl/io/parse_number.h"

namespace kinetri {

/// The index of the column whose number is the name; none if it is not a number.
inline std::optional<std::size_t> column_number(const std::string& name) {
  constexpr std::size_t most_digits = 7;
  if (name.empty() || name.size() > most_digits || name.front() == '0') return std::nullopt;
  if (name.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  return static_cast<std::size_t>(parse_number(name).value) - 1;
}

/// The parts of a name between plus signs.
inline std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> result;
  for (std::string_view rest = name;;) {
    const std::size_t plus = rest.find('+');
    result.emplace_back(rest.substr(0, plus));
    if (result.back().empty()) return {name};
    if (plus == std::string_view::npos) return result;
    rest.remove_prefix(plus + 1);
  }
}

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_COLUMN_NAMES_H
