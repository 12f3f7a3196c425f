// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "cli/arguments.h"
#include "cli/text.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"
#include "video/codec/decoder.h"
#include "video/codec/quality.h"
#include "video/formats/y4m.h"
#include "video/program/commands.h"
#include "video/program/x264.h"
#include "video/stream/block_bytes.h"

namespace kinetri::video {
namespace {

using app::Command;

constexpr std::array<std::string_view, 3> plane_names = {"y", "cb", "cr"};

// The texts of the options.
struct Compare_options {
  std::string source;
  std::string other;
  std::optional<std::string> table;
  std::string rate = "25";
};

std::string samples_text(const Video_format& format) {
  return joined(format.width, " x ", format.height, " samples, ", y4m_color(format.chroma), ", ",
                format.is_full_range ? "full" : "limited", " range");
}

void check_formats(const Video_format& source, const Video_format& other,
                   const Compare_options& options) {
  if (source.width == other.width && source.height == other.height &&
      source.chroma == other.chroma && source.is_full_range == other.is_full_range) {
    return;
  }
  throw Input_error(options.other, 0,
                    joined("it has ", samples_text(other), "; expected ", samples_text(source),
                           ", as ", options.source, " has"));
}

// By the name or the first bytes of the file.
bool is_stream(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".kvd") return true;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::array<char, stream_signature.size()> begin = {};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()) == stream_signature;
}

// Adds pairs of frames, and checks that both videos have the same number.
class Pairs {
 public:
  Pairs(Frame_source& source, const std::string& other, Quality& quality)
      : source_(source), other_(other), quality_(quality) {}

  void take(const Frame& other) {
    if (!source_.read(frame_)) {
      throw Input_error(other_, 0,
                        joined("it has more frames than ", source_.name(), ": expected ",
                               quality_.frames().size()));
    }
    quality_.add(frame_, other);
  }

  void end() {
    if (source_.read(frame_)) {
      throw Input_error(other_, 0,
                        joined("it has ", quality_.frames().size(), " frames; expected ",
                               "more, as ", source_.name(), " has"));
    }
  }

 private:
  Frame_source& source_;
  const std::string& other_;
  Quality& quality_;
  Frame frame_;
};

std::string psnr_text(double psnr) {
  return std::isinf(psnr) ? "inf" : app::fixed(psnr, 3);
}

void write_table(const std::string& path, const Quality& quality, std::size_t planes) {
  Output_file output(path);
  std::string text = "frame";
  for (std::size_t p = 0; p < planes; ++p) append(text, ",psnr_", plane_names[p]);
  for (std::size_t p = 0; p < planes; ++p) append(text, ",ssim_", plane_names[p]);
  text += '\n';
  for (std::size_t i = 0; i < quality.frames().size(); ++i) {
    const Frame_quality& frame = quality.frames()[i];
    append(text, i);
    for (std::size_t p = 0; p < planes; ++p) append(text, ",", psnr_text(frame.psnr(p)));
    for (std::size_t p = 0; p < planes; ++p) append(text, ",", app::fixed(frame.ssim[p], 5));
    text += '\n';
  }
  output.stream() << text;
  output.commit();
}

// The lines of one video; `name` begins each.
void append_quality(std::string& text, const Quality& quality, const Video_format& format,
                    std::string_view name) {
  const Frame_quality mean = quality.mean();
  for (std::size_t p = 0; p < format.planes(); ++p) {
    append(text, app::left_aligned(joined(name, plane_names[p]), 14), "PSNR ",
           psnr_text(mean.psnr(p)), " dB, SSIM ", app::fixed(mean.ssim[p], 5), '\n');
  }
  const auto flicker = quality.flicker();
  append(text, app::left_aligned(joined(name, "flicker"), 14),
         flicker ? app::significant(*flicker, 3) : "none: no sample of the source rests", '\n');
}

void append_bits(std::string& text, std::uint64_t bytes, const Video_format& format,
                 std::size_t frames, std::string_view name) {
  const double pixels =
      static_cast<double>(format.width) * format.height * static_cast<double>(frames);
  append(text, app::left_aligned(joined(name, "bits"), 14),
         app::significant(8.0 * static_cast<double>(bytes) / pixels, 4), " per pixel\n");
}

app::Exit_code run(const Compare_options& options) {
  const Ratio rate = rate_argument("--rate", options.rate);
  if (is_stream(options.source)) {
    throw app::Usage_error(
        joined("A: ", options.source, " is a stream; expected the source, and the stream as B"));
  }
  if (options.table) {
    check_output("--csv", *options.table, options.source);
    check_output("--csv", *options.table, options.other);
  }
  const auto source = open_frames(options.source, rate);
  const Video_format& format = source->format();
  Quality quality(format);
  Pairs pairs(*source, options.other, quality);
  std::optional<std::uint64_t> bytes;
  if (is_stream(options.other)) {
    Stream_reader stream = Stream_reader::open(options.other);
    check_formats(format, stream.header().format, options);
    Decoded decoded;
    decode(
        stream, {}, [&](const Frame& frame) { pairs.take(frame); }, decoded);
    bytes = stream.bytes();
  } else {
    const auto other = open_frames(options.other, rate);
    check_formats(format, other->format(), options);
    Frame frame;
    while (other->read(frame)) pairs.take(frame);
  }
  pairs.end();
  if (options.table) write_table(*options.table, quality, format.planes());
  if (options.table == "-") return app::Exit_code::done;

  std::string text = joined("frames        ", quality.frames().size(), '\n');
  append_quality(text, quality, format, "");
  if (bytes) {
    append_bits(text, *bytes, format, quality.frames().size(), "");
    const X264_result x264 = x264_at(options.source, rate, *bytes, quality.frames().size());
    if (x264.problem.empty()) {
      append_quality(text, *x264.quality, format, "x264 ");
      append_bits(text, x264.bytes, format, quality.frames().size(), "x264 ");
    } else {
      append(text, "x264          not compared: ", x264.problem, '\n');
    }
  }
  std::cout << text;
  return app::Exit_code::done;
}

}  // namespace

Command compare_command() {
  const auto options = std::make_shared<Compare_options>();
  Command result;
  result.name = "compare";
  result.summary = "Compare a stream, or another video, with its source";
  result.add_required("A", &options->source, "FILE",
                      "The source: YUV4MPEG2 video (Y4M), or a folder of PNG files");
  result.add_required("B", &options->other, "FILE", "The other video: a stream (.kvd), or as A");
  result.add("--csv", &options->table, "FILE", "Write a row for each frame, - for standard output");
  result.add("--rate", &options->rate, "FPS", "Frames a second of folders (default 25)");
  result.description = {
      "PSNR is that of the mean of squares over all frames; SSIM is the mean of all frames. "
      "Flicker "
      "is the mean change of brightness from frame to frame where the source changes by at most 1.",
      "If B is a stream and ffmpeg is installed, the same is shown for x264 at about as many bits, "
      "in two passes.",
      "Exit codes: see kinetri-video encode."};
  result.examples = {"kinetri-video compare clip.y4m clip.kvd --csv frames.csv"};
  result.run = [options](const Command& /*program*/) { return run(*options); };
  return result;
}

}  // namespace kinetri::video
