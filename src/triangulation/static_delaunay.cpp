// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/static_delaunay.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "kinetic/rounded_places.h"
#include "kinetri/impl/triangulation/insertion_order.h"
#include "kinetri/impl/triangulation/parallel.h"

namespace kinetri::detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Face_base = CGAL::Triangulation_face_base_with_info_2<std::uint32_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<
                CGAL::Triangulation_vertex_base_with_info_2<Point_id, Kernel>, Face_base>>;
using Regular = CGAL::Regular_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<
                CGAL::Triangulation_vertex_base_with_info_2<
                    Point_id, Kernel, CGAL::Regular_triangulation_vertex_base_2<Kernel>>,
                CGAL::Regular_triangulation_face_base_2<Kernel, Face_base>>>;

using Numbered = std::pair<Kernel::Point_2, Point_id>;

constexpr auto set_number = [](auto vertex, const auto& numbered) {
  vertex->info() = numbered.second;
};

// The faces of the triangulation.
template <class Triangulation>
Static_delaunay plain(Triangulation& triangulation) {
  triangulation.infinite_vertex()->info() = no_point;
  Static_delaunay result;
  std::uint32_t number = 0;
  for (const auto face : triangulation.all_face_handles()) face->info() = number++;
  result.faces.reserve(number);
  for (const auto face : triangulation.all_face_handles()) {
    result.faces.push_back(
        {{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()},
         {face->neighbor(0)->info(), face->neighbor(1)->info(), face->neighbor(2)->info()}});
  }
  return result;
}

Static_delaunay static_regular(const Static_points& points) {
  std::vector<std::pair<Kernel::Weighted_point_2, Point_id>> weighted;
  weighted.reserve(points.places.size());
  for (const Vector_2& place : points.places) {
    const std::size_t i = weighted.size();
    weighted.emplace_back(
        Kernel::Weighted_point_2(Kernel::Point_2(place.x, place.y), points.weights[i]),
        static_cast<Point_id>(i));
  }
  Regular triangulation;
  const auto point_of = [](const auto& numbered) -> const Kernel::Point_2& {
    return numbered.first.point();
  };
  if (sort_for_insertion(weighted, Kernel(), point_of)) return {};
  insert_in_order(
      triangulation, weighted, [](const auto& numbered) { return numbered.first; }, set_number);
  if (triangulation.dimension() < 2 ||
      triangulation.number_of_vertices() + triangulation.number_of_hidden_vertices() !=
          weighted.size()) {
    return {};
  }
  Static_delaunay result = plain(triangulation);
  for (const auto vertex : triangulation.hidden_vertex_handles()) {
    result.hidden.emplace_back(vertex->info(), vertex->face()->info());
  }
  return result;
}

// Numbers the faces breadth first, so that near ones are near in memory, and stores their vertices
// in the order in which they come.
void sort_breadth_first(Static_delaunay& triangulation, std::size_t points) {
  const std::vector<Static_delaunay::Face>& faces = triangulation.faces;
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(faces.size(), none);
  std::vector<std::uint32_t> sorted;
  sorted.reserve(faces.size());
  const auto visit = [&](std::uint32_t face) {
    if (number[face] != none) return;
    number[face] = static_cast<std::uint32_t>(sorted.size());
    sorted.push_back(face);
  };
  visit(0);
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    for (const std::uint32_t neighbor : faces[sorted[k]].neighbors) visit(neighbor);
  }
  Static_delaunay result;
  result.faces.reserve(faces.size());
  std::vector<bool> is_listed(points);
  const auto list = [&](Point_id point) {
    if (point == no_point || is_listed[point]) return;
    is_listed[point] = true;
    result.order.push_back(point);
  };
  for (const std::uint32_t k : sorted) {
    Static_delaunay::Face& face = result.faces.emplace_back(faces[k]);
    for (std::uint32_t& neighbor : face.neighbors) neighbor = number[neighbor];
    for (const Point_id point : face.vertices) list(point);
  }
  for (const auto& [point, face] : triangulation.hidden) {
    list(point);
    result.hidden.emplace_back(point, number[face]);
  }
  triangulation = std::move(result);
}

Static_delaunay static_delaunay_of_all(const Static_points& points) {
  if (!points.weights.empty()) return static_regular(points);
  constexpr std::size_t points_per_cell = 16384;
  if (points.places.size() >= 2 * points_per_cell) {
    Static_delaunay by_cells =
        static_delaunay_by_cells(points.places, points.places.size() / points_per_cell);
    if (!by_cells.faces.empty()) return by_cells;
  }
  std::vector<Numbered> numbered;
  numbered.reserve(points.places.size());
  for (const Vector_2& place : points.places) {
    numbered.emplace_back(Kernel::Point_2(place.x, place.y),
                          static_cast<Point_id>(numbered.size()));
  }
  const auto point_of = [](const Numbered& point) -> const Kernel::Point_2& { return point.first; };
  if (sort_for_insertion(numbered, Kernel(), point_of)) return {};
  Delaunay triangulation;
  insert_in_order(triangulation, numbered, point_of, set_number);
  if (triangulation.number_of_vertices() != numbered.size() || triangulation.dimension() < 2) {
    return {};
  }
  return plain(triangulation);
}

}  // namespace

Static_delaunay static_delaunay(const Static_points& points) {
  Static_delaunay result = static_delaunay_of_all(points);
  if (!result.faces.empty()) sort_breadth_first(result, points.places.size());
  return result;
}

bool is_certainly_delaunay(const Static_delaunay& triangulation, const Static_points& points) {
  using Face = Static_delaunay::Face;
  const std::vector<Face>& faces = triangulation.faces;
  const auto is_infinite = [](const Face& face) {
    return std::ranges::find(face.vertices, no_point) != face.vertices.end();
  };
  const auto turn = [&](Point_id p, Point_id q, Point_id r) {
    return certain_orientation(points.places[p], points.places[q], points.places[r], points.error);
  };
  const auto side = [&](const Face& face, Point_id s) {
    const auto& [p, q, r] = face.vertices;
    const auto& places = points.places;
    const auto& weights = points.weights;
    if (weights.empty()) {
      return certain_side_of_oriented_circle(places[p], places[q], places[r], places[s],
                                             points.error);
    }
    return certain_side_of_oriented_circle(
        places[p], places[q], places[r], places[s], points.error,
        {{weights[p], weights[q], weights[r], weights[s]}, points.weight_error});
  };
  const auto is_certain = [&](std::uint32_t f) {
    const Face& face = faces[f];
    if (is_infinite(face)) return true;
    const auto& [p, q, r] = face.vertices;
    if (turn(p, q, r) != CGAL::POSITIVE) return false;
    for (const std::uint32_t g : face.neighbors) {
      const Face& beyond = faces[g];
      if (g < f || is_infinite(beyond)) continue;
      const auto opposite = std::ranges::find(beyond.neighbors, f) - beyond.neighbors.begin();
      if (side(face, beyond.vertices[static_cast<std::size_t>(opposite)]) != CGAL::NEGATIVE) {
        return false;
      }
    }
    return true;
  };
  const auto is_certainly_hidden = [&](const std::pair<Point_id, std::uint32_t>& hidden) {
    const Face& face = faces[hidden.second];
    const auto& [p, q, r] = face.vertices;
    const Point_id s = hidden.first;
    return turn(p, q, s) == CGAL::POSITIVE && turn(q, r, s) == CGAL::POSITIVE &&
           turn(r, p, s) == CGAL::POSITIVE && side(face, s) == CGAL::NEGATIVE;
  };
  if (!std::ranges::all_of(triangulation.hidden, is_certainly_hidden)) return false;
  struct Block {
    std::uint32_t first, last;
    bool are_certain = true;
  };
  constexpr std::uint32_t faces_per_block = 2048;
  const auto size = static_cast<std::uint32_t>(faces.size());
  std::vector<Block> blocks;
  for (std::uint32_t first = 0; first < size; first += std::min(faces_per_block, size - first)) {
    blocks.push_back({first, first + std::min(faces_per_block, size - first)});
  }
  for_each_in_parallel(blocks, [&](Block& block) {
    for (std::uint32_t f = block.first; f < block.last; ++f) {
      block.are_certain = block.are_certain && is_certain(f);
    }
  });
  return std::ranges::all_of(blocks, &Block::are_certain);
}

}  // namespace kinetri::detail
