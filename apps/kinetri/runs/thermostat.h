// SPDX-License-Identifier: GPL-3.0-or-later
//
// A thermostat: keeps the kinetic energy of a run at its value, at regular times.
#ifndef KINETRI_APPS_THERMOSTAT_H
#define KINETRI_APPS_THERMOSTAT_H

#include <cstddef>
#include <optional>
#include <vector>

#include "runs/run_settings.h"
#include "sources/any_simulation.h"

namespace kinetri::app {

class Thermostat {
 public:
  explicit Thermostat(const Thermostat_settings& settings) : settings_(settings) {}

  /// Chooses the times after now, up to `until`, and the energy. Throws Usage_error if there are
  /// too many times, or if nothing moves.
  void start(const Any_simulation& simulation, double until);

  /// The time at which velocities are scaled next; none after the last.
  std::optional<double> next_time() const;

  /// Scales the velocities (set_kinetic_energy), unless nothing moves. Precondition: next_time() is
  /// the time of the simulation.
  void scale(const Any_simulation& simulation);

 private:
  Thermostat_settings settings_;
  std::vector<double> times_;
  std::size_t next_ = 0;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_THERMOSTAT_H
