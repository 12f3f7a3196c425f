// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/detail/static_delaunay.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

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

}  // namespace kinetri::detail
