// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads .kvd streams (docs/VIDEO.md).
#ifndef KINETRI_VIDEO_STREAM_STREAM_READER_H
#define KINETRI_VIDEO_STREAM_STREAM_READER_H

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>

#include "kinetri/base/error.h"
#include "video/stream/present_points.h"
#include "video/stream/stream.h"

namespace kinetri::video {

/// A stream is truncated or damaged at a block; the blocks before it have been read. `what()` names
/// the block, its byte, and the first frame that cannot be decoded.
class Damaged_stream_error : public Input_error {
 public:
  using Input_error::Input_error;
};

/// Reads a stream block by block, as it comes. Every block is checked before it is returned: its
/// checksum, and the conditions of stream.h, so that forged blocks are refused as well.
class Stream_reader {
 public:
  /// Reads the header; `name` is for messages. Throws Input_error if it is not the header of a
  /// stream of a known version.
  Stream_reader(std::istream& in, std::string name);

  /// The same of a file, or of standard input ("-").
  static Stream_reader open(const std::string& path);

  const Stream_header& header() const { return header_; }
  const std::string& name() const { return name_; }

  /// The next block; none after the last one, which is End. Throws Damaged_stream_error.
  std::optional<Block> read();

  /// The points after the last block read.
  const Present_points& points() const { return *points_; }
  /// The number of bytes read.
  std::uint64_t bytes() const { return bytes_; }

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::string read_bytes(std::size_t count);

  std::unique_ptr<std::istream> owned_;
  std::istream* in_;
  std::string name_;
  Stream_header header_;
  std::optional<Present_points> points_;
  std::uint64_t bytes_ = 0;
  std::uint64_t block_begin_ = 0;
  std::size_t blocks_ = 0;
};

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_STREAM_STREAM_READER_H
