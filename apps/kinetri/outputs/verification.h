// SPDX-License-Identifier: GPL-3.0-or-later
//
// The verification of a run: after it the program kinetri-verify decides whether it was right, from
// the input and from what was logged alone.
#ifndef KINETRI_APPS_VERIFICATION_H
#define KINETRI_APPS_VERIFICATION_H

#include <array>
#include <cstddef>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "cli/exit_code.h"
#include "cli/terminal.h"
#include "kinetri/io/event_log.h"
#include "outputs/child_process.h"
#include "outputs/output_table.h"
#include "sources/any_simulation.h"

namespace kinetri::app {

class Run_source;

/// What kinetri-verify reads: outputs of the run that are files, and nameless files in place of the
/// others.
class Verification {
 public:
  /// Throws Usage_error if kinetri-verify is not beside this program; Output_error.
  explicit Verification(const Output_paths& outputs);

  /// Follows the run from its start on. Throws Output_error.
  void start(const Any_simulation& simulation);

  /// To be called at the end of the run. Throws Output_error if its own files are not complete.
  void finish(const Any_simulation& simulation);

  /// Runs kinetri-verify, whose answer goes to the stream. Preconditions: finish() has been called,
  /// and the outputs of the run are in their places.
  Exit_code run(const Any_simulation& simulation, const Run_source& source, Stream answer) const;

 private:
  enum File_kind : std::size_t { events, motions, initial_edges, edges, number_of_files };

  /// An output of the run, or a file of its own.
  struct File {
    std::string path;
    Nameless_file own;     // null if it is an output
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
