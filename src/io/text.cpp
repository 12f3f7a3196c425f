// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace kinetri {
namespace {

// Numbers with exponents in this range are written without an exponent.
constexpr int least_exponent = -4;
constexpr int end_of_exponents = 16;

// Writes the number from `begin` on; returns the end.
char* write(char* begin, char* limit, double number) {
  char* const end = std::to_chars(begin, limit, number, std::chars_format::scientific).ptr;
  if (!std::isfinite(number)) return end;
  // Now it is d.ddde+xx, or de+xx: reformatted unless the exponent stays.
  if (*begin == '-') ++begin;
  char* mark = end - 1;
  while (*mark != 'e') --mark;
  int exponent = 0;
  const char* digits_of_exponent = mark[1] == '+' ? mark + 2 : mark + 1;
  std::from_chars(digits_of_exponent, end, exponent);
  if (exponent < least_exponent || exponent >= end_of_exponents) return end;

  std::array<char, 20> digits;
  std::size_t count = 0;
  for (const char* c = begin; c != mark; ++c) {
    if (*c != '.') digits[count++] = *c;
  }
  char* out = begin;
  const auto put = [&](const char* from, std::size_t n) {
    std::memcpy(out, from, n);
    out += n;
  };
  const auto put_zeros = [&](std::size_t n) {
    std::memset(out, '0', n);
    out += n;
  };
  if (exponent < 0) {
    put("0.", 2);
    put_zeros(static_cast<std::size_t>(-exponent - 1));
    put(digits.data(), count);
    return out;
  }
  const std::size_t before_point = static_cast<std::size_t>(exponent) + 1;
  if (count <= before_point) {
    put(digits.data(), count);
    put_zeros(before_point - count);
  } else {
    put(digits.data(), before_point);
    *out++ = '.';
    put(digits.data() + before_point, count - before_point);
  }
  return out;
}

std::string_view text_between(const char* begin, const char* end) {
  return std::string_view(begin, static_cast<std::size_t>(end - begin));
}

}  // namespace

Text_piece::Text_piece(char character) : text_(buffer_.data(), 1) {
  buffer_[0] = character;
}

Text_piece::Text_piece(double number) {
  const char* const end = write(buffer_.data(), buffer_.data() + buffer_.size(), number);
  text_ = text_between(buffer_.data(), end);
}

void Text_piece::set(std::int64_t number) {
  const auto result = std::to_chars(buffer_.data(), buffer_.data() + buffer_.size(), number);
  text_ = text_between(buffer_.data(), result.ptr);
}

void Text_piece::set(std::uint64_t number) {
  const auto result = std::to_chars(buffer_.data(), buffer_.data() + buffer_.size(), number);
  text_ = text_between(buffer_.data(), result.ptr);
}

void append_pieces(std::string& text, std::initializer_list<Text_piece> pieces) {
  for (const Text_piece& piece : pieces) text += piece.text();
}

std::string hexadecimal(std::uint64_t number, std::size_t digits) {
  std::array<char, 16> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, 16);
  const std::string_view text = text_between(buffer.data(), result.ptr);
  return std::string(digits - std::min(digits, text.size()), '0').append(text);
}

std::string rounded(double number, int digits) {
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                    std::chars_format::general, digits);
  return std::string(buffer.data(), result.ptr);
}

}  // namespace kinetri
