// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs other programs, and passes them temporary files without names.
#ifndef KINETRI_APPS_CHILD_PROCESS_H
#define KINETRI_APPS_CHILD_PROCESS_H

#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kinetri::app {

struct File_closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// A file without a name, which is deleted when it is closed, however the process ends.
using Nameless_file = std::unique_ptr<std::FILE, File_closer>;

/// Makes one, for reading and writing. Throws Output_error.
Nameless_file nameless_file();

/// A path by which this process, and a child that inherits the file, can open it from its
/// beginning.
std::string path_of(const Nameless_file& file);

/// Runs the program, given by a path or found in PATH, until it ends. `streams`: the descriptors
/// for its standard input, output and error. It inherits all nameless files. A signal that ends
/// this process ends it too. Returns the status from waitpid; none if it cannot be run.
std::optional<int> run_child(const std::string& program, std::vector<std::string> arguments,
                             const std::array<int, 3>& streams);

/// The whole content of the file.
std::string content(const Nameless_file& file);

/// The result of a program that reads a text and writes one.
struct Tool_result {
  bool has_run = false;  ///< false if it cannot be run; the rest is then undefined
  int status = 0;        ///< from waitpid; 0: success
  std::string out;       ///< what it wrote to standard output
  std::string err;       ///< and to standard error

  bool succeeded() const { return has_run && status == 0; }
  /// Its error output without line ends at the end, for a message.
  std::string says() const { return err.substr(0, err.find_last_not_of('\n') + 1); }
};

/// Runs the program with the text as its standard input. Throws Output_error.
Tool_result run_tool(const std::string& program, std::vector<std::string> arguments,
                     const std::string& input);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_CHILD_PROCESS_H
