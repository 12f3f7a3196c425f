// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/contact_turns.h"

#include "kinetri/impl/simulation/contact_runs.h"
#include "kinetri/simulation/simulation_2_impl.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"
#include "simulation/contact_turns_impl.h"
#include "triangulation/regions_impl.h"

namespace kinetri::detail {

template <class Simulation>
bool Contact_runs<Simulation>::can_run(const Simulation& simulation) {
  return Contact_turns<Simulation>::can_run(simulation);
}

template <class Simulation>
std::size_t Contact_runs<Simulation>::advance_to(Simulation& simulation, const Time& until,
                                                 const std::function<bool()>& may_go_on) {
  return Contact_turns<Simulation>::run_of(simulation, with_threads(simulation.threads_))
      .advance_to(until, may_go_on);
}

template <class Simulation>
void Contact_runs<Simulation>::join(Simulation& simulation) {
  Contact_turns<Simulation>::run_of(simulation, with_threads(simulation.threads_)).join();
}

template struct Contact_runs<Simulation_2<Linear_kinetic_traits_2>>;
template struct Contact_runs<Simulation_2<Polynomial_kinetic_traits_2>>;
template struct Contact_runs<Simulation_2<Disc_kinetic_traits_2>>;
template struct Contact_runs<Simulation_2<Polynomial_disc_kinetic_traits_2>>;
template class Contact_turns<Simulation_2<Linear_kinetic_traits_2>>;
template class Contact_turns<Simulation_2<Polynomial_kinetic_traits_2>>;
template class Contact_turns<Simulation_2<Disc_kinetic_traits_2>>;
template class Contact_turns<Simulation_2<Polynomial_disc_kinetic_traits_2>>;
template class Region_run<Kinetic_triangulation_2<Linear_kinetic_traits_2>,
                          Contact_turns<Simulation_2<Linear_kinetic_traits_2>>>;
template class Region_run<Kinetic_triangulation_2<Polynomial_kinetic_traits_2>,
                          Contact_turns<Simulation_2<Polynomial_kinetic_traits_2>>>;
template class Region_run<Kinetic_triangulation_2<Disc_kinetic_traits_2>,
                          Contact_turns<Simulation_2<Disc_kinetic_traits_2>>>;
template class Region_run<Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>,
                          Contact_turns<Simulation_2<Polynomial_disc_kinetic_traits_2>>>;

}  // namespace kinetri::detail
