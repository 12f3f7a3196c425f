// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kinetri::app::text_test {
namespace {

TEST(Separated, has_the_separator_between_words) {
  EXPECT_EQ(separated({}, ", "), "");
  EXPECT_EQ(separated(std::vector<std::string>{"a"}, ", "), "a");
  EXPECT_EQ(separated(std::vector<std::string>{"a", "b", "c"}, ", "), "a, b, c");
}

TEST(Counted, has_a_plural_for_all_numbers_but_one) {
  EXPECT_EQ(counted(0, "event"), "0 events");
  EXPECT_EQ(counted(1, "event"), "1 event");
  EXPECT_EQ(counted(2, "event"), "2 events");
}

TEST(Csv_field, is_quoted_where_it_must_be) {
  EXPECT_EQ(csv_field("a man; 5'"), "a man; 5'");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("5\""), "\"5\"\"\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
}

TEST(Digits, are_those_of_printf) {
  EXPECT_EQ(fixed(2.25, 1), "2.2");
  EXPECT_EQ(fixed(1e300, 0).size(), 301U);
  EXPECT_EQ(significant(0.00012345, 2), "0.00012");
  EXPECT_EQ(significant(1234567, 3), "1.23e+06");
}

TEST(Aligned, adds_blanks_and_cuts_nothing) {
  EXPECT_EQ(right_aligned("5", 3), "  5");
  EXPECT_EQ(left_aligned("5", 3), "5  ");
  EXPECT_EQ(right_aligned("12345", 3), "12345");
}

}  // namespace
}  // namespace kinetri::app::text_test
