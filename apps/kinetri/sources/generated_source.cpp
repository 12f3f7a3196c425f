// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/generated_source.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/text.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/impl/simulation/experiment.h"
#include "kinetri/io/viewer_page.h"
#include "sources/any_simulation.h"

namespace kinetri::app {
namespace {

struct Generated_run {
  std::string title;
  // Distinct points or discs inside of the box, at time 0.
  std::variant<std::vector<Linear_motion_2>, std::vector<Disc_motion_2>> motions;
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
  std::size_t number_of_points() const override {
    return std::visit([](const auto& motions) { return motions.size(); }, run_.motions);
  }
  double from() const override { return 0; }
  std::optional<double> until() const override { return run_.until; }
  std::string response() const override { return run_.response; }
  Any_simulation make_simulation(Arithmetic arithmetic) const override {
    return std::visit(
        [&]<class Motion>(const std::vector<Motion>& motions) -> Any_simulation {
          using Traits = Basic_kinetic_traits_2<Motion>;
          return std::make_unique<Simulation_2<Traits>>(motions, run_.options, from(),
                                                        Traits(arithmetic));
        },
        run_.motions);
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
  Generated_run result;
  result.title = joined("wave of ", setting.columns, " x ", setting.rows, " points");
  result.motions = wave_motions(setting);
  if (setting.has_sizes()) result.motions = wave_discs(setting);
  result.options = wave_options(setting);
  result.response = "swap";
  result.until = run.until;
  result.wave = Wave_shape{run.height, run.width};
  return std::make_unique<Generated_source>(std::move(result));
}

Experiment_setting experiment_setting(const Experiment_run& run) {
  Experiment_setting result;
  result.points = run.points;
  result.movers = run.points * static_cast<std::size_t>(run.percentage) / 100;
  result.seed = run.seed;
  result.side = run.side;
  result.speed = run.speed;
  result.diameter = 2 * run.radius;
  result.size_ratio = run.size_ratio;
  result.duration = run.duration;
  result.response = run.collisions.response;
  return result;
}

std::unique_ptr<Run_source> experiment_source(const Experiment_run& run) {
  const Experiment_setting setting = experiment_setting(run);
  Generated_run result;
  result.title = joined("experiment: ", counted(run.points, "point"), ", ", run.percentage,
                        " % moving, seed ", run.seed);
  result.motions = experiment_motions(setting);
  if (setting.has_sizes()) result.motions = experiment_discs(setting);
  result.options = experiment_options(setting);
  result.response = run.collisions.name;
  result.until = run.duration;
  return std::make_unique<Generated_source>(std::move(result));
}

}  // namespace kinetri::app
