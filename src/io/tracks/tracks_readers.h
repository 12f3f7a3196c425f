// SPDX-License-Identifier: GPL-3.0-or-later
//
// The readers of tracks, one for each format, and the recognition of formats. The table of readers
// is in tracks_readers.cpp.
#ifndef KINETRI_SRC_IO_TRACKS_TRACKS_READERS_H
#define KINETRI_SRC_IO_TRACKS_TRACKS_READERS_H

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iosfwd>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_table.h"
#include "io/tracks/tracks_builder.h"
#include "kinetri/io/tracks_file.h"

namespace kinetri {

inline constexpr Table_kind tracks_kind = {"tracks", "observation"};

/// The input of a reader.
struct Tracks_input {
  std::istream& in;
  const std::string& name;  ///< of the file, for messages
  const Tracks_file_options& options;
};

struct Tracks_reader {
  Tracks_format_name name;
  /// Whether a file with this beginning has the format. `head` is the whole file or its first 2^16
  /// bytes, without a byte order mark.
  bool (*recognizes)(std::string_view head);
  /// Reads the file. Throws Input_error.
  Tracks_file (*read)(const Tracks_input& input);
};

/// All readers, in the order of Tracks_format. The first one, `automatic`, recognizes rows of
/// frames or ids, which only the whole file distinguishes.
std::span<const Tracks_reader> tracks_readers();

/// @{
/// The readers.
Tracks_file read_rows(const Tracks_input& input);
Tracks_file read_frames(const Tracks_input& input);
Tracks_file read_ids(const Tracks_input& input);
Tracks_file read_frames_or_ids(const Tracks_input& input);
Tracks_file read_table(const Tracks_input& input);
Tracks_file read_jupedsim(const Tracks_input& input);
Tracks_file read_sumo(const Tracks_input& input);
Tracks_file read_lammps(const Tracks_input& input);
Tracks_file read_xyz(const Tracks_input& input);
Tracks_file read_geojson(const Tracks_input& input);
Tracks_file read_gpx(const Tracks_input& input);
Tracks_file read_trackmate(const Tracks_input& input);
/// @}

/// @{
/// The recognition of formats.
bool has_columns_of_rows(std::string_view head);
bool has_bare_columns(std::string_view head);
bool is_sqlite(std::string_view head);
bool is_xml(std::string_view head);
bool is_lammps(std::string_view head);
bool is_xyz(std::string_view head);
bool is_json(std::string_view head);
bool is_gpx(std::string_view head);
bool is_trackmate(std::string_view head);
/// @}

/// A message about a file with this beginning, if it has a known format without a reader; else
/// empty.
std::string foreign_format(std::string_view head);

/// The same of XML.
std::string foreign_xml(std::string_view head);

// ---- common functions of readers ----

/// Calls function(line) for each line of `head` that is neither blank nor a comment, without its
/// line end, until it returns false. The last line may be truncated.
template <class Function>
void for_each_line_of_head(std::string_view head, Function function) {
  while (!head.empty()) {
    const std::size_t end = head.find('\n');
    std::string_view line = head.substr(0, end);
    head.remove_prefix(end == std::string_view::npos ? head.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.starts_with('#') || trimmed(line).empty()) continue;
    if (!function(line)) return;
  }
}

/// A time, or the error: a whole message.
struct Parsed_time {
  Row_time value;
  std::string problem;
};

/// The time in a field, a number or a date, according to the options. `column` is its name in
/// messages.
Parsed_time parse_time(std::string_view field, std::string_view column,
                       const Tracks_file_options& options);

/// Detects times that are all dates written as whole numbers, as 20200131, or all times of day of 6
/// digits, some with one leading 0, as 095950: their differences are not seconds.
class Dates_of_digits {
 public:
  /// Adds the field of a time.
  void note(std::string_view field);

  /// Throws Input_error if all added fields are such dates, unless the options have a form of
  /// dates, or say that times are frames.
  void expect_none(const std::string& name, const Tracks_file_options& options) const;

 private:
  bool are_all_ = true;
  bool has_zero_ = false;
  std::string first_;
};

/// The message about a row whose number of fields is not that of the header or, without one, of the
/// first row.
std::string problem_of_row(std::size_t fields, std::size_t columns, bool has_header);

/// The message about a number with a decimal comma, in a table with this separator: "has a decimal
/// comma; expected ..."; empty for other fields.
std::string problem_of_comma(std::string_view field, char separator);

/// Whether the field stands for a missing number: it is empty, NaN, NA, N/A, null, None or \N, in
/// upper or lower case.
bool is_missing(std::string_view field);

/// Whether the position of a row is missing: both coordinates are, or one by a word such as NaN. A
/// single empty coordinate may be an error of the file.
bool is_without_place(std::string_view x, std::string_view y);

/// Whether the field may be a unit, or another word of a header: it does not begin with a digit,
/// sign or point, has no control characters, and does not stand for a missing number, unless it is
/// empty.
bool is_word(std::string_view field);

/// The time of a frame, frame / fps.
Parsed_time time_of_frame(double frame, double fps);

/// The quoted names, as "'a', 'b'"; at most the first 20, "and 3 others".
std::string list_of(std::span<const std::string> names);

/// The names of columns and the like that a reader ignores.
class Unused_names {
 public:
  /// Adds a name, once. Cost: O(log n) comparisons for n names.
  void add(std::string_view name);

  /// Adds columns without names; the greatest number counts.
  void add_without_names(std::size_t columns) {
    without_names_ = std::max(without_names_, columns);
  }

  /// Adds a remark with the names in the order of addition, and one with the number of those
  /// without names, unless there are none. `what` is its beginning.
  void add_remarks(Tracks_file& file, std::string_view what = "columns that are not used") const;

 private:
  std::set<std::string, std::less<>> known_;
  std::vector<std::string> names_;
  std::size_t without_names_ = 0;
};

/// The rate by which frames are divided: that of the options, or of the file, or 1.
double frame_rate(const Tracks_file_options& options, std::optional<double> of_file);

/// Stores in `file` the rate by which its frames were divided, and adds a remark on its source.
/// `frames` is their name, such as "frames".
void note_frame_rate(Tracks_file& file, const Tracks_input& input, std::optional<double> of_file,
                     std::string_view frames);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_TRACKS_READERS_H
