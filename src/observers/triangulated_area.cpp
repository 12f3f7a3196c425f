// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/triangulated_area.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "kinetri/algebra/number_types.h"

namespace kinetri::detail {
namespace {

// A ring, and its place in the input.
struct Named_ring {
  const Ring* positions;
  std::size_t polygon;
  std::size_t hole;  // from 1 on; 0 is the outer ring

  std::string name() const {
    const std::string result = "polygon " + std::to_string(polygon);
    return hole == 0 ? result : result + ", hole " + std::to_string(hole);
  }
};

// A side of a face.
struct Side_info {
  // The winding number on this side minus that on the other side.
  int step = 0;
  const Named_ring* ring = nullptr;  // of the side
};

struct Face_info {
  std::array<Side_info, 3> sides = {};  // opposite to the corners
  int winding = -1;  // the number of polygons minus that of holes that contain it
  bool is_known = false;
  std::size_t index = Triangulated_area::wall;  // among those of the area

  Side_info& side(int i) { return sides[static_cast<std::size_t>(i)]; }
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Faces =
    CGAL::Triangulation_face_base_with_info_2<Face_info, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Data_structure =
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>, Faces>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Data_structure,
                                               CGAL::No_constraint_intersection_tag>;
using Vertex_handle = Triangulation::Vertex_handle;
using Face_handle = Triangulation::Face_handle;

std::string text(const Vector_2& place) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << place.x << ' ' << place.y;
  return out.str();
}

// The sign of the area of the ring: 1 if it is counterclockwise, -1 if it is clockwise.
int direction(const Ring& ring) {
  Rational sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector_2& v = ring[i];
    const Vector_2& w = ring[(i + 1) % ring.size()];
    sum += to_rational(v.x) * to_rational(w.y) - to_rational(w.x) * to_rational(v.y);
  }
  return sum > 0 ? 1 : sum < 0 ? -1 : 0;
}

void insert_edges(Triangulation& triangulation, const std::vector<Named_ring>& rings,
                  std::vector<std::vector<Vertex_handle>>& vertices) {
  // All vertices first, so that edges are divided at vertices on them.
  Face_handle hint;
  for (const Named_ring& ring : rings) {
    vertices.emplace_back();
    for (const Vector_2& v : *ring.positions) {
      vertices.back().push_back(triangulation.insert({v.x, v.y}, hint));
      hint = vertices.back().back()->face();
    }
  }
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < vertices[r].size(); ++i) {
      const std::size_t next = (i + 1) % vertices[r].size();
      try {
        triangulation.insert_constraint(vertices[r][i], vertices[r][next]);
      } catch (const Triangulation::Intersection_of_constraints_exception&) {
        const Ring& ring = *rings[r].positions;
        throw Invalid_area{rings[r].name() + ": the edge from (" + text(ring[i]) + ") to (" +
                           text(ring[next]) +
                           ") crosses another edge, or runs along it; expected edges that share "
                           "single positions at most"};
      }
    }
  }
}

// Marks both sides of the edges from `v` to `end`.
void note_edges(const Triangulation& triangulation, Vertex_handle v, Vertex_handle end,
                const Named_ring& ring, int step) {
  const auto leads_on = [&](Vertex_handle w) {
    return w == end || CGAL::are_strictly_ordered_along_line(v->point(), w->point(), end->point());
  };
  while (v != end) {
    auto face = triangulation.incident_faces(v);
    for (;; ++face) {
      const int at_v = face->index(v);
      const Vertex_handle w = face->vertex(Triangulation::ccw(at_v));
      if (triangulation.is_infinite(w) || !leads_on(w)) continue;
      const int side = Triangulation::cw(at_v);
      const Face_handle right = face->neighbor(side);
      const int right_side = right->index(face);
      face->info().side(side) = {step, &ring};
      right->info().side(right_side) = {-step, &ring};
      v = w;
      break;
    }
  }
}

// Finds the faces of the area, by a search from the infinite faces.
std::vector<Face_handle> find_inside(const Triangulation& triangulation) {
  std::vector<Face_handle> inside;
  std::vector<Face_handle> open = {triangulation.infinite_face()};
  open.back()->info().winding = 0;
  open.back()->info().is_known = true;
  while (!open.empty()) {
    const Face_handle face = open.back();
    open.pop_back();
    if (face->info().winding == 1) inside.push_back(face);
    for (int i = 0; i < 3; ++i) {
      const Face_handle next = face->neighbor(i);
      if (next->info().is_known) continue;
      const int side = next->index(face);
      const auto& [step, ring] = next->info().side(side);
      const int winding = face->info().winding + step;
      if (winding < 0 || winding > 1) {
        throw Invalid_area{ring->name() +
                           (winding < 0 ? " is outside of its polygon, or overlaps another hole; "
                                          "expected holes inside of polygons that do not overlap"
                                        : " overlaps another polygon; expected polygons that do "
                                          "not overlap")};
      }
      next->info().winding = winding;
      next->info().is_known = true;
      open.push_back(next);
    }
  }
  return inside;
}

}  // namespace

Triangulated_area::Triangulated_area(const std::vector<Rings_of_polygon>& polygons)
    : number_of_polygons_(polygons.size()) {
  std::vector<Named_ring> rings;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    for (std::size_t r = 0; r < polygons[p].size(); ++r) {
      rings.push_back({&polygons[p][r], p + 1, r});
    }
  }
  Triangulation triangulation;
  std::vector<std::vector<Vertex_handle>> vertices;
  insert_edges(triangulation, rings, vertices);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const int turn = direction(*rings[r].positions);
    if (turn == 0) throw Invalid_area{rings[r].name() + " has no area; expected a ring with one"};
    const int step = rings[r].hole == 0 ? turn : -turn;
    for (std::size_t i = 0; i < vertices[r].size(); ++i) {
      note_edges(triangulation, vertices[r][i], vertices[r][(i + 1) % vertices[r].size()], rings[r],
                 step);
    }
  }
  std::vector<Face_handle> inside = find_inside(triangulation);
  for (std::size_t i = 0; i < inside.size(); ++i) inside[i]->info().index = i;
  for (const Face_handle face : inside) {
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& p = face->vertex(static_cast<int>(i))->point();
      triangle.corners[i] = {p.x(), p.y()};
      triangle.neighbors[i] = face->neighbor(static_cast<int>(i))->info().index;
    }
    triangles_.push_back(triangle);
  }
  make_trees();
}

auto Triangulated_area::tree_box(std::span<const Vector_2> places) -> Tree_box {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box_2 box = {infinity, infinity, -infinity, -infinity};
  for (const Vector_2& v : places) {
    box = {std::min(box.xmin, v.x), std::min(box.ymin, v.y), std::max(box.xmax, v.x),
           std::max(box.ymax, v.y)};
  }
  return tree_box(box);
}

void Triangulated_area::make_trees() {
  std::vector<std::pair<Tree_box, std::size_t>> boxes;
  std::vector<std::pair<Tree_box, std::size_t>> wall_boxes;
  std::vector<Vector_2> places;
  for (const auto& [corners, neighbors] : triangles_) {
    boxes.emplace_back(tree_box(corners), boxes.size());
    places.insert(places.end(), corners.begin(), corners.end());
    const auto& [a, b, c] = corners;
    area_ += ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)) / 2;
    for (std::size_t i = 0; i < 3; ++i) {
      if (neighbors[i] != wall) continue;
      walls_.push_back({corners[(i + 1) % 3], corners[(i + 2) % 3]});
      wall_boxes.emplace_back(tree_box(walls_.back()), wall_boxes.size());
    }
  }
  const Tree_box all = tree_box(places);
  extent_ = {all.min_corner().x(), all.min_corner().y(), all.max_corner().x(),
             all.max_corner().y()};
  triangle_tree_ = Tree(boxes);
  wall_tree_ = Tree(wall_boxes);
}

}  // namespace kinetri::detail
