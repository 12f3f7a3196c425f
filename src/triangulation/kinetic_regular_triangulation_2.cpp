// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"

#include "events/divided_scheduler_impl.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"
#include "triangulation/repair.h"
#include "triangulation/rounded_construction.h"

namespace kinetri {

template class Kinetic_triangulation_2<Disc_kinetic_traits_2>;
template class Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>;

namespace detail {
KINETRI_KINETIC_PARTS(template, Disc_kinetic_traits_2);
KINETRI_KINETIC_PARTS(template, Polynomial_disc_kinetic_traits_2);
template struct From_places<Disc_kinetic_traits_2>;
template struct From_places<Polynomial_disc_kinetic_traits_2>;
}  // namespace detail

}  // namespace kinetri
