// SPDX-License-Identifier: GPL-3.0-or-later
#include "runs/thermostat.h"

#include <cmath>

#include "cli/arguments.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/observers/mean_pressure.h"
#include "outputs/regular_times.h"

namespace kinetri::app {
namespace {

Usage_error problem(double energy) {
  return Usage_error(joined("--thermostat: the kinetic energy is ", energy,
                            ", so that no factor changes it to another one; expected points that "
                            "move, and numbers near 1, in other units perhaps"));
}

// The kinetic energy; throws unless it is finite.
double energy_of(const Any_simulation& simulation) {
  const double energy = simulation.visit([](const auto& s) { return kinetic_energy(s); });
  if (!std::isfinite(energy)) throw problem(energy);
  return energy;
}

}  // namespace

void Thermostat::start(const Any_simulation& simulation, double until) {
  constexpr std::size_t most = 1'000'000;
  const double from =
      simulation.visit([](const auto& s) { return s.current_time().tight_interval().upper; });
  const auto times = multiples(from, until, settings_.per_time, most);
  if (!times) {
    throw Usage_error(joined("--thermostat: ", settings_.per_time,
                             " times in a unit of time are more than ", most,
                             " until the end; expected a smaller number"));
  }
  times_ = *times;
  if (!times_.empty() && times_.front() == from) next_ = 1;  // a run that is resumed there
  const double now = energy_of(simulation);
  // With a given energy points may begin to move later.
  if (now == 0 && !settings_.energy) throw problem(now);
  if (!settings_.energy) settings_.energy = now;
}

std::optional<double> Thermostat::next_time() const {
  if (next_ >= times_.size()) return std::nullopt;
  return times_[next_];
}

void Thermostat::scale(const Any_simulation& simulation) {
  ++next_;
  if (energy_of(simulation) == 0) return;
  simulation.visit([this](auto& s) { set_kinetic_energy(s, *settings_.energy); });
}

}  // namespace kinetri::app
