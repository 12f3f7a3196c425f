// SPDX-License-Identifier: GPL-3.0-or-later
//
// Point sets to simulate. The same options give the same binary64 numbers on every platform: the
// random bits are those of std::mt19937_64, whose output the C++ standard fixes, and what is made
// of them uses only operations that IEEE 754 rounds correctly (no std distributions, no libm).
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

/// Where the points are at time 0, and how they move. "Random" is uniform and independent.
enum class Scenario {
  /// Random places in the square [0, side)^2; random velocity components in [-speed, speed).
  uniform,
  /// As `uniform`, but the coordinates are normally distributed about the centre of the square,
  /// with standard deviation side / 4.
  gaussian,
  /// As `uniform`, but in random directions at one speed: the squared speeds are exactly the same
  /// number, and the speed is within a millionth of `speed`. There are 8748 directions.
  constant_speed,
  /// As `constant_speed` for point 0; all others rest.
  one_mover,
  /// A square lattice, ceil(sqrt(points)) wide, at the multiples of `spacing`, row by row. The
  /// velocity components are whole numbers of at most `speed`, so that there are many simultaneous
  /// events and points that meet.
  lattice,
  /// As `lattice`, each coordinate shifted by a random offset in [-jitter, jitter); random velocity
  /// components in [-speed, speed).
  lattice_jitter,
};

/// Each of them once.
inline constexpr std::array<Scenario, 6> all_scenarios = {
    Scenario::uniform,   Scenario::gaussian, Scenario::constant_speed,
    Scenario::one_mover, Scenario::lattice,  Scenario::lattice_jitter};

/// The scenario's name: "uniform", "constant-speed", ...
std::string_view name(Scenario scenario);

/// Which points of `Scenario::lattice` move.
enum class Lattice_movers {
  none,
  one,      ///< the one in the middle, with a random velocity that is not zero
  columns,  ///< every second column, all with the velocity (0, floor(speed))
  all,      ///< each with a random velocity, which may be zero
};

/// Each of them once.
inline constexpr std::array<Lattice_movers, 4> all_lattice_movers = {
    Lattice_movers::none, Lattice_movers::one, Lattice_movers::columns, Lattice_movers::all};

/// The name: "none", "one", "columns", "all".
std::string_view name(Lattice_movers movers);

/// @{
/// The range of a length or of a speed that is not zero.
inline constexpr double smallest_scenario_size = 1e-100;
inline constexpr double largest_scenario_size = 1e100;
/// @}

/// What a scenario is made from. Fields that a scenario does not mention are ignored.
struct Scenario_options {
  std::size_t points = 100;  ///< how many there are
  std::uint64_t seed = 1;    ///< of all that is random
  /// The side of the square; without one, 10 sqrt(points), so that the density is that of 100
  /// points in 100 x 100.
  std::optional<double> side = std::nullopt;
  double speed = 5;     ///< the bound of velocity components, or that of all points
  double spacing = 10;  ///< of neighbors in a lattice
  double jitter = 0.1;  ///< the greatest offset from the lattice, in x and in y
  Lattice_movers movers = Lattice_movers::all;  ///< of Scenario::lattice
};

/// The scenario's motions, with epoch 0. Cost: linear, with one allocation.
///
/// Preconditions: fewer than 2^32 - 1 points; side and spacing from 1e-100 to 1e100; speed and
/// jitter in that range or 0; for a lattice whose points move, 1 <= speed <= 2^53. Lattice places
/// are exact where `spacing` times the width of the lattice is.
std::vector<Linear_motion_2> make_scenario(Scenario scenario, const Scenario_options& options);

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_SCENARIOS_H
