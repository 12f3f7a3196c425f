// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers as bytes in text: little-endian, in base64; written, and read back.
#ifndef KINETRI_IMPL_IO_BYTES_H
#define KINETRI_IMPL_IO_BYTES_H

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "kinetri/base/platform.h"

namespace kinetri {

/// Decodes base64 (RFC 4648, with padding). None if the text is invalid.
std::optional<std::string> bytes_of_base64(std::string_view text);

/// The unsigned integer whose bytes begin at the offset `place`, the least significant one first.
/// Precondition: it is within the bytes.
template <std::unsigned_integral Number>
Number number_at(std::string_view bytes, std::size_t place) {
  std::uint64_t number = 0;
  for (std::size_t i = sizeof(Number); i-- > 0;) {
    number = number << 8U | static_cast<std::uint8_t>(bytes[place + i]);
  }
  return static_cast<Number>(number);
}

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

  /// Encodes the bytes (RFC 4648, with padding).
  std::string base64() const;

 private:
  std::string bytes_;
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_BYTES_H
