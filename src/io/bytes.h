// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers as bytes in text: little-endian, in base64.
#ifndef KINETRI_SRC_IO_BYTES_H
#define KINETRI_SRC_IO_BYTES_H

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kinetri {

/// A sequence of bytes to which numbers are added, the least significant byte first.
class Bytes {
 public:
  template <std::unsigned_integral Number>
  void add(Number number) {
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bytes_.push_back(static_cast<char>(static_cast<std::uint8_t>(number >> (8 * i))));
    }
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

  std::size_t size() const { return bytes_.size(); }

  /// As RFC 4648 has it, with padding.
  std::string base64() const {
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

 private:
  std::string bytes_;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_BYTES_H
