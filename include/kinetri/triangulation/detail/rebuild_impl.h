// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_delaunay_triangulation_2: instants that flips alone do not pass, because
// points coincide or the hull goes flat.
#ifndef KINETRI_TRIANGULATION_DETAIL_REBUILD_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_REBUILD_IMPL_H

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

// Takes the points that coincide now out of the triangulation, but for one in each place, as it was
// just before: all else that happens now happens to distinct points. Points that come together
// share edges just before, so that each place's points are connected by edges whose ends coincide;
// these are first in the queue.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::set_coincident_points_aside() {
  rebuilt_edges_.emplace();
  // By point, one that is nearer to the least id in its place, or that one itself.
  std::map<Point_id, Point_id> parents;
  const auto least = [&parents](Point_id id) {
    while (parents.at(id) != id) id = parents.at(id);
    return id;
  };
  while (settle(current_time_) && queue_.top().kind == Entry_kind::coincidence) {
    const Edge edge = pop_entry().edge();
    set_event(two_sided(edge), no_event);
    const auto [a, b] = ids_of(edge);
    parents.emplace(a, a);
    parents.emplace(b, b);
    const std::array<Point_id, 2> merged = edge_ids(least(a), least(b));
    parents[merged[1]] = merged[0];
  }
  if (triangulation_.dimension() < 2) return rebuild();
  triangulation_.geom_traits().set_instant({current_time_, Side::before});
  for (const auto& [id, parent] : parents) {
    if (id == parent) continue;
    if (triangulation_.test_dim_down(vertices_[id])) return rebuild();
    set_aside(id, vertices_[least(id)]);
  }
  triangulation_.geom_traits().set_instant({current_time_, Side::after});
}

// Takes the point `id` out of the triangulation, which stays Delaunay at the instant of its traits.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::set_aside(Point_id id, Vertex_handle companion) {
  const Vertex_handle v = vertices_[id];
  std::vector<Vertex_handle> around;
  auto face = triangulation_.incident_faces(v);
  const auto first = face;
  do {
    unschedule_face(face);
    const Vertex_handle u = face->vertex(Triangulation::ccw(face->index(v)));
    if (!triangulation_.is_infinite(u)) around.push_back(u);
  } while (++face != first);
  std::ranges::sort(around, {}, [](Vertex_handle u) { return u->point().id(); });

  for (const Vertex_handle u : around) --(*rebuilt_edges_)[edge_ids(id, u->point().id())];
  note_edges_among(around, -1);
  points_set_aside_.push_back({v->point(), companion});
  vertices_[id] = Vertex_handle();
  triangulation_.remove(v);
  ++counters_.points_set_aside;
  note_edges_among(around, 1);
  for (const Vertex_handle u : around) schedule_around(u);
}

// Puts the points that were set aside back where they are just after now: each splits the triangle
// or edge that it is in, and what then violates its certificate is flipped like any other edge, by
// Lawson's argument until the triangulation is Delaunay.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::put_points_back() {
  using Locus = typename Triangulation::Locate_type;
  while (!points_set_aside_.empty()) {
    const auto [point, companion] = points_set_aside_.back();
    points_set_aside_.pop_back();
    Locus locus;
    int i = 0;
    const Face_handle face = triangulation_.locate(point, locus, i, companion->face());
    if (locus == Triangulation::VERTEX) {
      const Point_id other = face->vertex(i)->point().id();
      throw Coincident_trajectories_error(std::min(point.id(), other), std::max(point.id(), other));
    }
    const bool is_on_edge = locus == Triangulation::EDGE;
    unschedule_face(face);
    if (is_on_edge) {
      unschedule_face(face->neighbor(i));
      --(*rebuilt_edges_)[ids_of(Edge(face, i))];
    }
    const Vertex_handle v = is_on_edge ? triangulation_.tds().insert_in_edge(face, i)
                                       : triangulation_.tds().insert_in_face(face);
    v->set_point(point);
    vertices_[point.id()] = v;
    auto neighbor = triangulation_.incident_vertices(v);
    const auto first = neighbor;
    do {
      if (triangulation_.is_infinite(neighbor)) continue;
      ++(*rebuilt_edges_)[edge_ids(point.id(), neighbor->point().id())];
    } while (++neighbor != first);
    schedule_around(v);
    execute_due_events();
  }
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::unschedule_face(Face_handle face) {
  for (int i = 0; i < 3; ++i) {
    const Two_sided_edge edge = two_sided(Edge(face, i));
    unschedule(edge);
    set_event(edge, no_event);
  }
}

// Schedules those edges of the faces at `v` that have no event.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule_around(Vertex_handle v) {
  auto face = triangulation_.incident_faces(v);
  const auto first = face;
  do {
    for (int i = 0; i < 3; ++i) {
      if (face->event(i) == no_event) schedule(two_sided(Edge(face, i)), current_time_);
    }
  } while (++face != first);
}

// Notes the edges that have both ends in `vertices`, which are sorted by id, as added or removed.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::note_edges_among(
    const std::vector<Vertex_handle>& vertices, int change) {
  const auto id = [](Vertex_handle v) { return v->point().id(); };
  for (const Vertex_handle v : vertices) {
    auto neighbor = triangulation_.incident_vertices(v);
    const auto first = neighbor;
    do {
      if (triangulation_.is_infinite(neighbor) || id(neighbor) < id(v)) continue;
      if (std::ranges::binary_search(vertices, id(neighbor), {}, id)) {
        (*rebuilt_edges_)[edge_ids(id(v), id(neighbor))] += change;
      }
    } while (++neighbor != first);
  }
}

// Reconstructs the triangulation just after the present time. Right at any instant, however
// degenerate.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::rebuild() {
  if (!rebuilt_edges_) rebuilt_edges_.emplace();
  for (const Edge_ids& edge : finite_edge_ids()) --(*rebuilt_edges_)[edge];
  std::vector<Point_2> points;
  points.reserve(vertices_.size());
  for (const Vertex_handle v : triangulation_.finite_vertex_handles()) points.push_back(v->point());
  for (const auto& aside : std::exchange(points_set_aside_, {})) points.push_back(aside.point);
  std::ranges::sort(points, {}, &Point_2::id);
  queue_.clear();
  times_.clear();
  ++counters_.rebuilds;

  Triangulation rebuilt = build(points, current_time_);
  triangulation_.swap(rebuilt);
  index_vertices();
  schedule_all();
  for (const Edge_ids& edge : finite_edge_ids()) ++(*rebuilt_edges_)[edge];
}

// Reports the edges that a rebuild has removed and added in the end.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::report_rebuild() {
  if (!rebuilt_edges_) return;
  const auto edges = *std::exchange(rebuilt_edges_, std::nullopt);
  Event<Time> event;
  event.kind = Event_kind::rebuild;
  event.time = current_time_;
  for (const int change : {-1, 1}) {
    for (const auto& [edge, net_change] : edges) {
      if (net_change != change) continue;
      event.removed = change < 0 ? std::optional(edge) : std::nullopt;
      event.added = change > 0 ? std::optional(edge) : std::nullopt;
      report(event, [] {});
    }
  }
}

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_DETAIL_REBUILD_IMPL_H
