// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dates with times. The oracle of the calendar counts days one by one.
#include "io/tracks/timestamp.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "support/precondition_error.h"

namespace kinetri::timestamp_test {
namespace {

Timestamp timestamp(const std::string& text) {
  const Parsed_timestamp parsed = parse_timestamp(text);
  EXPECT_EQ(parsed.problem, "") << text;
  return parsed.value;
}

std::string date(int year, int month, int day) {
  const auto two = [](int number) { return (number < 10 ? "-0" : "-") + std::to_string(number); };
  return std::to_string(year) + two(month) + two(day);
}

TEST(Timestamp, days_are_those_of_the_calendar) {
  constexpr int lengths[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  std::int64_t day = 0;
  for (int year = 1970; year <= 2110; ++year) {
    const bool is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    for (int month = 1; month <= 12; ++month) {
      const int length = lengths[month - 1] + (month == 2 && is_leap ? 1 : 0);
      for (int d = 1; d <= length; ++d, ++day) {
        const std::string text = date(year, month, d);
        ASSERT_EQ(timestamp(text).seconds, 86400 * day) << text;
        ASSERT_EQ(text_of(timestamp(text)), text + "T00:00:00");
      }
      const std::string text = date(year, month, length + 1);
      ASSERT_NE(parse_timestamp(text).problem, "") << text;
    }
  }
}

TEST(Timestamp, zones_are_taken_off) {
  const Timestamp noon = timestamp("2024-05-01T12:00:00Z");
  for (const char* same :
       {"2024-05-01 12:00Z", "2024-05-01T14:30+02:30", "2024-05-01T14:30+0230",
        "2024-05-01T07:00:00.000-05", "2024-05-02t00:00:00+12:00", "2024-05-01T12:00:00,0+00:00"}) {
    EXPECT_EQ(timestamp(same), noon) << same;
  }
  EXPECT_EQ(timestamp("2024-05-01T12:00").seconds, noon.seconds);
  EXPECT_FALSE(timestamp("2024-05-01T12:00").has_zone);
}

TEST(Timestamp, texts_come_back) {
  for (const char* text : {"1969-12-31T23:59:59.999999999999999999Z", "2024-02-29T12:30:59.5",
                           "0001-01-01T00:00:00Z", "9999-12-31T23:59:59"}) {
    EXPECT_EQ(text_of(timestamp(text)), text);
  }
}

TEST(Timestamp, differences_are_rounded_to_nearest) {
  const auto between = [](const char* a, const char* b) {
    return seconds_between(timestamp(a), timestamp(b));
  };
  EXPECT_EQ(between("2024-05-01T00:00:00.9Z", "2024-05-01T00:00:01Z"), 0.1);
  EXPECT_EQ(between("2024-05-01T00:00:00.000000000000000001Z", "2024-05-01T00:00:00.3Z"),
            0.299999999999999999);
  EXPECT_EQ(between("1970-01-01", "2024-05-01T00:00:00.7"), 1714521600.7);
  EXPECT_EQ(between("1969-12-31T23:59:59.25", "1970-01-01T00:00:00.5"), 1.25);
  EXPECT_EQ(between("2024-05-01", "2024-05-01"), 0);
  EXPECT_PRECONDITION_ERROR(between("2024-05-02", "2024-05-01"),
                            "the second timestamp is before the first, or of another kind");
}

TEST(Timestamp, what_is_none_is_refused) {
  for (const char* text : {"2024-05",
                           "2024-5-1",
                           "2024-05-01X",
                           "2024-05-01T",
                           "2024-05-01T12",
                           "2024-05-01T12:0",
                           "2024-05-01T12:00:0",
                           "2024-05-01T12:00:00.",
                           "2024-05-01T12:00:00.1234567890123456789",
                           "2024-05-01T24:00",
                           "2024-05-01T12:60",
                           "2024-05-01T12:00:60",
                           "2024-05-01T12:00z5",
                           "2024-05-01T12:00+",
                           "2024-05-01T12:00+24",
                           "2024-05-01T12:00+02:60",
                           "2024-05-01T12:00+02:",
                           "2024-05-01T12:00 +02",
                           "2024-13-01",
                           "2024-00-01",
                           "2024-01-00",
                           "0000-01-01",
                           "-024-01-01",
                           "20240501",
                           ""}) {
    EXPECT_NE(parse_timestamp(text).problem, "") << text;
  }
}

TEST(Timestamp, numbers_do_not_look_like_dates) {
  for (const char* text : {"", "2024", "2024.5", "-2024-05-01", "2024-5-1", "1e10", "20240501"}) {
    EXPECT_FALSE(looks_like_timestamp(text)) << text;
  }
  EXPECT_TRUE(looks_like_timestamp("2024-05-"));
}

TEST(Parse_timestamp, of_a_wrong_format_is_a_precondition_error) {
  EXPECT_PRECONDITION_ERROR(parse_timestamp("5", "%m"), "the format of dates is wrong");
}

}  // namespace
}  // namespace kinetri::timestamp_test
