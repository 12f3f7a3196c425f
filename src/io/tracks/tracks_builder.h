// SPDX-License-Identifier: GPL-3.0-or-later
//
// Builds tracks from rows in any order, for all readers: collects the rows of each id, sorts them,
// drops duplicates, and finds contradictions.
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

/// An observation.
struct Tracks_row {
  std::string_view id;
  Row_time time;
  Vector_2 place;
  std::size_t line = 0;  ///< in the file
  double radius = 0;     ///< of a disc about it
};

class Tracks_builder {
 public:
  /// `name` is that of the file in messages, and must outlive it; `place_name` is the unit of
  /// Tracks_row::line; `duplicates` is that of the options.
  explicit Tracks_builder(const std::string& name, Tracks_duplicates duplicates,
                          std::string_view place_name = "line");

  /// Adds a row. Throws Input_error if the id has another radius, or if the times of the file are
  /// not all dates or all numbers. Precondition: its numbers are finite, its id is not empty.
  void add(const Tracks_row& row);

  /// Throws an Input_error about the row at `line`.
  [[noreturn]] void fail(std::size_t line, const std::string& message) const;

  /// Sorts the rows. No row may be added afterwards.
  void settle();

  /// The tracks in their order. Precondition: settle() was called.
  const std::vector<Track>& tracks() const { return result_.tracks; }

  /// The content of the file, to which the reader adds format, radii and frame rate. Throws
  /// Input_error if an id is at two positions at one time that are not to be merged. May be called
  /// once; calls settle().
  Tracks_file finish();

 private:
  // One id at two positions at one time.
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
  // The rows of each id: a tree, not a hash, so that no input is slow.
  std::map<std::string, Track, std::less<>> rows_;  // the tracks without their ids
  // Of all rows, if times are dates: the time of an observation is then the index of its date.
  std::vector<Timestamp> dates_;
  bool has_rows_ = false;
  std::size_t first_line_ = 0;  // of the first row
  bool is_settled_ = false;
  std::optional<Conflict> conflict_;  // that with the first second line
  Tracks_file result_;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_TRACKS_BUILDER_H
