// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of tracks in which the columns of frames and ids seem to be exchanged.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>

#include "support/tracks_text.h"

namespace kinetri::frame_columns_test {
namespace {

using test::frames;
using test::frames_error;

constexpr const char* exchange =
    "; expected frame, id, x and y in this order, or --format ids for id, frame, x and y";
constexpr const char* or_confirm =
    ", or, if this is their order, add the line '# frame id x y' above the rows";

TEST(Read_tracks_frames, refuses_a_comment_that_names_another_order) {
  for (const auto& [comment, names] :
       {std::pair{"# id frame x y", "id frame x y"}, std::pair{"#ID\tFR\tX\tY\tZ", "id fr x y"},
        std::pair{"# PersID Frame X Y Z", "persid frame x y"},
        std::pair{"# columns: ped_id, frame_number, x/m, y/m", "pedid framenumber x y"},
        std::pair{"# id frame x [in m] y [in m] z [in m]", "id frame x y"},
        std::pair{"# frame x y id", "frame x y id"}, std::pair{"# frame id y x", "frame id y x"}}) {
    EXPECT_EQ(frames_error("# recorded in 2011\n" + std::string(comment) + "\n1 0 1 2\n"),
              "t.csv:2: the comment names the columns '" + std::string(names) + "'" + exchange);
  }
  // Also below a row, and where another comment has named the right order.
  EXPECT_NE(frames_error("1 0 1 2\n# id frame x y\n"), "");
  EXPECT_NE(frames_error("# frame id x y\n# id frame x y\n1 0 1 2\n"), "");
}

TEST(Read_tracks_frames, comments_that_name_no_other_order_are_skipped) {
  for (const char* comment :
       {"# frame id x y", "# Frame PersID X Y", "#frame\tped_id\tx/m\ty/m", "# the id of a frame",
        "# frame: x y", "# x y", "# framerate", "# the framerate is unknown", "#", "# id frame"}) {
    EXPECT_EQ(frames_error(std::string(comment) + "\n1 0 1 2\n"), "") << comment;
  }
}

TEST(Read_tracks_frames, refuses_a_frame_rate_unless_the_order_is_confirmed) {
  for (const char* comment : {"# framerate: 16", "#framerate: 16.00 fps", "# Frame rate = 16",
                              "# frame_rate 16", "# fps: 16"}) {
    EXPECT_EQ(frames_error(std::string(comment) + "\n1 0 1 2\n", 16),
              std::string("t.csv:1: the comment gives a frame rate, as in files whose columns are "
                          "id, frame, x and y") +
                  exchange + or_confirm)
        << comment;
    EXPECT_EQ(frames_error(std::string(comment) + "\n1 0 1 2\n", 25),
              "t.csv:1: the comment gives 16 frames a second, but the file is read with 25; "
              "expected the same rate")
        << comment;
    EXPECT_EQ(frames_error(std::string(comment) + "\n# frame id x y\n1 0 1 2\n", 16), "");
    EXPECT_EQ(frames_error("# frame id x y\n" + std::string(comment) + "\n1 0 1 2\n", 16), "");
    EXPECT_NE(frames_error("# frame id x y\n" + std::string(comment) + "\n1 0 1 2\n", 25), "");
  }
}

TEST(Read_tracks_frames, refuses_ids_that_never_repeat) {
  // One person, in the order id, frame, x, y.
  const std::string one_person = "1 100 0 0\n1 101 0.1 0\n1 102 0.2 0\n";
  EXPECT_EQ(frames_error(one_person),
            std::string("t.csv: none of the 3 ids is in two frames, as if the first two columns "
                        "were exchanged") +
                exchange + or_confirm);
  EXPECT_EQ(frames("# frame id x y\n" + one_person).tracks.size(), 3U);
  // Ids that are no numbers are no frames, nor are those of several frames.
  EXPECT_EQ(frames_error("1 a 0 0\n1 b 0.1 0\n1 c 0.2 0\n"), "");
  EXPECT_EQ(frames_error("1 1.5 0 0\n1 2.5 0.1 0\n1 3.5 0.2 0\n"), "");
  EXPECT_EQ(frames_error("1 7 0 0\n2 8 0.1 0\n3 9 0.2 0\n"), "");
  EXPECT_EQ(frames_error(one_person + "2 100 5 5\n"), "");
}

// Persons that walk one beside the other, 2 apart, 0.1 in a frame.
std::string walk(bool id_first, double step) {
  std::ostringstream out;
  for (int person = 1; person <= 5; ++person) {
    for (int frame = 0; frame < 10; ++frame) {
      out << (id_first ? person : frame) << ' ' << (id_first ? frame : person) << ' '
          << step * frame << ' ' << 2 * person << '\n';
    }
  }
  return out.str();
}

TEST(Read_tracks_frames, refuses_places_that_make_sense_only_in_the_other_order) {
  EXPECT_EQ(frames_error(walk(true, 0.125)),
            std::string("t.csv: successive rows of one id are 2 apart on average, but those of one "
                        "frame only 0.125, as if the first two columns were exchanged") +
                exchange + or_confirm);
  EXPECT_EQ(frames("# frame id x y\n" + walk(true, 0.125)).tracks.size(), 10U);
  EXPECT_EQ(frames(walk(false, 0.125)).tracks.size(), 5U);
  // Where the steps are as long as the distances nothing can be noticed.
  EXPECT_EQ(frames_error(walk(true, 1)), "");
  EXPECT_EQ(frames_error(walk(false, 3)), "");
}

}  // namespace
}  // namespace kinetri::frame_columns_test
