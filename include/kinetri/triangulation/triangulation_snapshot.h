// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state of a kinetic triangulation between two events, as plain values.
#ifndef KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H
#define KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H

#include <optional>
#include <vector>

#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/triangulation/triangulation_counters.h"

namespace kinetri {

/// A snapshot of Kinetic_triangulation_2: the points, and the time; not the traits, nor the
/// periodic box that these may have. They determine the triangulation, even if points are
/// cocircular (docs/MATH.md, section 4), and the queue, since failure times do not depend on when
/// they were computed.
template <KineticTraits_2 Traits>
struct Triangulation_snapshot {
  using Motion = typename Traits::Motion;  ///< of the traits
  using Time = Algebraic_number;           ///< of events

  Time time = {};                              ///< the state is the one just after it
  std::vector<std::optional<Motion>> motions;  ///< by point id; none for an erased point
  Triangulation_counters counters;             ///< so far
  Certificate_counters certificates;           ///< so far
};

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H
