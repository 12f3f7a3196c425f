// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/polygon_and_disc.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kinetri::detail {
namespace {

// Twice the signed area for the edge from `a` to `b`, in units of the squared radius.
double twice_area(const Vector_2& a, const Vector_2& b) {
  const Vector_2 d = {b.x - a.x, b.y - a.y};
  const double cross = a.x * d.y - a.y * d.x;
  const double squared_length = d.x * d.x + d.y * d.y;
  // The positions a + s d on the circle are those with squared_length s^2 + 2 half s + ... = 0.
  const double half = a.x * d.x + a.y * d.y;
  const double discriminant = squared_length - cross * cross;
  const auto sector = [&](double from, double to) {
    // The cross and the scalar product of a + from d and a + to d.
    const double dot = a.x * a.x + a.y * a.y + (from + to) * half + from * to * squared_length;
    return std::atan2((to - from) * cross, dot);
  };
  if (!(discriminant > 0)) return squared_length > 0 ? sector(0, 1) : 0;
  const double root = std::sqrt(discriminant);
  const double enter = std::clamp((-half - root) / squared_length, 0.0, 1.0);
  const double leave = std::clamp((-half + root) / squared_length, 0.0, 1.0);
  if (enter == leave) return sector(0, 1);
  return (enter > 0 ? sector(0, enter) : 0) + (leave - enter) * cross +
         (leave < 1 ? sector(leave, 1) : 0);
}

}  // namespace

double area_within_disc(std::span<const Vector_2> polygon, double radius) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector_2& v = polygon[i];
    const Vector_2& w = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    sum += twice_area({v.x / radius, v.y / radius}, {w.x / radius, w.y / radius});
  }
  return sum / 2 * radius * radius;
}

}  // namespace kinetri::detail
