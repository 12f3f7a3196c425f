// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who follows the overlaps of the discs of a simulation.
#ifndef KINETRI_SIMULATION_OVERLAP_OBSERVER_H
#define KINETRI_SIMULATION_OVERLAP_OBSERVER_H

#include <span>

#include "kinetri/base/ids.h"

namespace kinetri {

/// Is told when points of a simulation have changed and it knows their overlaps again. An overlap
/// begins with a contact, which is an event, or with such a change.
class Overlap_observer {
 public:
  virtual ~Overlap_observer() = default;

  /// The points, which are sorted, have got other motions, have come or have gone, at the current
  /// time. All events of the change have been reported, and Simulation_2::overlapping_discs answers
  /// for it. May look at the simulation, but not change it: functions that do throw
  /// Precondition_error.
  virtual void after_change(std::span<const Point_id> points) = 0;

 protected:
  Overlap_observer() = default;
  /// @{
  /// For the copies of derived classes.
  Overlap_observer(const Overlap_observer&) = default;
  Overlap_observer& operator=(const Overlap_observer&) = default;
  /// @}
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_OVERLAP_OBSERVER_H
