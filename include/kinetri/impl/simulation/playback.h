// SPDX-License-Identifier: GPL-3.0-or-later
//
// A recording at a time: its edges and triangles, and where its points are. Not part of the public
// interface.
#ifndef KINETRI_IMPL_SIMULATION_PLAYBACK_H
#define KINETRI_IMPL_SIMULATION_PLAYBACK_H

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include "kinetri/simulation/recording.h"

namespace kinetri {

/// A point at a time, rounded.
struct Recorded_place {
  bool is_there = false;   ///< else the rest has no meaning
  bool is_hidden = false;  ///< by other points, so that it is no vertex
  double x = 0;
  double y = 0;
  double radius = 0;  ///< of the disc about it; 0 or more
  double weight = 0;  ///< in the triangulation
};

/// Whether the points of a recording have radii or weights, so that its triangulation is regular.
bool has_weights(const Recording& recording);

/// Where a motion is, and how fast: as rounded_place, but with a radius.
Recorded_place place_of(const Polynomial_disc_motion_2& motion, double time);

/// A recording that is played forward. Edges and triangles are those of the recording: no predicate
/// is evaluated. Places are binary64 numbers that err by a few units in the last place.
class Playback {
 public:
  /// At the start. `recording` must outlive it. Cost: that of the recording's size.
  explicit Playback(const Recording& recording);

  /// Goes to a time within the recording: each row whose exact time is not after it has happened.
  /// Back to an earlier time it plays from the start. Cost: O(log n) for each row.
  void go_to(double time);

  /// Goes to just after the first `rows` rows; the time is the first binary64 number that is not
  /// before that of the last one. Precondition: there are so many.
  void go_to_row(std::size_t rows);

  const Recording& recording() const { return recording_; }
  double time() const { return time_; }
  /// How many rows have happened.
  std::size_t rows() const { return rows_; }

  /// The edges now, sorted.
  const std::set<Edge_ids>& edges() const { return edges_; }
  /// The third corner of the triangle to the left of pq; no_point if there is none.
  Point_id apex(Point_id p, Point_id q) const { return triangles_.apex(p, q); }

  /// The number of points that ever are.
  std::size_t points() const { return current_.size(); }
  /// The motion in force; null if the point is not there.
  const Polynomial_disc_motion_2* motion(Point_id id) const;
  /// The index of that motion in the recording, also of one that says that the point is gone; none
  /// before the point comes.
  std::optional<std::size_t> index_of_motion(Point_id id) const { return current_[id]; }
  /// The index of the motion of the point before the one with this index; none before the first.
  std::optional<std::size_t> previous_motion(std::size_t index) const { return previous_[index]; }

  /// The places of all points by id.
  std::vector<Recorded_place> places() const;

 private:
  void start();
  void execute();
  void place_turning_points(std::vector<Recorded_place>& places) const;
  void find_hidden(std::vector<Recorded_place>& places) const;

  const Recording& recording_;
  double time_ = 0;
  std::size_t rows_ = 0;
  std::size_t next_motion_ = 0;    // index in the recording
  std::size_t next_triangle_ = 0;  // the same
  std::set<Edge_ids> edges_;
  detail::Triangle_map triangles_;
  std::vector<std::optional<std::size_t>> current_;
  std::vector<std::optional<std::size_t>> previous_;  // by motion
};

/// The time at which a row is shown: the first binary64 number that is not before its exact time,
/// but not after the end.
double shown_time(const Recording& recording, std::size_t row);

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_PLAYBACK_H
