// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 17, periodic boxes: the pressure of a gas of hard discs.
#include <kinetri/kinetic/periodic_kinetic_traits_2.h>
#include <kinetri/observers/mean_pressure.h>
#include <kinetri/simulation/simulation_2.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>
#include <vector>

using Traits = kinetri::Periodic_kinetic_traits_2;
using Simulation = kinetri::Simulation_2<Traits>;
using kinetri::Vector_2;

// Discs on a square lattice, which melts at once, get random velocities. Their sum is zero, so that
// the temperature is the kinetic energy divided by one less than the number of discs: 1.
static std::vector<kinetri::Linear_motion_2> gas(int side) {
  std::mt19937 random(1);
  std::vector<kinetri::Linear_motion_2> discs;
  Vector_2 mean;
  const auto number = [&] { return static_cast<double>(random()) / 0x1p31 - 1; };
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const Vector_2 velocity = {number(), number()};
      mean = {mean.x + velocity.x, mean.y + velocity.y};
      discs.push_back({{double(column), double(row)}, velocity});
    }
  }
  const auto size = static_cast<double>(discs.size());
  double squares = 0;
  for (auto& [position, velocity, epoch] : discs) {
    velocity = {velocity.x - mean.x / size, velocity.y - mean.y / size};
    squares += velocity.x * velocity.x + velocity.y * velocity.y;
  }
  const double scale = std::sqrt(2 * (size - 1) / squares);
  for (auto& disc : discs) disc.velocity = {scale * disc.velocity.x, scale * disc.velocity.y};
  return discs;
}

// The virial series of hard discs, with the coefficients of N. Clisby and B. M. McCoy, Journal of
// Statistical Physics 122 (2006), 15; and the equation of D. Henderson, Molecular Physics 30
// (1975), 971.
static double virial_series(double share) {
  constexpr std::array coefficients = {1.0,        0.7820044, 0.53223180, 0.33355604, 0.1988425,
                                       0.11486728, 0.0649930, 0.0362193,  0.0199537};
  double result = 1;
  double power = 1;
  for (const double coefficient : coefficients) result += coefficient * (power *= 2 * share);
  return result;
}
static double henderson(double share) {
  return (1 + share * share / 8) / ((1 - share) * (1 - share));
}

// Prints p A / (N k T) if discs cover this share of a square box with the given side.
static bool measure(double share, int side, double collisions) {
  const kinetri::Periodic_box_2 box({{double(side), 0}, {0, 0}}, {{0, double(side)}, {0, 0}});
  kinetri::Simulation_options options;
  options.radius = std::sqrt(share / std::numbers::pi);
  options.response = kinetri::collide_elastically;
  options.refuses_overlaps = true;
  Simulation simulation(gas(side), options, 0, Traits(box));
  kinetri::Mean_pressure pressure(simulation);

  const double number = side * side;
  constexpr int blocks = 20;
  // In which each disc has about so many collisions, by Enskog's rate.
  const double rate = 2 * (henderson(share) - 1) / options.radius / std::sqrt(std::numbers::pi);
  const double duration = collisions / rate / blocks;
  double mean = 0;
  double squares = 0;
  // The first four blocks are not counted.
  for (int block = -4; block < blocks; ++block) {
    simulation.advance_to((block + 5) * duration);
    const kinetri::Pressure_2 mean_pressure = pressure.next();
    if (block < 0) continue;
    // The temperature is 1, and the area is the number of discs.
    const double compressibility =
        1 + (mean_pressure.pressure() * number - mean_pressure.energy) / number;
    mean += compressibility / blocks;
    squares += compressibility * compressibility / blocks;
  }
  const double error = std::sqrt((squares - mean * mean) / (blocks - 1));
  std::printf("%.2f  %7.3f +- %.3f  %10.3f  %10.3f\n", share, mean, error, virial_series(share),
              henderson(share));
  return simulation.audit(kinetri::Audit_level::certificates).passed();
}

int main(int arguments, char** values) {
  const double collisions = arguments > 1 ? std::atof(values[1]) : 200;
  const int side = arguments > 2 ? std::atoi(values[2]) : 10;
  std::printf("share  p A / (N k T)    10 virials  Henderson\n");
  bool is_right = true;
  for (const double share : {0.3, 0.5, 0.69}) {
    is_right = measure(share, side, collisions) && is_right;
  }
  return is_right ? 0 : 1;
}
