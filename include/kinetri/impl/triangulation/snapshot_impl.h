// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2: how its state is taken out and put back.
#ifndef KINETRI_IMPL_TRIANGULATION_SNAPSHOT_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_SNAPSHOT_IMPL_H

#include <algorithm>
#include <chrono>
#include <string>
#include <unordered_map>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/snapshot_links.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::snapshot() const -> Snapshot {
  KINETRI_PRECONDITION(!is_in_event_ && !rebuilt_edges_ && points_set_aside_.empty(),
                       "a snapshot within an event; take it when advance_to or step has returned");
  Snapshot result;
  result.time = current_time().detached();
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
    auto& [vertices, neighbors] = result.faces[number];
    for (int i = 0; i <= std::max(result.dimension, 0); ++i) {
      const auto at = static_cast<std::size_t>(i);
      vertices[at] = face->vertex(i)->point().id();
      if (result.dimension >= 0) neighbors[at] = numbers.at(face->neighbor(i));
    }
  }
  result.infinite_vertex_face = numbers.at(triangulation_.infinite_vertex()->face());
  for (const Vertex_handle v : vertices_) {
    const bool is_there = v != Vertex_handle();
    result.motions.push_back(is_there ? std::optional(v->point().motion()) : std::nullopt);
    result.vertex_faces.push_back(is_there ? numbers.at(v->face()) : 0);
    if (is_there && is_hidden(v->point().id())) result.hidden_points.push_back(v->point().id());
  }
  return result;
}

template <KineticTraits_2 Traits>
Kinetic_triangulation_2<Traits>::Kinetic_triangulation_2(Restoration /*restores*/,
                                                         const Snapshot& snapshot,
                                                         const Traits& traits)
    : traits_(traits),
      current_time_(snapshot.time.detached()),
      clock_({current_time_, Time_side::after}) {
  const auto started = std::chrono::steady_clock::now();
  detail::Snapshot_links<Snapshot>(snapshot).check();
  triangulation_ = Triangulation(traits_.instantaneous_traits(clock_));
  make_faces(snapshot);
  check_restored();
  const auto built = std::chrono::steady_clock::now();
  certificate_counters_ = snapshot.certificates;
  schedule_all();
  counters_ = snapshot.counters;
  const auto initialized = std::chrono::steady_clock::now();
  using Seconds = std::chrono::duration<double>;
  construction_seconds_ = {Seconds(built - started).count(), Seconds(initialized - built).count()};
}

// Makes the vertices and faces of a snapshot whose links are right.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::make_faces(const Snapshot& snapshot) {
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
  if constexpr (is_weighted) {
    for (const Point_id id : snapshot.hidden_points) {
      triangulation_.hide(vertices_[id], vertices_[id]->face());
    }
    std::vector<Point_2> points;
    for (const Vertex_handle v : vertices_) {
      if (v != Vertex_handle()) points.push_back(v->point());
    }
    weights_are_equal_ = have_equal_weights(points);
  } else if (!snapshot.hidden_points.empty()) {
    throw Snapshot_error("the snapshot hides points, which have no weights");
  }
  triangulation_.infinite_vertex()->set_face(faces[snapshot.infinite_vertex_face]);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [vertices, neighbors] = snapshot.faces[f];
    for (int i = 0; i <= std::max(snapshot.dimension, 0); ++i) {
      const auto at = static_cast<std::size_t>(i);
      faces[f]->set_vertex(
          i, vertices[at] == no_point ? triangulation_.infinite_vertex() : vertices_[vertices[at]]);
      if (snapshot.dimension >= 0) faces[f]->set_neighbor(i, faces[neighbors[at]]);
    }
  }
}

// Throws unless faces whose links are right are a Delaunay triangulation just after the present
// time. The links make closed surfaces, which may have vertices in common. None is without the
// infinite vertex: it would be finite triangles whose signed areas add up to nothing, though all of
// them turn left. Each way around the infinite vertex is a polygon that turns right nowhere, and so
// has as many vertices that are lexicographically less than both their neighbors as it goes around,
// at least one. Where there is one in all, there is one surface, with one hull that goes around
// once. Had it a handle, or a vertex in two places, it would have more faces than the number of
// vertices allows; so it is a sphere. And since the hull goes around once, the angles at each inner
// vertex add up to no more than one turn (Gauss and Bonnet): no place is covered twice.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::check_restored() const {
  check_restored_hidden_points();
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
  const auto edge_text = [](const Edge& edge) {
    const Edge_ids ids = ids_of(edge);
    return std::to_string(ids[0]) + " and " + std::to_string(ids[1]);
  };
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
    } else if (triangulation_.is_infinite(face) && triangulation_.is_infinite(face->neighbor(i))) {
      throw Snapshot_error("the snapshot's edge of points " + edge_text(edge) + " has no triangle");
    } else if (!triangulation_.is_infinite(face) &&
               !triangulation_.is_infinite(face->neighbor(i)) &&
               now.side_of_oriented_circle_2_object()(
                   face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point(),
                   triangulation_.tds().mirror_vertex(face, i)->point()) ==
                   CGAL::ON_POSITIVE_SIDE) {
      throw Snapshot_error("the snapshot's edge of points " + edge_text(edge) +
                           " is not locally Delaunay");
    }
  }
  if (least_vertices != 1) throw Snapshot_error("the snapshot's hull goes around more than once");
}

// Throws unless each hidden point is where its face is, and not below it.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::check_restored_hidden_points() const {
  if constexpr (is_weighted) {
    const Instantaneous_traits& now = triangulation_.geom_traits();
    const auto side = now.power_side_of_oriented_power_circle_2_object();
    const auto are_hidden_by = [&](Face_handle f, const Point_2& point) {
      const auto corner = [&](int i) -> const Point_2& { return f->vertex(i)->point(); };
      if (triangulation_.dimension() < 1) {
        return now.equal_2_object()(corner(0), point) &&
               side(corner(0), point) != CGAL::ON_POSITIVE_SIDE;
      }
      if (triangulation_.dimension() == 1) {
        return now.orientation_2_object()(corner(0), corner(1), point) == CGAL::COLLINEAR &&
               (now.equal_2_object()(corner(0), point) || now.equal_2_object()(corner(1), point) ||
                now.collinear_are_strictly_ordered_along_line_2_object()(corner(0), point,
                                                                         corner(1))) &&
               side(corner(0), corner(1), point) != CGAL::ON_POSITIVE_SIDE;
      }
      for (int i = 0; i < 3; ++i) {
        if (now.orientation_2_object()(corner(Triangulation::ccw(i)), corner(Triangulation::cw(i)),
                                       point) == CGAL::RIGHT_TURN) {
          return false;
        }
      }
      return side(corner(0), corner(1), corner(2), point) != CGAL::ON_POSITIVE_SIDE;
    };
    for (const Vertex_handle v : triangulation_.hidden_vertex_handles()) {
      if (!are_hidden_by(v->face(), v->point())) {
        throw Snapshot_error("the snapshot's face of the hidden point " +
                             std::to_string(v->point().id()) + " does not hide it");
      }
    }
  }
}

// The same of points on a line, or fewer than three.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::check_restored_chain() const {
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

#endif  // KINETRI_IMPL_TRIANGULATION_SNAPSHOT_IMPL_H
