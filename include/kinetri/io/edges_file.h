// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of edges: the header line a,b, then the ends of one edge a line.
#ifndef KINETRI_IO_EDGES_FILE_H
#define KINETRI_IO_EDGES_FILE_H

#include <iosfwd>
#include <span>

#include "kinetri/events/event.h"

namespace kinetri {

/// Writes the edges in the given order. Other programs expect them sorted, as by
/// Kinetic_delaunay_triangulation_2::finite_edge_ids. Errors are those of the stream.
void write_edges(std::ostream& out, std::span<const Edge_ids> edges);

}  // namespace kinetri

#endif  // KINETRI_IO_EDGES_FILE_H
