// SPDX-License-Identifier: GPL-3.0-or-later
//
// The output files and directories of a run.
#ifndef KINETRI_APPS_RUN_OUTPUTS_H
#define KINETRI_APPS_RUN_OUTPUTS_H

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/output_directory.h"
#include "io/output_file.h"
#include "runs/simulation_run.h"

namespace kinetri::app {

/// Opens what the settings name; what they do not is null.
class Run_outputs {
 public:
  /// `input_path` may be empty. Throws Usage_error if two outputs, or an output and the input, are
  /// in each other's way; Output_error if one cannot be written.
  Run_outputs(const Run_settings& settings, const std::string& input_path);

  Output_file* events;
  Output_file* initial_edges;
  Output_file* edges;
  Output_file* stats;
  Output_file* points;
  Output_file* checkpoint;
  Output_file* html;
  Output_file* plot;
  Output_file* closest = nullptr;
  Output_directory* frames;
  Output_directory* vtu;

  /// All are complete before the first takes its place. Throws Output_error.
  void commit();

  /// As given, for people.
  std::vector<std::string> paths() const;

 private:
  Output_file* open(std::string_view option, const std::optional<std::string>& path);
  Output_directory* open_directory(std::string_view option, const std::optional<std::string>& path);
  void check_files(const std::string& input_path) const;
  void check_directories() const;

  std::vector<Output_file> files_;
  std::vector<std::string_view> options_;  // that named them
  std::vector<Output_directory> directories_;
  std::vector<std::string_view> directory_options_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_OUTPUTS_H
