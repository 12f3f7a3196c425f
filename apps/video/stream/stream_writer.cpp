// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/stream/stream_writer.h"

#include <zstd.h>

#include <ostream>
#include <string>

#include "kinetri/impl/base/check.h"
#include "video/stream/block_bytes.h"

namespace kinetri::video {
namespace {

// Blocks are small; this level makes them a few percent smaller than the default.
constexpr int compression_level = 19;

std::string bytes_of(const Stream_header& header) {
  const Video_format& format = header.format;
  std::string bytes(stream_signature);
  append_number(bytes, stream_version, 2);
  append_number(bytes, static_cast<std::uint8_t>(format.chroma), 1);
  append_number(bytes, format.is_full_range ? 1 : 0, 1);
  append_number(bytes, format.width, 4);
  append_number(bytes, format.height, 4);
  append_number(bytes, format.rate.numerator, 4);
  append_number(bytes, format.rate.denominator, 4);
  append_number(bytes, format.aspect.numerator, 4);
  append_number(bytes, format.aspect.denominator, 4);
  append_number(bytes, header.place_bits, 1);
  append_number(bytes, header.color_step, 1);
  append_number(bytes, header.margin, 1);
  append_number(bytes, 0, 5);
  append_number(bytes, checksum(bytes), 4);
  return bytes;
}

std::string compressed(const std::string& content) {
  std::string result(ZSTD_compressBound(content.size()), '\0');
  const std::size_t size = ZSTD_compress(result.data(), result.size(), content.data(),
                                         content.size(), compression_level);
  KINETRI_ASSERT(ZSTD_isError(size) == 0, ZSTD_getErrorName(size));
  result.resize(size);
  return result;
}

std::uint32_t begin_of(const Block& block) {
  if (const Key* key = std::get_if<Key>(&block)) return key->frame;
  if (const Group* group = std::get_if<Group>(&block)) return group->first;
  return std::get<End>(block).frames;
}

char type_of(const Block& block) {
  constexpr std::array<char, 3> types = {key_type, group_type, end_type};
  return types[block.index()];
}

}  // namespace

Stream_writer::Stream_writer(std::ostream& out, const Stream_header& header)
    : out_(out), points_(header) {
  const std::string bytes = bytes_of(header);
  KINETRI_ASSERT(bytes.size() == header_bytes, "the header has another size than it says");
  planes_ = header.format.planes();
  out_ << bytes;
  bytes_ += bytes.size();
}

void Stream_writer::write(const Block& block) {
  const std::string problem = points_.problem(block);
  KINETRI_ASSERT(problem.empty(), problem.c_str());
  const std::string content = content_of(block, points_, planes_);
  const std::string stored = content.empty() ? content : compressed(content);
  KINETRI_ASSERT(content.size() <= most_block_bytes, "a block is too large");
  std::string bytes;
  bytes += type_of(block);
  append_number(bytes, begin_of(block), 4);
  append_number(bytes, content.size(), 4);
  append_number(bytes, stored.size(), 4);
  append_number(bytes, checksum(bytes + stored), 4);
  bytes += stored;
  out_ << bytes;
  bytes_ += bytes.size();
  points_.follow(block);
}

}  // namespace kinetri::video
