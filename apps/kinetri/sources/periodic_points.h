// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run in a periodic box simulates: points of a file, or recorded tracks.
#ifndef KINETRI_APPS_PERIODIC_POINTS_H
#define KINETRI_APPS_PERIODIC_POINTS_H

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/periodic_box_2.h"

namespace kinetri::app {

struct Tracks_settings;

/// A new motion of a point, which is inserted if it is not there; none: the point is erased.
struct Periodic_change {
  double time = 0;
  Point_id id = no_point;
  std::optional<Linear_motion_2> motion;
};

struct Periodic_points {
  Periodic_box_2 box;
  double from = 0;
  double until = 0;                      ///< at least `from`
  std::vector<Linear_motion_2> motions;  ///< just after `from`
  std::size_t number_of_points = 0;      ///< also of those that are inserted
  /// After `from`, by time, then by id; points that are inserted get the next ids.
  std::vector<Periodic_change> changes = {};
  std::vector<std::string> labels = {};   ///< of all points by id; may be empty
  std::vector<std::string> remarks = {};  ///< about the input, for users
  std::string verified = {};              ///< a points file that kinetri-verify can read; or empty
  /// The error for two points that are images of each other from a time on.
  std::function<Input_error(const Coincident_trajectories_error&, double time)> coincidence = {};
  /// Writes the ids of the points (Output::ids).
  std::function<void(std::ostream&)> write_ids = {};
};

/// The points of a file. Throws Input_error if they cannot be read, or accelerate.
Periodic_points points_in_box(const std::string& path, const Periodic_box_2& box, double from,
                              double until);

/// Recorded tracks of atoms, in the box of their file. Throws Input_error, also if there is not one
/// such box; and Usage_error.
Periodic_points tracks_in_box(const Tracks_settings& settings);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_PERIODIC_POINTS_H
