// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas of polygons within a disc.
#ifndef KINETRI_SRC_OBSERVERS_POLYGON_AND_DISC_H
#define KINETRI_SRC_OBSERVERS_POLYGON_AND_DISC_H

#include <span>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

/// The area of the polygon, whose vertices are counterclockwise, within the disc about (0, 0). By
/// Green's theorem it is the sum, over the edges, of the signed area of the intersection of the
/// disc with the triangle of the edge and the center. Along an edge, that is a triangle inside the
/// disc, and a sector of the circle outside. The error of each is at most 2^-48 of the square of
/// the radius: if an edge almost touches the circle, the ends of the triangle are less accurate,
/// but the errors of the triangle and the adjacent sector cancel.
double area_within_disc(std::span<const Vector_2> polygon, double radius);

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_POLYGON_AND_DISC_H
