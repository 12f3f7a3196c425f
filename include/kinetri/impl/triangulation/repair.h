// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangulation of points that have moved, from that before, without certificates.
//
// After small steps most triangles are still counterclockwise. One of the corners of each that is
// not is taken out of the triangulation, so that the others have an embedded triangulation at their
// new positions; Lawson's flips make it Delaunay; then the points are inserted again. Points that
// are taken out and inserted again are the filter of P. de Castro, J. Cohen-Steiner, O. Devillers,
// Filtering relocations on a Delaunay triangulation, 2009, for whole triangles.
#ifndef KINETRI_IMPL_TRIANGULATION_REPAIR_H
#define KINETRI_IMPL_TRIANGULATION_REPAIR_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/kinetic/rounded_places.h"
#include "kinetri/impl/triangulation/event_reporter.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/topology.h"

namespace kinetri::detail {

/// Moves points of a triangulation without weights. Precondition: dimension 2; the triangulation is
/// Delaunay at the instant of its predicates.
///
/// Cost: O(n), O(log n) expected for each flip that is noted, and for each point that is taken out
/// what its removal and insertion cost.
template <class Traits>
class Kinetic_types<Traits>::Repair {
 public:
  /// `places` has the new positions of all points. Edges that change are noted by the reporter. The
  /// others must outlive this object.
  Repair(Topology& topology, Event_reporter& reporter, Rounded_places places)
      : topology_(topology),
        reporter_(reporter),
        triangulation_(topology.triangulation()),
        places_(std::move(places)) {
    if (places_.are_finite()) find_turned();
  }

  /// Whether the repair probably costs less than a construction: few triangles turn over.
  bool may_pay() const {
    return places_.are_finite() &&
           turned_.size() * points_for_each_removal <= topology_.number_of_vertices();
  }

  /// Gives the points their motions, and makes the triangulation Delaunay at the instant of its
  /// predicates. Returns false if it could not, or if points coincide: then all points have their
  /// motions, and the triangulation must be constructed anew; its finite edges are those noted.
  /// Precondition: may_pay().
  bool move(std::span<const Change> changes);

 private:
  static constexpr std::size_t points_for_each_removal = 12;

  struct Removed {
    Vertex_handle vertex;
    Vertex_handle neighbor;  // which it had
  };

  bool is_infinite(Vertex_handle v) const { return triangulation_.is_infinite(v); }
  static bool is_taken_out(Vertex_handle v) { return v->face() == Face_handle(); }
  bool is_certainly_left_turn(Face_handle face) const {
    return places_.orientation(face->vertex(0)->point().id(), face->vertex(1)->point().id(),
                               face->vertex(2)->point().id()) == CGAL::POSITIVE;
  }
  void find_turned();
  void find_turned_around();
  bool take_out_turned();
  void take_out(Vertex_handle v);
  bool put_back();
  void note(const Edge& edge, int change) { reporter_.note(Topology::ids_of(edge), change); }
  bool flip_hull(std::vector<Vertex_handle> suspects);
  std::vector<Vertex_handle> hull() const;
  bool is_hull_simple() const;
  bool flip_all();
  bool flip(std::vector<Edge>& suspects);
  bool is_violated(Face_handle face, int i) const;

  Topology& topology_;
  Event_reporter& reporter_;
  Triangulation& triangulation_;
  const Rounded_places places_;
  std::vector<Face_handle> turned_;    // finite triangles that may have turned over
  std::vector<Vertex_handle> around_;  // former neighbors of points taken out in this round
  std::vector<Removed> removed_;
  std::size_t flips_left_ = 0;
};

template <class Traits>
bool Kinetic_types<Traits>::Repair::move(std::span<const Change> changes) {
  const bool is_embedded = take_out_turned();
  for (const Change& change : changes) topology_.set_point(change);
  flips_left_ = 4 * triangulation_.tds().number_of_faces();
  return is_embedded && flip_hull(hull()) && is_hull_simple() && flip_all() && put_back();
}

// ---- points that are taken out ----

template <class Traits>
void Kinetic_types<Traits>::Repair::find_turned() {
  turned_.clear();
  for (const Face_handle face : triangulation_.finite_face_handles()) {
    if (!is_certainly_left_turn(face)) turned_.push_back(face);
  }
}

// The same of the triangles at neighbors of points that have been taken out.
template <class Traits>
void Kinetic_types<Traits>::Repair::find_turned_around() {
  turned_.clear();
  std::ranges::sort(around_);
  const auto again = std::ranges::unique(around_);
  around_.erase(again.begin(), again.end());
  for (const Vertex_handle v : around_) {
    if (is_taken_out(v)) continue;
    for_each_face_at(triangulation_, v, [&](Face_handle face) {
      if (!triangulation_.is_infinite(face) && !is_certainly_left_turn(face)) {
        turned_.push_back(face);
      }
    });
  }
  around_.clear();
  std::ranges::sort(turned_);
  const auto twice = std::ranges::unique(turned_);
  turned_.erase(twice.begin(), twice.end());
}

// Takes points out until all finite triangles are counterclockwise at the new positions. Returns
// false if these are too many. The points still have their old positions.
template <class Traits>
bool Kinetic_types<Traits>::Repair::take_out_turned() {
  const std::size_t most = topology_.number_of_vertices() / points_for_each_removal + 1;
  std::vector<std::uint32_t> counts(topology_.vertices().size());  // of turned triangles, by id
  std::vector<bool> is_chosen(counts.size());
  for (; !turned_.empty(); find_turned_around()) {
    std::vector<Vertex_handle> chosen;
    const auto id = [](Vertex_handle v) { return v->point().id(); };
    for (const Face_handle face : turned_) {
      for (int i = 0; i < 3; ++i) ++counts[id(face->vertex(i))];
    }
    for (const Face_handle face : turned_) {
      const std::array corners = {face->vertex(0), face->vertex(1), face->vertex(2)};
      if (std::ranges::any_of(corners, [&](Vertex_handle v) { return is_chosen[id(v)]; })) continue;
      chosen.push_back(
          *std::ranges::max_element(corners, {}, [&](Vertex_handle v) { return counts[id(v)]; }));
      is_chosen[id(chosen.back())] = true;
    }
    for (const Face_handle face : turned_) {
      for (int i = 0; i < 3; ++i) counts[id(face->vertex(i))] = 0;
    }
    if (removed_.size() + chosen.size() > most) return false;
    for (const Vertex_handle v : chosen) {
      if (triangulation_.test_dim_down(v)) return false;
      take_out(v);
    }
  }
  return true;
}

template <class Traits>
void Kinetic_types<Traits>::Repair::take_out(Vertex_handle v) {
  for_each_neighbor(triangulation_, v, [&](Vertex_handle u) { around_.push_back(u); });
  removed_.push_back({v, around_.back()});
  std::vector<Face_handle> faces;
  const auto edges = topology_.remove_from_faces(
      v, faces, [this](const Edge_ids& ids, int change) { reporter_.note(ids, change); });
  for (const Edge_with_mirror& edge : edges) Topology::set_event(edge, no_event);
  v->set_face(Face_handle());
}

// Inserts the points again. Returns false if one of them coincides with another.
template <class Traits>
bool Kinetic_types<Traits>::Repair::put_back() {
  for (auto removed = removed_.rbegin(); removed != removed_.rend(); ++removed) {
    const auto [v, neighbor] = *removed;
    const Face_handle start = neighbor->face();
    const Location location = topology_.locate(v->point(), start);
    const auto& [face, locus, i] = location;
    if (locus == Triangulation::VERTEX) return false;
    if (locus == Triangulation::EDGE) note(Edge(face, i), -1);
    const bool is_outside = triangulation_.is_infinite(face) && locus != Triangulation::EDGE;
    topology_.insert_in_faces(v, location);
    topology_.note_edges_at(
        v, 1, [this](const Edge_ids& ids, int change) { reporter_.note(ids, change); });
    if (is_outside) {
      std::vector<Vertex_handle> beside = {v};
      for_each_neighbor(triangulation_, v, [&](Vertex_handle u) { beside.push_back(u); });
      if (!flip_hull(std::move(beside))) return false;
    }
    std::vector<Edge> edges;
    for_each_face_at(triangulation_, v, [&](Face_handle f) {
      for (int k = 0; k < 3; ++k) edges.emplace_back(f, k);
    });
    if (!flip(edges)) return false;
  }
  return true;
}

// ---- the hull ----

template <class Traits>
auto Kinetic_types<Traits>::Repair::hull() const -> std::vector<Vertex_handle> {
  std::vector<Vertex_handle> result;
  for_each_neighbor(triangulation_, triangulation_.infinite_vertex(),
                    [&](Vertex_handle v) { result.push_back(v); });
  return result;
}

// Adds the edge between the hull neighbors of each reflex hull vertex. Returns false if three
// successive hull vertices fold back.
template <class Traits>
bool Kinetic_types<Traits>::Repair::flip_hull(std::vector<Vertex_handle> suspects) {
  const auto& now = triangulation_.geom_traits();
  const auto turn = now.orientation_2_object();
  const auto compare = now.compare_xy_2_object();
  while (!suspects.empty()) {
    const Vertex_handle v = suspects.back();
    suspects.pop_back();
    // The edge from v to infinity, if v is on the hull.
    std::optional<Edge> infinite;
    for_each_face_at(triangulation_, v, [&](Face_handle face, int i) {
      if (is_infinite(face->vertex(Triangulation::ccw(i)))) {
        infinite = Edge(face, Triangulation::cw(i));
      }
    });
    if (!infinite) continue;
    const auto [previous, here, next] = topology_.hull_turn(topology_.with_mirror(*infinite));
    if (previous == next) return false;
    const auto orientation = turn(previous->point(), here->point(), next->point());
    if (orientation == CGAL::LEFT_TURN) continue;
    if (orientation == CGAL::COLLINEAR) {
      if (compare(previous->point(), here->point()) != compare(here->point(), next->point())) {
        return false;
      }
      continue;
    }
    if (flips_left_-- == 0) return false;
    const auto& [face, i] = *infinite;
    triangulation_.tds().flip(face, i);
    reporter_.note(edge_ids(previous->point().id(), next->point().id()), 1);
    suspects.push_back(previous);
    suspects.push_back(next);
  }
  return true;
}

// Whether the hull, which makes no right turn, goes around once.
template <class Traits>
bool Kinetic_types<Traits>::Repair::is_hull_simple() const {
  const auto compare = triangulation_.geom_traits().compare_xy_2_object();
  const std::vector<Vertex_handle> around = hull();
  std::size_t least = 0;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const auto& here = around[k]->point();
    const auto& before = around[(k + around.size() - 1) % around.size()]->point();
    const auto& after = around[(k + 1) % around.size()]->point();
    if (compare(here, before) == CGAL::SMALLER && compare(here, after) == CGAL::SMALLER) ++least;
  }
  return least == 1;
}

// ---- edges inside ----

template <class Traits>
bool Kinetic_types<Traits>::Repair::is_violated(Face_handle face, int i) const {
  const Face_handle beyond = face->neighbor(i);
  if (triangulation_.is_infinite(face) || triangulation_.is_infinite(beyond)) return false;
  const Point_2& p = face->vertex(0)->point();
  const Point_2& q = face->vertex(1)->point();
  const Point_2& r = face->vertex(2)->point();
  const Point_2& s = beyond->vertex(triangulation_.tds().mirror_index(face, i))->point();
  const Sign known = places_.side_of_oriented_circle(p.id(), q.id(), r.id(), s.id());
  if (known != CGAL::ZERO) return known == CGAL::POSITIVE;
  return triangulation_.geom_traits().side_of_oriented_circle_2_object()(p, q, r, s) ==
         CGAL::ON_POSITIVE_SIDE;
}

// Flips edges until all are Delaunay. [Lawson 1977]
template <class Traits>
bool Kinetic_types<Traits>::Repair::flip_all() {
  std::vector<Edge> edges;
  for (const Face_handle face : triangulation_.finite_face_handles()) {
    for (int i = 0; i < 3; ++i) {
      if (!(face < face->neighbor(i))) continue;
      if (!is_violated(face, i)) continue;
      edges.emplace_back(face, i);
      if (!flip(edges)) return false;
    }
  }
  return true;
}

// Flips these edges, if they are violated, and those around them.
template <class Traits>
bool Kinetic_types<Traits>::Repair::flip(std::vector<Edge>& suspects) {
  while (!suspects.empty()) {
    const auto [face, i] = suspects.back();
    suspects.pop_back();
    if (!is_violated(face, i)) continue;
    if (flips_left_-- == 0) return false;
    const auto [beyond, j] = topology_.with_mirror(Edge(face, i)).there;
    note(Edge(face, i), -1);
    triangulation_.tds().flip(face, i);
    note(Edge(face, Triangulation::ccw(i)), 1);
    // The outer edges of the quadrilateral (Topology::flip).
    suspects.emplace_back(face, i);
    suspects.emplace_back(face, Triangulation::cw(i));
    suspects.emplace_back(beyond, j);
    suspects.emplace_back(beyond, Triangulation::cw(j));
  }
  return true;
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_REPAIR_H
