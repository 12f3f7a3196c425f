// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "cli/exit_code.h"
#include "io/output_directory.h"
#include "io/output_file.h"

namespace kinetri::app {
namespace {

volatile std::sig_atomic_t graceful = 0;
volatile std::sig_atomic_t stop_requested = 0;

}  // namespace

// A handler: only async-signal-safe calls.
extern "C" {
static void on_signal(int /*signal*/) {
  if (graceful != 0 && stop_requested == 0) {
    stop_requested = 1;
    return;
  }
  constexpr std::string_view message = "\nkinetri: interrupted, nothing written\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message.data(), message.size());
  Output_file::remove_all_temporaries();
  Output_directory::remove_all_temporaries();
  ::_exit(static_cast<int>(Exit_code::interrupted));
}
}

void install_signal_handlers() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaddset(&action.sa_mask, SIGINT);
  sigaddset(&action.sa_mask, SIGTERM);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void stop_gracefully_from_now_on() {
  graceful = 1;
}

bool interrupted() noexcept {
  return stop_requested != 0;
}

}  // namespace kinetri::app
