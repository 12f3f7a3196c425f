// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"
#include "video/codec/decoder.h"
#include "video/program/commands.h"

namespace kinetri::video {
namespace {

using app::Command;
using app::Usage_error;

constexpr std::array<std::string_view, 3> styles = {"linear", "flat", "smooth"};
constexpr std::array<Interpolation, 3> interpolations = {Interpolation::linear, Interpolation::flat,
                                                         Interpolation::smooth};

// The texts of the options.
struct Decode_options {
  std::string input;
  std::string output;
  std::optional<std::string> rate;
  std::optional<std::string> size;
  std::string style = "linear";
};

Decoder_settings settings_of(const Decode_options& options) {
  Decoder_settings result;
  result.style = interpolations[app::choice_argument("--style", options.style, styles)];
  if (options.rate) result.rate = rate_argument("--fps", *options.rate);
  if (options.size) {
    const std::string_view text = *options.size;
    const std::size_t x = text.find('x');
    if (x == std::string_view::npos) {
      throw Usage_error(
          joined("--size: '", text, "' is no size; expected WIDTHxHEIGHT, as 640x480"));
    }
    const auto number = [&](std::string_view digits) {
      const auto value = app::count_argument("--size", digits, greatest_size);
      if (value == 0) throw Usage_error("--size: 0 samples make no picture; expected 1 or more");
      return static_cast<std::uint32_t>(value);
    };
    result.width = number(text.substr(0, x));
    result.height = number(text.substr(x + 1));
  }
  return result;
}

// Refuses a name with the ending of another format.
void check_name(const Decode_options& options) {
  constexpr std::array<std::string_view, 8> others = {".avi", ".gif", ".jpg",  ".mkv",
                                                      ".mov", ".mp4", ".webm", ".png"};
  const std::string ending = std::filesystem::path(options.output).extension().string();
  if (std::ranges::find(others, ending) == others.end()) return;
  throw Usage_error(
      joined("OUT: ", options.output, ": no ", ending,
             " is written; expected a name as clip.y4m, or as frames/ "
             "for PNG files (kinetri-video decode IN - | ffmpeg -i - OUT makes other formats)"));
}

app::Exit_code run(const Decode_options& options) {
  const Decoder_settings settings = settings_of(options);
  check_name(options);
  Stream_reader stream = Stream_reader::open(options.input);
  check_output("OUT", options.output, options.input);
  const auto sink = create_frames(options.output, decoded_format(stream.header().format, settings));
  app::Progress progress(app::Progress_mode::automatic);
  Decoded decoded;
  try {
    decode(
        stream, settings,
        [&](const Frame& frame) {
          sink->write(frame);
          if (progress.due()) progress.show_stage(joined("frame ", decoded.frames));
        },
        decoded);
  } catch (const Damaged_stream_error& error) {
    progress.clear();
    if (decoded.frames == 0) throw;
    sink->commit();
    throw Damaged_stream_error(
        std::string(error.what()).substr(0, stream.name().size()), 0,
        joined(std::string(error.what()).substr(stream.name().size() + 2), "; ",
               app::counted(decoded.frames, "frame"), " before it written"));
  }
  progress.clear();
  sink->commit();
  return app::Exit_code::done;
}

}  // namespace

Command decode_command() {
  const auto options = std::make_shared<Decode_options>();
  Command result;
  result.name = "decode";
  result.summary = "Decode a stream to frames of any rate and size";
  result.add_required("IN", &options->input, "FILE", "The stream (.kvd), - for standard input");
  result.add_required("OUT", &options->output, "FILE",
                      "YUV4MPEG2 video (Y4M), - for standard output, or, ending with /, a folder "
                      "for PNG files");
  result.add("--fps", &options->rate, "FPS",
             "Frames a second, a number or a ratio (default: as the source)");
  result.add("--size", &options->size, "WxH", "Size of the frames (default: as the source)");
  result.add(
      "--style", &options->style, app::choice_type(styles),
      "linear: colors between corners; flat: one color a triangle; smooth: natural neighbors, "
      "without a jump when an edge is flipped (default linear)");
  result.description = {
      "The triangulation of each frame is that at the frame's exact time. The same stream gives "
      "the "
      "same frames, byte for byte, on every machine.",
      "A truncated or damaged stream is decoded up to the damage. The message says where it is, "
      "and the exit code is 2. Otherwise the output appears only when it is complete.",
      "Exit codes: see kinetri-video encode."};
  result.examples = {"kinetri-video decode clip.kvd clip.y4m",
                     "kinetri-video decode clip.kvd - --fps 100 --size 1280x960 | ffplay -",
                     "kinetri-video decode clip.kvd - | ffmpeg -i - clip.mp4",
                     "kinetri-video decode clip.kvd frames/ --style flat"};
  result.run = [options](const Command& /*program*/) { return run(*options); };
  return result;
}

}  // namespace kinetri::video
