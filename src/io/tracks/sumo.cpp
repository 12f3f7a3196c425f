// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as floating-car data of SUMO (--fcd-output): <fcd-export> with elements <timestep
// time="..">, and in these <vehicle id=".." x=".." y=".."/>, <person> and <container>. A comment
// above shows the configuration of SUMO; with fcd-output.geo in it, positions are degrees.
#include <cmath>
#include <map>
#include <optional>

#include "degrees.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"
#include "xml.h"

namespace kinetri {
namespace {

constexpr std::string_view content = "floating-car data of SUMO";

class Sumo_reader : public Xml_tracks {
 public:
  explicit Sumo_reader(const Tracks_input& input)
      : Xml_tracks(input, content), builder_(input.name, input.options.duplicates) {}

  Tracks_file read() {
    parse();
    expect_no_doubt();
    Tracks_file result = builder_.finish();
    result.format = Tracks_format::sumo;
    if (are_degrees_) {
      result.remarks.emplace_back(
          "places are degrees, as the comment of SUMO says (fcd-output.geo)");
    }
    if (has_third_) result.remarks.emplace_back("the third coordinate of the places is left out");
    unused_.add_remarks(result, "attributes that are left out");
    return result;
  }

 private:
  // `<fcd-output.geo value="true"/>`.
  void comment(std::string_view text) override {
    constexpr std::string_view option = "fcd-output.geo";
    has_configuration_ =
        has_configuration_ || text.find("<configuration") != std::string_view::npos;
    const std::size_t at = text.find(option);
    if (at == std::string_view::npos) return;
    std::string_view value = text.substr(at + option.size());
    if (value.starts_with("-")) return;  // another option
    value = value.substr(0, value.find_first_of(">\n"));
    for (const std::string_view no : {"false", "\"0\"", "\"no\"", "\"off\"", "\"f\"", "\"-\""}) {
      if (in_lower_case(value).find(no) != std::string::npos) return;
    }
    are_degrees_ = true;
    expect_projection(input().name, line(), input().options.projection,
                      "the comment of SUMO has fcd-output.geo: places are");
  }

  void begin(std::string_view name, const Xml_attributes& attributes, std::size_t depth) override {
    if (depth == 1 && name != "fcd-export") {
      fail(
          joined("the first element is ", in_quotes(name),
                 "; expected 'fcd-export', as SUMO writes it with --fcd-output, 'gpx', or 'Tracks' "
                 "of TrackMate"));
    }
    if (depth == 2) {
      is_in_timestep_ = name == "timestep";
      if (is_in_timestep_) {
        time_ =
            number(attributes, name, "time", ", as SUMO writes it without --human-readable-time");
      }
    }
    const bool moves = name == "vehicle" || name == "person" || name == "container";
    if (depth == 3 && is_in_timestep_ && moves) add(name, attributes);
  }

  void add(std::string_view kind, const Xml_attributes& attributes) {
    Tracks_row row;
    row.id = attribute(attributes, kind, "id");
    if (row.id.empty()) fail(joined("the id of a ", kind, " is empty; expected any text"));
    row.time.number = time_;
    row.place = {number(attributes, kind, "x"), number(attributes, kind, "y")};
    row.line = line();
    for (const auto& [name, value] : attributes) {
      has_third_ = has_third_ || name == "z";
      if (name != "id" && name != "x" && name != "y" && name != "z") unused_.add(name);
    }
    expect_kind(row, kind);
    note_motion(row, attributes);
    builder_.add(row);
  }

  // In degrees, distances are much less than speeds, which are in meters, imply.
  void note_motion(const Tracks_row& row, const Xml_attributes& attributes) {
    std::optional<double> speed;
    bool has_decimals = true;
    for (const auto& [name, value] : attributes) {
      const Parsed_number parsed = parse_number(value);
      if (name == "speed" && parsed.problem.empty()) speed = parsed.value;
      if (name == "x" || name == "y") has_decimals = has_decimals && has_many_decimals(value);
    }
    are_in_range_ = are_in_range_ && is_on_earth(row.place);
    ++rows_;
    if (has_decimals) ++rows_of_many_decimals_;
    Kind& known = kinds_.find(row.id)->second;
    const double duration = time_ - known.time;
    if (known.has_place && duration > 0) {
      const double way = std::hypot(row.place.x - known.place.x, row.place.y - known.place.y);
      way_ += way;
      duration_ += duration;
      if (speed) {
        way_with_speed_ += way;
        way_by_speed_ += *speed * duration;
      }
    }
    known.has_place = true;
    known.time = time_;
    known.place = row.place;
  }

  // By default SUMO writes meters with two decimals, and degrees with six.
  static bool has_many_decimals(std::string_view number) {
    constexpr std::size_t many = 4;
    const std::size_t point = number.find('.');
    return point != std::string_view::npos && number.size() - point > many;
  }

  void expect_no_doubt() const {
    if (input().options.projection != Tracks_projection::refused || !are_in_range_) return;
    constexpr double greatest_quotient = 0.001;
    constexpr double greatest_speed = 0.003;  // in degrees 330 m a second
    std::string why;
    if (way_by_speed_ > 0) {
      if (!(way_with_speed_ < greatest_quotient * way_by_speed_)) return;
      why = joined("things go ", rounded(way_with_speed_, 3), " where their speeds make ",
                   rounded(way_by_speed_, 3));
    } else if (has_configuration_) {
      return;
    } else if (way_ > 0) {
      if (!(way_ < greatest_speed * duration_)) return;
      why = joined("things go ", rounded(way_ / duration_, 3), " a second");
    } else {
      if (rows_ == 0 || 2 * rows_of_many_decimals_ < rows_) return;
      why = "most have four decimals or more";
    }
    throw Input_error(
        input().name, 0,
        joined("the places look like degrees (fcd-output.geo): they are within 180 and 90, and ",
               why,
               "; expected --projection local or --projection utm if they are longitude and "
               "latitude, or --projection none, which takes them as they are"));
  }

  // A vehicle and a person with one id are two things.
  void expect_kind(const Tracks_row& row, std::string_view kind) {
    const auto found = kinds_.find(row.id);
    if (found == kinds_.end()) {
      kinds_.emplace(row.id, Kind{.name = std::string(kind), .line = row.line});
    } else if (found->second.name != kind) {
      fail(joined("id ", in_quotes(row.id), " is a ", kind, ", but a ", found->second.name,
                  " in line ", found->second.line, "; expected ids that differ"));
    }
  }

  struct Kind {
    std::string name;
    std::size_t line;
    bool has_place = false;  // whether `place` is set
    double time = 0;
    Vector_2 place = {};
  };

  Tracks_builder builder_;
  bool is_in_timestep_ = false;
  bool are_degrees_ = false;
  bool has_third_ = false;
  Unused_names unused_;
  bool has_configuration_ = false;  // a comment of SUMO shows it
  bool are_in_range_ = true;
  std::size_t rows_ = 0;
  std::size_t rows_of_many_decimals_ = 0;
  double way_ = 0;             // of all things
  double duration_ = 0;        // of `way_`
  double way_with_speed_ = 0;  // of those with a speed
  double way_by_speed_ = 0;    // according to their speeds
  double time_ = 0;
  std::map<std::string, Kind, std::less<>> kinds_;  // of each id
};

}  // namespace

bool is_xml(std::string_view head) {
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && head[begin] == '<';
}

Tracks_file read_sumo(const Tracks_input& input) {
  return Sumo_reader(input).read();
}

}  // namespace kinetri
