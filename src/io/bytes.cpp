// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/bytes.h"

namespace kinetri {

std::optional<std::string> bytes_of_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  const auto digit = [](char c) -> std::uint32_t {
    if (c >= 'A' && c <= 'Z') return static_cast<std::uint32_t>(c - 'A');
    if (c >= 'a' && c <= 'z') return static_cast<std::uint32_t>(c - 'a' + 26);
    if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0' + 52);
    return c == '+' ? 62 : c == '/' ? 63 : 64;
  };
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t first = 0; first < text.size(); first += 4) {
    std::uint32_t group = 0;
    for (std::size_t i = first; i < first + 4; ++i) {
      const std::uint32_t value = i + padding < text.size() ? digit(text[i]) : 0;
      if (value == 64) return std::nullopt;
      group = group << 6U | value;
    }
    for (const unsigned shift : {16U, 8U, 0U}) bytes += static_cast<char>(group >> shift & 255U);
  }
  while (padding-- > 0) bytes.pop_back();
  return bytes;
}

std::string Bytes::base64() const {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((size() + 2) / 3 * 4);
  for (std::size_t first = 0; first < size(); first += 3) {
    std::uint32_t group = 0;
    for (std::size_t i = first; i < first + 3; ++i) {
      group = group << 8U | (i < size() ? static_cast<std::uint8_t>(bytes_[i]) : 0U);
    }
    for (const unsigned shift : {18U, 12U, 6U, 0U}) text += digits[group >> shift & 63U];
  }
  for (std::size_t i = 0; i < (3 - size() % 3) % 3; ++i) text[text.size() - 1 - i] = '=';
  return text;
}

}  // namespace kinetri
