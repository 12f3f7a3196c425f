// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace kinetri::text_test {
namespace {

TEST(Text, is_joined_from_pieces) {
  EXPECT_EQ(joined(), "");
  EXPECT_EQ(joined("a", 'b', std::string("c"), std::string_view("d"), 5, -6, 7U, 0.5),
            "abcd5-670.5");
  EXPECT_EQ(joined(std::numeric_limits<std::int64_t>::min(), ' ',
                   std::numeric_limits<std::uint64_t>::max()),
            "-9223372036854775808 18446744073709551615");
  std::string text = "x";
  append(text, 1, ',', 2);
  EXPECT_EQ(text, "x1,2");
}

TEST(Text, of_numbers_is_the_shortest) {
  const std::pair<double, const char*> cases[] = {
      {0, "0"},
      {-0.0, "-0"},
      {1, "1"},
      {-39.6, "-39.6"},
      {100000, "100000"},
      {0.1, "0.1"},
      {1.0 / 3, "0.3333333333333333"},
      {0.0001, "0.0001"},
      {0.00012345, "0.00012345"},
      {0.00001, "1e-05"},
      {1.5e-300, "1.5e-300"},
      {123456789012345.6, "123456789012345.6"},
      {9007199254740993.0, "9007199254740992"},
      {1e15, "1000000000000000"},
      {9999999999999998.0, "9999999999999998"},
      {1e16, "1e+16"},
      {1.5e16, "1.5e+16"},
      {5e-324, "5e-324"},
      {1.7976931348623157e308, "1.7976931348623157e+308"},
      {HUGE_VAL, "inf"},
      {-HUGE_VAL, "-inf"}};
  for (const auto& [number, text] : cases) EXPECT_EQ(joined(number), text);
}

TEST(Text, of_numbers_reads_back) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    EXPECT_EQ(std::strtod(joined(number).c_str(), nullptr), number);
    const double moderate = std::ldexp(std::remainder(number, 1), static_cast<int>(random() % 60));
    EXPECT_EQ(std::strtod(joined(moderate).c_str(), nullptr), moderate);
  }
}

TEST(Text, rounded_numbers_have_few_digits) {
  EXPECT_EQ(rounded(0.0009999999999994458, 3), "0.001");
  EXPECT_EQ(rounded(90, 3), "90");
  EXPECT_EQ(rounded(12345.6, 2), "1.2e+04");
}

TEST(Text, in_hexadecimal_digits_has_zeros_before_it) {
  EXPECT_EQ(hexadecimal(0x1b, 2), "1b");
  EXPECT_EQ(hexadecimal(0xabc, 8), "00000abc");
  EXPECT_EQ(hexadecimal(0, 1), "0");
}

}  // namespace
}  // namespace kinetri::text_test
