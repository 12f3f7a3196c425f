// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/generated_source.h"

namespace kinetri::app {

Any_simulation Generated_source::make_simulation(Arithmetic arithmetic) const {
  return std::make_unique<Simulation_2<>>(run_.motions, run_.options, from(),
                                          Linear_kinetic_traits_2(arithmetic));
}

}  // namespace kinetri::app
