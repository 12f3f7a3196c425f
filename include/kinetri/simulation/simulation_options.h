// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a simulation is made with, and what it counts.
#ifndef KINETRI_SIMULATION_SIMULATION_OPTIONS_H
#define KINETRI_SIMULATION_SIMULATION_OPTIONS_H

#include <cstdint>
#include <optional>

#include "kinetri/events/indexed_queue.h"
#include "kinetri/simulation/box_2.h"
#include "kinetri/simulation/collision_response.h"

namespace kinetri {

/// The box and the discs of a simulation. Without any, points go their ways freely.
struct Simulation_options {
  /// A point that reaches a side while it moves outward is reflected: the component of its velocity
  /// changes sign, exactly.
  std::optional<Box_2> box = std::nullopt;
  /// What touches the box: the centre of a disc, or its rim.
  bool rim_touches = false;
  /// Of every disc, in the unit of the coordinates. Discs of different radii are not supported: two
  /// of them may touch without being neighbors in the Delaunay triangulation; that takes a weighted
  /// one.
  double radius = 0;
  /// What discs do that touch; empty: nothing, and contacts are not looked for.
  Collision_response response = nullptr;
  /// The most contacts, of all points together, at one time.
  std::uint64_t contacts_at_one_time = 1'000'000;
};

/// Counts of what became of contacts; events count those that happened.
struct Contact_counters {
  Queue_counters queue;                    ///< of contacts and scheduled changes
  std::uint64_t discarded_walls = 0;       ///< contacts found that did not happen, as the point
  std::uint64_t discarded_collisions = 0;  ///< or its neighbor turned, or the edge went
  std::uint64_t instants = 0;              ///< times with contacts and without other events
  std::uint64_t most_at_one_time = 0;      ///< contacts
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_SIMULATION_OPTIONS_H
