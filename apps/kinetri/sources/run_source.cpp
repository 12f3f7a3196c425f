// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/run_source.h"

#include <fmt/format.h>

#include <filesystem>

namespace kinetri::app {

std::string input_name(const std::string& path) {
  return path == "-" ? "standard input" : path;
}

std::string Run_source::title() const {
  return path() == "-" ? input_name(path()) : std::filesystem::path(path()).filename().string();
}

Input_error Run_source::coincidence(const Coincident_trajectories_error& error, double time) const {
  return Input_error(
      path().empty() ? title() : input_name(path()), 0,
      fmt::format("at t = {} a contact leaves points {} and {} in one place with one velocity; "
                  "expected trajectories that stay distinct",
                  time, error.first(), error.second()));
}

}  // namespace kinetri::app
