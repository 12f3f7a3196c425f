// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the points of a group go.
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
  /// From these places on.
  explicit Followed_points(std::vector<Vector_2> places);

  /// Goes to the next frame of the flow. Points that are lost are not followed any further. One
  /// that is outside of the picture of the given size, or so near to its border that the flow does
  /// not see enough around it to know it again, counts as featureless where it is not found.
  void step(const Optical_flow& flow, double width, double height);

  /// Of the points that had a feature in the last step, the share that was lost; 0 if there were
  /// fewer than ten such points.
  double lost_share() const { return lost_share_; }

  std::size_t steps() const { return places_.size() - 1; }
  /// Where the point was after some steps.
  const Vector_2& place(std::size_t point, std::size_t step) const { return places_[step][point]; }
  /// What became of the point in the steps up to that one: lost if it ever was, else featureless if
  /// it ever was.
  Track::Kind kind(std::size_t point, std::size_t step) const { return kinds_[step][point]; }

 private:
  std::vector<std::vector<Vector_2>> places_;    // by step, then by point
  std::vector<std::vector<Track::Kind>> kinds_;  // the same
  double lost_share_ = 0;
};

/// The targets of points after `frames` steps; none for those that are to go: those that leave the
/// stage, and of two that come too near to each other one. A point without a feature, or a lost
/// one, moves as the mean of its neighbors: what is hidden leaves no hole. Displacements are
/// relaxed over the edges (indices into `points`). A displacement that is within one unit of the
/// expected one is that. The corners rest.
std::vector<std::optional<Place>> targets_of(
    const Stream_header& header, const std::vector<Present_points::Point>& points,
    const Followed_points& followed, std::uint32_t frames,
    std::span<const std::pair<std::size_t, std::size_t>> edges);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_GROUP_MOTION_H
