// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/run_outputs.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/arguments.h"

namespace kinetri::app {

Run_outputs::Run_outputs(const Run_settings& settings, const std::string& input_path) {
  // First, as the temporary of a file would be found in a directory.
  directories_.reserve(2);
  frames = open_directory("--frames", settings.frames.svg);
  vtu = open_directory("--vtu", settings.frames.vtu);
  files_.reserve(9);
  events = open("--events", settings.events);
  initial_edges = open("--initial-edges", settings.initial_edges);
  edges = open("--edges", settings.edges);
  stats = open("--stats", settings.stats);
  points = open("--ids", settings.points);
  checkpoint = open("--checkpoint", settings.checkpoint);
  html = open("--html", settings.html);
  plot = open("--plot", settings.plot);
  if (settings.closest > 0) closest = open("--closest", "-");
  check_files(input_path);
  check_directories();
}

Output_file* Run_outputs::open(std::string_view option, const std::optional<std::string>& path) {
  if (!path) return nullptr;
  options_.push_back(option);
  return &files_.emplace_back(*path);
}

Output_directory* Run_outputs::open_directory(std::string_view option,
                                              const std::optional<std::string>& path) {
  if (!path) return nullptr;
  directory_options_.push_back(option);
  return &directories_.emplace_back(*path);
}

void Run_outputs::check_files(const std::string& input_path) const {
  std::error_code ignored;
  const std::string input = std::filesystem::canonical(input_path, ignored).string();
  for (std::size_t i = 0; i < files_.size(); ++i) {
    if (files_[i].identity().empty()) continue;
    if (files_[i].identity() == input) {
      throw Usage_error(
          fmt::format("{}: {} is the input; expected another file", options_[i], files_[i].path()));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (files_[i].identity() != files_[j].identity()) continue;
      throw Usage_error(fmt::format("{} and {} name the same file, {}; expected different files",
                                    options_[j], options_[i], files_[i].path()));
    }
  }
}

// Nothing else may be written into a directory, or be it.
void Run_outputs::check_directories() const {
  for (std::size_t i = 0; i < directories_.size(); ++i) {
    const auto check = [&](std::string_view option, const auto& other) {
      if (!(other.identity() + '/').starts_with(directories_[i].identity() + '/')) return;
      throw Usage_error(
          fmt::format("{}: {} is, or is in, the directory of {}, {}; expected a path elsewhere",
                      option, other.path(), directory_options_[i], directories_[i].path()));
    };
    for (std::size_t j = 0; j < files_.size(); ++j) check(options_[j], files_[j]);
    for (std::size_t j = 0; j < directories_.size(); ++j) {
      if (j != i) check(directory_options_[j], directories_[j]);
    }
  }
}

void Run_outputs::commit() {
  for (Output_file& file : files_) file.finish();
  for (Output_directory& directory : directories_) directory.commit();
  for (Output_file& file : files_) file.commit();
}

std::vector<std::string> Run_outputs::paths() const {
  std::vector<std::string> result;
  for (const Output_file& file : files_) {
    result.push_back(file.path() == "-" ? "standard output" : file.path());
  }
  for (const Output_directory& directory : directories_) result.push_back(directory.path());
  return result;
}

}  // namespace kinetri::app
