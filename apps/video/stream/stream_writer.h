// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes .kvd streams (docs/VIDEO.md).
#ifndef KINETRI_VIDEO_STREAM_STREAM_WRITER_H
#define KINETRI_VIDEO_STREAM_STREAM_WRITER_H

#include <cstdint>
#include <iosfwd>

#include "video/stream/present_points.h"
#include "video/stream/stream.h"

namespace kinetri::video {

class Stream_writer {
 public:
  /// Writes the header. Errors are those of the stream. Precondition: the header is one that
  /// Stream_reader accepts.
  Stream_writer(std::ostream& out, const Stream_header& header);

  /// Writes the next block. Precondition: Present_points::problem is empty for it. The same blocks
  /// give the same bytes with the same version of zstd.
  void write(const Block& block);

  /// The points after the last block written.
  const Present_points& points() const { return points_; }
  /// The number of bytes written.
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::ostream& out_;
  Present_points points_;
  std::size_t planes_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_STREAM_STREAM_WRITER_H
