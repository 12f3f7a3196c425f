// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/tracks_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "frame_columns.h"
#include "kinetri/base/check.h"
#include "kinetri/base/error.h"
#include "text.h"
#include "text_table.h"

namespace kinetri {
namespace {

constexpr Table_kind tracks_kind = {"tracks", "observation"};

enum Column : std::size_t { t, id, x, y, radius, column_count };
constexpr std::size_t required_columns = radius;
constexpr std::array<std::string_view, column_count> rows_columns = {"t", "id", "x", "y", "radius"};
// In the order of the fields.
constexpr std::array<std::string_view, required_columns> frames_columns = {"frame", "id", "x", "y"};
constexpr std::string_view expected_columns =
    "expected a header line with the columns t,id,x,y and optionally radius, in any order";

constexpr std::string_view expected_order =
    "; expected frame, id, x and y in this order: exchange the first two columns, for example with "
    "awk '{ print $2, $1, $3, $4 }'";
constexpr std::string_view or_confirm =
    ", or, if this is their order, add the line '# frame id x y' above the rows";

bool earlier(const Track_observation& a, const Track_observation& b) {
  return a.time < b.time;
}

class Tracks_reader {
 public:
  Tracks_reader(std::istream& in, const std::string& name)
      : table_(in, name, tracks_kind), name_(name) {}

  Tracks_file read(Tracks_format format, double fps) {
    if (format == Tracks_format::rows) {
      read_rows();
      return tracks();
    }
    read_frames(fps);
    Tracks_file result = tracks();
    if (!is_order_confirmed_) {
      if (const auto sign = sign_in_rows(result.tracks)) {
        throw Input_error(name_, 0,
                          joined(*sign, ", as if the first two columns were exchanged",
                                 expected_order, or_confirm));
      }
    }
    return result;
  }

 private:
  // The fields of one row, as they come.
  struct Row {
    std::string_view id;
    std::array<double, column_count> values = {};
  };

  void read_rows() {
    const std::vector<std::size_t> columns =
        table_.read_header(rows_columns, required_columns, expected_columns);
    result_.has_radii = std::find(columns.begin(), columns.end(), radius) != columns.end();
    while (const auto line = table_.next()) {
      Row row;
      std::size_t fields = 0;
      for_each_field_between_commas(*line, [&](std::string_view field) {
        if (fields < columns.size()) read_field(row, field, columns[fields], rows_columns);
        ++fields;
      });
      table_.check_number_of_fields(fields, columns.size());
      add(row, row.values[t]);
    }
  }

  void read_frames(double fps) {
    table_.watch_comments([this, fps](std::string_view comment) { heed(comment, fps); });
    while (const auto line = table_.next()) {
      Row row;
      std::size_t fields = 0;
      for_each_field_between_blanks(*line, [&](std::string_view field) {
        if (fields < frames_columns.size()) read_field(row, field, fields, frames_columns);
        ++fields;
      });
      if (fields != frames_columns.size()) {
        table_.fail(joined("the row has ", fields, fields == 1 ? " field" : " fields",
                           "; expected 4, frame, id, x and y, separated by tabs or blanks"));
      }
      if (!is_order_confirmed_ && frame_rate_line_ > 0) fail_for_frame_rate();
      add(row, time_of_frame(row.values[t], fps));
    }
  }

  // What a comment of a file of frames says must agree with how it is read.
  void heed(std::string_view comment, double fps) {
    const Comment_signs signs = signs_in_comment(comment);
    if (!signs.column_names.empty() && !signs.has_expected_order) {
      table_.fail(
          joined("the comment names the columns '", signs.column_names, "'", expected_order));
    }
    if (!signs.column_names.empty()) is_order_confirmed_ = true;
    if (!signs.frame_rate) return;
    if (*signs.frame_rate != fps) {
      table_.fail(joined("the comment gives ", *signs.frame_rate,
                         " frames a second, but the file is read with ", fps,
                         "; expected the same rate"));
    }
    frame_rate_line_ = table_.line();
  }

  [[noreturn]] void fail_for_frame_rate() const {
    throw Input_error(name_, frame_rate_line_,
                      joined("the comment gives a frame rate, as in files whose columns are id, "
                             "frame, x and y",
                             expected_order, or_confirm));
  }

  void read_field(Row& row, std::string_view field, std::size_t column,
                  std::span<const std::string_view> names) const {
    if (column != id) {
      row.values[column] = table_.number(field, names[column]);
      if (column == radius && row.values[radius] < 0) {
        table_.fail(joined("the radius ", row.values[radius], " is negative; expected at least 0"));
      }
    } else if (field.empty()) {
      table_.fail(joined("the column ", names[column], " is empty; expected any text"));
    } else {
      row.id = field;
    }
  }

  double time_of_frame(double frame, double fps) const {
    const double time = frame / fps;
    if (!std::isfinite(time) || (time == 0 && frame != 0)) {
      table_.fail(joined("the time of the frame ", frame, " at ", fps,
                         " frames a second is out of the range of binary64; expected 0, or a "
                         "magnitude from 4.9e-324 to 1.8e308"));
    }
    return time;
  }

  void add(const Row& row, double time) {
    auto found = rows_.find(row.id);
    if (found == rows_.end()) {
      found = rows_.emplace(row.id, Track{"", {}, row.values[radius]}).first;
    }
    expect_radius(row, found->second);
    std::vector<Track_observation>& observations = found->second.observations;
    observations.push_back({time, {row.values[x], row.values[y]}, table_.line()});
    if (observations.size() > 1 && earlier(observations.back(), observations.end()[-2])) {
      ++result_.rows_out_of_order;
    }
  }

  void expect_radius(const Row& row, const Track& track) const {
    if (row.values[radius] == track.radius) return;
    table_.fail(joined("id ", quoted(row.id), " has the radius ", row.values[radius], ", but ",
                       track.radius, " in line ", track.observations.front().line,
                       "; expected one radius for each id"));
  }

  Tracks_file tracks() {
    for (auto& [track_id, track] : rows_) {
      std::vector<Track_observation>& observations = track.observations;
      if (!std::is_sorted(observations.begin(), observations.end(), earlier)) {
        std::stable_sort(observations.begin(), observations.end(), earlier);
      }
      drop_doubled(track_id, observations);
      result_.observations += observations.size();
    }
    if (conflict_) fail_at_two_places();
    result_.tracks.reserve(rows_.size());
    while (!rows_.empty()) {
      auto node = rows_.extract(rows_.begin());
      result_.tracks.push_back(std::move(node.mapped()));
      result_.tracks.back().id = std::move(node.key());
    }
    std::sort(result_.tracks.begin(), result_.tracks.end(), [](const Track& a, const Track& b) {
      const Track_observation& first_a = a.observations.front();
      const Track_observation& first_b = b.observations.front();
      return first_a.time != first_b.time ? first_a.time < first_b.time
                                          : first_a.line < first_b.line;
    });
    return std::move(result_);
  }

  // One id at two places at one time.
  struct Conflict {
    std::string_view id;
    Track_observation first;
    Track_observation second;  // in a later line
  };

  // Keeps, of the rows at one time, the one that comes first in the file.
  void drop_doubled(std::string_view track_id, std::vector<Track_observation>& observations) {
    std::size_t kept = 1;
    for (std::size_t i = 1; i < observations.size(); ++i) {
      const Track_observation& last = observations[kept - 1];
      const Track_observation& next = observations[i];
      if (last.time != next.time) {
        observations[kept++] = next;
      } else if (last.place == next.place) {
        ++result_.doubled_rows;
      } else if (!conflict_ || next.line < conflict_->second.line) {
        conflict_ = {track_id, last, next};
      }
    }
    observations.resize(kept);
  }

  [[noreturn]] void fail_at_two_places() const {
    const auto& [conflict_id, first, second] = *conflict_;
    throw Input_error(
        name_, second.line,
        joined("id ", quoted(conflict_id), " is at two places at t = ", second.time, ": at (",
               second.place.x, ", ", second.place.y, "), and at (", first.place.x, ", ",
               first.place.y, ") in line ", first.line, "; expected one"));
  }

  Table_reader table_;
  const std::string& name_;
  // The rows of each id: a tree, and not a hash, so that no input makes the search slow.
  std::map<std::string, Track, std::less<>> rows_;  // the tracks without their ids
  std::optional<Conflict> conflict_;                // the one whose second line comes first
  bool is_order_confirmed_ = false;                 // by a comment that names the columns
  std::size_t frame_rate_line_ = 0;  // of a comment that gives the rate; 0 if there is none
  Tracks_file result_;
};

}  // namespace

Tracks_file read_tracks(std::istream& in, const std::string& name, Tracks_format format,
                        double fps) {
  KINETRI_PRECONDITION(format == Tracks_format::rows || (std::isfinite(fps) && fps > 0),
                       "the number of frames a second is not a finite number greater than 0");
  // A stream that has failed before would look like a file without frames.
  if (in.fail()) {
    throw Input_error(name, 1, "reading failed; expected a readable file of tracks");
  }
  return Tracks_reader(in, name).read(format, fps);
}

Tracks_file read_tracks_file(const std::string& path, Tracks_format format, double fps) {
  if (path == "-") return read_tracks(std::cin, "standard input", format, fps);
  std::ifstream in = open_table(path, tracks_kind);
  return read_tracks(in, path, format, fps);
}

}  // namespace kinetri
