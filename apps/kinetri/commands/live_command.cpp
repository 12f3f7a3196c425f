// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "cli/arguments.h"
#include "cli/text.h"
#include "commands/collisions_option.h"
#include "commands/commands.h"
#include "commands/common_arguments.h"
#include "kinetri/impl/io/json_writer.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/points_file.h"
#include "kinetri/io/viewer_page.h"
#include "sources/any_simulation.h"
#include "sources/points_source.h"

namespace kinetri::app {
namespace {

// The texts of the options.
struct Live_options {
  std::optional<std::string> points;
  std::optional<std::string> box;
  bool rim = false;
  std::string collisions = "none";
  std::optional<std::string> radius;
  bool regular = false;
  std::string output = "live.html";
};

Points_settings points_settings(const Live_options& options) {
  Points_settings result;
  const bool has_options = options.box || options.rim || options.radius || options.regular ||
                           options.collisions != "none";
  if (!options.points && has_options) {
    throw Usage_error(
        "POINTS is missing; expected a path, or -, since the options are about its points");
  }
  if (options.points) result.points = *options.points;
  if (options.box) result.box = box_argument(*options.box);
  result.rim_touches = options.rim;
  if (options.rim && !options.box) {
    throw Usage_error("--rim: there is no box to touch; expected --box as well");
  }
  result.collisions = collisions_argument(options.collisions, named_responses);
  result.is_regular = options.regular;
  if (!options.radius) return result;
  result.radius = radius_argument("--radius", *options.radius);
  if (result.collisions.response != nullptr || options.rim || options.regular) return result;
  throw Usage_error(
      "--radius: nothing touches a disc; expected --collisions, --rim or --regular as well, or no "
      "radius");
}

// The options of KineticDelaunay in live/kinetri.mjs.
std::string page_options(const Points_settings& settings) {
  std::string result;
  Json_writer json(result);
  json.begin_object();
  if (settings.box) {
    json.key("box");
    json.begin_list();
    for (const double side :
         {settings.box->xmin, settings.box->ymin, settings.box->xmax, settings.box->ymax}) {
      json.value(side);
    }
    json.end_list();
  }
  json.member("rim", settings.rim_touches);
  json.member("regular", settings.is_regular);
  json.member("collisions", settings.collisions.name);
  if (settings.radius) json.member("radius", *settings.radius);
  json.end_object();
  return result;
}

// The points of the file, which are checked as those of a simulation are.
std::string points_text(Points_settings settings) {
  if (settings.points == "-") {  // it can be read once
    std::ostringstream all;
    all << std::cin.rdbuf();
    settings.text = all.str();
    settings.points = input_name("-");
  }
  const auto source = points_source(settings);
  source->read();
  source->make_simulation(Arithmetic::filtered);
  std::istringstream again(settings.text.value_or(""));
  const Points_file points =
      settings.text ? read_points(again, settings.points) : read_points_file(settings.points);
  std::ostringstream text;
  if (points.is_polynomial) {
    write_points(text, points.polynomial_motions, points.radii, points.growths, points.masses);
  } else {
    write_points(text, points.motions, points.radii, points.growths, points.masses);
  }
  return text.str();
}

Exit_code write_page(const Live_options& options) {
  const Points_settings settings = points_settings(options);
  if (!has_live_module()) {
    throw Run_error(
        "this kinetri has been built without the module of live pages; build it with "
        "scripts/platform.sh wasm, then build kinetri again");
  }
  Live_page page;
  page.title = "Kinetri live";
  if (options.points) {
    page.points = points_text(settings);
    page.options = page_options(settings);
  }
  Output_file output(options.output);
  write_live_page(output.stream(), page);
  output.commit();
  if (options.output != "-") {
    print_error(joined("kinetri: ", options.output, " is written; open it in a browser\n"));
  }
  return Exit_code::done;
}

}  // namespace

Command live_command() {
  const auto options = std::make_shared<Live_options>();
  Command result;
  result.name = "live";
  result.summary = "Write a page in which points move, and can be taken and thrown";
  result.add(
      "POINTS", &options->points, "FILE",
      "The moving points, as of kinetri simulate; - is standard input. Without it the page has "
      "points of its own");
  result.add("--box", &options->box, "XMIN,YMIN,XMAX,YMAX",
             "Keep the points in this box: its sides reflect them");
  result.add_flag("--rim", options->rim,
                  "Reflect discs when their boundary touches the box, not when their center does");
  add_collisions_option(result, options->collisions, named_responses,
                        collisions_help(named_responses));
  result.add("--radius", &options->radius, "R",
             "Radius of all discs, if POINTS has no column radius");
  result.add_flag("--regular", options->regular,
                  "Keep the regular triangulation of the discs, even if nothing touches them");
  result.add("-o,--output", &options->output, "FILE",
             "Write the page here (default live.html); - is standard output");
  result.description = {
      "The page contains the library as WebAssembly, and loads nothing: it opens from a file in "
      "any browser from 2023 or later. Its triangulation is exact, as that of kinetri simulate: "
      "the logs that it saves can be checked with kinetri-verify."};
  result.examples = {"kinetri live", "kinetri live points.csv --box 0,0,100,100 -o points.html",
                     "kinetri live points.csv --collisions elastic --radius 0.5"};
  result.run = [options](const Command& /*program*/) { return write_page(*options); };
  return result;
}

}  // namespace kinetri::app
