// SPDX-License-Identifier: GPL-3.0-or-later
//
// A frame as a picture: edges, hull, points, discs and box, as SVG.
#ifndef KINETRI_IO_SVG_FRAME_H
#define KINETRI_IO_SVG_FRAME_H

#include <cstddef>
#include <iosfwd>
#include <optional>

#include "kinetri/simulation/box_2.h"
#include "kinetri/triangulation/frame_2.h"

namespace kinetri {

/// What the pictures of a run have in common, so that only what moves moves.
struct Svg_view {
  Box_2 extent;                             ///< what is to be seen; discs about its points too
  std::optional<Box_2> box = std::nullopt;  ///< drawn if there is one
  double radius = 0;       ///< about the greatest of the discs: there is so much room at the sides
  std::size_t points = 0;  ///< about how many there are: the more, the finer dots and lines
};

/// Writes a frame as an SVG picture with its time below. One `path` of the class `edges` and one of
/// the class `hull` have a line `M x yL x y` for each edge, which is in one of the two; the groups
/// of the classes `points` and `discs`, the latter where there are discs, have a `circle` for each
/// point. Those of points that others hide are in the groups `hidden-points` and `hidden-discs`
/// instead, which are there if any are: hollow dots, and dashed circles.
///
/// Coordinates are rounded to hundredths of a pixel. What lies outside of the extent is cut off;
/// what is at a place that is not finite is left out. Pictures of one view have one size, in even
/// numbers of pixels as video encoders ask for. Errors are those of the stream. Precondition: the
/// extent is finite, and its lower bounds are not above the upper ones.
void write_svg_frame(std::ostream& out, const Frame_2& frame, const Svg_view& view);

}  // namespace kinetri

#endif  // KINETRI_IO_SVG_FRAME_H
