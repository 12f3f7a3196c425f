// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/checksum.h"

#include <boost/crc.hpp>

namespace kinetri {

void Checksum::add(std::string_view piece) {
  boost::crc_32_type crc(remainder_);
  crc.process_bytes(piece.data(), piece.size());
  remainder_ = crc.get_interim_remainder();
  bytes_ += piece.size();
}

std::uint32_t Checksum::crc32() const {
  return boost::crc_32_type(remainder_).checksum();
}

}  // namespace kinetri
