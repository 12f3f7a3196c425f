// SPDX-License-Identifier: GPL-3.0-or-later
//
// Generated points as the source of a run: those of the wave and of the experiment.
#ifndef KINETRI_APPS_GENERATED_SOURCE_H
#define KINETRI_APPS_GENERATED_SOURCE_H

#include <cstddef>
#include <cstdint>
#include <memory>

#include "kinetri/impl/simulation/wave.h"
#include "kinetri/simulation/collision_response.h"
#include "sources/run_source.h"

namespace kinetri {

struct Experiment_setting;

}  // namespace kinetri

namespace kinetri::app {

struct Wave_run {
  Wave_setting setting;
  double until = 0;
  double height = 1;  ///< of the crest on the page of --html
  double width = 1;   ///< standard deviation of its shape
};

std::unique_ptr<Run_source> wave_source(const Wave_run& run);

/// One run of the experiment.
struct Experiment_run {
  std::size_t points = 100;
  std::uint64_t percentage = 100;  ///< of the points that move
  std::uint64_t seed = 1;
  double side = 100;
  double speed = 5;
  double radius = 0.5;
  double size_ratio = 1;  ///< radius of the discs of odd ids over `radius`
  double duration = 10;
  Named_response collisions = named_responses.front();
};

/// Converts it to the library's type.
Experiment_setting experiment_setting(const Experiment_run& run);

std::unique_ptr<Run_source> experiment_source(const Experiment_run& run);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_GENERATED_SOURCE_H
