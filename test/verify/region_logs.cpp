// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the logs of small runs by regions, forced to have many regions and short windows, for
// regions_test.py.
//
// usage: kinetri_region_logs FOLDER FIRST_SEED NUMBER
//
// For each seed: SEED.motions.csv, SEED.events.csv and SEED.edges.csv in the folder, and a line on
// standard output with the arguments that kinetri-verify takes there. Fails where more than one run
// in ten has had no window of time.
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "kinetri/io/edges_file.h"
#include "kinetri/io/event_log.h"
#include "kinetri/io/motion_log.h"
#include "kinetri/simulation/simulation_2.h"
#include "simulation/contact_events.h"
#include "support/region_runs.h"

namespace kinetri {
namespace {

using Simulation = Simulation_2<Linear_kinetic_traits_2>;

constexpr double spacing = 10;  // of the lattice on which points start
constexpr double until = 1.5;

// Points near those of a lattice, no nearer than `apart`; every third one with whole numbers on
// some seeds, so that several events have one time.
std::vector<Linear_motion_2> motions_of(std::size_t n, std::size_t columns, double apart,
                                        unsigned seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  std::vector<Linear_motion_2> result;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = spacing * static_cast<double>(k % columns) + apart / 2;
    const double y = spacing * static_cast<double>(k / columns) + apart / 2;
    const double free = spacing - apart;
    Linear_motion_2 motion = {{x + between(0, free), y + between(0, free)},
                              {between(-9, 9), between(-9, 9)}};
    if (seed % 4 == 3 && k % 3 == 0) {
      motion.position = {std::round(motion.position.x), std::round(motion.position.y)};
      motion.velocity = {std::round(motion.velocity.x), std::round(motion.velocity.y)};
    }
    result.push_back(motion);
  }
  return result;
}

// Returns whether the run has had a window.
bool write_run(const std::string& folder, unsigned seed) {
  const std::size_t n = 20 + 7 * (seed % 12);
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  const double side = spacing * static_cast<double>(columns);
  const std::string word = std::array{"none", "elastic", "swap", "stop"}[seed / 4 % 4];
  Simulation_options options;
  for (const Named_response& named : named_responses) {
    if (named.name == word) options.response = named.response;
  }
  if (options.response) options.radius = 0.5 + seed % 3;
  std::string verify = word == "none" ? "" : " --collisions " + word;
  if (seed % 3 != 2) {
    options.box = Box_2{0, 0, side, side};
    verify += " --box 0,0," + std::to_string(side) + "," + std::to_string(side);
  }
  Simulation simulation(motions_of(n, columns, 2 * options.radius + 1, seed), options);
  const std::string path = folder + "/" + std::to_string(seed);
  std::ofstream events(path + ".events.csv");
  std::ofstream motions(path + ".motions.csv");
  Event_log_writer event_log(events);
  Motion_log_writer<Linear_kinetic_traits_2> motion_log(motions, simulation.triangulation(),
                                                        options.radius);
  simulation.add_observer(event_log);
  simulation.add_observer(motion_log);
  auto run =
      detail::region_run_of(simulation, test::options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 15)));
  run.advance_to(until);
  std::ofstream edges(path + ".edges.csv");
  write_edges(edges, simulation.triangulation().finite_edge_ids());
  std::cout << seed << ".motions.csv " << seed << ".events.csv --until " << until << " --edges "
            << seed << ".edges.csv" << verify << "\n";
  return run.counters().windows > 0;
}

}  // namespace
}  // namespace kinetri

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: kinetri_region_logs FOLDER FIRST_SEED NUMBER\n";
    return 2;
  }
  // More threads than this machine may have.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  const auto first = static_cast<unsigned>(std::stoul(argv[2]));
  const auto number = static_cast<unsigned>(std::stoul(argv[3]));
  unsigned with_windows = 0;
  for (unsigned seed = first; seed < first + number; ++seed) {
    if (kinetri::write_run(argv[1], seed)) ++with_windows;
  }
  if (10 * with_windows >= 9 * number) return 0;
  std::cerr << with_windows << " of " << number << " runs had windows\n";
  return 1;
}
