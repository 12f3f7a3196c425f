// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures the difference of two videos.
#ifndef KINETRI_VIDEO_CODEC_QUALITY_H
#define KINETRI_VIDEO_CODEC_QUALITY_H

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "video/formats/frame.h"

namespace kinetri::video {

/// The quality of one frame by plane; 0 for absent planes.
struct Frame_quality {
  std::array<double, 3> mean_square = {};  ///< of the differences of samples
  std::array<double, 3> ssim = {};         ///< structural similarity: 1 for equal planes

  /// 10 log10(255^2 / mean_square): infinite for equal planes.
  double psnr(std::size_t plane) const;
};

/// Mean structural similarity of two planes with a Gaussian window of 11 x 11 samples. Z. Wang, A.
/// C. Bovik, H. R. Sheikh, E. P. Simoncelli, Image quality assessment: from error visibility to
/// structural similarity, IEEE Transactions on Image Processing 13, 2004.
double ssim(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
            std::size_t columns, std::size_t rows);

/// Compares videos frame by frame.
class Quality {
 public:
  explicit Quality(const Video_format& format) : format_(format) {}

  /// Adds a frame of the source and the corresponding one of the other video. Precondition: both
  /// have the format.
  void add(const Frame& source, const Frame& other);

  const std::vector<Frame_quality>& frames() const { return frames_; }
  /// The mean of all frames.
  Frame_quality mean() const;
  /// The mean change from frame to frame, in the other video, of samples of brightness that change
  /// by at most 1 in the source. None if there are no such samples.
  std::optional<double> flicker() const;

 private:
  Video_format format_;
  std::vector<Frame_quality> frames_;
  Frame last_source_;
  Frame last_other_;
  double changes_ = 0;
  std::uint64_t resting_ = 0;
};

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_QUALITY_H
