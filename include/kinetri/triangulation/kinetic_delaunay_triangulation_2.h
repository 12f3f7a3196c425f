// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic Delaunay triangulation.
#ifndef KINETRI_TRIANGULATION_KINETIC_DELAUNAY_TRIANGULATION_2_H
#define KINETRI_TRIANGULATION_KINETIC_DELAUNAY_TRIANGULATION_2_H

#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

/// The Delaunay triangulation of moving points, exact at every time: a
/// CGAL::Delaunay_triangulation_2 of points that move, in a periodic box one of the flat torus.
/// Kinetic_triangulation_2 has the interface.
template <KineticTraits_2 Traits = Linear_kinetic_traits_2>
using Kinetic_delaunay_triangulation_2 = Kinetic_triangulation_2<Traits>;

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_KINETIC_DELAUNAY_TRIANGULATION_2_H
