// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>
#include <voro++/voro++.hh>

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;
using Periodic = Kinetic_delaunay_triangulation_2<Periodic_kinetic_traits_2>;

constexpr double step_lengths[] = {0.01, 0.1, 0.3};  // of a step, in distances of neighbors
constexpr int timed_steps = 2;

// The number of neighbors of all points by voro++, in a layer as thick as a neighbor is far: the
// cells of a plane are prisms then, whose other two faces are walls. freud does the same.
std::size_t neighbors_by_voro(const std::vector<Vector_2>& places, double side) {
  const int blocks = static_cast<int>(side / (2 * neighbor_distance)) + 1;
  voro::container cells(0, side, 0, side, -neighbor_distance / 2, neighbor_distance / 2, blocks,
                        blocks, 1, true, true, false, 8);
  int id = 0;
  for (const Vector_2& place : places) cells.put(id++, place.x, place.y, 0);
  voro::c_loop_all loop(cells);
  voro::voronoicell_neighbor cell;
  std::vector<int> neighbors;
  std::size_t result = 0;
  if (!loop.start()) return result;
  do {
    if (!cells.compute_cell(cell, loop)) continue;
    cell.neighbors(neighbors);
    for (const int neighbor : neighbors) result += neighbor >= 0 ? 1U : 0U;
  } while (loop.inc());
  return result;
}

// Each point goes on by a random step. Kinetri knows the edges after it by the events on the way,
// and another one by repair.
json measure_moves(const Setup& setup, double side, double length, std::mt19937_64& random) {
  const Periodic_kinetic_traits_2 traits({{{side, 0}, {0, 0}}, {{0, side}, {0, 0}}});
  const std::vector<Linear_motion_2> motions = setup.motions();
  Periodic through(motions, 0, traits);
  Periodic repaired(motions, 0, traits);
  std::vector<Vector_2> places;
  for (const Linear_motion_2& motion : motions) places.push_back(motion.position);
  std::normal_distribution<double> shift(0, length * neighbor_distance / std::sqrt(2.0));
  double events = 0;
  double repairs = 0;
  double voro = 0;
  std::size_t different = 0;
  for (int step = 0; step <= timed_steps; ++step) {
    for (Vector_2& place : places) place = {place.x + shift(random), place.y + shift(random)};
    const auto seconds = [&](const auto& work, double& sum) {
      const Stopwatch watch;
      const std::size_t result = work();
      if (step > 0) sum += watch.seconds();
      return result;
    };
    const auto edges_through = [&] {
      through.advance_through(places, 1.0);
      return through.periodic_edges().size();
    };
    const auto edges_repaired = [&] {
      repaired.set_positions(places);
      return repaired.periodic_edges().size();
    };
    const std::size_t known = seconds(edges_through, events);
    different += seconds(edges_repaired, repairs) == known ? 0U : 1U;
    const std::size_t found = seconds([&] { return neighbors_by_voro(places, side); }, voro);
    different += found == 2 * known ? 0U : 1U;
  }
  return {{"events_seconds", events / timed_steps},
          {"repair_seconds", repairs / timed_steps},
          {"voro_seconds", voro / timed_steps},
          {"voro_over_events", ratio(voro, events)},
          {"voro_over_repair", ratio(voro, repairs)},
          {"steps_with_other_numbers_of_neighbors", different}};
}

}  // namespace

json measure_periodic_steps(const Setup& setup) {
  double side = 0;
  for (const Linear_motion_2& m : setup.motions()) {
    side = std::max({side, m.position.x, m.position.y});
  }
  std::mt19937_64 random(setup.options.seed);
  json result = json::array();
  for (const double length : step_lengths) {
    json setting = median_round([&] { return measure_moves(setup, side, length, random); });
    setting["length"] = length;
    result.push_back(std::move(setting));
  }
  return {{"settings", std::move(result)}};
}

}  // namespace kinetri::bench
