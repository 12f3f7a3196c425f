// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

constexpr double shares[] = {0, 0.01, 0.1, 0.5,
                             1};              // of the points whose velocities change at a step
constexpr double lengths[] = {0.01, 0.1, 1};  // of a step, in distances of neighbors
constexpr double jumps[] = {0.01, 0.1, 0.3};  // of all points, in distances of neighbors
constexpr int measured_steps = 2;

double mean_speed(const std::vector<Linear_motion_2>& motions) {
  double sum = 0;
  for (const auto& m : motions) sum += std::hypot(m.velocity.x, m.velocity.y);
  return sum / static_cast<double>(motions.size());
}

// Seconds per step of both ways, without the first step. Points may leave the square, so each round
// has a new triangulation.
json measure_round(const Setup& setup, double share, double duration, std::mt19937_64& random) {
  std::vector<Linear_motion_2> motions = setup.motions();
  std::vector<Point_id> all(motions.size());
  std::iota(all.begin(), all.end(), 0);
  const auto turning = std::lround(share * static_cast<double>(all.size()));
  Kinetic_delaunay_triangulation_2<> kinetic(motions);
  double kept = 0;
  double rebuilt = 0;
  double now = 0;
  for (int step = 0; step <= measured_steps; ++step) {
    std::vector<Point_id> ids;
    std::ranges::sample(all, std::back_inserter(ids), turning, random);
    Setup other = setup;
    other.options.seed = random();
    const std::vector<Linear_motion_2> velocities = other.motions();
    const double end = now + duration;

    const Stopwatch watch_kinetic;
    std::vector<Linear_motion_2> turned;
    for (const Point_id id : ids) {
      turned.push_back(with_velocity_at(kinetic.motion(id), velocities[id].velocity, now));
    }
    kinetic.set_motions(ids, turned);
    kinetic.advance_to(end);
    if (step > 0) kept += watch_kinetic.seconds();

    for (std::size_t i = 0; i < ids.size(); ++i) motions[ids[i]] = turned[i];
    const Stopwatch watch_static;
    const auto places = positions(motions, end);
    const Static_triangulation anew(places.begin(), places.end());
    if (step > 0) rebuilt += watch_static.seconds();
    now = end;
  }
  return {{"kinetic_seconds", kept / measured_steps},
          {"rebuild_seconds", rebuilt / measured_steps},
          {"kinetic_over_rebuild", ratio(kept, rebuilt)}};
}

// The same if all points jump to given positions, where they rest until the next step.
json measure_jumps(const Setup& setup, double length, std::mt19937_64& random) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  std::vector<Vector_2> places;
  for (const Linear_motion_2& motion : motions) places.push_back(motion.position);
  Kinetic_delaunay_triangulation_2<> kinetic(motions);
  std::normal_distribution<double> shift(0, length * neighbor_distance / std::sqrt(2.0));
  double kept = 0;
  double rebuilt = 0;
  for (int step = 0; step <= measured_steps; ++step) {
    std::vector<Static_kernel::Point_2> static_places;
    for (Vector_2& place : places) {
      place = {place.x + shift(random), place.y + shift(random)};
      static_places.emplace_back(place.x, place.y);
    }
    const Stopwatch watch_kinetic;
    kinetic.set_positions(places);
    if (step > 0) kept += watch_kinetic.seconds();
    const Stopwatch watch_static;
    const Static_triangulation anew(static_places.begin(), static_places.end());
    if (step > 0) rebuilt += watch_static.seconds();
  }
  return {{"kinetic_seconds", kept / measured_steps},
          {"rebuild_seconds", rebuilt / measured_steps},
          {"kinetic_over_rebuild", ratio(kept, rebuilt)}};
}

}  // namespace

json measure_steps(const Setup& setup) {
  const double speed = mean_speed(setup.motions());
  std::mt19937_64 random(setup.options.seed);
  json settings = json::array();
  for (const double share : shares) {
    for (const double length : lengths) {
      json setting = median_round(
          [&] { return measure_round(setup, share, length * neighbor_distance / speed, random); });
      setting["share"] = share;
      setting["length"] = length;
      settings.push_back(std::move(setting));
    }
  }
  json jumping = json::array();
  for (const double length : jumps) {
    json setting = median_round([&] { return measure_jumps(setup, length, random); });
    setting["length"] = length;
    jumping.push_back(std::move(setting));
  }
  return {{"settings", std::move(settings)}, {"positions", std::move(jumping)}};
}

}  // namespace kinetri::bench
