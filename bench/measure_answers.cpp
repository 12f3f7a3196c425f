// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Delaunay_triangulation_2.h>

#include <limits>
#include <stdexcept>

#include "kinetri/simulation/box_2.h"
#include "kinetri/triangulation/queries_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

double squared_distance(const Static_kernel::Point_2& p, const Static_kernel::Point_2& q) {
  return (p.x() - q.x()) * (p.x() - q.x()) + (p.y() - q.y()) * (p.y() - q.y());
}

// The least squared distance of `p` from another point, by comparing all.
double nearest_of_all(const std::vector<Static_kernel::Point_2>& points, std::size_t p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t q = 0; q < points.size(); ++q) {
    if (q != p) least = std::min(least, squared_distance(points[p], points[q]));
  }
  return least;
}

// Uses a result, so that the compiler does not remove its computation.
double sum_of(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double x : numbers) sum += x;
  return sum;
}

}  // namespace

json measure_answers(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  const double n = static_cast<double>(motions.size());
  Kinetic_delaunay_triangulation_2<> kinetic(motions);
  kinetic.advance_to(present);
  const Kinetic_queries_2 queries(kinetic);
  const Static_triangulation fixed = [&] {
    const auto places = positions(motions, present);
    return Static_triangulation(places.begin(), places.end());
  }();
  const auto points = positions(motions, present);
  Box_2 box = {points[0].x(), points[0].y(), points[0].x(), points[0].y()};
  for (const auto& p : points) {
    box = {std::min(box.xmin, p.x()), std::min(box.ymin, p.y()), std::max(box.xmax, p.x()),
           std::max(box.ymax, p.y())};
  }
  const double area = (box.xmax - box.xmin) * (box.ymax - box.ymin);
  const auto ids = static_cast<Point_id>(motions.size());
  return median_round([&]() -> json {
    json result;
    double sum = 0;
    const auto time_per_point = [&](const char* key, const auto& work) {
      const Stopwatch watch;
      work();
      result[key] = 1e9 * watch.seconds() / n;
    };
    time_per_point("rounded_cell_ns", [&] {
      for (Point_id id = 0; id < ids; ++id) {
        for (const Vector_2& v : queries.rounded_voronoi_cell(id).vertices) sum += v.x;
      }
    });
    const Point_id few = std::min<Point_id>(ids, 20);
    const Stopwatch exact_watch;
    for (Point_id id = 0; id < few; ++id) {
      sum += static_cast<double>(queries.voronoi_cell(id).vertices.size());
    }
    result["exact_cell_ns"] = 1e9 * exact_watch.seconds() / few;
    time_per_point("static_cell_ns", [&] {
      for (const auto v : fixed.finite_vertex_handles()) {
        auto face = fixed.incident_faces(v);
        const auto first = face;
        do {
          if (!fixed.is_infinite(face)) sum += fixed.dual(face).x();
        } while (++face != first);
      }
    });
    std::vector<double> areas;
    time_per_point("areas_ns", [&] { areas = queries.rounded_voronoi_areas(box.corners()); });
    if (std::abs(sum_of(areas) - area) > 1e-9 * area) {
      throw std::runtime_error("the areas of the cells do not sum to that of the box");
    }
    time_per_point("positions_ns", [&] { sum += queries.rounded_positions().back(); });
    time_per_point("rounded_place_ns", [&] {
      for (const Linear_motion_2& m : motions) sum += rounded_place(m, present).x;
    });
    std::vector<Point_id> nearest;
    time_per_point("nearest_neighbors_ns", [&] { nearest = queries.nearest_neighbors(); });
    const Stopwatch all_pairs_watch;
    for (Point_id id = 0; id < few; ++id) {
      const double least = nearest_of_all(points, id);
      if (squared_distance(points[id], points[nearest[id]]) > least * (1 + 1e-9)) {
        throw std::runtime_error("a nearest neighbor is not the nearest point");
      }
    }
    result["nearest_of_all_ns"] = 1e9 * all_pairs_watch.seconds() / few;
    const Point_id some = std::min<Point_id>(ids, 1000);
    const Stopwatch place_watch;
    for (Point_id id = 0; id < some; ++id) {
      const Static_kernel::Point_2& p = points[id];
      sum += *queries.nearest_vertex({0.5 * (p.x() + points[0].x()), p.y()});
    }
    result["nearest_vertex_ns"] = 1e9 * place_watch.seconds() / some;
    const Stopwatch pair_watch;
    sum += (*queries.closest_pair())[0];
    result["closest_pair_ms"] = 1e3 * pair_watch.seconds();
    if (sum == 0) throw std::runtime_error("no answer has a number");
    return result;
  });
}

}  // namespace kinetri::bench
