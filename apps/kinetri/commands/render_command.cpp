// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string_view>

#include "cli/arguments.h"
#include "cli/progress.h"
#include "commands/commands.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/viewer_page.h"
#include "outputs/regular_times.h"
#include "pictures/film.h"
#include "pictures/run_pictures.h"

namespace kinetri::app {
namespace {

constexpr std::uint64_t least_side = 16;  // pixels
constexpr std::uint64_t greatest_side = 16'384;
constexpr std::size_t most_film_frames = 20'000;
constexpr double marked_seconds =
    0.3;  // of the film, before and after an event, in which it is marked

constexpr std::array<std::string_view, 2> picture_endings = {".svg", ".png"};
constexpr std::array<std::string_view, 4> film_endings = {".gif", ".webp", ".webm", ".mp4"};
constexpr std::array<std::string_view, 3> render_progress_modes = {"auto", "always", "never"};

// The texts of the options.
struct Render_options {
  std::string run;
  std::optional<std::string> at;
  std::optional<std::string> output;
  std::optional<std::string> animate;
  std::optional<std::string> from;
  std::optional<std::string> until;
  std::optional<std::string> fps;
  std::optional<std::string> speed;
  std::optional<std::string> view;
  std::string width = "960";
  std::string height = "640";
  bool has_time = false;
  std::string progress = "auto";
};

int side_argument(std::string_view option, const std::string& text) {
  const std::uint64_t value = count_argument(option, text, greatest_side);
  if (value < least_side) {
    throw Usage_error(joined(option, ": ", value, " is out of range; expected a number from ",
                             least_side, " to ", greatest_side));
  }
  return static_cast<int>(value);
}

// The index in `endings` of the ending of a path.
template <std::size_t n>
std::size_t format_of(std::string_view option, const std::string& path,
                      const std::array<std::string_view, n>& endings) {
  const std::string ending = in_lower_case(std::filesystem::path(path).extension().string());
  const auto found = std::ranges::find(endings, ending);
  if (found != endings.end()) return static_cast<std::size_t>(found - endings.begin());
  throw Usage_error(joined(option, ": ", path,
                           " has an unknown ending; expected a name that ends with ",
                           alternatives(endings)));
}

double time_of_run(std::string_view option, const std::string& text, const Recording& recording) {
  const double time = number_argument(option, text);
  if (time >= recording.from && time <= recording.until) return time;
  throw Usage_error(joined(option, ": ", time, " is outside of the run; expected a time from ",
                           recording.from, " to ", recording.until));
}

Viewer_page page_of(const std::string& path) {
  if (path == "-") return read_viewer_page(std::cin, "standard input");
  std::ifstream in = open_input(path, "a run, as --html writes it");
  return read_viewer_page(in, path);
}

// Opens an output that is not the input.
Output_file output_of(std::string_view option, const std::string& path, const std::string& run) {
  Output_file result(path);
  std::error_code ignored;
  const std::string input = std::filesystem::canonical(run, ignored).string();
  if (!result.identity().empty() && result.identity() == input) {
    throw Usage_error(joined(option, ": ", path, " is the input; expected another file"));
  }
  return result;
}

// The format, rate and times of the frames of a film.
struct Film_plan {
  Film_format format = Film_format::gif;
  double frames_per_second = 0;
  double speed = 0;
  std::vector<double> times;
};

Film_plan film_plan(const Render_options& options, const Picture_options& picture,
                    const Recording& recording) {
  Film_plan result;
  result.format = static_cast<Film_format>(format_of("--animate", *options.animate, film_endings));
  // All formats support the lowest rate.
  result.frames_per_second =
      options.fps ? size_argument("--fps", *options.fps, 0.01, 1000, false) : 20;
  result.speed = options.speed ? positive_argument("--speed", *options.speed) : 1;
  const double from =
      options.from ? time_of_run("--from", *options.from, recording) : recording.from;
  const double until =
      options.until ? time_of_run("--until", *options.until, recording) : recording.until;
  if (from > until) {
    throw Usage_error(
        joined("--until: ", until, " is before --from, ", from, "; expected times in order"));
  }
  for (const auto& [option, side] :
       {std::pair("--width", picture.width), std::pair("--height", picture.height)}) {
    if ((result.format != Film_format::webm && result.format != Film_format::mp4) || side % 2 == 0)
      continue;
    throw Usage_error(joined(option, ": ", side, " is odd, but WebM and MP4 need even sizes; ",
                             "expected an even number"));
  }
  const double per_time = result.frames_per_second / result.speed;
  auto times = regular_times(from, until, per_time, most_film_frames);
  if (!times) {
    throw Usage_error(joined("--fps: ", result.frames_per_second, " from t = ", from, " to ", until,
                             " are more than ", most_film_frames,
                             " frames; expected fewer, a shorter time, or a greater --speed"));
  }
  result.times = std::move(*times);
  return result;
}

std::string film_of(const Viewer_page& page, const std::vector<View_source>& sources,
                    Picture_options picture, const Film_plan& plan, Progress_mode mode) {
  picture.highlight = marked_seconds * plan.speed;
  Run_pictures pictures(page, sources, picture);
  Progress progress(mode);
  Film film;
  for (std::size_t i = 0; i < plan.times.size(); ++i) {
    if (progress.due()) progress.show_stage(joined("frame ", i + 1, " of ", plan.times.size()));
    film.add(pictures.at(plan.times[i]));
  }
  progress.show_stage("encoding");
  return film.encoded(plan.format, plan.frames_per_second);
}

Exit_code render(const Render_options& options) {
  if (!options.output && !options.animate) {
    throw Usage_error("there is nothing to write; expected --output FILE, or --animate FILE");
  }
  std::vector<View_source> sources;
  if (options.view) sources.push_back({"--view", view_words("--view", *options.view)});
  Picture_options picture;
  picture.width = side_argument("--width", options.width);
  picture.height = side_argument("--height", options.height);
  picture.has_time = options.has_time;
  const auto mode = static_cast<Progress_mode>(
      choice_argument("--progress", options.progress, render_progress_modes));
  const bool is_png = options.output && *options.output != "-" &&
                      format_of("--output", *options.output, picture_endings) == 1;
  if (is_png) require_drawing_tool("an --output that ends with .svg");
  if (options.animate) {
    format_of("--animate", *options.animate, film_endings);
    require_drawing_tool("no --animate");
    require_film_tool("no --animate");
  }
  const Viewer_page page = page_of(options.run);
  if (!page.settings.view.empty()) {
    sources.insert(sources.begin(), {options.run, view_words(options.run, page.settings.view)});
  }
  std::optional<Output_file> still;
  std::optional<Output_file> film;
  if (options.output) still.emplace(output_of("--output", *options.output, options.run));
  if (options.animate) film.emplace(output_of("--animate", *options.animate, options.run));
  if (still && film && !film->identity().empty() && still->identity() == film->identity()) {
    throw Usage_error(joined("--output and --animate name the same file, ", *options.animate,
                             "; expected different files"));
  }
  std::optional<Film_plan> plan;
  if (film) plan = film_plan(options, picture, page.recording);
  if (still) {
    Run_pictures pictures(page, sources, picture);
    const std::string svg = options.at
                                ? pictures.at(time_of_run("--at", *options.at, page.recording))
                                : pictures.first();
    still->stream() << (is_png ? png_of(svg) : svg);
    still->finish();
  }
  if (film) {
    film->stream() << film_of(page, sources, picture, *plan, mode);
    film->finish();
  }
  if (still) still->commit();
  if (film) film->commit();
  return Exit_code::done;
}

}  // namespace

Command render_command() {
  const auto options = std::make_shared<Render_options>();
  Command result;
  result.name = "render";
  result.summary = "Draw pictures and films of a run that --html has recorded";
  result.add_required("RUN", &options->run, "FILE",
                      "A page that --html has written; - is standard input");
  result.add("-o,--output", &options->output, "FILE",
             "Write a picture here: the name ends with .svg or .png; - is standard output, as SVG");
  result
      .add("--at", &options->at, "T",
           "The picture shows this time, events at this time included (default: what --view says, "
           "then what the page shows first, then the start)")
      .needs = "--output";
  result.add("--animate", &options->animate, "FILE",
             "Write a film here: the name ends with .gif, .webp, .webm or .mp4");
  result.add("--from", &options->from, "T", "The film begins at this time (default: the start)")
      .needs = "--animate";
  result.add("--until", &options->until, "T", "The film ends at this time (default: the end)")
      .needs = "--animate";
  result
      .add("--fps", &options->fps, "N",
           "Frames in a second of the film, from 0.01 to 1000 (default 20)")
      .needs = "--animate";
  result
      .add("--speed", &options->speed, "V",
           "Time of the run that passes in a second of the film (default 1)")
      .needs = "--animate";
  result.add("--view", &options->view, "WORDS",
             "What is shown, as in --html-view: color=area&show=voronoi&hide=ids&theme=dark");
  result.add("--width", &options->width, "N", "Pixels (default 960)");
  result.add("--height", &options->height, "N", "Pixels (default 640)");
  result.add_flag("--time", options->has_time, "Write the time into the picture");
  result.add("--progress", &options->progress, choice_type(render_progress_modes),
             "Show a progress line; auto (default) shows it on a terminal");
  result.description = {
      "The pictures are those of the page, without a browser. They show what the page shows first "
      "(--html-view), unless --view says otherwise. Its words are those of --html-view; play, "
      "list, draw and the circle under the pointer have no effect.",
      "rsvg-convert (Debian: librsvg2-bin) draws PNG and films, ffmpeg encodes films. "
      "SVG needs neither.",
      "A film has a frame at its first time and then one after each 1 / N seconds, up to its last "
      "time. Edges that an event removes are dashed and orange shortly before it, edges that it "
      "adds are bold and blue shortly after it. A picture marks only those of events at its time.",
      "Exit codes: 0 done, 2 bad usage or input, or a tool is missing, 130 interrupted."};
  result.examples = {
      "kinetri render run.html --at 2.5 --output picture.svg",
      "kinetri render run.html --at 2.5 --output picture.png --view 'color=density&hide=ids'",
      "kinetri render run.html --animate film.gif --from 0 --until 4 --fps 20 --width 480 "
      "--height 320"};
  result.run = [options](const Command& /*program*/) { return render(*options); };
  return result;
}

}  // namespace kinetri::app
