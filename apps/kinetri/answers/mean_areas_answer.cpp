// SPDX-License-Identifier: GPL-3.0-or-later
#include "answers/table_answer.h"

namespace kinetri::app {

std::unique_ptr<Answer> mean_areas_answer(const Answer_settings& settings,
                                          const Any_simulation& simulation,
                                          const Run_source& source) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    return table_answer<Mean_cell_areas<Traits>>(source, detail::Mean_area_columns(), s,
                                                 *settings.limits);
  });
}

}  // namespace kinetri::app
