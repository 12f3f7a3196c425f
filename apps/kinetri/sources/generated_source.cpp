// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/generated_source.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/text.h"
#include "io/text.h"
#include "kinetri/io/viewer_page.h"
#include "simulation/experiment.h"
#include "sources/any_simulation.h"

namespace kinetri::app {
namespace {

struct Generated_run {
  std::string title;
  std::vector<Linear_motion_2> motions;  // at time 0, distinct, and inside of the box
  Simulation_options options;
  std::string response;  // its name in `named_responses`
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
  std::optional<double> until() const override { return run_.until; }
  std::string response() const override { return run_.response; }
  Any_simulation make_simulation(Arithmetic arithmetic) const override {
    return std::make_unique<Any_simulation::Linear>(run_.motions, run_.options, from(),
                                                    Linear_kinetic_traits_2(arithmetic));
  }
  void describe(Viewer_settings& settings) const override {
    Run_source::describe(settings);
    settings.wave = run_.wave;
  }

 private:
  Generated_run run_;
};

}  // namespace

std::unique_ptr<Run_source> wave_source(const Wave_run& run) {
  const Wave_setting& setting = run.setting;
  return std::make_unique<Generated_source>(Generated_run{
      joined("wave of ", setting.columns, " x ", setting.rows, " points"), wave_motions(setting),
      wave_options(setting), "swap", run.until, Wave_shape{run.height, run.width}});
}

Experiment_setting experiment_setting(const Experiment_run& run) {
  Experiment_setting result;
  result.points = run.points;
  result.movers = run.points * static_cast<std::size_t>(run.percentage) / 100;
  result.seed = run.seed;
  result.side = run.side;
  result.speed = run.speed;
  result.diameter = 2 * run.radius;
  result.duration = run.duration;
  result.response = run.collisions.response;
  return result;
}

std::unique_ptr<Run_source> experiment_source(const Experiment_run& run) {
  const Experiment_setting setting = experiment_setting(run);
  return std::make_unique<Generated_source>(
      Generated_run{joined("experiment: ", counted(run.points, "point"), ", ", run.percentage,
                           " % moving, seed ", run.seed),
                    experiment_motions(setting), experiment_options(setting),
                    std::string(run.collisions.name), run.duration});
}

}  // namespace kinetri::app
