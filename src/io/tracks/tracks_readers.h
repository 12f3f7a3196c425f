// SPDX-License-Identifier: GPL-3.0-or-later
//
// The readers of tracks, one for each format, and how the content of a file shows its format. A
// reader is a function from the file to its tracks; the table of them is in tracks_readers.cpp.
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

#include "io/tracks/tracks_builder.h"
#include "kinetri/impl/io/text_table.h"
#include "kinetri/io/tracks_file.h"

namespace kinetri {

inline constexpr Table_kind tracks_kind = {"tracks", "observation"};

/// What a reader reads.
struct Tracks_input {
  std::istream& in;
  const std::string& name;  ///< of the file, for messages
  const Tracks_file_options& options;
};

struct Tracks_reader {
  Tracks_format_name name;
  /// Whether a file that begins so is of the format. `head` is the whole file or its first 2^16
  /// bytes, without a byte order mark.
  bool (*recognizes)(std::string_view head);
  /// Reads the file. Throws Input_error.
  Tracks_file (*read)(const Tracks_input& input);
};

/// All readers, in the order of Tracks_format. The first one, `automatic`, recognizes rows of which
/// only all of them tell whether they are frames or ids.
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
/// What they recognize.
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

/// What a file that begins so is, and what was expected, if it is of a known format that nothing
/// here reads; else empty.
std::string foreign_format(std::string_view head);

/// The same of XML.
std::string foreign_xml(std::string_view head);

// ---- what readers have in common ----

/// Calls function(line) for each line of `head` that is neither blank nor a comment, without its
/// line end, until it returns false. The last line may be cut.
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

/// A time, or what is wrong: a whole message.
struct Parsed_time {
  Row_time value;
  std::string problem;
};

/// The time of a field that is a number or a date, as the options say. `column` names it in
/// messages.
Parsed_time parse_time(std::string_view field, std::string_view column,
                       const Tracks_file_options& options);

/// Times that are whole numbers of 8, 10 or 12 digits, which all are dates without signs between,
/// as 20200131, or of 6 digits, which all are times of day, some with one 0 at the beginning, as
/// 095950: their differences are no seconds.
class Dates_of_digits {
 public:
  /// Notes the field of a time.
  void note(std::string_view field);

  /// Throws Input_error if all that were noted are such dates, unless the options say what form
  /// dates have, or that times are frames.
  void expect_none(const std::string& name, const Tracks_file_options& options) const;

 private:
  bool are_all_ = true;
  bool has_zero_ = false;
  std::string first_;
};

/// What to say of a row with another number of fields than the header has columns, or without a
/// header the first row has fields.
std::string problem_of_row(std::size_t fields, std::size_t columns, bool has_header);

/// What to say of a field that is no number since it has a decimal comma, in a table of fields
/// with this character between: "has a decimal comma; expected ..."; empty if it is another.
std::string problem_of_comma(std::string_view field, char separator);

/// Whether the field says that there is no number: it is empty, NaN, NA, N/A, null, None or \N, in
/// any case.
bool is_missing(std::string_view field);

/// Whether the coordinates of a row say that there is no place: both are missing, or one by a word,
/// as NaN. One that is empty beside another may be a fault of the file.
bool is_without_place(std::string_view x, std::string_view y);

/// Whether the field may be a unit, or another word of a header: it begins with no digit, sign or
/// point, has no control characters, and says not that a number is missing, unless it is empty.
bool is_word(std::string_view field);

/// The time of a frame, frame / fps.
Parsed_time time_of_frame(double frame, double fps);

/// The names, quoted, as "'a', 'b'"; of many the first 20, "and 3 others".
std::string list_of(std::span<const std::string> names);

/// The names of columns, or what takes their place, that a reader leaves out.
class Unused_names {
 public:
  /// Notes one; each name counts once. Cost: O(log n) comparisons for n names.
  void add(std::string_view name);

  /// Notes columns without names; of several numbers the greatest counts.
  void add_without_names(std::size_t columns) {
    without_names_ = std::max(without_names_, columns);
  }

  /// Adds a remark with the names in the order in which they first came, unless there is none, and
  /// one with the number of those without names. `what` begins it: "columns that are not used".
  void add_remarks(Tracks_file& file, std::string_view what = "columns that are not used") const;

 private:
  std::set<std::string, std::less<>> known_;
  std::vector<std::string> names_;
  std::size_t without_names_ = 0;
};

/// The rate that frames are divided by: that of the options, or of the file, or 1.
double frame_rate(const Tracks_file_options& options, std::optional<double> of_file);

/// Notes in `file` the rate that its frames were divided by: from where it is (see frame_rate), and
/// what `frames` are, such as "frames".
void note_frame_rate(Tracks_file& file, const Tracks_input& input, std::optional<double> of_file,
                     std::string_view frames);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_TRACKS_READERS_H
