// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of recorded tracks: where things that move, each with an id, were seen at which times. The
// rows of a file may stand in any order. The formats:
//
//   rows     comma separated, a header line naming the columns t, id, x, y and optionally radius,
//            of a disc about what moves, and z, which is left out, in any order; an id is any text
//            without commas, which is not quoted: quotation marks belong to the id; all rows of an
//            id have the same radius
//   frames   no header; four fields `frame id x y` separated by tabs or blanks, the form of some
//            public data sets of pedestrians; a frame is a finite number, an id any text
//   ids      no header; fields `id frame x y`, and others behind them that are ignored (z),
//            separated by tabs or blanks, the form of other public data sets of pedestrians
//   table    any table whose columns Track_columns names, by their names in its header or, where it
//            has none, by their numbers; separated by commas, semicolons, tabs or blanks; fields
//            may be quoted (RFC 4180)
//   jupedsim a database of SQLite as JuPedSim writes it, of version 1, 2 or 3
//   sumo     XML with floating-car data, as SUMO writes it: fcd-export
//   gpx      XML with tracks of GPS receivers: gpx
//   trackmate XML with tracks of TrackMate: Tracks
//   lammps   a text dump of LAMMPS with the columns id and x y, xu yu, xs ys or xsu ysu
//   xyz      XYZ, plain or extended, several frames one behind the other
//   geojson  GeoJSON: points with properties for id and time, lines with a time for each place
//
// In rows, frames, ids and table, blank lines and lines that begin with # are skipped; but such a
// line is a row where it has as many fields as the others, its first column is no number, and the
// numbers of its columns are numbers: the # begins an id, such as #1.
//
// A file in UTF-16 is read as the same text in UTF-8.
//
// In rows and table, lines below the header whose times and places begin with no digit, sign or
// point name units, and are left out. A row whose places are both empty, or one of them NaN, NA,
// N/A, null or None is no observation; nor is, in a table, one without an id, and where places are
// degrees, one at the latitude 91 or the longitude 181, by which AIS says that it knows no place,
// and one at (0, 0) if all others are farther than a degree from there. Nor is a feature of GeoJSON
// without geometry, or with null or NaN for all coordinates.
//
// In a table, a first column that the header does not name and whose first field is in quotation
// marks has the names of rows, as R's write.table writes them, and is left out.
//
// Files with rows `frame id x y` and with rows `id frame x y` look alike. What tells the order is a
// comment that names the columns, without which Tracks_format::automatic takes rows of four fields
// alone; a comment that gives a frame rate, which files of ids have; whole numbers as ids that
// never repeat, while a frame does; or places that make sense only in the other order.
// Tracks_format::automatic takes the order that these tell, and refuses a file in which none of
// them does, or in which they contradict each other. The formats frames and ids refuse a file in
// which one of them tells the other order. A comment line `# frame id x y` or `# id frame x y`
// confirms the order: with it, only a comment that contradicts it is refused.
//
// A column of times, and a time in GeoJSON, is a number, or a date and time in ISO 8601 (such as
// 2024-05-01T12:00:00.5Z) or in Tracks_file_options::date_format; all of a file are of one kind.
// Dates become seconds since the earliest of the file, rounded to nearest; times of day, in a form
// of Tracks_file_options::date_format without a day, seconds since midnight. Whole numbers that all
// are dates by their digits, as 20200131, are refused.
//
// Places are taken for degrees where the file says so: GeoJSON and GPX by their standard, SUMO in
// the comment that shows its configuration, a table by the names of its columns (lon, location-lat,
// decimalLongitude, GPSLatitude, x_deg, x_wgs84) or by units in brackets or below the header (x
// (deg)). Where a table or SUMO does not say it, places that look like degrees are refused.
//
// An id is its text: 1 and 1.0 are two ids. Numbers are read as those of files of points are
// (kinetri/io/points_file.h).
#ifndef KINETRI_IO_TRACKS_FILE_H
#define KINETRI_IO_TRACKS_FILE_H

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
  automatic,  ///< the one that the content shows
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

/// A format as users see it.
struct Tracks_format_name {
  Tracks_format format;          ///< the format
  std::string_view name;         ///< "rows"
  std::string_view description;  ///< a phrase without a period at its end
};

/// All formats, in the order of the enumerators.
std::span<const Tracks_format_name> tracks_formats();

/// Which columns of a table, or properties in GeoJSON, mean what. Empty: not named. Where all that
/// are named are whole numbers, from 1 on, they are the numbers of the columns of a table without a
/// header. (A first row of which neither time nor place begins with a digit, a sign or a point is a
/// header nevertheless, and is left out.)
struct Track_columns {
  /// Times. In a table whose times are in several columns, such as dates and times of day, their
  /// names or numbers with plus signs between, as in "date+time": the time is what the columns
  /// have, with blanks between. If a column has this name itself, plus signs included, it is that
  /// one.
  std::string t = {};
  std::string id = {};      ///< ids
  std::string x = {};       ///< places, to the right
  std::string y = {};       ///< places, up
  std::string radius = {};  ///< radii

  /// Whether none is named.
  bool is_empty() const {
    return t.empty() && id.empty() && x.empty() && y.empty() && radius.empty();
  }
};

/// What becomes of places in degrees of longitude and latitude. Places on both sides of the
/// antimeridian are no further apart than they are on earth. The functions are those of the C
/// library: machines may differ in the last digits. The remarks say by how much distances are off
/// at most; a file in which that can be more than 0.1 % is refused, and the message says by how
/// much.
enum class Tracks_projection {
  refused,  ///< files that have degrees by their standard, or in columns with such names, are
            ///< refused
  none,     ///< they are places as they are: x is the longitude, y the latitude
  /// x and y are degrees on the ellipsoid of WGS 84, and become metres, equirectangular about the
  /// middle of the data (l, p), which is that of their bounding box: x = N cos(p) (x - l),
  /// y = M (y - p), angles in radians, with the radii of curvature at p, of the meridian,
  /// M = a (1 - e^2) / (1 - e^2 sin(p)^2)^(3/2), and in the prime vertical,
  /// N = a / (1 - e^2 sin(p)^2)^(1/2) (J. P. Snyder, Map projections: a working manual, U.S.
  /// Geological Survey Professional Paper 1395, 1987, section 12, with the radii of equations 4-18
  /// and 4-20, so that lengths are right at the middle).
  local,
  /// x and y are degrees on the ellipsoid of WGS 84, and become metres in the zone of Universal
  /// Transverse Mercator that the middle of the data is in: x from 500000 m west of its central
  /// meridian, y from the equator, or where all places are in the south, from 10000000 m below it.
  /// The zones are all 6 degrees wide: the exceptions in Norway and Svalbard are not made. By the
  /// series of Krueger to the sixth order (C. F. F. Karney, Transverse Mercator with an accuracy of
  /// a few nanometers, Journal of Geodesy 85, 2011, equations 7 to 11 and 35).
  utm,
};

/// What becomes of several places of one id at one time.
enum class Tracks_duplicates {
  automatic,  ///< as first; but the file is refused if half of the times of an id or more have
              ///< several places, since then the id may be that of several things
  refuse,     ///< the file is refused
  first,      ///< the place that comes first in the file is taken
  last,       ///< the last one
  mean,       ///< the mean of all that differ, computed from left to right
};

/// What becomes of atoms that leave a periodic box and come in on its other side.
enum class Tracks_unwrap {
  refused,  ///< files are refused in which an image of an atom's next place is nearer than it
  nearest,  ///< an atom goes on to the nearest image of its next place
};

/// How a file of tracks is read.
struct Tracks_file_options {
  Tracks_format format = Tracks_format::automatic;  ///< which one the file has
  /// Frames in a unit of time, for files whose times are numbers of frames (also the column t of
  /// a table, a timestep of LAMMPS). Finite and greater than 0. Without it the file's own rate is
  /// taken, or else 1.
  std::optional<double> fps = std::nullopt;
  Track_columns columns =
      {};  ///< for the formats table and geojson; makes `automatic` one of the two
  Tracks_projection projection = Tracks_projection::refused;  ///< of degrees
  /// The form of dates, if it is not ISO 8601, as of strptime: %Y %y %m %b %B %d %j %H %I %M %S %f
  /// %p %z %Z %a %A %T %D %F %R %% and other characters that stand for themselves; a blank stands
  /// for one or more. %S takes a fraction. Two digits of a year are from 1969 to 2068. Names are
  /// English. See problem_of_date_format.
  std::string date_format = {};
  Tracks_duplicates duplicates = Tracks_duplicates::automatic;  ///< of several places at one time
  Tracks_unwrap unwrap = Tracks_unwrap::refused;                ///< of the formats lammps and xyz
};

/// What is wrong with a format of dates, as the second half of a message; empty if nothing is: it
/// has a year, month and day, and hours where it has minutes.
std::string problem_of_date_format(std::string_view format);

/// Something was seen at a place.
struct Track_observation {
  double time = 0;  ///< when
  Vector_2 place;   ///< where
  /// Where the observation stands in the file, counted from 1: the line, or what
  /// Tracks_file::place_name says.
  std::size_t line = 0;
};

/// All that was seen of one id.
struct Track {
  std::string id;                               ///< not empty
  std::vector<Track_observation> observations;  ///< at least one, at strictly ascending times
  double radius = 0;                            ///< at least 0; 0 if the file has no such column
};

/// What a file of tracks holds.
struct Tracks_file {
  /// By the time of their first observation, and by its line where the times are equal.
  std::vector<Track> tracks;
  std::size_t observations = 0;  ///< of all tracks
  bool has_radii = false;        ///< whether the file has a column radius
  /// Rows left out because they repeat id, time and place of an earlier one (0 and -0 are the
  /// same).
  std::size_t doubled_rows = 0;
  /// Rows, doubled ones included, whose time is earlier than that of the row before it in the file
  /// that has the same id.
  std::size_t rows_out_of_order = 0;
  std::size_t comment_lines = 0;               ///< lines that begin with #, none of them a row
  std::size_t rows_without_place = 0;          ///< rows that are no observation
  std::size_t rows_without_id = 0;             ///< rows of a table that belong to nothing
  std::size_t rows_at_another_place = 0;       ///< rows left out by Tracks_duplicates, or averaged
  Tracks_format format = Tracks_format::rows;  ///< the one that was read, never `automatic`
  /// What Track_observation::line counts: "line", "row" (of the table trajectory_data), "feature".
  std::string_view place_name = "line";
  /// The rate by which numbers of frames were divided; none if the file has times.
  std::optional<double> frame_rate;
  /// The date and time of t = 0 in ISO 8601, that of the earliest observation; empty if times are
  /// numbers.
  std::string origin;
  /// The area in which people walk as WKT, which JuPedSim writes with tracks; else empty.
  std::string walkable_area;
  /// What a user should know of how the file was read, in phrases without a period at the end.
  std::vector<std::string> remarks;
};

/// What a user should know of rows that were left out, merged, or not in order, in phrases as those
/// of Tracks_file::remarks. `duplicates` is that of the options.
std::vector<std::string> remarks_on_rows(const Tracks_file& file, Tracks_duplicates duplicates);

/// Reads tracks from `in`. Lines may have up to 2^20 bytes, and are read one by one: beyond the
/// result that needs memory for one line, for the doubled rows, and for sorting; where `automatic`
/// has to tell frames from ids, for the tracks in both orders. Databases and JSON are read whole.
/// Accepts LF and CRLF line ends, a byte order mark, and blanks around fields. No rows, where there
/// is a header if the format has one, are no tracks, and valid.
///
/// Times of frames are frame / fps, rounded to nearest. Rows whose frames differ by so little that
/// their times are equal are rows at one time. Where a comment of the formats frames and ids says
/// that places are in centimetres or millimetres they become metres: x / 100 or x / 1000, rounded
/// to nearest. Scaled places of LAMMPS, and those with images, are computed from the box, each
/// operation rounded to nearest. A third coordinate is ignored, and so are other columns of a
/// table, a dump, XYZ or JuPedSim, and attributes of SUMO, that are not used; remarks name them.
///
/// Throws Input_error `name:line: ...`, or with the place in other words where there are no lines,
/// for everything else, such as: a format that is not recognized, or is ambiguous, or for which the
/// library was built without its library (SQLite, expat); no header; a column that is unknown,
/// missing or named twice; a row with too few or too many fields; a field that is empty, or not a
/// number where one is needed (as in a points file); a time that is out of the range of binary64; a
/// negative radius, or two radii of one id, naming both lines; one id at two places at one time,
/// naming both lines, unless the options allow it; a frame rate, unit or order of columns in the
/// file that contradicts the options, or another in it; degrees, unless a projection is chosen that
/// keeps distances; atoms that jump through the boundary of a periodic box, unless they are
/// unwrapped; a stream that fails; a file that ends too early. Of several ids that are at two
/// places the one whose second place comes first in the file is named.
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

/// The tracks `file`, which a program has got by itself, with what read_tracks makes of the places
/// of a table: it decides whether they are degrees, x the longitude and y the latitude, and
/// projects them. What says so are the names `columns.x` and `columns.y` (an empty name says
/// nothing), and where these say nothing, what the places show whose times are dates, which they
/// are where the file has an `origin`, or seconds since 1970. Places in degrees at the longitude
/// 181 or the latitude 91 are left out, and counted in `rows_without_place`, and those at (0, 0) as
/// read_tracks does; the times and the `origin` stay as they are. What was concluded, and how far
/// distances are off, is added to the remarks. `name` stands at the beginning of messages.
///
/// Throws Input_error if places are degrees, or look like them, and `projection` is `refused`; if
/// names say radians, or two units of length, or the latitude is x; if places that are to be
/// projected are not on earth; or if distances would be off by more than 0.1 %.
///
/// Precondition: each track has an observation; times ascend strictly; places are finite.
///
/// Cost: O(n) for n observations, and a sort of the tracks where places are left out.
Tracks_file project_tracks(Tracks_file file, const std::string& name, const Track_columns& columns,
                           Tracks_projection projection);

/// The error that something is wrong with the observation at `line` of the file that was read from
/// `name`: "name:line: message", or "name: row line: message".
Input_error tracks_error(const std::string& name, std::string_view place_name, std::size_t line,
                         const std::string& message);

}  // namespace kinetri

#endif  // KINETRI_IO_TRACKS_FILE_H
