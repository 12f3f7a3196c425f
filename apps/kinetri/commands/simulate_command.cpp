// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/simulate_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "cli/arguments.h"
#include "cli/command_line.h"

namespace kinetri::app {
namespace {

Box_2 box_argument(const std::string& text) {
  std::array<double, 4> sides = {};
  std::size_t number = 0;
  for (std::size_t start = 0; start <= text.size(); ++number) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const std::string side = text.substr(start, comma - start);
    if (number < sides.size()) sides[number] = number_argument("--box", side);
    start = comma + 1;
  }
  if (number != sides.size()) {
    throw Usage_error(fmt::format("--box: '{}' has {} numbers; expected four, XMIN,YMIN,XMAX,YMAX",
                                  text, number));
  }
  const auto& [xmin, ymin, xmax, ymax] = sides;
  if (xmin < xmax && ymin < ymax) return {xmin, ymin, xmax, ymax};
  throw Usage_error(
      fmt::format("--box: '{}' has no area; expected XMIN,YMIN,XMAX,YMAX with XMIN < XMAX and "
                  "YMIN < YMAX",
                  text));
}

}  // namespace

Simulate_command::Simulate_command(CLI::App& program)
    : command_(
          add_command(program, "simulate",
                      "Keep the Delaunay triangulation of moving points, and log its events")) {
  const auto add = [this](const char* option, auto& value, const char* type, const char* help) {
    return add_option(*command_, option, value, type, help);
  };
  add("POINTS", points_, "FILE", "The moving points, at time 0; - is standard input")->required();
  add("--until", until_, "T", "Execute every event at or before this time")->required();
  add("--from", from_, "T", "Start just after this time (default 0)");
  add("--box", box_, "XMIN,YMIN,XMAX,YMAX",
      "Reflect points at the sides of this box, in which all start");
  add_flag(*command_, "--rim", rim_, "What touches the box is the rim of a disc, not its centre");
  add("--collisions", collisions_, "none|log|swap|elastic|stop|remove",
      "What discs do that touch: nothing (default); be logged; exchange velocities; collide "
      "elastically; stop, both; vanish, both");
  add("--radius", radius_, "R", "Radius of all discs, for points without a column radius");
  run_options_.add_to(*command_);
  run_options_.add_checkpoint_to(*command_);
  command_->footer(
      "The file POINTS has a header line x,y,vx,vy, and one point a line. Further columns may be\n"
      "radius, with all radii equal; ax,ay, accelerations; jx,jy, their derivatives. Interrupted, "
      "the command stops at the next event and writes what it "
      "has.\n\n"
      "Exit codes: 0 done; 1 an audit failed; 2 bad usage or input; 3 an internal check failed;\n"
      "130 interrupted.\n\n"
      "Example:\n"
      "  kinetri simulate points.csv --until 10 --events events.csv --edges edges.csv --audit end\n"
      "  kinetri simulate points.csv --until 10 --box 0,0,100,100 --collisions elastic --radius 1\n"
      "  kinetri simulate points.csv --until 10 --html run.html\n"
      "  kinetri simulate points.csv --until 10 --checkpoint run.kinetri");
}

Exit_code Simulate_command::run() const {
  Points_source source(settings());
  return run_simulation(run_options_.settings(), source);
}

Points_settings Simulate_command::settings() const {
  Points_settings result;
  result.points = points_;
  result.from = number_argument("--from", from_);
  result.until = number_argument("--until", until_);
  if (result.until < result.from) {
    throw Usage_error(fmt::format(
        "--until: {} is before the start; expected at least {}, which is --from", until_, from_));
  }
  if (box_) result.box = box_argument(*box_);
  result.rim_touches = rim_;
  if (rim_ && !box_) throw Usage_error("--rim: there is no box to touch; expected --box as well");
  std::array<std::string_view, named_responses.size()> responses;
  std::ranges::transform(named_responses, responses.begin(), &Named_response::name);
  result.collisions = named_responses[choice_argument("--collisions", collisions_, responses)];
  if (radius_) {
    result.radius = positive_argument("--radius", *radius_);
    if (result.collisions.response == nullptr && !rim_) {
      throw Usage_error(
          "--radius: nothing touches a disc; expected --collisions or --rim as well, or no radius");
    }
  }
  return result;
}

}  // namespace kinetri::app
