// SPDX-License-Identifier: GPL-3.0-or-later
//
// std::from_chars for binary64, which libc++ before version 20 does not have.
#ifndef KINETRI_SRC_BASE_FROM_CHARS_H
#define KINETRI_SRC_BASE_FROM_CHARS_H

#include <charconv>
#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include "kinetri/base/platform.h"
#endif

namespace kinetri {

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000

/// As std::from_chars. glibc's strtod_l rounds to nearest; blanks, signs and prefixes, which it
/// also accepts, are excluded first.
inline std::from_chars_result from_chars(const char* first, const char* last, double& value,
                                         std::chars_format format = std::chars_format::general) {
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  const bool is_negative = first != last && *first == '-';
  const char* const begin = first + (is_negative ? 1 : 0);
  const bool is_hexadecimal = format == std::chars_format::hex;
  const std::string_view digits = is_hexadecimal ? "0123456789abcdefABCDEF" : "0123456789";
  const std::string_view letters = "iInN";
  const bool is_word = begin != last && letters.find(*begin) != std::string_view::npos;
  const bool begins =
      begin != last && (is_word || *begin == '.' || digits.find(*begin) != std::string_view::npos);
  // "0x" would be a prefix for strtod.
  const bool has_prefix = last - begin > 1 && *begin == '0' && (begin[1] == 'x' || begin[1] == 'X');
  if (!begins) return {first, std::errc::invalid_argument};
  if (has_prefix) {
    value = is_negative ? -0.0 : 0.0;
    return {begin + 1, {}};
  }
  const std::string text = (is_hexadecimal && !is_word ? "0x" : "") + std::string(begin, last);
  char* end = nullptr;
  const double result = strtod_l(text.c_str(), &end, c_locale);
  const auto taken = end - text.c_str() - (is_hexadecimal && !is_word ? 2 : 0);
  if (taken <= 0) return {first, std::errc::invalid_argument};
  const std::string_view number(begin, static_cast<std::size_t>(taken));
  const bool is_zero = number.substr(0, number.find_first_of(is_hexadecimal ? "pP" : "eE"))
                           .find_first_of("123456789abcdefABCDEF") == std::string_view::npos;
  const bool is_out_of_range = !is_word && (std::isinf(result) || (result == 0 && !is_zero));
  if (is_out_of_range) return {begin + taken, std::errc::result_out_of_range};
  value = is_negative ? -result : result;
  return {begin + taken, {}};
}

#else

using std::from_chars;

#endif

}  // namespace kinetri

#endif  // KINETRI_SRC_BASE_FROM_CHARS_H
