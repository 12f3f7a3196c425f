// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;
using Motions = std::vector<Linear_motion_2>;

// The motion of point k of n.
using Motion_of = std::function<Linear_motion_2(double k, double n)>;

const std::map<std::string, Motion_of>& kinds() {
  static const std::map<std::string, Motion_of> result = {
      {"line at rest",
       [](double k, double) {
         return Linear_motion_2{{k, 0}, {}};
       }},
      {"vertical line",
       [](double k, double) {
         return Linear_motion_2{{0, k}, {}};
       }},
      {"line aslant",
       [](double k, double) {
         return Linear_motion_2{{k, 3 * k}, {}};
       }},
      {"line apart along itself",
       [](double k, double) {
         return Linear_motion_2{{k, 2 * k}, {k, 2 * k}};
       }},
      {"line of equal velocities",
       [](double k, double) {
         return Linear_motion_2{{k, 0}, {1, 2}};
       }},
      {"line and one point beside it",
       [](double k, double n) {
         return Linear_motion_2{{k, k == n / 2 ? 1.0 : 0.0}, {}};
       }},
      {"two lines",
       [](double k, double) {
         return Linear_motion_2{{k, std::fmod(k, 2.0)}, {0, 0}};
       }},
      {"line that bends",
       [](double k, double n) {
         return Linear_motion_2{{k, 0}, {0, k * k / (n * n)}};
       }},
      {"circle",
       [](double k, double n) {
         const double angle = 2 * std::numbers::pi * k / n;
         return Linear_motion_2{{std::cos(angle), std::sin(angle)}, {}};
       }},
      {"lattice",
       [](double k, double n) {
         const double side = std::ceil(std::sqrt(n));
         return Linear_motion_2{{std::fmod(k, side), std::floor(k / side)}, {}};
       }},
  };
  return result;
}

template <class Kinetic, class Motion>
double nanoseconds(const std::vector<Motion>& motions) {
  const Stopwatch watch;
  const Kinetic kinetic(motions);
  return 1e9 * watch.seconds() / static_cast<double>(motions.size());
}

}  // namespace

json measure_lines(const Setup& setup) {
  constexpr std::size_t least = 4096;
  if (setup.options.points < least) {
    throw std::runtime_error("the smallest start that is measured has " + std::to_string(least) +
                             " points; expected at least as many --points");
  }
  json result;
  for (const auto& [name, motion_of] : kinds()) {
    for (std::size_t n = least; n <= setup.options.points; n *= 4) {
      Motions motions;
      for (std::size_t k = 0; k < n; ++k) {
        motions.push_back(motion_of(static_cast<double>(k), static_cast<double>(n)));
      }
      std::ranges::shuffle(motions, std::mt19937_64(setup.options.seed));
      result[name][std::to_string(n)] = nanoseconds<Kinetic_delaunay_triangulation_2<>>(motions);
      if (name != "line at rest") continue;
      std::vector<Disc_motion_2> discs;
      for (const Linear_motion_2& m : motions) {
        discs.push_back({m, 0.25 + 0.125 * std::fmod(m.position.x, 3.0), 0, 0});
      }
      result["discs of a line"][std::to_string(n)] =
          nanoseconds<Kinetic_regular_triangulation_2<>>(discs);
    }
  }
  return result;
}

}  // namespace kinetri::bench
