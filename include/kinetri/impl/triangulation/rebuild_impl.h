// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2: instants that flips alone do not pass, because
// points coincide or the hull goes flat.
#ifndef KINETRI_IMPL_TRIANGULATION_REBUILD_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_REBUILD_IMPL_H

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

// Takes the points that coincide now out of the triangulation, but for one in each place, as it was
// just before: all else that happens now happens to distinct points. Points that come together
// share edges just before, so that each place's points are connected by edges whose ends coincide;
// these are first in the queue.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_coincident_points_aside() {
  rebuilt_edges_.emplace();
  // By point, one that is nearer to the least id in its place, or that one itself.
  std::map<Point_id, Point_id> parents;
  const auto least = [&parents](Point_id id) {
    while (parents.at(id) != id) id = parents.at(id);
    return id;
  };
  while (settle_now() && queue_.top().kind == Entry_kind::coincidence) {
    const Edge edge = queue_.pop().edge();
    set_event(two_sided(edge), no_event);
    const auto [a, b] = ids_of(edge);
    parents.emplace(a, a);
    parents.emplace(b, b);
    const std::array<Point_id, 2> merged = edge_ids(least(a), least(b));
    parents[merged[1]] = merged[0];
  }
  // Each point that is put back is looked for from where it was, maybe far away.
  constexpr std::size_t few = 8;
  const bool are_many = parents.size() > std::max(few, number_of_points_ / few);
  if (are_many || triangulation_.dimension() < 2 || !weights_are_equal_) return rebuild();
  clock_.set({current_time(), Time_side::before});
  for (const auto& [id, parent] : parents) {
    if (id == parent) continue;
    if (triangulation_.test_dim_down(vertices_[id])) return rebuild();
    take_out(vertices_[id]);
    points_set_aside_.push_back({vertices_[id], vertices_[least(id)]});
    ++counters_.points_set_aside;
  }
  show_current_time();
}

// Puts the points that were set aside back where they are just after now, one after the other.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::put_points_back() {
  while (!points_set_aside_.empty()) {
    const auto [v, companion] = points_set_aside_.back();
    points_set_aside_.pop_back();
    put_in(v, locate(v->point(), companion->face()));
    execute_due_events();
  }
}

// Reconstructs the triangulation just after the present time. Right at any instant, however
// degenerate. In between, `change_vertices` may insert, erase or move points; `rebuilt` is the
// triangulation of the points after that, if it has been made already.
template <KineticTraits_2 Traits>
template <class Change_vertices>
void Kinetic_triangulation_2<Traits>::rebuild(Change_vertices change_vertices,
                                              std::optional<Triangulation> rebuilt) {
  if (!rebuilt_edges_) rebuilt_edges_.emplace();
  for (const Edge_ids& edge : finite_edge_ids()) rebuilt_edges_->note(edge, -1);
  points_set_aside_.clear();
  postponed_.clear();
  show_current_time();
  queue_.clear();
  change_vertices();
  adopt(rebuilt ? std::move(*rebuilt) : build_now(points_after({})));
  if constexpr (is_weighted) weights_are_equal_ = have_equal_weights(points_after({}));
  schedule_all();
  for (const Edge_ids& edge : finite_edge_ids()) rebuilt_edges_->note(edge, 1);
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::rebuild() {
  ++counters_.reconstructions;
  rebuild([] {});
}

// Just before the mirrored time the triangulation is Delaunay; the events of that time are executed
// as in `run_instant`. A flat triangle, as there is also where points meet, is rebuilt instead.
template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::reverse() {
  const detail::Flag_while changing = start_change();
  const std::uint64_t before = counters_.number_of_events();
  queue_.clear();
  set_current_time(-current_time());
  for (const Vertex_handle v : vertices_) {
    if (v == Vertex_handle()) continue;
    v->set_point(Point_2(mirrored(v->point().motion()), v->point().id()));
  }
  show_current_time();
  if (has_flat_triangle()) {
    rebuild();
  } else {
    schedule_all();
    execute_due_events();
  }
  report_rebuild();
  return static_cast<std::size_t>(counters_.number_of_events() - before);
}

// Whether a triangle is flat at the present time, or the points are on a line.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::has_flat_triangle() const {
  if (triangulation_.dimension() < 2) return true;
  const auto now = traits_.instantaneous_traits({current_time(), Time_side::at});
  return std::ranges::any_of(triangulation_.finite_face_handles(), [&](Face_handle face) {
    return now.orientation_2_object()(face->vertex(0)->point(), face->vertex(1)->point(),
                                      face->vertex(2)->point()) == CGAL::COLLINEAR;
  });
}

// Takes over the faces of another triangulation of the same points. The vertices stay what they
// are.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::adopt(Triangulation rebuilt) {
  auto& tds = triangulation_.tds();
  const auto vertex_here = [&](Vertex_handle there) {
    return rebuilt.is_infinite(there) ? triangulation_.infinite_vertex()
                                      : vertices_[there->point().id()];
  };
  tds.faces().clear();
  tds.faces().swap(rebuilt.tds().faces());
  tds.set_dimension(rebuilt.dimension());
  // A face of a triangulation of dimension d has d + 1 vertices, but for that of the lone infinite
  // vertex, which has dimension -1.
  const int corners = std::max(rebuilt.dimension(), 0) + 1;
  for (Face_handle face = tds.faces().begin(); face != tds.faces().end(); ++face) {
    for (int i = 0; i < corners; ++i) face->set_vertex(i, vertex_here(face->vertex(i)));
  }
  auto& vertices = rebuilt.tds().vertices();
  for (Vertex_handle there = vertices.begin(); there != vertices.end(); ++there) {
    vertex_here(there)->set_face(there->face());
  }
  if constexpr (is_weighted) {
    for (Face_handle face = tds.faces().begin(); face != tds.faces().end(); ++face) {
      face->vertex_list().clear();
    }
    for (Vertex_handle there = vertices.begin(); there != vertices.end(); ++there) {
      if (rebuilt.is_infinite(there)) continue;
      const Vertex_handle here = vertex_here(there);
      if (here->is_hidden() != there->is_hidden()) {
        rebuilt_points_.push_back({here->point().id(), there->is_hidden()});
        moved_hidden_.push_back(here->point().id());
      }
      here->set_hidden(there->is_hidden());
      here->set_event(no_event);
      if (!there->is_hidden()) continue;
      there->face()->vertex_list().push_back(here);
      moved_hidden_.push_back(here->point().id());
    }
    triangulation_.count_hidden_vertices();
  }
}

// Reports the points that a rebuild has hidden or revealed in the end.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::report_rebuilt_points() {
  auto points = std::exchange(rebuilt_points_, {});
  std::ranges::stable_sort(points, {}, &std::pair<Point_id, bool>::first);
  for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
    const auto [id, is_first_hidden] = points[first];
    while (last < points.size() && points[last].first == id) ++last;
    // Each change is to the other state.
    if ((last - first) % 2 == 0 || !contains(id)) continue;
    Event event;
    event.kind = is_first_hidden ? Event_kind::hide : Event_kind::reveal;
    event.point_a = id;
    report(event, [] {});
  }
}

// Reports the edges that a rebuild has removed and added in the end, then all that it has touched.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::report_rebuild() {
  if (!rebuilt_edges_) return;
  const auto edges = rebuilt_edges_->take();
  rebuilt_edges_.reset();
  report_rebuilt_points();
  Event event;
  event.kind = Event_kind::rebuild;
  for (const int change : {-1, 1}) {
    for (const auto& [edge, net_change] : edges) {
      if (net_change != change) continue;
      event.removed = change < 0 ? std::optional(edge) : std::nullopt;
      event.added = change > 0 ? std::optional(edge) : std::nullopt;
      report(event, [] {});
    }
  }
  if (observers_.empty()) return;
  std::vector<Edge_ids> touched;
  touched.reserve(edges.size());
  for (const auto& [edge, net_change] : edges) touched.push_back(edge);
  is_in_event_ = true;
  observers_.call([&](Observer& observer) { observer.after_rebuild(current_time(), touched); });
  is_in_event_ = false;
}

// Tells the observers which hidden points may have other triangles.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::report_hiding() {
  if (moved_hidden_.empty()) return;
  std::vector<Point_id> points = std::exchange(moved_hidden_, {});
  if (observers_.empty()) return;
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  is_in_event_ = true;
  observers_.call([&](Observer& observer) { observer.after_hiding(current_time(), points); });
  is_in_event_ = false;
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_REBUILD_IMPL_H
