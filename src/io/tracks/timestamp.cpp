// SPDX-License-Identifier: GPL-3.0-or-later
#include "timestamp.h"

#include <chrono>
#include <optional>

#include "io/text.h"
#include "kinetri/base/check.h"
#include "kinetri/io/points_file.h"

namespace kinetri {
namespace {

constexpr std::int64_t attoseconds_in_second = 1'000'000'000'000'000'000;
constexpr std::int64_t seconds_in_day = 86400;
constexpr std::size_t most_digits = 18;

constexpr std::string_view no_timestamp =
    "is no date and time; expected one in ISO 8601 such as 2024-05-01T12:00:00.5Z";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Takes pieces from the beginning of a text.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }

  bool take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool next_is_digit() const { return !rest_.empty() && is_digit(rest_.front()); }

  // That many digits as a number.
  std::optional<int> number(std::size_t digits) {
    if (rest_.size() < digits) return std::nullopt;
    int result = 0;
    for (const char c : rest_.substr(0, digits)) {
      if (!is_digit(c)) return std::nullopt;
      result = 10 * result + (c - '0');
    }
    rest_.remove_prefix(digits);
    return result;
  }

  // One or more digits behind a point, in units of 10^-18; none if there are too many.
  std::optional<std::int64_t> fraction() {
    std::int64_t result = 0;
    std::size_t digits = 0;
    for (; next_is_digit(); rest_.remove_prefix(1)) {
      if (++digits > most_digits) return std::nullopt;
      result = 10 * result + (rest_.front() - '0');
    }
    if (digits == 0) return std::nullopt;
    for (; digits < most_digits; ++digits) result *= 10;
    return result;
  }

 private:
  std::string_view rest_;
};

// Seconds that local time is ahead of UTC; none if the text ends without a zone.
struct Zone {
  bool is_valid = false;
  std::optional<int> offset;
};

Zone zone_of(Scanner& scanner) {
  if (scanner.at_end()) return {true, std::nullopt};
  if (scanner.take('Z') || scanner.take('z')) return {scanner.at_end(), 0};
  const bool is_behind = scanner.take('-');
  if (!is_behind && !scanner.take('+')) return {};
  const std::optional<int> hours = scanner.number(2);
  if (!hours || *hours > 23) return {};
  int minutes = 0;
  if (!scanner.at_end()) {
    scanner.take(':');
    const std::optional<int> taken = scanner.number(2);
    if (!taken || *taken > 59) return {};
    minutes = *taken;
  }
  const int offset = 3600 * *hours + 60 * minutes;
  return {scanner.at_end(), is_behind ? -offset : offset};
}

// In decimal digits, with zeros before it up to that many.
void append_digits(std::string& text, std::int64_t number, std::size_t digits) {
  const std::string plain = joined(number);
  if (plain.size() < digits) text.append(digits - plain.size(), '0');
  text += plain;
}

}  // namespace

bool looks_like_timestamp(std::string_view text) {
  Scanner scanner(text);
  return scanner.number(4) && scanner.take('-') && scanner.number(2) && scanner.take('-');
}

Parsed_timestamp parse_timestamp(std::string_view text) {
  Scanner scanner(text);
  const auto year = scanner.number(4);
  const bool has_month = scanner.take('-');
  const auto month = scanner.number(2);
  const bool has_day = scanner.take('-');
  const auto day = scanner.number(2);
  if (!year || !has_month || !month || !has_day || !day) return {{}, no_timestamp};
  const std::chrono::year_month_day date(std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day)));
  if (!date.ok() || *year == 0)
    return {{}, "is a day that is not in the calendar; expected one that is"};
  Timestamp result;
  result.seconds = seconds_in_day * std::chrono::sys_days(date).time_since_epoch().count();
  if (scanner.at_end()) return {result, {}};

  if (!scanner.take('T') && !scanner.take('t') && !scanner.take(' ')) return {{}, no_timestamp};
  const auto hour = scanner.number(2);
  const bool has_minute = scanner.take(':');
  const auto minute = scanner.number(2);
  if (!hour || !has_minute || !minute) return {{}, no_timestamp};
  int second = 0;
  if (scanner.take(':')) {
    const auto taken = scanner.number(2);
    if (!taken) return {{}, no_timestamp};
    second = *taken;
    if (scanner.take('.') || scanner.take(',')) {
      const auto fraction = scanner.fraction();
      if (!fraction) {
        return {{},
                "has no digits, or more than 18, behind the point of its seconds; expected 1 "
                "to 18"};
      }
      result.attoseconds = *fraction;
    }
  }
  if (*hour > 23 || *minute > 59 || second > 59) {
    return {{}, "is a time that no day has; expected one from 00:00:00 to 23:59:59"};
  }
  result.seconds += 3600 * *hour + 60 * *minute + second;
  const Zone zone = zone_of(scanner);
  if (!zone.is_valid) return {{}, no_timestamp};
  result.has_zone = zone.offset.has_value();
  result.seconds -= zone.offset.value_or(0);
  return {result, {}};
}

double seconds_between(const Timestamp& a, const Timestamp& b) {
  KINETRI_PRECONDITION(a <= b && a.has_zone == b.has_zone,
                       "the second timestamp is before the first, or of another kind");
  std::int64_t seconds = b.seconds - a.seconds;
  std::int64_t attoseconds = b.attoseconds - a.attoseconds;
  if (attoseconds < 0) {
    attoseconds += attoseconds_in_second;
    --seconds;
  }
  // The exact difference in decimal digits, which is rounded as every number in a file is.
  std::string digits = joined(seconds, '.');
  append_digits(digits, attoseconds, most_digits);
  return parse_number(digits).value;
}

std::string text_of(const Timestamp& timestamp) {
  std::int64_t days = timestamp.seconds / seconds_in_day;
  std::int64_t of_day = timestamp.seconds % seconds_in_day;
  if (of_day < 0) {
    of_day += seconds_in_day;
    --days;
  }
  const std::chrono::year_month_day date(
      std::chrono::sys_days(std::chrono::days(static_cast<std::chrono::days::rep>(days))));
  std::string result;
  append_digits(result, static_cast<int>(date.year()), 4);
  result += '-';
  append_digits(result, static_cast<unsigned>(date.month()), 2);
  result += '-';
  append_digits(result, static_cast<unsigned>(date.day()), 2);
  result += 'T';
  append_digits(result, of_day / 3600, 2);
  result += ':';
  append_digits(result, of_day / 60 % 60, 2);
  result += ':';
  append_digits(result, of_day % 60, 2);
  if (timestamp.attoseconds != 0) {
    result += '.';
    append_digits(result, timestamp.attoseconds, most_digits);
    result.erase(result.find_last_not_of('0') + 1);
  }
  return timestamp.has_zone ? result + 'Z' : result;
}

}  // namespace kinetri
