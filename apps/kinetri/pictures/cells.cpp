// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/cells.h"

#include <cmath>

#include "pictures/polygon_clipping.h"

namespace kinetri::app {
namespace {

// The part of a convex polygon in which the power of a is at most that of b.
std::vector<Vector_2> nearer_part(const std::vector<Vector_2>& polygon, const Recorded_place& a,
                                  const Recorded_place& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  return part_inside(polygon, [&](const Vector_2& p) {  // positive where a is nearer
    return dx * dx + dy * dy - (b.weight - a.weight) - 2 * (dx * (p.x - a.x) + dy * (p.y - a.y));
  });
}

// The area of a counterclockwise polygon, computed relative to its first corner.
double area_of(const std::vector<Vector_2>& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vector_2& origin = polygon[0];
    const Vector_2& p = polygon[i - 1];
    const Vector_2& q = polygon[i];
    twice += (p.x - origin.x) * (q.y - origin.y) - (q.x - origin.x) * (p.y - origin.y);
  }
  return twice / 2;
}

// The corners of the cell in order; none if it is unbounded.
std::vector<Vector_2> corners_of(const Playback& playback, const Places& places, Point_id id,
                                 const std::vector<Periodic_image>& neighbors) {
  std::vector<Vector_2> result;
  Periodic_image q = neighbors.front();
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    const Periodic_image r = playback.apex({id, {}}, q);
    if (r.id == no_point) return {};
    result.push_back(power_center(places[id], places.image(id, q), places.image(id, r)));
    if (!std::isfinite(result.back().x) || !std::isfinite(result.back().y)) return {};
    q = r;
  }
  return result;
}

bool is_within(const std::vector<Vector_2>& corners, const Box_2& box) {
  for (const Vector_2& p : corners) {
    if (p.x < box.xmin || p.y < box.ymin || p.x > box.xmax || p.y > box.ymax) return false;
  }
  return true;
}

}  // namespace

Vector_2 power_center(const Recorded_place& a, const Recorded_place& b, const Recorded_place& c) {
  const double ux = b.x - a.x;
  const double uy = b.y - a.y;
  const double vx = c.x - a.x;
  const double vy = c.y - a.y;
  const double u = ux * ux + uy * uy - (b.weight - a.weight);
  const double v = vx * vx + vy * vy - (c.weight - a.weight);
  const double d = 2 * (ux * vy - uy * vx);
  return {a.x + (vy * u - uy * v) / d, a.y + (ux * v - vx * u) / d};
}

std::vector<Cell> cells(const Playback& playback, const Places& places,
                        const std::optional<Box_2>& box) {
  std::vector<std::vector<Periodic_image>> neighbors(places.size());
  for (const auto& [ids, offset] : playback.edges()) {
    neighbors[ids[0]].push_back({ids[1], offset});
    neighbors[ids[1]].push_back({ids[0], offset_between(offset, {})});
  }
  std::vector<Cell> result(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Recorded_place& place = places[i];
    Cell& cell = result[i];
    cell.degree = neighbors[i].size();
    if (!place.is_there || place.is_hidden) continue;
    if (cell.degree > 0) {
      cell.corners = corners_of(playback, places, static_cast<Point_id>(i), neighbors[i]);
    }
    if (box && (cell.corners.empty() || !is_within(cell.corners, *box))) {
      cell.corners = {{box->xmin, box->ymin},
                      {box->xmax, box->ymin},
                      {box->xmax, box->ymax},
                      {box->xmin, box->ymax}};
      for (const Periodic_image& other : neighbors[i]) {
        cell.corners = nearer_part(cell.corners, place, places[other.id]);
      }
    }
    if (cell.corners.size() > 2) cell.area = area_of(cell.corners);
  }
  const std::vector<std::size_t> coincident = playback.numbers_of_coincident();
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i].degree += coincident[i];
    result[i].area /= static_cast<double>(1 + coincident[i]);
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Point_id shown = playback.shown(static_cast<Point_id>(i));
    if (shown == i) continue;
    result[i].degree = 1;
    result[i].area = result[shown].area;
  }
  return result;
}

}  // namespace kinetri::app
