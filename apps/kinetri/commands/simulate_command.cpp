// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <utility>

#include "cli/arguments.h"
#include "commands/collisions_option.h"
#include "commands/commands.h"
#include "commands/common_arguments.h"
#include "commands/periodic_option.h"
#include "commands/run_options.h"
#include "kinetri/impl/io/text.h"
#include "runs/simulation_run.h"
#include "sources/points_source.h"
#include "sources/replay_source.h"

namespace kinetri::app {
namespace {

// The texts of the options.
struct Simulate_options {
  std::string points;
  std::string from = "0";
  Periodic_options periodic;
  std::optional<std::string> box;
  bool rim = false;
  std::string collisions = "none";
  std::optional<std::string> radius;
  std::optional<std::string> growth;
  std::string mass = "column";
  bool regular = false;
  std::string coincident;
  std::optional<std::string> replay;
  Run_options run;
};

// By the value of Points_settings::has_area_masses.
constexpr std::array<std::string_view, 2> masses = {"column", "area"};

void expect_in_order(double from, double until, const Simulate_options& options) {
  if (until >= from) return;
  throw Usage_error(joined("--until: ", *options.run.until,
                           " is before the start; expected at least ", options.from,
                           ", which is --from"));
}

// Throws if an option is given that does not go with --periodic.
void expect_periodic_options(const Simulate_options& options) {
  expect_periodic(options.run);
  if (options.box) refuse_with_periodic("--box");
  if (options.rim) refuse_with_periodic("--rim");
}

Points_settings points_settings(const Simulate_options& options) {
  Points_settings result;
  if (options.periodic.periodic) {
    expect_periodic_options(options);
    result.periodic_box = periodic_box(options.periodic);
  }
  result.points = options.points;
  result.from = number_argument("--from", options.from);
  result.until = until_argument(options.run);
  if (result.until) expect_in_order(result.from, *result.until, options);
  if (options.box) result.box = box_argument(*options.box);
  result.rim_touches = options.rim;
  if (options.rim && !options.box) {
    throw Usage_error("--rim: there is no box to touch; expected --box as well");
  }
  result.collisions = collisions_argument(options.collisions, named_responses);
  result.is_regular = options.regular;
  result.coincident = coincident_argument(options.coincident);
  const bool has_discs = result.collisions.response != nullptr || options.rim || options.regular;
  const auto expect_discs = [&](std::string_view option) {
    if (has_discs) return;
    throw Usage_error(joined("--", option, ": nothing touches a disc; expected --collisions",
                             result.periodic_box ? "" : ", --rim", " or --regular as well, or no ",
                             option));
  };
  if (options.radius) {
    result.radius = radius_argument("--radius", *options.radius);
    expect_discs("radius");
  }
  if (options.growth) {
    result.growth = number_argument("--growth", *options.growth);
    expect_discs("growth");
  }
  result.has_area_masses = choice_argument("--mass", options.mass, masses) == 1;
  if (result.has_area_masses && result.collisions.name != "elastic") {
    throw Usage_error(
        "--mass: only elastic collisions have masses; expected --collisions elastic as well");
  }
  return result;
}

// Throws if an option does not go with --replay: the logs say it, or do not have it.
void expect_replay_options(const Simulate_options& options) {
  const std::array<std::pair<std::string_view, bool>, 5> excluded = {
      {{"--radius", options.radius.has_value()},
       {"--growth", options.growth.has_value()},
       {"--mass", options.mass != "column"},
       {"--until-share", options.run.until_share.has_value()},
       {"--checkpoint", options.run.outputs[Output::checkpoint].has_value()}}};
  for (const auto& [option, is_given] : excluded) {
    if (is_given) throw Usage_error(joined("--replay excludes ", option, "; expected one of them"));
  }
}

}  // namespace

Command simulate_command() {
  const auto options = std::make_shared<Simulate_options>();
  Command result;
  result.name = "simulate";
  result.summary = "Keep the Delaunay triangulation of moving points, and log its events";
  result.add_required("POINTS", &options->points, "FILE",
                      "The moving points, one a line, as CSV; - is standard input");
  add_end_options(result, options->run);
  result.add("--from", &options->from, "T",
             "Start just after this time (default 0, the time of the positions in POINTS)");
  add_periodic_options(result, options->periodic);
  result.add("--box", &options->box, "XMIN,YMIN,XMAX,YMAX",
             "Keep the points in this box: its sides reflect them. All points start inside");
  result.add_flag("--rim", options->rim,
                  "Reflect discs when their boundary touches the box, not when their center does");
  add_collisions_option(result, options->collisions, named_responses,
                        collisions_help(named_responses));
  result.add("--radius", &options->radius, "R",
             "Radius of all discs at time 0, if POINTS has no column radius");
  result.add("--growth", &options->growth, "G",
             "Growth of all radii in a unit of time, if POINTS has no column growth (default 0)");
  result.add("--mass", &options->mass, choice_type(masses),
             "Masses of the discs in elastic collisions: column (default), the column mass of "
             "POINTS, or 1 without it; area, the squares of the radii at the start");
  result.add_flag("--regular", options->regular,
                  "Keep the regular triangulation of the discs, whose dual is the power diagram, "
                  "even if nothing touches them");
  add_thermostat_option(result, options->run);
  add_coincident_option(result, options->coincident);
  result.add("--replay", &options->replay, "EVENTS",
             "Repeat a run: POINTS is the file of its --motions, and EVENTS that of its --events. "
             "Points are inserted, erased and moved as they were then; the other options are those "
             "of that run");
  add_run_options(result, options->run,
                  {Output::checkpoint, Output::neighbors, Output::exchanges, Output::nearest,
                   Output::components, Output::connected, Output::spanning_tree, Output::areas,
                   Output::mean_areas, Output::pressure, Output::encounters, Output::contact_plan});
  result.description = {
      "The first line of POINTS names its columns: x,y,vx,vy (position at time 0, and velocity), "
      "and optionally ax,ay (acceleration) and jx,jy (jerk, the rate of change of the "
      "acceleration), and of the disc about the point its radius at time 0, its growth (of the "
      "radius, in a unit of time; may be negative) and its mass. A column id has labels; other "
      "columns are ignored.",
      "If discs of different or growing radii can touch something (--collisions, --rim), or with "
      "--regular, the triangulation is the regular triangulation of the discs, in which discs that "
      "touch are neighbors. Else it is the Delaunay triangulation of the centers.",
      "In a periodic box (--periodic) the triangulation is that of all images of the points, or "
      "discs: one of the torus, without a hull. Edges have offsets: how often the two vectors of "
      "the box are added to the position of the second end. Such a run has no walls; its discs "
      "collide with images of others, whose offsets are in the log.",
      "Discs that grow may become jammed, with any response: they have no free area left between "
      "one another or between walls. The run then ends, and the outputs hold what happened until "
      "then. It ends in the same way if points are accelerated against a wall or each other, and "
      "the response does not separate them.",
      "Ctrl-C stops the run after the events of the present time, and the outputs hold what "
      "happened until then. If that takes longer than 0.4 s plus 5 s for each million points, "
      "nothing is written.",
      "A run uses all available processors, or --threads N of them, at the start, and throughout "
      "if about 50000 points or more move. The outputs are the same for any N, except the counters "
      "and times of --stats and --plot.",
      "With --verify, kinetri-verify writes one line to standard output, or to standard error if "
      "an output of the run goes to standard output. A run that was stopped by a signal, or by "
      "contacts without end, is not verified.",
      "Exit codes: 0 done; 1 an audit failed, or kinetri-verify refuted the run; 2 bad usage or "
      "bad input; 3 an internal check failed; 130 interrupted, jammed, or in contacts without "
      "end."};
  result.examples = {"kinetri simulate points.csv --until 10 --events events.csv --edges edges.csv",
                     "kinetri simulate points.csv --until 10 --html run.html",
                     "kinetri simulate points.csv --until 10 --verify",
                     "kinetri simulate points.csv --until 10 --coincident refuse",
                     "kinetri simulate points.csv --until 10 --periodic 100,100 --shear 0.1 \\",
                     "    --events events.csv --edges edges.csv --verify",
                     "kinetri simulate points.csv --until 10 --periodic 100,100 --html run.html",
                     "kinetri simulate points.csv --until 10 --periodic 100,100 \\",
                     "    --collisions elastic --radius 0.5 --events events.csv",
                     "kinetri simulate points.csv --until 10 --box 0,0,100,100 \\",
                     "    --collisions elastic --radius 0.5 --events -",
                     "kinetri simulate discs.csv --until 10 --box 0,0,100,100 --rim \\",
                     "    --collisions elastic --mass area --html run.html",
                     "kinetri simulate points.csv --until-share 0.82 --box 0,0,100,100 --rim \\",
                     "    --collisions elastic --growth 0.1 --html run.html",
                     "kinetri simulate points.csv --until 10 --checkpoint run.kinetri",
                     "kinetri simulate motions.csv --replay events.csv --until 10 --html run.html"};
  result.run = [options](const Command& /*program*/) {
    expect_no_shear(options->periodic);
    const Points_settings settings = points_settings(*options);
    if (options->replay) expect_replay_options(*options);
    const auto source =
        options->replay ? replay_source(settings, *options->replay) : points_source(settings);
    return run_simulation(run_settings(options->run), *source);
  };
  return result;
}

}  // namespace kinetri::app
