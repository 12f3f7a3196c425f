// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "commands/collisions_option.h"
#include "commands/commands.h"
#include "commands/common_arguments.h"
#include "commands/periodic_option.h"
#include "commands/run_options.h"
#include "kinetri/impl/io/text.h"
#include "runs/simulation_run.h"
#include "sources/tracks_source.h"

namespace kinetri::app {
namespace {

// In the order of the enumerators, without the first one.
constexpr std::array<std::string_view, 3> projections = {"none", "local", "utm"};
constexpr std::array<std::string_view, 4> duplicates = {"refuse", "first", "last", "mean"};
constexpr std::array<std::string_view, 1> unwraps = {"nearest"};
constexpr std::span<const Named_response> none_and_log =
    std::span<const Named_response>(named_responses).first(2);
constexpr std::uint64_t most_approaches = 1'000'000;

// The texts of the options.
struct Tracks_options {
  std::string tracks;
  std::string format = "auto";
  std::optional<std::string> columns;
  std::optional<std::string> projection;
  std::optional<std::string> date_format;
  std::optional<std::string> duplicates;
  std::optional<std::string> unwrap;
  bool periodic = false;
  std::string coincident;
  std::optional<std::string> fps;
  std::optional<std::string> from;
  std::optional<std::string> until;
  std::optional<std::string> longest_gap;
  std::optional<std::string> closest;
  std::string collisions = "none";
  std::optional<std::string> radius;
  Run_options run;
};

// In the order of the enumerators.
std::vector<std::string_view> format_names() {
  std::vector<std::string_view> result;
  for (const Tracks_format_name& format : tracks_formats()) result.push_back(format.name);
  return result;
}

// The help text of --format.
std::string format_help() {
  std::string result;
  for (const auto& [format, name, description] : tracks_formats()) {
    result += joined(result.empty() ? "" : "; ", name,
                     format == Tracks_format::automatic ? " (default): " : ": ", description);
  }
  return result;
}

Track_columns columns_argument(const std::string& text) {
  constexpr std::string_view expected =
      "; expected t=NAME,id=NAME,x=NAME,y=NAME and optionally radius=NAME, or numbers of columns";
  Track_columns result;
  const std::array<std::pair<std::string_view, std::string*>, 5> columns = {
      {{"t", &result.t},
       {"id", &result.id},
       {"x", &result.x},
       {"y", &result.y},
       {"radius", &result.radius}}};
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view piece = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), piece.size() + 1));
    const std::size_t equals = piece.find('=');
    const auto found = std::ranges::find_if(
        columns, [&](const auto& column) { return column.first == piece.substr(0, equals); });
    if (equals == std::string_view::npos || equals + 1 == piece.size() || found == columns.end()) {
      throw Usage_error(joined("--columns: '", piece, "' names no column", expected));
    }
    if (!found->second->empty()) {
      throw Usage_error(joined("--columns: ", found->first, " is named twice", expected));
    }
    *found->second = piece.substr(equals + 1);
  }
  if (result.is_empty()) throw Usage_error(joined("--columns: no column is named", expected));
  return result;
}

Tracks_file_options reading_options(const Tracks_options& options) {
  Tracks_file_options result;
  const std::vector<std::string_view> names = format_names();
  result.format = static_cast<Tracks_format>(choice_argument("--format", options.format, names));
  if (options.columns) result.columns = columns_argument(*options.columns);
  if (options.projection) {
    result.projection = static_cast<Tracks_projection>(
        1 + choice_argument("--projection", *options.projection, projections));
  }
  if (options.date_format) {
    const std::string problem = problem_of_date_format(*options.date_format);
    if (!problem.empty()) {
      throw Usage_error(joined("--date-format: '", *options.date_format, "' ", problem));
    }
    result.date_format = *options.date_format;
  }
  if (options.duplicates) {
    result.duplicates = static_cast<Tracks_duplicates>(
        1 + choice_argument("--duplicates", *options.duplicates, duplicates));
  }
  if (options.unwrap) {
    choice_argument("--unwrap", *options.unwrap, unwraps);
    result.unwrap = Tracks_unwrap::nearest;
  }
  if (options.fps) result.fps = positive_argument("--fps", *options.fps);
  return result;
}

Tracks_settings tracks_settings(const Tracks_options& options) {
  Tracks_settings result;
  result.tracks = options.tracks;
  result.reading = reading_options(options);
  if (options.from) result.from = number_argument("--from", *options.from);
  if (options.until) result.until = number_argument("--until", *options.until);
  if (options.longest_gap) {
    result.longest_gap = positive_argument("--max-gap", *options.longest_gap);
  }
  result.coincident = coincident_argument(options.coincident);
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

// Throws if an option is given that does not go with --periodic.
void expect_periodic_options(const Tracks_options& options) {
  expect_periodic(options.run);
  if (options.unwrap) refuse_with_periodic("--unwrap");
}

}  // namespace

Command tracks_command() {
  const auto options = std::make_shared<Tracks_options>();
  Command result;
  result.name = "tracks";
  result.summary = "Keep the Delaunay triangulation of recorded trajectories";
  result.add_required("TRACKS", &options->tracks, "FILE", "The observations; - is standard input");
  result.add("--format", &options->format, choice_type(format_names()), format_help());
  result.add(
      "--columns", &options->columns, "t=T,id=ID,x=X,y=Y",
      "Which columns of a table have the times, ids and positions, and with radius=R the radii: "
      "their names in the header, or in a table without a header their numbers, from 1 on, as in "
      "t=1,id=2,x=3,y=4. A plus sign joins two columns of a time, t=DATE+TIME. Fields are "
      "separated by commas, semicolons, tabs or blanks. In GeoJSON, the properties t and id");
  result.add("--projection", &options->projection, choice_type(projections),
             "Positions in degrees of longitude and latitude: none takes them as they are; local "
             "converts them to meters by an equirectangular projection about the middle of the "
             "data; utm converts them to meters in its zone of UTM. A file in which distances "
             "would be off by more than 0.1 % is refused");
  result.add(
      "--date-format", &options->date_format, "F",
      "The form of dates that are not ISO 8601, such as '%d/%m/%Y %H:%M:%S' (as of strptime; "
      "%S takes a fraction); or of times of day, such as %H:%M:%S, which become seconds since "
      "midnight");
  result.add("--duplicates", &options->duplicates, choice_type(duplicates),
             "Several positions of an id at one time: take the first or last in the file, or their "
             "mean, or refuse the file (default: take the first, but refuse a file in which half "
             "of the times of an id or more have several positions)");
  result.add("--unwrap", &options->unwrap, choice_type(unwraps),
             "Atoms that leave a periodic box and enter it on the other side move to the nearest "
             "image of their next position (default: refuse the file)");
  result.add_flag("--periodic", options->periodic,
                  "Repeat atoms all over the plane, by the periodic box of a dump of LAMMPS or of "
                  "XYZ, which must be the same in all frames. Each goes on to the nearest image of "
                  "its next position, unless xu and yu, or ix and iy, say where it is");
  add_coincident_option(result, options->coincident);
  result.add("--fps", &options->fps, "F",
             "Frames in a unit of time in TRACKS, if its times are numbers of frames (default: the "
             "rate that TRACKS gives, or 1). The rate of --frames is --frames-per-time");
  result.add("--from", &options->from, "T",
             "Start just after this time (default: the first observation)");
  result.add("--until", &options->until, "T", "End at this time (default: the last observation)");
  result.add(
      "--max-gap", &options->longest_gap, "T",
      "An id that is not observed for longer than this leaves, and comes back as a new point");
  result.add("--closest", &options->closest, "K",
             "Write the K closest approaches of neighbors to standard output, as CSV; of discs of "
             "different sizes, those with the smallest gaps");
  add_collisions_option(result, options->collisions, none_and_log, collisions_help(none_and_log));
  result.add("--radius", &options->radius, "R",
             "Radius of all discs around the points, if TRACKS has no column radius");
  add_run_options(result, options->run,
                  {Output::ids, Output::neighbors, Output::exchanges, Output::nearest,
                   Output::components, Output::connected, Output::spanning_tree, Output::areas,
                   Output::mean_areas, Output::encounters, Output::contact_plan});
  result.description = {
      "A point moves in a straight line at constant velocity from one observation of its id to the "
      "next. It is inserted at the first observation and erased at the last one; an id with one "
      "observation is left out. Rows may be in any order, and copies of a row are left out.",
      "The event log numbers points in the order in which they are inserted; --ids writes the id "
      "of each.",
      "Exit codes: see kinetri simulate."};
  result.examples = {"kinetri tracks tracks.csv --events events.csv --ids ids.csv --audit end",
                     "kinetri tracks crowd.txt --format frames --fps 25 --closest 10",
                     "kinetri tracks ships.csv --columns t=time,id=name,x=lon,y=lat --projection "
                     "utm",
                     "kinetri tracks gt.txt --columns t=1,id=2,x=3,y=4 --closest 10",
                     "kinetri tracks walks.csv --coincident refuse",
                     "kinetri tracks dump.lammpstrj --periodic --html run.html"};
  result.run = [options](const Command& /*program*/) {
    if (options->periodic) expect_periodic_options(*options);
    Tracks_settings settings = tracks_settings(*options);
    if (options->periodic) settings.reading.unwrap = Tracks_unwrap::periodic;
    const auto source = tracks_source(settings);
    return run_simulation(settings_of_run(*options), *source);
  };
  return result;
}

}  // namespace kinetri::app
