// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file of points as the source of a run: their motions, walls and discs.
#ifndef KINETRI_APPS_POINTS_SOURCE_H
#define KINETRI_APPS_POINTS_SOURCE_H

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/simulation/box_2.h"
#include "kinetri/simulation/collision_response.h"
#include "kinetri/triangulation/coincident_points.h"
#include "sources/run_source.h"

namespace kinetri {

struct Points_file;

}  // namespace kinetri

namespace kinetri::app {

struct Points_settings {
  std::string points;               ///< a path, or "-"
  std::optional<std::string> text;  ///< the points themselves: then `points` is a name for messages
  double from = 0;
  std::optional<double> until;                 ///< at least `from`; if none, see Run_source::until
  std::optional<Periodic_box_2> periodic_box;  ///< instead of walls
  std::optional<Box_2> box;
  bool rim_touches = false;
  std::optional<double> radius;  ///< of all discs, instead of the column of the points
  std::optional<double> growth;  ///< growth of all radii, instead of the column
  bool has_area_masses = false;  ///< masses are squares of radii, instead of the column
  /// Whether the triangulation is the regular one of the discs even if nothing touches them.
  bool is_regular = false;
  Coincident_points coincident = Coincident_points::hide;
  Named_response collisions = named_responses.front();
};

/// Remarks about the file for the user, a line each.
std::vector<std::string> remarks_about(const Points_file& points);

std::unique_ptr<Run_source> points_source(const Points_settings& settings);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_POINTS_SOURCE_H
