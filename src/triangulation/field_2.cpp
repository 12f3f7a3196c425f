// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/field_2.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "kinetic/rounded_places.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "triangulation/field_present.h"
#include "triangulation/field_raster.h"
#include "triangulation/field_weights.h"

namespace kinetri {
namespace {

using detail::Present;
using detail::Raster;

double rounded_value(const Linear_value& v, double t) {
  return v.value + v.slope * (t - v.epoch);
}

// The values of vertices at the current time, by channel: those of the point or, if points coincide
// for a while, the mean of theirs.
template <class Traits>
class Vertex_values {
 public:
  // Keeps references to both.
  Vertex_values(const Kinetic_field_2<Traits>& field,
                const Kinetic_triangulation_2<Traits>& kinetic)
      : field_(field),
        kinetic_(kinetic),
        time_(kinetic.current_time().to_double()),
        may_coincide_(kinetic.number_of_hidden_points() > 0) {}

  // Precondition: the point has a vertex, and all points of that vertex have values (checked).
  void find(Point_id id, std::span<double> result) {
    find_of_point(id, result);
    if (!may_coincide_) return;
    const std::vector<Point_id> others = kinetic_.coincident_points(id);
    if (others.empty()) return;
    const std::size_t channels = result.size();
    const std::size_t count = 1 + others.size();
    of_points_.assign(result.begin(), result.end());
    of_points_.resize(count * channels);
    for (std::size_t i = 1; i < count; ++i) {
      find_of_point(others[i - 1], std::span(of_points_).subspan(i * channels, channels));
    }
    at_points_.resize(count);
    shares_.assign(count, 1 / static_cast<double>(count));
    for (std::size_t channel = 0; channel < channels; ++channel) {
      for (std::size_t i = 0; i < count; ++i) at_points_[i] = of_points_[i * channels + channel];
      result[channel] = detail::weighted_mean(at_points_, shares_);
    }
  }

 private:
  void find_of_point(Point_id id, std::span<double> result) const {
    const std::span<const Linear_value> values = field_.values(id);
    KINETRI_PRECONDITION(!values.empty(), "point " + std::to_string(id) + " has no values");
    for (std::size_t channel = 0; channel < values.size(); ++channel) {
      result[channel] = rounded_value(values[channel], time_);
    }
  }

  const Kinetic_field_2<Traits>& field_;
  const Kinetic_triangulation_2<Traits>& kinetic_;
  double time_;
  bool may_coincide_;
  std::vector<double> of_points_;  // by point, then by channel
  std::vector<double> at_points_;
  std::vector<double> shares_;
};

bool has_finite_numbers(const Linear_value& v) {
  return std::isfinite(v.value) && std::isfinite(v.slope) && std::isfinite(v.epoch);
}

void check_place(const Vector_2& place) {
  KINETRI_PRECONDITION(detail::size_of(place) <= detail::largest_coordinate,
                       "a position has a coordinate that is not finite or beyond 1e300");
}

// Checks a grid, and returns the number of its positions.
std::size_t check_grid(const Grid_2& grid, std::size_t channels) {
  const auto is_step = [](double step) { return std::isfinite(step) && step != 0; };
  KINETRI_PRECONDITION(is_step(grid.step.x) && is_step(grid.step.y),
                       "a step of a grid is zero or not finite");
  const std::size_t most = std::numeric_limits<std::size_t>::max() / channels;
  KINETRI_PRECONDITION(grid.columns == 0 || grid.rows <= most / grid.columns,
                       "a grid has too many positions");
  const std::size_t size = grid.rows * grid.columns;
  if (size > 0) {
    check_place(grid.origin);
    check_place(grid.place(grid.columns - 1, grid.rows - 1));
  }
  return size;
}

void check_size(std::size_t given, const Grid_2& grid, std::size_t channels) {
  const std::size_t expected = grid.rows * grid.columns * channels;
  KINETRI_PRECONDITION(given == expected,
                       "the result has " + std::to_string(given) + " elements; a grid of " +
                           std::to_string(grid.columns) + " x " + std::to_string(grid.rows) +
                           " positions with " + std::to_string(channels) + " channels needs " +
                           std::to_string(expected));
}

// Points and their weights at a position.
template <class Traits>
class Combination {
 public:
  using Vertex_handle = typename Present<Traits>::Vertex_handle;

  // For a position and its triangle.
  void find(Present<Traits>& present, typename Present<Traits>::Face_handle triangle,
            const Vector_2& position, Interpolation interpolation) {
    vertices_ = {triangle->vertex(0), triangle->vertex(1), triangle->vertex(2)};
    begin_with_least_id();
    if (interpolation == Interpolation::flat) {
      weights_.assign(3, 1.0 / 3);
      return;
    }
    const std::array<Vector_2, 3> corners = {
        present.place(vertices_[0]), present.place(vertices_[1]), present.place(vertices_[2])};
    if (interpolation == Interpolation::smooth &&
        std::ranges::find(corners, position) == corners.end()) {
      return find_smooth(present, triangle, position);
    }
    const std::array<double, 3> weights = detail::barycentric_weights(corners, position);
    weights_.assign(weights.begin(), weights.end());
  }

  const std::vector<Vertex_handle>& vertices() const { return vertices_; }
  const std::vector<double>& weights() const { return weights_; }

 private:
  // The result must not depend on the order of vertices in a face.
  void begin_with_least_id() {
    const auto least = std::ranges::min_element(
        vertices_, {}, [](Vertex_handle v) { return Present<Traits>::id(v); });
    std::rotate(vertices_.begin(), least, vertices_.end());
  }

  void find_smooth(Present<Traits>& present, typename Present<Traits>::Face_handle triangle,
                   const Vector_2& position) {
    present.find_neighbors(triangle, position, vertices_);
    begin_with_least_id();
    // Of neighbors with the same rounded position, which share one side of the cell, only the first
    // is kept.
    places_.clear();
    std::size_t kept = 0;
    for (const Vertex_handle v : vertices_) {
      const Vector_2 place = present.place(v);
      if (std::ranges::find(places_, place) != places_.end()) continue;
      places_.push_back(place);
      vertices_[kept++] = v;
    }
    vertices_.resize(kept);
    weights_.resize(kept);
    if (kept == 1) {
      weights_[0] = 1;
    } else {
      detail::laplace_weights(places_, position, weights_);
    }
  }

  std::vector<Vertex_handle> vertices_;
  std::vector<double> weights_;
  std::vector<Vector_2> places_;
};

}  // namespace

Vector_2 Grid_2::place(std::size_t column, std::size_t row) const {
  return {origin.x + static_cast<double>(column) * step.x,
          origin.y + static_cast<double>(row) * step.y};
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>) Kinetic_field_2<Traits>::Kinetic_field_2(
    const Triangulation& triangulation, std::size_t channels)
    : triangulation_(triangulation), channels_(channels) {
  KINETRI_PRECONDITION(channels > 0, "a field needs at least one channel");
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>) void Kinetic_field_2<Traits>::set_values(
    Point_id id, std::span<const Linear_value> values) {
  KINETRI_PRECONDITION(triangulation_.contains(id), "there is no point " + std::to_string(id));
  KINETRI_PRECONDITION(values.size() == channels_, "point " + std::to_string(id) + " is given " +
                                                       std::to_string(values.size()) +
                                                       " values; the field has " +
                                                       std::to_string(channels_) + " channels");
  KINETRI_PRECONDITION(std::ranges::all_of(values, has_finite_numbers),
                       "a value of point " + std::to_string(id) + " is not finite");
  if (is_set_.size() <= id) {
    is_set_.resize(triangulation_.next_id());
    values_.resize(is_set_.size() * channels_);
  }
  std::ranges::copy(values, values_.begin() + static_cast<std::ptrdiff_t>(id * channels_));
  is_set_[id] = true;
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>)
    std::span<const Linear_value> Kinetic_field_2<Traits>::values(Point_id id)
const {
  if (id >= is_set_.size() || !is_set_[id]) return {};
  return std::span(values_).subspan(id * channels_, channels_);
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>)
    std::optional<std::vector<double>> Kinetic_field_2<Traits>::at(const Vector_2& place,
                                                                   Interpolation interpolation)
const {
  check_place(place);
  Present<Traits> present(triangulation_);
  const auto triangle = present.triangle_at(place);
  if (triangle == typename Triangulation::Face_handle()) return std::nullopt;
  Combination<Traits> combination;
  combination.find(present, triangle, place, interpolation);
  std::vector<double> result(channels_);
  std::vector<double> at_points(combination.vertices().size());
  std::vector<double> of_vertices(at_points.size() * channels_);  // by vertex, then by channel
  Vertex_values<Traits> vertex_values(*this, triangulation_);
  for (std::size_t i = 0; i < at_points.size(); ++i) {
    vertex_values.find(Present<Traits>::id(combination.vertices()[i]),
                       std::span(of_vertices).subspan(i * channels_, channels_));
  }
  for (std::size_t channel = 0; channel < channels_; ++channel) {
    for (std::size_t i = 0; i < at_points.size(); ++i) {
      at_points[i] = of_vertices[i * channels_ + channel];
    }
    result[channel] = detail::weighted_mean(at_points, combination.weights());
  }
  return result;
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>) void Kinetic_field_2<Traits>::raster(
    const Grid_2& grid, Interpolation interpolation, std::span<double> result) const {
  check_grid(grid, channels_);
  check_size(result.size(), grid, channels_);
  if (result.empty()) return;

  // By id of those with a vertex, then by channel.
  std::vector<double> of_points(std::size_t{triangulation_.next_id()} * channels_);
  Vertex_values<Traits> vertex_values(*this, triangulation_);
  std::ranges::fill(result, std::numeric_limits<double>::quiet_NaN());
  for (Point_id id = 0; id < triangulation_.next_id(); ++id) {
    if (!triangulation_.contains(id) || triangulation_.is_hidden(id)) continue;
    vertex_values.find(id, std::span(of_points).subspan(id * channels_, channels_));
  }

  Present<Traits> present(triangulation_);
  present.round_all();
  const Raster<Traits> raster(present, grid);
  if (interpolation == Interpolation::linear) {
    std::vector<double> of_corners(3 * channels_);  // by channel
    raster.for_each_corner_weights(
        [&](const std::array<Point_id, 3>& corners) {
          for (std::size_t channel = 0; channel < channels_; ++channel) {
            for (std::size_t i = 0; i < 3; ++i) {
              of_corners[3 * channel + i] = of_points[corners[i] * channels_ + channel];
            }
          }
        },
        [&](std::size_t position, const std::array<double, 3>& weights) {
          for (std::size_t channel = 0; channel < channels_; ++channel) {
            result[position * channels_ + channel] =
                detail::weighted_mean(std::span(of_corners).subspan(3 * channel, 3), weights);
          }
        });
  } else {
    Combination<Traits> combination;
    std::vector<double> at_points;
    raster.for_each_triangle([&](std::size_t position, const Vector_2& place, auto triangle) {
      combination.find(present, triangle, place, interpolation);
      at_points.resize(combination.vertices().size());
      for (std::size_t channel = 0; channel < channels_; ++channel) {
        for (std::size_t i = 0; i < at_points.size(); ++i) {
          const Point_id id = Present<Traits>::id(combination.vertices()[i]);
          at_points[i] = of_points[id * channels_ + channel];
        }
        result[position * channels_ + channel] =
            detail::weighted_mean(at_points, combination.weights());
      }
    });
  }
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>) void find_corner_weights(
    const Kinetic_triangulation_2<Traits>& triangulation, const Grid_2& grid,
    std::span<Corner_weights> result) {
  check_grid(grid, 1);
  check_size(result.size(), grid, 1);
  std::ranges::fill(result, Corner_weights());
  if (result.empty()) return;
  Present<Traits> present(triangulation);
  present.round_all();
  std::array<Point_id, 3> of_triangle = {};
  Raster<Traits>(present, grid)
      .for_each_corner_weights(
          [&](const std::array<Point_id, 3>& corners) { of_triangle = corners; },
          [&](std::size_t position, const std::array<double, 3>& weights) {
            result[position] = {of_triangle, weights};
          });
}

template void find_corner_weights(const Kinetic_triangulation_2<Linear_kinetic_traits_2>&,
                                  const Grid_2&, std::span<Corner_weights>);
template void find_corner_weights(const Kinetic_triangulation_2<Polynomial_kinetic_traits_2>&,
                                  const Grid_2&, std::span<Corner_weights>);
template class Kinetic_field_2<Linear_kinetic_traits_2>;
template class Kinetic_field_2<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
