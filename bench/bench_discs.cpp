// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench_discs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace kinetri::bench {
namespace {

// After so many positions for one disc there is probably no free area.
constexpr int most_trials = 1'000'000;

// The motions of the setup's lattice, with the square of its cells as the box.
Bench_discs without_radii(const Setup& setup) {
  Bench_discs result;
  result.motions = setup.motions();
  const double spacing = setup.options.spacing;
  const double side = spacing * std::ceil(std::sqrt(static_cast<double>(result.motions.size())));
  result.box = {-spacing / 2, -spacing / 2, side - spacing / 2, side - spacing / 2};
  return result;
}

// Whether disc `i` certainly overlaps no disc before it.
bool is_apart(const Bench_discs& discs, std::size_t i) {
  const Vector_2& place = discs.motions[i].position;
  for (std::size_t j = 0; j < i; ++j) {
    const double x = discs.motions[j].position.x - place.x;
    const double y = discs.motions[j].position.y - place.y;
    const double contact = discs.radii[j] + discs.radii[i];
    // The margin exceeds rounding errors. The simulation refuses overlapping discs exactly.
    if (x * x + y * y < (1 + 0x1p-40) * (contact * contact)) return false;
  }
  return true;
}

}  // namespace

Bench_discs equal_discs(const Setup& setup) {
  Bench_discs result = without_radii(setup);
  result.radii.assign(result.motions.size(),
                      setup.options.spacing * std::sqrt(setup.area_fraction / std::numbers::pi));
  return result;
}

Bench_discs discs_of_different_sizes(const Setup& setup) {
  Bench_discs result = without_radii(setup);
  const auto n = static_cast<double>(result.motions.size());
  double area = 0;
  for (std::size_t i = 0; i < result.motions.size(); ++i) {
    const double share = static_cast<double>(i) / (n - 1);
    const double radius = 1 / ((1 - share) / *setup.size_ratio + share);
    result.radii.push_back(radius);
    area += std::numbers::pi * radius * radius;
  }
  const double side = result.box.xmax - result.box.xmin;
  const double unit = side * std::sqrt(setup.area_fraction / area);
  for (double& radius : result.radii) radius *= unit;

  std::mt19937_64 random(setup.options.seed);
  const auto below_side = [&] { return side * static_cast<double>(random() >> 11U) * 0x1p-53; };
  for (std::size_t i = 0; i < result.motions.size(); ++i) {
    int trials = 0;
    do {
      if (++trials > most_trials) {
        throw std::runtime_error("there is no room for the discs; expected a smaller share");
      }
      const double x = result.box.xmin + below_side();
      result.motions[i].position = {x, result.box.ymin + below_side()};
    } while (!is_apart(result, i));
  }
  return result;
}

}  // namespace kinetri::bench
