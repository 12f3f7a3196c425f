// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/parse_number.h"

#include <charconv>
#include <cmath>
#include <system_error>

#include "base/from_chars.h"

namespace kinetri {
namespace {

constexpr std::string_view not_a_number =
    "is not a number; expected a decimal or hexadecimal floating point number such as -1.5, "
    "2e-3 or 0x1.8p3";
constexpr std::string_view not_finite = "is not finite; expected a finite number";
constexpr std::string_view out_of_range =
    "is out of the range of binary64; expected 0, or a magnitude from 4.9e-324 to 1.8e308";

}  // namespace

Parsed_number parse_number(std::string_view text) {
  std::string_view digits = text;
  const bool negative = digits.starts_with('-');
  if (negative || digits.starts_with('+')) digits.remove_prefix(1);
  const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
  if (hexadecimal) digits.remove_prefix(2);
  // from_chars would accept a second minus sign.
  if (digits.starts_with('-')) return {0, not_a_number};
  const char* const end = digits.data() + digits.size();
  double value = 0;
  const auto [stop, error] = from_chars(
      digits.data(), end, value, hexadecimal ? std::chars_format::hex : std::chars_format::general);
  if (error == std::errc::invalid_argument || stop != end) return {0, not_a_number};
  if (error == std::errc::result_out_of_range) return {0, out_of_range};
  if (!std::isfinite(value)) return {0, not_finite};
  return {negative ? -value : value, {}};
}

}  // namespace kinetri
