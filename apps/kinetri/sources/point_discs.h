// SPDX-License-Identifier: GPL-3.0-or-later
//
// The discs of a points file: their sizes and masses, from columns or options, checked.
#ifndef KINETRI_APPS_POINT_DISCS_H
#define KINETRI_APPS_POINT_DISCS_H

#include <cstddef>
#include <vector>

#include "kinetri/io/points_file.h"
#include "sources/points_source.h"

namespace kinetri::app {

/// By point id.
struct Point_discs {
  std::vector<double> radii;    ///< at time 0
  std::vector<double> growths;  ///< of the radii, in a unit of time

  /// Whether all radii are equal, and none changes.
  bool are_equal() const;
};

/// The discs. Throws Usage_error if columns and options contradict each other or give no radii; and
/// Input_error, naming the line, for a radius that is negative at the start or before the end
/// (unless discs may stop growing before), and for discs that never touch, or do not fit into the
/// box that reflects their boundaries.
Point_discs point_discs(const Points_file& points, const Points_settings& settings);

/// The masses of the discs; empty if all are 1. Throws Input_error, naming the line, for a squared
/// radius that is not a valid mass.
std::vector<double> point_masses(const Points_file& points, const Point_discs& discs,
                                 const Points_settings& settings);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_POINT_DISCS_H
