// SPDX-License-Identifier: GPL-3.0-or-later
//
// The motion of the points of a group.
#ifndef KINETRI_VIDEO_CODEC_GROUP_MOTION_H
#define KINETRI_VIDEO_CODEC_GROUP_MOTION_H

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "video/codec/optical_flow.h"
#include "video/stream/present_points.h"
#include "video/stream/stream.h"

namespace kinetri::video {

/// Points that are followed from frame to frame.
class Followed_points {
 public:
  /// Starts at these positions.
  explicit Followed_points(std::vector<Vector_2> places);

  /// Advances to the next frame of the flow. Lost points are not followed further. A point that is
  /// not found counts as featureless, not lost, if it is outside of the picture of the given size,
  /// or so near to its border that too little of its surroundings is visible.
  void step(const Optical_flow& flow, double width, double height);

  /// The fraction of points with a feature that were lost in the last step; 0 if there were fewer
  /// than ten such points.
  double lost_share() const { return lost_share_; }

  std::size_t steps() const { return places_.size() - 1; }
  /// The position of the point after `step` steps.
  const Vector_2& place(std::size_t point, std::size_t step) const { return places_[step][point]; }
  /// The kind of the point in the steps up to that one: lost if it ever was, else featureless if it
  /// ever was.
  Track::Kind kind(std::size_t point, std::size_t step) const { return kinds_[step][point]; }

 private:
  std::vector<std::vector<Vector_2>> places_;    // by step, then by point
  std::vector<std::vector<Track::Kind>> kinds_;  // the same
  double lost_share_ = 0;
};

/// The targets of points after `frames` steps; none for points to be removed: those that leave the
/// stage, and one of two that come too near to each other. A point without a feature, or a lost
/// one, moves as the mean of its neighbors, so that hidden parts leave no holes. Displacements are
/// relaxed over the edges (indices into `points`). A displacement within one unit of the expected
/// one is replaced by it. The corners rest.
std::vector<std::optional<Place>> targets_of(
    const Stream_header& header, const std::vector<Present_points::Point>& points,
    const Followed_points& followed, std::uint32_t frames,
    std::span<const std::pair<std::size_t, std::size_t>> edges);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_GROUP_MOTION_H
