// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/interrupt.h"

#include <pthread.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <string_view>

#include "cli/exit_code.h"
#include "kinetri/impl/io/output_directory.h"
#include "kinetri/impl/io/output_file.h"

namespace kinetri::app {
namespace {

// SIGALRM means that the run has not reacted to one of the others in time.
constexpr std::array<int, 4> signals = {SIGINT, SIGTERM, SIGHUP, SIGALRM};

// What a signal would interrupt.
enum Stage : int {
  reading,     // nothing: the process ends
  running,     // the run: it is asked to stop
  writing,     // writing of outputs: they are completed, unless another signal comes
  committing,  // replacing of files that belong together: signals are ignored
  committed,   // nothing, and there are no temporary files
};
// Atomic since a handler reads and writes them.
std::atomic<int> current_stage = reading;
std::atomic<bool> stop_requested = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
                  std::atomic<pid_t>::is_always_lock_free && std::atomic<long>::is_always_lock_free,
              "a signal handler may not wait for a lock");
std::atomic<pid_t> child = 0;
// The time in microseconds within which a run must react to a signal: some of its steps are long.
// Set before the stage `running`.
std::atomic<long> patience = 0;
std::string_view program_name;  // set before there is a handler
pthread_t outputs_thread;       // the thread that writes outputs; set before there is a handler

// Async-signal-safe.
void write_error(std::string_view text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

// Sends SIGALRM after so many microseconds; not at all after 0.
void set_alarm(long microseconds) {
  constexpr long second = 1'000'000;
  const itimerval timer = {
      {0, 0}, {microseconds / second, static_cast<suseconds_t>(microseconds % second)}};
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

// Whether the process was started with SIGHUP ignored, as nohup does.
bool ignores_hangup() {
  struct sigaction action = {};
  return sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

// Async-signal-safe.
[[noreturn]] void end_now() {
  if (child > 0) ::kill(child, SIGTERM);
  ::_exit(static_cast<int>(Exit_code::interrupted));
}

}  // namespace

// A handler: only async-signal-safe calls (setitimer is a plain system call).
extern "C" {
static void on_signal(int signal) {
  // If another thread ran the handler, this one could create temporary files meanwhile, which would
  // stay.
  if (::pthread_equal(::pthread_self(), outputs_thread) == 0) {
    ::pthread_kill(outputs_thread, signal);
    return;
  }
  if (current_stage == committing) return;
  if (current_stage == committed) end_now();
  // A closing terminal sends it twice: the shell does, and the system when the shell ends.
  if (signal == SIGHUP && stop_requested) return;
  if (current_stage != reading && !stop_requested.exchange(true)) {
    if (current_stage == running) set_alarm(patience);
    return;
  }
  constexpr std::string_view at_once = ": interrupted, nothing written\n";
  constexpr std::string_view within =
      ": interrupted within an instant, or another step that is long; nothing written\n";
  write_error("\n");
  write_error(program_name);
  write_error(signal == SIGALRM ? within : at_once);
  Output_file::remove_all_temporaries();
  Output_directory::remove_all_temporaries();
  end_now();
}
}

void install_signal_handlers(std::string_view program) {
  program_name = program;
  outputs_thread = ::pthread_self();
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  action.sa_mask = handled_signals();
  for (const int signal : signals) {
    if (signal != SIGHUP || !ignores_hangup()) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

sigset_t handled_signals() {
  sigset_t result = {};
  sigemptyset(&result);
  for (const int signal : signals) sigaddset(&result, signal);
  return result;
}

void stop_gracefully_from_now_on(std::chrono::microseconds most) {
  patience = static_cast<long>(most.count());
  current_stage = running;
}

void complete_outputs_from_now_on() {
  current_stage = writing;
  set_alarm(0);
}

Commit_section::Commit_section() {
  current_stage = committing;
}

Commit_section::~Commit_section() {
  current_stage = committed;
}

Child_section::Child_section(pid_t id) {
  child = id;
}

Child_section::~Child_section() {
  child = 0;
}

bool interrupted() noexcept {
  if (!stop_requested) return false;
  set_alarm(0);
  return true;
}

}  // namespace kinetri::app
