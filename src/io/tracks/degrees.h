// SPDX-License-Identifier: GPL-3.0-or-later
//
// What tells that places are degrees of longitude and latitude: the names of columns, their units,
// comments, and the places themselves; and what becomes of them then.
#ifndef KINETRI_SRC_IO_TRACKS_DEGREES_H
#define KINETRI_SRC_IO_TRACKS_DEGREES_H

#include <cstddef>
#include <string>
#include <string_view>

#include "kinetri/io/tracks_file.h"

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
/// `longitudinal` such words. Names of the reference system WGS 84 (`x_wgs84`, `X_4326`) say
/// degrees.
Angle angle_in_name(std::string_view name);

/// Whether a comment says that places are longitude and latitude: it names the two, without
/// numbers, or x or y in degrees (x/deg), or the reference system WGS 84 (EPSG:4326) without a
/// projection such as UTM.
bool says_degrees(std::string_view comment);

/// Throws Input_error unless the options say what becomes of degrees. `name` is that of the file,
/// and `what` is in degrees, "the comment says that places are".
void expect_projection(const std::string& name, std::size_t line, Tracks_projection projection,
                       std::string_view what);

/// What names say of the places of a table.
struct Named_degrees {
  bool are_degrees = false;  ///< whether places are degrees that a projection makes metres
  std::string remark = {};   ///< what was concluded, and from what; empty if names say nothing
};

/// What the names of the columns x and y, or their units, say. `what` has these words, "columns" or
/// "units", and stands in `line` of the file `name`, if that is not 0. Throws Input_error if they
/// say two units of length; and unless the projection is Tracks_projection::none, which takes
/// angles as they are, if they say radians, or the latitude as x, or degrees without a projection.
Named_degrees degrees_in_names(const std::string& name, std::size_t line,
                               Tracks_projection projection, std::string_view what,
                               const std::string& of_x, const std::string& of_y);

/// Whether a place in degrees says that there is none: the longitude 181, or the latitude 91, of
/// AIS (ITU-R M.1371).
bool is_no_place(const Vector_2& degrees);

/// Whether a place may be one in degrees: at most 180 and 90.
bool is_on_earth(const Vector_2& degrees);

/// Whether a place is the longitude 0 and the latitude 0, in the sea, which is what many programs
/// write that do not know a place.
inline bool is_null_island(const Vector_2& degrees) {
  return degrees == Vector_2{0, 0};
}

/// What in the rows of a table shows degrees, where no name says what places are: numbers of which
/// nine in ten or more are in the range of degrees, and of these at least half have four decimals
/// or more; motion that would be slow in metres, and not too fast in degrees; and, so that slow is
/// known, dates as times, or seconds since 1970 or thousandths of them or smaller parts, or else
/// names of columns that are often of degrees. The place (0, 0) says nothing.
class Signs_of_degrees {
 public:
  /// Notes a place, and its numbers as texts: the fields that it was read from.
  void note(const Vector_2& place, std::string_view x, std::string_view y);

  /// Throws Input_error if the file of this name, which has all rows that were noted, shows these
  /// signs, and no projection says what becomes of degrees. `of_x` and `of_y` are the names of the
  /// columns.
  void expect_none(const Tracks_file& file, const std::string& name, Tracks_projection projection,
                   const std::string& of_x, const std::string& of_y) const;

 private:
  std::size_t rows_ = 0;
  std::size_t rows_of_many_digits_ = 0;
  std::size_t rows_in_range_ = 0;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_DEGREES_H
