// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detection of degrees of longitude and latitude: by the names of columns, units, comments, and the
// positions themselves.
#ifndef KINETRI_SRC_IO_TRACKS_DEGREES_H
#define KINETRI_SRC_IO_TRACKS_DEGREES_H

#include <cstddef>
#include <string>
#include <string_view>

#include "kinetri/io/tracks_file.h"

namespace kinetri {

/// The kind of angle in the name of a column.
enum class Angle {
  none,       ///< not an angle
  degrees,    ///< degrees of longitude, latitude or another angle
  longitude,  ///< degrees of longitude
  latitude,   ///< degrees of latitude
  radians,    ///< angles in radians
};

/// By the words of a name, which end at signs, blanks and capitals: lon, lat, long, longitude,
/// latitude, their translations, also joined with words such as gps and deg (`location-long`,
/// `decimalLatitude`, `GPSLongitude`, `stoplat`); deg and degrees (`x_deg`, `X (deg)`); names of
/// the reference system WGS 84 (`x_wgs84`, `X_4326`). Not if the name ends in a unit of length, as
/// `lat_m`, and not `lateral` and `longitudinal`.
Angle angle_in_name(std::string_view name);

/// Whether a comment says that positions are longitude and latitude: it names the two, without
/// numbers, or x or y in degrees (x/deg), or the reference system WGS 84 (EPSG:4326) without a
/// projection such as UTM.
bool says_degrees(std::string_view comment);

/// Throws Input_error unless the options choose a treatment of degrees. `name` is that of the file,
/// and `what` the beginning of "... in degrees".
void expect_projection(const std::string& name, std::size_t line, Tracks_projection projection,
                       std::string_view what);

/// The evidence in names of columns of a table.
struct Named_degrees {
  bool are_degrees = false;  ///< whether positions are degrees to be projected
  std::string remark = {};   ///< the conclusion and its reason; empty without evidence
};

/// The evidence in the names of the columns x and y, or in their units. `what` is "columns" or
/// "units", in `line` of the file `name`, if that is not 0. Throws Input_error for two different
/// units of length; and unless the projection is Tracks_projection::none, which keeps angles, for
/// radians, for the latitude as x, and for degrees without a projection.
Named_degrees degrees_in_names(const std::string& name, std::size_t line,
                               Tracks_projection projection, std::string_view what,
                               const std::string& of_x, const std::string& of_y);

/// Whether degrees stand for an unknown position: the longitude 181, or the latitude 91, of AIS
/// (ITU-R M.1371).
bool is_no_place(const Vector_2& degrees);

/// Whether degrees are in their range: at most 180 and 90.
bool is_on_earth(const Vector_2& degrees);

/// Whether a position is the longitude 0 and the latitude 0, in the sea, which many programs write
/// for an unknown position.
inline bool is_null_island(const Vector_2& degrees) {
  return degrees == Vector_2{0, 0};
}

/// The evidence of degrees in the rows of a table, without evidence in names: at least nine in ten
/// positions are in the range of degrees, and at least half of these have four decimals or more;
/// motion would be slow in meters, and is not too fast in degrees; and the unit of time is known,
/// from dates, or seconds since 1970 or decimal fractions of them, or else names of columns are
/// often used for degrees. The position (0, 0) is ignored.
class Signs_of_degrees {
 public:
  /// Adds a position, and the texts of its numbers.
  void note(const Vector_2& place, std::string_view x, std::string_view y);

  /// Throws Input_error if the added rows, those of `file`, have this evidence, and no projection
  /// is chosen. `of_x` and `of_y` are the names of the columns.
  void expect_none(const Tracks_file& file, const std::string& name, Tracks_projection projection,
                   const std::string& of_x, const std::string& of_y) const;

 private:
  std::size_t rows_ = 0;
  std::size_t rows_of_many_digits_ = 0;
  std::size_t rows_in_range_ = 0;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_DEGREES_H
