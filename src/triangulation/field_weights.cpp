// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/field_weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kinetic/rounded_places.h"

namespace kinetri::detail {
namespace {

double dot(const Vector_2& v, const Vector_2& w) {
  return v.x * w.x + v.y * w.y;
}

// A power of two to scale vectors of that size by, so that products of coordinates neither overflow
// nor underflow.
double power_of_two_for(double size) {
  int exponent = 0;
  if (size > 0) std::frexp(size, &exponent);
  return std::ldexp(1.0, std::clamp(-exponent, -1020, 1020));
}

Vector_2 scaled(const Vector_2& v, double factor) {
  return {factor * v.x, factor * v.y};
}

// The weight of `q` at the point of the segment pq nearest to the origin; zero if p and q are
// equal.
double share_on_segment(const Vector_2& p, const Vector_2& q) {
  const Vector_2 along = difference(q, p);
  const double length = square(along);
  return length > 0 ? std::clamp(-dot(p, along) / length, 0.0, 1.0) : 0.0;
}

template <std::size_t N>
void divide_by_sum(std::span<double, N> weights) {
  double sum = 0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w /= sum;
}

}  // namespace

std::array<double, 3> barycentric_weights_of_any(const std::array<Vector_2, 3>& corners,
                                                 const Vector_2& place) {
  std::array<Vector_2, 3> from;
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = difference(corners[i], place);
    size = std::max(size, size_of(from[i]));
  }
  // Powers of two change no quotient.
  const double factor = power_of_two_for(size);
  for (Vector_2& v : from) v = scaled(v, factor);
  std::array<double, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] = std::max(cross(from[(i + 1) % 3], from[(i + 2) % 3]), 0.0);
  }
  if (weights[0] + weights[1] + weights[2] > 0) {
    divide_by_sum(std::span(weights));
    return weights;
  }
  // The corner opposite the longest side.
  std::size_t opposite = 0;
  double longest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = square(difference(from[(i + 2) % 3], from[(i + 1) % 3]));
    if (length > longest) {
      longest = length;
      opposite = i;
    }
  }
  const std::size_t p = (opposite + 1) % 3;
  const std::size_t q = (opposite + 2) % 3;
  const double share = share_on_segment(from[p], from[q]);
  weights[opposite] = 0;
  weights[p] = 1 - share;
  weights[q] = share;
  return weights;
}

void laplace_weights(std::span<const Vector_2> neighbors, const Vector_2& place,
                     std::span<double> weights) {
  const std::size_t n = neighbors.size();
  double size = 0;
  for (const Vector_2& p : neighbors) size = std::max(size, size_of(difference(p, place)));
  const double factor = power_of_two_for(size);
  const auto from = [&](std::size_t i) { return scaled(difference(neighbors[i], place), factor); };
  const auto next = [&](std::size_t i) { return i + 1 < n ? i + 1 : 0; };
  const auto use_side = [&](std::size_t i) {
    std::ranges::fill(weights, 0.0);
    const double share = share_on_segment(from(i), from(next(i)));
    weights[i] = 1 - share;
    weights[next(i)] = share;
  };

  // The side of the position's cell that faces a neighbor p, divided by the distance of p, is the
  // sum of the cotangents at the two corners opposite to the segment from the position to p; times
  // one half, which the sum of the weights removes.
  std::ranges::fill(weights, 0.0);
  std::size_t nearest_side = 0;
  double least_area = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector_2 p = from(i);
    const Vector_2 q = from(next(i));
    const Vector_2 side = difference(q, p);
    const double area = cross(p, q);
    if (i == 0 || area < least_area) {
      least_area = area;
      nearest_side = i;
    }
    weights[i] += dot(q, side) / area;
    weights[next(i)] -= dot(p, side) / area;
  }
  double sum = 0;
  for (double& w : weights) {
    w = std::max(w, 0.0);
    sum += w;
  }
  // Division by a smaller area might overflow.
  if (!(least_area > 0x1p-500) || !(sum > 0)) return use_side(nearest_side);
  divide_by_sum(weights);
}

}  // namespace kinetri::detail
