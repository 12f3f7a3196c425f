// SPDX-License-Identifier: GPL-3.0-or-later
//
// What comments and rows tell of the columns of recorded pedestrians. Public recordings come with
// rows `frame id x y` and with rows `id frame x y`; both are numbers, so that a file of the one
// form could be read as one of the other without an error, and wrongly.
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
enum class Length_unit { metre, centimetre, millimetre };

/// Which field of a row is what, counted from 0.
struct Frame_columns {
  std::size_t frame = 0;
  std::size_t id = 1;
  std::size_t x = 2;
  std::size_t y = 3;

  friend bool operator==(const Frame_columns&, const Frame_columns&) = default;
};

/// What a comment says of columns and times.
struct Comment_signs {
  /// Names of an id, a frame, x and y one behind the other, in the order of the comment.
  std::string column_names;
  bool has_expected_order = false;   ///< of the names: frame, id, x, y
  Frame_columns columns;             ///< of the names, as if nothing stood before them
  std::size_t words_before = 0;      ///< words before the names, behind the last colon
  std::size_t words = 0;             ///< those, the names, and the words behind
  std::optional<double> frame_rate;  ///< after a word such as `framerate`
  std::optional<Length_unit> unit;   ///< of places
  bool has_two_units = false;        ///< x and y have different ones, or the comment names two
};

/// The signs in a comment. Names of columns are compared without regard to case, underscores and
/// units: `# id frame x/m y/m`, `# PersID Frame X Y Z`. Units are those behind x and y, as in x/cm,
/// `x [in cm]`, or else those behind the words `in` and `unit`.
Comment_signs signs_in_comment(std::string_view comment);

/// What in the rows says that the ids are frames, and the frames ids; none if nothing does. Both
/// columns must be whole numbers. One sign is that no id has two rows while a frame has several:
/// one person was recorded. The other is that, on average, rows of one frame with successive ids
/// are less than half as far apart as rows of one id in successive frames: in a short time a person
/// does not go farther than others are away. Cost: O(n log n).
std::optional<std::string> sign_in_rows(const std::vector<Track>& tracks);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_FRAME_COLUMNS_H
