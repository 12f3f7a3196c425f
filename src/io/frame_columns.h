// SPDX-License-Identifier: GPL-3.0-or-later
//
// Evidence in comments and rows for the order of columns. Public recordings of pedestrians have
// rows `frame id x y` or `id frame x y`; all are numbers, so a file could be read in the wrong
// order without an error.
#ifndef KINETRI_SRC_IO_FRAME_COLUMNS_H
#define KINETRI_SRC_IO_FRAME_COLUMNS_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinetri/io/tracks_file.h"

namespace kinetri {

/// Units of length in comments.
enum class Length_unit { meter, centimeter, millimeter };

/// The indices of the fields of a row, from 0.
struct Frame_columns {
  std::size_t frame = 0;
  std::size_t id = 1;
  std::size_t x = 2;
  std::size_t y = 3;

  friend bool operator==(const Frame_columns&, const Frame_columns&) = default;
};

/// The evidence in a comment about columns and times.
struct Comment_signs {
  /// The names of id, frame, x and y, in the order of the comment.
  std::string column_names;
  bool has_expected_order = false;   ///< whether the order is frame, id, x, y
  Frame_columns columns;             ///< their indices among the names
  std::size_t words_before = 0;      ///< words before the names, after the last colon
  std::size_t words = 0;             ///< all words after the last colon
  std::optional<double> frame_rate;  ///< after a word such as `framerate`
  std::optional<Length_unit> unit;   ///< of positions
  bool has_two_units = false;  ///< whether x and y have different ones, or the comment names two
};

/// The evidence in a comment. Case, underscores and units in names of columns are ignored: `# id
/// frame x/m y/m`, `# PersID Frame X Y Z`. Units are those after x and y, as in x/cm, `x [in cm]`,
/// or else those after the words `in` and `unit`.
Comment_signs signs_in_comment(std::string_view comment);

/// The evidence in rows that ids and frames are swapped; none if there is none. Both columns must
/// be whole numbers. Either no id has two rows while a frame has several: one person was recorded.
/// Or, on average, rows of one frame with successive ids are less than half as far apart as rows of
/// one id in successive frames: a person walks less in a short time than the distance to others.
/// Cost: O(n log n).
std::optional<std::string> sign_in_rows(const std::vector<Track>& tracks);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_FRAME_COLUMNS_H
