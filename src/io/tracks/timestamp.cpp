// SPDX-License-Identifier: GPL-3.0-or-later
#include "timestamp.h"

#include <array>
#include <chrono>
#include <optional>

#include "io/text_table.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/tracks_file.h"

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

// Reads a text from its beginning.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }

  bool take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  std::string_view rest() const { return rest_; }
  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t'))
      rest_.remove_prefix(1);
  }

  // A number of at least one and at most `digits` digits.
  std::optional<int> number_up_to(std::size_t digits) {
    std::size_t size = 0;
    while (size < digits && size < rest_.size() && is_digit(rest_[size])) ++size;
    return size == 0 ? std::nullopt : number(size);
  }

  // One of the names, or its first three letters; its index.
  template <std::size_t size>
  std::optional<int> name(const std::array<std::string_view, size>& names) {
    const std::string lower = in_lower_case(rest_.substr(0, 20));
    for (std::size_t i = 0; i < size; ++i) {
      for (const std::string_view text : {names[i], names[i].substr(0, 3)}) {
        if (!lower.starts_with(text)) continue;
        rest_.remove_prefix(text.size());
        return static_cast<int>(i);
      }
    }
    return std::nullopt;
  }

  bool next_is_digit() const { return !rest_.empty() && is_digit(rest_.front()); }

  // A number of exactly `digits` digits.
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

  // One or more decimals, in units of 10^-18; none if there are too many.
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
  if (scanner.take('Z') || scanner.take('z')) return {true, 0};
  const bool is_behind = scanner.take('-');
  if (!is_behind && !scanner.take('+')) return {};
  const std::optional<int> hours = scanner.number(2);
  if (!hours || *hours > 23) return {};
  int minutes = 0;
  if (scanner.take(':') || scanner.next_is_digit()) {
    const std::optional<int> taken = scanner.number(2);
    if (!taken || *taken > 59) return {};
    minutes = *taken;
  }
  const int offset = 3600 * *hours + 60 * minutes;
  return {true, is_behind ? -offset : offset};
}

// The calendar day as seconds since 1970; none if there is no such day.
std::optional<std::int64_t> seconds_of_day(int year, int month, int day) {
  const std::chrono::year_month_day date(std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day)));
  if (!date.ok() || year == 0) return std::nullopt;
  return seconds_in_day * std::chrono::sys_days(date).time_since_epoch().count();
}

// Appends a number, padded with zeros to `digits` digits.
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
  const auto seconds = seconds_of_day(*year, *month, *day);
  if (!seconds) return {{}, "is a day that is not in the calendar; expected one that is"};
  Timestamp result;
  result.seconds = *seconds;
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
  if (!zone.is_valid || !scanner.at_end()) return {{}, no_timestamp};
  result.has_zone = zone.offset.has_value();
  result.seconds -= zone.offset.value_or(0);
  return {result, {}};
}

namespace {

constexpr std::array<std::string_view, 12> months = {
    "january", "february", "march",     "april",   "may",      "june",
    "july",    "august",   "september", "october", "november", "december"};
constexpr std::array<std::string_view, 7> weekdays = {"monday", "tuesday",  "wednesday", "thursday",
                                                      "friday", "saturday", "sunday"};
constexpr std::array<std::string_view, 3> zones_of_utc = {"utc", "gmt", "z"};

// The parts of a date that a format names.
struct Date_parts {
  int year = 1970;
  int month = 1;
  int day = 1;
  std::optional<int> day_of_year;
  int hour = 0;
  int minute = 0;
  int second = 0;
  std::int64_t attoseconds = 0;
  std::optional<bool> is_afternoon;
  std::optional<int> zone;
};

// The directives that stand for several others.
std::string without_short_forms(std::string_view format) {
  std::string result;
  for (std::size_t i = 0; i < format.size(); ++i) {
    const char next = format[i] == '%' && i + 1 < format.size() ? format[i + 1] : '\0';
    const std::string_view whole = next == 'T'   ? "%H:%M:%S"
                                   : next == 'R' ? "%H:%M"
                                   : next == 'F' ? "%Y-%m-%d"
                                   : next == 'D' ? "%m/%d/%y"
                                                 : "";
    if (whole.empty()) {
      result += format[i];
      if (next != '\0') result += next;
    } else {
      result += whole;
    }
    if (next != '\0') ++i;
  }
  return result;
}

// Reads the part of the directive. False if the text does not match.
bool take_part(Scanner& scanner, char directive, bool has_own_fraction, Date_parts& parts) {
  const auto take = [&](int& part, std::size_t digits, int least, int most) {
    const auto number = scanner.number_up_to(digits);
    if (!number || *number < least || *number > most) return false;
    part = *number;
    return true;
  };
  switch (directive) {
    case 'Y': {
      const auto year = scanner.number(4);
      parts.year = year.value_or(0);
      return year.has_value();
    }
    case 'y': {
      const auto year = scanner.number(2);
      parts.year = year.value_or(0) + (year.value_or(0) < 69 ? 2000 : 1900);
      return year.has_value();
    }
    case 'm':
      return take(parts.month, 2, 1, 12);
    case 'b':
    case 'B':
    case 'h': {
      const auto month = scanner.name(months);
      parts.month = month.value_or(0) + 1;
      return month.has_value();
    }
    case 'd':
    case 'e':
      return take(parts.day, 2, 1, 31);
    case 'j': {
      int day = 0;
      if (!take(day, 3, 1, 366)) return false;
      parts.day_of_year = day;
      return true;
    }
    case 'H':
      return take(parts.hour, 2, 0, 23);
    case 'I':
      return take(parts.hour, 2, 1, 12);
    case 'M':
      return take(parts.minute, 2, 0, 59);
    case 'S': {
      if (!take(parts.second, 2, 0, 59)) return false;
      const std::string_view rest = scanner.rest();
      const bool has_fraction = !has_own_fraction && rest.size() > 1 &&
                                (rest[0] == '.' || rest[0] == ',') && is_digit(rest[1]);
      if (!has_fraction) return true;
      if (!scanner.take('.')) scanner.take(',');
      const auto fraction = scanner.fraction();
      parts.attoseconds = fraction.value_or(0);
      return fraction.has_value();
    }
    case 'f': {
      const auto fraction = scanner.fraction();
      parts.attoseconds = fraction.value_or(0);
      return fraction.has_value();
    }
    case 'p': {
      const bool is_morning = scanner.take('A') || scanner.take('a');
      if (!is_morning && !scanner.take('P') && !scanner.take('p')) return false;
      scanner.take('.');
      parts.is_afternoon = !is_morning;
      if (!scanner.take('M') && !scanner.take('m')) return false;
      scanner.take('.');
      return true;
    }
    case 'z': {
      const Zone zone = zone_of(scanner);
      parts.zone = zone.offset;
      return zone.is_valid && zone.offset;
    }
    case 'Z':
      parts.zone = 0;
      return scanner.name(zones_of_utc).has_value();
    case 'a':
    case 'A':
      return scanner.name(weekdays).has_value();
    default:
      return scanner.take('%');
  }
}

}  // namespace

std::string problem_of_date_format(std::string_view format) {
  constexpr std::string_view known = "YymbBhdejHIMSfpzZaA%";
  const std::string whole = without_short_forms(format);
  std::string there;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole[i] != '%') continue;
    if (++i == whole.size() || known.find(whole[i]) == std::string_view::npos) {
      return joined("has '%", std::string_view(whole).substr(i, 1),
                    "'; expected directives among %Y %y %m %b %B %d %j %H %I %M %S %f %p %z %Z %a "
                    "%A %T %D %F %R %%");
    }
    if (whole[i] != '%' && there.find(whole[i]) != std::string::npos) {
      return joined("has '%", whole[i], "' twice; expected each directive once");
    }
    there += whole[i];
  }
  const auto has = [&](std::string_view directives) {
    return there.find_first_of(directives) != std::string::npos;
  };
  const bool has_day = has("Yy") && (has("j") || (has("mbBh") && has("de")));
  if (!has_day && (!has("HI") || has("YymbBhdejaA"))) {
    return "has no day; expected a year (%Y or %y), a month (%m or %b) and a day (%d), or %j, or "
           "times of day alone";
  }
  const bool has_hour = has("H") || (has("I") && has("p"));
  if ((has("I") || has("p") || has("MSf")) && !has_hour) {
    return "has no hour of the day; expected %H, or %I and %p, or no minutes and seconds";
  }
  if ((has("S") && !has("M")) || (has("f") && !has("S"))) {
    return "has seconds without minutes, or a fraction without seconds; expected both";
  }
  return {};
}

bool is_form_of_day(std::string_view format) {
  const std::string whole = without_short_forms(format);
  for (std::size_t i = 0; i + 1 < whole.size(); ++i) {
    if (whole[i] != '%') continue;
    ++i;
    if (whole[i] == 'Y' || whole[i] == 'y') return false;
  }
  return true;
}

Parsed_timestamp parse_timestamp(std::string_view text, std::string_view format) {
  constexpr std::string_view no_date = "is no date";
  KINETRI_PRECONDITION(problem_of_date_format(format).empty(), "the format of dates is wrong");
  const std::string whole = without_short_forms(format);
  Scanner scanner(text);
  Date_parts parts;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (is_blank(whole[i])) {
      if (scanner.rest().empty() || !is_blank(scanner.rest().front())) return {{}, no_date};
      scanner.skip_blanks();
    } else if (whole[i] != '%') {
      if (!scanner.take(whole[i])) return {{}, no_date};
    } else {
      ++i;
      const std::string_view behind = std::string_view(whole).substr(i + 1);
      const bool has_own_fraction = behind.starts_with(".%f") || behind.starts_with(",%f");
      if (!take_part(scanner, whole[i], has_own_fraction, parts)) return {{}, no_date};
    }
  }
  if (!scanner.at_end()) return {{}, no_date};
  if (parts.is_afternoon) parts.hour = parts.hour % 12 + (*parts.is_afternoon ? 12 : 0);
  auto seconds = seconds_of_day(parts.year, parts.month, parts.day);
  if (parts.day_of_year) {
    const auto first = seconds_of_day(parts.year, 1, 1);
    const auto next = seconds_of_day(parts.year + 1, 1, 1);
    seconds = first;
    if (first) *seconds += (*parts.day_of_year - 1) * seconds_in_day;
    if (seconds && next && *seconds >= *next) seconds.reset();
  }
  if (!seconds) return {{}, "is no day in the calendar"};
  Timestamp result;
  result.seconds = *seconds + 3600 * parts.hour + 60 * parts.minute + parts.second;
  result.attoseconds = parts.attoseconds;
  result.has_zone = parts.zone.has_value();
  result.seconds -= parts.zone.value_or(0);
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
  // The exact difference in decimal digits, rounded like every number in a file.
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
