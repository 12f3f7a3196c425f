// SPDX-License-Identifier: GPL-3.0-or-later
//
// Degrees of longitude and latitude as metres in the plane.
#ifndef KINETRI_SRC_IO_TRACKS_PROJECTION_H
#define KINETRI_SRC_IO_TRACKS_PROJECTION_H

#include <string>

#include "kinetri/io/tracks_file.h"

namespace kinetri {

/// Replaces the places, which are degrees, by those of the projection, and adds a remark on how far
/// distances are off. Throws Input_error if one of them is no place on earth, or if distances can
/// be off by more than 0.1 %. Precondition: the projection is local or utm.
void project(Tracks_file& file, const std::string& name, Tracks_projection projection);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_PROJECTION_H
