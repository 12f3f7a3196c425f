// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state of a kinetic triangulation between two events, as plain values: what decides its future
// and nothing else, so that it can be kept, sent and read back.
#ifndef KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H
#define KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H

#include <optional>
#include <vector>

#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/triangulation/triangulation_counters.h"

namespace kinetri {

/// A snapshot of Kinetic_triangulation_2: the points, and the time. They determine the
/// triangulation, also if points are cocircular (docs/MATH.md, section 4). The queue is not part
/// of it, since when a certificate fails does not depend on when that was found.
template <KineticTraits_2 Traits>
struct Triangulation_snapshot {
  using Motion = typename Traits::Motion;  ///< of the traits
  using Time = Algebraic_number;           ///< of events

  Time time = {};                              ///< the state is the one just after it
  std::vector<std::optional<Motion>> motions;  ///< by point id; none of a point that is not there
  Triangulation_counters counters;             ///< so far
  Certificate_counters certificates;           ///< so far
};

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H
