// SPDX-License-Identifier: GPL-3.0-or-later
//
// The transverse Mercator projection of the ellipsoid of WGS 84, by the series of L. Krueger (1912)
// to the sixth order in the third flattening, as C. F. F. Karney gives it: Transverse Mercator with
// an accuracy of a few nanometers, Journal of Geodesy 85, 2011, 475-485, equations 7 to 11 and 35.
// Within 30 degrees of the central meridian the error of the series is less than a micrometer.
#ifndef KINETRI_SRC_IO_TRACKS_TRANSVERSE_MERCATOR_H
#define KINETRI_SRC_IO_TRACKS_TRANSVERSE_MERCATOR_H

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// A position in the plane, and the scale there.
struct Mercator_place {
  Vector_2 place;    ///< in meters: east of the central meridian, and north of the equator
  double scale = 1;  ///< meters in the plane per meter on the ellipsoid, in any direction
};

/// Projects a longitude relative to the central meridian, and a latitude, in degrees; the scale on
/// the central meridian is 0.9996, as in UTM. Precondition: the longitude is from -80 to 80, the
/// latitude from -90 to 90.
Mercator_place transverse_mercator(double longitude, double latitude);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_TRANSVERSE_MERCATOR_H
