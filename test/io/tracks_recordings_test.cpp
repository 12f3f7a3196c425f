// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files as those write them who record: tables without a header, rows of units, rows without a
// place, several places at one time, ids that begin with #, dates in other forms, UTF-16, and
// periodic boxes.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "kinetri/io/points_file.h"
#include "kinetri/io/tracks_file.h"
#include "support/tracks_text.h"

namespace kinetri::tracks_recordings_test {
namespace {

using test::read_options;
using test::read_options_error;
using test::rows;
using test::shown;

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}
bool has_remark(const Tracks_file& file, const std::string& piece) {
  for (const std::string& remark : file.remarks) {
    if (contains(remark, piece)) return true;
  }
  return false;
}

const Track_columns numbers = {.t = "1", .id = "2", .x = "3", .y = "4"};
const Track_columns names = {.t = "t", .id = "id", .x = "x", .y = "y"};

// ---- numbers of columns ----

TEST(Read_tracks_numbers, of_columns_in_tables_without_a_header) {
  const std::string expected =
      "1: 1 (10, 20) line 1 2 (11, 20) line 2; 2: 1 (30, 20) line 3 2 (29, "
      "20) line 4";
  for (const auto& [text, columns] :
       {// MOT challenge.
        std::pair{std::string("1,1,10,20,5,9,1,-1,-1,-1\n2,1,11,20,5,9,1,-1,-1,-1\n"
                              "1,2,30,20,5,9,1,-1,-1,-1\n2,2,29,20,5,9,1,-1,-1,-1\n"),
                  numbers},
        // BIWI: frame id x z y and velocities.
        {std::string("1.0e0 1 10 0 20 1 0 0\n2 1 11 0 20 1 0 0\n1 2 30 0 20 1 0 0\n2 2 29 0 20 1 0 "
                     "0\n"),
         Track_columns{.t = "1", .id = "2", .x = "3", .y = "5"}},
        {std::string("20;10;1;1\n20;11;1;2\n20;30;2;1\n20;29;2;2\n"),
         Track_columns{.t = "4", .id = "3", .x = "2", .y = "1"}},
        {std::string("x\t1\t1\t10\t20\nx\t2\t1\t11\t20\nx\t1\t2\t30\t20\nx\t2\t2\t29\t20\n"),
         Track_columns{.t = "2", .id = "3", .x = "4", .y = "5"}},
        {std::string("\"1\",\"1\",10,20\n2,1,11,20\n1,2,30,20\n2,2,29,20\n"), numbers},
        {std::string("1, 1, 10, 20\n2, 1, 11, 20\n1, 2, 30, 20\n2, 2, 29, 20\n"), numbers}}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(shown(read_options(text, {.columns = columns})), expected);
  }
}

TEST(Read_tracks_numbers, skip_a_header_and_say_so) {
  const Tracks_file file =
      read_options("frame,track,left,top\n1,1,10,20\n2,1,11,20\n", {.columns = numbers});
  EXPECT_EQ(shown(file), "1: 1 (10, 20) line 2 2 (11, 20) line 3");
  EXPECT_TRUE(has_remark(file, "1 row without numbers below or in place of the header left out"));
}

TEST(Read_tracks_numbers, must_be_there) {
  EXPECT_EQ(
      read_options_error("1,2,3\n", {.columns = numbers}),
      "t.csv:1: the row has fewer than 4 fields; expected as many as the numbers in --columns "
      "need, separated by commas, semicolons, tabs or blanks");
  EXPECT_EQ(read_options_error("1,2,3,4\n1,2,3\n", {.columns = numbers}),
            "t.csv:2: the row has 3 fields; expected 4, as the first row has");
  EXPECT_TRUE(contains(read_options_error("", {.columns = numbers}), "the file is empty"));
  // Names that are not there, in a table without names.
  EXPECT_TRUE(contains(read_options_error("0 1 2 3\n", {.columns = names}),
                       "the numbers of the columns, from 1 on, in --columns t=N,id=N,x=N,y=N"));
}

TEST(Read_tracks_numbers, columns_that_are_not_used_are_named_or_counted) {
  EXPECT_TRUE(
      has_remark(read_options("1,2,3,4,5,6\n", {.columns = numbers}), "2 columns not used"));
  EXPECT_TRUE(has_remark(read_options("t,id,x,y,z,speed\n0,a,1,2,3,4\n", {.columns = names}),
                         "columns that are not used: 'z', 'speed'"));
}

// ---- rows of many numbers without names ----

TEST(Read_tracks_bare, rows_of_more_than_four_numbers_are_refused) {
  for (const char* const text :
       {"780.0 1.0 8.46 0.0 3.58 1.67 0.0 0.31\n", "0 0 0.00 0.00 0\n",
        "7 8 2 3 1.7\n7 16 4 5 1.7\n", "1 7 0 0 9\n2 7 0 0 9\n3 7 0 0 9\n",
        "# framerate: 25\n1 7 0 0 9\n", "0 -1 23.5 50.2 10.0 80.1 0 1 0 Car\n"}) {
    const std::string error = read_options_error(text, {});
    EXPECT_TRUE(contains(error,
                         "and nothing says what they are; expected --format table --columns "
                         "t=N,id=N,x=N,y=N, with the number of each column, from 1 on"))
        << error;
    EXPECT_EQ(read_options_error(text, {.format = Tracks_format::table, .columns = numbers}), "");
    EXPECT_EQ(read_options_error("# id frame x y z\n" + std::string(text), {.fps = 25.0}), "");
  }
  // What --format names is read.
  EXPECT_EQ(shown(read_options("7 8 2 3 1.7\n7 16 4 5 1.7\n", {.format = Tracks_format::ids})),
            "7: 8 (2, 3) line 1 16 (4, 5) line 2");
}

TEST(Read_tracks_bare, commas_are_told_where_blanks_are_expected) {
  for (const Tracks_format format : {Tracks_format::frames, Tracks_format::ids}) {
    EXPECT_TRUE(contains(read_options_error("1,1,10,20\n", {.format = format}),
                         "the row has commas or semicolons; expected fields that are separated by "
                         "tabs or blanks, or --format table --columns t=N,id=N,x=N,y=N"));
  }
}

// ---- units, and rows without a place or an id ----

TEST(Read_tracks_units, below_the_header_are_left_out) {
  for (const char* const units :
       {"s,,m,m\n", "\"s\",\"\",\"m\",\"m\"\n", "(sec),-,(pixel),(pixel)\n",
        "T,Label,X,Y\nsec,,um,um\n", "time,name,,\n", "[s],[],[m],[m]\n"}) {
    SCOPED_TRACE(units);
    const Tracks_file file = read_options("t,id,x,y\n" + std::string(units) + "0,a,1,2\n1,a,3,4\n",
                                          {.format = Tracks_format::table, .columns = names});
    EXPECT_EQ(file.observations, 2U);
    EXPECT_TRUE(has_remark(file, "without numbers below or in place of the header left out"));
  }
  EXPECT_TRUE(has_remark(rows("t,id,x,y\ns,,m,m\n0,a,1,2\n"), "1 row without numbers below"));
  // Further down it is no unit.
  EXPECT_NE(test::rows_error("t,id,x,y\n0,a,1,2\ns,,m,m\n"), "");
}

TEST(Read_tracks_missing, places_are_counted) {
  for (const char* const missing :
       {",", "NaN,NaN", "nan,nan", "NA,NA", "null,NULL", "None,None", "N/A,N/A", "\\N,\\N"}) {
    SCOPED_TRACE(missing);
    const std::string text = "t,id,x,y\n0,a,1,2\n1,a," + std::string(missing) + "\n2,a,3,4\n";
    for (const Tracks_file& file :
         {rows(text), read_options(text, {.format = Tracks_format::table, .columns = names})}) {
      EXPECT_EQ(shown(file), "a: 0 (1, 2) line 2 2 (3, 4) line 4");
      EXPECT_EQ(file.rows_without_place, 1U);
    }
  }
  EXPECT_EQ(
      read_options("0 a 1 2\n1 a nan nan\n", {.format = Tracks_format::frames}).rows_without_place,
      1U);
  // Half of a place is a mistake.
  EXPECT_EQ(test::rows_error("t,id,x,y\n0,a,1,\n"),
            "t.csv:2: the column y is empty; expected a number");
}

TEST(Read_tracks_missing, ids_of_a_table_are_counted) {
  const Tracks_file file = read_options("t,id,x,y\n0,a,1,2\n1,,3,4\n",
                                        {.format = Tracks_format::table, .columns = names});
  EXPECT_EQ(file.rows_without_id, 1U);
  EXPECT_EQ(file.observations, 1U);
}

// ---- ids that begin with # ----

TEST(Read_tracks_hash, begins_ids_where_the_rest_is_a_row) {
  const std::string expected = "#1: 0 (0, 0) line 2 10 (10, 0) line 3; 3: 0 (0, 9) line 4";
  const std::string text = "id,t,x,y\n#1,0,0,0\n#1,10,10,0\n3,0,0,9\n# no row\n#4,a,b,c\n";
  for (const Tracks_file& file :
       {rows(text), read_options(text, {.format = Tracks_format::table, .columns = names})}) {
    EXPECT_EQ(shown(file), expected);
    EXPECT_EQ(file.comment_lines, 2U);
  }
  // Where the first column is a number, # is no part of it.
  EXPECT_EQ(rows("t,id,x,y\n#0,a,0,0\n0,b,0,0\n").comment_lines, 1U);
  EXPECT_EQ(shown(read_options("#1 0 0 0\n#1 1 1 0\n#2 0 0 5\n", {})),
            "#1: 0 (0, 0) line 1 1 (1, 0) line 2; #2: 0 (0, 5) line 3");
  const Tracks_file frames = read_options("0 a 1 2\n#0 a 5 5\n", {.format = Tracks_format::frames});
  EXPECT_EQ(frames.observations, 1U);
  EXPECT_EQ(frames.comment_lines, 1U);
  // Numbers of columns.
  EXPECT_EQ(shown(read_options("#7,0,1,2\n#7,1,3,4\n",
                               {.columns = {.t = "2", .id = "1", .x = "3", .y = "4"}})),
            "#7: 0 (1, 2) line 1 1 (3, 4) line 2");
}

TEST(Read_points_hash, begins_labels_where_the_rest_is_a_row) {
  std::istringstream in("id,x,y,vx,vy\n#1,0,0,1,1\n# two\n#2,5,0,1,1\n");
  const Points_file file = read_points(in, "p.csv");
  EXPECT_EQ(file.labels, (std::vector<std::string>{"#1", "#2"}));
  EXPECT_EQ(file.comment_lines, 1U);
}

// ---- points in space ----

std::string points_problem(const std::string& text) {
  std::istringstream in(text);
  return test::message_of<Input_error>([&] { read_points(in, "p.csv"); });
}

TEST(Read_points_in_space, are_refused_unless_they_are_in_one_plane) {
  EXPECT_EQ(points_problem("x,y,z,vx,vy,vz\n0,0,0,1,1,0\n5,0,3,1,1,0\n"),
            "p.csv:3: the column z is 3, but 0 in line 2, and points move in the plane of x and y; "
            "expected one z for all, or no columns z and vz");
  EXPECT_TRUE(contains(points_problem("x,y,z,vx,vy,vz\n0,0,0,1,1,0\n5,0,0,1,1,2\n"),
                       "the column vz is 2, but 0 in line 2"));
  EXPECT_TRUE(contains(points_problem("x,y,z,vx,vy\n0,0,0,1,1\n"),
                       "the column vz is missing; expected both z and vz, or neither"));
  std::istringstream in("x,y,z,vx,vy,vz\n0,0,2,1,1,0\n5,0,2,1,1,0\n");
  EXPECT_EQ(read_points(in, "p.csv").ignored_columns, (std::vector<std::string>{"'z'", "'vz'"}));
}

TEST(Read_tracks_in_space, name_the_third_coordinate) {
  EXPECT_TRUE(has_remark(rows("t,id,x,y,z\n0,a,1,2,3\n"), "the column z, is left out"));
}

// ---- several places at one time ----

TEST(Read_tracks_duplicates, are_merged_as_asked) {
  const std::string text = "t,id,x,y\n0,a,0,0\n60,a,10,0\n60,a,12,3\n60,a,10,0\n120,a,20,0\n";
  const auto read = [&](Tracks_duplicates duplicates) {
    return read_options(text, {.duplicates = duplicates});
  };
  EXPECT_EQ(shown(read(Tracks_duplicates::first)),
            "a: 0 (0, 0) line 2 60 (10, 0) line 3 120 (20, 0) "
            "line 6");
  EXPECT_EQ(shown(read(Tracks_duplicates::last)),
            "a: 0 (0, 0) line 2 60 (10, 0) line 5 120 (20, 0) "
            "line 6");
  EXPECT_EQ(shown(read(Tracks_duplicates::mean)),
            "a: 0 (0, 0) line 2 60 (11, 1.5) line 3 120 (20, "
            "0) line 6");
  EXPECT_EQ(read(Tracks_duplicates::mean).rows_at_another_place, 1U);
  EXPECT_EQ(read(Tracks_duplicates::mean).doubled_rows, 1U);
  // Without the option, one time in three is merged, and one in two is refused.
  EXPECT_EQ(shown(rows(text)), shown(read(Tracks_duplicates::first)));
  EXPECT_EQ(rows(text).rows_at_another_place, 1U);
  const std::string error = test::rows_error("t,id,x,y\n0,a,0,0\n60,a,10,0\n60,a,12,3\n");
  EXPECT_EQ(error,
            "t.csv:4: id 'a' is at two places at t = 60: at (12, 3), and at (10, 0) in line 3; "
            "expected one, or --duplicates first, last or mean, which says what to take");
  EXPECT_EQ(read_options_error(text, {.duplicates = Tracks_duplicates::refuse}), error);
}

TEST(Read_tracks_duplicates, of_two_things_with_one_id_are_refused) {
  EXPECT_NE(test::rows_error("t,id,x,y\n0,a,0,0\n0,a,9,9\n1,a,1,0\n1,a,8,9\n2,a,2,0\n"), "");
}

// ---- dates ----

TEST(Read_tracks_dates, in_other_forms_are_read_as_asked) {
  for (const auto& [format, first, second] :
       {std::tuple{"%d/%m/%Y %H:%M:%S", "05/03/2023 00:00:00", "05/03/2023 00:00:10"},
        {"%m/%d/%Y %H:%M:%S", "03/05/2023 00:00:00", "03/05/2023 00:00:10.0"},
        {"%d.%m.%y %H:%M:%S", "05.03.23 00:00:00", "5.3.23 0:00:10"},
        {"%Y%m%d%H%M%S", "20230305000000", "20230305000010"},
        {"%m/%d/%Y %I:%M:%S %p", "3/5/2023 12:00:00 AM", "3/5/2023 12:00:10 am"},
        {"%d %b %Y %H:%M:%S", "05 Mar 2023 00:00:00", "5 march 2023 00:00:10"},
        {"%Y-%j %H:%M:%S", "2023-064 00:00:00", "2023-064 00:00:10"},
        {"%a %b %d %H:%M:%S %Z %Y", "Sun Mar 05 00:00:00 UTC 2023", "Sun Mar  5 00:00:10 UTC 2023"},
        {"%Y/%m/%dT%T%z", "2023/03/05T01:00:00+01:00", "2023/03/05T00:00:10Z"},
        {"%H:%M:%S,%f %d-%m-%Y", "00:00:00,0 05-03-2023", "00:00:10,000 05-03-2023"},
        {"%A, %D %R:%S", "Sunday, 03/05/23 00:00:00", "Sunday, 03/05/23 00:00:10"}}) {
    SCOPED_TRACE(format);
    EXPECT_EQ(problem_of_date_format(format), "");
    const Tracks_file file =
        read_options("t;id;x;y\n" + std::string(first) + ";a;1;2\n" + second + ";a;3;4\n",
                     {.format = Tracks_format::table, .columns = names, .date_format = format});
    EXPECT_EQ(shown(file), "a: 0 (1, 2) line 2 10 (3, 4) line 3");
    EXPECT_TRUE(file.origin.starts_with("2023-03-05T00:00:00")) << file.origin;
  }
}

TEST(Read_tracks_dates, that_do_not_fit_the_form_are_errors) {
  for (const char* const date :
       {"32/01/2023 00:00", "30/02/2023 00:00", "01/13/2023 00:00", "01/01/2023",
        "01/01/2023 24:00", "01/01/2023 00:00 x", "5", "1/1/23 00:00"}) {
    EXPECT_NE(read_options_error("t,id,x,y\n" + std::string(date) + ",a,1,2\n",
                                 {.date_format = "%d/%m/%Y %H:%M"}),
              "")
        << date;
  }
  for (const char* const format : {"", "%m %H:%M", "%d/%m", "%Y-%m-%d %I:%M", "%Y-%m-%d %Q",
                                   "%Y-%m-%d %", "%Y-%m-%d %S", "%Y %Y-%m-%d", "%Y-%m-%d %M"}) {
    EXPECT_NE(problem_of_date_format(format), "") << format;
  }
}

TEST(Read_tracks_dates, the_message_about_another_form_gives_an_option_that_works) {
  for (const char* const date :
       {"05/03/2023 00:00:00", "5/3/2023 0:00", "05.03.2023 00:00:00", "2023/03/05 00:00:00",
        "20230305T000000Z", "20230305000000", "03/05/2023 12:00:00 AM", "05 Mar 2023 00:00:00",
        "05/03/2023", "05-Mar-2023 00:00:00", "Sun Mar 5 00:00:00 2023"}) {
    SCOPED_TRACE(date);
    const std::string text = "t,id,x,y\n" + std::string(date) + ",a,1,2\n";
    const std::string error = read_options_error(text, {});
    EXPECT_TRUE(contains(error, "is a date, but not in ISO 8601")) << error;
    const std::string option = "--date-format '";
    for (std::size_t at = error.find(option); at != std::string::npos;
         at = error.find(option, at)) {
      at += option.size();
      const std::string format = error.substr(at, error.find('\'', at) - at);
      EXPECT_EQ(read_options_error(text, {.date_format = format}), "") << format;
    }
  }
}

TEST(Read_tracks_dates, that_no_form_fits_are_told_which_forms_there_are) {
  EXPECT_EQ(
      test::rows_error("t,id,x,y\n12:00:01:05,a,1,2\n"),
      "t.csv:2: the column t is '12:00:01:05', which is neither a number nor a date in ISO 8601, "
      "as 2024-05-01T12:00:00Z is; expected one of the two, or --date-format for dates in "
      "another form");
}

TEST(Read_tracks_dates, the_header_of_a_comment_is_named_with_or_without_its_sign) {
  const std::string text =
      "# Timestamp,MMSI,Latitude,Longitude\n"
      "05/03/2023 00:00:00,1,55.0,12.0\n05/03/2023 00:10:00,1,55.02,12.0\n";
  for (const char* const time : {"Timestamp", "# Timestamp"}) {
    const Tracks_file file =
        read_options(text, {.columns = {.t = time, .id = "MMSI", .x = "Longitude", .y = "Latitude"},
                            .projection = Tracks_projection::none,
                            .date_format = "%d/%m/%Y %H:%M:%S"});
    EXPECT_EQ(shown(file), "1: 0 (12, 55) line 2 600 (12, 55.02) line 3");
    EXPECT_EQ(file.comment_lines, 0U);
  }
  // The names in the message are those of the comment.
  EXPECT_TRUE(contains(read_options_error(text, {.columns = names}),
                       "expected one of 'Timestamp', 'MMSI', 'Latitude', 'Longitude'"));
}

// ---- UTF-16 ----

std::string utf16(const std::u16string& text, bool is_big, bool has_mark = true) {
  std::string result;
  for (const char16_t unit : (has_mark ? u"\xFEFF" : u"") + text) {
    const char high = static_cast<char>(unit >> 8U);
    const char low = static_cast<char>(unit & 0xFFU);
    result += is_big ? high : low;
    result += is_big ? low : high;
  }
  return result;
}

TEST(Read_utf16, is_read_as_utf8) {
  const std::u16string text = u"t,id,x,y\r\n0,\u00E4\u4E2D\U0001F600,1,2\r\n1,b,2,2\r\n";
  for (const bool is_big : {false, true}) {
    for (const bool has_mark : {false, true}) {
      const Tracks_file file = read_options(utf16(text, is_big, has_mark), {});
      EXPECT_EQ(shown(file),
                "\xC3\xA4\xE4\xB8\xAD\xF0\x9F\x98\x80: 0 (1, 2) line 2; b: 1 (2, 2) "
                "line 3");
      EXPECT_TRUE(has_remark(file, "UTF-16"));
    }
  }
  std::istringstream points(utf16(u"x,y,vx,vy\n1,2,3,4\n", false));
  EXPECT_EQ(read_points(points, "p.csv").motions.size(), 1U);
  // Cut in the middle of a character.
  EXPECT_NE(read_options_error(utf16(u"t,id,x,y\n0,a,1,2", false) + "3", {}), "");
  // Longer than a buffer.
  std::u16string many = u"t,id,x,y\n";
  for (int i = 0; i < 20000; ++i) many += u"0,a,1,2\n";
  EXPECT_EQ(read_options(utf16(many, true), {}).doubled_rows, 19999U);
}

// ---- LAMMPS, XYZ ----

std::string frame(const std::string& head, const std::string& atom) {
  return head +
         "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n0 1\nITEM: ATOMS id "
         "x y\n" +
         atom + "\n";
}

TEST(Read_tracks_lammps_times, stand_before_or_behind_the_timestep) {
  const std::string before = frame("ITEM: UNITS\nlj\nITEM: TIME\n0\nITEM: TIMESTEP\n0\n", "1 1 1") +
                             frame("ITEM: TIME\n0.5\nITEM: TIMESTEP\n100\n", "1 2 1") +
                             frame("ITEM: TIME\n0.75\nITEM: TIMESTEP\n300\n", "1 3 1");
  const std::string behind = frame("ITEM: TIMESTEP\n0\nITEM: TIME\n0\n", "1 1 1") +
                             frame("ITEM: TIMESTEP\n100\nITEM: TIME\n0.5\n", "1 2 1") +
                             frame("ITEM: TIMESTEP\n300\nITEM: TIME\n0.75\n", "1 3 1");
  for (const std::string& text : {before, behind}) {
    const Tracks_file file = read_options(text, {});
    ASSERT_EQ(file.tracks.size(), 1U);
    std::vector<double> times;
    for (const auto& seen : file.tracks[0].observations) times.push_back(seen.time);
    EXPECT_EQ(times, (std::vector<double>{0, 0.5, 0.75}));
    EXPECT_TRUE(has_remark(file, "times are those of ITEM: TIME"));
  }
  EXPECT_TRUE(contains(read_options_error("ITEM: TIME\n0\nITEM: TIME\n1\n", {}), "twice"));
  EXPECT_TRUE(contains(read_options_error("ITEM: TIMESTEP\n0\nITEM: TIMESTEP\n1\n", {}), "twice"));
  EXPECT_TRUE(contains(read_options_error(before + "ITEM: TIME\n1\n", {}),
                       "ends in the middle of a frame"));
}

TEST(Read_tracks_xyz_times, are_those_that_programs_write) {
  for (const auto& [first, second] :
       {std::pair{"Atoms. Timestep: 0 Time: 0.000000", "Atoms. Timestep: 100 Time: 0.500000"},
        {" i = 0, time = 0.000, E = -17.1", " i = 1, time = 0.500, E = -17.2"},
        {"Time=0 Properties=species:S:1:pos:R:3", "Time=0.5 Properties=species:S:1:pos:R:3"},
        {"water t= 0.0 step= 0", "water t= 0.5 step= 100"},
        {"energy=-1 time=0", "energy=-2 time=0.5"}}) {
    SCOPED_TRACE(first);
    const Tracks_file file =
        read_options("1\n" + std::string(first) + "\nAr 1 2 0\n1\n" + second + "\nAr 3 4 0\n", {});
    EXPECT_EQ(shown(file), "0: 0 (1, 2) line 3 0.5 (3, 4) line 6");
    EXPECT_FALSE(file.frame_rate);
  }
}

TEST(Read_tracks_unwrap, goes_on_to_the_nearest_image) {
  const auto dump = [](const std::vector<std::string>& places) {
    std::string result;
    for (std::size_t i = 0; i < places.size(); ++i) {
      result += frame("ITEM: TIMESTEP\n" + std::to_string(i) + "\n", "1 " + places[i]);
    }
    return result;
  };
  const Tracks_file_options nearest = {.unwrap = Tracks_unwrap::nearest};
  // To the right and up around the corner, twice, and back.
  const Tracks_file file = read_options(dump({"8 9", "1 1", "4 4", "8 8", "2 1", "9 9"}), nearest);
  std::vector<Vector_2> places;
  for (const auto& seen : file.tracks[0].observations) places.push_back(seen.place);
  EXPECT_EQ(places,
            (std::vector<Vector_2>{{8, 9}, {11, 11}, {14, 14}, {18, 18}, {22, 21}, {19, 19}}));
  EXPECT_TRUE(has_remark(file, "nearest image"));
  const std::string refused = read_options_error(dump({"8 9", "1 9"}), {});
  EXPECT_TRUE(contains(refused, "or --unwrap nearest")) << refused;
  EXPECT_TRUE(contains(read_options_error(dump({"0 0", "5 0"}), nearest), "equally near"));
  EXPECT_EQ(read_options_error("t,id,x,y\n0,a,1,2\n", nearest),
            "t.csv: has no periodic box; expected no --unwrap");
  const std::string xyz =
      "1\nLattice=\"10 0 0 0 10 0 0 0 10\" pbc=\"T T T\"\nAr 9 5 0\n"
      "1\nLattice=\"10 0 0 0 10 0 0 0 10\" pbc=\"T T T\"\nAr 1 5 0\n";
  EXPECT_EQ(shown(read_options(xyz, nearest)), "0: 0 (9, 5) line 3 1 (11, 5) line 6");
  EXPECT_TRUE(contains(read_options_error("1\n\nAr 9 5 0\n1\n\nAr 1 5 0\n", nearest),
                       "expected no --unwrap"));
}

}  // namespace
}  // namespace kinetri::tracks_recordings_test
