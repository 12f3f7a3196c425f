// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/simulation_2.h"

#include "kinetri/simulation/simulation_2_impl.h"

namespace kinetri {

template class Simulation_2<Linear_kinetic_traits_2>;
template struct detail::Simulation_types<Linear_kinetic_traits_2>::Simulation_core;
template class Simulation_2<Polynomial_kinetic_traits_2>;
template struct detail::Simulation_types<Polynomial_kinetic_traits_2>::Simulation_core;

}  // namespace kinetri
