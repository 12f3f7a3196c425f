// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/text.h"

#include <array>
#include <cstdio>

#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

std::string printed(const char* format, int digits, double number) {
  std::array<char, 512> buffer;  // 309 digits before the point, and the decimals
  const int size = std::snprintf(buffer.data(), buffer.size(), format, digits, number);
  return {buffer.data(), static_cast<std::size_t>(size)};
}

}  // namespace

std::string separated(std::span<const std::string> words, std::string_view separator) {
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
  return joined(number, ' ', noun, number == 1 ? "" : "s");
}

std::string with_name(std::string text, std::string_view name) {
  constexpr std::string_view placeholder = "NAME";
  for (std::size_t at = 0; (at = text.find(placeholder, at)) != std::string::npos;
       at += name.size()) {
    text.replace(at, placeholder.size(), name);
  }
  return text;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string result = "\"";
  for (const char c : text) result.append(c == '"' ? 2 : 1, c);
  return result + '"';
}

void print_error(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace kinetri::app
