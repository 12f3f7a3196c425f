// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of moving points: comma separated, a header line naming the columns x, y, vx, vy and
// optionally radius, growth, mass, ax and ay, jx and jy in any order, then one point a line: its
// place at time 0 and its derivatives there, velocity, acceleration and jerk; the radius that a
// disc about it has at time 0, how much that grows in a unit of time, and the mass. Blank lines and
// lines that begin with # are skipped; but such a line is a point where the first column is `id`,
// it has as many fields as the header, and its numbers are numbers: its label is #1, for example.
// Columns z and vz, which go together, are ignored where they are the same for all points, and else
// are an error: points move in the plane. A file in UTF-16 is read as the same text in UTF-8.
//
// Files as R, pandas and spreadsheets write them are read as well: fields in quotation marks (two
// of them inside stand for one), names of columns in upper case, semicolons as separators where the
// header has no comma (numbers have a decimal point all the same), a column `id` with a label for
// each point, and other columns, which are ignored.
//
// Every number that comes out is the binary64 number that the text stands for, rounded correctly.
// Text that stands for none (nan, inf, too large, too small to be told from zero) is an error.
#ifndef KINETRI_IO_POINTS_FILE_H
#define KINETRI_IO_POINTS_FILE_H

#include <cstddef>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri {

/// What a file of points holds. Entry i of each vector belongs to the point with the id i.
struct Points_file {
  /// With epoch 0, all of them finite; no two points are equal in motion, radius and growth. Those
  /// of one kind: polynomial if the file has a column ax or jx, else linear.
  std::vector<Linear_motion_2> motions;
  std::vector<Polynomial_motion_2> polynomial_motions;  ///< as `motions`
  bool is_polynomial = false;                           ///< which of the two there are
  std::vector<double> radii;       ///< at least 0; empty if the file has no such column
  std::vector<double> growths;     ///< finite; empty if the file has no such column
  std::vector<double> masses;      ///< greater than 0; empty if the file has no such column
  std::vector<std::size_t> lines;  ///< where the point stands, counted from 1
  /// The texts of the column `id`, no two equal; empty if the file has no such column. They name
  /// points for people only: the id of a point is its index.
  std::vector<std::string> labels;
  /// The names of the other columns, as messages show them: in quotes, printable, not too long.
  std::vector<std::string> ignored_columns;
  bool is_utf16 = false;          ///< whether the file was in UTF-16
  std::size_t comment_lines = 0;  ///< lines that begin with #, and are no points

  /// The number of points, of either kind.
  std::size_t number_of_points() const { return lines.size(); }
};

/// Reads points from `in`, line by line: beyond the result it needs memory for one line, which may
/// have up to 2^20 bytes, and at the end 16 bytes a point. Accepts LF and CRLF line ends, a byte
/// order mark, and blanks around fields.
///
/// Throws Input_error `name:line: ...` for everything else: no header, or one in which a column is
/// named by a number; a column that is missing or named twice, or one of a pair without the other;
/// a row with too few or too many fields; a quotation mark that is not closed on its line; a field
/// that is empty or not a number (as 12, -.5e-3 or 0x1.8p3, within the range of binary64), a number
/// with a decimal comma; a label that is empty; a negative radius; a mass that is not greater than
/// 0; two points with the same label, or with the same motion, radius and growth (0 and -0 are the
/// same), naming both lines; 2^32 - 1 points or more; a stream that fails. Zero points are valid.
/// Cost: linear, but for sorts that find equal points and labels: O(n log n) for every input.
Points_file read_points(std::istream& in, const std::string& name);

/// Reads the file `path`, or standard input if it is "-". Throws as read_points, and Input_error
/// without a line if the path is a directory or cannot be opened.
Points_file read_points_file(const std::string& path);

/// @{
/// Writes points so that read_points gives the same numbers back: header, then the shortest decimal
/// numbers that read back exactly. Precondition: all motions are finite and have epoch 0; each of
/// `radii`, `growths` and `masses` is empty, and then no column, or as long as `motions`. Errors
/// are those of the stream.
void write_points(std::ostream& out, std::span<const Linear_motion_2> motions,
                  std::span<const double> radii = {}, std::span<const double> growths = {},
                  std::span<const double> masses = {});
void write_points(std::ostream& out, std::span<const Polynomial_motion_2> motions,
                  std::span<const double> radii = {}, std::span<const double> growths = {},
                  std::span<const double> masses = {});
/// @}

}  // namespace kinetri

#endif  // KINETRI_IO_POINTS_FILE_H
