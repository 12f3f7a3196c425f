// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables whose columns the user names, dates as times, and degrees as places.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "kinetri/io/tracks_file.h"
#include "support/tracks_text.h"

namespace kinetri::tracks_table_test {
namespace {

using test::read_options;
using test::read_options_error;
using test::rows;
using test::rows_error;
using test::shown;

const Track_columns named = {.t = "time", .id = "name", .x = "E", .y = "N"};

Tracks_file table(const std::string& text) {
  return read_options(text, {.columns = named});
}
std::string table_error(const std::string& text) {
  return read_options_error(text, {.columns = named});
}

TEST(Read_tracks_table, recognizes_the_separator) {
  for (const std::string separator : {",", ";", "\t", " ", " , ", "  \t "}) {
    std::string text = "N|z|name|E|time\n2|x|a|1|0\n3|y|a|4|0.5\n";
    for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|')) {
      text.replace(i, 1, separator);
    }
    const Tracks_file file = table(text);
    EXPECT_EQ(shown(file), "a: 0 (1, 2) line 2 0.5 (4, 3) line 3") << "'" << separator << "'";
    EXPECT_EQ(file.format, Tracks_format::table);
    EXPECT_FALSE(file.has_radii);
  }
  // A comma in a name does not make a table one of commas.
  EXPECT_EQ(shown(read_options("time;a,b;E;N\n0;7,5;1;2\n",
                               {.columns = {.t = "time", .id = "a,b", .x = "E", .y = "N"}})),
            "7,5: 0 (1, 2) line 2");
  // Empty fields between tabs are fields.
  EXPECT_EQ(shown(table("time\tnote\tname\tE\tN\n0\t\ta\t1\t2\n1\t \ta\t1\t2\n")),
            "a: 0 (1, 2) line 2 1 (1, 2) line 3");
}

TEST(Read_tracks_table, understands_quotation_marks) {
  EXPECT_EQ(shown(table("\"time\",\"name\",\"E\",N\n0,\"a, \"\"b\"\"\",\"1\" , 2\n")),
            "a, \"b\": 0 (1, 2) line 2");
  EXPECT_EQ(shown(table("time name E N\n0 \"a man\" 1 2\n1 \"a man\" 3 4\n")),
            "a man: 0 (1, 2) line 2 1 (3, 4) line 3");
  // A line end belongs to the field; the row has the number of its first line.
  EXPECT_EQ(shown(table("time,name,E,N\r\n0,\"a\r\n\r\n#b\",1,2\r\n1,c,1,2\r\n")),
            "a\n\n#b: 0 (1, 2) line 2; c: 1 (1, 2) line 5");
  // Blanks are part of a quoted field; around an unquoted one they are dropped.
  EXPECT_EQ(shown(table("time,name,E,N\n0,\" a\",1,2\n0, a ,1,2\n")),
            " a: 0 (1, 2) line 2; a: 0 (1, 2) line 3");
  // A mark within a field is nothing special.
  EXPECT_EQ(shown(table("time,name,E,N\n0,5\" man,1,2\n")), "5\" man: 0 (1, 2) line 2");
}

TEST(Read_tracks_table, the_header_may_be_the_last_comment) {
  EXPECT_EQ(shown(table("# recorded in 2011\n# time name E N\n0 a 1 2\n1 a 1 2\n")),
            "a: 0 (1, 2) line 3 1 (1, 2) line 4");
}

TEST(Read_tracks_table, takes_radii_and_frames) {
  Tracks_file_options options = {.fps = 25, .columns = named};
  options.columns.radius = "size";
  const Tracks_file file = read_options("time,name,E,N,size\n10,a,1,2,0.5\n3,a,1,2,0.5\n", options);
  EXPECT_EQ(shown(file), "a: 0.12 (1, 2) line 3 0.4 (1, 2) line 2");
  EXPECT_TRUE(file.has_radii);
  EXPECT_EQ(file.tracks[0].radius, 0.5);
  EXPECT_EQ(file.frame_rate, 25);
  EXPECT_EQ(read_options_error("time,name,E,N,size\n10,a,1,2,-1\n", options),
            "t.csv:2: the radius -1 is negative; expected at least 0");
}

TEST(Read_tracks_table, errors_name_line_and_column) {
  for (const auto& [text, message] : {
           std::pair{"",
                     "1: the file is empty; expected a header line with the columns that "
                     "--columns names"},
           {"time,E,N\n", "1: the column 'name' is missing; expected one of 'time', 'E', 'N'"},
           {"0 1 2 3\n",
            "1: the column 'time' is missing; expected one of '0', '1', '2', '3', or, since these "
            "seem to be no names, the numbers of the columns, from 1 on, in --columns "
            "t=N,id=N,x=N,y=N"},
           {"time,name,E,N,E\n", "1: the column 'E' is named twice; expected names that differ"},
           {"time,name,E,N\n0,a,1\n",
            "2: the row has 3 fields; expected 4, one for each column of the header"},
           {"time,name,E,N\n0,a,,2\n", "2: the column E is empty; expected a number"},
           {"time,name,E,N\n,a,1,2\n", "2: the column time is empty; expected a number"},
           {"time,name,E,N\n0,a,1,north\n",
            "2: the column N is 'north', which is not a number; expected a decimal or hexadecimal "
            "floating point number such as -1.5, 2e-3 or 0x1.8p3"},
           {"time;name;E;N\n0;a;1,5;2\n",
            "2: the column E is '1,5', which has a decimal comma; expected a decimal point, as sed "
            "'s/,/./g' FILE makes of all commas"},
           {"time,name,E,N\n0,\"a\" b,1,2\n",
            "2: something stands behind a quoted field; expected ',' or the end of the row"},
           {"time,name,E,N\n0,\"a,1,2\n0,b,1,2\n",
            "2: a quotation mark is not closed; expected a second one in the same row, which may "
            "have 1000 lines and 1048576 bytes"},
           {"time,name,E,N\n0,a,1,2\n0,a,1,3\n",
            "3: id 'a' is at two places at t = 0: at (1, 3), and at (1, 2) in line 2; expected "
            "one, or --duplicates first, last or mean, which says what to take"},
       }) {
    EXPECT_EQ(table_error(text), std::string("t.csv:") + message);
  }
  EXPECT_EQ(read_options_error("t,id,x,y\n", {.columns = {.t = "t"}}),
            "t.csv: the column that is id is not named; expected --columns "
            "t=NAME,id=NAME,x=NAME,y=NAME with the names in the header");
  EXPECT_EQ(read_options_error("t,id,x,y\n", {.format = Tracks_format::rows, .columns = named}),
            "t.csv: is read in the format rows, whose columns have names already; expected no "
            "--columns, or --format table");
}

TEST(Read_tracks_table, many_open_quotation_marks_are_refused_quickly) {
  std::string text = "time,name,E,N\n0,\"";
  for (int i = 0; i < 100'000; ++i) text += ",a\"b,\"\n\"";
  EXPECT_NE(table_error(text), "");
  std::string lines = "time,name,E,N\n0,\"";
  for (int i = 0; i < 100'000; ++i) lines += "a\n";
  EXPECT_NE(table_error(lines).find("t.csv:2: a quotation mark is not closed"), std::string::npos);
}

// ---- dates ----

TEST(Read_tracks, dates_are_seconds_since_the_earliest) {
  const Tracks_file file = rows(
      "t,id,x,y\n2024-03-01T00:00:00Z,a,1,2\n2024-02-28T23:59:59.75Z,b,1,2\n"
      "2024-02-29T01:00:00.1+01:00,b,3,4\n");
  EXPECT_EQ(shown(file), "b: 0 (1, 2) line 3 0.35 (3, 4) line 4; a: 86400.2 (1, 2) line 2");
  EXPECT_EQ(file.tracks[0].observations[1].time, 0.35);
  EXPECT_EQ(file.tracks[1].observations[0].time, 86400.25);
  EXPECT_EQ(file.origin, "2024-02-28T23:59:59.75Z");
  EXPECT_EQ(file.remarks,
            std::vector<std::string>{
                "t = 0 is 2024-02-28T23:59:59.75Z, the earliest date; times are in seconds"});
  const Tracks_file local =
      table("time,name,E,N\n2024-05-01 12:00,a,1,2\n2024-05-01 12:01,a,3,4\n");
  EXPECT_EQ(shown(local), "a: 0 (1, 2) line 2 60 (3, 4) line 3");
  EXPECT_EQ(local.origin, "2024-05-01T12:00:00");
  EXPECT_EQ(local.remarks[0],
            "t = 0 is 2024-05-01T12:00:00, the earliest date, which has no time zone; times are in "
            "seconds");
}

TEST(Read_tracks, dates_and_numbers_do_not_mix) {
  EXPECT_EQ(rows_error("t,id,x,y\n2024-05-01,a,1,2\n5,a,1,2\n"),
            "t.csv:3: the time is a number, but a date in line 2; expected one of the two");
  EXPECT_EQ(rows_error("t,id,x,y\n5,a,1,2\n2024-05-01,b,1,2\n"),
            "t.csv:3: the time is a date, but a number in line 2; expected one of the two");
  EXPECT_EQ(rows_error("t,id,x,y\n2024-05-01T00:00Z,a,1,2\n2024-05-02,b,1,2\n"),
            "t.csv:3: the date has no time zone, but one in line 2; expected one for all dates or "
            "for none");
  EXPECT_EQ(rows_error("t,id,x,y\n2024-02-30,a,1,2\n"),
            "t.csv:2: the column t is '2024-02-30', which is a day that is not in the calendar; "
            "expected one that is");
  EXPECT_EQ(read_options_error("time,name,E,N\n2024-05-01,a,1,2\n", {.fps = 2, .columns = named}),
            "t.csv: times are dates, not frames; expected no --fps");
}

// ---- degrees ----

TEST(Read_tracks, degrees_are_refused_unless_a_projection_is_chosen) {
  const std::string text = "time,name,lon,lat\n0,a,8,50\n1,a,8.5,50.0625\n";
  Tracks_file_options options = {.columns = {.t = "time", .id = "name", .x = "lon", .y = "lat"}};
  EXPECT_NE(
      read_options_error(text, options)
          .find("t.csv: the columns 'lon' and 'lat' are places in degrees of longitude and "
                "latitude, between which distances mean nothing; expected --projection local"),
      std::string::npos);
  options.projection = Tracks_projection::none;
  EXPECT_EQ(shown(read_options(text, options)), "a: 0 (8, 50) line 2 1 (8.5, 50.0625) line 3");
  options.projection = Tracks_projection::local;
  const Tracks_file file = read_options(text, options);
  const auto& seen = file.tracks[0].observations;
  EXPECT_EQ(seen[0].place, (Vector_2{-seen[1].place.x, -seen[1].place.y}));
  // Degrees of longitude and latitude at 50.03125 degrees north, in meters.
  EXPECT_NEAR(seen[1].place.x, 71649.27 * 0.25, 0.01);
  EXPECT_NEAR(seen[1].place.y, 111229.67 * 0.03125, 0.01);
  EXPECT_EQ(file.remarks,
            (std::vector<std::string>{
                "places are degrees, as the columns 'lon' and 'lat' say",
                "places are in meters from the longitude 8.25 and the latitude 50.03125 "
                "(equirectangular projection of the ellipsoid of WGS 84); distances are off by at "
                "most 0.066 %"}));
  std::swap(options.columns.x, options.columns.y);
  EXPECT_EQ(read_options_error(text, options),
            "t.csv: x is the column 'lat', and y 'lon'; expected the longitude as x, and the "
            "latitude as y");
}

TEST(Read_tracks, degrees_must_be_places_on_earth) {
  const Tracks_file_options local = {.projection = Tracks_projection::local};
  EXPECT_EQ(read_options_error("t,id,x,y\n0,a,8,91\n", local),
            "t.csv:2: the longitude is 8, and the latitude 91; expected degrees from -180 to 180, "
            "and from -90 to 90");
  EXPECT_TRUE(read_options("t,id,x,y\n", local).tracks.empty());
}

// ---- times in several columns ----

std::string dated(const std::string& date, const std::string& time) {
  return "date,time,id,x,y\n" + date + "," + time + ",a,1,2\n";
}

TEST(Read_tracks_table, times_are_in_several_columns) {
  const Tracks_file_options options = {
      .columns = {.t = "date+time", .id = "id", .x = "x", .y = "y"}};
  const std::string text = dated("2024-05-01", "23:59:59.5") + "2024-05-02,00:00:00,a,3,4\n";
  const Tracks_file iso = read_options(text, options);
  EXPECT_EQ(shown(iso), "a: 0 (1, 2) line 2 0.5 (3, 4) line 3");
  EXPECT_EQ(iso.origin, "2024-05-01T23:59:59.5");
  EXPECT_EQ(iso.remarks.size(), 1U);  // the columns are used
  EXPECT_EQ(read_options(dated("2024-05-01", "12:00:00Z"), options).origin, "2024-05-01T12:00:00Z");
  Tracks_file_options german = options;
  german.date_format = "%d.%m.%Y %H:%M:%S";
  EXPECT_EQ(read_options(dated("1.5.2024", "12:00:00"), german).origin, "2024-05-01T12:00:00");
  // As many columns as there are, in any order.
  Tracks_file_options parts = {.columns = {.t = "m+d+Y+h", .id = "id", .x = "x", .y = "y"}};
  parts.date_format = "%m %d %Y %H";
  EXPECT_EQ(read_options("Y;m;d;h;id;x;y\n2024;5;1;12;a;1;2\n", parts).origin,
            "2024-05-01T12:00:00");
  // By numbers, and below a header that these skip.
  const Tracks_file_options numbers = {.columns = {.t = "1+2", .id = "3", .x = "4", .y = "5"}};
  EXPECT_EQ(shown(read_options("2024-05-01 10:00 a 1 2\n2024-05-01 10:01 a 1 3\n", numbers)),
            "a: 0 (1, 2) line 1 60 (1, 3) line 2");
  EXPECT_EQ(read_options(text, numbers).origin, "2024-05-01T23:59:59.5");
  // A row of units, and an id that begins with #.
  EXPECT_EQ(
      read_options("date,time,id,x,y\nUTC,h,,m,m\n2024-05-01,12:00,a,1,2\n", options).observations,
      1U);
  EXPECT_EQ(shown(read_options("id,date,time,x,y\n#1,2024-05-01,12:00,1,2\n", options)),
            "#1: 0 (1, 2) line 2");
}

TEST(Read_tracks_table, a_plus_sign_may_belong_to_a_name) {
  const Tracks_file_options options = {.columns = {.t = "a+b", .id = "id", .x = "x", .y = "y"}};
  EXPECT_EQ(shown(read_options("a,b,a+b,id,x,y\n1,2,3,i,5,6\n", options)), "i: 3 (5, 6) line 2");
  const Tracks_file_options place = {.columns = {.t = "t", .id = "id", .x = "x+", .y = "+y"}};
  EXPECT_EQ(shown(read_options("t,id,x+,+y\n1,i,5,6\n", place)), "i: 1 (5, 6) line 2");
  const Tracks_file_options end = {.columns = {.t = "t+", .id = "id", .x = "x", .y = "y"}};
  EXPECT_EQ(read_options_error("t,id,x,y\n1,i,5,6\n", end),
            "t.csv:1: the column 't+' is missing; expected one of 't', 'id', 'x', 'y'");
}

TEST(Read_tracks_table, errors_of_times_in_several_columns) {
  const Tracks_file_options options = {
      .columns = {.t = "date+time", .id = "id", .x = "x", .y = "y"}};
  const auto error = [&](const std::string& text) { return read_options_error(text, options); };
  // A date alone would be its midnight.
  EXPECT_EQ(error(dated("2024-05-01", "")),
            "t.csv:2: the column time is empty; expected a part of the time");
  EXPECT_EQ(error(dated("", "12:00")),
            "t.csv:2: the column date is empty; expected a part of the time");
  EXPECT_EQ(error("date,id,x,y\n2024-05-01,a,1,2\n"),
            "t.csv:1: the column 'time' is missing; expected one of 'date', 'id', 'x', 'y'");
  EXPECT_EQ(error("date,time,time,id,x,y\n"),
            "t.csv:1: the column 'time' is named twice; expected names that differ");
  EXPECT_EQ(error(dated("20240501", "120000")),
            "t.csv:2: the column date+time is '20240501 120000', which is a date, but not in ISO "
            "8601, as 2024-05-01T12:00:00Z is; expected that, or --date-format '%Y%m%d %H%M%S'");
  Tracks_file_options advised = options;
  advised.date_format = "%Y%m%d %H%M%S";
  EXPECT_EQ(read_options(dated("20240501", "120000"), advised).origin, "2024-05-01T12:00:00");
  EXPECT_NE(error(dated("1", "2")).find("the column date+time is '1 2', which is not a number"),
            std::string::npos);
}

}  // namespace
}  // namespace kinetri::tracks_table_test
