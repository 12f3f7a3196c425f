// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/detail/static_delaunay.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

#include "kinetri/kinetic/rounded_places.h"
#include "kinetri/triangulation/detail/parallel.h"

namespace kinetri::detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<
                CGAL::Triangulation_vertex_base_with_info_2<Point_id, Kernel>,
                CGAL::Triangulation_face_base_with_info_2<std::uint32_t, Kernel>>>;

}  // namespace

Static_delaunay static_delaunay(std::span<const Vector_2> places) {
  std::vector<std::pair<Kernel::Point_2, Point_id>> points;
  points.reserve(places.size());
  for (const Vector_2& place : places) {
    points.emplace_back(Kernel::Point_2(place.x, place.y), static_cast<Point_id>(points.size()));
  }
  Triangulation triangulation;
  triangulation.insert(points.begin(), points.end());
  if (triangulation.number_of_vertices() != places.size() || triangulation.dimension() < 2) {
    return {};
  }
  triangulation.infinite_vertex()->info() = no_point;
  Static_delaunay result;
  result.order.reserve(places.size());
  for (const auto vertex : triangulation.finite_vertex_handles()) {
    result.order.push_back(vertex->info());
  }
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

bool is_certainly_delaunay(const Static_delaunay& triangulation, std::span<const Vector_2> places,
                           double error) {
  using Face = Static_delaunay::Face;
  const std::vector<Face>& faces = triangulation.faces;
  const auto is_infinite = [](const Face& face) {
    return std::ranges::find(face.vertices, no_point) != face.vertices.end();
  };
  const auto is_certain = [&](std::uint32_t f) {
    const Face& face = faces[f];
    if (is_infinite(face)) return true;
    const auto& [p, q, r] = face.vertices;
    if (certain_orientation(places[p], places[q], places[r], error) != CGAL::POSITIVE) return false;
    for (const std::uint32_t g : face.neighbors) {
      const Face& beyond = faces[g];
      if (g < f || is_infinite(beyond)) continue;
      const auto opposite = std::ranges::find(beyond.neighbors, f) - beyond.neighbors.begin();
      const Point_id s = beyond.vertices[static_cast<std::size_t>(opposite)];
      if (certain_side_of_oriented_circle(places[p], places[q], places[r], places[s], error) !=
          CGAL::NEGATIVE) {
        return false;
      }
    }
    return true;
  };
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
