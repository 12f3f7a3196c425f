// SPDX-License-Identifier: GPL-3.0-or-later
//
// Placement of points: error-driven insertion into the Delaunay triangulation, many points a
// round. M. Garland, P. S. Heckbert, Fast polygonal approximation of terrains and height fields,
// Carnegie Mellon University, CMU-CS-95-181, 1995.
#ifndef KINETRI_VIDEO_CODEC_PLACEMENT_H
#define KINETRI_VIDEO_CODEC_PLACEMENT_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinetri/triangulation/field_2.h"
#include "video/formats/frame.h"
#include "video/stream/stream.h"

namespace kinetri::video {

/// A place for a new point.
struct Candidate {
  Place place;
  double error = 0;  ///< the sum of squares in the triangle that it is in
};

/// For each triangle, and of a large one for each square of 16 x 16 pixels, the center of the pixel
/// at which the error is largest, except pixels within two pixels of the triangle's corners; those
/// of the largest sum of squares first. `error` has a number for each sample of brightness.
std::vector<Candidate> candidates(const Stream_header& header,
                                  std::span<const Corner_weights> weights,
                                  std::span<const double> error,
                                  std::span<const Vector_2> positions);

/// Sorts positions into the order in which new points are stored: strips from top to bottom, so
/// that successive ones are near each other.
void sort_places(const Stream_header& header, std::span<Place> places);

/// The distance of points in a ring around the picture, for that number of points.
double ring_spacing(const Stream_header& header, std::size_t count);

/// Positions around the picture: on its border if the stage has no margin, else in two rings on the
/// margin, the outer one with half as many. Points that enter the picture start there.
std::vector<Place> ring_places(const Stream_header& header, double spacing);

/// The places of a key: the corners of the stage, rings around the picture as far as a half of the
/// points reaches, and points in the picture. At most `count`, which is at least
/// `number_of_corners`; fewer if the picture is reproduced before.
std::vector<Place> places_by_content(const Stream_header& header, const Frame& frame,
                                     std::size_t count);

/// The same on a grid, whatever the picture. Precondition: the stage has no margin.
std::vector<Place> places_on_grid(const Stream_header& header, std::size_t count);

/// A sample of a plane at a position, bilinear between the nearest ones; outside of the picture
/// that of the nearest position in it.
double sample_at(const Stream_header& header, const Frame& frame, std::size_t plane,
                 const Vector_2& position);

/// The position in pixels.
Vector_2 position_of(const Stream_header& header, const Place& place);

/// The nearest place of the stream, which is on the stage.
Place place_at(const Stream_header& header, const Vector_2& position);

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_CODEC_PLACEMENT_H
