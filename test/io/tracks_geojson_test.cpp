// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points and lines with times as GeoJSON.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "support/tracks_text.h"

namespace kinetri::tracks_geojson_test {
namespace {

using test::read_options;
using test::read_options_error;
using test::shown;

const Tracks_file_options as_they_are = {.projection = Tracks_projection::none};

std::string error_of(const std::string& text) {
  return read_options_error(text, as_they_are);
}

std::string collection(const std::string& features) {
  return "{\"type\": \"FeatureCollection\", \"features\": [" + features + "]}";
}

std::string feature(const std::string& type, const std::string& coordinates,
                    const std::string& properties) {
  return "{\"type\": \"Feature\", \"geometry\": {\"type\": \"" + type +
         "\", \"coordinates\": " + coordinates + "}, \"properties\": {" + properties + "}}";
}

std::string point(const std::string& coordinates, const std::string& properties) {
  return feature("Point", coordinates, properties);
}

TEST(Read_tracks_geojson, reads_points) {
  const Tracks_file file =
      read_options(collection(point("[8, 50]", R"("id": "Ada", "time": 0, "speed": 3)") + "," +
                              point("[1.5, -2, 100]", R"("id": 7, "time": 0.5)") + ",\n" +
                              point("[8.25, 50.5]", R"("time": 1e0, "id": "Ada")")),
                   as_they_are);
  EXPECT_EQ(shown(file), "Ada: 0 (8, 50) line 1 1 (8.25, 50.5) line 3; 7: 0.5 (1.5, -2) line 2");
  EXPECT_EQ(file.format, Tracks_format::geojson);
  EXPECT_EQ(file.place_name, "feature");
  EXPECT_EQ(file.remarks,
            std::vector<std::string>{"the third coordinate of the places is left out"});
  EXPECT_TRUE(read_options(collection(""), as_they_are).tracks.empty());
}

TEST(Read_tracks_geojson, reads_lines_with_times) {
  const std::string dates =
      R"(["2024-05-01T12:00:00Z", "2024-05-01T12:00:00.5Z", "2024-05-01T14:00:01+02:00"])";
  const std::string places = "[[8, 50], [8.5, 50], [9, 51]]";
  for (const std::string& times : {"\"coordTimes\": " + dates, "\"times\": " + dates,
                                   "\"coordinateProperties\": {\"times\": " + dates + "}"}) {
    const Tracks_file file =
        read_options(feature("LineString", places, "\"id\": \"Ada\", " + times), as_they_are);
    EXPECT_EQ(shown(file), "Ada: 0 (8, 50) line 1 0.5 (8.5, 50) line 1 1 (9, 51) line 1");
    EXPECT_EQ(file.origin, "2024-05-01T12:00:00Z");
    // Without a name, a line is known by its number.
    EXPECT_EQ(
        read_options(collection(feature("LineString", places, times)), as_they_are).tracks[0].id,
        "1");
  }
}

TEST(Read_tracks_geojson, properties_may_be_named) {
  const std::string text = collection(
      point("[8, 50]", R"("who": "Ada", "id": 1, "time": 0, "date": "2024-05-01")") + "," +
      point("[9, 50]", R"("who": "Ada", "id": 2, "time": 0, "date": "2024-05-02")"));
  Tracks_file_options options = as_they_are;
  EXPECT_EQ(error_of(text),
            "t.csv: /features/0/properties has several of the names of a time, t, time, timestamp, "
            "datetime, date; expected --columns t=NAME,id=NAME with names of 'date', 'id', 'time', "
            "'who'");
  options.columns = {.t = "date", .id = "who"};
  EXPECT_EQ(shown(read_options(text, options)), "Ada: 0 (8, 50) line 1 86400 (9, 50) line 2");
  options.columns.x = "lon";
  EXPECT_EQ(read_options_error(text, options),
            "t.csv: places in GeoJSON have no names; expected --columns t=NAME,id=NAME");
}

TEST(Read_tracks_geojson, degrees_are_refused_unless_the_file_has_another_system) {
  const std::string text = collection(point("[8, 50]", R"("id": "Ada", "time": 0)"));
  EXPECT_NE(read_options_error(text, {}).find(
                "t.csv: places in GeoJSON are in degrees of longitude and latitude"),
            std::string::npos);
  EXPECT_EQ(
      read_options(text, {.projection = Tracks_projection::local}).tracks[0].observations[0].place,
      (Vector_2{0, 0}));
  const auto with_system = [&](const std::string& name) {
    return "{\"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"" + name + "\"}}, " +
           text.substr(1);
  };
  const Tracks_file projected = read_options(with_system("urn:ogc:def:crs:EPSG::25832"), {});
  EXPECT_EQ(shown(projected), "Ada: 0 (8, 50) line 1");
  EXPECT_EQ(projected.remarks,
            std::vector<std::string>{
                "places are taken as they are, in the system 'urn:ogc:def:crs:EPSG::25832'"});
  EXPECT_NE(read_options_error(with_system("urn:ogc:def:crs:OGC:1.3:CRS84"), {}), "");
  for (const char* const number : {"4326", "4258", "4269", "4267", "7844"}) {
    EXPECT_NE(read_options_error(with_system(std::string("urn:ogc:def:crs:EPSG::") + number), {}),
              "")
        << number;
  }
  EXPECT_EQ(read_options_error(with_system("EPSG:4978"), {}), "");
  const Tracks_file asked =
      read_options(with_system("EPSG:25832"), {.projection = Tracks_projection::utm});
  EXPECT_EQ(asked.remarks.size(), 2U);
  for (const std::string& remark : asked.remarks) {
    EXPECT_EQ(remark.find("taken as they are"), std::string::npos) << remark;
  }
}

TEST(Read_tracks_geojson, errors_say_where) {
  const std::string good = point("[8, 50]", R"("id": "Ada", "time": 0)");
  for (
      const auto& [text, message] : {
          std::pair{std::string("{"),
                    "t.csv:1: is not valid JSON, or ends too early; expected GeoJSON, and all of "
                    "the file"},
          {collection(good).substr(0, 60) + "\n]",
           "t.csv:2: is not valid JSON, or ends too early; expected GeoJSON, and all of the file"},
          {"[1, 2]", "t.csv: the file has no type; expected an object of GeoJSON"},
          {"{\"type\": 5}", "t.csv: the file has no type; expected an object of GeoJSON"},
          {"{\"type\": \"Point\"}",
           "t.csv: /type is 'Point'; expected 'FeatureCollection' or 'Feature'"},
          {"{\"type\": \"FeatureCollection\"}",
           "t.csv: the file has no list 'features'; expected GeoJSON with one"},
          {collection(good + ", 5"),
           "t.csv: /features/1 has no object 'geometry'; expected GeoJSON with one"},
          {collection(feature("Polygon", "[]", "")),
           "t.csv: /features/0/geometry/type is 'Polygon'; expected 'Point' or 'LineString'"},
          {collection(point("[8, 50]", R"("time": 0, "k": 1)")),
           "t.csv: /features/0/properties has none of the names of an id, id, track_id, trackId, "
           "track, name; expected --columns t=NAME,id=NAME with names of 'k', 'time'"},
          {collection(good + "," + point("[8, 50]", R"("id": "Ada")")),
           "t.csv: /features/1/properties has no 'time'; expected one"},
          {collection(point("[8, 50]", R"("id": "Ada", "time": null)")),
           "t.csv: /features/0/properties/time is no time; expected a number or a date"},
          {collection(point("[8, 50]", R"("id": "Ada", "time": "noon")")),
           "t.csv: the column /features/0/properties/time is 'noon', which is not a number; "
           "expected a decimal or hexadecimal floating point number such as -1.5, 2e-3 or 0x1.8p3"},
          {collection(point("[8, 50]", R"("id": "", "time": 0)")),
           "t.csv: /features/0/properties/id is no id; expected a text or a number"},
          {collection(point("[8]", R"("id": 1, "time": 0)")),
           "t.csv: /features/0/geometry/coordinates is no place; expected a list of two numbers, "
           "or "
           "three"},
          {collection(point("[8, \"50\"]", R"("id": 1, "time": 0)")),
           "t.csv: /features/0/geometry/coordinates is no place; expected a list of two numbers, "
           "or "
           "three"},
          {collection(point("[8, 1e999]", R"("id": 1, "time": 0)")),
           "t.csv: has a number that is out of the range of binary64; expected 0, or a magnitude "
           "from 4.9e-324 to 1.8e308"},
          {collection(good + "," + point("[8, 51]", R"("id": "Ada", "time": 0)")),
           "t.csv: feature 2: id 'Ada' is at two places at t = 0: at (8, 51), and at (8, 50) in "
           "feature 1; expected one, or --duplicates first, last or mean, which says what to take"},
          {collection(feature("LineString", "[[8, 50]]", "")),
           "t.csv: /features/0/properties has no times of a line; expected a list coordTimes or "
           "times, or --columns t=NAME"},
          {collection(feature("LineString", "[[8, 50]]", "\"times\": [1, 2]")),
           "t.csv: /features/0/properties/times is no list of 1 times; expected one for each place "
           "of the line"},
          {collection(feature("LineString", "[[8, 50], [9]]", "\"times\": [1, 2]")),
           "t.csv: /features/0/geometry/coordinates/1 is no place; expected a list of two numbers, "
           "or three"},
          {collection(
               feature("LineString", "[[8, 50], [9, 50]]", "\"times\": [1, \"2024-05-01\"]")),
           "t.csv: feature 1: the time is a date, but a number in feature 1; expected one of the "
           "two"},
      }) {
    EXPECT_EQ(error_of(text), message);
  }
}

TEST(Read_tracks_geojson, deep_nesting_is_refused) {
  for (const std::string piece : {"[", "{\"a\":"}) {
    std::string deep;
    for (int i = 0; i < 1'000'000; ++i) deep += piece;
    EXPECT_EQ(read_options_error(deep, {.format = Tracks_format::geojson}),
              "t.csv: lists and objects are nested more than 100 deep; expected GeoJSON");
  }
}

}  // namespace
}  // namespace kinetri::tracks_geojson_test
