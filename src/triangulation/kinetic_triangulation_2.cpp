// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/kinetic_triangulation_2.h"

#include <numeric>

#include "events/divided_scheduler_impl.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"
#include "triangulation/repair.h"
#include "triangulation/rounded_construction.h"

namespace kinetri {

std::uint64_t Triangulation_counters::number_of_events() const {
  return std::accumulate(events.begin(), events.end(), std::uint64_t{0});
}

// One cache line each, with pointers of 64 bits: memory access dominates the time of a run.
using Faces_and_vertices = Kinetic_triangulation_2<Linear_kinetic_traits_2>::Triangulation;
static_assert(sizeof(void*) != 8 || sizeof(Faces_and_vertices::Face) == 64);
static_assert(sizeof(void*) != 8 || sizeof(Faces_and_vertices::Vertex) == 64);

template class Kinetic_triangulation_2<Linear_kinetic_traits_2>;
template class Kinetic_triangulation_2<Polynomial_kinetic_traits_2>;

namespace detail {
KINETRI_KINETIC_PARTS(template, Linear_kinetic_traits_2);
KINETRI_KINETIC_PARTS(template, Polynomial_kinetic_traits_2);
template struct From_places<Linear_kinetic_traits_2>;
template struct From_places<Polynomial_kinetic_traits_2>;
}  // namespace detail

}  // namespace kinetri
