// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic regular triangulation: of discs of any size, and of points with weights.
#ifndef KINETRI_TRIANGULATION_KINETIC_REGULAR_TRIANGULATION_2_H
#define KINETRI_TRIANGULATION_KINETIC_REGULAR_TRIANGULATION_2_H

#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

/// The regular triangulation of moving points with weights, exact at every time: a
/// CGAL::Regular_triangulation_2 of points that move, in a periodic box one of the flat torus. It
/// is dual to the power diagram. For discs with disjoint interiors no point is hidden, and two
/// discs that touch have an edge. Kinetic_triangulation_2 has the interface.
template <WeightedKineticTraits_2 Traits = Disc_kinetic_traits_2>
using Kinetic_regular_triangulation_2 = Kinetic_triangulation_2<Traits>;

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_KINETIC_REGULAR_TRIANGULATION_2_H
