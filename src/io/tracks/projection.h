// SPDX-License-Identifier: GPL-3.0-or-later
//
// Projections from degrees of longitude and latitude to meters.
#ifndef KINETRI_SRC_IO_TRACKS_PROJECTION_H
#define KINETRI_SRC_IO_TRACKS_PROJECTION_H

#include <string>

#include "kinetri/io/tracks_file.h"

namespace kinetri {

/// Projects the positions, which are degrees, and adds a remark with the bound of the error of
/// distances. Throws Input_error if a position is not on earth, or if the bound exceeds 0.1 %.
/// Precondition: the projection is local or utm.
void project(Tracks_file& file, const std::string& name, Tracks_projection projection);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_PROJECTION_H
