// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "cli/arguments.h"
#include "commands/collisions_option.h"
#include "commands/commands.h"
#include "commands/run_options.h"
#include "runs/simulation_run.h"
#include "sources/tracks_source.h"

namespace kinetri::app {
namespace {

// In the order of the enumerators that they name.
constexpr std::array<std::string_view, 2> formats = {"rows", "frames"};
constexpr std::span<const Named_response> none_and_log =
    std::span<const Named_response>(named_responses).first(2);
constexpr std::uint64_t most_approaches = 1'000'000;

// The options' values as they stand on the command line.
struct Tracks_options {
  std::string tracks;
  std::string format = "rows";
  std::optional<std::string> fps;
  std::optional<std::string> from;
  std::optional<std::string> until;
  std::optional<std::string> longest_gap;
  std::optional<std::string> closest;
  std::string collisions = "none";
  std::optional<std::string> radius;
  Run_options run;
};

Tracks_settings tracks_settings(const Tracks_options& options) {
  Tracks_settings result;
  result.tracks = options.tracks;
  result.format = static_cast<Tracks_format>(choice_argument("--format", options.format, formats));
  if (options.fps) {
    if (result.format != Tracks_format::frames) {
      throw Usage_error(
          "--fps: rows have times; expected --format frames as well, or no --fps "
          "(--frames-per-time is the rate of --frames and --vtu)");
    }
    result.fps = positive_argument("--fps", *options.fps);
  }
  if (options.from) result.from = number_argument("--from", *options.from);
  if (options.until) result.until = number_argument("--until", *options.until);
  if (options.longest_gap) {
    result.longest_gap = positive_argument("--max-gap", *options.longest_gap);
  }
  result.logs_contacts = collisions_argument(options.collisions, none_and_log).response != nullptr;
  if (options.radius && !result.logs_contacts) {
    throw Usage_error("--radius: nothing touches a disc; expected --collisions log as well");
  }
  if (options.radius) result.radius = radius_argument("--radius", *options.radius);
  return result;
}

Run_settings settings_of_run(const Tracks_options& options) {
  Run_settings result = run_settings(options.run);
  if (!options.closest) return result;
  result.answers.closest =
      static_cast<std::size_t>(count_argument("--closest", *options.closest, most_approaches));
  if (result.answers.closest == 0) {
    throw Usage_error("--closest: 0 approaches show nothing; expected 1 or more");
  }
  result.outputs[Output::closest] = "-";
  return result;
}

}  // namespace

Command tracks_command() {
  const auto options = std::make_shared<Tracks_options>();
  Command result;
  result.name = "tracks";
  result.summary = "Keep the Delaunay triangulation of recorded trajectories";
  result.add_required("TRACKS", &options->tracks, "FILE", "The observations; - is standard input");
  result.add(
      "--format", &options->format, choice_type(formats),
      "rows (default): CSV with the columns t,id,x,y and optionally radius; frames: lines of "
      "frame id x y, without a header");
  result.add("--fps", &options->fps, "F",
             "Frames in a unit of time in TRACKS, for --format frames (default 1). The rate of "
             "--frames is --frames-per-time");
  result.add("--from", &options->from, "T",
             "Start just after this time (default: the first observation)");
  result.add("--until", &options->until, "T", "End at this time (default: the last observation)");
  result.add(
      "--max-gap", &options->longest_gap, "T",
      "An id that is not observed for longer than this leaves, and comes back as a new point");
  result.add("--closest", &options->closest, "K",
             "Write the K closest approaches of neighbors to standard output, as CSV; of discs of "
             "different sizes those of the least gaps between rims");
  add_collisions_option(result, options->collisions, none_and_log, collisions_help(none_and_log));
  result.add("--radius", &options->radius, "R",
             "Radius of all discs around the points, if TRACKS has no column radius");
  add_run_options(result, options->run, {Output::ids});
  result.description = {
      "A point moves in a straight line at constant velocity from one observation of its id to the "
      "next. It is inserted at the first observation and erased at the last one; an id with one "
      "observation is left out. Rows may be in any order, and copies of a row are left out.",
      "In the event log points have numbers, in the order in which they are inserted; --ids says "
      "which id each one is.",
      "Exit codes: see kinetri simulate."};
  result.examples = {"kinetri tracks tracks.csv --events events.csv --ids ids.csv --audit end",
                     "kinetri tracks crowd.txt --format frames --fps 25 --closest 10"};
  result.run = [options](const Command& /*program*/) {
    const auto source = tracks_source(tracks_settings(*options));
    return run_simulation(settings_of_run(*options), *source);
  };
  return result;
}

}  // namespace kinetri::app
