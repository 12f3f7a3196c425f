// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/detail/contact_turns.h"

#include "kinetri/simulation/detail/contact_turns_impl.h"
#include "kinetri/simulation/simulation_2_impl.h"
#include "kinetri/triangulation/detail/regions_impl.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"

namespace kinetri::detail {

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
