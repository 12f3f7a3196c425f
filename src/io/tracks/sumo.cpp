// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as floating-car data of SUMO (--fcd-output): <fcd-export> with elements <timestep
// time="..">, and in these <vehicle id=".." x=".." y=".."/>, <person> and <container>. A comment
// above shows the configuration of SUMO; with fcd-output.geo in it, places are degrees.
#include <map>

#include "io/text.h"
#include "kinetri/base/error.h"
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
    Tracks_file result = builder_.finish();
    result.format = Tracks_format::sumo;
    if (are_degrees_) {
      result.remarks.emplace_back(
          "places are degrees, as the comment of SUMO says (fcd-output.geo)");
    }
    if (has_third_) result.remarks.emplace_back("the third coordinate of the places is left out");
    return result;
  }

 private:
  // `<fcd-output.geo value="true"/>`.
  void comment(std::string_view text) override {
    constexpr std::string_view option = "fcd-output.geo";
    const std::size_t at = text.find(option);
    if (at == std::string_view::npos) return;
    std::string_view value = text.substr(at + option.size());
    if (value.starts_with("-")) return;  // another option
    value = value.substr(0, value.find_first_of(">\n"));
    for (const std::string_view no : {"false", "\"0\"", "\"no\"", "\"off\"", "\"f\"", "\"-\""}) {
      if (in_lower_case(value).find(no) != std::string::npos) return;
    }
    are_degrees_ = true;
    expect_projection(input(), line(), "the comment of SUMO has fcd-output.geo: places are");
  }

  void begin(std::string_view name, const Xml_attributes& attributes, std::size_t depth) override {
    if (depth == 1 && name != "fcd-export") {
      fail(
          joined("the first element is ", quoted(name),
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
    for (const auto& [name, value] : attributes) has_third_ = has_third_ || name == "z";
    expect_kind(row, kind);
    builder_.add(row);
  }

  // A vehicle and a person with one id are two things.
  void expect_kind(const Tracks_row& row, std::string_view kind) {
    const auto found = kinds_.find(row.id);
    if (found == kinds_.end()) {
      kinds_.emplace(row.id, Kind{std::string(kind), row.line});
    } else if (found->second.name != kind) {
      fail(joined("id ", quoted(row.id), " is a ", kind, ", but a ", found->second.name,
                  " in line ", found->second.line, "; expected ids that differ"));
    }
  }

  struct Kind {
    std::string name;
    std::size_t line;
  };

  Tracks_builder builder_;
  bool is_in_timestep_ = false;
  bool are_degrees_ = false;
  bool has_third_ = false;
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
