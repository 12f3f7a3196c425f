// SPDX-License-Identifier: GPL-3.0-or-later
//
// The verification of a run: the program kinetri-verify decides from the input and the logs whether
// the run was correct.
#ifndef KINETRI_APPS_VERIFICATION_H
#define KINETRI_APPS_VERIFICATION_H

#include <array>
#include <cstddef>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "cli/terminal.h"
#include "kinetri/io/event_log.h"
#include "outputs/child_process.h"
#include "outputs/output_table.h"
#include "sources/any_simulation.h"

namespace kinetri::app {

class Run_source;

/// The files for kinetri-verify: outputs of the run that are files, and nameless files for the
/// others.
class Verification {
 public:
  /// Throws Usage_error if kinetri-verify is not beside this program; Output_error.
  explicit Verification(const Output_paths& outputs);

  /// Observes the run from its start on. Throws Output_error.
  void start(const Any_simulation& simulation);

  /// Must be called at the end of the run. Throws Output_error if its own files cannot be
  /// completed.
  void finish(const Any_simulation& simulation);

  /// Runs kinetri-verify, which writes its answer to the stream. Precondition: finish() and
  /// Run_outputs::commit have been called.
  Exit_code run(const Any_simulation& simulation, const Run_source& source, Stream answer) const;

 private:
  enum File_kind : std::size_t { events, motions, initial_edges, edges, number_of_files };

  /// An output of the run, or a file of its own.
  struct File {
    std::string path;
    Nameless_file own;     // null if the file is an output
    std::ofstream stream;  // of its own file
  };

  std::string program_;
  std::array<File, number_of_files> files_;
  std::optional<Event_log_writer> event_log_;
  std::unique_ptr<Event_observer> motion_log_;
  double from_ = 0;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_VERIFICATION_H
