// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/motion_output.h"

#include "kinetri/io/motion_log.h"

namespace kinetri::app {

std::unique_ptr<Event_observer> follow_motions(std::ostream& out,
                                               const Any_simulation& simulation) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) {
    auto log =
        std::make_unique<Motion_log_writer<Traits>>(out, s.triangulation(), s.options().radius);
    s.add_observer(*log);
    return std::unique_ptr<Event_observer>(std::move(log));
  });
}

}  // namespace kinetri::app
