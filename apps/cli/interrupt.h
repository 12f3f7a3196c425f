// SPDX-License-Identifier: GPL-3.0-or-later
//
// Interruption by the user (SIGINT), by the system (SIGTERM), or because the terminal is closed
// (SIGHUP; a process that is started with this signal ignored, as by nohup, ignores it).
//
// A signal normally ends the process at once, with exit code 130, and removes the temporary files
// of outputs. During a run the first signal only asks the run to stop and to write its results; a
// second one, unless it is SIGHUP, ends the process. So does the first one if the run does not
// react in time: a single step may be long, such as an instant with very many events, or an audit.
#ifndef KINETRI_APPS_INTERRUPT_H
#define KINETRI_APPS_INTERRUPT_H

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <string_view>

namespace kinetri::app {

/// Installs the handlers. Their messages begin with the name of the program, which must outlive
/// them. Also makes writing to a closed pipe, or beyond the maximum size of files, an error instead
/// of a signal.
void install_signal_handlers(std::string_view program);

/// The signals that these handlers handle.
sigset_t handled_signals();

/// From now on the first signal makes interrupted() true. If interrupted() is not called within the
/// given time, the process ends.
void stop_gracefully_from_now_on(
    std::chrono::microseconds patience = std::chrono::milliseconds(400));

/// From now on the first signal is ignored, since outputs are being written. The second one, unless
/// it is SIGHUP, ends the process.
void complete_outputs_from_now_on();

/// While it exists, signals are ignored, since files that belong together are being replaced.
/// Afterwards signals end the process.
class Commit_section {
 public:
  Commit_section();
  ~Commit_section();
  Commit_section(const Commit_section&) = delete;
  Commit_section& operator=(const Commit_section&) = delete;
};

/// While it exists, a signal that ends this process ends the child too. Of several at a time, only
/// the last one counts.
class Child_section {
 public:
  explicit Child_section(pid_t id);
  ~Child_section();
  Child_section(const Child_section&) = delete;
  Child_section& operator=(const Child_section&) = delete;
};

/// Whether a signal has asked the run to stop. If so, the caller must stop, and no time limit
/// applies any more.
bool interrupted() noexcept;

}  // namespace kinetri::app

#endif  // KINETRI_APPS_INTERRUPT_H
