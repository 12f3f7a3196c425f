// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/codec/point_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

namespace kinetri::video {
namespace {

// A position of a ring gets a point if none is within this fraction of the rings' spacing.
constexpr double ring_gap = 0.7;

// Fits a linear function to values by least squares, weighted by nearness to the origin.
class Plane_fit {
 public:
  void add(double x, double y, double value) {
    const double weight = 1 / (x * x + y * y);
    const std::array<double, 3> row = {1, x, y};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) matrix_[i][j] += weight * row[i] * row[j];
      right_[i] += weight * row[i] * value;
    }
  }

  // The value at the origin, by Cramer's rule; the mean if the positions are on a line.
  // Precondition: there is a value.
  double value() const {
    const auto& m = matrix_;
    const double a = m[1][1] * m[2][2] - m[1][2] * m[2][1];
    const double b = m[1][0] * m[2][2] - m[1][2] * m[2][0];
    const double c = m[1][0] * m[2][1] - m[1][1] * m[2][0];
    const double determinant = m[0][0] * a - m[0][1] * b + m[0][2] * c;
    if (!(determinant > 1e-6 * m[0][0] * m[1][1] * m[2][2])) return right_[0] / m[0][0];
    return (right_[0] * a - m[0][1] * (right_[1] * m[2][2] - m[1][2] * right_[2]) +
            m[0][2] * (right_[1] * m[2][1] - m[1][1] * right_[2])) /
           determinant;
  }

 private:
  std::array<std::array<double, 3>, 3> matrix_ = {};
  std::array<double, 3> right_ = {};
};

// The distance from the picture; inside, minus the distance from its border.
double distance_outside(const Stream_header& header, const Vector_2& p) {
  return std::max(std::max(-p.x, p.x - header.format.width),
                  std::max(-p.y, p.y - header.format.height));
}

}  // namespace

std::vector<Removable> removable_points(const Stream_header& header, std::size_t count,
                                        const std::vector<Present_points::Point>& points,
                                        std::span<const Corner_weights> weights,
                                        std::span<const Edge_ids> edges) {
  const std::size_t ids = points.back().id + std::size_t{1};
  std::vector<double> area(ids);
  for (const Corner_weights& here : weights) {
    for (std::size_t k = 0; k < 3; ++k) area[here.corners[k]] += here.weights[k];
  }
  std::vector<const Node*> nodes(ids);
  for (const auto& point : points) nodes[point.id] = &point.node;
  std::vector<Plane_fit> fits(ids);
  for (const auto& [a, b] : edges) {
    const double dx = nodes[b]->place.x - nodes[a]->place.x;
    const double dy = nodes[b]->place.y - nodes[a]->place.y;
    fits[a].add(dx, dy, nodes[b]->colors[0]);
    fits[b].add(-dx, -dy, nodes[a]->colors[0]);
  }
  const double unit = header.color_step / 8.0;
  const double spacing = ring_spacing(header, count);
  std::vector<Removable> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point_id id = points[i].id;
    // Points of the rings may enter the picture soon; points further outside are useless.
    const double outside = distance_outside(header, position_of(header, points[i].node.place));
    if (id < number_of_corners || (outside >= 0 && outside <= 4 * spacing)) continue;
    const double difference = (points[i].node.colors[0] - fits[id].value()) * unit;
    result.push_back({difference * difference * area[id], i});
  }
  std::ranges::stable_sort(result, {}, &Removable::worth);
  return result;
}

std::vector<Candidate> ring_gaps(const Stream_header& header, std::size_t count,
                                 const std::vector<Present_points::Point>& points) {
  std::vector<Candidate> result;
  if (header.margin == 0) return result;
  const double spacing = ring_spacing(header, count);
  std::vector<Vector_2> near;
  for (const auto& point : points) {
    const Vector_2 p = position_of(header, point.node.place);
    if (distance_outside(header, p) > -spacing) near.push_back(p);
  }
  for (const Place& place : ring_places(header, spacing)) {
    const Vector_2 p = position_of(header, place);
    const bool is_free = std::ranges::none_of(near, [&](const Vector_2& q) {
      return std::hypot(p.x - q.x, p.y - q.y) < ring_gap * spacing;
    });
    if (is_free) result.push_back({place, std::numeric_limits<double>::infinity()});
  }
  return result;
}

std::vector<Entering> entering_points(const Stream_header& header, std::size_t count,
                                      const std::vector<Present_points::Point>& points,
                                      const std::vector<std::optional<Place>>& targets) {
  const double width = header.format.width;
  const double height = header.format.height;
  const double side = std::max(1.25 * std::sqrt(width * height / static_cast<double>(count)), 2.0);
  const auto columns = static_cast<std::size_t>(std::max(std::floor(width / side), 1.0));
  const auto rows = static_cast<std::size_t>(std::max(std::floor(height / side), 1.0));
  std::vector<bool> is_covered(columns * rows);
  std::vector<Vector_2> places;
  std::vector<Vector_2> moves;
  std::set<Place> begins;
  for (std::size_t i = 0; i < points.size(); ++i) {
    begins.insert(points[i].node.place);
    if (i < number_of_corners || !targets[i]) continue;
    const Vector_2 from = position_of(header, points[i].node.place);
    const Vector_2 to = position_of(header, *targets[i]);
    places.push_back(to);
    moves.push_back({to.x - from.x, to.y - from.y});
    if (distance_outside(header, to) >= 0) continue;
    const auto column = static_cast<std::size_t>(to.x / width * static_cast<double>(columns));
    const auto row = static_cast<std::size_t>(to.y / height * static_cast<double>(rows));
    is_covered[row * columns + column] = true;
  }
  std::vector<Entering> result;
  for (std::size_t i = 0; i < is_covered.size() && !places.empty(); ++i) {
    if (is_covered[i]) continue;
    const Vector_2 to = {
        (static_cast<double>(i % columns) + 0.5) * width / static_cast<double>(columns),
        (static_cast<double>(i / columns) + 0.5) * height / static_cast<double>(rows)};
    const auto nearest = std::ranges::min_element(places, {}, [&](const Vector_2& p) {
      return (p.x - to.x) * (p.x - to.x) + (p.y - to.y) * (p.y - to.y);
    });
    const Vector_2& move = moves[static_cast<std::size_t>(nearest - places.begin())];
    const Vector_2 from = {to.x - move.x, to.y - move.y};
    if (distance_outside(header, from) <= 0) continue;
    if (distance_outside(header, from) >= header.margin) continue;
    const Entering point = {place_at(header, from), place_at(header, to)};
    if (begins.insert(point.begin).second) result.push_back(point);
  }
  return result;
}

}  // namespace kinetri::video
