// SPDX-License-Identifier: GPL-3.0-or-later
//
// Recordings of which two meanings are possible: places that may be degrees, numbers that may be
// dates, columns that may be names of rows. Each is known, or refused with what answers.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "support/tracks_text.h"

namespace kinetri::tracks_doubts_test {
namespace {

using test::has_piece;
using test::read_options;
using test::read_options_error;
using test::shown;

// ---- places that may be degrees ----

// Two rows of one id, 60 units of time apart, under these names.
std::string slow_rows(const std::string& x, const std::string& y, const std::string& first = "0",
                      const std::string& second = "60") {
  return "t,id," + x + "," + y + "\n" + first + ",a,5.123456,60.123456\n" + second +
         ",a,5.133456,60.123456\n";
}

Tracks_file_options with_columns(const std::string& x, const std::string& y,
                                 Tracks_projection projection = Tracks_projection::refused) {
  return {.columns = {.t = "t", .id = "id", .x = x, .y = y}, .projection = projection};
}

// That the file is refused, and read with each of the two options that answer.
void expect_doubt(const std::string& text, const std::string& x, const std::string& y,
                  const std::string& why) {
  const std::string error = read_options_error(text, with_columns(x, y));
  EXPECT_TRUE(has_piece(error, "they look like degrees: " + why)) << error;
  EXPECT_TRUE(has_piece(error,
                        "expected --projection local or --projection utm if they are "
                        "longitude and latitude, or --projection none"))
      << error;
  for (const auto projection :
       {Tracks_projection::none, Tracks_projection::local, Tracks_projection::utm}) {
    EXPECT_EQ(read_options_error(text, with_columns(x, y, projection)), "");
  }
}

TEST(Read_tracks_doubts, names_of_wgs84_are_of_degrees) {
  for (const auto& [x, y] : {std::pair{"x_wgs84", "y_wgs84"},
                             {"X_4326", "Y_4326"},
                             {"WGS84_E", "WGS84_N"},
                             {"laenge", "breite"},
                             {"L\xC3\xA4nge", "Breite"},
                             {"lengtegraad", "breedtegraad"}}) {
    EXPECT_TRUE(has_piece(read_options_error(slow_rows(x, y), with_columns(x, y)),
                          "are places in degrees of longitude and latitude"))
        << x;
  }
  for (const auto& [x, y] : {std::pair{"x_wgs84_utm", "y_wgs84_utm"}, {"x_wgs84_m", "y_wgs84_m"}}) {
    EXPECT_EQ(read_options_error(slow_rows(x, y), with_columns(x, y)), "") << x;
  }
  EXPECT_TRUE(
      has_piece(read_options_error(slow_rows("breite", "laenge"), with_columns("breite", "laenge")),
                "expected the longitude as x, and the latitude as y"));
}

TEST(Read_tracks_doubts, names_that_are_often_of_degrees_are_asked_about) {
  for (const auto& [x, y] : {std::pair{"gps_x", "gps_y"},
                             {"geo_x", "geo_y"},
                             {"POINT_X", "POINT_Y"},
                             {"Xcoord", "Ycoord"},
                             {"lo", "la"}}) {
    expect_doubt(slow_rows(x, y), x, y,
                 "the columns are '" + std::string(x) + "' and '" + y + "', and numbers within");
  }
  // Who walks; other places; the unit.
  EXPECT_EQ(
      read_options_error(slow_rows("gps_x", "gps_y", "0", "0.01"), with_columns("gps_x", "gps_y")),
      "");
  EXPECT_EQ(read_options_error("t,id,gps_x,gps_y\n0,a,512345.1234,6012345.1234\n60,a,512345.2345,"
                               "6012345.1234\n",
                               with_columns("gps_x", "gps_y")),
            "");
  EXPECT_EQ(read_options_error(slow_rows("gps_x_m", "gps_y_m"), with_columns("gps_x_m", "gps_y_m")),
            "");
  EXPECT_EQ(read_options_error(slow_rows("x", "y"), with_columns("x", "y")), "");
}

TEST(Read_tracks_doubts, times_since_1970_are_of_a_known_unit) {
  for (const std::string zeros : {"", "000", "000000", "000000000"}) {
    const std::string text = slow_rows("x", "y", "1704067200" + zeros, "1704067260" + zeros);
    expect_doubt(text, "x", "y", "times are those since 1970");
    EXPECT_TRUE(has_piece(read_options_error(text, {}), "times are those since 1970"));
  }
  const std::string bare =
      "# frame id x y\n1704067200 a 5.123456 60.123456\n1704067260 a 5.133456 60.123456\n";
  EXPECT_TRUE(has_piece(read_options_error(bare, {}), "times are those since 1970"));
  EXPECT_EQ(read_options_error(bare, {.projection = Tracks_projection::utm}), "");
  // A walk, and numbers that are no such times.
  EXPECT_EQ(read_options_error(slow_rows("x", "y", "1704067200", "1704067200.01"), {}), "");
  EXPECT_EQ(read_options_error(slow_rows("x", "y", "100000000", "100000060"), {}), "");
}

TEST(Read_tracks_doubts, the_place_0_0_hides_no_degrees) {
  const std::string rows =
      "1704067200,a,0,0\n1704067201,a,5.123456,60.123456\n1704067202,a,0.0,0.0\n1704067260,a,"
      "5.133456,60.123456\n1704067270,a,0,0\n1704067271,a,0,0\n";
  expect_doubt("t,id,x,y\n" + rows, "x", "y", "times are those since 1970");
}

TEST(Read_tracks_doubts, the_place_0_0_is_none_where_all_others_are_far) {
  const auto placed = [](const std::string& places) { return "t,id,lon,lat\n" + places; };
  const auto read = [](const std::string& text) {
    return read_options(text, with_columns("lon", "lat", Tracks_projection::utm));
  };
  const Tracks_file file = read(placed("0,a,10,60\n1,a,0,0\n2,a,10.001,60\n3,b,0,0\n"));
  EXPECT_EQ(file.observations, 2U);
  ASSERT_EQ(file.tracks.size(), 1U);
  ASSERT_EQ(file.remarks.size(), 3U);
  EXPECT_EQ(file.remarks[1],
            "2 rows left out, at the longitude 0 and the latitude 0, which stand for no place "
            "where all others are farther than a degree from there (--projection none keeps them)");
  // What the summary advises.
  EXPECT_EQ(read_options(placed("0,a,10,60\n1,a,0,0\n"),
                         with_columns("lon", "lat", Tracks_projection::none))
                .observations,
            2U);
  // In the Gulf of Guinea they are places; and where there are no others.
  EXPECT_EQ(read(placed("0,a,0.5,0.5\n1,a,0,0\n")).observations, 2U);
  EXPECT_EQ(read(placed("0,a,0,0\n1,a,0,0\n")).observations, 2U);
}

#ifdef KINETRI_WITH_EXPAT

TEST(Read_tracks_doubts, sumo_without_its_comment_is_asked_about) {
  const auto sumo = [](const std::string& first, const std::string& second,
                       const std::string& comment = "") {
    return comment + "<fcd-export><timestep time='0'><vehicle id='a' " + first +
           "/></timestep>\n<timestep time='10'><vehicle id='a' " + second +
           "/></timestep></fcd-export>";
  };
  const std::string configured = "<!-- <configuration><output/></configuration> -->";
  for (const auto& [first, second, why] :
       {std::tuple{"x='13.4' y='52.5'", "x='13.401' y='52.5'", "things go"},
        {"x='13.400001' y='52.500001'", "x='13.400001' y='52.500001'", "most have four decimals"},
        {"x='13.4' y='52.5' speed='9'", "x='13.401' y='52.5' speed='9'", "things go 0.001"}}) {
    const std::string error = read_options_error(sumo(first, second), {});
    EXPECT_TRUE(has_piece(error, "the places look like degrees (fcd-output.geo)")) << error;
    EXPECT_TRUE(has_piece(error, why)) << error;
    for (const auto projection : {Tracks_projection::none, Tracks_projection::utm}) {
      EXPECT_EQ(read_options_error(sumo(first, second), {.projection = projection}), "");
    }
  }
  // Meters by speeds, by motion, by the size of the net, by the comment.
  for (const auto& [first, second] :
       {std::pair{"x='13' y='52' speed='1'", "x='23' y='52' speed='1'"},
        {"x='13.4' y='52.5'", "x='23.4' y='52.5'"},
        {"x='1340.4' y='52.5'", "x='1340.401' y='52.5'"},
        {"x='13.4' y='52.5'", "x='13.4' y='52.5'"}}) {
    EXPECT_EQ(read_options_error(sumo(first, second), {}), "") << first;
  }
  EXPECT_EQ(read_options_error(sumo("x='13.4' y='52.5'", "x='13.401' y='52.5'", configured), {}),
            "");
}

// ---- XML ----

TEST(Read_tracks_doubts, xml_that_is_no_utf8_is_named_with_what_makes_it) {
  const auto gpx = [](const std::string& declaration, const std::string& name) {
    return declaration + "<gpx><trk><name>" + name +
           "</name><trkseg><trkpt lat='55' lon='12'><time>2024-05-01T00:00:00Z</time></trkpt>"
           "</trkseg></trk></gpx>";
  };
  const Tracks_file_options none = {.projection = Tracks_projection::none};
  EXPECT_EQ(
      read_options_error(gpx("<?xml version='1.0' encoding=\"windows-1252\"?>", "\xC5"), none),
      "t.csv:1: is in the encoding 'windows-1252'; expected UTF-8, as iconv -f windows-1252 -t "
      "UTF-8 FILE | sed '1s/windows-1252/UTF-8/' makes of it");
  EXPECT_EQ(
      read_options_error(gpx("", "\xC5se"), none),
      "t.csv:1: has bytes that are not of UTF-8, and names no other encoding; expected UTF-8, "
      "as iconv -f WINDOWS-1252 -t UTF-8 FILE makes of it, with the encoding that it is in");
  EXPECT_EQ(
      read_options(gpx("<?xml version='1.0' encoding='ISO-8859-1'?>", "\xC5se"), none).tracks[0].id,
      "\xC3\x85se");
  EXPECT_EQ(read_options(gpx("", "\xC3\x85se"), none).tracks[0].id, "\xC3\x85se");
}

TEST(Read_tracks_doubts, frames_of_trackmate_need_an_interval_or_a_rate) {
  const auto tracks = [](const std::string& attributes) {
    return "<Tracks nTracks='1'" + attributes +
           "><particle><detection t='0' x='1' y='2' z='0'/><detection t='5' x='2' y='2' z='0'/>"
           "</particle></Tracks>";
  };
  const Tracks_file_options rate = {.fps = 10.0};
  for (const std::string attributes :
       {"", " frameInterval='0'", " frameInterval='-1'", " frameInterval='0.5'"}) {
    EXPECT_EQ(shown(read_options(tracks(attributes), rate)),
              "0: 0 (1, 2) line 1 0.5 (2, 2) line 1");
  }
  EXPECT_EQ(
      read_options_error(tracks(""), {}),
      "t.csv:1: the tracks have no frameInterval; expected one, or --fps, the frames in a unit "
      "of time");
  EXPECT_TRUE(has_piece(read_options_error(tracks(" frameInterval='0'"), {}),
                        "expected a number greater than 0, or --fps"));
}

#endif

// ---- numbers that may be dates, and times of day ----

TEST(Read_tracks_doubts, numbers_that_are_dates_are_refused) {
  for (const auto& [first, second, form] : {std::tuple{"20200131", "20200201", "%Y%m%d"},
                                            {"2020013123", "2020020100", "%Y%m%d%H"},
                                            {"202001312359", "202002010001", "%Y%m%d%H%M"}}) {
    const std::string text = "t,id,x,y\n" + std::string(first) + ",a,1,2\n" + second + ",a,3,4\n";
    const std::string expected = "t.csv: all times are numbers that look like dates, such as " +
                                 std::string(first) + "; expected --date-format '" + form +
                                 "' if they are, or, if they are numbers, at least one with a "
                                 "decimal point, as in " +
                                 first + ".0";
    EXPECT_EQ(read_options_error(text, {}), expected);
    EXPECT_EQ(read_options_error(text, with_columns("x", "y")), expected);
    EXPECT_EQ(read_options(text, {.date_format = form}).origin.substr(0, 10), "2020-01-31");
    const std::string number =
        "t,id,x,y\n" + std::string(first) + ".0,a,1,2\n" + second + ",a,3,4\n";
    EXPECT_EQ(read_options_error(number, {}), "");
  }
  // Before two places of one id on one day are.
  EXPECT_TRUE(has_piece(read_options_error("t,id,x,y\n20200131,a,1,2\n20200131,a,3,4\n", {}),
                        "all times are numbers that look like dates"));
  // One that is no date, and frames.
  EXPECT_EQ(read_options_error("t,id,x,y\n20200131,a,1,2\n20200132,a,3,4\n", {}), "");
  Tracks_file_options frames = with_columns("x", "y");
  frames.fps = 25;
  EXPECT_EQ(read_options_error("t,id,x,y\n20200131,a,1,2\n20200201,a,3,4\n", frames), "");
  const std::string features =
      R"({"type": "Feature", "properties": {"id": "a", "time": 20200131},
          "geometry": {"type": "Point", "coordinates": [8, 50]}})";
  EXPECT_TRUE(has_piece(read_options_error(features, {.projection = Tracks_projection::none}),
                        "all times are numbers that look like dates"));
}

TEST(Read_tracks_doubts, times_of_day_are_seconds_since_midnight_of_one_day) {
  const auto day = [](const std::string& first, const std::string& second) {
    return "t,id,x,y\n" + first + ",a,1,2\n" + second + ",a,3,4\n";
  };
  for (const auto& [first, second, form] : {std::tuple{"9:59:50", "10:00:00.5", "%H:%M:%S"},
                                            {"09:59", "10:00", "%H:%M"},
                                            {"11:59:50 AM", "12:00:10 PM", "%I:%M:%S %p"}}) {
    const std::string text = day(first, second);
    const std::string error = read_options_error(text, {});
    EXPECT_TRUE(has_piece(error,
                          "is a time of day without a date; expected dates with times, also "
                          "in two columns, as in --columns t=DATE+TIME, or --date-format '" +
                              std::string(form) + "'"))
        << error;
    EXPECT_TRUE(read_options(text, {.date_format = form}).origin.empty());
  }
  const Tracks_file file = read_options(day("00:00:10", "01:00:00.5"), {.date_format = "%T"});
  EXPECT_EQ(shown(file), "a: 10 (1, 2) line 2 3600.5 (3, 4) line 3");
  EXPECT_EQ(file.remarks.back(), "times are times of day, in seconds since midnight");
  EXPECT_EQ(read_options_error(day("095950", "100000"), {}),
            "t.csv: all times are numbers that look like times of day, such as 095950; expected "
            "--date-format '%H%M%S' if they are, or, if they are numbers, at least one with a "
            "decimal point, as in 095950.0");
  EXPECT_EQ(shown(read_options(day("095950", "100000"), {.date_format = "%H%M%S"})),
            "a: 35990 (1, 2) line 2 36000 (3, 4) line 3");
  EXPECT_EQ(read_options_error(day("115950", "120000"), {}), "");
  EXPECT_EQ(read_options_error(day("095950", "096000"), {}), "");
  EXPECT_EQ(read_options_error(day("000000", "000001"), {}), "");
  EXPECT_EQ(read_options_error(day("095950.0", "100000"), {}), "");
  EXPECT_EQ(read_options_error(day("23:59:50", "00:00:10"), {.date_format = "%H:%M:%S"}),
            "t.csv: times of day go back in 1 row, as they do past midnight; expected dates with "
            "them, also in two columns, as in --columns t=DATE+TIME, or rows of one day in the "
            "order of time");
  // With dates, as the message advises.
  EXPECT_EQ(shown(read_options("date,t,id,x,y\n2024-05-01,23:59:50,a,1,2\n2024-05-02,00:00:10,a,3,"
                               "4\n",
                               {.columns = {.t = "date+t", .id = "id", .x = "x", .y = "y"}})),
            "a: 0 (1, 2) line 2 20 (3, 4) line 3");
  for (const auto& [date, form] : {std::pair{"2024-05-01 9:59:50", "%Y-%m-%d %H:%M:%S"},
                                   {"2024-05-01 09:59:50 UTC", "%Y-%m-%d %H:%M:%S %Z"},
                                   {"2024-032", "%Y-%j"},
                                   {"13.02.24 10:00", "%d.%m.%y %H:%M"}}) {
    const std::string text = "t,id,x,y\n" + std::string(date) + ",a,1,2\n";
    EXPECT_TRUE(has_piece(read_options_error(text, {}),
                          "expected that, or --date-format '" + std::string(form) + "'"))
        << read_options_error(text, {});
    EXPECT_EQ(read_options_error(text, {.date_format = form}), "");
  }
}

// ---- rows ----

TEST(Read_tracks_doubts, names_of_rows_that_the_header_does_not_name) {
  const Tracks_file_options named = with_columns("x", "y");
  const std::string table =
      "\"t\" \"id\" \"x\" \"y\"\n\"1\" 0 \"A\" 1 2\n\"2\" 1 \"A\" 3 4\n\"3\" 0 \"B\" 5 6\n";
  const Tracks_file file = read_options(table, named);
  EXPECT_EQ(shown(file), "A: 0 (1, 2) line 2 1 (3, 4) line 3; B: 0 (5, 6) line 4");
  EXPECT_EQ(file.remarks,
            std::vector<std::string>{"the first column, which the header does not name, is left "
                                     "out"});
  EXPECT_EQ(shown(read_options("t;id;x;y;z\n\"a\";0;A;1;2;9\n\"b\";1;A;3;4;9\n", named)),
            "A: 0 (1, 2) line 2 1 (3, 4) line 3");
  // Without quotation marks the first field may be anything.
  for (const Tracks_file_options& options : {named, Tracks_file_options{}}) {
    EXPECT_TRUE(has_piece(read_options_error("t,id,x,y\n1,0,A,1,2\n2,1,A,3,4\n", options),
                          "t.csv:2: the row has 5 fields; expected 4, one for each column of the "
                          "header; if the first field is the name of a row, as R's write.table "
                          "writes it, expected a name for it in the header, and --columns"));
  }
  EXPECT_EQ(shown(read_options("row,t,id,x,y\n1,0,A,1,2\n2,1,A,3,4\n", named)),
            "A: 0 (1, 2) line 2 1 (3, 4) line 3");
  EXPECT_TRUE(has_piece(read_options_error(table + "\"4\" 1 \"B\" 7\n", named),
                        "t.csv:5: the row has 4 fields; expected 5"));
}

TEST(Read_tracks_doubts, a_comment_of_degrees_does_not_come_before_a_wrong_header) {
  const std::string rows = "0,a,5,60\n1,a,5.001,60\n";
  EXPECT_TRUE(has_piece(read_options_error("# lon lat\ntime,id,x,y\n" + rows, {}),
                        "unknown column 'time'; expected a header line"));
  EXPECT_TRUE(has_piece(read_options_error("# lon lat\nt,id,x,y\n" + rows, {}),
                        "t.csv:1: the comment says that places are in degrees"));
  EXPECT_TRUE(has_piece(read_options_error("t,id,x,y\n# lon lat\n" + rows, {}),
                        "t.csv:2: the comment says that places are in degrees"));
}

TEST(Read_tracks_doubts, rows_with_one_coordinate_by_a_word_are_no_observations) {
  const std::string text = "t,id,x,y\n0,a,1,2\n1,a,nan,2\n2,a,3,NA\n3,a,,\n4,a,5,6\n";
  for (const Tracks_file_options& options : {with_columns("x", "y"), Tracks_file_options{}}) {
    const Tracks_file file = read_options(text, options);
    EXPECT_EQ(shown(file), "a: 0 (1, 2) line 2 4 (5, 6) line 6");
    EXPECT_EQ(file.rows_without_place, 3U);
    EXPECT_EQ(read_options_error("t,id,x,y\n0,a,1,\n", options),
              "t.csv:2: the column y is empty; expected a number");
  }
  const Tracks_file bare = read_options("# id frame x y\na 0 1 2\na 1 nan 2\na 2 3 4\n", {});
  EXPECT_EQ(shown(bare), "a: 0 (1, 2) line 2 2 (3, 4) line 4");
}

TEST(Read_tracks_doubts, quoted_fields_of_rows_are_read_as_the_message_advises) {
  for (const std::string row : {"0,a,\"1\",2", "0,\"Ada, A.\",1,2"}) {
    const std::string text = "t,id,x,y\n" + row + "\n";
    EXPECT_TRUE(has_piece(read_options_error(text, {}),
                          "or --columns t=t,id=id,x=x,y=y, which reads quoted fields"));
    EXPECT_EQ(read_options_error(text, with_columns("x", "y")), "");
  }
}

TEST(Read_tracks_doubts, features_without_a_place_are_no_observations) {
  const auto feature = [](const std::string& geometry, int time) {
    return R"({"type": "Feature", "properties": {"id": "NaN \"NaN", "time": )" +
           std::to_string(time) + "}, \"geometry\": " + geometry + "}";
  };
  const auto point_at = [](const std::string& coordinates) {
    return R"({"type": "Point", "coordinates": )" + coordinates + "}";
  };
  const Tracks_file file = read_options(
      R"({"type": "FeatureCollection", "features": [)" + feature(point_at("[8, 50]"), 0) + "," +
          feature("null", 1) + "," + feature(point_at("[NaN, NaN]"), 2) + "," +
          feature(point_at("[]"), 3) + "," + feature(point_at("[8.5, 50]"), 4) + "]}",
      {.projection = Tracks_projection::none});
  EXPECT_EQ(shown(file), "NaN \"NaN: 0 (8, 50) line 1 4 (8.5, 50) line 5");
  EXPECT_EQ(file.rows_without_place, 3U);
  EXPECT_TRUE(has_piece(read_options_error(feature(point_at("[NaN, 50]"), 0),
                                           {.projection = Tracks_projection::none}),
                        "is no place; expected a list of two numbers, or three"));
}

}  // namespace
}  // namespace kinetri::tracks_doubts_test
