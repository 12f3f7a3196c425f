// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/terminal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "cli/exit_code.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string_view() : value;
}

std::string colored(std::string_view text, Stream stream, std::string_view code) {
  if (!has_colors(stream)) return std::string(text);
  return joined("\x1b[", code, "m", text, "\x1b[0m");
}

}  // namespace

void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const bool is_closed = ::fcntl(stream, F_GETFD) < 0 && errno == EBADF;
    // open() returns the lowest free descriptor. A directory, unlike /dev/null, always exists, and
    // can be neither read nor written.
    if (is_closed && ::open("/", O_RDONLY | O_DIRECTORY) != stream) {
      ::_exit(static_cast<int>(Exit_code::bad_input));
    }
  }
}

bool is_terminal(Stream stream) {
  return ::isatty(stream == Stream::output ? STDOUT_FILENO : STDERR_FILENO) == 1;
}

bool has_colors(Stream stream) {
  return is_terminal(stream) && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
}

std::string heading(std::string_view text, Stream stream) {
  return colored(text, stream, "1");
}

std::string alarm(std::string_view text, Stream stream) {
  return colored(text, stream, "1;31");
}

void report(std::string_view where, std::string_view what) {
  print_error(joined(alarm(joined(where, ":"), Stream::error), " ", what, "\n"));
}

void end_by_closed_pipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
  ::_exit(128 + SIGPIPE);  // the signal is blocked
}

}  // namespace kinetri::app
