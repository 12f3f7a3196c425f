// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pressure of discs in periodic boxes: known values; the work that a box does, which follows
// from the pressure and is seen in the energy; and the thermostat.
#include "kinetri/observers/mean_pressure.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "support/precondition_error.h"

namespace kinetri::mean_pressure_test {
namespace {

using Traits = Periodic_kinetic_traits_2;
using Disc_traits = Periodic_disc_kinetic_traits_2;
using Simulation = Simulation_2<Traits>;
using Disc_simulation = Simulation_2<Disc_traits>;

const Periodic_box_2 square({{10, 0}, {0, 0}}, {{0, 10}, {0, 0}});

Simulation_options elastic(double radius) {
  Simulation_options options;
  options.radius = radius;
  options.response = collide_elastically;
  return options;
}

/// Discs of several radii and masses near the places of a lattice, with random velocities relative
/// to the flow; if `are_apart`, at images of these that are far from each other.
std::vector<Disc_motion_2> gas(const Periodic_box_2& box, std::vector<double>& masses,
                               bool are_apart = false) {
  constexpr int side = 5;
  std::mt19937_64 random(7);
  const auto between = [&](double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(random);
  };
  std::vector<Disc_motion_2> result;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double k = (column + between(0, 0.1)) / side + (are_apart ? column - 2 * row : 0);
      const double l = (row + between(0, 0.1)) / side + (are_apart ? row % 3 : 0);
      const Vector_2 a = box.first().position;
      const Vector_2 b = box.second().position;
      const Vector_2 place = {k * a.x + l * b.x, k * a.y + l * b.y};
      const Vector_2 flow = box.flow_at(place, 0);
      Disc_motion_2 disc;
      disc.position = place;
      disc.velocity = {flow.x + between(-1, 1), flow.y + between(-1, 1)};
      disc.radius = between(0.3, 0.7);
      result.push_back(disc);
      masses.push_back(between(0.5, 2));
    }
  }
  return result;
}

TEST(Flow, is_that_of_positions_with_constant_coordinates) {
  const Periodic_box_2 box({{3, 1}, {0.5, 0}, 1}, {{-1, 2}, {0.25, -0.125}, 2});
  for (const double t : {0.0, 1.5}) {
    const auto place_at = [&](double time) {
      const Vector_2 a = rounded_place(box.first(), time);
      const Vector_2 b = rounded_place(box.second(), time);
      return Vector_2{0.75 * a.x - 1.5 * b.x, 0.75 * a.y - 1.5 * b.y};
    };
    const Vector_2 flow = box.flow_at(place_at(t), t);
    const Vector_2 before = place_at(t - 1);
    const Vector_2 after = place_at(t + 1);
    EXPECT_NEAR(flow.x, (after.x - before.x) / 2, 1e-15);
    EXPECT_NEAR(flow.y, (after.y - before.y) / 2, 1e-15);
  }
  EXPECT_EQ(square.flow_at({3, 4}, 5), (Vector_2{0, 0}));
  for (const double size : {0x1p-550, 0x1p550}) {
    const Periodic_box_2 sheared({{size, 0}, {0, 0}}, {{0, size}, {size / 2, 0}});
    EXPECT_EQ(sheared.flow_at({size, size}, 1), (Vector_2{size / 2, 0}));
  }
}

TEST(Mean_pressure, without_collisions_is_the_flow_of_momentum) {
  Simulation simulation({{{1, 1}, {2, 1}}, {{5, 6}, {-1, 3}}}, {}, 0, Traits(square));
  simulation.set_mass(1, 2);
  Mean_pressure pressure(simulation);
  simulation.advance_to(0.75);
  const Pressure_2 mean = pressure.next();
  EXPECT_EQ(mean.from, 0);
  EXPECT_EQ(mean.until, 0.75);
  EXPECT_EQ(mean.collisions, 0U);
  EXPECT_DOUBLE_EQ(mean.energy, (4 + 1 + 2 * (1 + 9)) / 2.0);
  EXPECT_DOUBLE_EQ(mean.xx, (4 + 2) / 100.0);
  EXPECT_DOUBLE_EQ(mean.xy, (2 - 6) / 100.0);
  EXPECT_DOUBLE_EQ(mean.yy, (1 + 18) / 100.0);
  EXPECT_DOUBLE_EQ(mean.pressure(), mean.energy / 100);
}

// Two discs on a line are rods on a circle: their free length is that of the box without the two
// diameters (L. Tonks, Physical Review 50, 1936). After two collisions, one on each side, all is
// repeated.
TEST(Mean_pressure, of_discs_on_a_line_is_that_of_rods) {
  for (const double radius : {0.5, 1.0, 2.25}) {
    Simulation simulation({{{2, 5}, {2, 0}}, {{7, 5}, {-2, 0}}}, elastic(radius), 0,
                          Traits(square));
    Mean_pressure pressure(simulation);
    const double free = 10 - 4 * radius;
    simulation.advance_to(free / 2);  // two collisions, each after free / 4
    const Pressure_2 mean = pressure.next();
    EXPECT_EQ(mean.collisions, 2U);
    EXPECT_DOUBLE_EQ(mean.xx * 10, 8 / free);
    EXPECT_EQ(mean.xy, 0);
    EXPECT_EQ(mean.yy, 0);
  }
}

// Of an oblique line between the centers each component is known too.
TEST(Mean_pressure, has_the_direction_of_the_line_of_centers) {
  Simulation simulation({{{0, 0}, {3, 4}}, {{6, 8}, {0, 0}}}, elastic(2.5), 0, Traits(square));
  Mean_pressure pressure(simulation);
  simulation.advance_to(1.25);  // the collision is at 1
  const Pressure_2 mean = pressure.next();
  EXPECT_EQ(mean.collisions, 1U);
  // u u^T = (9 12; 12 16) at all times; q = (3, 4), and r = (3, 4).
  EXPECT_NEAR(mean.xx, (9 + 9 / 1.25) / 100, 1e-15);
  EXPECT_NEAR(mean.xy, (12 + 12 / 1.25) / 100, 1e-15);
  EXPECT_NEAR(mean.yy, (16 + 16 / 1.25) / 100, 1e-15);
}

// The work of a sheared box is -area * rate * xy per unit of time, and elastic collisions change
// the energy by nothing else. The box is sheared along x, along y, and is oblique.
TEST(Mean_pressure, of_a_sheared_box_explains_the_energy) {
  const std::array<Periodic_box_2, 3> boxes = {
      Periodic_box_2({{10, 0}, {0, 0}}, {{0, 10}, {2.5, 0}}),
      Periodic_box_2({{10, 0}, {0, -5}}, {{0, 8}, {0, 0}}),
      Periodic_box_2({{9, 0}, {0, 0}}, {{-4, 11}, {5.5, 0}})};
  const std::array<double, 3> rates = {0.25, -0.5, 0.5};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::vector<double> masses;
    Simulation_options options = elastic(0);
    const std::vector<Disc_motion_2> discs = gas(boxes[i], masses);
    options.masses = masses;
    Disc_simulation simulation(discs, options, 0, Disc_traits(boxes[i]));
    Mean_pressure pressure(simulation);
    const double area = to_double(boxes[i].area(0));
    std::uint64_t collisions = 0;
    double energy = kinetic_energy(simulation);
    for (const double time : {0.5, 1.0, 3.0}) {
      simulation.advance_to(time);
      const Pressure_2 mean = pressure.next();
      const double work = -area * rates[i] * mean.xy * (mean.until - mean.from);
      EXPECT_NEAR(mean.energy - energy, work, 1e-11 * mean.energy) << i << ' ' << time;
      EXPECT_GT(std::abs(work), 0.01 * energy);
      energy = mean.energy;
      collisions += mean.collisions;
    }
    EXPECT_GT(collisions, 30U);
  }
}

// A box that shrinks does the work -p dA; over short intervals that is the sum of the means.
TEST(Mean_pressure, of_a_shrinking_box_explains_the_energy) {
  const double rate = -0.0625;
  const Periodic_box_2 box({{10, 0}, {10 * rate, 0}}, {{0, 10}, {0, 10 * rate}});
  std::vector<double> masses;
  const std::vector<Disc_motion_2> discs = gas(box, masses);
  Simulation_options options = elastic(0);
  options.masses = masses;
  Disc_simulation simulation(discs, options, 0, Disc_traits(box));
  Mean_pressure pressure(simulation);
  const double before = kinetic_energy(simulation);
  double work = 0;
  Pressure_2 mean;
  const auto area_at = [&](double time) { return to_double(box.area(time)); };
  for (int step = 1; step <= 2048; ++step) {
    simulation.advance_to(step / 1024.0);
    mean = pressure.next();
    work -= mean.pressure() * (area_at(mean.until) - area_at(mean.from));
  }
  EXPECT_NEAR(mean.energy - before, work, 2e-4 * before);
  EXPECT_GT(work, 0.2 * before);
}

TEST(Mean_pressure, is_the_same_for_other_images) {
  const Periodic_box_2 box({{10, 0}, {0, 0}}, {{0, 10}, {2.5, 0}});
  std::vector<Pressure_2> results;
  for (const bool are_apart : {false, true}) {
    std::vector<double> masses;
    const std::vector<Disc_motion_2> discs = gas(box, masses, are_apart);
    Disc_simulation simulation(discs, elastic(0), 0, Disc_traits(box));
    Mean_pressure pressure(simulation);
    simulation.advance_to(1.5);
    results.push_back(pressure.next());
  }
  EXPECT_GT(results[0].collisions, 5U);
  EXPECT_EQ(results[0].collisions, results[1].collisions);
  for (const auto component :
       {&Pressure_2::energy, &Pressure_2::xx, &Pressure_2::xy, &Pressure_2::yy}) {
    EXPECT_NEAR(results[0].*component, results[1].*component, 1e-10);
  }
}

TEST(Mean_pressure, follows_points_that_come_and_go) {
  Simulation simulation({{{1, 1}, {2, 0}}, {{5, 5}, {0, 2}}}, {}, 0, Traits(square));
  Mean_pressure pressure(simulation);
  simulation.advance_to(1);
  simulation.erase(0);
  const Point_id id = simulation.insert({{8, 8}, {3, 0}, 1}, 2);
  simulation.advance_to(2);
  simulation.set_velocities(std::vector<Point_id>{id}, std::vector<Vector_2>{{1, 0}});
  simulation.advance_to(4);
  const Pressure_2 mean = pressure.next();
  EXPECT_DOUBLE_EQ(mean.xx, (4 * 1 + 2 * 9 * 1 + 2 * 1 * 2) / 4.0 / 100);
  EXPECT_DOUBLE_EQ(mean.yy, 4.0 / 100);
  EXPECT_DOUBLE_EQ(mean.energy, (4 + 2) / 2.0);
  EXPECT_PRECONDITION_ERROR(pressure.next(),
                            "the interval from t = 4 on is empty; advance the time before the next "
                            "call");
}

TEST(Thermostat, scales_velocities_relative_to_the_flow) {
  const Periodic_box_2 box({{10, 0}, {0, 0}}, {{0, 10}, {2.5, 0}});
  std::vector<double> masses;
  const std::vector<Disc_motion_2> discs = gas(box, masses);
  Disc_simulation simulation(discs, elastic(0), 0, Disc_traits(box));
  simulation.advance_to(1);
  const Disc_motion_2 before = simulation.triangulation().motion(3);
  set_kinetic_energy(simulation, 4 * kinetic_energy(simulation));
  const Disc_motion_2 after = simulation.triangulation().motion(3);
  const Vector_2 flow = box.flow_at(rounded_place(before, 1), 1);
  EXPECT_NEAR(after.velocity.x - flow.x, 2 * (before.velocity.x - flow.x), 1e-12);
  EXPECT_NEAR(after.velocity.y - flow.y, 2 * (before.velocity.y - flow.y), 1e-12);
  set_kinetic_energy(simulation, 3);
  EXPECT_NEAR(kinetic_energy(simulation), 3, 1e-12);
  EXPECT_TRUE(simulation.is_valid());
}

TEST(Thermostat, works_in_the_plane) {
  Simulation_2<Linear_kinetic_traits_2> simulation({{{0, 0}, {3, 4}}, {{9, 9}, {0, 0}}}, {});
  EXPECT_EQ(kinetic_energy(simulation), 12.5);
  set_kinetic_energy(simulation, 0.5);
  EXPECT_DOUBLE_EQ(simulation.triangulation().motion(0).velocity.x, 0.6);
  EXPECT_PRECONDITION_ERROR(set_kinetic_energy(simulation, -1),
                            "the energy is -1; expected a finite number that is not "
                            "negative");
  set_kinetic_energy(simulation, 0);
  EXPECT_PRECONDITION_ERROR(
      set_kinetic_energy(simulation, 1),
      "the kinetic energy is 0, so that no factor changes it to another one; "
      "expected points that move, and numbers near 1, in other units perhaps");
}

}  // namespace
}  // namespace kinetri::mean_pressure_test
