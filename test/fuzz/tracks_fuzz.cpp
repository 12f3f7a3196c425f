// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reader of tracks on any bytes, in both formats: it refuses them with a message that names the
// place; or it reads tracks that come back the same from what is written of them, and from the same
// rows in the opposite order.
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>
#include <vector>

#include "fuzz/fuzz.h"
#include "kinetri/base/error.h"
#include "kinetri/io/tracks_file.h"

namespace kinetri {
namespace {

using test::require;

using Places = std::vector<std::array<double, 3>>;  // time, x, y

std::map<std::string, Places> places_of(const Tracks_file& file) {
  std::map<std::string, Places> result;
  for (const Track& track : file.tracks) {
    Places& places = result[track.id];
    require(places.empty(), "an id twice");
    for (const auto& [time, place, line] : track.observations) {
      require(std::isfinite(time) && std::isfinite(place.x) && std::isfinite(place.y),
              "a number that is not finite");
      require(places.empty() || places.back()[0] < time, "times that do not ascend");
      places.push_back({time, place.x, place.y});
    }
    require(!places.empty(), "a track without an observation");
  }
  return result;
}

// Ids that need no quotes.
bool is_plain(const std::string& id) {
  return id.find_first_of("\",;\t #\r") == std::string::npos;
}

std::string rows_of(const std::map<std::string, Places>& tracks, bool backward) {
  std::vector<std::string> rows;
  for (const auto& [id, places] : tracks) {
    if (!is_plain(id)) return {};
    for (const auto& [time, x, y] : places) {
      std::ostringstream row;
      row << std::setprecision(std::numeric_limits<double>::max_digits10) << time << ',' << id
          << ',' << x << ',' << y << '\n';
      rows.push_back(row.str());
    }
  }
  std::string result = "t,id,x,y\n";
  if (backward) {
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) result += *row;
  } else {
    for (const std::string& row : rows) result += row;
  }
  return result;
}

void check(const std::string& text, Tracks_format format) {
  std::istringstream in(text);
  try {
    const Tracks_file file =
        read_tracks(in, "input", format, format == Tracks_format::frames ? 25 : 0);
    const auto tracks = places_of(file);
    std::size_t observations = 0;
    for (const auto& [id, places] : tracks) observations += places.size();
    require(observations == file.observations, "another number of observations");
    for (const bool backward : {false, true}) {
      const std::string rows = rows_of(tracks, backward);
      if (rows.empty()) return;
      std::istringstream written(rows);
      const auto again = places_of(read_tracks(written, "written", Tracks_format::rows));
      require(again == tracks, "other tracks from what was written");
    }
  } catch (const Input_error& error) {
    const std::string message = error.what();
    require(message.starts_with("input:"), "a message with its place: " + message);
    require(message.find('\n') == std::string::npos, "a message on one line");
  }
}

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  kinetri::check(text, kinetri::Tracks_format::rows);
  kinetri::check(text, kinetri::Tracks_format::frames);
  return 0;
}
