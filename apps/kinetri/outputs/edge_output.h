// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges of a simulation of any kind of motion.
#ifndef KINETRI_APPS_EDGE_OUTPUT_H
#define KINETRI_APPS_EDGE_OUTPUT_H

#include <iosfwd>

namespace kinetri::app {

class Any_simulation;

/// Writes the present edges, in a periodic box with their offsets.
void write_present_edges(std::ostream& out, const Any_simulation& simulation);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_EDGE_OUTPUT_H
