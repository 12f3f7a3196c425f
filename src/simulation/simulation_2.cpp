// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/simulation_2.h"

#include "simulation/simulation_2_impl.h"

namespace kinetri {

template class Simulation_2<Linear_kinetic_traits_2>;
template class Simulation_2<Polynomial_kinetic_traits_2>;

namespace detail {
KINETRI_SIMULATION_PARTS(template, Linear_kinetic_traits_2);
KINETRI_SIMULATION_PARTS(template, Polynomial_kinetic_traits_2);
}  // namespace detail

}  // namespace kinetri
