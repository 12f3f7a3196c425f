// SPDX-License-Identifier: GPL-3.0-or-later
//
// What tells that places are degrees of longitude and latitude: the names of columns, and their
// units.
#ifndef KINETRI_SRC_IO_TRACKS_DEGREES_H
#define KINETRI_SRC_IO_TRACKS_DEGREES_H

#include <cstddef>
#include <string_view>

#include "tracks_readers.h"

namespace kinetri {

/// What the name of a column says of its numbers.
enum class Angle {
  none,       ///< nothing of angles
  degrees,    ///< they are degrees, of longitude or latitude or another angle
  longitude,  ///< they are degrees of longitude
  latitude,   ///< they are degrees of latitude
  radians,    ///< they are angles in radians
};

/// By the words of a name, which end at signs, blanks and capitals: lon, lat, long, longitude,
/// latitude, their like in other languages, also behind or before words such as gps and deg
/// (`location-long`, `decimalLatitude`, `GPSLongitude`, `stoplat`); deg and degrees (`x_deg`,
/// `X (deg)`). Not where the name ends in a unit of length, as `lat_m` does; nor are `lateral` and
/// `longitudinal` such words.
Angle angle_in_name(std::string_view name);

/// Whether a comment says that places are longitude and latitude: it names the two, without
/// numbers, or x or y in degrees (x/deg), or the reference system WGS 84 (EPSG:4326) without a
/// projection such as UTM.
bool says_degrees(std::string_view comment);

/// What in the rows of a table shows degrees, where no name says what places are: dates as times,
/// numbers that are in the range of degrees, at least half of which have four decimals or more, and
/// motion that would be slow in metres, and not too fast in degrees.
class Signs_of_degrees {
 public:
  /// Notes a place, and the fields that it was read from.
  void note(const Vector_2& place, std::string_view x, std::string_view y);

  /// Throws Input_error if the file, which has all rows that were noted, shows these signs, and the
  /// options do not say what becomes of degrees.
  void expect_none(const Tracks_file& file, const Tracks_input& input) const;

 private:
  std::size_t rows_ = 0;
  std::size_t rows_of_many_digits_ = 0;
  bool are_in_range_ = true;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_DEGREES_H
