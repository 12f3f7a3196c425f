// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace kinetri::app {
namespace {

TEST(Shortest, has_an_exponent_only_where_it_helps) {
  EXPECT_EQ(shortest(0), "0");
  EXPECT_EQ(shortest(-0.0), "-0");
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(100000), "100000");
  EXPECT_EQ(shortest(-2.5), "-2.5");
  EXPECT_EQ(shortest(0.0001), "0.0001");
  EXPECT_EQ(shortest(0.00001), "1e-05");
  EXPECT_EQ(shortest(9999999999999998.0), "9999999999999998");
  EXPECT_EQ(shortest(1e16), "1e+16");
  EXPECT_EQ(shortest(1e-100), "1e-100");
  EXPECT_EQ(shortest(std::numeric_limits<double>::max()), "1.7976931348623157e+308");
}

TEST(Shortest, reads_back_as_the_same_number) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300);
  std::uniform_real_distribution<double> fraction(-1, 1);
  for (int i = 0; i < 10'000; ++i) {
    const double number = fraction(random) * std::pow(10, exponent(random));
    EXPECT_EQ(std::strtod(shortest(number).c_str(), nullptr), number);
  }
}

TEST(Concat, joins_words_and_numbers) {
  const std::string word = "point";
  EXPECT_EQ(concat({}), "");
  EXPECT_EQ(concat({word, " ", 7, " at t = ", 0.5, ", ", 18446744073709551615U}),
            "point 7 at t = 0.5, 18446744073709551615");
}

TEST(Joined, has_the_separator_between_words) {
  EXPECT_EQ(joined({}, ", "), "");
  EXPECT_EQ(joined(std::vector<std::string>{"a"}, ", "), "a");
  EXPECT_EQ(joined(std::vector<std::string>{"a", "b", "c"}, ", "), "a, b, c");
}

TEST(Counted, has_a_plural_for_all_numbers_but_one) {
  EXPECT_EQ(counted(0, "event"), "0 events");
  EXPECT_EQ(counted(1, "event"), "1 event");
  EXPECT_EQ(counted(2, "event"), "2 events");
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
}  // namespace kinetri::app
