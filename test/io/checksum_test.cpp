// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/checksum.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>

namespace kinetri::checksum_test {
namespace {

std::uint32_t crc32_of(std::string_view content) {
  Checksum checksum;
  checksum.add(content);
  return checksum.crc32();
}

// Bit by bit, from the definition: the remainder of a division of polynomials, all reflected.
std::uint32_t crc32_by_bits(std::string_view content) {
  std::uint32_t remainder = 0xFFFFFFFF;
  for (const char c : content) {
    remainder ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder >> 1U) ^ ((remainder & 1U) != 0 ? 0xEDB88320U : 0U);
    }
  }
  return ~remainder;
}

TEST(Checksum, of_known_contents) {
  EXPECT_EQ(crc32_of(""), 0U);
  EXPECT_EQ(crc32_of("123456789"), 0xCBF43926U);  // the check value of this CRC
  EXPECT_EQ(crc32_of("The quick brown fox jumps over the lazy dog"), 0x414FA339U);
}

TEST(Checksum, does_not_depend_on_the_pieces) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::string content(random() % 300, '\0');
    for (char& c : content) c = static_cast<char>(random());
    Checksum checksum;
    for (std::size_t from = 0; from < content.size();) {
      const std::size_t size = 1 + random() % 50;
      checksum.add(std::string_view(content).substr(from, size));
      checksum.add("");
      from += size;
    }
    EXPECT_EQ(checksum.bytes(), content.size());
    EXPECT_EQ(checksum.crc32(), crc32_by_bits(content));
    EXPECT_EQ(checksum.crc32(), checksum.crc32());
  }
}

}  // namespace
}  // namespace kinetri::checksum_test
