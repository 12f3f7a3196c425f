// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 6, queries: four points rest at the corners of a rectangle, and point 4 moves through it.
// Which are near which, at an exact time?
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>
#include <kinetri/triangulation/queries_2.h>

#include <iostream>
#include <span>
#include <vector>

using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<>;

static void print(const char* text, std::span<const kinetri::Point_id> ids) {
  std::cout << text;
  for (const kinetri::Point_id id : ids) std::cout << ' ' << id;
  std::cout << '\n';
}

// Kinetri's queries: ids, at any time from the current one up to the next event.
static void ask_kinetri(const Triangulation& kdt, const kinetri::Rational& time) {
  const kinetri::Kinetic_queries_2 queries(kdt, time);
  std::cout << "at t = " << time << '\n';
  std::cout << "nearest to (5, 4): " << *queries.nearest_vertex({5, 4}) << '\n';
  print("triangle at (5, 4):", queries.locate({5, 4}).points);
  print("neighbors of 4:", queries.neighbors(4));
  print("closest pair:", *queries.closest_pair());

  // At a rational time the coordinates are rational, and nothing is rounded.
  const kinetri::Voronoi_cell_2<kinetri::Exact_position_2> cell = queries.voronoi_cell(4);
  std::cout << "Voronoi cell of 4:";
  for (const auto& [x, y] : cell.vertices) std::cout << " (" << x << ", " << y << ')';
  std::cout << '\n';
}

// CGAL's queries: handles, at the current time.
static void ask_cgal(const Triangulation& kdt) {
  const Triangulation::Triangulation& dt = kdt.triangulation();
  std::cout << "vertices " << dt.number_of_vertices() << ", faces " << dt.number_of_faces() << '\n';

  // The points of this triangulation move. A query point is a point at rest.
  const kinetri::Moving_point_2 query({{5, 4}, {0, 0}});
  std::cout << "nearest to (5, 4): " << dt.nearest_vertex(query)->point().id() << '\n';
  const Triangulation::Face_handle face = dt.locate(query);
  std::cout << "triangle at (5, 4):";
  for (int i = 0; i < 3; ++i) std::cout << ' ' << face->vertex(i)->point().id();
  std::cout << '\n';

  // The dual of a face, its circumcenter, is a moving point too.
  const kinetri::Moving_point_2 center = dt.dual(face);
  for (const int t : {0, 1}) {
    const kinetri::Exact_position_2 at = center.position(t);
    std::cout << "its circumcenter at t = " << t << ": (" << at.x << ", " << at.y << ")\n";
  }

  std::cout << "hull vertices:";
  auto v = dt.incident_vertices(dt.infinite_vertex());
  const auto first = v;
  do {
    std::cout << ' ' << v->point().id();
  } while (++v != first);
  std::cout << '\n';
}

int main() {
  const std::vector<kinetri::Linear_motion_2> motions = {
      {{0, 0}, {0, 0}}, {{8, 0}, {0, 0}}, {{8, 6}, {0, 0}}, {{0, 6}, {0, 0}}, {{2, 3}, {1, 0}}};
  Triangulation kdt(motions);
  ask_kinetri(kdt, kinetri::Rational(4, 3));
  ask_cgal(kdt);
}
