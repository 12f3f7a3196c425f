// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/io/text.h"
#include "transverse_mercator.h"
#include "wgs84.h"

namespace kinetri {
namespace {

constexpr double greatest_error = 0.001;
constexpr double widest = 170;  // in degrees of longitude, for all projections

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

// The ranges of positions, in degrees. Longitudes may exceed 180, beyond the antimeridian.
struct Extent {
  Range longitudes;
  Range latitudes;
};

template <class File, class Function>
void for_each_observation(File& file, Function function) {
  for (auto& track : file.tracks) {
    for (auto& seen : track.observations) function(seen);
  }
}

// With longitudes from 0 to 360 if their range is smaller then.
Extent extent_of(Tracks_file& file, const std::string& name) {
  Extent result;
  Range turned;
  const auto from_zero = [](double longitude) {
    return longitude < 0 ? longitude + 360 : longitude;
  };
  for_each_observation(file, [&](const Track_observation& seen) {
    const auto& [longitude, latitude] = seen.place;
    if (std::abs(longitude) > 180 || std::abs(latitude) > 90) {
      throw tracks_error(name, file.place_name, seen.line,
                         joined("the longitude is ", longitude, ", and the latitude ", latitude,
                                "; expected degrees from -180 to 180, and from -90 to 90"));
    }
    result.longitudes.add(longitude);
    result.latitudes.add(latitude);
    turned.add(from_zero(longitude));
  });
  if (result.longitudes.size() <= 180 || turned.size() > 180) return result;
  for_each_observation(file,
                       [&](Track_observation& seen) { seen.place.x = from_zero(seen.place.x); });
  result.longitudes = turned;
  return result;
}

// Bounds the relative error of distances in the equirectangular projection about the center of the
// extent, by the errors of lengths along all meridians and parallels that shortest paths meet.
double error_of_local(const Extent& extent) {
  if (extent.longitudes.size() > widest) return std::numeric_limits<double>::infinity();
  // A shortest path between positions of one latitude is nearer to the pole than they are. By
  // Clairaut's relation it is a great circle in reduced latitudes, whose longitudes are longer by
  // at most 1 / (1 - flattening).
  const double half =
      extent.longitudes.size() / 2 * wgs84::radians_in_degree / (1 - wgs84::flattening);
  const auto toward_pole = [half](double latitude) {
    return std::atan(std::tan(latitude * wgs84::radians_in_degree) / std::cos(half)) /
           wgs84::radians_in_degree;
  };
  const wgs84::Radii middle = wgs84::radii_at(extent.latitudes.middle());
  const auto& [south, north] = extent.latitudes;
  const bool has_equator = south < 0 && north > 0;
  double result = 0;
  // Both radii grow or shrink from the equator to the poles.
  for (const double latitude :
       {south, north, toward_pole(south), toward_pole(north), has_equator ? 0 : south}) {
    const wgs84::Radii there = wgs84::radii_at(latitude);
    result = std::max({result, std::abs(middle.meridian / there.meridian - 1),
                       std::abs(middle.parallel / there.parallel - 1)});
  }
  return result;
}

// The zone of UTM of the center of the extent, from 1 to 60.
int zone_of(const Extent& extent) {
  const double middle = extent.longitudes.middle();
  const double from_zero = middle >= 180 ? middle - 180 : middle + 180;
  return std::min(60, static_cast<int>(std::floor(from_zero / 6)) + 1);
}

// The longitude relative to the central meridian of the zone.
double from_meridian(double longitude, int zone) {
  const double meridian = 6. * zone - 183;
  return std::remainder(longitude - meridian, 360);
}

// Bound of the relative error of lengths in the zone: the scale grows away from the central
// meridian, and toward the equator.
double error_of_utm(const Extent& extent) {
  if (extent.longitudes.size() > widest) return std::numeric_limits<double>::infinity();
  const int zone = zone_of(extent);
  const double west = from_meridian(extent.longitudes.least, zone);
  const double east = from_meridian(extent.longitudes.greatest, zone);
  const auto& [south, north] = extent.latitudes;
  if (std::max(std::abs(west), std::abs(east)) > 80) {
    return std::numeric_limits<double>::infinity();
  }
  double result = 0;
  const bool has_meridian = west <= 0 && east >= 0;
  const bool has_equator = south <= 0 && north >= 0;
  for (const double longitude : {west, east, has_meridian ? 0 : west}) {
    for (const double latitude : {south, north, has_equator ? 0 : south}) {
      result = std::max(result, std::abs(transverse_mercator(longitude, latitude).scale - 1));
    }
  }
  return result;
}

// As "0.034 %". Precondition: it is finite.
std::string percent(double part) {
  return joined(rounded(100 * part, 2), " %");
}

// "from 8 to 12 degrees of longitude and from 0 to 60 of latitude".
std::string text_of(const Extent& extent) {
  return joined("from ", extent.longitudes.least, " to ", extent.longitudes.greatest,
                " degrees of longitude and from ", extent.latitudes.least, " to ",
                extent.latitudes.greatest, " of latitude");
}

void expect_small_error(const Extent& extent, const std::string& name,
                        Tracks_projection projection) {
  const bool is_local = projection == Tracks_projection::local;
  const double local = error_of_local(extent);
  const double utm = error_of_utm(extent);
  if ((is_local ? local : utm) <= greatest_error) return;
  const bool is_other_right = (is_local ? utm : local) <= greatest_error;
  const double wrong = is_local ? local : utm;
  const std::string_view name_of_it = is_local ? "--projection local" : "--projection utm";
  const std::string_view name_of_other = is_local ? "--projection utm" : "--projection local";
  throw Input_error(
      name, 0,
      joined("the places are ", text_of(extent), ": ",
             std::isfinite(wrong)
                 ? joined("by ", name_of_it, " distances would be wrong by up to ", percent(wrong))
                 : joined("too far apart for ", name_of_it, " to keep distances"),
             ", and 0.1 % is allowed; expected ",
             is_other_right ? joined(name_of_other, ", by which they are wrong by at most ",
                                     percent(is_local ? utm : local), ", or ")
                            : std::string(),
             "a file for each region, or --projection none, which takes degrees as they are"));
}

void project_locally(Tracks_file& file, const Extent& extent) {
  const Vector_2 middle = {extent.longitudes.middle(), extent.latitudes.middle()};
  const auto [meridian, parallel] = wgs84::radii_at(middle.y);
  const double of_longitude = parallel * wgs84::radians_in_degree;
  const double of_latitude = meridian * wgs84::radians_in_degree;
  for_each_observation(file, [&](Track_observation& seen) {
    seen.place = {of_longitude * (seen.place.x - middle.x),
                  of_latitude * (seen.place.y - middle.y)};
  });
  file.remarks.push_back(
      joined("places are in meters from the longitude ", middle.x, " and the latitude ", middle.y,
             " (equirectangular projection of the ellipsoid of WGS 84); distances are off by at "
             "most ",
             percent(error_of_local(extent))));
}

void project_to_zone(Tracks_file& file, const Extent& extent) {
  const int zone = zone_of(extent);
  const bool is_south = extent.latitudes.greatest < 0;
  for_each_observation(file, [&](Track_observation& seen) {
    const auto [x, y] = transverse_mercator(from_meridian(seen.place.x, zone), seen.place.y).place;
    seen.place = {500000 + x, is_south ? 10000000 + y : y};
  });
  file.remarks.push_back(joined("places are in meters of UTM, zone ", zone,
                                is_south ? " south (EPSG:327" : " north (EPSG:326",
                                zone < 10 ? "0" : "", zone, "); distances are off by at most ",
                                percent(error_of_utm(extent))));
}

}  // namespace

void project(Tracks_file& file, const std::string& name, Tracks_projection projection) {
  KINETRI_PRECONDITION(
      projection == Tracks_projection::local || projection == Tracks_projection::utm,
      "the projection makes no meters of degrees");
  if (file.tracks.empty()) return;
  const Extent extent = extent_of(file, name);
  expect_small_error(extent, name, projection);
  if (projection == Tracks_projection::local) {
    project_locally(file, extent);
  } else {
    project_to_zone(file, extent);
  }
}

}  // namespace kinetri
