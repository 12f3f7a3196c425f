// SPDX-License-Identifier: GPL-3.0-or-later
//
// contact_events.cpp for platforms without oneTBB: one thread executes contacts, so that nothing
// else is called.
#include <cstddef>
#include <functional>

#include "kinetri/impl/base/check.h"
#include "simulation/contact_runs.h"

namespace kinetri::detail {

template <class Traits>
bool Contact_runs<Traits>::can_run(const Core&) {
  return false;
}

template <class Traits>
std::size_t Contact_runs<Traits>::advance_to(Core&, const Algebraic_number&,
                                             const std::function<bool()>&) {
  KINETRI_ASSERT(false, "one thread executes contacts");
  return 0;
}

template <class Traits>
void Contact_runs<Traits>::join(Core&) {
  KINETRI_ASSERT(false, "the queues are in one part");
}

template struct Contact_runs<Linear_kinetic_traits_2>;
template struct Contact_runs<Polynomial_kinetic_traits_2>;
template struct Contact_runs<Disc_kinetic_traits_2>;
template struct Contact_runs<Polynomial_disc_kinetic_traits_2>;
template struct Contact_runs<Periodic_kinetic_traits_2>;
template struct Contact_runs<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri::detail
