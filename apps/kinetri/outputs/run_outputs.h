// SPDX-License-Identifier: GPL-3.0-or-later
//
// The output files and directories of a run.
#ifndef KINETRI_APPS_RUN_OUTPUTS_H
#define KINETRI_APPS_RUN_OUTPUTS_H

#include <algorithm>
#include <array>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "kinetri/impl/io/output_directory.h"
#include "kinetri/impl/io/output_file.h"
#include "outputs/output_table.h"

namespace kinetri {

struct Checkpoint_log;

}  // namespace kinetri

namespace kinetri::app {

/// Opens what has a path; what has none is null.
class Run_outputs {
 public:
  /// Paths of inputs may be empty. Throws Usage_error if two outputs, or an output and an input,
  /// are in each other's way; Output_error if one cannot be written.
  Run_outputs(const Output_paths& paths, const std::vector<std::string>& input_paths);

  Output_file* file(Output output) { return files_of_[static_cast<std::size_t>(output)]; }
  Output_directory* directory(Output output) {
    return directories_of_[static_cast<std::size_t>(output)];
  }
  bool has(Output output) { return file(output) != nullptr || directory(output) != nullptr; }
  /// Precondition: the output is an open file.
  std::ostream& stream(Output output) { return file(output)->stream(); }

  /// To be called when all of the output has been written, or when writing it has failed. Throws
  /// Output_error if it has failed; but if nobody reads standard output any more and there are
  /// other outputs, these are still worth the run.
  void finish(Output output) { finish(*file(output)); }

  /// What belongs to the checkpoint: the events, motions and edges that are files, which are then
  /// complete.
  std::vector<Checkpoint_log> finish_logs();

  /// All are complete before the first takes its place; the checkpoint is the last one. Throws
  /// Output_error.
  void commit();

  /// Whether one of them is standard output.
  bool has_standard_output() const {
    return std::ranges::find(files_, "-", &Output_file::path) != files_.end();
  }

  /// Whether nobody reads standard output any more. Known when all are complete.
  bool is_unread() const { return unread_.has_value(); }

  /// Throws Unread_output_error if nobody reads standard output any more.
  void expect_reader() const {
    if (unread_) throw Unread_output_error(*unread_);
  }

  /// What identifies the files (Output_file::identity).
  std::vector<std::string> identities() const;

  /// As given, for people.
  std::vector<std::string> paths() const;

 private:
  void open(const Output_row& row, const std::string& path);
  void finish(Output_file& file);
  bool is_unread(const Output_file& file) const { return is_unread() && file.path() == "-"; }
  void check_files(const std::vector<std::string>& input_paths) const;
  void check_directories() const;

  // Of the same length: what is open, and the option that named it.
  std::vector<Output_file> files_;
  std::vector<const char*> options_;
  std::vector<Output_directory> directories_;
  std::vector<const char*> directory_options_;
  std::array<Output_file*, number_of_outputs> files_of_ = {};
  std::array<Output_directory*, number_of_outputs> directories_of_ = {};
  std::optional<Unread_output_error> unread_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_OUTPUTS_H
