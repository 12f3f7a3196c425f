// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/edge_output.h"

#include "kinetri/io/edges_file.h"
#include "sources/any_simulation.h"

namespace kinetri::app {

void write_present_edges(std::ostream& out, const Any_simulation& simulation) {
  simulation.visit([&]<class Traits>(const Simulation_2<Traits>& s) {
    if constexpr (PeriodicKineticTraits_2<Traits>) {
      write_periodic_edges(out, s.triangulation().periodic_edges());
    } else {
      write_edges(out, s.triangulation().finite_edge_ids());
    }
  });
}

}  // namespace kinetri::app
