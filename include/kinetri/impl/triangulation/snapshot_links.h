// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the links of a snapshot are those of a triangulation, looked at before anything follows
// them. Together with the geometry, which is checked when the faces are there, this is enough; see
// Kinetic_triangulation_2::check_restored.
#ifndef KINETRI_IMPL_TRIANGULATION_SNAPSHOT_LINKS_H
#define KINETRI_IMPL_TRIANGULATION_SNAPSHOT_LINKS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/impl/triangulation/point_problems.h"

namespace kinetri::detail {

inline std::string vertex_name(Point_id id) {
  return id == no_point ? "the infinite vertex" : "point " + std::to_string(id);
}

/// Checks the links of a Triangulation_snapshot: every function throws Snapshot_error.
template <class Snapshot>
class Snapshot_links {
 public:
  explicit Snapshot_links(const Snapshot& snapshot) : snapshot_(snapshot) {}

  void check() {
    check_points();
    check_hidden_points();
    check_numbers();
    for (std::size_t f = 0; f < snapshot_.faces.size(); ++f) check_vertices(f);
    for (std::size_t f = 0; f < snapshot_.faces.size(); ++f) check_neighbors(f);
    check_face_of(no_point, snapshot_.infinite_vertex_face);
    for (std::size_t id = 0; id < snapshot_.motions.size(); ++id) {
      if (!snapshot_.motions[id] || is_hidden(static_cast<Point_id>(id))) continue;
      check_face_of(static_cast<Point_id>(id), snapshot_.vertex_faces[id]);
    }
  }

 private:
  using Face = typename Snapshot::Face;

  [[noreturn]] static void fail(const std::string& message) { throw Snapshot_error(message); }
  [[noreturn]] static void fail_at(std::size_t face, const std::string& message) {
    fail("face " + std::to_string(face) + " of the snapshot " + message);
  }

  /// Of the vertices of a face.
  int corners() const { return std::max(snapshot_.dimension, 0) + 1; }
  static int ccw(int i) { return (i + 1) % 3; }
  static int cw(int i) { return (i + 2) % 3; }

  static Point_id vertex(const Face& face, int i) {
    return face.vertices[static_cast<std::size_t>(i)];
  }
  static std::size_t neighbor(const Face& face, int i) {
    return face.neighbors[static_cast<std::size_t>(i)];
  }
  /// corners() if the face does not have the vertex.
  int index(const Face& face, Point_id id) const {
    int i = 0;
    while (i < corners() && vertex(face, i) != id) ++i;
    return i;
  }

  bool is_hidden(Point_id id) const {
    return std::ranges::binary_search(snapshot_.hidden_points, id);
  }

  // Each is there, and has a face without the infinite vertex.
  void check_hidden_points() {
    const auto& hidden = snapshot_.hidden_points;
    if (std::ranges::adjacent_find(hidden, std::ranges::greater_equal()) != hidden.end()) {
      fail("the snapshot's hidden points are not in order");
    }
    for (const Point_id id : hidden) {
      if (id >= snapshot_.motions.size() || !snapshot_.motions[id]) {
        fail("the snapshot hides " + vertex_name(id) + ", which is not there");
      }
      const std::size_t f = snapshot_.vertex_faces[id];
      if (f >= snapshot_.faces.size() || index(snapshot_.faces[f], no_point) < corners()) {
        fail("the snapshot hides " + vertex_name(id) + " in the face " + std::to_string(f) +
             ", which is no finite one");
      }
    }
    points_ -= hidden.size();
  }

  void check_points() {
    const std::size_t ids = snapshot_.motions.size();
    if (ids >= no_point) fail(std::string("the snapshot has ") + too_many_points);
    if (snapshot_.vertex_faces.size() != ids) {
      fail("the snapshot has " + std::to_string(ids) + " points, but faces of " +
           std::to_string(snapshot_.vertex_faces.size()) + "; expected one of each");
    }
    for (std::size_t id = 0; id < ids; ++id) {
      if (!snapshot_.motions[id]) continue;
      ++points_;
      if (!is_finite(*snapshot_.motions[id])) {
        fail(not_finite_problem(id));
      }
    }
  }

  // Euler's formula says how many faces there are.
  void check_numbers() const {
    const int dimension = snapshot_.dimension;
    const int lowest = points_ < 2 ? static_cast<int>(points_) - 1 : 1;
    const int highest = points_ < 3 ? lowest : 2;
    if (dimension < lowest || dimension > highest) {
      fail("a triangulation of " + std::to_string(points_) + " points has no dimension " +
           std::to_string(dimension));
    }
    const std::size_t faces = dimension == 2 ? 2 * points_ - 2 : points_ + 1;
    if (snapshot_.faces.size() != faces) {
      fail("the snapshot has " + std::to_string(snapshot_.faces.size()) + " faces; expected " +
           std::to_string(faces) + " for " + std::to_string(points_) + " points");
    }
  }

  void check_vertices(std::size_t f) const {
    const Face& face = snapshot_.faces[f];
    for (int i = 0; i < corners(); ++i) {
      const Point_id id = vertex(face, i);
      if (id != no_point && (id >= snapshot_.motions.size() || !snapshot_.motions[id])) {
        fail_at(f, "has " + vertex_name(id) + ", which is not there");
      }
      if (id != no_point && is_hidden(id)) fail_at(f, "has " + vertex_name(id) + ", a hidden one");
      if (index(face, id) != i) fail_at(f, "has " + vertex_name(id) + " twice");
    }
  }

  // A neighbor shares all vertices but the one opposite, and has this face as its neighbor there.
  // In dimension 2 it goes around the edge in the other sense.
  void check_neighbors(std::size_t f) const {
    const Face& face = snapshot_.faces[f];
    for (int i = 0; snapshot_.dimension >= 0 && i < corners(); ++i) {
      const std::size_t g = neighbor(face, i);
      if (g >= snapshot_.faces.size() || g == f) {
        fail_at(f, "has a neighbor " + std::to_string(g) + ", which is no other face");
      }
      const Face& other = snapshot_.faces[g];
      if (!are_glued(face, i, f, other)) {
        fail_at(f, "has the neighbor " + std::to_string(g) + " at an edge that they do not share");
      }
    }
  }

  bool are_glued(const Face& face, int i, std::size_t f, const Face& other) const {
    if (snapshot_.dimension == 0) return neighbor(other, 0) == f;
    if (snapshot_.dimension == 1) {
      return vertex(other, i) == vertex(face, 1 - i) && neighbor(other, 1 - i) == f;
    }
    const int right = index(other, vertex(face, ccw(i)));
    if (right == corners()) return false;
    const int j = ccw(right);
    return vertex(other, ccw(j)) == vertex(face, cw(i)) && neighbor(other, j) == f;
  }

  void check_face_of(Point_id id, std::size_t f) const {
    if (f < snapshot_.faces.size() && index(snapshot_.faces[f], id) < corners()) return;
    fail("the snapshot gives " + vertex_name(id) + " the face " + std::to_string(f) +
         ", which does not have it");
  }

  const Snapshot& snapshot_;
  std::size_t points_ = 0;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_SNAPSHOT_LINKS_H
