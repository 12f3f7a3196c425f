// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/tracks_command.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "cli/arguments.h"
#include "cli/command_line.h"

namespace kinetri::app {
namespace {

// In the order of the enumerators that they name.
constexpr std::array<std::string_view, 2> formats = {"rows", "frames"};
constexpr std::array<std::string_view, 2> collision_modes = {"none", "log"};
constexpr std::uint64_t most_approaches = 1'000'000;

}  // namespace

Tracks_command::Tracks_command(CLI::App& program)
    : command_(add_command(
          program, "tracks",
          "Keep the Delaunay triangulation of recorded tracks: they come, turn and go")) {
  const auto add = [this](const char* option, auto& value, const char* type, const char* help) {
    return add_option(*command_, option, value, type, help);
  };
  add("TRACKS", tracks_, "FILE", "The observations; - is standard input")->required();
  add("--format", format_, "rows|frames",
      "rows (default): CSV with the columns t,id,x,y; frames: frame id x y, without a header");
  add("--fps", fps_, "F",
      "Frames per unit of time in TRACKS, for the format frames (default 1); not of --frames");
  add("--from", from_, "T", "Start just after this time (default: the first observation)");
  add("--until", until_, "T", "End at this time (default: the last observation)");
  add("--max-gap", longest_gap_, "T",
      "Not seen for longer than this, an id was away: it leaves and comes back as another point");
  add("--closest", closest_, "K",
      "Print the K closest approaches of neighbors, as CSV on standard output");
  add("--ids", ids_, "FILE", "Write which point is which id, from when to when, here");
  add("--collisions", collisions_, "none|log", "Log contacts of discs about the points");
  add("--radius", radius_, "R", "Radius of the discs");
  run_options_.add_to(*command_);
  command_->footer(
      "Between two observations an id goes straight and at one speed. It appears at its first\n"
      "observation, turns at each, and leaves at its last; one that is seen only once is left "
      "out.\n"
      "Rows may be in any order; one that repeats another is dropped. The events say when points\n"
      "are inserted and erased; their numbers follow the order in which they appear.\n\n"
      "Example:\n"
      "  kinetri tracks tracks.csv --events events.csv --audit end\n"
      "  kinetri tracks crowd.txt --format frames --fps 25 --closest 10");
}

Exit_code Tracks_command::run() const {
  Tracks_source source(settings());
  Run_settings run_settings = run_options_.settings();
  run_settings.points = ids_;
  if (closest_) {
    run_settings.closest =
        static_cast<std::size_t>(count_argument("--closest", *closest_, most_approaches));
    if (run_settings.closest == 0) {
      throw Usage_error("--closest: 0 approaches show nothing; expected 1 or more");
    }
  }
  return run_simulation(run_settings, source);
}

Tracks_settings Tracks_command::settings() const {
  Tracks_settings result;
  result.tracks = tracks_;
  result.format = static_cast<Tracks_format>(choice_argument("--format", format_, formats));
  if (fps_) {
    if (result.format != Tracks_format::frames) {
      throw Usage_error(
          "--fps: rows have times; expected --format frames as well, or no --fps "
          "(--frames-per-time is the rate of --frames and --vtu)");
    }
    result.fps = positive_argument("--fps", *fps_);
  }
  if (from_) result.from = number_argument("--from", *from_);
  if (until_) result.until = number_argument("--until", *until_);
  if (longest_gap_) result.longest_gap = positive_argument("--max-gap", *longest_gap_);
  const bool logs = choice_argument("--collisions", collisions_, collision_modes) != 0;
  if (logs != radius_.has_value()) {
    throw Usage_error(logs ? "--collisions: discs have a radius; expected --radius R as well"
                           : "--radius: nothing touches a disc; expected --collisions log as well");
  }
  if (radius_) result.radius = positive_argument("--radius", *radius_);
  return result;
}

}  // namespace kinetri::app
