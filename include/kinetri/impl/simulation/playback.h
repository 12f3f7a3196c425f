// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges, triangles and positions of a recording at a time. Not part of the public interface.
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
  bool is_there = false;   ///< else the rest is meaningless
  bool is_hidden = false;  ///< without a cell
  double x = 0;
  double y = 0;
  double radius = 0;  ///< of the disc about it; 0 or more
  double weight = 0;  ///< in the triangulation
};

/// Whether the points of a recording have radii or weights, so that its triangulation is regular.
bool has_weights(const Recording& recording);

/// The i-th triangle at the start; in the plane offsets are zero.
Periodic_triangle initial_triangle(const Recording& recording, std::size_t i);

/// The position at the time, as rounded_place, with radius and weight.
Recorded_place place_of(const Polynomial_disc_motion_2& motion, double time);

/// Plays a recording forward. Edges and triangles are those of the recording: no predicate is
/// evaluated. Positions err by a few units in the last place.
class Playback {
 public:
  /// At the start. `recording` must outlive it. Cost: that of the recording's size.
  explicit Playback(const Recording& recording);

  /// Goes to a time within the recording, after each row whose exact time is not later. An earlier
  /// time is reached from the start. Cost: O(log n) for each row.
  void go_to(double time);

  /// Goes to just after the first `rows` rows; the time is the first binary64 number that is not
  /// before that of the last one. Precondition: rows <= number of rows.
  void go_to_row(std::size_t rows);

  const Recording& recording() const { return recording_; }
  double time() const { return time_; }
  /// The number of rows that have been played.
  std::size_t rows() const { return rows_; }

  /// The edges now, sorted. In the plane offsets are zero.
  const std::set<Periodic_edge>& edges() const { return edges_; }
  /// The third corner of the triangle to the left of pq; its id is no_point if there is none.
  Periodic_image apex(const Periodic_image& p, const Periodic_image& q) const {
    return triangles_.apex(p, q);
  }
  /// The same in the plane.
  Point_id apex(Point_id p, Point_id q) const { return apex(Periodic_image{p}, {q}).id; }

  /// The number of point ids.
  std::size_t points() const { return current_.size(); }
  /// The present motion; null if the point does not exist now.
  const Polynomial_disc_motion_2* motion(Point_id id) const;
  /// The index of the last motion of the point in the recording, which may be its erasure; none
  /// before its insertion.
  std::optional<std::size_t> index_of_motion(Point_id id) const { return current_[id]; }
  /// The index of the motion of the point before the one with this index; none before the first.
  std::optional<std::size_t> previous_motion(std::size_t index) const { return previous_[index]; }

  /// The point that has the vertex of the point: another one that coincides with it, or itself.
  Point_id shown(Point_id id) const { return shown_[id]; }

  /// For each shown point, by id, the number of those that coincide with it; 0 for others.
  std::vector<std::size_t> numbers_of_coincident() const;

  /// The positions of all points by id.
  std::vector<Recorded_place> places() const;

 private:
  void start();
  void execute();
  void interpolate_changing_points(std::vector<Recorded_place>& places) const;
  void find_hidden(std::vector<Recorded_place>& places) const;

  const Recording& recording_;
  double time_ = 0;
  std::size_t rows_ = 0;
  std::size_t next_motion_ = 0;       // index in the recording
  std::size_t next_triangle_ = 0;     // the same
  std::size_t next_coincidence_ = 0;  // the same
  std::set<Periodic_edge> edges_;
  detail::Triangle_map<Periodic_image> triangles_;
  std::vector<Point_id> shown_;
  std::vector<std::optional<std::size_t>> current_;
  std::vector<std::optional<std::size_t>> previous_;  // by motion
};

/// The time at which a row is shown: the first binary64 number that is not before its exact time,
/// but not after the end.
double shown_time(const Recording& recording, std::size_t row);

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_PLAYBACK_H
