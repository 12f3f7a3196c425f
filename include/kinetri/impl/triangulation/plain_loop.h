// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plain loop of a triangulation whose queue may be in parts, for a simulation that owns it.
#ifndef KINETRI_IMPL_TRIANGULATION_PLAIN_LOOP_H
#define KINETRI_IMPL_TRIANGULATION_PLAIN_LOOP_H

#include <cstddef>

#include "kinetri/base/ids.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri::detail {

/// What a simulation has its triangulation do, event by event. A run by regions has left the queue
/// in parts, and these functions leave it so.
template <class KineticTriangulation>
class Plain_loop {
 public:
  using Time = typename KineticTriangulation::Time;  ///< of events

  /// As step(*until), or as step() if `until` is null.
  static std::size_t step(KineticTriangulation& kinetic, const Time* until) {
    return kinetic.step_in_parts(until);
  }
  /// As advance_to(time).
  static void run_to(KineticTriangulation& kinetic, const Time& time) {
    kinetic.run_to(time, nullptr);
  }
  /// Throws Precondition_error if an observer has thrown, and left the triangulation in an event.
  static void check_may_change(const KineticTriangulation& kinetic) { kinetic.check_may_change(); }
  /// As reserve_id(), also within an event.
  static Point_id give_id(KineticTriangulation& kinetic) { return kinetic.give_id(); }
  /// Puts the queue into one part again.
  static void join(KineticTriangulation& kinetic) { kinetic.join_parts(); }
  /// How vertices belong to regions.
  static const Region_division& division(const KineticTriangulation& kinetic) {
    return kinetic.division_;
  }
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_PLAIN_LOOP_H
