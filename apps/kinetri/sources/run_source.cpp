// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/run_source.h"

#include <charconv>
#include <filesystem>

#include "kinetri/impl/io/text.h"
#include "kinetri/io/viewer_page.h"

namespace kinetri::app {

std::string input_name(const std::string& path) {
  return path == "-" ? "standard input" : path;
}

std::string title_of(const std::string& path) {
  return path == "-" ? input_name(path) : std::filesystem::path(path).filename().string();
}

std::string Run_source::title() const {
  return title_of(path());
}

std::vector<Point_id> Run_source::points_named(const std::string& name) const {
  Point_id id = no_point;
  const char* const end = name.data() + name.size();
  const auto [rest, problem] = std::from_chars(name.data(), end, id);
  if (problem != std::errc() || rest != end) return {};
  return {id};
}

Input_error Run_source::coincidence(const Coincident_trajectories_error& error, double time) const {
  return Input_error(
      path().empty() ? title() : input_name(path()), 0,
      joined("at t = ", time, " a contact leaves points ", error.first(), " and ", error.second(),
             " with the same position and velocity; expected trajectories that stay distinct"));
}

void Run_source::describe(Viewer_settings& settings) const {
  settings.title = title();
  settings.names = labels();
}

}  // namespace kinetri::app
