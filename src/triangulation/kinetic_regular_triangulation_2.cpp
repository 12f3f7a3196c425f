// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"

#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"

namespace kinetri {

template class Kinetic_triangulation_2<Disc_kinetic_traits_2>;
template class Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>;

// What simulations and audits call of the parts.
namespace detail {
template class Topology<Disc_kinetic_traits_2>;
template class Topology<Polynomial_disc_kinetic_traits_2>;
template class Event_loop<Disc_kinetic_traits_2>;
template class Event_loop<Polynomial_disc_kinetic_traits_2>;
template class Point_changes<Disc_kinetic_traits_2>;
template class Point_changes<Polynomial_disc_kinetic_traits_2>;
template struct Kinetic_core<Disc_kinetic_traits_2>;
template class Schedule<Disc_kinetic_traits_2>::Policy;
template bool Schedule<Disc_kinetic_traits_2>::settle(const Algebraic_number*);
template struct Kinetic_core<Polynomial_disc_kinetic_traits_2>;
template class Schedule<Polynomial_disc_kinetic_traits_2>::Policy;
template bool Schedule<Polynomial_disc_kinetic_traits_2>::settle(const Algebraic_number*);
}  // namespace detail

}  // namespace kinetri
