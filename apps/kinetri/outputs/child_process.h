// SPDX-License-Identifier: GPL-3.0-or-later
//
// Other programs that this one runs, and files without a name that go to them and come from them.
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

/// A file without a name, which is gone when it is closed, however the process ends.
using Nameless_file = std::unique_ptr<std::FILE, File_closer>;

/// Makes one, for reading and writing. Throws Output_error.
Nameless_file nameless_file();

/// The path by which this process and a child that inherits it open the file from its beginning.
std::string path_of(const Nameless_file& file);

/// Runs the program, a path or a name that PATH leads to, until it ends. `streams`: the descriptors
/// that are its standard input, output and error. It inherits all nameless files. A signal that
/// ends this process ends it too. Returns what waitpid says of it; none if it cannot be run.
std::optional<int> run_child(const std::string& program, std::vector<std::string> arguments,
                             const std::array<int, 3>& streams);

/// What is in the file, from its beginning.
std::string content(const Nameless_file& file);

/// What a program did that got a text and wrote one.
struct Tool_result {
  bool has_run = false;  ///< else it cannot be run, and the rest has no meaning
  int status = 0;        ///< as waitpid has it; 0: all is well
  std::string out;       ///< what it wrote to standard output
  std::string err;       ///< and to standard error

  bool succeeded() const { return has_run && status == 0; }
  /// What it said, for a message.
  std::string says() const { return err.substr(0, err.find_last_not_of('\n') + 1); }
};

/// Runs the program with the text as its standard input. Throws Output_error.
Tool_result run_tool(const std::string& program, std::vector<std::string> arguments,
                     const std::string& input);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_CHILD_PROCESS_H
