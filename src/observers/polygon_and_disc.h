// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas of polygons within a disc.
#ifndef KINETRI_SRC_OBSERVERS_POLYGON_AND_DISC_H
#define KINETRI_SRC_OBSERVERS_POLYGON_AND_DISC_H

#include <span>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

/// The area of the polygon, whose vertices are counterclockwise, within the disc about (0, 0): no
/// polygon stands for the circle. By Green's theorem it is the sum, over the edges, of the signed
/// area of what the disc and the triangle of the edge and the centre have in common. Along an edge
/// from a to b, that is a triangle where the edge is inside of the disc, and else a sector of the
/// circle. Each of these is off by at most 2^-48 of the square of the radius: where an edge almost
/// touches the circle the ends of the triangle are known less well, but what it then has too much
/// the sector beside it has too little.
double area_within_disc(std::span<const Vector_2> polygon, double radius);

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_POLYGON_AND_DISC_H
