// SPDX-License-Identifier: GPL-3.0-or-later
//
// Observers of the overlaps of the discs of a simulation.
#ifndef KINETRI_SIMULATION_OVERLAP_OBSERVER_H
#define KINETRI_SIMULATION_OVERLAP_OBSERVER_H

#include <span>

#include "kinetri/base/ids.h"

namespace kinetri {

/// Is called after points of a simulation have changed and their overlaps have been updated. An
/// overlap begins with a contact, which is an event, or with such a change.
class Overlap_observer {
 public:
  virtual ~Overlap_observer() = default;

  /// The points, sorted, have got other motions or have been inserted or erased, at the current
  /// time. All events of the change have been reported, and Simulation_2::overlapping_discs is up
  /// to date. May read the simulation; functions that change it throw Precondition_error.
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
