// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/film.h"

#include <vector>

#include "cli/arguments.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

// --unlimited: a path of many edges is a long text.
const std::vector<std::string> drawing_arguments = {"--format=png", "--unlimited"};

[[noreturn]] void fail_drawing(const std::string& says) {
  throw Output_error(
      joined("rsvg-convert: drawing failed; expected one of librsvg 2.52 or newer (Debian: "
             "librsvg2-bin), and space in /tmp; it said: ",
             says));
}

std::vector<std::string> encoding_arguments(Film_format format) {
  switch (format) {
    case Film_format::gif:
      // One palette for all frames: without it, colors would flicker.
      return {"-filter_complex",
              "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=none:"
              "diff_mode=rectangle",
              "-f", "gif"};
    case Film_format::webp:
      return {"-c:v", "libwebp_anim", "-quality", "50", "-compression_level",
              "6",    "-loop",        "0",        "-f", "webp"};
    case Film_format::webm:
      return {"-c:v", "libvpx-vp9", "-crf", "32", "-b:v", "0", "-pix_fmt", "yuv420p", "-f", "webm"};
    default:
      return {"-c:v",     "libx264", "-crf",      "22",         "-preset", "slow",
              "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f",      "mp4"};
  }
}

}  // namespace

void require_drawing_tool(std::string_view otherwise) {
  if (run_tool("rsvg-convert", {"--version"}, "").succeeded()) return;
  throw Usage_error(
      joined("rsvg-convert, which draws pictures, is not installed; expected it "
             "(Debian: librsvg2-bin), or ",
             otherwise));
}

void require_film_tool(std::string_view otherwise) {
  if (run_tool("ffmpeg", {"-version"}, "").succeeded()) return;
  throw Usage_error(joined(
      "ffmpeg, which makes films, is not installed; expected it (Debian: ffmpeg), or ", otherwise));
}

std::string png_of(const std::string& svg) {
  const Tool_result result = run_tool("rsvg-convert", drawing_arguments, svg);
  if (!result.succeeded() || result.out.empty()) fail_drawing(result.says());
  return result.out;
}

void Film::add(const std::string& svg) {
  const std::string png = png_of(svg);
  if (std::fwrite(png.data(), 1, png.size(), frames_.get()) == png.size()) return;
  throw Output_error("/tmp: writing the frames of the film failed; expected space for them");
}

std::string Film::encoded(Film_format format, double frames_per_second) const {
  const Nameless_file film = nameless_file();
  const Nameless_file err = nameless_file();
  const Nameless_file none = nameless_file();
  std::vector<std::string> arguments = {"-nostdin",   "-hide_banner", "-loglevel",
                                        "error",      "-y",           "-f",
                                        "image2pipe", "-framerate",   joined(frames_per_second),
                                        "-c:v",       "png",          "-i",
                                        "pipe:0"};
  for (const std::string& argument : encoding_arguments(format)) arguments.push_back(argument);
  // No metadata, so that the bytes are reproducible. The file is named by its descriptor, since
  // some formats need to seek.
  for (const char* argument :
       {"-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"}) {
    arguments.emplace_back(argument);
  }
  arguments.push_back("file:" + path_of(film));
  std::rewind(frames_.get());
  const auto status =
      run_child("ffmpeg", std::move(arguments),
                {::fileno(frames_.get()), ::fileno(none.get()), ::fileno(err.get())});
  std::string result = content(film);
  if (status && *status == 0 && !result.empty()) return result;
  const std::string says = content(err);
  throw Output_error(
      joined("ffmpeg: encoding failed; expected an ffmpeg with the encoders gif, libwebp_anim, "
             "libvpx-vp9 and libx264 (Debian: ffmpeg), and space in /tmp; it said: ",
             says.substr(0, says.find_last_not_of('\n') + 1)));
}

}  // namespace kinetri::app
