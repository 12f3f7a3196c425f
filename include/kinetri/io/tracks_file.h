// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of recorded tracks: observed positions and times of moving things, each with an id. Rows
// may be in any order. The formats:
//
//   rows     comma separated, a header line naming the columns t, id, x, y and optionally radius,
//            of a disc about the thing, and z, which is ignored, in any order; an id is any text
//            without commas; quotation marks belong to it; all rows of an id have the same radius
//   frames   no header; four fields `frame id x y` separated by tabs or blanks, the form of some
//            public data sets of pedestrians; a frame is a finite number, an id any text
//   ids      no header; fields `id frame x y`, and further ones that are ignored (z), separated by
//            tabs or blanks, the form of other public data sets of pedestrians
//   table    any table whose columns Track_columns names, by their names in its header or, if it
//            has none, by their numbers; separated by commas, semicolons, tabs or blanks; fields
//            may be quoted (RFC 4180)
//   jupedsim a database of SQLite as JuPedSim writes it, of version 1, 2 or 3
//   sumo     XML with floating-car data, as SUMO writes it: fcd-export
//   gpx      XML with tracks of GPS receivers: gpx
//   trackmate XML with tracks of TrackMate: Tracks
//   lammps   a text dump of LAMMPS with the columns id and x y, xu yu, xs ys or xsu ysu
//   xyz      XYZ, plain or extended, with several frames
//   geojson  GeoJSON: points with properties for id and time, lines with a time for each position
//
// In rows, frames, ids and table, blank lines and comments, which begin with #, are skipped. A line
// that begins with # is a row, not a comment, if it has as many fields as the others, valid
// numbers, and in its first field an id that is not a number, such as #1.
//
// A file in UTF-16 is read as the same text in UTF-8.
//
// In rows and table, lines below the header whose times and coordinates do not begin with a digit,
// sign or point name units, and are ignored. Not an observation, and ignored: a row whose
// coordinates are both empty, or one of them NaN, NA, N/A, null or None; in a table, a row without
// an id; if positions are in degrees, a row at the latitude 91 or the longitude 181, which stand
// for an unknown position in AIS, and a row at (0, 0) if all others are farther than a degree from
// there; a feature of GeoJSON without geometry, or with null or NaN for all coordinates.
//
// In a table, a first column without a name in the header and with a quoted first field has the
// names of rows, as written by R's write.table, and is ignored.
//
// Files with rows `frame id x y` and with rows `id frame x y` look alike. The evidence of the order
// is a comment that names the columns, without which Tracks_format::automatic reads rows of four
// fields only; a comment with a frame rate, which files of ids have; whole numbers as ids that
// never repeat, while a frame does; or positions that are plausible in one order only.
// Tracks_format::automatic refuses a file without evidence, or with contradictory evidence. The
// formats frames and ids refuse a file with evidence of the other order. A comment line `# frame id
// x y` or `# id frame x y` confirms the order: with it, only a contradictory comment is refused.
//
// A column of times, and a time in GeoJSON, is a number, or a date and time in ISO 8601 (such as
// 2024-05-01T12:00:00.5Z) or in Tracks_file_options::date_format; all of a file are of one kind.
// Dates become seconds since the earliest of the file, rounded to nearest; times of day, in a form
// of Tracks_file_options::date_format without a day, seconds since midnight. If all times are whole
// numbers with the digits of dates, such as 20200131, they are refused.
//
// Positions are degrees in GeoJSON and GPX, by their standards; in SUMO if the comment with its
// configuration says so; in a table by the names of its columns (lon, location-lat,
// decimalLongitude, GPSLatitude, x_deg, x_wgs84) or by units in brackets or below the header (x
// (deg)). In other tables and SUMO files, positions that look like degrees are refused.
//
// An id is its text: 1 and 1.0 are two ids. Numbers are read as in files of points
// (kinetri/io/points_file.h).
#ifndef KINETRI_IO_TRACKS_FILE_H
#define KINETRI_IO_TRACKS_FILE_H

#include <array>
#include <cstddef>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// A format of such files.
enum class Tracks_format {
  automatic,  ///< found from the content
  rows,       ///< t, id, x, y below a header
  frames,     ///< frame, id, x, y
  ids,        ///< id, frame, x, y
  table,      ///< columns that are named by Track_columns
  jupedsim,   ///< SQLite
  sumo,       ///< XML
  lammps,     ///< dumps
  xyz,        ///< frames of atoms
  geojson,    ///< JSON
  gpx,        ///< XML of GPS receivers
  trackmate,  ///< XML of TrackMate
};

/// The name of a format.
struct Tracks_format_name {
  Tracks_format format;          ///< the format
  std::string_view name;         ///< "rows"
  std::string_view description;  ///< a phrase without a period at its end
};

/// All formats, in the order of the enumerators.
std::span<const Tracks_format_name> tracks_formats();

/// The names of the columns of a table, or of properties in GeoJSON; empty if not named. If all
/// names are whole numbers from 1 on, they are column numbers of a table without a header. (A first
/// row is a header nevertheless, and ignored, if neither its time nor its coordinates begin with a
/// digit, a sign or a point.)
struct Track_columns {
  /// Times. If the times of a table are in several columns, such as dates and times of day, their
  /// names or numbers with plus signs between, as in "date+time": the fields are joined by blanks.
  /// A column that has this name itself, plus signs included, takes precedence.
  std::string t = {};
  std::string id = {};      ///< ids
  std::string x = {};       ///< positions, to the right
  std::string y = {};       ///< positions, upward
  std::string radius = {};  ///< radii

  /// Whether none is named.
  bool is_empty() const {
    return t.empty() && id.empty() && x.empty() && y.empty() && radius.empty();
  }
};

/// The treatment of positions in degrees of longitude and latitude. The antimeridian does not
/// separate positions. The functions are those of the C library: machines may differ in the last
/// digits. The remarks bound the relative error of distances; a file in which it can exceed 0.1 %
/// is refused, with the bound in the message.
enum class Tracks_projection {
  refused,  ///< files with degrees are refused
  none,     ///< unchanged: x is the longitude, y the latitude
  /// From degrees on the ellipsoid of WGS 84 to meters, equirectangular about the center (l, p) of
  /// the bounding box of the data: x = N cos(p) (x - l), y = M (y - p), angles in radians, with the
  /// radii of curvature at p, of the meridian, M = a (1 - e^2) / (1 - e^2 sin(p)^2)^(3/2), and in
  /// the prime vertical, N = a / (1 - e^2 sin(p)^2)^(1/2) (J. P. Snyder, Map projections: a working
  /// manual, U.S. Geological Survey Professional Paper 1395, 1987, section 12, with the radii of
  /// equations 4-18 and 4-20, so that lengths are right at the middle).
  local,
  /// From degrees on the ellipsoid of WGS 84 to meters in the zone of Universal Transverse Mercator
  /// of the center of the data: x from 500000 m west of its central meridian, y from the equator,
  /// or if all positions are in the south, from 10000000 m south of it. The zones are all 6 degrees
  /// wide, without the exceptions in Norway and Svalbard. By the series of Krueger to the sixth
  /// order (C. F. F. Karney, Transverse Mercator with an accuracy of a few nanometers, Journal of
  /// Geodesy 85, 2011, equations 7 to 11 and 35).
  utm,
};

/// The treatment of several positions of one id at one time.
enum class Tracks_duplicates {
  automatic,  ///< as first; but the file is refused if half of the times of an id or more have
              ///< several positions, since several things may share the id
  refuse,     ///< the file is refused
  first,      ///< the first position in the file
  last,       ///< the last position in the file
  mean,       ///< the mean of all different ones, summed from first to last
};

/// The treatment of atoms that leave a periodic box and enter it on the other side.
enum class Tracks_unwrap {
  refused,  ///< a file is refused if an image of an atom's next position is nearer than that
  nearest,  ///< an atom continues to the nearest image of its next position
  /// The file must have one periodic box (Tracks_file::periodic_box). An atom continues to the
  /// nearest image, unless the file says itself which image is meant: by xu and yu, or ix and iy.
  periodic,
};

/// Options for reading a file of tracks.
struct Tracks_file_options {
  Tracks_format format = Tracks_format::automatic;  ///< which one the file has
  /// Frames in a unit of time, for files whose times are numbers of frames (also the column t of a
  /// table, a timestep of LAMMPS). Finite and greater than 0. Without it the rate is that of the
  /// file, or else 1.
  std::optional<double> fps = std::nullopt;
  /// For the formats table and geojson; makes `automatic` one of the two.
  Track_columns columns = {};
  Tracks_projection projection = Tracks_projection::refused;  ///< of degrees
  /// The form of dates, if it is not ISO 8601, as of strptime: %Y %y %m %b %B %d %j %H %I %M %S %f
  /// %p %z %Z %a %A %T %D %F %R %% and other characters that stand for themselves; a blank stands
  /// for one or more. %S takes a fraction. Two digits of a year are from 1969 to 2068. Names are
  /// English. See problem_of_date_format.
  std::string date_format = {};
  Tracks_duplicates duplicates = Tracks_duplicates::automatic;  ///< of positions at one time
  Tracks_unwrap unwrap = Tracks_unwrap::refused;                ///< of the formats lammps and xyz
};

/// What is wrong with a format of dates, as the second half of a message; empty if nothing is.
std::string problem_of_date_format(std::string_view format);

/// An observed position.
struct Track_observation {
  double time = 0;  ///< when
  Vector_2 place;   ///< where
  /// The number of the line in the file, or of the unit Tracks_file::place_name, counted from 1.
  std::size_t line = 0;
};

/// All observations of one id.
struct Track {
  std::string id;                               ///< not empty
  std::vector<Track_observation> observations;  ///< at least one, at strictly ascending times
  double radius = 0;                            ///< at least 0; 0 if the file has no such column
};

/// The content of a file of tracks.
struct Tracks_file {
  /// By the time of their first observation, then by its line.
  std::vector<Track> tracks;
  std::size_t observations = 0;  ///< of all tracks
  bool has_radii = false;        ///< whether the file has a column radius
  /// Ignored rows that repeat id, time and position of an earlier one (0 and -0 are the same).
  std::size_t doubled_rows = 0;
  /// Rows, doubled ones included, whose time is earlier than that of the previous row with the same
  /// id.
  std::size_t rows_out_of_order = 0;
  std::size_t comment_lines = 0;               ///< lines that begin with # and are not rows
  std::size_t rows_without_place = 0;          ///< rows that are not observations
  std::size_t rows_without_id = 0;             ///< rows of a table without an id
  std::size_t rows_at_another_place = 0;       ///< rows ignored or averaged by Tracks_duplicates
  Tracks_format format = Tracks_format::rows;  ///< never `automatic`
  /// What Track_observation::line counts: "line", "row" (of the table trajectory_data), "feature".
  std::string_view place_name = "line";
  /// The rate by which numbers of frames were divided; none if the file has times.
  std::optional<double> frame_rate;
  /// The date and time of t = 0 in ISO 8601, that of the earliest observation; empty if times are
  /// numbers.
  std::string origin;
  /// The area in which people walk as WKT, which JuPedSim writes with tracks; else empty.
  std::string walkable_area;
  /// The vectors of the box of atoms, the second one to the left of the first, if it is the same in
  /// all frames and periodic in two directions of the plane; of a box that is tilted toward z, only
  /// if its third edge is not periodic.
  std::optional<std::array<Vector_2, 2>> periodic_box;
  /// How the file was read, for users, in phrases without a period at the end.
  std::vector<std::string> remarks;
};

/// Phrases, as in Tracks_file::remarks, about rows that were ignored, merged, or not in order.
/// `duplicates` is that of the options.
std::vector<std::string> remarks_on_rows(const Tracks_file& file, Tracks_duplicates duplicates);

/// Reads tracks from `in`. Lines may have up to 2^20 bytes, and are read one by one: beyond the
/// result that needs memory for one line, for the doubled rows, and for sorting; if `automatic` has
/// to distinguish frames from ids, for the tracks in both orders. Databases and JSON are read
/// whole. Accepts LF and CRLF line ends, a byte order mark, and blanks around fields. A file
/// without rows, but with the header if the format has one, is valid.
///
/// Times of frames are frame / fps, rounded to nearest. Rows whose frames differ by so little that
/// their times are equal are rows at one time. If a comment of the formats frames and ids says that
/// positions are in centimeters or millimeters, they are converted to meters: x / 100 or x / 1000,
/// rounded to nearest. Scaled positions of LAMMPS, and those with images, are computed from the
/// box, each operation rounded to nearest. A third coordinate is ignored, and so are other columns
/// of a table, a dump, XYZ or JuPedSim, and attributes of SUMO, that are not used; remarks name
/// them.
///
/// Throws Input_error `name:line: ...`, or with another unit if there are no lines, for everything
/// else, such as: a format that is not recognized, is ambiguous, or needs a library that Kinetri
/// was built without (SQLite, expat); no header; a column that is unknown, missing or named twice;
/// a row with too few or too many fields; a field that is empty, or an invalid number (as in a
/// points file); a time that is out of the range of binary64; a negative radius, or two radii of
/// one id, naming both lines; one id at two positions at one time, naming both lines, unless the
/// options allow it; a frame rate, unit or order of columns in the file that contradicts the
/// options, or another in it; degrees, unless a projection is chosen that keeps distances; atoms
/// that jump through the boundary of a periodic box, unless they are unwrapped; a stream that
/// fails; a file that ends too early. Of several ids at two positions, the one whose second
/// position comes first in the file is named.
///
/// Precondition: `fps`, if there is one, is finite and greater than 0, and problem_of_date_format
/// is empty for `date_format`, if that is not.
///
/// Cost: O(n log n) for n rows, and O(log n) comparisons of an id with others per row, for every
/// input.
Tracks_file read_tracks(std::istream& in, const std::string& name,
                        const Tracks_file_options& options);

/// The same for a format. `fps` is ignored for rows, and 0 means none for all but frames.
/// Precondition: for frames `fps` is finite and greater than 0, for the others it may be 0.
Tracks_file read_tracks(std::istream& in, const std::string& name, Tracks_format format,
                        double fps = 0);

/// @{
/// Reads the file `path`, or standard input if it is "-". Throws as read_tracks, and Input_error
/// without a line if the path is a directory or cannot be opened.
Tracks_file read_tracks_file(const std::string& path, const Tracks_file_options& options);
Tracks_file read_tracks_file(const std::string& path, Tracks_format format, double fps = 0);
/// @}

/// Treats the positions of tracks from another source as read_tracks treats those of a table:
/// decides whether they are degrees, x the longitude and y the latitude, and projects them. The
/// evidence is the names `columns.x` and `columns.y`, unless empty; without it, the positions
/// themselves, if times are dates (the file has an `origin`) or seconds since 1970. Positions in
/// degrees at the longitude 181 or the latitude 91, and at (0, 0) as in read_tracks, are removed
/// and counted in `rows_without_place`; times and `origin` are kept. Conclusions and errors of
/// distances are added to the remarks. `name` is the beginning of messages.
///
/// Throws Input_error if positions are degrees, or look like them, and `projection` is `refused`;
/// if the names stand for radians, or two units of length, or the latitude is x; if positions to be
/// projected are not on earth; or if the error of distances would exceed 0.1 %.
///
/// Precondition: each track has an observation; times ascend strictly; positions are finite.
///
/// Cost: O(n) for n observations, and a sort of the tracks if positions are removed.
Tracks_file project_tracks(Tracks_file file, const std::string& name, const Track_columns& columns,
                           Tracks_projection projection);

/// The error about the observation at `line` of the file read from `name`: "name:line: message", or
/// "name: row line: message".
Input_error tracks_error(const std::string& name, std::string_view place_name, std::size_t line,
                         const std::string& message);

}  // namespace kinetri

#endif  // KINETRI_IO_TRACKS_FILE_H
