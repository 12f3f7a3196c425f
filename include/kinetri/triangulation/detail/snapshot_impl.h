// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_delaunay_triangulation_2: how its state is taken out and put back.
#ifndef KINETRI_TRIANGULATION_DETAIL_SNAPSHOT_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_SNAPSHOT_IMPL_H

#include <algorithm>
#include <chrono>
#include <string>
#include <unordered_map>
#include <vector>

#include "kinetri/base/check.h"
#include "kinetri/triangulation/detail/snapshot_links.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::snapshot() const -> Snapshot {
  KINETRI_PRECONDITION(!is_in_event_ && !rebuilt_edges_ && points_set_aside_.empty(),
                       "a snapshot is taken between events");
  Snapshot result;
  result.time = current_time_.detached();
  result.dimension = triangulation_.dimension();
  result.counters = counters_;
  result.certificates = certificate_counters_;
  std::unordered_map<Face_handle, std::size_t> numbers;
  auto& faces = triangulation_.tds().faces();
  for (Face_handle face = faces.begin(); face != faces.end(); ++face) {
    numbers.emplace(face, numbers.size());
  }
  result.faces.resize(numbers.size());
  for (const auto& [face, number] : numbers) {
    auto& [vertices, neighbors, has_queue_entry] = result.faces[number];
    for (int i = 0; i <= std::max(result.dimension, 0); ++i) {
      const auto at = static_cast<std::size_t>(i);
      vertices[at] = face->vertex(i)->point().id();
      if (result.dimension >= 0) neighbors[at] = numbers.at(face->neighbor(i));
      if (result.dimension < 2 || face->event(i) == no_event) continue;
      has_queue_entry[at] = queue_[face->event(i)].edge() == Edge(face, i);
    }
  }
  result.infinite_vertex_face = numbers.at(triangulation_.infinite_vertex()->face());
  for (const Vertex_handle v : vertices_) {
    const bool is_there = v != Vertex_handle();
    result.motions.push_back(is_there ? std::optional(v->point().motion()) : std::nullopt);
    result.vertex_faces.push_back(is_there ? numbers.at(v->face()) : 0);
  }
  return result;
}

template <KineticTraits_2 Traits>
Kinetic_delaunay_triangulation_2<Traits>::Kinetic_delaunay_triangulation_2(Restoration /*restores*/,
                                                                           const Snapshot& snapshot,
                                                                           const Traits& traits)
    : traits_(traits), current_time_(snapshot.time.detached()) {
  const auto started = std::chrono::steady_clock::now();
  detail::Snapshot_links<Snapshot>(snapshot).check();
  triangulation_ = Triangulation(traits_.instantaneous_traits({current_time_, Side::after}));
  const std::vector<Face_handle> faces = make_faces(snapshot);
  check_restored();
  const auto built = std::chrono::steady_clock::now();
  certificate_counters_ = snapshot.certificates;
  schedule_all(sides_in_queue(snapshot, faces));
  counters_ = snapshot.counters;
  const auto initialized = std::chrono::steady_clock::now();
  using Seconds = std::chrono::duration<double>;
  construction_seconds_ = {Seconds(built - started).count(), Seconds(initialized - built).count()};
}

// Makes the vertices and faces of a snapshot whose links are right. Returns the faces in its order.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::make_faces(const Snapshot& snapshot)
    -> std::vector<Face_handle> {
  auto& tds = triangulation_.tds();
  tds.faces().clear();
  tds.set_dimension(snapshot.dimension);
  std::vector<Face_handle> faces;
  faces.reserve(snapshot.faces.size());
  for (std::size_t f = 0; f < snapshot.faces.size(); ++f) faces.push_back(tds.create_face());
  vertices_.resize(snapshot.motions.size());
  for (std::size_t id = 0; id < vertices_.size(); ++id) {
    if (!snapshot.motions[id]) continue;
    vertices_[id] = tds.create_vertex();
    vertices_[id]->set_point(Point_2(*snapshot.motions[id], static_cast<Point_id>(id)));
    vertices_[id]->set_face(faces[snapshot.vertex_faces[id]]);
    ++number_of_points_;
  }
  triangulation_.infinite_vertex()->set_face(faces[snapshot.infinite_vertex_face]);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [vertices, neighbors, unused] = snapshot.faces[f];
    for (int i = 0; i <= std::max(snapshot.dimension, 0); ++i) {
      const auto at = static_cast<std::size_t>(i);
      faces[f]->set_vertex(
          i, vertices[at] == no_point ? triangulation_.infinite_vertex() : vertices_[vertices[at]]);
      if (snapshot.dimension >= 0) faces[f]->set_neighbor(i, faces[neighbors[at]]);
    }
  }
  return faces;
}

// Every edge from the side on which its entry was, those without one as in edges().
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::sides_in_queue(
    const Snapshot& snapshot, const std::vector<Face_handle>& faces) const -> std::vector<Edge> {
  if (snapshot.dimension < 2) return edges();
  std::vector<Edge> result;
  result.reserve(3 * (vertices_.size() + 1));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const Two_sided_edge edge = two_sided(Edge(faces[f], i));
      const std::size_t g = snapshot.faces[f].neighbors[static_cast<std::size_t>(i)];
      const bool is_here = snapshot.faces[f].has_queue_entry[static_cast<std::size_t>(i)];
      const bool is_there =
          snapshot.faces[g].has_queue_entry[static_cast<std::size_t>(edge.there.second)];
      if (is_here || (!is_there && faces[f]->vertex(Triangulation::cw(i))->point().id() <
                                       faces[f]->vertex(Triangulation::ccw(i))->point().id())) {
        result.push_back(edge.here);
      }
    }
  }
  return result;
}

// Throws unless faces whose links are right are a Delaunay triangulation just after the present
// time. The links make closed surfaces with as many faces as a sphere. One without the infinite
// vertex would be finite triangles whose signed areas add up to nothing; so, with all of them left
// turns, there is one surface, and it is a sphere. What is left is a disc that might cover places
// of the plane more than once, as about a point whose angles add up to two turns. Its hull, nowhere
// a right turn, then goes around more than once, and as often as it goes around it has a vertex
// that is lexicographically less than both its neighbors.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::check_restored() const {
  if (triangulation_.dimension() < 2) return check_restored_chain();
  const Instantaneous_traits& now = triangulation_.geom_traits();
  const auto orientation = now.orientation_2_object();
  const auto is_less = [&](Vertex_handle v, Vertex_handle w) {
    const auto by_x = now.compare_x_2_object()(v->point(), w->point());
    return by_x == CGAL::SMALLER ||
           (by_x == CGAL::EQUAL &&
            now.compare_y_2_object()(v->point(), w->point()) == CGAL::SMALLER);
  };
  for (const Face_handle f : triangulation_.finite_face_handles()) {
    if (orientation(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point()) !=
        CGAL::LEFT_TURN) {
      throw Snapshot_error("the snapshot's triangle of points " +
                           std::to_string(f->vertex(0)->point().id()) + ", " +
                           std::to_string(f->vertex(1)->point().id()) + " and " +
                           std::to_string(f->vertex(2)->point().id()) + " is not counterclockwise");
    }
  }
  std::size_t least_vertices = 0;
  for (const Edge& edge : edges()) {
    const auto& [face, i] = edge;
    if (triangulation_.is_infinite(edge)) {
      const auto [previous, here, next] = hull_turn(two_sided(edge));
      if (orientation(previous->point(), here->point(), next->point()) == CGAL::RIGHT_TURN) {
        throw Snapshot_error("the snapshot's hull is not convex at point " +
                             std::to_string(here->point().id()));
      }
      if (is_less(here, previous) && is_less(here, next)) ++least_vertices;
    } else if (!triangulation_.is_infinite(face) &&
               !triangulation_.is_infinite(face->neighbor(i)) &&
               now.side_of_oriented_circle_2_object()(
                   face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point(),
                   triangulation_.tds().mirror_vertex(face, i)->point()) ==
                   CGAL::ON_POSITIVE_SIDE) {
      const Edge_ids ids = ids_of(edge);
      throw Snapshot_error("the snapshot's edge of points " + std::to_string(ids[0]) + " and " +
                           std::to_string(ids[1]) + " is not locally Delaunay");
    }
  }
  if (least_vertices != 1) throw Snapshot_error("the snapshot's hull goes around more than once");
}

// The same of points on a line, or fewer than three.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::check_restored_chain() const {
  if (triangulation_.dimension() < 1) return;
  const Instantaneous_traits& now = triangulation_.geom_traits();
  for (const Edge& edge : triangulation_.finite_edges()) {
    const Face_handle face = edge.first;
    const Point_2& from = face->vertex(0)->point();
    const Point_2& to = face->vertex(1)->point();
    const Face_handle next = face->neighbor(0);
    const bool is_right =
        triangulation_.is_infinite(next)
            ? now.compare_x_2_object()(from, to) != CGAL::EQUAL ||
                  now.compare_y_2_object()(from, to) != CGAL::EQUAL
            : now.orientation_2_object()(from, to, next->vertex(1)->point()) == CGAL::COLLINEAR &&
                  now.collinear_are_strictly_ordered_along_line_2_object()(
                      from, to, next->vertex(1)->point());
    if (is_right) continue;
    throw Snapshot_error("the snapshot's chain of collinear points is not in order at points " +
                         std::to_string(from.id()) + " and " + std::to_string(to.id()));
  }
}

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_DETAIL_SNAPSHOT_IMPL_H
