// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file of points as the source of a run: their paths, walls and discs.
#ifndef KINETRI_APPS_POINTS_SOURCE_H
#define KINETRI_APPS_POINTS_SOURCE_H

#include <optional>

#include "kinetri/io/points_file.h"
#include "sources/run_source.h"

namespace kinetri::app {

struct Points_settings {
  std::string points;  ///< a path, or "-"
  double from = 0;
  double until = 0;  ///< at least `from`
  std::optional<Box_2> box;
  bool rim_touches = false;
  std::optional<double> radius;  ///< of all discs, instead of the column of the points
  Named_response collisions = named_responses[0];
};

class Points_source final : public Run_source {
 public:
  explicit Points_source(Points_settings settings) : settings_(std::move(settings)) {}

  std::string path() const override { return settings_.points; }
  void read() override;
  std::size_t number_of_points() const override { return points_.number_of_points(); }
  double from() const override { return settings_.from; }
  double until() const override { return settings_.until; }
  std::string response() const override { return std::string(settings_.collisions.name); }
  Any_simulation make_simulation(Arithmetic arithmetic) const override;
  std::vector<std::string> remarks() const override;

 private:
  Simulation_options options() const;
  double radius() const;

  Points_settings settings_;
  Points_file points_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_POINTS_SOURCE_H
