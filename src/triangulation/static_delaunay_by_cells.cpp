// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/insertion_order.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/kd_cells.h"
#include "triangulation/static_delaunay.h"

namespace kinetri::detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Face = Static_delaunay::Face;
using Numbered = std::pair<Kernel::Point_2, Point_id>;

constexpr std::uint32_t no_face = std::numeric_limits<std::uint32_t>::max();

// The index of a face in the result. For a face of the border also the faces of cells beyond its
// edges, if there are any.
struct Position {
  std::uint32_t here = no_face;
  std::array<std::uint32_t, 3> beyond = {no_face, no_face, no_face};
};

using Triangulation = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<
                CGAL::Triangulation_vertex_base_with_info_2<Point_id, Kernel>,
                CGAL::Triangulation_face_base_with_info_2<Position, Kernel>>>;
using Face_handle = Triangulation::Face_handle;
using Vertex_handle = Triangulation::Vertex_handle;

Face as_plain(Face_handle face) {
  const auto vertex = [face](int i) { return face->vertex(i)->info(); };
  const auto neighbor = [face](int i) { return face->neighbor(i)->info().here; };
  return {{vertex(0), vertex(1), vertex(2)}, {neighbor(0), neighbor(1), neighbor(2)}};
}

// Inserts the positions with these numbers. Equal positions share a vertex.
void insert(std::span<const Vector_2> places, std::span<const Point_id> numbers,
            Triangulation& triangulation) {
  std::vector<Numbered> numbered;
  numbered.reserve(numbers.size());
  for (const Point_id id : numbers) {
    numbered.emplace_back(Kernel::Point_2(places[id].x, places[id].y), id);
  }
  const auto place_of = [](const Numbered& n) -> const Kernel::Point_2& { return n.first; };
  sort_for_insertion(numbered, Kernel(), place_of);
  insert_in_order(triangulation, numbered, place_of,
                  [](Vertex_handle v, const Numbered& n) { v->info() = n.second; });
  triangulation.infinite_vertex()->info() = no_point;
}

// Whether the circumcircle of a triangle is inside a cell, up to rounding.
bool is_circle_inside(const Triangulation& triangulation, Face_handle face,
                      const Kd_cells::Cell& cell) {
  const Kernel::Point_2 center = triangulation.dual(face);
  const Kernel::Point_2& corner = face->vertex(0)->point();
  const double radius = std::sqrt(CGAL::squared_distance(center, corner));
  return center.x() - radius > cell.least.x && center.x() + radius < cell.greatest.x &&
         center.y() - radius > cell.least.y && center.y() + radius < cell.greatest.y;
}

// The triangulation of a cell.
struct Part {
  const Kd_cells::Cell* cell = nullptr;
  std::vector<Point_id> numbers = {};  // of the positions in the cell
  std::vector<Point_id> order = {};
  std::vector<Face> faces = {};  // with circumcircle in the cell; neighbors are indices of `faces`
  std::vector<Point_id> border = {};  // vertices of the other faces, sorted
};

void triangulate(std::span<const Vector_2> places, Part& part) {
  Triangulation triangulation;
  insert(places, part.numbers, triangulation);
  for (const Vertex_handle v : triangulation.finite_vertex_handles()) {
    part.order.push_back(v->info());
  }
  if (triangulation.dimension() < 2) {
    part.border = part.order;
    std::ranges::sort(part.border);
    return;
  }
  std::uint32_t count = 0;
  for (const Face_handle face : triangulation.finite_face_handles()) {
    if (is_circle_inside(triangulation, face, *part.cell)) face->info().here = count++;
  }
  part.faces.reserve(count);
  for (const Face_handle face : triangulation.all_face_handles()) {
    if (face->info().here != no_face) {
      part.faces.push_back(as_plain(face));
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      if (!triangulation.is_infinite(face->vertex(i))) {
        part.border.push_back(face->vertex(i)->info());
      }
    }
  }
  std::ranges::sort(part.border);
  part.border.erase(std::unique(part.border.begin(), part.border.end()), part.border.end());
}

// The triangulation of the border. Its faces that faces of cells do not cover are part of the
// result.
class Border {
 public:
  // Returns whether there are triangles.
  bool triangulate(std::span<const Vector_2> places, std::span<const Point_id> numbers) {
    insert(places, numbers, triangulation_);
    for (const Vertex_handle v : triangulation_.finite_vertex_handles()) {
      vertices_.emplace(v->info(), v);
    }
    return triangulation_.dimension() == 2;
  }

  // Links the face f of a cell to the face of the border beyond its side i. Returns whether the
  // side is an edge of the border.
  bool put_beside(const Face& face, std::uint32_t f, std::size_t i) {
    Face_handle here;
    int k = 0;
    // The face here has the edge in the other direction.
    if (!triangulation_.is_edge(vertices_.at(face.vertices[(i + 2) % 3]),
                                vertices_.at(face.vertices[(i + 1) % 3]), here, k)) {
      return false;
    }
    if (here->vertex(Triangulation::ccw(k))->info() != face.vertices[(i + 2) % 3]) {
      std::tie(here, k) = triangulation_.mirror_edge({here, k});
    }
    here->info().beyond[static_cast<std::size_t>(k)] = f;
    sides_.emplace_back(here, k);
    return true;
  }

  // Appends the faces that faces of cells do not cover, and links both. Returns whether none
  // overlap.
  bool append_to(std::vector<Face>& faces) {
    std::vector<Face_handle> found;
    const auto find = [&](Face_handle face) {
      if (face->info().here != no_face) return;
      face->info().here = static_cast<std::uint32_t>(faces.size() + found.size());
      found.push_back(face);
    };
    find(triangulation_.infinite_face());
    for (const auto& [face, k] : sides_) find(face);
    for (std::size_t next = 0; next < found.size(); ++next) {
      for (int k = 0; k < 3; ++k) {
        if (beyond(found[next], k) == no_face) find(found[next]->neighbor(k));
      }
    }
    for (const auto& [face, k] : sides_) {
      if (face->neighbor(k)->info().here != no_face) return false;
    }
    for (const Face_handle face : found) {
      Face& plain = faces.emplace_back(as_plain(face));
      for (int k = 0; k < 3; ++k) {
        if (beyond(face, k) != no_face)
          plain.neighbors[static_cast<std::size_t>(k)] = beyond(face, k);
      }
    }
    for (const auto& [face, k] : sides_) {
      Face& other = faces[beyond(face, k)];
      std::size_t i = 0;
      while (other.vertices[(i + 1) % 3] != face->vertex(Triangulation::cw(k))->info()) ++i;
      other.neighbors[i] = face->info().here;
    }
    return true;
  }

 private:
  static std::uint32_t beyond(Face_handle face, int k) {
    return face->info().beyond[static_cast<std::size_t>(k)];
  }

  Triangulation triangulation_;
  std::unordered_map<Point_id, Vertex_handle> vertices_;
  std::vector<Triangulation::Edge> sides_;  // with faces of cells beyond them
};

std::vector<Part> parts_of(std::span<const Vector_2> places, const Kd_cells& cells) {
  std::vector<Part> parts;
  for (const Kd_cells::Cell& cell : cells.cells()) parts.push_back({&cell});
  for (std::size_t id = 0; id < places.size(); ++id) {
    parts[cells.cell_of(places[id])].numbers.push_back(static_cast<Point_id>(id));
  }
  return parts;
}

}  // namespace

Static_delaunay static_delaunay_by_cells(std::span<const Vector_2> places, std::size_t cells) {
  std::vector<Vector_2> sample;
  const std::size_t step = Kd_cells::sample_step(places.size(), cells);
  for (std::size_t k = 0; k < places.size(); k += step) sample.push_back(places[k]);
  const Kd_cells plane(std::move(sample), cells);
  std::vector<Part> parts = parts_of(places, plane);
  for_each_in_parallel(parts, [&](Part& part) { triangulate(places, part); });
  Static_delaunay result;
  std::vector<Point_id> on_border;
  for (const Part& part : parts) {
    result.order.insert(result.order.end(), part.order.begin(), part.order.end());
    on_border.insert(on_border.end(), part.border.begin(), part.border.end());
    const auto first = static_cast<std::uint32_t>(result.faces.size());
    for (Face face : part.faces) {
      for (std::uint32_t& neighbor : face.neighbors) {
        if (neighbor != no_face) neighbor += first;
      }
      result.faces.push_back(face);
    }
  }
  Border border;
  if (on_border.size() > places.size() / 2 || !border.triangulate(places, on_border)) return {};
  for (std::uint32_t f = 0; f < result.faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (result.faces[f].neighbors[i] == no_face && !border.put_beside(result.faces[f], f, i)) {
        return {};
      }
    }
  }
  if (!border.append_to(result.faces)) return {};
  // With the infinite vertex, all positions are vertices if and only if there are 2 n - 2 faces
  // (Euler).
  if (result.faces.size() + 2 != 2 * places.size()) return {};
  return result;
}

}  // namespace kinetri::detail
