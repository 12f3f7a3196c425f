// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state of a simulation between two instants, as plain values.
#ifndef KINETRI_SIMULATION_SIMULATION_SNAPSHOT_H
#define KINETRI_SIMULATION_SIMULATION_SNAPSHOT_H

#include <optional>
#include <vector>

#include "kinetri/events/event.h"
#include "kinetri/simulation/simulation_options.h"
#include "kinetri/triangulation/triangulation_snapshot.h"

namespace kinetri {

/// A snapshot of Simulation_2. It does not include future contacts, because the motions determine
/// them.
template <KineticTraits_2 Traits>
struct Simulation_snapshot {
  using Motion = typename Traits::Motion;  ///< of the traits
  using Time = Algebraic_number;           ///< of events

  /// A scheduled change of a point that is still to be made.
  struct Change {
    Time time;                                    ///< time of the change
    Event_kind kind = Event_kind::trajectory;     ///< insert, erase or trajectory
    Point_id point = no_point;                    ///< the point; for insert, its future id
    std::optional<Motion> motion = std::nullopt;  ///< the new motion; none for erase
  };

  Triangulation_snapshot<Traits> triangulation;  ///< of the simulation's triangulation
  Simulation_options options;                    ///< without the response
  bool has_response = false;                     ///< whether there was one
  std::vector<Edge_ids> in_contact;  ///< pairs of discs that a response has left in contact; sorted
  std::vector<Change> scheduled;     ///< in the order of the calls that scheduled them
  Contact_counters counters;         ///< without the counters of the queue
  Certificate_counters certificates;  ///< of contacts
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_SIMULATION_SNAPSHOT_H
