// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/spelling.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kinetri::app::spelling_test {
namespace {

TEST(Edit_distance, counts_insertions_deletions_replacements_and_exchanges) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("until", "until"), 0U);
  EXPECT_EQ(edit_distance("util", "until"), 1U);
  EXPECT_EQ(edit_distance("untill", "until"), 1U);
  EXPECT_EQ(edit_distance("untol", "until"), 1U);
  EXPECT_EQ(edit_distance("unitl", "until"), 1U);
  EXPECT_EQ(edit_distance("", "until"), 5U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(Nearest_name, is_the_one_with_the_fewest_wrong_letters) {
  const std::vector<std::string> names = {"--events", "--edges", "--initial-edges", "--until"};
  EXPECT_EQ(nearest_name("--util", names), "--until");
  EXPECT_EQ(nearest_name("-until", names), "--until");
  EXPECT_EQ(nearest_name("--edge", names), "--edges");
  EXPECT_EQ(nearest_name("--event=e.csv", names), "--events");
  EXPECT_EQ(nearest_name("--initial", names), "--initial-edges");
}

TEST(Nearest_name, is_empty_where_none_is_near) {
  const std::vector<std::string> names = {"--events", "--edges", "--until", "-o", "-q"};
  for (const char* word : {"--wrong", "--e", "-x", "--", "-", ""}) {
    EXPECT_EQ(nearest_name(word, names), "") << word;
  }
  EXPECT_EQ(nearest_name("--until", {}), "");
}

// What could be completed in two ways is not.
TEST(Nearest_name, does_not_complete_what_is_ambiguous) {
  const std::vector<std::string> names = {"--frames", "--frames-per-time"};
  EXPECT_EQ(nearest_name("--fram", names), "--frames");  // two letters of six are missing
  const std::vector<std::string> others = {"--progress", "--programme"};
  EXPECT_EQ(nearest_name("--pro", others), "");
}

}  // namespace
}  // namespace kinetri::app::spelling_test
