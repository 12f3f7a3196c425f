// SPDX-License-Identifier: GPL-3.0-or-later
//
// Interruption by the user (SIGINT), by the system (SIGTERM), or because the terminal is closed
// (SIGHUP; a process that is started with this signal ignored, as by nohup, ignores it).
//
// Normally it ends the process at once, with exit code 130, and removes the temporaries of output
// files. While a run is under way the first one only asks it to stop, so that it writes what it
// has; the second one, unless it is SIGHUP, ends the process. So does the first one if the run does
// not notice it within some time: a single step may be long, such as an instant with very many
// events, or an audit.
#ifndef KINETRI_APPS_INTERRUPT_H
#define KINETRI_APPS_INTERRUPT_H

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <string_view>

namespace kinetri::app {

/// Installs the handlers; their messages begin with the name of the program, which must stay where
/// it is. Also makes writing to a closed pipe, or beyond the size that files may
/// have, an error instead of a signal.
void install_signal_handlers(std::string_view program);

/// The signals that these handlers handle.
sigset_t handled_signals();

/// From now on the first signal only makes interrupted() true, if it is asked within that time.
/// Else the process ends then.
void stop_gracefully_from_now_on(
    std::chrono::microseconds patience = std::chrono::milliseconds(400));

/// From now on the first signal changes nothing: the run is over, and its outputs are written. The
/// second one, unless it is SIGHUP, ends the process.
void complete_outputs_from_now_on();

/// As long as it lives, signals change nothing: outputs that belong together take their places.
/// Afterwards they end the process.
class Commit_section {
 public:
  Commit_section();
  ~Commit_section();
  Commit_section(const Commit_section&) = delete;
  Commit_section& operator=(const Commit_section&) = delete;
};

/// As long as it lives, a signal that ends this process ends the child too. Of several that live at
/// a time, only the last one counts.
class Child_section {
 public:
  explicit Child_section(pid_t id);
  ~Child_section();
  Child_section(const Child_section&) = delete;
  Child_section& operator=(const Child_section&) = delete;
};

/// Whether a signal has asked the run to stop. If so, the caller stops, and may take its time.
bool interrupted() noexcept;

}  // namespace kinetri::app

#endif  // KINETRI_APPS_INTERRUPT_H
