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

/// What frames are made.
struct Decoder_settings {
  Interpolation style = Interpolation::linear;
  std::optional<Ratio> rate;            ///< frames a second; as the source if there is none
  std::optional<std::uint32_t> width;   ///< as the source if there is none
  std::optional<std::uint32_t> height;  ///< the same
};

/// What a stream was found to be while it was decoded.
struct Decoded {
  std::uint32_t source_frames = 0;  ///< of the source, as far as the stream is whole
  std::uint64_t frames = 0;         ///< that were made
  std::uint64_t events = 0;         ///< of the triangulation
};

/// The format of the frames that are made.
Video_format decoded_format(const Video_format& source, const Decoder_settings& settings);

/// Makes the frames: frame j is the picture at the exact time j / rate, for all times before the
/// end of the last source frame. Calls `take` for each, in order. Reads the stream block by block.
///
/// Throws Damaged_stream_error where the stream is damaged, after all frames before that place have
/// been made: `decoded` has their number then.
void decode(Stream_reader& stream, const Decoder_settings& settings,
            const std::function<void(const Frame&)>& take, Decoded& decoded);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_DECODER_H
