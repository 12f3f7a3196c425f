// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as GeoJSON (RFC 7946): a FeatureCollection of points, each with properties for what was
// seen and when, or of lines with one time for each position, in the property coordTimes, times, or
// times in coordinateProperties. Positions are degrees, unless the member crs of older files names
// another reference system.
#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "degrees.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"
#include "tracks_readers.h"

namespace kinetri {
namespace {

using nlohmann::json;

constexpr int greatest_depth = 100;
constexpr std::array<const char*, 5> names_of_times = {"t", "time", "timestamp", "datetime",
                                                       "date"};
constexpr std::array<const char*, 5> names_of_ids = {"id", "track_id", "trackId", "track", "name"};

struct Too_deep {};

// The line in a message of the parser; 0 if there is none.
std::size_t line_in(std::string_view message) {
  constexpr std::string_view before = "at line ";
  const std::size_t at = message.find(before);
  if (at == std::string_view::npos) return 0;
  message.remove_prefix(at + before.size());
  const Parsed_number line =
      parse_number(message.substr(0, message.find_first_not_of("0123456789")));
  return line.problem.empty() ? static_cast<std::size_t>(line.value) : 0;
}

// Replaces NaN, which is not JSON but written by some programs, by null.
std::string without_nan(const std::string& text) {
  constexpr std::string_view nan = "NaN";
  std::string result;
  result.reserve(text.size());
  bool is_in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_in_string && std::string_view(text).substr(i).starts_with(nan)) {
      result += "null";
      i += nan.size() - 1;
      continue;
    }
    result += text[i];
    if (is_in_string && text[i] == '\\' && i + 1 < text.size()) {
      result += text[++i];
    } else if (text[i] == '"') {
      is_in_string = !is_in_string;
    }
  }
  return result;
}

json parsed(const Tracks_input& input) {
  const auto is_kept = [](int depth, json::parse_event_t /*event*/, json& /*value*/) {
    if (depth > greatest_depth) throw Too_deep();
    return true;
  };
  const std::string text = without_nan(std::string(std::istreambuf_iterator<char>(input.in), {}));
  try {
    return json::parse(text, is_kept);
  } catch (const json::parse_error& error) {
    if (input.in.bad()) {
      throw Input_error(input.name, line_in(error.what()),
                        "reading failed; expected a readable file of tracks");
    }
    throw Input_error(
        input.name, line_in(error.what()),
        "is not valid JSON, or ends too early; expected GeoJSON, and all of the file");
  } catch (const json::out_of_range&) {
    throw Input_error(
        input.name, 0,
        "has a number that is out of the range of binary64; expected 0, or a magnitude "
        "from 4.9e-324 to 1.8e308");
  } catch (const Too_deep&) {
    throw Input_error(input.name, 0,
                      joined("lists and objects are nested more than ", greatest_depth,
                             " deep; expected GeoJSON"));
  }
}

// Whether the name ends in the number of a geographic system of EPSG, whose coordinates are
// degrees: those from 4001 to 4999, except the geocentric 4978, and newer ones of WGS 84, of
// Australia, North America, Italy and Japan.
bool is_geographic(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  if (in_lower_case(name).find("epsg") == std::string::npos || colon == std::string_view::npos) {
    return false;
  }
  const Parsed_number number = parse_number(name.substr(colon + 1));
  if (!number.problem.empty()) return false;
  constexpr std::array<double, 8> newer = {6318, 6319, 6668, 6706, 7843, 7844, 9057, 9755};
  return (number.value > 4000 && number.value < 5000 && number.value != 4978) ||
         std::find(newer.begin(), newer.end(), number.value) != newer.end();
}

class Geojson_reader {
 public:
  explicit Geojson_reader(const Tracks_input& input)
      : input_(input), builder_(input.name, input.options.duplicates, "feature") {
    const Track_columns& columns = input.options.columns;
    if (!columns.x.empty() || !columns.y.empty() || !columns.radius.empty()) {
      fail("", "places in GeoJSON have no names; expected --columns t=NAME,id=NAME");
    }
    time_name_ = columns.t;
    id_name_ = columns.id;
  }

  Tracks_file read() {
    const json file = parsed(input_);
    const std::string type = type_of(file, "");
    std::string system;
    if (file.contains("crs")) system = reference_system(file["crs"]);
    if (system.empty()) {
      expect_projection(input_.name, 0, input_.options.projection, "places in GeoJSON are");
    }
    if (type == "FeatureCollection") {
      const json& features = member(file, "", "features", json::value_t::array);
      for (const json& feature : features) add_feature(feature, joined("/features/", feature_));
    } else if (type == "Feature") {
      add_feature(file, "");
    } else {
      fail("/type",
           joined("is ", kinetri::in_quotes(type), "; expected 'FeatureCollection' or 'Feature'"));
    }
    dates_.expect_none(input_.name, input_.options);
    Tracks_file result = builder_.finish();
    result.format = Tracks_format::geojson;
    result.rows_without_place = features_without_place_;
    if (!system.empty()) {
      const bool is_projected = input_.options.projection == Tracks_projection::local ||
                                input_.options.projection == Tracks_projection::utm;
      result.remarks.push_back(
          is_projected
              ? joined("places are degrees of the system ", system, ", as the projection says")
              : joined("places are taken as they are, in the system ", system));
    }
    if (has_third_) result.remarks.push_back("the third coordinate of the places is left out");
    return result;
  }

 private:
  // `pointer` is the position, a JSON pointer (RFC 6901).
  [[noreturn]] void fail(const std::string& pointer, const std::string& message) const {
    throw Input_error(input_.name, 0, pointer.empty() ? message : joined(pointer, ' ', message));
  }

  const json& member(const json& object, const std::string& pointer, const std::string& name,
                     json::value_t type) const {
    const auto found = object.is_object() ? object.find(name) : object.end();
    if (!object.is_object() || found == object.end() || found->type() != type) {
      fail(pointer, joined(pointer.empty() ? "the file has no " : "has no ",
                           type == json::value_t::array ? "list " : "object ",
                           kinetri::in_quotes(name), "; expected GeoJSON with one"));
    }
    return *found;
  }

  std::string type_of(const json& object, const std::string& pointer) const {
    const auto found = object.is_object() ? object.find("type") : object.end();
    if (!object.is_object() || found == object.end() || !found->is_string()) {
      fail(pointer, joined(pointer.empty() ? "the file has no type" : "has no type",
                           "; expected an object of GeoJSON"));
    }
    return found->get<std::string>();
  }

  // Of files before RFC 7946; empty for that of the standard, which is in degrees.
  std::string reference_system(const json& crs) const {
    if (crs.is_null()) return {};
    const json& properties = member(crs, "/crs", "properties", json::value_t::object);
    const auto name = properties.find("name");
    if (name == properties.end() || !name->is_string()) {
      fail("/crs/properties", "has no name; expected a reference system, or no crs");
    }
    std::string result = name->get<std::string>();
    const bool is_degrees = result.find("CRS84") != std::string::npos || is_geographic(result);
    return is_degrees ? std::string() : kinetri::in_quotes(result);
  }

  void add_feature(const json& feature, const std::string& pointer) {
    ++feature_;
    // Without a position (RFC 7946, section 3.2).
    if (feature.is_object() && feature.contains("geometry") && feature["geometry"].is_null()) {
      ++features_without_place_;
      return;
    }
    const json& geometry = member(feature, pointer, "geometry", json::value_t::object);
    const std::string type = type_of(geometry, pointer + "/geometry");
    const json& properties = member(feature, pointer, "properties", json::value_t::object);
    const json& coordinates =
        member(geometry, pointer + "/geometry", "coordinates", json::value_t::array);
    if (type == "Point") {
      if (time_name_.empty()) time_name_ = the_one(properties, names_of_times, "time", pointer);
      if (id_name_.empty()) id_name_ = the_one(properties, names_of_ids, "id", pointer);
      const std::string id = id_of(feature, pointer);
      add(id, member_of_any_type(properties, time_name_, pointer + "/properties"),
          pointer + "/properties/" + time_name_, coordinates, pointer + "/geometry/coordinates");
    } else if (type == "LineString") {
      add_line(feature, pointer, coordinates);
    } else {
      fail(pointer + "/geometry/type",
           joined("is ", kinetri::in_quotes(type), "; expected 'Point' or 'LineString'"));
    }
  }

  void add_line(const json& feature, const std::string& pointer, const json& coordinates) {
    const json& properties = feature["properties"];
    const json* times = nullptr;
    std::string times_pointer = pointer + "/properties";
    for (const std::string& name : {time_name_, std::string("coordTimes"), std::string("times")}) {
      if (name.empty() || times != nullptr || !properties.contains(name)) continue;
      times = &properties[name];
      times_pointer += '/' + name;
    }
    const auto of_coordinates = properties.find("coordinateProperties");
    if (times == nullptr && of_coordinates != properties.end() && of_coordinates->is_object() &&
        of_coordinates->contains("times")) {
      times = &(*of_coordinates)["times"];
      times_pointer += "/coordinateProperties/times";
    }
    if (times == nullptr) {
      fail(times_pointer,
           "has no times of a line; expected a list coordTimes or times, or --columns t=NAME");
    }
    if (!times->is_array() || times->size() != coordinates.size()) {
      fail(times_pointer, joined("is no list of ", coordinates.size(),
                                 " times; expected one for each place of the line"));
    }
    // A line is one track, whatever its name.
    const bool has_name = !id_name_.empty() || properties.contains("id") || feature.contains("id");
    const std::string kept = id_name_;
    if (id_name_.empty()) id_name_ = "id";
    const std::string id = has_name ? id_of(feature, pointer) : joined(feature_);
    id_name_ = kept;
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      add(id, (*times)[i], joined(times_pointer, '/', i), coordinates[i],
          joined(pointer, "/geometry/coordinates/", i));
    }
  }

  // The only one of the names that occurs.
  std::string the_one(const json& properties, std::span<const char* const> names,
                      std::string_view what, const std::string& pointer) const {
    std::string found;
    std::string all;
    std::size_t count = 0;
    for (const char* const name : names) {
      append(all, all.empty() ? "" : ", ", name);
      if (!properties.contains(name)) continue;
      ++count;
      found = name;
    }
    if (count == 1) return found;
    std::string there;
    for (const auto& [name, value] : properties.items()) {
      append(there, there.empty() ? "" : ", ", kinetri::in_quotes(name));
    }
    fail(pointer + "/properties",
         joined("has ", count == 0 ? "none" : "several", " of the names of a",
                what == "id" ? "n " : " ", what, ", ", all,
                "; expected --columns t=NAME,id=NAME with names of ",
                there.empty() ? "properties, of which there are none" : there));
  }

  const json& member_of_any_type(const json& object, const std::string& name,
                                 const std::string& pointer) const {
    const auto found = object.find(name);
    if (found == object.end())
      fail(pointer, joined("has no ", kinetri::in_quotes(name), "; expected one"));
    return *found;
  }

  std::string id_of(const json& feature, const std::string& pointer) const {
    const json& properties = feature["properties"];
    const bool is_of_feature =
        id_name_ == "id" && !properties.contains("id") && feature.contains("id");
    const json& id = member_of_any_type(is_of_feature ? feature : properties, id_name_,
                                        is_of_feature ? pointer : pointer + "/properties");
    if (id.is_number()) return id.dump();
    if (id.is_string() && !id.get_ref<const std::string&>().empty()) return id.get<std::string>();
    fail(pointer + "/properties/" + id_name_, "is no id; expected a text or a number");
  }

  void add(const std::string& id, const json& time, const std::string& time_pointer,
           const json& place, const std::string& place_pointer) {
    const auto is_null = [](const json& number) { return number.is_null(); };
    if (place.is_array() && std::all_of(place.begin(), place.end(), is_null)) {
      ++features_without_place_;
      return;
    }
    Tracks_row row;
    row.id = id;
    row.line = feature_;
    if (time.is_number()) {
      row.time.number = time.get<double>();
      dates_.note(time.dump());
    } else if (time.is_string()) {
      const Parsed_time read =
          parse_time(time.get_ref<const std::string&>(), time_pointer, input_.options);
      if (!read.problem.empty()) fail("", read.problem);
      row.time = read.value;
      dates_.note(time.get_ref<const std::string&>());
    } else {
      fail(time_pointer, "is no time; expected a number or a date");
    }
    const auto is_number = [](const json& number) { return number.is_number(); };
    if (!place.is_array() || place.size() < 2 ||
        !std::all_of(place.begin(), place.end(), is_number)) {
      fail(place_pointer, "is no place; expected a list of two numbers, or three");
    }
    has_third_ = has_third_ || place.size() > 2;
    row.place = {place[0].get<double>(), place[1].get<double>()};
    builder_.add(row);
  }

  const Tracks_input& input_;
  Tracks_builder builder_;
  Dates_of_digits dates_;
  std::string time_name_;
  std::string id_name_;
  std::size_t feature_ = 0;  // the number of the present one, from 1 on
  std::size_t features_without_place_ = 0;
  bool has_third_ = false;
};

}  // namespace

bool is_json(std::string_view head) {
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && (head[begin] == '{' || head[begin] == '[');
}

Tracks_file read_geojson(const Tracks_input& input) {
  return Geojson_reader(input).read();
}

}  // namespace kinetri
