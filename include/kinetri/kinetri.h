// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library, in one include.
#ifndef KINETRI_KINETRI_H
#define KINETRI_KINETRI_H

#include "kinetri/base/error.h"
#include "kinetri/events/event.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/triangulation/audit.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/queries_2.h"
#include "kinetri/version.h"

#endif  // KINETRI_KINETRI_H
