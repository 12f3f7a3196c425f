// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangulation of points in a periodic box, and of the torus. Its parts are instantiated
// member by member: the members for the hull are not for periodic boxes.
#include "events/divided_scheduler_impl.h"
#include "kinetri/triangulation/audit_impl.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"
#include "triangulation/face_journal.h"
#include "triangulation/repair.h"
#include "triangulation/torus_construction.h"
#include "triangulation/torus_topology.h"

namespace kinetri {

template class Kinetic_triangulation_2<Periodic_kinetic_traits_2>;

namespace detail {
using Predicates = Periodic_kinetic_traits_2::Instantaneous_traits;
template class Torus_triangulation<Predicates>;
template Torus_triangulation<Predicates> triangulation_of_torus(
    std::span<const Predicates::Point_2>, double, const Predicates&, std::vector<Edge_ids>&);
KINETRI_PARTS_OF_ANY_SPACE(template, Periodic_kinetic_traits_2);
template Audit_report audit<Periodic_kinetic_traits_2>(
    const Kinetic_core<Periodic_kinetic_traits_2>&, Audit_level);
}  // namespace detail

}  // namespace kinetri
