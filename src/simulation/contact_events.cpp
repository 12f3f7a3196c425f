// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/contact_events.h"

#include "kinetri/impl/triangulation/kinetic_core_impl.h"
#include "simulation/contact_events_impl.h"
#include "simulation/contact_runs.h"
#include "simulation/simulation_core_impl.h"
#include "triangulation/regions_impl.h"

namespace kinetri::detail {

template <class Traits>
bool Contact_runs<Traits>::can_run(const Core& core) {
  return Watched_contacts<Traits>::can_run(core);
}

template <class Traits>
std::size_t Contact_runs<Traits>::advance_to(Core& core, const Algebraic_number& until,
                                             const std::function<bool()>& may_go_on) {
  return Region_run<Traits, Contact_events<Traits>>(core, with_threads(core.threads))
      .advance_to(until, may_go_on);
}

template <class Traits>
void Contact_runs<Traits>::join(Core& core) {
  Region_run<Traits, Contact_events<Traits>>(core, with_threads(core.threads)).join();
}

template struct Contact_runs<Linear_kinetic_traits_2>;
template struct Contact_runs<Polynomial_kinetic_traits_2>;
template struct Contact_runs<Disc_kinetic_traits_2>;
template struct Contact_runs<Polynomial_disc_kinetic_traits_2>;
template struct Contact_runs<Periodic_kinetic_traits_2>;
template struct Contact_runs<Periodic_disc_kinetic_traits_2>;
template class Region_run<Linear_kinetic_traits_2, Contact_events<Linear_kinetic_traits_2>>;
template class Region_run<Polynomial_kinetic_traits_2, Contact_events<Polynomial_kinetic_traits_2>>;
template class Region_run<Disc_kinetic_traits_2, Contact_events<Disc_kinetic_traits_2>>;
template class Region_run<Polynomial_disc_kinetic_traits_2,
                          Contact_events<Polynomial_disc_kinetic_traits_2>>;
template class Region_run<Periodic_kinetic_traits_2, Contact_events<Periodic_kinetic_traits_2>>;
template class Region_run<Periodic_disc_kinetic_traits_2,
                          Contact_events<Periodic_disc_kinetic_traits_2>>;

}  // namespace kinetri::detail
