// SPDX-License-Identifier: GPL-3.0-or-later
#include "transverse_mercator.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "kinetri/impl/base/check.h"
#include "wgs84.h"

namespace kinetri {
namespace {

using wgs84::e2;
using wgs84::equatorial_radius;
using wgs84::flattening;

constexpr double scale_on_meridian = 0.9996;

// The third flattening, and its powers.
constexpr double n = flattening / (2 - flattening);
constexpr double n2 = n * n;
constexpr double n3 = n2 * n;
constexpr double n4 = n3 * n;
constexpr double n5 = n4 * n;
constexpr double n6 = n5 * n;

// 2 pi times this is the length of a meridian (equation 14).
constexpr double rectifying_radius =
    equatorial_radius / (1 + n) * (1 + n2 / 4 + n4 / 64 + n6 / 256);

// Equation 35.
constexpr std::array<double, 6> alpha = {
    n / 2 - 2 * n2 / 3 + 5 * n3 / 16 + 41 * n4 / 180 - 127 * n5 / 288 + 7891 * n6 / 37800,
    13 * n2 / 48 - 3 * n3 / 5 + 557 * n4 / 1440 + 281 * n5 / 630 - 1983433 * n6 / 1935360,
    61 * n3 / 240 - 103 * n4 / 140 + 15061 * n5 / 26880 + 167603 * n6 / 181440,
    49561 * n4 / 161280 - 179 * n5 / 168 + 6601661 * n6 / 7257600,
    34729 * n5 / 80640 - 3418889 * n6 / 1995840,
    212378941 * n6 / 319334400};

}  // namespace

Mercator_place transverse_mercator(double longitude, double latitude) {
  KINETRI_PRECONDITION(std::abs(longitude) <= 80 && std::abs(latitude) <= 90,
                       "a place is too far from the central meridian, or not on earth");
  const double lambda = longitude * wgs84::radians_in_degree;
  const double phi = latitude * wgs84::radians_in_degree;
  const double e = std::sqrt(e2);
  // The tangents of the latitude and of the conformal latitude (equations 7 to 9).
  const double tau = std::tan(phi);
  const double secant = std::hypot(1, tau);
  const double sigma = std::sinh(e * std::atanh(e * tau / secant));
  const double tau_prime = tau * std::hypot(1, sigma) - sigma * secant;
  const double cosine = std::cos(lambda);
  const double xi_prime = std::atan2(tau_prime, cosine);
  const double eta_prime = std::asinh(std::sin(lambda) / std::hypot(tau_prime, cosine));
  double xi = xi_prime;
  double eta = eta_prime;
  double p = 1;
  double q = 0;
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    const double j = 2 * static_cast<double>(i + 1);
    xi += alpha[i] * std::sin(j * xi_prime) * std::cosh(j * eta_prime);
    eta += alpha[i] * std::cos(j * xi_prime) * std::sinh(j * eta_prime);
    p += j * alpha[i] * std::cos(j * xi_prime) * std::cosh(j * eta_prime);
    q += j * alpha[i] * std::sin(j * xi_prime) * std::sinh(j * eta_prime);
  }
  constexpr double radius = scale_on_meridian * rectifying_radius;
  // Equations 24 and 25, of the sphere and of the series.
  const double of_sphere =
      std::sqrt(1 - e2 * std::pow(std::sin(phi), 2)) * secant / std::hypot(tau_prime, cosine);
  const double of_series = rectifying_radius / equatorial_radius * std::hypot(p, q);
  return {{radius * eta, radius * xi}, scale_on_meridian * of_sphere * of_series};
}

}  // namespace kinetri
