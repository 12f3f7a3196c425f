// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangulation of a torus of points that have moved, from that before, without certificates.
//
// Points whose triangles turn over stay behind where they were, until all triangles turn left.
// Lawson's flips make these Delaunay. Then the points that stayed are taken out and inserted where
// they belong, which is the filter of P. M. M. de Castro, J. Tournois, P. Alliez, O. Devillers,
// Filtering relocations on a Delaunay triangulation, Computer Graphics Forum 28(5), 2009.
// docs/MATH.md, section 18, proves that the result is the Delaunay triangulation.
#ifndef KINETRI_SRC_TRIANGULATION_TORUS_REPAIR_H
#define KINETRI_SRC_TRIANGULATION_TORUS_REPAIR_H

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/incident.h"
#include "triangulation/face_journal.h"

namespace kinetri::detail {

/// Moves points in a periodic box. Precondition: there are points; the triangulation is Delaunay at
/// the instant of its predicates. Cost: O(n), O(1) for each flip, and for each point that stays
/// behind what its removal and insertion cost.
template <class Traits>
class Kinetic_types<Traits>::Torus_repair {
 public:
  /// The others must outlive this object.
  Torus_repair(Topology& topology, Schedule& schedule, Event_reporter& reporter, Updates& updates)
      : topology_(topology),
        schedule_(schedule),
        reporter_(reporter),
        updates_(updates),
        triangulation_(topology.triangulation()) {}

  /// As Repair::move. Certificates are deferred.
  bool move(std::span<const Change> changes) {
    schedule_.defer();
    changes_ = changes;
    before_.reserve(changes.size());
    for (const Change& change : changes) {
      before_.push_back(topology_.vertex(change.point)->point());
      topology_.set_point(change);
    }
    const bool is_moved = leave_behind() && (restore_delaunay(), catch_up());
    for (const std::size_t i : behind_) topology_.set_point(changes_[i]);
    return is_moved;
  }

 private:
  // If more points stay behind, a construction costs less.
  static constexpr std::size_t points_for_each_behind = 12;

  bool is_left_turn(Face_handle face) const {
    return triangulation_.orientation(face) == CGAL::LEFT_TURN;
  }

  // Sets points back until all triangles turn left, as all did before. Returns false if these are
  // too many.
  bool leave_behind() {
    std::vector<bool> is_behind(changes_.size(), false);
    std::vector<Face_handle> faces = topology_.faces();
    while (!faces.empty()) {
      const Face_handle face = faces.back();
      if (is_left_turn(face)) {
        faces.pop_back();
        continue;
      }
      std::size_t next = changes_.size();
      for (int i = 0; i < 3 && next == changes_.size(); ++i) {
        const std::size_t change = change_of(face->vertex(i));
        if (change < changes_.size() && !is_behind[change]) next = change;
      }
      KINETRI_ASSERT(next < changes_.size(), "all triangles turned left before");
      if (points_for_each_behind * (behind_.size() + 1) > topology_.number_of_vertices()) {
        return false;
      }
      is_behind[next] = true;
      behind_.push_back(next);
      const Vertex_handle v = topology_.vertex(changes_[next].point);
      v->set_point(before_[next]);
      for_each_face_at(triangulation_, v, [&](Face_handle at) { faces.push_back(at); });
    }
    return true;
  }

  // The position of the vertex among the changes, which are sorted; their number, if there is none.
  std::size_t change_of(Vertex_handle v) const {
    const Point_id id = v->point().id();
    const auto found = std::ranges::lower_bound(changes_, id, {}, &Change::point);
    return static_cast<std::size_t>(
        (found != changes_.end() && found->point == id ? found : changes_.end()) -
        changes_.begin());
  }

  // [Lawson 1977]
  void restore_delaunay() {
    std::vector<Edge> edges;
    edges.reserve(3 * topology_.number_of_vertices());
    for (const Face_handle face : topology_.faces()) {
      topology_.for_each_own_edge(face, [&](const Edge& edge) { edges.push_back(edge); });
    }
    while (!edges.empty()) {
      const Edge edge = edges.back();
      edges.pop_back();
      if (!triangulation_.is_violated(edge)) continue;
      reporter_.note(Topology::name_of(edge), -1);
      const Edge added = triangulation_.flip(edge);
      reporter_.note(Topology::name_of(added), 1);
      for (const Edge_with_mirror& side : topology_.outer_edges(topology_.with_mirror(added))) {
        edges.push_back(side.here);
      }
    }
  }

  // Moves the points that have stayed behind. Returns false if one coincides with another, or
  // cannot be taken out.
  bool catch_up() {
    while (!behind_.empty()) {
      const Change& change = changes_[behind_.back()];
      const Vertex_handle v = topology_.vertex(change.point);
      const Vertex_handle neighbor = v->face()->vertex(Triangulation::ccw(v->face()->index(v)));
      if (!topology_.can_take_out(v) || !updates_.take_out(v)) return false;
      topology_.set_point(change);
      behind_.pop_back();
      const Location there =
          topology_.locate(v->point(), neighbor == v ? Face_handle() : neighbor->face());
      if (there.locus == Triangulation::VERTEX) return false;
      updates_.put_in(v, there);
    }
    return true;
  }

  Topology& topology_;
  Schedule& schedule_;
  Event_reporter& reporter_;
  Updates& updates_;
  Triangulation& triangulation_;
  std::span<const Change> changes_;
  std::vector<Point_2> before_;      // the points of the changes
  std::vector<std::size_t> behind_;  // the changes of points that have been set back
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_TORUS_REPAIR_H
