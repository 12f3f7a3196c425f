// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that the program itself makes as the source of a run: those of the wave, and of the
// experiment.
#ifndef KINETRI_APPS_GENERATED_SOURCE_H
#define KINETRI_APPS_GENERATED_SOURCE_H

#include <utility>

#include "sources/run_source.h"

namespace kinetri::app {

struct Generated_run {
  std::string title;
  std::vector<Linear_motion_2> motions;  ///< at time 0, distinct, and inside of the box
  Simulation_options options;
  std::string response;  ///< its name in `named_responses`
  double until = 0;
  std::optional<Wave_shape> wave = std::nullopt;
};

class Generated_source final : public Run_source {
 public:
  explicit Generated_source(Generated_run run) : run_(std::move(run)) {}

  std::string path() const override { return {}; }
  std::string title() const override { return run_.title; }
  void read() override {}
  std::size_t number_of_points() const override { return run_.motions.size(); }
  double from() const override { return 0; }
  double until() const override { return run_.until; }
  std::string response() const override { return run_.response; }
  Any_simulation make_simulation(Arithmetic arithmetic) const override;
  std::optional<Wave_shape> wave() const override { return run_.wave; }

 private:
  Generated_run run_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_GENERATED_SOURCE_H
