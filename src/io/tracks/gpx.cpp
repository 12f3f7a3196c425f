// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks of GPS receivers as GPX 1.0 and 1.1 (https://www.topografix.com/GPX/1/1/): elements
// <trk>, perhaps with a <name>, of segments <trkseg> with points <trkpt lat=".." lon="..">, which
// have a <time>. Waypoints and routes, which have none, are left out.
#include <algorithm>
#include <cmath>
#include <vector>

#include "degrees.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"
#include "xml.h"

namespace kinetri {
namespace {

class Gpx_reader : public Xml_tracks {
 public:
  explicit Gpx_reader(const Tracks_input& input)
      : Xml_tracks(input, "GPX"), builder_(input.name, input.options.duplicates) {}

  Tracks_file read() {
    expect_projection(input().name, 0, input().options.projection, "places in GPX are");
    parse();
    Tracks_file result = builder_.finish();
    expect_spans_apart();
    result.format = Tracks_format::gpx;
    if (other_points_ > 0) {
      result.remarks.push_back(joined(other_points_, other_points_ == 1 ? " point" : " points",
                                      " of routes, and waypoints, left out"));
    }
    return result;
  }

 private:
  void begin(std::string_view name, const Xml_attributes& attributes, std::size_t depth) override {
    if (depth == 1 && name != "gpx") {
      fail(joined("the first element is ", in_quotes(name), "; expected 'gpx'"));
    }
    if (depth == 2 && name == "trk") {
      ++track_;
      line_of_track_ = line();
      is_in_span_ = false;
      id_ = joined("track ", track_);
      has_points_ = false;
    }
    if (name == "wpt" || name == "rtept") ++other_points_;
    if (name != "trkpt") return;
    has_points_ = true;
    row_ = {};
    row_.place = {number(attributes, name, "lon"), number(attributes, name, "lat")};
    row_.line = line();
    has_time_ = false;
  }

  void end(std::string_view name, const std::string& text, std::size_t depth) override {
    const std::string_view value = trimmed_lines(text);
    if (depth == 3 && name == "name" && track_ > 0 && !value.empty()) {
      // The points above it would have got another id.
      if (has_points_) fail("the name of a track stands below its points; expected it above");
      id_ = value;
    }
    if (depth == 5 && name == "time") {
      const Parsed_time time = parse_time(value, "time", input().options);
      if (!time.problem.empty()) fail(time.problem);
      row_.time = time.value;
      has_time_ = true;
    }
    if (name != "trkpt") return;
    if (!has_time_) fail("a point of a track has no time; expected one in each");
    row_.id = id_;
    builder_.add(row_);
    add_to_span();
  }

  // The times of the points of an element <trk>.
  struct Span {
    std::string id;
    Row_time first;
    Row_time last;
    std::size_t line;
  };

  static bool is_before(const Row_time& a, const Row_time& b) {
    return a.date && b.date ? *a.date < *b.date : a.number < b.number;
  }

  void add_to_span() {
    if (!is_in_span_) {
      spans_.push_back({id_, row_.time, row_.time, line_of_track_});
      is_in_span_ = true;
      return;
    }
    Span& span = spans_.back();
    if (is_before(row_.time, span.first)) span.first = row_.time;
    if (is_before(span.last, row_.time)) span.last = row_.time;
  }

  // Tracks of one name are one thing, so their times must not overlap.
  void expect_spans_apart() {
    std::ranges::stable_sort(spans_, [](const Span& a, const Span& b) {
      return a.id != b.id ? a.id < b.id : is_before(a.first, b.first);
    });
    for (std::size_t i = 1; i < spans_.size(); ++i) {
      const Span& one = spans_[i - 1];
      const Span& other = spans_[i];
      if (one.id != other.id) continue;
      if (is_before(other.first, one.last)) {
        throw Input_error(input().name, std::max(one.line, other.line),
                          joined("the track ", in_quotes(one.id), " is at times of that of line ",
                                 std::min(one.line, other.line),
                                 ", which has the same name; expected another "
                                 "name for one of the two, if they are of two things"));
      }
    }
  }

  static std::string_view trimmed_lines(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
  }

  Tracks_builder builder_;
  std::size_t track_ = 0;  // its number, from 1 on
  std::size_t line_of_track_ = 0;
  std::vector<Span> spans_;  // of tracks with points
  bool is_in_span_ = false;  // whether the last one is of the present track
  std::string id_;           // of the track
  bool has_points_ = false;
  Tracks_row row_;
  bool has_time_ = false;
  std::size_t other_points_ = 0;
};

// The name of the first element.
std::string_view first_element(std::string_view head) {
  for (std::size_t at = head.find('<'); at != std::string_view::npos; at = head.find('<', at + 1)) {
    const std::string_view rest = head.substr(at + 1);
    if (rest.starts_with("!--")) {
      at = head.find("-->", at);
      if (at == std::string_view::npos) return {};
      continue;
    }
    if (rest.starts_with('?') || rest.starts_with('!')) continue;
    return rest.substr(0, rest.find_first_of(" \t\r\n/>"));
  }
  return {};
}

// Files of TrackMate's action "Export tracks to XML file": <Tracks frameInterval=".."> of elements
// <particle> with a <detection t=".." x=".." y=".." z=".."/> for each frame t.
class Trackmate_reader : public Xml_tracks {
 public:
  explicit Trackmate_reader(const Tracks_input& input)
      : Xml_tracks(input, "tracks of TrackMate"), builder_(input.name, input.options.duplicates) {}

  Tracks_file read() {
    parse();
    Tracks_file result = builder_.finish();
    result.format = Tracks_format::trackmate;
    result.frame_rate = input().options.fps;
    if (!input().options.fps) {
      result.remarks.push_back(
          joined("frames are ", interval_, " ", time_unit_, " apart, as the file says"));
    }
    if (!length_unit_.empty()) result.remarks.push_back(joined("places are in ", length_unit_));
    result.remarks.emplace_back("ids are the numbers of particles, from 0 on");
    result.remarks.emplace_back("the third coordinate of the places is left out");
    return result;
  }

 private:
  void begin(std::string_view name, const Xml_attributes& attributes, std::size_t depth) override {
    if (depth == 1) {
      if (name != "Tracks") {
        fail(joined("the first element is ", in_quotes(name), "; expected 'Tracks'"));
      }
      if (!input().options.fps) take_interval(attributes);
      for (const auto& [key, value] : attributes) {
        if (key == "timeUnits") time_unit_ = value;
        if (key == "spaceUnits") length_unit_ = value;
      }
    }
    if (depth == 2 && name == "particle") id_ = joined(particles_++);
    if (depth != 3 || name != "detection") return;
    Tracks_row row;
    row.id = id_;
    row.place = {number(attributes, name, "x"), number(attributes, name, "y")};
    row.line = line();
    const double frame = number(attributes, name, "t");
    if (input().options.fps) {
      const Parsed_time time = time_of_frame(frame, *input().options.fps);
      if (!time.problem.empty()) fail(time.problem);
      row.time = time.value;
    } else {
      row.time.number = frame * interval_;
      if (!std::isfinite(row.time.number)) {
        fail(joined("the time of the frame ", frame,
                    " is out of the range of binary64; expected "
                    "smaller numbers"));
      }
    }
    builder_.add(row);
  }

  void take_interval(const Xml_attributes& attributes) {
    const auto is_interval = [](const auto& pair) { return pair.first == "frameInterval"; };
    if (std::ranges::none_of(attributes, is_interval)) {
      fail(
          "the tracks have no frameInterval; expected one, or --fps, the frames in a unit of time");
    }
    interval_ = number(attributes, "Tracks", "frameInterval");
    if (interval_ > 0) return;
    fail(joined("the frameInterval is ", interval_,
                "; expected a number greater than 0, or --fps, the frames in a unit of time"));
  }

  Tracks_builder builder_;
  double interval_ = 1;
  std::string time_unit_ = "units of time";
  std::string length_unit_;
  std::size_t particles_ = 0;
  std::string id_ = "0";
};

}  // namespace

bool is_gpx(std::string_view head) {
  return is_xml(head) && first_element(head) == "gpx";
}

Tracks_file read_gpx(const Tracks_input& input) {
  return Gpx_reader(input).read();
}

bool is_trackmate(std::string_view head) {
  return is_xml(head) && first_element(head) == "Tracks";
}

Tracks_file read_trackmate(const Tracks_input& input) {
  return Trackmate_reader(input).read();
}

std::string foreign_xml(std::string_view head) {
  if (!is_xml(head)) return {};
  const std::string_view element = first_element(head);
  if (element == "TrackMate") {
    return "is a session of TrackMate; expected what its action 'Export tracks to XML file' "
           "writes, "
           "or its table of spots as CSV, read with --columns "
           "t=POSITION_T,id=TRACK_ID,x=POSITION_X,y=POSITION_Y";
  }
  if (element == "kml") return "is KML; expected GPX, which gpsbabel -i kml -o gpx makes of it";
  return {};
}

}  // namespace kinetri
