// SPDX-License-Identifier: GPL-3.0-or-later
//
// A drawing as SVG: edges, hull, points, discs and box at one time.
#ifndef KINETRI_IO_SVG_FRAME_H
#define KINETRI_IO_SVG_FRAME_H

#include <cstddef>
#include <iosfwd>
#include <optional>

#include "kinetri/simulation/box_2.h"
#include "kinetri/triangulation/frame_2.h"

namespace kinetri {

/// The common layout of the drawings of a run.
struct Svg_view {
  Box_2 extent;  ///< the visible area; discs about its points are visible too
  std::optional<Box_2> box = std::nullopt;  ///< drawn if there is one
  double radius = 0;                        ///< about the greatest radius of the discs: the margin
  std::size_t points = 0;  ///< about their number: the more, the finer dots and lines
};

/// Writes an SVG drawing with its time below. One `path` of the class `edges` and one of the class
/// `hull` have a line `M x yL x y` for each edge, which is in one of the two; the groups of the
/// classes `points` and `discs` (if there are discs) have a `circle` for each point. Hidden points
/// are in the groups `hidden-points` and `hidden-discs` instead: hollow dots, and dashed circles.
///
/// Of a periodic box, `box` is a path, its outline. There is no `hull`; edges that leave the box
/// are in a path `leaving-edges`, from each of their ends to the image of the other one, and
/// `images` has a `circle` at each of these images.
///
/// Coordinates are rounded to hundredths of a pixel. Drawings are clipped to the extent; positions
/// that are not finite are omitted. Drawings of one view have one size, with even numbers of pixels
/// for video encoders. Errors are those of the stream. Precondition: the extent is finite, and its
/// lower bounds are not above the upper ones.
void write_svg_frame(std::ostream& out, const Frame_2& frame, const Svg_view& view);

}  // namespace kinetri

#endif  // KINETRI_IO_SVG_FRAME_H
