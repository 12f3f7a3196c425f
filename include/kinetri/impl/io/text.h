// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text composed of pieces, for messages and rows of files. What is slow to compile is in text.cpp.
#ifndef KINETRI_IMPL_IO_TEXT_H
#define KINETRI_IMPL_IO_TEXT_H

#include <array>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "kinetri/base/platform.h"

namespace kinetri {

/// A piece of a text: a text, a character, an integer in decimal digits, or a binary64 number with
/// the fewest digits that read back exactly, as `1`, `0.25`, `1e-05`, `-0`, `1e+16`, `inf`: without
/// an exponent from 1e-4 to below 1e16. Does not depend on the locale. A text must outlive its
/// piece.
class Text_piece {
 public:
  Text_piece(std::string_view text) : text_(text) {}    // NOLINT(google-explicit-constructor)
  Text_piece(const std::string& text) : text_(text) {}  // NOLINT(google-explicit-constructor)
  Text_piece(const char* text) : text_(text) {}         // NOLINT(google-explicit-constructor)
  Text_piece(char character);                           // NOLINT(google-explicit-constructor)
  Text_piece(double number);                            // NOLINT(google-explicit-constructor)
  template <std::integral Integer>
  Text_piece(Integer number) {  // NOLINT(google-explicit-constructor)
    if constexpr (std::signed_integral<Integer>) {
      set(std::int64_t{number});
    } else {
      set(std::uint64_t{number});
    }
  }
  Text_piece(bool) = delete;

  Text_piece(const Text_piece&) = delete;
  Text_piece& operator=(const Text_piece&) = delete;

  std::string_view text() const { return text_; }

 private:
  void set(std::int64_t number);
  void set(std::uint64_t number);

  std::array<char, 32> buffer_;
  std::string_view text_;
};

void append_pieces(std::string& text, std::initializer_list<Text_piece> pieces);

/// Appends the pieces to `text`.
template <class... Pieces>
void append(std::string& text, const Pieces&... pieces) {
  append_pieces(text, {Text_piece(pieces)...});
}

/// The concatenated pieces.
template <class... Pieces>
std::string joined(const Pieces&... pieces) {
  std::string text;
  append(text, pieces...);
  return text;
}

/// The number in hexadecimal digits, padded with zeros to `digits` digits.
std::string hexadecimal(std::uint64_t number, std::size_t digits);

/// The number rounded to that many significant digits, for messages.
std::string rounded(double number, int digits);

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_TEXT_H
