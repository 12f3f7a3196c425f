// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/run_outputs.h"

#include <algorithm>
#include <filesystem>

#include "cli/arguments.h"
#include "cli/interrupt.h"
#include "kinetri/impl/io/checkpoint_logs.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/checkpoint_file.h"

namespace kinetri::app {
namespace {

// The outputs that a checkpoint lists: a resumed run continues them, and they do not depend on the
// machine.
constexpr std::array noted_outputs = {Output::events, Output::motions, Output::initial_edges,
                                      Output::edges};

}  // namespace

Run_outputs::Run_outputs(const Output_paths& paths, const std::vector<std::string>& input_paths) {
  // Pointers to elements must stay valid.
  files_.reserve(number_of_outputs);
  directories_.reserve(number_of_outputs);
  // Directories first: the temporary file of an output in a directory would make it nonempty.
  for (const bool opens_directories : {true, false}) {
    for (const Output_row& row : output_table) {
      const auto& path = paths[row.output];
      if (path && row.is_directory() == opens_directories) open(row, *path);
    }
  }
  check_files(input_paths);
  check_directories();
  if (!has(Output::checkpoint)) return;
  for (const Output log : noted_outputs) {
    if (has(log)) file(log)->keep_checksum();
  }
}

void Run_outputs::open(const Output_row& row, const std::string& path) {
  const auto index = static_cast<std::size_t>(row.output);
  if (row.is_directory()) {
    directory_options_.push_back(row.option);
    directories_of_[index] = &directories_.emplace_back(path);
  } else {
    options_.push_back(row.option);
    files_of_[index] = &files_.emplace_back(path);
  }
}

void Run_outputs::check_files(const std::vector<std::string>& input_paths) const {
  std::error_code ignored;
  std::vector<std::string> inputs;
  for (const std::string& path : input_paths) {
    inputs.push_back(std::filesystem::canonical(path, ignored).string());
  }
  for (std::size_t i = 0; i < files_.size(); ++i) {
    if (files_[i].identity().empty()) continue;
    if (std::ranges::find(inputs, files_[i].identity()) != inputs.end()) {
      throw Usage_error(
          joined(options_[i], ": ", files_[i].path(), " is the input; expected another file"));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (files_[i].identity() != files_[j].identity()) continue;
      throw Usage_error(joined(options_[j], " and ", options_[i], " name the same file, ",
                               files_[i].path(), "; expected different files"));
    }
  }
}

// No other output may be a directory of this run, or be in one.
void Run_outputs::check_directories() const {
  for (std::size_t i = 0; i < directories_.size(); ++i) {
    const auto check = [&](const char* option, const auto& other) {
      if (!(other.identity() + '/').starts_with(directories_[i].identity() + '/')) return;
      throw Usage_error(joined(option, ": ", other.path(), " is, or is in, the directory of ",
                               directory_options_[i], ", ", directories_[i].path(),
                               "; expected a path elsewhere"));
    };
    for (std::size_t j = 0; j < files_.size(); ++j) check(options_[j], files_[j]);
    for (std::size_t j = 0; j < directories_.size(); ++j) {
      if (j != i) check(directory_options_[j], directories_[j]);
    }
  }
}

void Run_outputs::finish(Output_file& file) {
  if (is_unread(file)) return;
  try {
    file.finish();
  } catch (const Unread_output_error& error) {
    if (files_.size() + directories_.size() == 1) throw;
    unread_ = error;
  }
}

std::vector<Checkpoint_log> Run_outputs::finish_logs() {
  std::vector<Checkpoint_log> result;
  for (const Output log : noted_outputs) {
    if (!has(log) || !file(log)->checksum()) continue;
    finish(log);
    const std::string option = output_table[static_cast<std::size_t>(log)].option;
    result.push_back(log_of(option.substr(2), *file(log), file(Output::checkpoint)->identity()));
  }
  return result;
}

void Run_outputs::commit() {
  for (Output_file& file : files_) finish(file);
  const Commit_section uninterrupted;
  for (Output_directory& directory : directories_) directory.commit();
  // The checkpoint last, so that it is never newer than the other outputs.
  Output_file* const checkpoint = file(Output::checkpoint);
  for (Output_file& file : files_) {
    if (&file != checkpoint && !is_unread(file)) file.commit();
  }
  if (checkpoint != nullptr && !is_unread(*checkpoint)) checkpoint->commit();
}

std::vector<std::string> Run_outputs::identities() const {
  std::vector<std::string> result;
  for (const Output_file& file : files_) result.push_back(file.identity());
  return result;
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
