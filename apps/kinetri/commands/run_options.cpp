// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/run_options.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "cli/arguments.h"
#include "cli/command_line.h"
#include "outputs/gnuplot.h"

namespace kinetri::app {
namespace {

// In the order of the enumerators that they name.
constexpr std::array<std::string_view, 3> audit_modes = {"none", "end", "events"};
constexpr std::array<std::string_view, 3> progress_modes = {"auto", "always", "never"};

}  // namespace

std::vector<CLI::Option*> Run_options::add_to(CLI::App& command) {
  std::vector<CLI::Option*> result;
  const auto add = [&](const char* option, auto& value, const char* type, const char* help) {
    result.push_back(add_option(command, option, value, type, help));
  };
  add("--events", events_, "FILE", "Write the events here; - is standard output");
  add("--initial-edges", initial_edges_, "FILE", "Write the edges just after the start here");
  add("--edges", edges_, "FILE", "Write the edges at the end here");
  add("--stats", stats_, "FILE", "Write counts and times here, as JSON");
  add("--html", html_, "FILE", "Write a page here that plays the run in a browser");
  add("--frames", frames_, "DIR", "Write pictures of the run into this new directory, as SVG");
  add("--vtu", vtu_, "DIR", "Write the run into this new directory, as VTU files for ParaView");
  // Recorded tracks have an option --fps of their own.
  const bool fps_is_free = command.get_option_no_throw("--fps") == nullptr;
  add(fps_is_free ? "--fps,--frames-per-time" : "--frames-per-time", frames_per_time_, "N",
      "Frames of --frames and --vtu in a unit of time (default: 101 frames from start to end)");
  frames_per_time_option_ = result.back();
  add("--plot", plot_, "FILE", "Draw events, queues and stages of the run here, as SVG");
  add("--audit", audit_, "none|end|events",
      "Check everything exactly: never (default), at the end, or after every event too (there "
      "without "
      "recomputing all failure times)");
  result.push_back(
      add_flag(command, "--exact-only", exact_only_,
               "Decide everything by exact arithmetic, without filters: the same events, slower"));
  add_option(command, "--progress", progress_, "auto|always|never",
             "Show a progress line; auto (default): on a terminal");
  add_flag(command, "--quiet", quiet_, "Neither a progress line nor a summary");
  return result;
}

void Run_options::add_checkpoint_to(CLI::App& command) {
  add_option(command, "--checkpoint", checkpoint_, "FILE",
             "Write the state at the end here, for kinetri resume; when interrupted, too");
}

Frame_settings Run_options::frame_settings() const {
  Frame_settings result;
  result.svg = frames_;
  result.vtu = vtu_;
  if (!frames_per_time_) return result;
  // With all its names: any of them may be the one that was used.
  const std::string option = frames_per_time_option_->get_name(false, true);
  if (!frames_ && !vtu_) {
    throw Usage_error(
        fmt::format("{}: no frames are written; expected --frames or --vtu as well", option));
  }
  result.rate = Frame_rate{positive_argument(option, *frames_per_time_), option};
  return result;
}

Run_settings Run_options::settings() const {
  Run_settings result;
  result.events = events_;
  result.initial_edges = initial_edges_;
  result.edges = edges_;
  result.stats = stats_;
  result.checkpoint = checkpoint_;
  result.html = html_;
  result.frames = frame_settings();
  result.plot = plot_;
  if (plot_) require_gnuplot("no --plot");
  result.audit = static_cast<Audit_mode>(choice_argument("--audit", audit_, audit_modes));
  if (exact_only_) result.arithmetic = Arithmetic::exact_only;
  result.progress =
      static_cast<Progress_mode>(choice_argument("--progress", progress_, progress_modes));
  if (quiet_) result.progress = Progress_mode::never;
  result.quiet = quiet_;
  return result;
}

}  // namespace kinetri::app
