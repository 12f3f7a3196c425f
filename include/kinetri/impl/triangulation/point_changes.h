// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of points at the present time: other motions, points that come, points that go.
#ifndef KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_H
#define KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_H

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/event_loop.h"
#include "kinetri/impl/triangulation/updates.h"

namespace kinetri::detail {

/// Plans changes of points, and makes them. A point *turns* if its triangles stay embedded, so that
/// only certificates change; else it *jumps*: it leaves its triangles, and comes elsewhere. The
/// edges that a change leaves violated have their events at the present time, and are flipped by
/// these (docs/MATH.md, section 5).
template <class Traits>
class Kinetic_types<Traits>::Point_changes {
 public:
  /// Of the triangulation with these other parts, which must outlive this object.
  explicit Point_changes(Kinetic_core& core)
      : core_(core),
        topology_(core.topology),
        certification_(core.certification),
        schedule_(core.schedule),
        reporter_(core.reporter),
        updates_(core.updates),
        loop_(core.loop),
        triangulation_(core.topology.triangulation()) {}

  /// Makes one change for each point, each an event of the given kind. Throws Precondition_error if
  /// a point is named twice, else what perform throws. Precondition: the points are there, or come.
  void change_all(Event_kind kind, std::vector<Change> changes);

  /// Makes the changes and the flips that they make necessary, and reports the events, then the
  /// edges that have changed. Throws Coincident_trajectories_error, before anything is reported or
  /// changed, if two points would have one trajectory (and weight). Returns the edges that have
  /// changed. Precondition: each point is named once.
  Changed_edges perform(std::span<const Event> events, std::span<const Change> changes);

 private:
  /// A point that leaves its triangles, comes or goes.
  struct Jump {
    Change change;
    Location location = {};   // where it comes, in the triangulation before any point jumps
    Vertex_handle near = {};  // a corner there that does not change, if there is one
  };
  /// How changes of points are made.
  struct Plan {
    std::vector<Change> turns;
    std::vector<Jump> jumps;
    std::optional<Triangulation> rebuilt;  // if all of it is built anew
  };

  Plan plan(std::span<const Change> changes);
  void find_turns(std::span<const Change> changes, Plan& plan);
  void check_turns_are_new(std::span<const Change> changes, std::span<const Change> turns) const;
  void check_are_distinct(std::span<const Change> changes, std::vector<Jump>& jumps) const;
  void locate_jumps(std::span<const Change> changes, std::span<Jump> jumps) const;
  std::vector<Point_2> points_after(std::span<const Change> changes) const;
  bool are_most(std::size_t points) const;
  bool is_embedded_around(Vertex_handle v) const;

  void note_weights(std::span<const Change> changes);
  void make(std::span<const Change> changes, Plan& plan);
  void make_turns(std::span<const Change> turns);
  bool make_jumps(std::span<const Jump> jumps, bool are_located);
  bool place(Vertex_handle v, const Location& location);

  Kinetic_core& core_;
  Topology& topology_;
  const Certification& certification_;
  Schedule& schedule_;
  Event_reporter& reporter_;
  Updates& updates_;
  Event_loop& loop_;
  Triangulation& triangulation_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_H
