// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simulation_2 of discs of any size in a periodic box, apart from that of discs of one size for the
// time that it takes to compile. The members of the parts of the triangulation that it uses are
// instantiated here.
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"
#include "simulation/simulation_2_impl.h"
#include "triangulation/face_journal.h"
#include "triangulation/repair.h"
#include "triangulation/torus_construction.h"
#include "triangulation/torus_topology.h"

namespace kinetri {

template class Simulation_2<Periodic_disc_kinetic_traits_2>;

namespace detail {
KINETRI_SIMULATION_PARTS(template, Periodic_disc_kinetic_traits_2);
}  // namespace detail

}  // namespace kinetri
