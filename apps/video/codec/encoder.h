// SPDX-License-Identifier: GPL-3.0-or-later
//
// Encodes frames as a stream (method: docs/VIDEO.md).
#ifndef KINETRI_VIDEO_CODEC_ENCODER_H
#define KINETRI_VIDEO_CODEC_ENCODER_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>

#include "video/formats/frame.h"
#include "video/stream/stream.h"

namespace kinetri::video {

/// The placement of the points of a key.
enum class Placement : std::uint8_t {
  content,  ///< where the picture needs them
  grid,     ///< on a grid, for comparison
};

/// The settings of the encoder.
struct Encoder_settings {
  std::size_t points = 2000;  ///< at one time, at most; at least `number_of_corners`
  std::uint32_t group_frames =
      8;  ///< between changes of motion; a power of two up to most_group_frames
  std::uint32_t key_frames = 0;  ///< frames between keys; 0: only necessary keys
  bool has_scene_cuts = true;    ///< whether a scene cut begins with a key
  Placement placement = Placement::content;
  bool has_motion = true;    ///< else points rest; for comparison
  unsigned place_bits = 4;   ///< of Stream_header
  unsigned color_step = 32;  ///< of Stream_header
};

/// Statistics of an encoded video.
struct Encoded {
  std::uint32_t frames = 0;
  std::uint32_t keys = 0;
  std::uint32_t scene_cuts = 0;  ///< of these keys
  std::uint64_t inserted = 0;    ///< points inserted after a key
  std::uint64_t erased = 0;      ///< points erased before the next key
  std::uint64_t events = 0;      ///< of the triangulation
  std::uint64_t bytes = 0;
};

/// Reads all frames and writes the stream block by block. At most a group of frames is in memory.
/// Calls `progress` with the number of frames that are done, after each block. Throws Input_error
/// if there is no frame. Errors of `out` are those of the stream. Precondition: the settings are as
/// above.
Encoded encode(Frame_source& source, std::ostream& out, const Encoder_settings& settings,
               const std::function<void(std::uint32_t)>& progress = nullptr);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_ENCODER_H
