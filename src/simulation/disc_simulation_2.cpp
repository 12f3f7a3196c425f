// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simulation_2 of discs of any size, apart from that of points for the time that it takes to
// compile.
#include "kinetri/simulation/simulation_2.h"
#include "simulation/simulation_2_impl.h"

namespace kinetri {

template class Simulation_2<Disc_kinetic_traits_2>;
template class Simulation_2<Polynomial_disc_kinetic_traits_2>;

namespace detail {
KINETRI_SIMULATION_PARTS(template, Disc_kinetic_traits_2);
KINETRI_SIMULATION_PARTS(template, Polynomial_disc_kinetic_traits_2);
}  // namespace detail

}  // namespace kinetri
