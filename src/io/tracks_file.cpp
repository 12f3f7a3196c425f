// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/tracks_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <utility>

#include "io/text_table.h"
#include "io/tracks/degrees.h"
#include "io/tracks/projection.h"
#include "io/tracks/timestamp.h"
#include "io/tracks/tracks_readers.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/io/text.h"
#include "utf8_input.h"

namespace kinetri {
namespace {

constexpr std::size_t head_size = std::size_t{1} << 16U;

[[noreturn]] void fail_to_read(const std::string& name) {
  throw Input_error(name, 1, "reading failed; expected a readable file of tracks");
}

std::string_view without_byte_order_mark(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  return head;
}

bool has_named_columns(Tracks_format format) {
  return format == Tracks_format::table || format == Tracks_format::geojson;
}

// The reader of a file with this beginning.
const Tracks_reader& reader_of(std::string_view head, const Tracks_input& input) {
  const std::span<const Tracks_reader> readers = tracks_readers();
  const auto reader = [&](Tracks_format format) -> const Tracks_reader& {
    return readers[static_cast<std::size_t>(format)];
  };
  const auto of_format = [&](Tracks_format format) { return reader(format).recognizes(head); };
  if (const std::string foreign = foreign_format(head); !foreign.empty()) {
    throw Input_error(input.name, 0, foreign);
  }
  // Those that are recognized by their first bytes come last in the table.
  for (std::size_t i = readers.size(); i-- > 0;) {
    const Tracks_format format = readers[i].name.format;
    if (!of_format(format)) continue;
    const bool is_table = format == Tracks_format::rows || format == Tracks_format::automatic;
    if (input.options.columns.is_empty() || has_named_columns(format)) return readers[i];
    if (is_table) return reader(Tracks_format::table);
    throw Input_error(input.name, 0,
                      joined("seems to be of the format ", readers[i].name.name,
                             ", whose columns have names already; expected no --columns"));
  }
  return reader(input.options.columns.is_empty() ? Tracks_format::rows : Tracks_format::table);
}

void expect_tracks(const Tracks_file& file) {
  for (const Track& track : file.tracks) {
    const auto& seen = track.observations;
    KINETRI_PRECONDITION(!seen.empty(), "a track has no observation");
    for (std::size_t i = 0; i < seen.size(); ++i) {
      KINETRI_PRECONDITION(i == 0 || seen[i - 1].time < seen[i].time,
                           "the times of a track do not ascend");
      KINETRI_PRECONDITION(std::isfinite(seen[i].place.x) && std::isfinite(seen[i].place.y),
                           "a place is not finite");
    }
  }
}

// Removes the observations without a position, according to `is_none`. Returns their number.
template <class Is_none>
std::size_t leave_out_no_places(Tracks_file& file, const Is_none& is_none) {
  std::size_t left_out = 0;
  for (Track& track : file.tracks) {
    left_out += std::erase_if(track.observations,
                              [&](const Track_observation& seen) { return is_none(seen.place); });
  }
  if (left_out == 0) return 0;
  std::erase_if(file.tracks, [](const Track& track) { return track.observations.empty(); });
  std::stable_sort(file.tracks.begin(), file.tracks.end(), [](const Track& a, const Track& b) {
    const Track_observation& of_a = a.observations.front();
    const Track_observation& of_b = b.observations.front();
    return of_a.time != of_b.time ? of_a.time < of_b.time : of_a.line < of_b.line;
  });
  file.observations -= left_out;
  return left_out;
}

// Removes positions at (0, 0), which trackers write for unknown ones, unless another position is
// near.
void leave_out_null_island(Tracks_file& file) {
  constexpr double near = 1;  // in degrees
  std::size_t others = 0;
  std::size_t there = 0;
  for (const Track& track : file.tracks) {
    for (const Track_observation& seen : track.observations) {
      if (is_null_island(seen.place)) {
        ++there;
        continue;
      }
      ++others;
      if (std::abs(seen.place.x) <= near && std::abs(seen.place.y) <= near) return;
    }
  }
  if (there == 0 || others == 0) return;
  leave_out_no_places(file, is_null_island);
  file.remarks.push_back(
      joined(there, there == 1 ? " row" : " rows",
             " left out, at the longitude 0 and the latitude 0, which stand for no place where all "
             "others are farther than a degree from there (--projection none keeps them)"));
}

void project_if_asked(Tracks_file& file, const std::string& name, Tracks_projection projection) {
  if (projection == Tracks_projection::local || projection == Tracks_projection::utm) {
    // Without names of degrees, one number alone may be an error.
    file.rows_without_place += leave_out_no_places(file, [](const Vector_2& place) {
      return place == Vector_2{181, 91};
    });
    leave_out_null_island(file);
    project(file, name, projection);
  }
}

Tracks_file read_recognized(const Tracks_input& input) {
  std::string head(head_size, '\0');
  input.in.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (input.in.bad()) fail_to_read(input.name);
  head.resize(static_cast<std::size_t>(input.in.gcount()));
  const Tracks_reader& reader = reader_of(without_byte_order_mark(head), input);
  Replayed_buffer buffer(std::move(head), input.in);
  std::istream whole(&buffer);
  return reader.read({whole, input.name, input.options});
}

Tracks_file read_as(Tracks_format format, const Tracks_input& input) {
  const Tracks_reader& reader = tracks_readers()[static_cast<std::size_t>(format)];
  if (!input.options.columns.is_empty() && !has_named_columns(format)) {
    throw Input_error(input.name, 0,
                      joined("is read in the format ", reader.name.name,
                             ", whose columns have names already; expected no --columns, or "
                             "--format table"));
  }
  return reader.read(input);
}

// Times of day must ascend in the rows of each id: after midnight they would not.
void expect_one_day(Tracks_file& file, const std::string& name) {
  if (file.rows_out_of_order > 0) {
    throw Input_error(
        name, 0,
        joined("times of day go back in ", file.rows_out_of_order,
               file.rows_out_of_order == 1 ? " row" : " rows",
               ", as they do past midnight; expected dates with them, also in two columns, as in "
               "--columns t=DATE+TIME, or rows of one day in the order of time"));
  }
  file.remarks.emplace_back("times are times of day, in seconds since midnight");
}

Tracks_file_options options_of(Tracks_format format, double fps) {
  Tracks_file_options options;
  options.format = format;
  const bool has_rate = format == Tracks_format::frames || fps != 0;
  if (has_rate && format != Tracks_format::rows) options.fps = fps;
  return options;
}

}  // namespace

std::span<const Tracks_format_name> tracks_formats() {
  static const std::vector<Tracks_format_name> all = [] {
    std::vector<Tracks_format_name> names;
    for (const Tracks_reader& reader : tracks_readers()) names.push_back(reader.name);
    return names;
  }();
  return all;
}

std::vector<std::string> remarks_on_rows(const Tracks_file& file, Tracks_duplicates duplicates) {
  std::vector<std::string> result;
  const auto add = [&](std::size_t number, std::string_view what, std::string_view remark) {
    if (number > 0) result.push_back(joined(number, what, number == 1 ? "" : "s", remark));
  };
  add(file.comment_lines, " line", " left out, beginning with #");
  add(file.rows_without_place, " row", " left out, having no place");
  add(file.rows_without_id, " row", " left out, having no id");
  add(file.doubled_rows, " row", " left out, being a copy of another");
  const std::string_view of_duplicates =
      duplicates == Tracks_duplicates::mean
          ? " averaged with an earlier one that has another place of the same id at the same time"
      : duplicates == Tracks_duplicates::last
          ? " left out for a later one with another place of the same id at the same time"
      : duplicates == Tracks_duplicates::first
          ? " left out for an earlier one with another place of the same id at the same time"
          : " left out for an earlier one with another place of the same id at the same time "
            "(--duplicates first, last, mean or refuse)";
  add(file.rows_at_another_place, " row", of_duplicates);
  add(file.rows_out_of_order, " row", " out of the order of time");
  return result;
}

Tracks_file project_tracks(Tracks_file file, const std::string& name, const Track_columns& columns,
                           Tracks_projection projection) {
  expect_tracks(file);
  const Named_degrees named =
      degrees_in_names(name, 0, projection, "columns", columns.x, columns.y);
  if (named.remark.empty()) {
    Signs_of_degrees signs;
    for (const Track& track : file.tracks) {
      for (const Track_observation& seen : track.observations) {
        signs.note(seen.place, joined(seen.place.x), joined(seen.place.y));
      }
    }
    signs.expect_none(file, name, projection, columns.x, columns.y);
  } else {
    file.remarks.push_back(named.remark);
  }
  if (named.are_degrees) file.rows_without_place += leave_out_no_places(file, is_no_place);
  project_if_asked(file, name, projection);
  return file;
}

Input_error tracks_error(const std::string& name, std::string_view place_name, std::size_t line,
                         const std::string& message) {
  if (line == 0 || place_name == "line") return Input_error(name, line, message);
  return Input_error(name, 0, joined(place_name, ' ', line, ": ", message));
}

Tracks_file read_tracks(std::istream& in, const std::string& name,
                        const Tracks_file_options& options) {
  KINETRI_PRECONDITION(!options.fps || (std::isfinite(*options.fps) && *options.fps > 0),
                       "the number of frames a second is not a finite number greater than 0");
  // A failed stream would look like an empty file.
  if (in.fail()) fail_to_read(name);
  KINETRI_PRECONDITION(
      options.date_format.empty() || problem_of_date_format(options.date_format).empty(),
      "the format of dates is wrong");
  Utf8_input utf8(in);
  const Tracks_input input = {utf8.stream(), name, options};
  Tracks_file file = options.format == Tracks_format::automatic ? read_recognized(input)
                                                                : read_as(options.format, input);
  if (utf8.is_converted()) file.remarks.emplace_back("the file is in UTF-16, read as UTF-8");
  const bool is_of_atoms =
      file.format == Tracks_format::lammps || file.format == Tracks_format::xyz;
  if (options.unwrap != Tracks_unwrap::refused && !is_of_atoms) {
    throw Input_error(
        name, 0,
        joined("has no periodic box; expected no ",
               options.unwrap == Tracks_unwrap::periodic ? "--periodic" : "--unwrap"));
  }
  if (!options.date_format.empty() && is_form_of_day(options.date_format) && file.origin.empty()) {
    expect_one_day(file, name);
  }
  project_if_asked(file, name, options.projection);
  return file;
}

Tracks_file read_tracks(std::istream& in, const std::string& name, Tracks_format format,
                        double fps) {
  return read_tracks(in, name, options_of(format, fps));
}

Tracks_file read_tracks_file(const std::string& path, const Tracks_file_options& options) {
  if (path == "-") return read_tracks(std::cin, "standard input", options);
  std::ifstream in = open_input(path, tracks_kind.content);
  return read_tracks(in, path, options);
}

Tracks_file read_tracks_file(const std::string& path, Tracks_format format, double fps) {
  return read_tracks_file(path, options_of(format, fps));
}

}  // namespace kinetri
