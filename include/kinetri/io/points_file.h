// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of moving points: comma separated, a header line naming the columns x, y, vx, vy and
// optionally radius, growth, mass, ax and ay, jx and jy in any order, then one point a line: its
// position at time 0 and the derivatives there: velocity, acceleration and jerk; the radius of its
// disc at time 0, the growth of the radius per unit of time, and the mass. Blank lines and lines
// that begin with # are skipped; but a line with # is a point if the first column is `id`, it has
// as many fields as the header, and its numbers are valid: its label is #1, for example. Columns z
// and vz, which occur together, are ignored if they are the same for all points, and an error
// otherwise. A file in UTF-16 is read as the same text in UTF-8.
//
// Files written by R, pandas and spreadsheets are read as well: quoted fields (two quotation marks
// inside stand for one), names of columns in upper case, semicolons as separators if the header has
// no comma (numbers still have a decimal point), a column `id` with a label for each point, and
// other columns, which are ignored.
//
// Every number is the correctly rounded binary64 number of its text. Text without one (nan, inf,
// too large, nonzero but rounded to zero) is an error.
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

/// The content of a file of points. Entry i of each vector belongs to the point with the id i.
struct Points_file {
  /// With epoch 0, all finite; no two points are equal in motion, radius and growth. Used if the
  /// file has no column ax or jx.
  std::vector<Linear_motion_2> motions;
  std::vector<Polynomial_motion_2> polynomial_motions;  ///< the same, if it has one
  bool is_polynomial = false;                           ///< which of the two there are
  std::vector<double> radii;       ///< at least 0; empty if the file has no such column
  std::vector<double> growths;     ///< finite; empty if the file has no such column
  std::vector<double> masses;      ///< greater than 0; empty if the file has no such column
  std::vector<std::size_t> lines;  ///< the line of the point, counted from 1
  /// The texts of the column `id`, no two equal; empty if the file has no such column. They are
  /// labels for people: the id of a point is its index.
  std::vector<std::string> labels;
  /// The names of the other columns, as messages show them: in quotes, printable, not too long.
  std::vector<std::string> ignored_columns;
  bool is_utf16 = false;          ///< whether the file was in UTF-16
  std::size_t comment_lines = 0;  ///< lines that begin with # and are not points

  /// The number of points, of either kind.
  std::size_t number_of_points() const { return lines.size(); }

  /// The result of function(motions) with the motions, of either kind.
  template <class Function>
  auto with_motions(const Function& function) const {
    return is_polynomial ? function(polynomial_motions) : function(motions);
  }
};

/// Reads points from `in`, line by line: beyond the result it needs memory for one line, which may
/// have up to 2^20 bytes. Accepts LF and CRLF line ends, a byte order mark, and blanks around
/// fields.
///
/// Throws Input_error `name:line: ...` for everything else: no header, or a column whose name is a
/// number; a column that is missing or named twice, or one of a pair without the other; a row with
/// too few or too many fields; a quotation mark that is not closed on its line; a field that is
/// empty or not a number (such as 12, -.5e-3 or 0x1.8p3, within the range of binary64), a number
/// with a decimal comma; an empty label; a negative radius; a mass that is not greater than 0; two
/// points with the same label, naming both lines; 2^32 - 1 points or more; a stream that fails.
/// Zero points are valid, and so are points that are equal otherwise. Cost: O(n log n) for labels;
/// else linear.
Points_file read_points(std::istream& in, const std::string& name);

/// Reads the file `path`, or standard input if it is "-". Throws as read_points, and Input_error
/// without a line if the path is a directory or cannot be opened.
Points_file read_points_file(const std::string& path);

/// @{
/// Writes points so that read_points returns the same numbers: header, then the shortest decimal
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
