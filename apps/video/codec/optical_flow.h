// SPDX-License-Identifier: GPL-3.0-or-later
//
// Optical flow from one frame to the next: pyramidal Lucas-Kanade, by OpenCV. B. D. Lucas, T.
// Kanade, An iterative image registration technique, IJCAI 1981; J.-Y. Bouguet, Pyramidal
// implementation of the Lucas Kanade feature tracker, Intel, 2000.
#ifndef KINETRI_VIDEO_CODEC_OPTICAL_FLOW_H
#define KINETRI_VIDEO_CODEC_OPTICAL_FLOW_H

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::video {

/// The result of following a position.
struct Track {
  enum class Kind {
    followed,     ///< the picture around it is at `place`
    featureless,  ///< the picture around it has no corner to find again
    lost,         ///< it has a corner, which is not found in the next frame
  };
  Kind kind = Kind::lost;
  Vector_2 place;
};

/// Follows positions from frame to frame.
class Optical_flow {
 public:
  Optical_flow(std::uint32_t width, std::uint32_t height);
  ~Optical_flow();

  /// Makes these samples of brightness the next frame, and the previous next frame the present one.
  /// If the whole picture fades, the present frame is first adjusted to the brightness of the next.
  void add(std::span<const std::uint8_t> brightness);

  /// The positions in the next frame. A position counts as followed only if it comes back to within
  /// half a pixel when it is followed backwards (Z. Kalal, K. Mikolajczyk, J. Matas,
  /// Forward-backward error, ICPR 2010). Precondition: two frames were added.
  std::vector<Track> follow(std::span<const Vector_2> places) const;

 private:
  struct Pyramids;

  int width_;
  int height_;
  std::unique_ptr<Pyramids> pyramids_;
};

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_OPTICAL_FLOW_H
