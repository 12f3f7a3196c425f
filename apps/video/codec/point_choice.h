// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least valuable points of a picture, and positions where points are missing although no error
// shows it.
#ifndef KINETRI_VIDEO_CODEC_POINT_CHOICE_H
#define KINETRI_VIDEO_CODEC_POINT_CHOICE_H

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/triangulation/field_2.h"
#include "video/codec/placement.h"
#include "video/stream/present_points.h"
#include "video/stream/stream.h"

namespace kinetri::video {

/// A point that may be removed.
struct Removable {
  double worth = 0;       ///< estimated sum of squared errors that its removal adds
  std::size_t index = 0;  ///< of the point
};

/// The points that may be removed, the least valuable first: all but the corners and those of the
/// rings. The worth of a point is the squared difference of its brightness from the value that its
/// neighbors predict, times its number of samples (the anticipated error of adaptive thinning: N.
/// Dyn, M. S. Floater, A. Iske, Adaptive thinning for bivariate scattered data, Journal of
/// Computational and Applied Mathematics 145, 2002; here a linear function is fitted to the
/// neighbors). `count`: the greatest number of points; `weights` and `edges`: of the triangulation,
/// by number of the points.
std::vector<Removable> removable_points(const Stream_header& header, std::size_t count,
                                        const std::vector<Present_points::Point>& points,
                                        std::span<const Corner_weights> weights,
                                        std::span<const Edge_ids> edges);

/// Positions of the rings around the picture without a point near them, as candidates preferred to
/// others.
std::vector<Candidate> ring_gaps(const Stream_header& header, std::size_t count,
                                 const std::vector<Present_points::Point>& points);

/// A point that enters the picture.
struct Entering {
  Place begin;   ///< outside of the picture
  Place target;  ///< in the picture
};

/// Points for parts that enter the picture until the targets are reached, and contain no target:
/// each moves as the nearest point with a target.
std::vector<Entering> entering_points(const Stream_header& header, std::size_t count,
                                      const std::vector<Present_points::Point>& points,
                                      const std::vector<std::optional<Place>>& targets);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_POINT_CHOICE_H
