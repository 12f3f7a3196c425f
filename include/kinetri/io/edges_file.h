// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of edges: the header line a,b, then the ends of one edge a line. In a periodic box the
// header is a,b,offset, and the third field is the offset of the second end against the first, as
// in "1 -2".
#ifndef KINETRI_IO_EDGES_FILE_H
#define KINETRI_IO_EDGES_FILE_H

#include <iosfwd>
#include <span>

#include "kinetri/events/event.h"

namespace kinetri {

/// Writes the edges in the given order. Other programs expect them sorted, as by
/// Kinetic_delaunay_triangulation_2::finite_edge_ids. Errors are those of the stream.
void write_edges(std::ostream& out, std::span<const Edge_ids> edges);

/// Writes the edges of a triangulation in a periodic box in the given order. Other programs expect
/// them sorted, as by Kinetic_triangulation_2::periodic_edges. Errors are those of the stream.
void write_periodic_edges(std::ostream& out, std::span<const Periodic_edge> edges);

}  // namespace kinetri

#endif  // KINETRI_IO_EDGES_FILE_H
