// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of points at the present time, before they are made.
#ifndef KINETRI_IMPL_TRIANGULATION_CHANGE_PLANNER_H
#define KINETRI_IMPL_TRIANGULATION_CHANGE_PLANNER_H

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/updates.h"

namespace kinetri::detail {

/// Says which vertices and twins are changed by changes of points, and how. A point changes
/// *in place* if its triangles stay embedded, so that only certificates change; else it *jumps*: it
/// is removed from its triangles and inserted elsewhere. If many points change, all *move* at once
/// (Repair).
template <class Traits>
class Kinetic_types<Traits>::Change_planner {
 public:
  /// A point that jumps, is inserted or is erased.
  struct Jump {
    Change change;
    Location location = {};   ///< the new location, before any point jumps
    Vertex_handle near = {};  ///< a corner there that does not change, if any
  };
  /// How changes of vertices are made.
  struct Plan {
    std::vector<Change> in_place;
    std::vector<Jump> jumps;
    std::optional<Triangulation> rebuilt;  ///< if everything is rebuilt
    bool moves = false;                    ///< whether many points move at once
  };
  /// A point that becomes a twin.
  struct Joined {
    Point_2 point;
    Point_id shown;  ///< the point that hides it
  };
  /// Changes of vertices and twins, to which changes of points lead.
  struct Vertex_changes {
    std::span<const Change> changes;  ///< those of the points, or in `storage`
    std::vector<Change> storage;
    Plan plan;
    std::vector<Point_id> separated;  ///< twins that change, or are erased
    std::vector<Point_id> heirs;      ///< twins that replace the point that hid them
    std::vector<Joined> joined;       ///< points that become twins
  };

  /// The other parts must outlive this object.
  Change_planner(Topology& topology, const Certification& certification, const Schedule& schedule,
                 const Updates& updates)
      : topology_(topology),
        certification_(certification),
        schedule_(schedule),
        updates_(updates),
        triangulation_(topology.triangulation()) {}

  /// The plan of the changes, which must outlive it. Points that would have one trajectory (and
  /// weight) become twins; throws Coincident_trajectories_error if the topology refuses that.
  /// Meanwhile vertices have other points. Precondition: each point is named once.
  Vertex_changes plan(std::span<const Change> changes);
  /// Whether so many points change in place that all certificates are recomputed.
  bool should_schedule_all(std::size_t points) const;

 private:
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
  bool is_embedded_around(Vertex_handle v) const;

  Topology& topology_;
  const Certification& certification_;
  const Schedule& schedule_;
  const Updates& updates_;
  const Triangulation& triangulation_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_CHANGE_PLANNER_H
