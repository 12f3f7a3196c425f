// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames from a stream, at any frame rate and size.
#ifndef KINETRI_VIDEO_CODEC_DECODER_H
#define KINETRI_VIDEO_CODEC_DECODER_H

#include <cstdint>
#include <functional>
#include <optional>

#include "video/codec/moving_picture.h"
#include "video/formats/frame.h"
#include "video/stream/stream_reader.h"

namespace kinetri::video {

/// The settings of the frames to make.
struct Decoder_settings {
  Interpolation style = Interpolation::linear;
  std::optional<Ratio> rate;            ///< frames a second; by default that of the source
  std::optional<std::uint32_t> width;   ///< by default that of the source
  std::optional<std::uint32_t> height;  ///< the same
};

/// Statistics of a decoded stream.
struct Decoded {
  std::uint32_t source_frames = 0;  ///< of the source, up to a damaged block
  std::uint64_t frames = 0;         ///< frames made
  std::uint64_t events = 0;         ///< of the triangulation
};

/// The format of the frames that are made.
Video_format decoded_format(const Video_format& source, const Decoder_settings& settings);

/// Makes the frames: frame j is the picture at the exact time j / rate, for all times before the
/// end of the last source frame. Calls `take` for each, in order. Reads the stream block by block.
///
/// Throws Damaged_stream_error if the stream is damaged, after making all frames before that place;
/// `decoded` then has their number.
void decode(Stream_reader& stream, const Decoder_settings& settings,
            const std::function<void(const Frame&)>& take, Decoded& decoded);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_DECODER_H
