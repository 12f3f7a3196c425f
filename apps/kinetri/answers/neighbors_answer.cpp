// SPDX-License-Identifier: GPL-3.0-or-later
#include "answers/table_answer.h"

namespace kinetri::app {

std::unique_ptr<Answer> neighbors_answer(const Answer_settings& settings,
                                         const Any_simulation& simulation,
                                         const Run_source& source) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    return table_answer<Neighbor_lives<Traits>>(
        source,
        detail::Neighbor_life_columns{settings.ridge.has_value(), PeriodicKineticTraits_2<Traits>},
        s, settings.ridge);
  });
}

std::unique_ptr<Answer> exchanges_answer(const Answer_settings& settings,
                                         const Any_simulation& simulation,
                                         const Run_source& source) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    return table_answer<Neighbor_lives<Traits>>(
        source, detail::Exchange_columns{settings.ridge.has_value()}, s, settings.ridge);
  });
}

}  // namespace kinetri::app
