// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of answers.
#ifndef KINETRI_APPS_ANSWER_SETTINGS_H
#define KINETRI_APPS_ANSWER_SETTINGS_H

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kinetri {

struct Cell_limits;

}  // namespace kinetri

namespace kinetri::app {

/// Options of answers. They have no effect without the corresponding output.
struct Answer_settings {
  std::size_t closest = 0;  ///< number of closest approaches
  double range = 0;         ///< points at most this distance apart are near
  std::vector<std::array<std::string, 2>> between = {};  ///< pairs of names for --connected
  std::optional<double> ridge;                           ///< shorter ridges are marked
  std::optional<std::string> walkable = std::nullopt;  ///< path of the file with the walkable area
  std::optional<double> cutoff = std::nullopt;  ///< greatest distance of a cell from its point
  /// The bounds of cells, by `walkable`, `cutoff` or the input. Null until they are read.
  std::shared_ptr<const Cell_limits> limits = nullptr;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_ANSWER_SETTINGS_H
