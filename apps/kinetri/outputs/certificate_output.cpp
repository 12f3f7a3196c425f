// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/certificate_output.h"

#include "kinetri/io/certificate_log.h"

namespace kinetri::app {

std::unique_ptr<Event_observer> follow_certificates(std::ostream& out,
                                                    const Any_simulation& simulation) {
  return simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) {
    auto log =
        std::make_unique<Certificate_log_writer<Traits>>(out, s.triangulation(), s.options());
    s.add_observer(*log);
    return std::unique_ptr<Event_observer>(std::move(log));
  });
}

}  // namespace kinetri::app
