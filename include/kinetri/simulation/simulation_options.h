// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options and counters of a simulation.
#ifndef KINETRI_SIMULATION_SIMULATION_OPTIONS_H
#define KINETRI_SIMULATION_SIMULATION_OPTIONS_H

#include <cstdint>
#include <optional>
#include <vector>

#include "kinetri/impl/events/indexed_queue.h"
#include "kinetri/simulation/box_2.h"
#include "kinetri/simulation/collision_response.h"
#include "kinetri/triangulation/coincident_points.h"

namespace kinetri {

namespace detail {
/// What is wrong with discs that collide and have no radius.
inline constexpr const char* zero_radius_message =
    "the radius is 0, and such discs never touch; expected a radius greater than 0";
}  // namespace detail

/// The box and the discs of a simulation. By default there are none, and points move freely.
struct Simulation_options {
  /// If set, a point that reaches a side of the box while moving outward is reflected: the
  /// component of its velocity normal to that side changes sign, exactly.
  std::optional<Box_2> box = std::nullopt;
  /// Whether the boundary circle of a disc touches the box, instead of its center.
  bool rim_touches = false;
  /// The radius of every disc, in the unit of the coordinates. It is 0 if motions have radii, such
  /// as Disc_motion_2: these may differ and grow.
  double radius = 0;
  /// The response to contacts of discs. If empty, no contacts are computed.
  Collision_response response = nullptr;
  /// Whether the response depends on its argument only, and may be called by several threads at
  /// once, also for contacts that are rolled back. Then several threads (Simulation_2::set_threads)
  /// execute contacts too. Built-in responses need not be declared. Contacts at which both discs
  /// keep their motions, or a disc is erased, cost much more on several threads: with many of them
  /// one thread is faster.
  bool response_is_pure = false;
  /// Whether discs that overlap at the start, or when one is inserted, are refused; touching is
  /// allowed. For responses that assume discs without overlaps, such as elastic collisions.
  bool refuses_overlaps = false;
  /// What happens to points with the same trajectory and, if they have radii, the same radius.
  Coincident_points coincident = Coincident_points::hide;
  /// The masses by point id, each positive and finite: one for each point at the start, or none.
  /// Points without one have the mass 1.
  std::vector<double> masses = {};
  /// The greatest number of contacts at one time that change points; if none is given, 10 000 plus
  /// 100 for each point. Contacts at which both discs keep their motions do not count: there is at
  /// most one for each pair.
  std::optional<std::uint64_t> max_contacts_per_instant = std::nullopt;
};

/// Counters of contacts. Those that happened are counted as events (Triangulation_counters).
struct Contact_counters {
  Queue_counters queue;                    ///< of contacts and scheduled changes
  std::uint64_t discarded_walls = 0;       ///< discarded because the point got a new motion
  std::uint64_t discarded_collisions = 0;  ///< the same for either point; or the edge was removed
  std::uint64_t instants = 0;              ///< times with contacts or changes, but without failures
  std::uint64_t most_at_one_time = 0;      ///< greatest number of contacts at one time
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_SIMULATION_OPTIONS_H
