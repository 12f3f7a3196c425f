// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/text.h"

#include <array>
#include <charconv>
#include <cstdio>

namespace kinetri::app {
namespace {

std::string printed(const char* format, int digits, double number) {
  std::array<char, 512> buffer;  // 309 digits before the point, and the decimals
  const int size = std::snprintf(buffer.data(), buffer.size(), format, digits, number);
  return {buffer.data(), static_cast<std::size_t>(size)};
}

}  // namespace

std::string shortest(double number) {
  // Below 1e16 without an exponent, so that counts and lengths read as such.
  constexpr double large = 1e16;
  constexpr double small = 1e-4;
  const double magnitude = number < 0 ? -number : number;
  const bool has_exponent = magnitude != 0 && !(magnitude >= small && magnitude < large);
  std::array<char, 64> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                    has_exponent ? std::chars_format::scientific : std::chars_format::fixed);
  return {buffer.data(), end};
}

std::string concat(std::initializer_list<Word> words) {
  std::string result;
  for (const Word& word : words) result += word.text();
  return result;
}

std::string joined(std::span<const std::string> words, std::string_view separator) {
  std::string result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) result += separator;
    result += words[i];
  }
  return result;
}

std::string fixed(double number, int decimals) {
  return printed("%.*f", decimals, number);
}

std::string significant(double number, int digits) {
  return printed("%.*g", digits, number);
}

std::string right_aligned(std::string text, std::size_t width) {
  if (text.size() < width) text.insert(0, width - text.size(), ' ');
  return text;
}

std::string left_aligned(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

std::string counted(std::uint64_t number, std::string_view noun) {
  return concat({number, " ", noun, number == 1 ? "" : "s"});
}

void print_error(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace kinetri::app
