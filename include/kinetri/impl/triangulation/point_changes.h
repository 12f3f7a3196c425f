// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of points at the present time: new motions, insertions, erasures.
#ifndef KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_H
#define KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_H

#include <span>
#include <vector>

#include "kinetri/impl/triangulation/change_planner.h"
#include "kinetri/impl/triangulation/event_loop.h"
#include "kinetri/impl/triangulation/updates.h"

namespace kinetri::detail {

/// Makes changes of points, as Change_planner plans them. Edges that a change leaves violated fail
/// at the present time, and are flipped (docs/MATH.md, section 5).
template <class Traits>
class Kinetic_types<Traits>::Point_changes {
 public:
  /// The other parts must outlive this object.
  explicit Point_changes(Kinetic_core& core)
      : core_(core),
        topology_(core.topology),
        schedule_(core.schedule),
        reporter_(core.reporter),
        updates_(core.updates),
        loop_(core.loop),
        planner_(core.topology, core.certification, core.schedule, core.updates) {}

  /// Makes one change for each point, each an event of the given kind. Throws Precondition_error if
  /// a point is named twice, and what perform throws. Precondition: the points exist or are being
  /// inserted.
  void change_all(Event_kind kind, std::vector<Change> changes);

  /// Makes the changes and the necessary flips, and reports the events, then the changed edges.
  /// Points that would have one trajectory (and weight) become twins; if the topology refuses that,
  /// throws Coincident_trajectories_error before anything is reported or changed. Returns the
  /// changed edges. Precondition: each point is named once.
  Changed_edges perform(std::span<const Event> events, std::span<const Change> changes);

 private:
  using Jump = typename Change_planner::Jump;
  using Plan = typename Change_planner::Plan;
  using Joined = typename Change_planner::Joined;
  using Vertex_changes = typename Change_planner::Vertex_changes;

  void note_weights(const Vertex_changes& planned);
  void note_separated(const Vertex_changes& planned);
  Changed_edges set_twins(const Vertex_changes& planned);
  void make(Vertex_changes& planned);
  void move(Vertex_changes& planned);
  bool repair(std::span<const Change> changes);
  void set_point(const Change& change);
  void change_in_place(std::span<const Change> changes);
  bool take_out(std::span<const Jump> jumps);
  void put_in(std::span<const Jump> jumps, bool are_located);
  bool place(Vertex_handle v, const Location& location);

  Kinetic_core& core_;
  Topology& topology_;
  Schedule& schedule_;
  Event_reporter& reporter_;
  Updates& updates_;
  Event_loop& loop_;
  Change_planner planner_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_H
