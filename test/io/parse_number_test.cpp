// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers in text: exactly those that are written there, and everything else is an error.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "kinetri/impl/io/parse_number.h"

namespace kinetri::parse_number_test {
namespace {

double number(const std::string& text) {
  const Parsed_number parsed = parse_number(text);
  EXPECT_TRUE(parsed.problem.empty()) << text << " " << parsed.problem;
  return parsed.value;
}

TEST(Parse_number, reads_decimal_numbers) {
  EXPECT_EQ(number("0"), 0);
  EXPECT_EQ(number("12"), 12);
  EXPECT_EQ(number("+12"), 12);
  EXPECT_EQ(number("-1.5"), -1.5);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("5."), 5);
  EXPECT_EQ(number("1e3"), 1000);
  EXPECT_EQ(number("1E+3"), 1000);
  EXPECT_EQ(number("2.5e-1"), 0.25);
  EXPECT_EQ(number("00012"), 12);
}

TEST(Parse_number, reads_hexadecimal_numbers) {
  EXPECT_EQ(number("0x1.8p3"), 12);
  EXPECT_EQ(number("-0x1.8p3"), -12);
  EXPECT_EQ(number("+0X1.8P+3"), 12);
  EXPECT_EQ(number("0x10"), 16);
  EXPECT_EQ(number("0x.8"), 0.5);
  EXPECT_EQ(number("0xAbC.dEfp-4"), 0xABC.DEFp-4);
}

TEST(Parse_number, keeps_the_sign_of_zero) {
  EXPECT_FALSE(std::signbit(number("0.0")));
  EXPECT_TRUE(std::signbit(number("-0.0")));
  EXPECT_TRUE(std::signbit(number("-0x0p0")));
  EXPECT_EQ(number("0e999999999999"), 0);
}

TEST(Parse_number, reaches_the_ends_of_the_range) {
  EXPECT_EQ(number("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(number("0x1.fffffffffffffp1023"), std::numeric_limits<double>::max());
  EXPECT_EQ(number("2.2250738585072014e-308"), std::numeric_limits<double>::min());
  EXPECT_EQ(number("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number("0x1p-1074"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number("0x1.23p-1060"), 0x1.23p-1060);
  // Just above half of the smallest number; exactly half, and below, would be 0.
  EXPECT_EQ(number("2.4703282292062328e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number("0x.80000001p-1074"), std::numeric_limits<double>::denorm_min());
}

TEST(Parse_number, rejects_numbers_out_of_range) {
  for (const char* text :
       {"1e309", "-1e309", "1.8e308", "1e99999999999999999999", "0x1p1024", "-0x1p5000", "1e-400",
        "-1e-324", "1e-99999999999999999999", "0x1p-1080", "0x.0000001p-1060",
        "2.4703282292062327e-324", "0x.8p-1074", "0x1p-99999999999"}) {
    EXPECT_NE(parse_number(text).problem.find("is out of the range of binary64"), std::string::npos)
        << text << " gives " << parse_number(text).value << " " << parse_number(text).problem;
  }
}

TEST(Parse_number, rejects_numbers_that_are_not_finite) {
  for (const char* text : {"nan", "NaN", "-nan", "nan(1)", "inf", "-inf", "+Infinity", "INF"}) {
    EXPECT_EQ(parse_number(text).problem, "is not finite; expected a finite number") << text;
  }
}

TEST(Parse_number, rejects_other_text) {
  for (const char* text :
       {"",      "abc", "1x",   "1 ",   " 1",   "1,5",   "--1",      "+-1",   "-+1",
        "++1",   "0x",  "0x-1", "0x+1", "-0x",  "1e",    "1e+",      "0x1p",  ".",
        "-",     "+",   "-.",   "e5",   "1..5", "1.2.3", "0x.p1",    "1_000", "1'000",
        "0x0x1", "1f",  "0b1",  "infx", "nanx", "1e5e5", "0x1.8p3 x"}) {
    EXPECT_NE(parse_number(text).problem.find("is not a number"), std::string::npos) << text;
  }
  EXPECT_FALSE(parse_number(std::string("1\0", 2)).problem.empty());
  EXPECT_FALSE(parse_number("\xEF\xBB\xBF"
                            "1")
                   .problem.empty());
}

// The C library rounds correctly.
TEST(Parse_number, agrees_with_the_c_library) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    char text[64];
    // Few digits, enough digits, more digits than fit; and halfway cases in hexadecimal.
    for (const char* format : {"%.3g", "%.17g", "%.25g", "%a", "%.0f", "%.6a"}) {
      if (std::string(format) == "%.0f" && std::abs(value) > 1e40) continue;
      std::snprintf(text, sizeof text, format, value);
      const double expected = std::strtod(text, nullptr);
      if (!std::isfinite(expected) || expected == 0) continue;
      ASSERT_EQ(number(text), expected) << text;
    }
    std::snprintf(text, sizeof text, "0x%llx.%03llxp%d", static_cast<unsigned long long>(random()),
                  static_cast<unsigned long long>(random() % 4096),
                  static_cast<int>(random() % 2000) - 1100);
    const double expected = std::strtod(text, nullptr);
    if (!std::isfinite(expected) || expected == 0) continue;
    ASSERT_EQ(number(text), expected) << text;
  }
}

}  // namespace
}  // namespace kinetri::parse_number_test
