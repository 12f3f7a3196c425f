// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames for ParaView and VTK: a VTU file each (an unstructured grid of triangles, as XML with
// exact binary64 numbers in base64), and a PVD file with the times of the frames.
#ifndef KINETRI_IO_VTU_FILE_H
#define KINETRI_IO_VTU_FILE_H

#include <iosfwd>
#include <span>
#include <string>

#include "kinetri/triangulation/frame_2.h"

namespace kinetri {

/// Writes a frame as a VTU file:
///
///   points      x, y, 0, in the order of ids
///   cells       the triangles, counterclockwise
///   point data  id; velocity (three components, the last one 0); if there are discs, radius and
///               hidden, which is 1 for points that others hide, else 0
///   field data  TimeValue; events, how many there have been so far; and of each kind events_KIND
///
/// Of a periodic box, points are those within the box; images at which triangles end outside of it
/// follow, each as often as such a corner, with the id and velocity of the point. The point data
/// has `image` too, 1 for these images, else 0; the field data `box`, the corners of the box,
/// counterclockwise, with three components each.
///
/// Errors are those of the stream.
void write_vtu(std::ostream& out, const Frame_2& frame);

/// A file of a series.
struct Vtu_frame {
  double time = 0;   ///< of the frame
  std::string file;  ///< its path relative to the PVD file; without characters that XML escapes
};

/// Writes the PVD file of the series. Errors are those of the stream.
void write_pvd(std::ostream& out, std::span<const Vtu_frame> frames);

}  // namespace kinetri

#endif  // KINETRI_IO_VTU_FILE_H
