// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangulation of discs in a periodic box, instantiated as that of points.
#include "events/divided_scheduler_impl.h"
#include "kinetri/triangulation/audit_impl.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"
#include "triangulation/face_journal.h"
#include "triangulation/repair.h"
#include "triangulation/torus_construction.h"
#include "triangulation/torus_topology.h"

namespace kinetri {

template class Kinetic_triangulation_2<Periodic_disc_kinetic_traits_2>;

namespace detail {
using Disc_predicates = Periodic_disc_kinetic_traits_2::Instantaneous_traits;
template class Torus_triangulation<Disc_predicates>;
template Torus_triangulation<Disc_predicates> triangulation_of_torus(
    std::span<const Disc_predicates::Point_2>, double, const Disc_predicates&,
    std::vector<Edge_ids>&);
KINETRI_PARTS_OF_ANY_SPACE(template, Periodic_disc_kinetic_traits_2);
template Audit_report audit<Periodic_disc_kinetic_traits_2>(
    const Kinetic_core<Periodic_disc_kinetic_traits_2>&, Audit_level);
}  // namespace detail

}  // namespace kinetri
