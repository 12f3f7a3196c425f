// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fits the colors of a moving picture to frames.
#ifndef KINETRI_VIDEO_CODEC_PICTURE_FIT_H
#define KINETRI_VIDEO_CODEC_PICTURE_FIT_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kinetri/triangulation/field_2.h"
#include "video/codec/color_fit.h"
#include "video/codec/moving_picture.h"
#include "video/formats/frame.h"
#include "video/stream/present_points.h"
#include "video/stream/stream.h"

namespace kinetri::video {

/// Fits colors to frames, and keeps the weights of the last one.
class Picture_fit {
 public:
  using Points = std::vector<Present_points::Point>;
  using Frames = std::function<const Frame&(std::uint32_t)>;  ///< by number

  explicit Picture_fit(const Stream_header& header);

  /// Finds the colors of `targets`, one for each point: those at the end of a group that begins at
  /// the time `first` with the colors of the points, and has so many frames; 0 at a key, whose
  /// colors are fitted to that frame alone. Advances the picture to the end. A color that would
  /// change little is kept, and those of the first `fixed` points always are.
  void fit(Moving_picture& picture, const Points& points, std::uint32_t first, std::uint32_t frames,
           const Frames& frame, std::vector<Node>& targets, std::size_t fixed = 0);

  /// Of the samples of brightness of the frame that was fitted last.
  std::span<const Corner_weights> weights() const { return weights_; }

  /// The errors of brightness in the frame fitted last, with the colors of the points.
  std::vector<double> error(const Points& points, const Frame& frame) const;

  /// The nearest color of the stream.
  std::int16_t quantized(double value) const;

 private:
  // Planes with samples at the same positions.
  struct Plane_set {
    std::size_t first = 0;
    std::size_t count = 1;
    Grid_2 grid;
  };

  static std::vector<Plane_set> plane_sets(const Video_format& format);
  double unit() const { return header_.color_step / 8.0; }
  void add_frame(const Moving_picture& picture, const Plane_set& set, const Frame& frame,
                 double importance, double share, std::vector<double> colors, Color_fit& fit);

  Stream_header header_;
  std::vector<Plane_set> sets_;
  std::vector<Corner_weights> weights_;        // of brightness
  std::vector<Corner_weights> color_weights_;  // of color
};

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_PICTURE_FIT_H
