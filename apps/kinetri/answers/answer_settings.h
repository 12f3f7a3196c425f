// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the questions about a run are.
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

/// What is asked. A question without its output is not asked.
struct Answer_settings {
  std::size_t closest = 0;                               ///< how many closest approaches
  double range = 0;                                      ///< what is near: at most this far apart
  std::vector<std::array<std::string, 2>> between = {};  ///< who is to be connected, by name
  std::optional<double> ridge;  ///< of neighbors: shorter ridges are told apart
  std::optional<std::string> walkable = std::nullopt;  ///< the path of a file: where points can be
  std::optional<double> cutoff = std::nullopt;         ///< how far cells reach from their points
  /// What bounds cells: that, or what the input has. None as long as that is not read.
  std::shared_ptr<const Cell_limits> limits = nullptr;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_ANSWER_SETTINGS_H
