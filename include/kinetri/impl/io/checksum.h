// SPDX-License-Identifier: GPL-3.0-or-later
//
// The checksum of a file.
#ifndef KINETRI_IMPL_IO_CHECKSUM_H
#define KINETRI_IMPL_IO_CHECKSUM_H

#include <cstdint>
#include <string_view>

#include "kinetri/base/platform.h"

namespace kinetri {

/// The size and CRC-32 (that of zlib, gzip and PNG) of bytes that are added in pieces.
class Checksum {
 public:
  /// Appends the piece. Cost: some nanoseconds a byte.
  void add(std::string_view piece);

  std::uint64_t bytes() const { return bytes_; }
  std::uint32_t crc32() const;

 private:
  std::uint64_t bytes_ = 0;
  std::uint32_t remainder_ = 0xFFFFFFFF;
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_CHECKSUM_H
