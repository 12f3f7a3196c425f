// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ellipsoid of WGS 84 (NIMA TR8350.2, third edition, 2000, table 3.1), and its radii of
// curvature.
#ifndef KINETRI_SRC_IO_TRACKS_WGS84_H
#define KINETRI_SRC_IO_TRACKS_WGS84_H

#include <cmath>
#include <numbers>

namespace kinetri::wgs84 {

inline constexpr double equatorial_radius = 6378137;  ///< in meters
inline constexpr double flattening = 1 / 298.257223563;
/// The square of the eccentricity.
inline constexpr double e2 = flattening * (2 - flattening);

inline constexpr double radians_in_degree = std::numbers::pi / 180;

/// The radii of curvature at a latitude, in meters (J. P. Snyder, Map projections: a working
/// manual, U.S. Geological Survey Professional Paper 1395, 1987, equations 4-18 and 4-20).
struct Radii {
  double meridian = 0;  ///< of the meridian
  double parallel = 0;  ///< of the parallel: the radius in the prime vertical times its cosine
};

/// Of a latitude in degrees, from -90 to 90.
inline Radii radii_at(double latitude) {
  const double phi = latitude * radians_in_degree;
  const double w2 = 1 - e2 * std::sin(phi) * std::sin(phi);
  const double in_prime_vertical = equatorial_radius / std::sqrt(w2);
  return {in_prime_vertical * (1 - e2) / w2, in_prime_vertical * std::cos(phi)};
}

}  // namespace kinetri::wgs84

#endif  // KINETRI_SRC_IO_TRACKS_WGS84_H
