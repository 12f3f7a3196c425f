// SPDX-License-Identifier: GPL-3.0-or-later
//
// The optimistic parallel execution of a simulation and its contacts. Defined in
// contact_events.cpp, for the library's own traits.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_RUNS_H
#define KINETRI_SRC_SIMULATION_CONTACT_RUNS_H

#include <cstddef>
#include <functional>

#include "kinetri/impl/triangulation/kinetic_core.h"
#include "simulation/simulation_core.h"

namespace kinetri::detail {

/// Uses the threads that the simulation may use.
template <class Traits>
struct Contact_runs {
  using Core = Simulation_core<Traits>;  ///< of the simulation

  /// Whether contacts can be executed in time windows; see Watched_contacts::can_run.
  static bool can_run(const Core& core);
  /// As advance_to of the simulation, with the same result; see Region_run::advance_to.
  static std::size_t advance_to(Core& core, const Algebraic_number& until,
                                const std::function<bool()>& may_go_on);
  /// Merges the shards of the queues.
  static void join(Core& core);
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_RUNS_H
