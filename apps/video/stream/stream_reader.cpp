// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/stream/stream_reader.h"

#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <istream>
#include <string_view>
#include <utility>

#include "kinetri/impl/io/text.h"
#include "video/stream/block_bytes.h"

namespace kinetri::video {
namespace {

// Decompresses the stored bytes of a block; none if they are invalid.
std::optional<std::string> decompressed(std::string_view stored, std::size_t size) {
  if (size == 0 && stored.empty()) return std::string();
  // Checks the size before allocating it.
  if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != size) return std::nullopt;
  std::string result(size, '\0');
  const std::size_t found = ZSTD_decompress(result.data(), size, stored.data(), stored.size());
  if (ZSTD_isError(found) != 0 || found != size) return std::nullopt;
  return result;
}

std::uint32_t number32(std::string_view bytes, std::size_t position) {
  return static_cast<std::uint32_t>(number_at(bytes, position, 4));
}

}  // namespace

Stream_reader::Stream_reader(std::istream& in, std::string name)
    : in_(&in), name_(std::move(name)) {
  const auto refuse = [&](const std::string& what) { throw Input_error(name_, 0, what); };
  const std::string bytes = read_bytes(header_bytes);
  if (bytes.empty()) refuse("it is empty; expected a stream of kinetri-video");
  if (!bytes.starts_with(stream_signature)) {
    refuse(
        "it does not begin as a stream of kinetri-video does; expected a file that "
        "'kinetri-video encode' has written");
  }
  if (bytes.size() < header_bytes) {
    refuse(joined("the header is cut off after ", bytes.size(), " bytes; expected ", header_bytes));
  }
  const auto version = number_at(bytes, 8, 2);
  if (version != stream_version) {
    refuse(joined("the stream has version ", version, "; expected ", stream_version,
                  ": a newer kinetri-video may read it"));
  }
  if (number32(bytes, header_bytes - 4) != checksum(std::string_view(bytes).substr(0, 44))) {
    refuse("the header is damaged: its checksum is wrong");
  }
  Video_format& format = header_.format;
  const auto chroma = number_at(bytes, 10, 1);
  format.is_full_range = number_at(bytes, 11, 1) != 0;
  format.width = number32(bytes, 12);
  format.height = number32(bytes, 16);
  format.rate = {number32(bytes, 20), number32(bytes, 24)};
  format.aspect = {number32(bytes, 28), number32(bytes, 32)};
  header_.place_bits = static_cast<unsigned>(number_at(bytes, 36, 1));
  header_.color_step = static_cast<unsigned>(number_at(bytes, 37, 1));
  header_.margin = static_cast<unsigned>(number_at(bytes, 38, 1));
  const auto is_size = [](std::uint32_t size) { return size > 0 && size <= greatest_size; };
  if (chroma > static_cast<std::uint64_t>(Chroma::yuv420_paldv) || !is_size(format.width) ||
      !is_size(format.height) || format.rate.numerator == 0 || format.rate.denominator == 0 ||
      header_.place_bits > most_place_bits || header_.color_step == 0) {
    refuse("the header says what is not possible: a size, a frame rate, or a kind of color");
  }
  format.chroma = static_cast<Chroma>(chroma);
  points_.emplace(header_);
}

Stream_reader Stream_reader::open(const std::string& path) {
  if (path == "-") return {std::cin, "standard input"};
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file || file->peek() == std::ifstream::traits_type::eof()) {
    const int error = *file ? 0 : errno;
    file->clear();
    if (error != 0) {
      throw Input_error(path, 0,
                        joined("it cannot be opened: ", std::strerror(error),
                               "; expected a stream of kinetri-video"));
    }
  }
  Stream_reader result(*file, path);
  result.owned_ = std::move(file);
  return result;
}

std::string Stream_reader::read_bytes(std::size_t count) {
  // A false size must not exhaust memory.
  constexpr std::size_t most_at_once = 1U << 20U;
  std::string bytes;
  while (bytes.size() < count && *in_) {
    const std::size_t begin = bytes.size();
    bytes.resize(std::min(count, begin + most_at_once));
    in_->read(&bytes[begin], static_cast<std::streamsize>(bytes.size() - begin));
    bytes.resize(begin + static_cast<std::size_t>(in_->gcount()));
  }
  bytes_ += bytes.size();
  return bytes;
}

void Stream_reader::fail(const std::string& what) const {
  std::string message = joined("block ", blocks_, ", at byte ", block_begin_, ": ", what, "; ");
  if (points_->time() > 0) {
    append(message, "only what is before frame ", points_->time(), " can be decoded");
  } else {
    append(message, "nothing can be decoded");
  }
  throw Damaged_stream_error(name_, 0, message);
}

std::optional<Block> Stream_reader::read() {
  block_begin_ = bytes_;
  const std::string head = read_bytes(block_header_bytes);
  if (points_->has_ended()) {
    if (!head.empty()) fail("bytes come after the end");
    return std::nullopt;
  }
  if (head.size() < block_header_bytes) fail("the stream is cut off");
  const char type = head[0];
  const std::uint32_t frame = number32(head, 1);
  const std::uint32_t size = number32(head, 5);
  const std::uint32_t stored_size = number32(head, 9);
  if (size > most_block_bytes || stored_size > most_block_bytes) {
    fail("its size is not possible, so it is damaged");
  }
  const std::string stored = read_bytes(stored_size);
  if (stored.size() < stored_size) fail("the stream is cut off");
  if (number32(head, 13) != checksum(head.substr(0, 13) + stored)) {
    fail("its checksum is wrong, so it is damaged");
  }
  const auto content = decompressed(stored, size);
  if (!content) fail("it cannot be decompressed");
  auto block = block_of(type, frame, *content, *points_, header_.format.planes());
  if (!block) fail("its content is no block of this version");
  if (const std::string problem = points_->problem(*block); !problem.empty()) fail(problem);
  points_->follow(*block);
  ++blocks_;
  return block;
}

}  // namespace kinetri::video
