// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>

#include "answers/answer.h"
#include "io/text.h"
#include "kinetri/observers/mean_cell_areas.h"
#include "outputs/area_output.h"

namespace kinetri::app {
namespace {

template <class Traits>
class Mean_areas_answer : public Answer {
 public:
  Mean_areas_answer(Simulation_2<Traits>& simulation, const Answer_settings& settings)
      : means_(simulation, cell_limits(settings)) {}

  void write(std::ostream& out) override {
    out << "id,from,until,area,error\n";
    for (const auto& [id, from, until, area, error] : means_.means()) {
      out << joined(id, ",", from, ",", until, ",", area, ",", error, "\n");
    }
  }

 private:
  Mean_cell_areas<Traits> means_;
};

}  // namespace

std::unique_ptr<Answer> mean_areas_answer(const Answer_settings& settings,
                                          const Any_simulation& simulation,
                                          const Run_source& /*source*/) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) -> std::unique_ptr<Answer> {
    return std::make_unique<Mean_areas_answer<Traits>>(s, settings);
  });
}

}  // namespace kinetri::app
