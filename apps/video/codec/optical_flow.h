// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the picture around a place goes from one frame to the next: pyramidal Lucas-Kanade, by
// OpenCV. B. D. Lucas, T. Kanade, An iterative image registration technique, IJCAI 1981; J.-Y.
// Bouguet, Pyramidal implementation of the Lucas Kanade feature tracker, Intel, 2000.
#ifndef KINETRI_VIDEO_CODEC_OPTICAL_FLOW_H
#define KINETRI_VIDEO_CODEC_OPTICAL_FLOW_H

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::video {

/// What became of a place.
struct Track {
  enum class Kind {
    followed,     ///< the picture around it is at `place`
    featureless,  ///< the picture around it has no corner by which it could be known
    lost,         ///< it has one, which is not in the next frame
  };
  Kind kind = Kind::lost;
  Vector_2 place;
};

/// Follows places from frame to frame.
class Optical_flow {
 public:
  Optical_flow(std::uint32_t width, std::uint32_t height);
  ~Optical_flow();

  /// Makes these samples of brightness the next frame, and the one before the present frame. Where
  /// the whole picture fades from one to the other, the present one is made as bright as the next
  /// one first.
  void add(std::span<const std::uint8_t> brightness);

  /// Where the places go from the present frame to the next one. A place counts as followed only if
  /// it comes back to within half a pixel when it is followed backwards (Z. Kalal, K. Mikolajczyk,
  /// J. Matas, Forward-backward error, ICPR 2010). Precondition: two frames were added.
  std::vector<Track> follow(std::span<const Vector_2> places) const;

 private:
  struct Pyramids;

  int width_;
  int height_;
  std::unique_ptr<Pyramids> pyramids_;
};

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_OPTICAL_FLOW_H
