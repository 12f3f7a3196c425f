// SPDX-License-Identifier: GPL-3.0-or-later
#include "local_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/text.h"

namespace kinetri {
namespace {

// The mean radius (2a + b) / 3 of the ellipsoid GRS 80 in metres (H. Moritz, Geodetic reference
// system 1980, Journal of Geodesy 74, 2000).
constexpr double mean_radius = 6371008.8;
constexpr double radians_in_degree = std::numbers::pi / 180;

struct Range {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();

  void add(double number) {
    least = std::min(least, number);
    greatest = std::max(greatest, number);
  }
  double size() const { return greatest - least; }
  double middle() const { return least + size() / 2; }
};

template <class Function>
void for_each_observation(Tracks_file& file, Function function) {
  for (Track& track : file.tracks) {
    for (Track_observation& seen : track.observations) function(seen);
  }
}

}  // namespace

void project_locally(Tracks_file& file, const std::string& name) {
  if (file.tracks.empty()) return;
  Range longitudes;
  Range latitudes;
  for_each_observation(file, [&](const Track_observation& seen) {
    const auto& [longitude, latitude] = seen.place;
    if (std::abs(longitude) > 180 || std::abs(latitude) > 90) {
      throw tracks_error(name, file.place_name, seen.line,
                         joined("the longitude is ", longitude, ", and the latitude ", latitude,
                                "; expected degrees from -180 to 180, and from -90 to 90"));
    }
    longitudes.add(longitude);
    latitudes.add(latitude);
  });
  if (longitudes.size() > 180) {
    throw Input_error(
        name, 0,
        joined("the longitudes are from ", longitudes.least, " to ", longitudes.greatest,
               " degrees, as if the places were around the antimeridian; expected "
               "places that are less than 180 degrees apart"));
  }
  const Vector_2 middle = {longitudes.middle(), latitudes.middle()};
  const double metres_in_degree = mean_radius * radians_in_degree;
  const double of_longitude = metres_in_degree * std::cos(middle.y * radians_in_degree);
  for_each_observation(file, [&](Track_observation& seen) {
    seen.place = {of_longitude * (seen.place.x - middle.x),
                  metres_in_degree * (seen.place.y - middle.y)};
  });
  file.remarks.push_back(joined("places are in metres from the longitude ", middle.x,
                                " and the latitude ", middle.y, " (equirectangular projection)"));
}

}  // namespace kinetri
