// SPDX-License-Identifier: GPL-3.0-or-later
//
// Point sets to simulate. The same options give the same binary64 numbers on every platform: random
// bits come from std::mt19937_64, whose output the C++ standard fixes, and are processed only by
// operations that IEEE 754 rounds correctly (no std distributions, no libm).
#ifndef KINETRI_SIMULATION_SCENARIOS_H
#define KINETRI_SIMULATION_SCENARIOS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// Positions at time 0, and velocities. "Random" means uniform and independent.
enum class Scenario {
  /// Random positions in the square [0, side)^2; random velocity components in [-speed, speed).
  uniform,
  /// Like `uniform`, with coordinates normally distributed about the center of the square, with
  /// standard deviation side / 4.
  gaussian,
  /// Like `uniform`, with equal speeds and random directions: all squared speeds are exactly equal,
  /// and the speed is within a millionth of `speed`. There are 8748 directions.
  constant_speed,
  /// Like `constant_speed` for point 0; all others rest.
  one_mover,
  /// A square lattice, ceil(sqrt(points)) wide, at the multiples of `spacing`, row by row. Velocity
  /// components are integers of magnitude at most `speed`, so that many events are simultaneous and
  /// points meet.
  lattice,
  /// Like `lattice`, each coordinate shifted by a random offset in [-jitter, jitter); random
  /// velocity components in [-speed, speed).
  lattice_jitter,
};

/// All scenarios.
inline constexpr std::array<Scenario, 6> all_scenarios = {
    Scenario::uniform,   Scenario::gaussian, Scenario::constant_speed,
    Scenario::one_mover, Scenario::lattice,  Scenario::lattice_jitter};

/// The scenario's name: "uniform", "constant-speed", ...
std::string_view name(Scenario scenario);

/// Which points of `Scenario::lattice` move.
enum class Lattice_movers {
  none,
  one,      ///< the point in the middle, with a random nonzero velocity
  columns,  ///< every second column, all with the velocity (0, floor(speed))
  all,      ///< every point, with a random velocity, possibly zero
};

/// All values of Lattice_movers.
inline constexpr std::array<Lattice_movers, 4> all_lattice_movers = {
    Lattice_movers::none, Lattice_movers::one, Lattice_movers::columns, Lattice_movers::all};

/// The value's name: "none", "one", "columns", "all".
std::string_view name(Lattice_movers movers);

/// @{
/// The allowed range of lengths and of nonzero speeds.
inline constexpr double smallest_scenario_size = 1e-100;
inline constexpr double largest_scenario_size = 1e100;
/// @}

/// Whether `x` is in that range.
constexpr bool is_scenario_size(double x) {
  return x >= smallest_scenario_size && x <= largest_scenario_size;
}

/// The parameters of a scenario. Parameters that a scenario does not use are ignored.
struct Scenario_options {
  std::size_t points = 100;  ///< number of points
  std::uint64_t seed = 1;    ///< of all random numbers
  /// The side of the square; by default 10 sqrt(points), which is a density of 100 points in
  /// 100 x 100.
  std::optional<double> side = std::nullopt;
  double speed = 5;     ///< bound of velocity components, or speed of all points
  double spacing = 10;  ///< distance of neighbors in a lattice
  double jitter = 0.1;  ///< greatest offset from the lattice, in x and in y
  Lattice_movers movers = Lattice_movers::all;  ///< for Scenario::lattice
};

/// The motions of the scenario, with epoch 0. Cost: O(points), one allocation.
///
/// Preconditions: fewer than 2^32 - 1 points; side and spacing from 1e-100 to 1e100; speed and
/// jitter in that range or 0; for a lattice whose points move, 1 <= speed <= 2^53. Lattice
/// positions are exact if `spacing` times the width of the lattice is exact.
std::vector<Linear_motion_2> make_scenario(Scenario scenario, const Scenario_options& options);

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_SCENARIOS_H
