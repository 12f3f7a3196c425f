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

/// Opens all outputs that have a path; the others are null.
class Run_outputs {
 public:
  /// Paths of inputs may be empty. Throws Usage_error if two outputs, or an output and an input,
  /// are the same file, or one is in a directory of another; Output_error if one cannot be written.
  Run_outputs(const Output_paths& paths, const std::vector<std::string>& input_paths);

  Output_file* file(Output output) { return files_of_[static_cast<std::size_t>(output)]; }
  Output_directory* directory(Output output) {
    return directories_of_[static_cast<std::size_t>(output)];
  }
  bool has(Output output) { return file(output) != nullptr || directory(output) != nullptr; }
  /// Precondition: the output is an open file.
  std::ostream& stream(Output output) { return file(output)->stream(); }

  /// Must be called when all of the output has been written, or writing it has failed. Throws
  /// Output_error if it has failed, except if standard output is a closed pipe and there are other
  /// outputs.
  void finish(Output output) { finish(*file(output)); }

  /// Completes the events, motions and edges that are files, and returns the records of them for
  /// the checkpoint.
  std::vector<Checkpoint_log> finish_logs();

  /// Completes all outputs, then moves them into place, the checkpoint last. Throws Output_error.
  void commit();

  /// Whether one of them is standard output.
  bool has_standard_output() const {
    return std::ranges::find(files_, "-", &Output_file::path) != files_.end();
  }

  /// Whether standard output is a closed pipe. Known when all outputs are complete.
  bool is_unread() const { return unread_.has_value(); }

  /// Throws Unread_output_error if standard output is a closed pipe.
  void expect_reader() const {
    if (unread_) throw Unread_output_error(*unread_);
  }

  /// The identities of the files (Output_file::identity).
  std::vector<std::string> identities() const;

  /// The paths as given.
  std::vector<std::string> paths() const;

 private:
  void open(const Output_row& row, const std::string& path);
  void finish(Output_file& file);
  bool is_unread(const Output_file& file) const { return is_unread() && file.path() == "-"; }
  void check_files(const std::vector<std::string>& input_paths) const;
  void check_directories() const;

  // The open files, and the option of each.
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
