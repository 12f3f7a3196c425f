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

/// A snapshot of Simulation_2. The contacts to come are not part of it: they follow from the
/// motions.
template <KineticTraits_2 Traits>
struct Simulation_snapshot {
  using Motion = typename Traits::Motion;  ///< of the traits
  using Time = typename Traits::Time;      ///< of the traits

  /// A change of a point that was scheduled and has not been made.
  struct Change {
    Time time;                                    ///< when it is to be made
    Event_kind kind = Event_kind::trajectory;     ///< insert, erase or trajectory
    Point_id point = no_point;                    ///< of insert, the one that it will have
    std::optional<Motion> motion = std::nullopt;  ///< none for erase
  };

  Triangulation_snapshot<Traits> triangulation;  ///< of the triangulation that it owns
  Simulation_options options;                    ///< without the response
  bool has_response = false;                     ///< whether there was one
  std::vector<Edge_ids> in_contact;   ///< discs that a response has left in contact; sorted
  std::vector<Change> scheduled;      ///< in the order in which they were scheduled
  Contact_counters counters;          ///< but for those of the queue
  Certificate_counters certificates;  ///< of contacts
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_SIMULATION_SNAPSHOT_H
