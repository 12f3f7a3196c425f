// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dates with times in ISO 8601, as exact numbers of seconds.
#ifndef KINETRI_SRC_IO_TRACKS_TIMESTAMP_H
#define KINETRI_SRC_IO_TRACKS_TIMESTAMP_H

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace kinetri {

/// A date and time, exact to 10^-18 s. Without a zone it is local time of an unknown zone; such
/// times compare with each other only.
struct Timestamp {
  std::int64_t seconds = 0;      ///< since 1970-01-01T00:00:00; in UTC if there is a zone
  std::int64_t attoseconds = 0;  ///< after that, from 0 to below 10^18
  bool has_zone = false;

  friend auto operator<=>(const Timestamp&, const Timestamp&) = default;
};

/// A timestamp read from text, or the error.
struct Parsed_timestamp {
  Timestamp value;
  /// Empty if `value` is valid. Else the second half of a message that begins with the text.
  std::string_view problem;
};

/// Whether the text begins with a year and a month: `2024-05-`.
bool looks_like_timestamp(std::string_view text);

/// Reads YYYY-MM-DD, optionally followed by T or a blank and hh:mm, :ss, a point or comma with up
/// to 18 digits, and Z, +hh:mm, +hhmm or +hh (or -). Leap seconds are problems.
Parsed_timestamp parse_timestamp(std::string_view text);

/// Reads `text` in the form `format`, as in Tracks_file_options::date_format. The problem does not
/// say what was expected. Precondition: problem_of_date_format(format) is empty.
Parsed_timestamp parse_timestamp(std::string_view text, std::string_view format);

/// Frequent forms of dates, for messages.
inline constexpr std::array<std::string_view, 33> likely_date_formats = {"%Y-%m-%d %H:%M:%S",
                                                                         "%Y-%m-%d %H:%M",
                                                                         "%Y-%m-%d %I:%M:%S %p",
                                                                         "%Y-%m-%d %H:%M:%S %Z",
                                                                         "%a, %d %b %Y %H:%M:%S %Z",
                                                                         "%Y-%j",
                                                                         "%d/%m/%y %H:%M",
                                                                         "%m/%d/%y %H:%M",
                                                                         "%d.%m.%y %H:%M",
                                                                         "%d/%m/%Y %H:%M:%S",
                                                                         "%m/%d/%Y %H:%M:%S",
                                                                         "%d/%m/%Y %H:%M",
                                                                         "%m/%d/%Y %H:%M",
                                                                         "%d.%m.%Y %H:%M:%S",
                                                                         "%d.%m.%Y %H:%M",
                                                                         "%d-%m-%Y %H:%M:%S",
                                                                         "%m-%d-%Y %H:%M:%S",
                                                                         "%Y/%m/%d %H:%M:%S",
                                                                         "%Y/%m/%d %H:%M",
                                                                         "%Y.%m.%d %H:%M:%S",
                                                                         "%m/%d/%Y %I:%M:%S %p",
                                                                         "%d %b %Y %H:%M:%S",
                                                                         "%Y%m%dT%H%M%S%z",
                                                                         "%Y%m%dT%H%M%S",
                                                                         "%Y%m%d %H:%M:%S",
                                                                         "%Y%m%d %H%M%S",
                                                                         "%d/%m/%y %H:%M:%S",
                                                                         "%d/%m/%Y",
                                                                         "%m/%d/%Y",
                                                                         "%d.%m.%Y",
                                                                         "%Y%m%d%H%M%S",
                                                                         "%d-%b-%Y %H:%M:%S",
                                                                         "%a %b %d %H:%M:%S %Y"};

/// The same for times of day.
inline constexpr std::array<std::string_view, 4> likely_forms_of_day = {"%H:%M:%S", "%H:%M",
                                                                        "%I:%M:%S %p", "%I:%M %p"};

/// Whether a form has hours and no day: it is a time since midnight, on 1970-01-01. Precondition:
/// problem_of_date_format(format) is empty.
bool is_form_of_day(std::string_view format);

/// The binary64 number nearest to the seconds from `a` to `b`. Precondition: a <= b, and both have
/// a zone or neither has.
double seconds_between(const Timestamp& a, const Timestamp& b);

/// The timestamp in ISO 8601, with as many digits of a second as it needs, and Z for UTC.
std::string text_of(const Timestamp& timestamp);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_TIMESTAMP_H
