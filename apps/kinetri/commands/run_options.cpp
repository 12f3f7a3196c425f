// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/run_options.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/text.h"
#include "commands/common_arguments.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/text.h"
#include "outputs/gnuplot.h"
#include "pictures/view_words.h"

namespace kinetri::app {
namespace {

// In the order of the enumerators.
constexpr std::array<std::string_view, 3> audit_modes = {"none", "end", "events"};
constexpr std::array<std::string_view, 3> progress_modes = {"auto", "always", "never"};

constexpr std::uint64_t most_events = std::numeric_limits<std::uint64_t>::max();

constexpr std::uint64_t most_threads = 1024;

constexpr double smallest_share = 1e-9;

constexpr const char* outputs_heading = "Outputs";
constexpr const char* run_heading = "Run and display";

// The options that need --range.
std::string ranged_outputs() {
  std::vector<std::string> result;
  for (const Output_row& row : output_table) {
    if (row.has_range) result.emplace_back(row.option);
  }
  return separated(result, ", ");
}

// The value of --range, which some outputs need, and the page of --html uses to show encounters.
double range_argument(const Run_options& options) {
  bool is_needed = false;
  for (const Output_row& row : output_table) {
    if (!row.has_range || !options.outputs[row.output]) continue;
    is_needed = true;
    if (options.range) continue;
    throw Usage_error(joined(row.option, ": needs --range R; expected both"));
  }
  if (!options.range) return 0;
  if (!is_needed && !options.outputs[Output::html]) {
    throw Usage_error(joined("--range: no option uses it; expected one of ", ranged_outputs(),
                             ", --html as well"));
  }
  const double range = number_argument("--range", *options.range);
  if (range < 0) {
    throw Usage_error(joined("--range: ", *options.range, " is negative; expected 0 or more"));
  }
  return range;
}

// The two names in a value of --between, read as CSV.
std::array<std::string, 2> names_between(const std::string& text) {
  static const std::string option = "--between";
  std::vector<std::string> names;
  try {
    names = csv_fields(text, option);
  } catch (const Input_error& error) {
    throw Usage_error(error.what());
  }
  if (names.size() == 2 && !names[0].empty() && !names[1].empty()) return {names[0], names[1]};
  throw Usage_error(
      joined(option, ": ", kinetri::in_quotes(text), " is not a pair; expected two names ",
             "separated by a comma, such as 3,7; a name that contains a comma in quotation marks"));
}

// The values of --between, which --connected needs.
std::vector<std::array<std::string, 2>> between_arguments(const Run_options& options) {
  const bool is_needed = options.outputs[Output::connected].has_value();
  if (is_needed && options.between.empty()) {
    throw Usage_error("--connected: needs --between A,B; expected both");
  }
  if (!is_needed && !options.between.empty()) {
    throw Usage_error("--between: no option uses it; expected --connected as well");
  }
  std::vector<std::array<std::string, 2>> result;
  for (const std::string& text : options.between) result.push_back(names_between(text));
  return result;
}

// The value of --ridge.
std::optional<double> ridge_argument(const Run_options& options) {
  if (!options.ridge) return std::nullopt;
  if (!options.outputs[Output::neighbors] && !options.outputs[Output::exchanges]) {
    throw Usage_error(
        "--ridge: no neighbors are written; expected --neighbors or --exchanges as well");
  }
  return positive_argument("--ridge", *options.ridge);
}

// The outputs for which --walkable and --cutoff can be given.
std::string limited_outputs() {
  std::vector<std::string> result;
  for (const Output_row& row : output_table) {
    if (row.has_limits) result.emplace_back(row.option);
  }
  return separated(result, " or ");
}

// The values of --walkable and --cutoff. Whether one is missing is checked later, since the input
// may have a walkable area.
void set_limits(const Run_options& options, Answer_settings& settings) {
  const bool is_needed = std::ranges::any_of(output_table, [&](const Output_row& row) {
    return row.has_limits && options.outputs[row.output];
  });
  if (!is_needed && (options.walkable || options.cutoff)) {
    throw Usage_error(joined(options.walkable ? "--walkable" : "--cutoff",
                             ": no cells are measured; expected ", limited_outputs(), " as well"));
  }
  settings.walkable = options.walkable;
  if (options.cutoff) {
    settings.cutoff = size_argument("--cutoff", *options.cutoff, 1e-150, 1e150, false);
  }
}

// The value of --html-view.
std::string html_view(const Run_options& options) {
  if (!options.html_view) return {};
  if (!options.outputs[Output::html]) {
    throw Usage_error("--html-view: no page is written; expected --html as well");
  }
  view_words("--html-view", *options.html_view);
  return *options.html_view;
}

void add_outputs(Command& command, Run_options& options, std::initializer_list<Output> requested) {
  bool has_range = false;
  bool has_limits = false;
  for (const Output_row& row : output_table) {
    const bool is_requested =
        std::find(requested.begin(), requested.end(), row.output) != requested.end();
    if (row.offered == Offered::by_request && !is_requested) continue;
    // Another option may already have the short name.
    const bool short_is_free = command.find_option("-o") == nullptr;
    command
        .add(short_is_free ? row.names : row.option, &options.outputs[row.output], row.type,
             row.help)
        .heading = outputs_heading;
    has_range = has_range || row.has_range;
    has_limits = has_limits || row.has_limits;
    if (row.has_frames) options.framed.emplace_back(row.option);
  }
  if (has_limits) {
    command
        .add("--walkable", &options.walkable, "FILE",
             joined("For ", limited_outputs(),
                    ": where points can be, as polygons with holes in Well-Known Text; replaces "
                    "the area of the input, if it has one"))
        .heading = outputs_heading;
    command
        .add("--cutoff", &options.cutoff, "R",
             joined("For ", limited_outputs(), ": cells end at this distance from their points"))
        .heading = outputs_heading;
  }
  if (command.find_option("--neighbors") != nullptr) {
    command
        .add("--ridge", &options.ridge, "L",
             "For --neighbors and --exchanges: mark neighbors whose ridge, the common side of "
             "their cells, was always shorter than this, and do not count their exchanges")
        .heading = outputs_heading;
  }
  if (command.find_option("--connected") != nullptr) {
    command
        .add("--between", &options.between, "A,B",
             "For --connected: two ids of the input; may be repeated")
        .heading = outputs_heading;
  }
  if (!has_range) return;
  command
      .add("--range", &options.range, "R",
           joined("For ", ranged_outputs(),
                  ", and for --html, which then shows points near each other: near are points at "
                  "most this distance apart; discs, with at most this gap between them"))
      .heading = outputs_heading;
}

}  // namespace

void add_end_options(Command& command, Run_options& options) {
  command
      .add_required("--until", &options.until, "T",
                    "Run to this time, events at this time included")
      .alternative = "--until-share";
  command
      .add("--until-share", &options.until_share, "S",
           "Run until the discs, which grow and collide elastically, cover this share of the box")
      .excludes = "--until";
}

std::optional<double> until_argument(const Run_options& options) {
  if (options.until) return number_argument("--until", *options.until);
  if (options.until_share) return std::nullopt;
  throw Usage_error("--until is missing; expected --until T, or --until-share S");
}

void add_thermostat_option(Command& command, Run_options& options) {
  command.add("--thermostat", &options.thermostat, "N[,E]",
              "N times in a unit of time, multiply all velocities by the factor that makes the "
              "kinetic energy E, by default that at the start; in a periodic box velocities "
              "relative to its flow");
}

void add_run_options(Command& command, Run_options& options,
                     std::initializer_list<Output> requested) {
  // Recorded tracks have an option --fps of their own.
  const bool fps_is_free = command.find_option("--fps") == nullptr;
  options.frames_per_time_option = fps_is_free ? "--fps,--frames-per-time" : "--frames-per-time";
  add_outputs(command, options, requested);
  command
      .add(options.frames_per_time_option, &options.frames_per_time, "N",
           joined("Frames in a unit of time, for ", alternatives(options.framed),
                  " (default: 101 frames from start to end, with 100 intervals between",
                  command.find_option("--areas") != nullptr
                      ? "; for --areas, if tracks consist of frames: each frame of them)"
                      : ")"))
      .heading = outputs_heading;
  command
      .add("--html-view", &options.html_view, "WORDS",
           "What the page of --html shows first, as in the part of its address after #: "
           "t=2&color=area")
      .heading = outputs_heading;
  command
      .add("--audit", &options.audit, choice_type(audit_modes),
           "Check the triangulation by exact arithmetic: never (default); at the end; or at the "
           "start, after every event and at the end")
      .heading = run_heading;
  command
      .add_flag("--verify", options.verify,
                "After the run, let the program kinetri-verify decide from the input and the logs "
                "alone whether the triangulation was right at all times")
      .heading = run_heading;
  command
      .add("--max-events", &options.max_events, "N",
           "Stop once more than N events have happened, and write the results up to then (default "
           "1000000000)")
      .heading = run_heading;
  command
      .add("--threads", &options.threads, "N",
           "Use at most N threads; 0 (default): as many as are available; the outputs are the "
           "same for any N")
      .heading = run_heading;
  command
      .add_flag("--exact-only", options.exact_only,
                "Use exact arithmetic for every decision, without floating-point filters: the same "
                "events, but slower")
      .heading = run_heading;
  command
      .add("--progress", &options.progress, choice_type(progress_modes),
           "Show a progress line; auto (default) shows it on a terminal")
      .heading = run_heading;
  command.add_flag("-q,--quiet", options.quiet, "Show no progress line and no summary").heading =
      run_heading;
}

Run_settings run_settings(const Run_options& options) {
  Run_settings result;
  result.outputs = options.outputs;
  result.answers.range = range_argument(options);
  result.answers.between = between_arguments(options);
  result.answers.ridge = ridge_argument(options);
  set_limits(options, result.answers);
  result.html_view = html_view(options);
  if (options.range && options.outputs[Output::html]) result.html_range = result.answers.range;
  if (options.frames_per_time) {
    const std::string& option = options.frames_per_time_option;
    if (std::ranges::none_of(output_table, [&](const Output_row& row) {
          return row.has_frames && result.outputs[row.output];
        })) {
      throw Usage_error(joined(option, ": no frames are written; expected ",
                               alternatives(options.framed), " as well"));
    }
    result.frame_rate = Frame_rate{positive_argument(option, *options.frames_per_time), option};
  }
  if (options.thermostat) {
    const std::vector<double> numbers =
        numbers_argument("--thermostat", *options.thermostat, 1, 2, "one or two, N or N,E");
    for (const double number : numbers) {
      if (number > 0) continue;
      throw Usage_error(joined("--thermostat: '", *options.thermostat, "' has ", number,
                               "; expected numbers greater than 0"));
    }
    result.thermostat = Thermostat_settings{numbers[0], std::nullopt};
    if (numbers.size() == 2) result.thermostat->energy = numbers[1];
  }
  if (result.outputs[Output::plot]) require_gnuplot("no --plot");
  if (options.until_share) {
    result.until_share =
        size_argument("--until-share", *options.until_share, smallest_share, 1, false);
  }
  if (options.max_events) {
    result.max_events = count_argument("--max-events", *options.max_events, most_events);
  }
  result.threads = count_argument("--threads", options.threads, most_threads);
  result.audit = static_cast<Audit_mode>(choice_argument("--audit", options.audit, audit_modes));
  result.exact_only = options.exact_only;
  result.verifies = options.verify;
  result.progress =
      static_cast<Progress_mode>(choice_argument("--progress", options.progress, progress_modes));
  if (options.quiet) result.progress = Progress_mode::never;
  result.quiet = options.quiet;
  return result;
}

}  // namespace kinetri::app
