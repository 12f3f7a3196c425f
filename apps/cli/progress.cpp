// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>

#include "cli/terminal.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

constexpr std::chrono::milliseconds period(200);
constexpr const char* erase_line = "\r\x1b[K";

bool is_enabled(Progress_mode mode) {
  return mode == Progress_mode::always ||
         (mode == Progress_mode::automatic && is_terminal(Stream::error));
}

// The columns of the terminal; 0 if standard error is not a terminal.
std::size_t terminal_width() {
  winsize size = {};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace

std::string readable_duration(double seconds) {
  constexpr double longest = 1e9;
  if (!(seconds < longest)) return "very long";
  const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
  const auto two_digits = [](std::int64_t number) {
    return joined(number < 10 ? "0" : "", number);
  };
  if (whole < 60) return joined(whole, " s");
  if (whole < 3600) return joined(whole / 60, " min ", two_digits(whole % 60), " s");
  return joined(whole / 3600, " h ", two_digits(whole / 60 % 60), " min");
}

std::string progress_text(double from, double until, double time, std::uint64_t events,
                          double seconds) {
  // Halved, so that no difference of finite numbers overflows.
  const double span = until / 2 - from / 2;
  const double share = span > 0 ? (time / 2 - from / 2) / span : 1;
  const double rate = seconds > 0 ? static_cast<double>(events) / seconds : 0;
  std::string text = joined(right_aligned(fixed(std::floor(100 * share), 0), 3),
                            " %, t = ", significant(time, 6), " of ", significant(until, 6), ", ",
                            counted(events, "event"), ", ", fixed(rate, 0), " events/s");
  constexpr double settled = 1;  // seconds; earlier rates are meaningless
  if (share > 0 && seconds >= settled) {
    text += joined(", ", readable_duration(seconds * (1 - share) / share), " left");
  }
  return text;
}

Progress::Progress(Progress_mode mode) : enabled_(is_enabled(mode)) {}

void Progress::set_range(double from, double until) {
  from_ = from;
  until_ = until;
}

bool Progress::due() const {
  return enabled_ && Clock::now() >= next_;
}

void Progress::show_stage(std::string_view stage) {
  start_ = Clock::now();
  next_ = start_ + period;
  show_line(joined(stage, " ..."));
}

void Progress::show(double time, std::uint64_t events) {
  const Clock::time_point now = Clock::now();
  next_ = now + period;
  show_line(progress_text(from_, until_, time, events,
                          std::chrono::duration<double>(now - start_).count()));
}

void Progress::show_line(std::string text) {
  if (!enabled_) return;
  // A line that wraps cannot be written over.
  if (const std::size_t width = terminal_width(); width > 1 && text.size() >= width) {
    text.resize(width - 1);
  }
  print_error(erase_line + text);
  shown_ = true;
}

void Progress::clear() {
  if (!shown_) return;
  print_error(erase_line);
  shown_ = false;
}

}  // namespace kinetri::app
