// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/encounters.h"

#include <cmath>

#include "kinetri/impl/base/check.h"
#include "observers/encounter_tracker.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
Encounters<Traits>::Encounters(Simulation_2<Traits>& simulation, double range)
    : Edge_follower<Traits>(simulation), range_(range) {
  start(simulation.options().radius);
}

template <ContactKineticTraits_2 Traits>
Encounters<Traits>::~Encounters() = default;

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::start(double radius) {
  KINETRI_PRECONDITION(range_ >= 0 && std::isfinite(range_),
                       "the range must be a number of at least 0");
  tracker_ = std::make_shared<detail::Encounter_tracker<Traits>>(
      this->graph(), this->traits(), range_, radius, this->triangulation().current_time());
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::advance(const Time& time) {
  tracker_->advance(time);
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::before_change(std::span<const Edge_ids> /*removed*/,
                                       std::span<const Changed_point> points) {
  tracker_->before_change(points);
}

template <ContactKineticTraits_2 Traits>
void Encounters<Traits>::change(const Time& time, std::span<const Edge_ids> /*removed*/,
                                std::span<const Edge_ids> added,
                                std::span<const Changed_point> points) {
  tracker_->change(time, added, points);
}

template <ContactKineticTraits_2 Traits>
std::vector<Encounter> Encounters<Traits>::encounters() {
  this->update();
  return tracker_->encounters(this->triangulation().current_time());
}

template <ContactKineticTraits_2 Traits>
const Certificate_counters& Encounters<Traits>::certificate_counters() const {
  return tracker_->certificate_counters();
}

template <ContactKineticTraits_2 Traits>
const Queue_counters& Encounters<Traits>::queue_counters() const {
  return tracker_->queue_counters();
}

template class Encounters<Linear_kinetic_traits_2>;
template class Encounters<Polynomial_kinetic_traits_2>;
template class Encounters<Disc_kinetic_traits_2>;
template class Encounters<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri
