// SPDX-License-Identifier: GPL-3.0-or-later
#include "answers/table_answer.h"
#include "cli/arguments.h"

namespace kinetri::app {

std::unique_ptr<Answer> spanning_tree_answer(const Answer_settings& /*settings*/,
                                             const Any_simulation& simulation,
                                             const Run_source& source) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    if constexpr (!HasWeight<typename Traits::Motion>) {
      return table_answer<detail::Spanning_tree_rows<Traits>>(
          source, detail::Spanning_tree_columns{PeriodicKineticTraits_2<Traits>}, s);
    } else {
      throw Usage_error(
          "--spanning-tree: a regular triangulation of discs need not contain the spanning tree of "
          "their centers; expected points, or discs of one size");
    }
  });
}

}  // namespace kinetri::app
