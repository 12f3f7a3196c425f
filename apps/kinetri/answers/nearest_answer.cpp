// SPDX-License-Identifier: GPL-3.0-or-later
#include "answers/table_answer.h"
#include "cli/arguments.h"

namespace kinetri::app {

std::unique_ptr<Answer> nearest_answer(const Answer_settings& /*settings*/,
                                       const Any_simulation& simulation, const Run_source& source) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    if constexpr (HasNearestNeighbors<Traits>) {
      return table_answer<Nearest_neighbors<Traits>>(
          source, detail::Nearest_neighbor_columns{PeriodicKineticTraits_2<Traits>}, s);
    } else {
      throw Usage_error(
          "--nearest: nearest discs need not be neighbors in a regular triangulation; expected "
          "points, or discs of one size");
    }
  });
}

}  // namespace kinetri::app
