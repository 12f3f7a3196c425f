// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangulation of points in a periodic box. Includes CGAL: headers that only name the class
// should declare what they need.
#ifndef KINETRI_APPS_PERIODIC_TRIANGULATION_H
#define KINETRI_APPS_PERIODIC_TRIANGULATION_H

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri::app {

/// Nothing but its points and edges changes: a box has no walls, and points have no contacts.
using Periodic_triangulation = Kinetic_triangulation_2<Periodic_kinetic_traits_2>;

}  // namespace kinetri::app

#endif  // KINETRI_APPS_PERIODIC_TRIANGULATION_H
