// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/simulation/wave.h"

#include "kinetri/impl/base/check.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri {
namespace {

void check(const Wave_setting& setting) {
  KINETRI_PRECONDITION(setting.columns > 0 && setting.rows > 0,
                       "a wave without points; expected 1 row and 1 column or more");
  KINETRI_PRECONDITION(setting.rows < no_point / setting.columns,
                       "a wave of too many points; expected fewer than 2^32 - 1");
  KINETRI_PRECONDITION(is_scenario_size(setting.spacing) && is_scenario_size(setting.speed) &&
                           is_scenario_size(setting.diameter) && setting.size_ratio >= 1 &&
                           setting.greatest_diameter() < setting.spacing,
                       "spacing, speed or diameter of a wave out of range; expected numbers from "
                       "1e-100 to 1e100, and a diameter less than the spacing");
  KINETRI_PRECONDITION(
      setting.jitter == 0 || (is_scenario_size(setting.jitter) &&
                              setting.jitter < (setting.spacing - setting.greatest_diameter()) / 2),
      "the jitter of a wave is out of range; expected 0, or a number from 1e-100 on and less than "
      "half of the room between neighbors");
}

}  // namespace

std::vector<Linear_motion_2> wave_motions(const Wave_setting& setting) {
  check(setting);
  const std::size_t points = setting.columns * setting.rows;
  std::vector<double> offsets(points, 0);
  if (setting.jitter > 0) {
    Scenario_options options;
    options.points = points;
    options.seed = setting.seed;
    options.side = 2 * setting.jitter;
    const auto random = make_scenario(Scenario::uniform, options);
    for (std::size_t i = 0; i < points; ++i) offsets[i] = random[i].position.y - setting.jitter;
  }
  std::vector<Linear_motion_2> result;
  result.reserve(points);
  for (std::size_t row = 0; row < setting.rows; ++row) {
    for (std::size_t column = 0; column < setting.columns; ++column) {
      const Vector_2 place = {static_cast<double>(column) * setting.spacing,
                              static_cast<double>(row) * setting.spacing + offsets[result.size()]};
      result.push_back({place, {0, row == 0 ? setting.speed : 0}});
    }
  }
  return result;
}

std::vector<Disc_motion_2> wave_discs(const Wave_setting& setting) {
  std::vector<Disc_motion_2> result;
  for (const Linear_motion_2& motion : wave_motions(setting)) {
    const std::size_t row = result.size() / setting.columns;
    const std::size_t column = result.size() % setting.columns;
    const bool is_small = (row + column) % 2 == 0;
    result.push_back(
        {motion, (is_small ? setting.diameter : setting.greatest_diameter()) / 2, 0, 0});
  }
  return result;
}

Simulation_options wave_options(const Wave_setting& setting) {
  check(setting);
  const double margin = setting.spacing / 2;
  Simulation_options result;
  result.box = Box_2{-margin, -margin, setting.width() - margin, setting.height() - margin};
  result.radius = setting.has_sizes() ? 0 : setting.diameter / 2;
  result.refuses_overlaps = setting.has_sizes();
  result.response = swap_velocities;
  return result;
}

}  // namespace kinetri
