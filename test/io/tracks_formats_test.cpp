// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which format the content of a file shows, and what is refused since it shows none, or two.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "support/precondition_error.h"
#include "support/temporary_directory.h"
#include "support/tracks_text.h"

namespace kinetri::tracks_formats_test {
namespace {

using test::frames;
using test::read_options;
using test::read_options_error;
using test::rows;
using test::shown;

Tracks_file automatic(const std::string& text, std::optional<double> fps = std::nullopt) {
  return read_options(text, {.fps = fps});
}

std::string automatic_error(const std::string& text, std::optional<double> fps = std::nullopt) {
  return read_options_error(text, {.fps = fps});
}

TEST(Tracks_formats, are_named_in_the_order_of_the_enumerators) {
  const auto formats = tracks_formats();
  for (std::size_t i = 0; i < formats.size(); ++i) {
    EXPECT_EQ(formats[i].format, static_cast<Tracks_format>(i));
    EXPECT_FALSE(formats[i].name.empty());
    EXPECT_FALSE(formats[i].description.empty());
    EXPECT_NE(formats[i].description.back(), '.');
  }
}

// ---- rows ----

TEST(Recognized_tracks, rows_are_read_as_before) {
  const std::string text = "# made by hand\n\n y,x ,id,t\n2,1,a,0\n2,2,a,1\n";
  const Tracks_file file = automatic(text);
  EXPECT_EQ(file.format, Tracks_format::rows);
  EXPECT_EQ(shown(file), shown(rows(text)));
  EXPECT_FALSE(file.frame_rate);
  EXPECT_TRUE(file.remarks.empty());
}

TEST(Recognized_tracks, what_nothing_recognizes_is_refused_with_all_that_is_possible) {
  const std::string expected =
      "expected a header line with the columns t,id,x,y and optionally radius, in any order, or "
      "--columns t=NAME,id=NAME,x=NAME,y=NAME for the names in another table, --columns "
      "t=N,id=N,x=N,y=N for the numbers of the columns, from 1 on, of one without a header, or a "
      "file in one of the formats that --format lists";
  EXPECT_EQ(automatic_error(""), "t.csv:1: the file is empty; " + expected);
  EXPECT_EQ(automatic_error("time,name,x,y\n"), "t.csv:1: unknown column 'time'; " + expected);
  EXPECT_EQ(automatic_error("t,id,x,y,w\n"), "t.csv:1: unknown column 'w'; " + expected);
  EXPECT_EQ(automatic_error("one two three four\n"),
            "t.csv:1: unknown column 'one two three four'; " + expected);
}

TEST(Recognized_tracks, known_formats_that_are_not_read_are_named) {
  EXPECT_EQ(automatic_error("\x1f\x8b\x08"),
            "t.csv: is compressed by gzip; expected the file that gunzip makes of it");
  EXPECT_EQ(
      automatic_error("PK\x03\x04 and more"),
      "t.csv: is an archive of zip, or a workbook of a spreadsheet; expected a table exported "
      "as CSV");
  EXPECT_EQ(automatic_error("\x89HDF\r\n"),
            "t.csv: is a file of HDF5; expected a table exported as text");
}

// ---- frames or ids ----

// Persons that walk one beside the other, 2 apart, 0.125 in a frame.
std::string walk(bool id_first) {
  std::ostringstream out;
  for (int person = 1; person <= 5; ++person) {
    for (int frame = 10; frame < 20; ++frame) {
      out << (id_first ? person : frame) << ' ' << (id_first ? frame : person) << ' '
          << 0.125 * frame << ' ' << 2 * person << '\n';
    }
  }
  return out.str();
}

TEST(Recognized_tracks, a_comment_that_names_the_columns_decides) {
  const std::string expected = "7: 0.5 (2, 3) line 3 1 (4, 5) line 4";
  for (const auto& [comment, text, format] :
       {std::tuple{"# frame id x y", "1 7 2 3\n2 7 4 5\n", Tracks_format::frames},
        {"# Frame PersID X Y Z", "1 7 2 3 9\n2 7 4 5 9\n", Tracks_format::frames},
        {"# PersID Frame X Y Z", "7 1 2 3 9\n7 2 4 5 9\n", Tracks_format::ids},
        {"#ID\tFR\tX\tY", "7 1 2 3\n7 2 4 5\n", Tracks_format::ids},
        {"# columns: x/m y/m id frame", "2 3 7 1\n4 5 7 2\n", Tracks_format::ids},
        {"# time id frame x y", "1.5 7 1 2 3\n1.6 7 2 4 5\n", Tracks_format::ids},
        {"# the columns id frame x y", "7 1 2 3\n7 2 4 5\n", Tracks_format::ids}}) {
    SCOPED_TRACE(comment);
    const Tracks_file file = automatic("# recorded\n" + std::string(comment) + "\n" + text, 2.0);
    EXPECT_EQ(shown(file), expected);
    EXPECT_EQ(file.format, format);
  }
}

TEST(Recognized_tracks, a_comment_below_the_rows_decides_where_nothing_else_did) {
  EXPECT_EQ(shown(automatic("1 7 2 3\n# id frame x y\n2 7 4 5\n")),
            "1: 7 (2, 3) line 1; 2: 7 (4, 5) line 3");
  EXPECT_EQ(shown(automatic("1 7 2 3\n# frame id x y\n2 7 4 5\n")),
            "7: 1 (2, 3) line 1 2 (4, 5) line 3");
  EXPECT_EQ(automatic_error("1 7 2 3\n# x y id frame\n"),
            "t.csv:2: the comment names the columns 'x y id frame', but the rows above are read in "
            "another order; expected it above all rows");
}

TEST(Recognized_tracks, a_frame_rate_is_a_sign_of_ids) {
  const Tracks_file file = automatic("#framerate: 16.00 fps\n7 8 2 3\n7 16 4 5\n");
  EXPECT_EQ(shown(file), "7: 0.5 (2, 3) line 2 1 (4, 5) line 3");
  EXPECT_EQ(file.format, Tracks_format::ids);
  EXPECT_EQ(file.frame_rate, 16);
  EXPECT_EQ(file.remarks, (std::vector<std::string>{
                              "16 frames a second, as the file says",
                              "the columns are taken as id frame x y, since a comment gives a "
                              "frame rate"}));
}

TEST(Read_tracks_ids, may_have_more_columns) {
  const Tracks_file_options ids = {.format = Tracks_format::ids, .fps = 16.0};
  EXPECT_EQ(shown(read_options("7 8 2 3 1.7\n7 16 4 5 1.7\n", ids)),
            "7: 0.5 (2, 3) line 1 1 (4, 5) line 2");
  EXPECT_EQ(read_options_error("7 8 2 3 1.7\n7 16 4 5\n", ids),
            "t.csv:2: the row has 4 fields; expected 5, as in the rows above");
  // Unless the rows contradict it. What the message advises is read.
  EXPECT_EQ(read_options_error("1 7 0 0 9\n2 7 0 0 9\n3 7 0 0 9\n", ids),
            "t.csv: none of the 3 ids is in two frames, as if the first two columns were "
            "exchanged; expected id, frame, x and y in this order: read the file with --format "
            "table --columns t=N,id=N,x=N,y=N, with the number of each column, or, if this is "
            "their order, add the line '# id frame x y' above the rows");
  EXPECT_EQ(read_options_error("1 7 0 0 9\n2 7 0 0 9\n3 7 0 0 9\n",
                               {.format = Tracks_format::table,
                                .columns = {.t = "1", .id = "2", .x = "3", .y = "4"}}),
            "");
  EXPECT_EQ(read_options_error("# id frame x y\n1 7 0 0 9\n2 7 0 0 9\n3 7 0 0 9\n", ids), "");
}

TEST(Recognized_tracks, places_decide) {
  const Tracks_file ids = automatic(walk(true), 25.0);
  EXPECT_EQ(ids.format, Tracks_format::ids);
  EXPECT_EQ(ids.tracks.size(), 5U);
  EXPECT_EQ(ids.remarks, std::vector<std::string>(
                             {"the columns are taken as id frame x y, since in the other order "
                              "successive rows of one id are 2 apart on average, but those of one "
                              "frame only 0.125"}));
  const Tracks_file of_frames = automatic(walk(false), 25.0);
  EXPECT_EQ(of_frames.format, Tracks_format::frames);
  EXPECT_EQ(shown(of_frames), shown(frames(walk(false), 25)));
}

TEST(Recognized_tracks, an_id_that_is_a_text_decides) {
  EXPECT_EQ(automatic("1 Ada 2 3\n2 Ada 4 5\n").format, Tracks_format::frames);
  EXPECT_EQ(automatic("Ada 1 2 3\nAda 2 4 5\n").format, Tracks_format::ids);
  // Also if the first rows do not show it.
  EXPECT_EQ(shown(automatic("1 7 2 3\n2 Ada 4 5\n")), "7: 1 (2, 3) line 1; Ada: 2 (4, 5) line 2");
  EXPECT_EQ(automatic_error("1 Ada 2 3\nBen 1 2 3\n"),
            "t.csv:2: the column frame is 'Ben', which is not a number; expected a decimal or "
            "hexadecimal floating point number such as -1.5, 2e-3 or 0x1.8p3");
}

TEST(Recognized_tracks, what_is_ambiguous_is_shown_in_both_readings) {
  const std::string expected =
      "t.csv: the rows have four columns without names, which mean either of two things: with "
      "--format frames, the order frame id x y, the file begins with id '7' in frame '1', then id "
      "'7' in frame '2'; with --format ids, the order id frame x y, with id '1' in frame '7', then "
      "id '2' in frame '7'; expected one of the two, or a comment '# frame id x y' or '# id frame "
      "x "
      "y' above the rows";
  EXPECT_EQ(automatic_error("1 7 2 3\n2 7 4 5\n3 8 1 1\n1 8 1 1\n"), expected);
  // Signs for both are as good as none: a frame rate, and ids that never repeat.
  EXPECT_NE(automatic_error("# framerate: 25\n1 7 2 3\n2 7 4 5\n3 7 4 5\n")
                .find("which mean either of two things"),
            std::string::npos);
  // With the option each is read.
  const std::string text = "1 7 2 3\n2 7 4 5\n";
  EXPECT_EQ(shown(read_options(text, {.format = Tracks_format::frames})),
            "7: 1 (2, 3) line 1 2 (4, 5) line 2");
  EXPECT_EQ(shown(read_options(text, {.format = Tracks_format::ids})),
            "1: 7 (2, 3) line 1; 2: 7 (4, 5) line 2");
}

TEST(Read_tracks_ids, refuse_a_file_that_seems_to_have_the_other_order) {
  const Tracks_file_options ids = {.format = Tracks_format::ids};
  EXPECT_EQ(read_options_error("# frame id x y\n1 7 2 3\n", ids),
            "t.csv:1: the comment names the columns 'frame id x y'; expected the id before the "
            "frame, or --format frames");
  EXPECT_NE(read_options_error(walk(false), ids).find("as if the first two columns were exchanged"),
            std::string::npos);
  EXPECT_EQ(read_options("# id frame x y\n" + walk(false), ids).tracks.size(), 10U);
  EXPECT_EQ(read_options_error("1 2 3\n", ids),
            "t.csv:1: the row has 3 fields; expected at least 4, id, frame, x and y, separated by "
            "tabs or blanks");
}

// ---- rates and units ----

TEST(Read_tracks_ids, the_rate_of_the_option_must_be_that_of_the_file) {
  EXPECT_EQ(automatic_error("# framerate: 25\n7 8 2 3\n", 16.0),
            "t.csv:1: the comment gives 25 frames a second, but the file is read with 16; expected "
            "the same rate");
  EXPECT_EQ(automatic("# framerate: 25\n7 8 2 3\n7 9 2 3\n", 25.0).frame_rate, 25);
  EXPECT_EQ(automatic_error("# framerate: 25\n# fps 16\n7 8 2 3\n"),
            "t.csv:2: the comment gives 16 frames a second, but the file is read with 25; expected "
            "the same rate");
  // Rows above were read with 1.
  EXPECT_EQ(automatic_error("7 8 2 3\n# fps 16\n"),
            "t.csv:2: the comment gives 16 frames a second, but the file is read with 1; expected "
            "the same rate");
  EXPECT_EQ(automatic_error("# framerate: 0\n7 8 2 3\n"),
            "t.csv:1: the comment gives 0 frames a second; expected a number greater than 0");
}

TEST(Read_tracks_ids, centimeters_and_millimeters_become_meters) {
  for (const auto& [comment, units] : {std::pair{"# id frame x/cm y/cm z/cm", 100.0},
                                       {"# id frame x [in cm] y [in cm]", 100.0},
                                       {"# x/mm y/mm", 1000.0},
                                       {"# unit: cm", 100.0},
                                       {"# id frame X Y Z (in cm)", 100.0},
                                       {"# id frame x y z (cm)", 100.0},
                                       {"# x, y, z in cm", 100.0},
                                       {"# all coordinates in centimetres", 100.0},
                                       {"# id frame x/cm y/cm z/m", 100.0},
                                       {"# X in cm, Y in cm, Z in m", 100.0},
                                       {"# id frame x/m y/m z/cm", 1.0},
                                       {"# in m", 1.0},
                                       {"# nothing", 1.0}}) {
    SCOPED_TRACE(comment);
    const Tracks_file file = read_options(std::string(comment) + "\n7 0 123.3 -7\n7 1 0.1 1e-300\n",
                                          {.format = Tracks_format::ids, .fps = 1.0});
    const auto& seen = file.tracks[0].observations;
    EXPECT_EQ(seen[0].place, (Vector_2{123.3 / units, -7 / units}));
    EXPECT_EQ(seen[1].place, (Vector_2{0.1 / units, 1e-300 / units}));
    EXPECT_EQ(file.remarks.size(), units == 1 ? 0U : 1U);
  }
  EXPECT_EQ(automatic("# id frame x/cm y/cm\n7 0 1 1\n", 25.0).remarks,
            std::vector<std::string>{"places are in meters; the file has centimeters"});
}

TEST(Read_tracks_ids, units_that_contradict_each_other_are_refused) {
  EXPECT_EQ(automatic_error("# id frame x/cm y/m\n7 0 1 1\n"),
            "t.csv:1: the comment gives places in centimeters and in another unit; expected one "
            "unit, above the rows");
  EXPECT_EQ(automatic_error("# in cm\n# in m\n7 0 1 1\n"),
            "t.csv:2: the comment gives places in meters, but the file is read in centimeters; "
            "expected one unit, above the rows");
  EXPECT_EQ(automatic_error("# id frame x y\n7 0 1 1\n# in cm\n"),
            "t.csv:3: the comment gives places in centimeters, but the file is read in meters; "
            "expected one unit, above the rows");
}

TEST(Read_tracks, frames_a_second_of_options_must_be_positive_and_finite) {
  EXPECT_PRECONDITION_ERROR(automatic("1 a 2 3\n", 0.0),
                            "the number of frames a second is not a finite number greater than 0");
}

// ---- real tracks ----

TEST(Recognized_tracks, recorded_crowds_are_recognized_in_both_orders) {
  for (const char* const name : {"students003.txt", "biwi_eth.txt"}) {
    const auto path = std::filesystem::path(KINETRI_SHARED_DATA) / "crowd" / name;
    if (!std::filesystem::exists(path)) {
      GTEST_SKIP() << "no recorded tracks: " << path << " does not exist";
    }
    const Tracks_file expected = read_tracks_file(path, Tracks_format::frames, 25);
    const Tracks_file file = read_tracks_file(path, {.fps = 25});
    EXPECT_EQ(file.format, Tracks_format::frames);
    EXPECT_EQ(shown(file), shown(expected));
    std::istringstream in(test::read_file(path));
    std::ostringstream exchanged;
    for (std::string frame, id, x, y; in >> frame >> id >> x >> y;) {
      exchanged << id << '\t' << frame << '\t' << x << '\t' << y << '\n';
    }
    const Tracks_file of_ids = automatic(exchanged.str(), 25.0);
    EXPECT_EQ(of_ids.format, Tracks_format::ids);
    EXPECT_EQ(shown(of_ids), shown(expected));
  }
}

}  // namespace
}  // namespace kinetri::tracks_formats_test
