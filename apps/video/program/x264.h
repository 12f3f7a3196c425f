// SPDX-License-Identifier: GPL-3.0-or-later
//
// The block codec x264 at as many bits, for comparison, through the program ffmpeg.
#ifndef KINETRI_VIDEO_PROGRAM_X264_H
#define KINETRI_VIDEO_PROGRAM_X264_H

#include <cstdint>
#include <optional>
#include <string>

#include "video/codec/quality.h"
#include "video/formats/frame.h"

namespace kinetri::video {

/// The result of encoding with x264.
struct X264_result {
  /// Why there is no comparison; empty if there is one.
  std::string problem;
  std::uint64_t bytes = 0;  ///< of the H.264 stream, without a container
  std::optional<Quality> quality;
};

/// Encodes the frames of the source, which is opened twice, in two passes by x264 with the settings
/// `medium`, so that they take about `bytes` bytes, and compares the result with the source. x264
/// may miss that number, especially a small one. Throws Input_error as the source does. Runs the
/// shell and `ffmpeg`, and keeps files in a temporary folder meanwhile.
X264_result x264_at(const std::string& source, const Ratio& rate, std::uint64_t bytes,
                    std::uint64_t frames);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_PROGRAM_X264_H
