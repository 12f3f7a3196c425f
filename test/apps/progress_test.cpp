// SPDX-License-Identifier: GPL-3.0-or-later
//
// The text of the progress line.
#include "cli/progress.h"

#include <gtest/gtest.h>

#include <limits>

namespace kinetri::app::progress_test {
namespace {

TEST(Readable_duration, uses_the_unit_that_fits) {
  EXPECT_EQ(readable_duration(0), "0 s");
  EXPECT_EQ(readable_duration(0.2), "1 s");
  EXPECT_EQ(readable_duration(59), "59 s");
  EXPECT_EQ(readable_duration(59.1), "1 min 00 s");
  EXPECT_EQ(readable_duration(187), "3 min 07 s");
  EXPECT_EQ(readable_duration(7500), "2 h 05 min");
  EXPECT_EQ(readable_duration(1e12), "very long");
  EXPECT_EQ(readable_duration(std::numeric_limits<double>::quiet_NaN()), "very long");
}

TEST(Progress_text, shows_share_time_events_rate_and_time_left) {
  EXPECT_EQ(progress_text(0, 10, 2.5, 3000, 2),
            " 25 %, t = 2.5 of 10, 3000 events, 1500 events/s, 6 s left");
  EXPECT_EQ(progress_text(-10, 10, 0, 8, 4), " 50 %, t = 0 of 10, 8 events, 2 events/s, 4 s left");
}

TEST(Progress_text, promises_nothing_before_it_can_tell) {
  EXPECT_EQ(progress_text(0, 10, 0, 0, 0), "  0 %, t = 0 of 10, 0 events, 0 events/s");
  EXPECT_EQ(progress_text(0, 10, 1, 50, 0.5), " 10 %, t = 1 of 10, 50 events, 100 events/s");
}

TEST(Progress_text, survives_extreme_times) {
  EXPECT_EQ(progress_text(-1.7e308, 1.7e308, 0, 1, 1),
            " 50 %, t = 0 of 1.7e+308, 1 event, 1 events/s, 1 s left");
  EXPECT_EQ(progress_text(5, 5, 5, 0, 0), "100 %, t = 5 of 5, 0 events, 0 events/s");
}

}  // namespace
}  // namespace kinetri::app::progress_test
