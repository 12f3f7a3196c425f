// SPDX-License-Identifier: GPL-3.0-or-later
//
// Degrees of longitude and latitude as metres in the plane.
#ifndef KINETRI_SRC_IO_TRACKS_LOCAL_PROJECTION_H
#define KINETRI_SRC_IO_TRACKS_LOCAL_PROJECTION_H

#include <string>

#include "kinetri/io/tracks_file.h"

namespace kinetri {

/// Replaces the places by those of Tracks_projection::local. Throws Input_error if one of them is
/// no place on earth, or if they are on both sides of the antimeridian. The cosine is that of the C
/// library: machines may differ in the last digits.
void project_locally(Tracks_file& file, const std::string& name);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_LOCAL_PROJECTION_H
