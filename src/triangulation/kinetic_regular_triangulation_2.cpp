// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"

#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"

namespace kinetri {

template class Kinetic_triangulation_2<Disc_kinetic_traits_2>;
template class Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>;

// What simulations and audits call of the parts.
namespace detail {
template class Kinetic_types<Disc_kinetic_traits_2>::Topology;
template class Kinetic_types<Polynomial_disc_kinetic_traits_2>::Topology;
template class Kinetic_types<Disc_kinetic_traits_2>::Event_loop;
template class Kinetic_types<Polynomial_disc_kinetic_traits_2>::Event_loop;
template class Kinetic_types<Disc_kinetic_traits_2>::Point_changes;
template class Kinetic_types<Polynomial_disc_kinetic_traits_2>::Point_changes;
template struct Kinetic_types<Disc_kinetic_traits_2>::Kinetic_core;
template class Kinetic_types<Disc_kinetic_traits_2>::Schedule::Policy;
template bool Kinetic_types<Disc_kinetic_traits_2>::Schedule::settle(const Algebraic_number*);
template struct Kinetic_types<Polynomial_disc_kinetic_traits_2>::Kinetic_core;
template class Kinetic_types<Polynomial_disc_kinetic_traits_2>::Schedule::Policy;
template bool Kinetic_types<Polynomial_disc_kinetic_traits_2>::Schedule::settle(
    const Algebraic_number*);
}  // namespace detail

}  // namespace kinetri
