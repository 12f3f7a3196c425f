// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/queries_2.h"
#include "triangulation/queries_2_impl.h"

namespace kinetri {

template class Kinetic_queries_2<Disc_kinetic_traits_2>;
template class Kinetic_queries_2<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri
