// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;
using Motions = std::vector<Linear_motion_2>;

// The user and system time of this process.
double processor_seconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Seconds {
  double wall = 0;
  double processor = 0;
  std::size_t events = 0;
};

template <class Make>
Seconds run(const Make& make, double until, std::size_t threads) {
  auto kinetic = make();
  kinetic.set_threads(threads);
  const double before = processor_seconds();
  const Stopwatch watch;
  const std::size_t events = kinetic.advance_to(Algebraic_number(until));
  return {watch.seconds(), processor_seconds() - before, events};
}

template <class Make>
json compare(const Make& make, double until) {
  constexpr int rounds = 3;
  std::vector<double> wall;
  std::vector<double> processor;
  Seconds one;
  Seconds all;
  for (int round = 0; round < rounds; ++round) {
    one = run(make, until, 1);
    all = run(make, until, 0);
    wall.push_back(ratio(all.wall, one.wall));
    processor.push_back(ratio(all.processor, one.processor));
  }
  return {{"until", until},
          {"events", one.events},
          {"one_thread_seconds", one.wall},
          {"wall_ratio", median(wall)},
          {"processor_ratio", median(processor)}};
}

// Two long rows, of which one moves along the other.
Motions rows(std::size_t points) {
  Motions result;
  for (std::size_t k = 0; k < points; ++k) {
    const bool is_upper = k % 2 == 1;
    result.push_back({{5.0 * static_cast<double>(k) + (is_upper ? 1.3 : 0), is_upper ? 8.0 : 0.0},
                      {is_upper ? 3.0 : 0.0, 0}});
  }
  return result;
}

// Dense groups that move apart and through each other.
Motions clusters(std::size_t points, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0, 1);
  constexpr std::size_t groups = 7;
  std::array<Vector_2, groups> centers;
  for (Vector_2& center : centers) center = {2000 * normal(random), 2000 * normal(random)};
  Motions result;
  for (std::size_t k = 0; k < points; ++k) {
    const Vector_2& center = centers[k * k % groups];
    const double x = center.x + 50 * normal(random);
    const double y = center.y + 50 * normal(random);
    const double vx = normal(random);
    result.push_back({{x, y}, {vx, normal(random)}});
  }
  return result;
}

// One velocity for the points left of the middle, and one for the others.
Motions equal_velocities(Motions motions) {
  for (Linear_motion_2& m : motions) {
    const double side = 10 * std::sqrt(static_cast<double>(motions.size()));
    m.velocity = m.position.x < side / 2 ? Vector_2{1, 0.5} : Vector_2{-1, 0.25};
  }
  return motions;
}

Motions of(const Setup& setup, Scenario scenario) {
  Scenario_options options = setup.options;
  options.jitter = 0.2;
  return make_scenario(scenario, options);
}

}  // namespace

json measure_threads(const Setup& setup) {
  std::mt19937_64 random(setup.options.seed);
  const auto n = static_cast<double>(setup.options.points);
  const double side = setup.options.spacing * std::ceil(std::sqrt(n));
  const Motions lattice = of(setup, Scenario::lattice);
  const Motions jitter = of(setup, Scenario::lattice_jitter);
  const Motions uniform = of(setup, Scenario::uniform);
  json result;
  const auto points = [&](const std::string& name, const Motions& motions, double until) {
    result[name] = compare([&] { return Kinetic_delaunay_triangulation_2<>(motions); }, until);
  };
  const auto discs = [&](const std::string& name, const Motions& motions,
                         const Collision_response& response, double radius) {
    Simulation_options options;
    options.box = Box_2{-5, -5, side - 5, side - 5};
    options.response = response;
    options.radius = radius;
    result[name] = compare([&] { return Simulation_2<Linear_kinetic_traits_2>(motions, options); },
                           setup.until);
  };
  points("uniform", uniform, setup.until);
  points("lattice", lattice, setup.until / 5);
  points("rows", rows(setup.options.points), setup.until);
  points("clusters", clusters(setup.options.points, random), setup.until);
  points("equal velocities", equal_velocities(uniform), setup.until);
  discs("discs at random, elastic", jitter, collide_elastically, 2);
  discs("discs on a lattice, elastic", lattice, collide_elastically, 2);
  discs("discs on a lattice, remove", lattice, erase_both, 2);
  discs("discs on a lattice, log", lattice, log_contact, 2);
  return result;
}

}  // namespace kinetri::bench
