// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/encounters.h"

#include "observers/encounter_tracker.h"

namespace kinetri {

template <DistanceKineticTraits_2 Traits>
Encounters<Traits>::Encounters(Simulation_2<Traits>& simulation, double range)
    : tracker_(std::make_unique<detail::Encounter_tracker<Traits>>(simulation, range,
                                                                   simulation.options().radius)) {}

template <DistanceKineticTraits_2 Traits>
Encounters<Traits>::Encounters(Triangulation& triangulation,
                               double range) requires(!HasWeight<typename Traits::Motion>)
    : tracker_(std::make_unique<detail::Encounter_tracker<Traits>>(triangulation, range, 0)) {}

template <DistanceKineticTraits_2 Traits>
Encounters<Traits>::~Encounters() = default;

template <DistanceKineticTraits_2 Traits>
double Encounters<Traits>::range() const {
  return tracker_->range();
}

template <DistanceKineticTraits_2 Traits>
std::vector<Encounter> Encounters<Traits>::encounters() {
  return tracker_->encounters();
}

template <DistanceKineticTraits_2 Traits>
const Certificate_counters& Encounters<Traits>::certificate_counters() const {
  return tracker_->certificate_counters();
}

template <DistanceKineticTraits_2 Traits>
const Queue_counters& Encounters<Traits>::queue_counters() const {
  return tracker_->queue_counters();
}

template class Encounters<Linear_kinetic_traits_2>;
template class Encounters<Polynomial_kinetic_traits_2>;
template class Encounters<Disc_kinetic_traits_2>;
template class Encounters<Polynomial_disc_kinetic_traits_2>;
template class Encounters<Periodic_kinetic_traits_2>;
template class Encounters<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri
