// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames for ParaView and VTK: one VTU file each (an unstructured grid of triangles, as XML with
// numbers in base64, so that every binary64 number is read back exactly), and a PVD file that says
// which frame is at which time.
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
///   point data  id; velocity (three components, the last one 0); where there are discs, radius and
///               hidden, which is 1 for points that others hide, else 0
///   field data  TimeValue; events, how many there have been so far; and of each kind events_KIND
///
/// Without points or triangles the file is one without points or cells. Errors are those of the
/// stream.
void write_vtu(std::ostream& out, const Frame_2& frame);

/// A file of a series.
struct Vtu_frame {
  double time = 0;   ///< of the frame
  std::string file;  ///< as seen from the PVD file; its name needs no escapes in XML
};

/// Writes the PVD file of the series. Errors are those of the stream.
void write_pvd(std::ostream& out, std::span<const Vtu_frame> frames);

}  // namespace kinetri

#endif  // KINETRI_IO_VTU_FILE_H
