// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of recorded tracks: where things that move, each with an id, were seen at which times. Two
// formats; the rows of either may stand in any order, and blank lines and lines that begin with #
// are skipped.
//
//   rows    comma separated, a header line naming the columns t, id, x, y and optionally radius, of
//           a disc about what moves, in any order; an id is any text without commas, which is not
//           quoted: quotation marks belong to the id; all rows of an id have the same radius
//   frames  no header; four fields `frame id x y` separated by tabs or blanks, the form of some
//           public data sets of pedestrians; a frame is a finite number, an id any text
//
// Other public data sets of pedestrians have rows `id frame x y`. A file of the format `frames`
// that shows a sign of that order is refused: a comment that names the columns in another order; a
// comment that gives a frame rate; whole numbers as ids that never repeat, while a frame does; or
// places that make sense only in the other order. A comment line `# frame id x y` confirms the
// order: with it, only a comment that contradicts it is refused.
//
// An id is its text: 1 and 1.0 are two ids. Numbers are read as those of files of points are
// (kinetri/io/points_file.h).
#ifndef KINETRI_IO_TRACKS_FILE_H
#define KINETRI_IO_TRACKS_FILE_H

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// A format of such files.
enum class Tracks_format {
  rows,    ///< t, id, x, y below a header
  frames,  ///< frame, id, x, y
};

/// Something was seen at a place.
struct Track_observation {
  double time = 0;       ///< when
  Vector_2 place;        ///< where
  std::size_t line = 0;  ///< where the observation stands in the file, counted from 1
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
};

/// Reads tracks from `in`, line by line: beyond the result it needs memory for one line, which may
/// have up to 2^20 bytes, for the doubled rows, and for sorting. Accepts LF and CRLF line ends, a
/// byte order mark, and blanks around fields. No rows, in the format `rows` below a header, are no
/// tracks, and valid.
///
/// `fps` is for the format `frames` alone: the time is frame / fps, rounded to nearest. Rows whose
/// frames differ by so little that their times are equal are rows at one time. Precondition: in
/// that format `fps` is finite and greater than 0.
///
/// Throws Input_error `name:line: ...` for everything else: no header; a column that is unknown,
/// missing or named twice; a row with too few or too many fields; a field that is empty, or not a
/// number where one is needed (see parse_number); a time that is out of the range of binary64; a
/// negative radius, or two radii of one id, naming both lines; one id at two places at one time,
/// naming both lines; a stream that fails. Of several ids that are at
/// two places the one whose second place comes first in the file is named. In the format `frames`
/// also for a comment that names the columns in another order, or gives another rate than `fps`;
/// and, where no comment confirms the order of the columns, for a sign that the ids stand in the
/// first one (see above; without a line where the rows show it). The names `id`, `frame`, `x` and
/// `y` in a comment have variants such as `PersID`, `fr` and `x/m`.
///
/// Cost: O(n log n) for n rows, and O(log n) comparisons of an id with others per row, for every
/// input.
Tracks_file read_tracks(std::istream& in, const std::string& name, Tracks_format format,
                        double fps = 0);

/// Reads the file `path`, or standard input if it is "-". Throws as read_tracks, and Input_error
/// without a line if the path is a directory or cannot be opened.
Tracks_file read_tracks_file(const std::string& path, Tracks_format format, double fps = 0);

}  // namespace kinetri

#endif  // KINETRI_IO_TRACKS_FILE_H
