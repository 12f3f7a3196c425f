// SPDX-License-Identifier: GPL-3.0-or-later
//
// The readers of tracks in every format, and the one that recognizes the format, on any bytes: each
// refuses them with a message that names the file, on one line; or it reads tracks that are well
// formed. The readers that the content chooses give what they give by name.
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "fuzz/fuzz.h"
#include "kinetri/base/error.h"
#include "kinetri/io/tracks_file.h"

namespace kinetri {
namespace {

using test::require;

// What the file holds, as text; none if it is refused.
std::optional<std::string> tracks_of(const std::string& text, const Tracks_file_options& options,
                                     Tracks_format& format) {
  std::istringstream in(text);
  try {
    const Tracks_file file = read_tracks(in, "input", options);
    format = file.format;
    require(format != Tracks_format::automatic, "a format that is none");
    std::ostringstream out;
    out << std::hexfloat;
    std::size_t observations = 0;
    for (const Track& track : file.tracks) {
      require(!track.id.empty() && !track.observations.empty(), "a track of nothing");
      out << track.id << ' ' << track.radius;
      std::optional<double> before;
      for (const auto& [time, place, line] : track.observations) {
        require(std::isfinite(time) && std::isfinite(place.x) && std::isfinite(place.y),
                "a number that is not finite");
        require(!before || *before < time, "times that do not ascend");
        require(line > 0, "an observation that is nowhere");
        before = time;
        ++observations;
        out << ' ' << time << ' ' << place.x << ' ' << place.y << ' ' << line;
      }
      out << '\n';
    }
    require(observations == file.observations, "another number of observations");
    return out.str();
  } catch (const Input_error& error) {
    const std::string message = error.what();
    require(message.starts_with("input:"), "a message with its place: " + message);
    require(message.find('\n') == std::string::npos, "a message on one line");
    return std::nullopt;
  }
}

void check(const std::string& text) {
  Tracks_format format = Tracks_format::automatic;
  const std::optional<std::string> recognized = tracks_of(text, {}, format);
  if (recognized) {
    const Tracks_format by_content = format;
    // Signs of frames and of ids together count for the one that recognizes, not for each alone.
    const auto again = tracks_of(text, {.format = by_content}, format);
    const bool is_of_frames =
        by_content == Tracks_format::frames || by_content == Tracks_format::ids;
    require(again == recognized || (is_of_frames && !again),
            "other tracks by the name of the format");
  }
  for (const Tracks_format_name& name : tracks_formats()) {
    Tracks_file_options options;
    options.format = name.format;
    options.projection = Tracks_projection::local;
    if (name.format == Tracks_format::table) {
      options.columns = {.t = "t", .id = "id", .x = "x", .y = "y", .radius = ""};
    }
    tracks_of(text, options, format);
    options.projection = Tracks_projection::none;
    if (name.format != Tracks_format::rows) options.fps = 25;
    tracks_of(text, options, format);
    options.projection = Tracks_projection::utm;
    options.duplicates = Tracks_duplicates::mean;
    options.unwrap = Tracks_unwrap::nearest;
    options.fps = std::nullopt;
    if (name.format == Tracks_format::table) {
      options.columns = {.t = "1", .id = "2", .x = "3", .y = "4", .radius = ""};
    }
    tracks_of(text, options, format);
    options.duplicates = Tracks_duplicates::last;
    options.date_format = "%d/%m/%Y %H:%M:%S";
    options.projection = Tracks_projection::none;
    tracks_of(text, options, format);
  }
}

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::check(std::string(data, data + size));
  return 0;
}
