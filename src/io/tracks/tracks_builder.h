// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows come in, in any order; tracks go out. What every reader of tracks feeds: it gathers the rows
// of each id, sorts them, leaves out those that are there twice, and finds those that contradict
// each other.
#ifndef KINETRI_SRC_IO_TRACKS_TRACKS_BUILDER_H
#define KINETRI_SRC_IO_TRACKS_TRACKS_BUILDER_H

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/tracks/timestamp.h"
#include "kinetri/io/tracks_file.h"

namespace kinetri {

/// The time of a row: a date, or a number if there is none.
struct Row_time {
  double number = 0;
  std::optional<Timestamp> date = std::nullopt;
};

/// Something was seen.
struct Tracks_row {
  std::string_view id;
  Row_time time;
  Vector_2 place;
  std::size_t line = 0;  ///< where in the file
  double radius = 0;     ///< of a disc about it
};

class Tracks_builder {
 public:
  /// `name` is that of the file in messages, and must outlive it; `place_name` is what
  /// Tracks_row::line counts; `duplicates` is of the options.
  explicit Tracks_builder(const std::string& name, Tracks_duplicates duplicates,
                          std::string_view place_name = "line");

  /// Takes a row. Its numbers are finite, its id is not empty. Throws Input_error if the id has had
  /// another radius, or the time is a date where the first one was a number, or the reverse.
  void add(const Tracks_row& row);

  /// Throws Input_error: something is wrong with the row there.
  [[noreturn]] void fail(std::size_t line, const std::string& message) const;

  /// Sorts what has come. Nothing may come after that.
  void settle();

  /// The tracks in their order. Precondition: settle() was called.
  const std::vector<Track>& tracks() const { return result_.tracks; }

  /// What the file holds, as far as rows tell: the reader adds its format, radii and frame rate.
  /// Throws Input_error if an id is at two places at one time, unless it is to merge them. May be
  /// called once; settles.
  Tracks_file finish();

 private:
  // One id at two places at one time.
  struct Conflict {
    std::string id;
    Track_observation first;
    Track_observation second;  // in a later line
  };

  void expect_radius(const Tracks_row& row, const Track& track) const;
  void expect_kind_of_time(const Tracks_row& row) const;
  void replace_dates();
  void count_rows_out_of_order(const std::vector<Track_observation>& observations);
  void merge_times(const std::string& id, std::vector<Track_observation>& observations);
  Track_observation merged(std::span<const Track_observation> at_one_time,
                           std::optional<Conflict>& conflict);
  void sort_tracks();
  [[noreturn]] void fail_at_two_places() const;

  const std::string& name_;
  Tracks_duplicates duplicates_;
  std::string_view place_name_;
  // The rows of each id: a tree, and not a hash, so that no input makes the search slow.
  std::map<std::string, Track, std::less<>> rows_;  // the tracks without their ids
  // Of all rows, if times are dates: then the time of an observation is the index of its date.
  std::vector<Timestamp> dates_;
  bool has_rows_ = false;
  std::size_t first_line_ = 0;  // of the first row that came
  bool is_settled_ = false;
  std::optional<Conflict> conflict_;  // the one whose second line comes first
  Tracks_file result_;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_TRACKS_BUILDER_H
