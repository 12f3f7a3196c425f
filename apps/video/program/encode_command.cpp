// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "cli/progress.h"
#include "cli/text.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"
#include "video/codec/encoder.h"
#include "video/program/commands.h"

namespace kinetri::video {
namespace {

using app::Command;
using app::Usage_error;

constexpr std::array<std::string_view, 2> placements = {"content", "grid"};

// The texts of the options.
struct Encode_options {
  std::string input;
  std::string output;
  std::string points = "2000";
  std::optional<std::string> key_every;
  std::string turn_every = "8";
  std::string color_step = "4";
  std::string rate = "25";
  std::string placement = "content";
  bool scene_cut = false;
  bool no_motion = false;
};

Encoder_settings settings_of(const Encode_options& options, const Video_format& format) {
  Encoder_settings result;
  result.points = app::count_argument("--points", options.points, most_points);
  if (result.points < number_of_corners) {
    throw Usage_error(joined("--points: ", result.points,
                             " are fewer than the picture has corners; expected 4 or more"));
  }
  const std::uint64_t frames =
      app::count_argument("--turn-every", options.turn_every, most_group_frames);
  if (!std::has_single_bit(frames)) {
    throw Usage_error(joined("--turn-every: ", frames,
                             " is no power of two; expected 1, 2, 4, ..., ", most_group_frames));
  }
  result.group_frames = static_cast<std::uint32_t>(frames);
  if (options.key_every) {
    const double seconds = app::positive_argument("--key-every", *options.key_every);
    const double number = std::round(seconds * format.rate.numerator / format.rate.denominator);
    result.key_frames = static_cast<std::uint32_t>(std::clamp(number, 1.0, 1e9));
  }
  result.has_scene_cuts = options.scene_cut;
  const double step = app::size_argument("--color-step", options.color_step, 0.125, 31.875, false);
  if (step * 8 != std::floor(step * 8)) {
    throw Usage_error(joined("--color-step: ", step, " is no multiple of 1/8; expected one"));
  }
  result.color_step = static_cast<unsigned>(step * 8);
  result.placement =
      static_cast<Placement>(app::choice_argument("--placement", options.placement, placements));
  result.has_motion = !options.no_motion;
  return result;
}

app::Exit_code run(const Encode_options& options) {
  const auto source = open_frames(options.input, rate_argument("--rate", options.rate));
  const Encoder_settings settings = settings_of(options, source->format());
  check_output("OUT", options.output, options.input);
  Output_file output(options.output);
  app::Progress progress(app::Progress_mode::automatic);
  const Encoded encoded = encode(*source, output.stream(), settings, [&](std::uint32_t frames) {
    if (!output.stream()) output.finish();
    if (progress.due()) progress.show_stage(joined("frame ", frames));
  });
  progress.clear();
  output.commit();
  if (options.output == "-") return app::Exit_code::done;
  const Video_format& format = source->format();
  const double pixels = static_cast<double>(format.width) * format.height * encoded.frames;
  std::cout << joined(
      app::counted(encoded.frames, "frame"), ", ", app::counted(encoded.keys, "key"), " (",
      app::counted(encoded.scene_cuts, "scene cut"), "), ", app::counted(encoded.events, "event"),
      ", ", app::counted(encoded.bytes, "byte"), " (",
      app::significant(8.0 * static_cast<double>(encoded.bytes) / pixels, 3), " bits per pixel)\n");
  return app::Exit_code::done;
}

}  // namespace

Command encode_command() {
  const auto options = std::make_shared<Encode_options>();
  Command result;
  result.name = "encode";
  result.summary = "Encode a video as a stream of moving triangles";
  result.add_required(
      "IN", &options->input, "FILE",
      "YUV4MPEG2 video (Y4M), - for standard input, or a folder of PNG files, in the "
      "order of the numbers in their names");
  result.add_required("OUT", &options->output, "FILE", "The stream (.kvd), - for standard output");
  result.add("--points", &options->points, "N",
             "Points at one time, at most; 4 or more (default 2000)");
  result.add("--key-every", &options->key_every, "S",
             "Place all points anew after this many seconds (default: only at the beginning)");
  result.add_flag("--scene-cut", options->scene_cut, "Place them anew if a scene begins");
  result.add("--turn-every", &options->turn_every, "FRAMES",
             "Frames between changes of a point's velocity, a power of two (default 8)");
  result.add(
      "--color-step", &options->color_step, "STEP",
      "Colors are multiples of this, a multiple of 1/8; a finer step takes more bits (default 4)");
  result.add("--rate", &options->rate, "FPS",
             "Frames a second of a folder, a number or a ratio (default 25)");
  result.add("--placement", &options->placement, app::choice_type(placements),
             "Where points are placed: where the error is largest, or on a grid, for comparison "
             "(default content)");
  result.add_flag("--no-motion", options->no_motion, "Points rest, for comparison");
  result.description = {
      "Points are placed where the error of linear interpolation between the points so far is "
      "largest, and follow the picture by optical flow (pyramidal Lucas-Kanade). Their paths are "
      "piecewise linear; their colors are fitted to the frames by least squares. Points that lose "
      "their texture move with their neighbors, points that leave the picture are removed, and new "
      "ones are inserted where the error is largest; they may replace points that make little "
      "difference.",
      "The file appears when all of it has been written. docs/VIDEO.md describes the method and "
      "the format.",
      "Exit codes: 0 done, 2 bad usage, input or output, 3 internal error, 130 interrupted."};
  result.examples = {"kinetri-video encode clip.y4m clip.kvd --points 2000",
                     "kinetri-video encode frames/ clip.kvd --rate 30 --scene-cut",
                     "ffmpeg -i clip.mp4 -f yuv4mpegpipe - | kinetri-video encode - clip.kvd"};
  result.run = [options](const Command& /*program*/) { return run(*options); };
  return result;
}

}  // namespace kinetri::video
