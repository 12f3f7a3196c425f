// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of points at the present time: new motions, insertions, erasures.
#ifndef KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_H
#define KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_H

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/event_loop.h"
#include "kinetri/impl/triangulation/updates.h"

namespace kinetri::detail {

/// Plans and makes changes of points. A point changes *in place* if its triangles stay embedded, so
/// that only certificates change; else it *jumps*: it is removed from its triangles and inserted
/// elsewhere. Edges that a change leaves violated fail at the present time, and are flipped
/// (docs/MATH.md, section 5). If many points change, and few triangles turn over, all *move* at
/// once (Repair).
template <class Traits>
class Kinetic_types<Traits>::Point_changes {
 public:
  /// The other parts must outlive this object.
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
  /// a point is named twice, and what perform throws. Precondition: the points exist or are being
  /// inserted.
  void change_all(Event_kind kind, std::vector<Change> changes);

  /// Makes the changes and the necessary flips, and reports the events, then the changed edges.
  /// Points that would have one trajectory (and weight) become twins; if the topology refuses that,
  /// throws Coincident_trajectories_error before anything is reported or changed. Returns the
  /// changed edges. Precondition: each point is named once.
  Changed_edges perform(std::span<const Event> events, std::span<const Change> changes);

 private:
  /// A point that jumps, is inserted or is erased.
  struct Jump {
    Change change;
    Location location = {};   // the new location, before any point jumps
    Vertex_handle near = {};  // a corner there that does not change, if any
  };
  /// How changes of points are made.
  struct Plan {
    std::vector<Change> in_place;
    std::vector<Jump> jumps;
    std::optional<Triangulation> rebuilt;  // if everything is rebuilt
    bool moves = false;                    // whether many points move at once
  };

  struct Joined {
    Point_2 point;
    Point_id shown;
  };
  /// Changes of vertices and twins, to which changes of points lead.
  struct Vertex_changes {
    std::span<const Change> changes;  // those of the points, or in `storage`
    std::vector<Change> storage;
    Plan plan;
    std::vector<Point_id> separated;  // twins that change, or are erased
    std::vector<Point_id> heirs;      // twins that replace the point that hid them
    std::vector<Joined> joined;       // points that become twins
  };

  Vertex_changes plan(std::span<const Change> changes);
  void separate_twins(Vertex_changes& planned) const;
  void join_twins(std::span<const Edge_ids> coincident, Vertex_changes& planned) const;
  Plan plan_vertices(std::span<const Change> changes, std::vector<Edge_ids>& coincident);
  bool move_at_once(std::span<const Change> changes) const;
  void find_changes_in_place(std::span<const Change> changes, Plan& plan);
  void find_coincident_in_place(std::span<const Change> changes, std::span<const Change> in_place,
                                std::vector<Edge_ids>& coincident) const;
  void sort_jumps(std::span<const Change> changes, std::vector<Jump>& jumps,
                  std::vector<Edge_ids>& coincident) const;
  void locate_jumps(std::span<const Change> changes, std::span<Jump> jumps,
                    std::vector<Edge_ids>& coincident) const;
  std::vector<Point_2> points_after(std::span<const Change> changes) const;
  bool should_schedule_all(std::size_t points) const;
  bool is_embedded_around(Vertex_handle v) const;

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
  const Certification& certification_;
  Schedule& schedule_;
  Event_reporter& reporter_;
  Updates& updates_;
  Event_loop& loop_;
  Triangulation& triangulation_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_H
