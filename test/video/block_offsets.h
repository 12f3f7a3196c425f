// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the blocks of a stream end, found as docs/VIDEO.md describes it.
#ifndef KINETRI_TEST_VIDEO_BLOCK_OFFSETS_H
#define KINETRI_TEST_VIDEO_BLOCK_OFFSETS_H

#include <cstddef>
#include <string>
#include <vector>

namespace kinetri::video::test {

inline std::vector<std::size_t> block_ends(const std::string& bytes) {
  std::vector<std::size_t> result;
  std::size_t at = 48;
  while (at < bytes.size()) {
    std::size_t stored = 0;
    for (std::size_t i = 4; i > 0; --i) {
      stored = 256 * stored + static_cast<unsigned char>(bytes[at + 8 + i]);
    }
    at += 17 + stored;
    result.push_back(at);
  }
  return result;
}

}  // namespace kinetri::video::test

#endif  // KINETRI_TEST_VIDEO_BLOCK_OFFSETS_H
