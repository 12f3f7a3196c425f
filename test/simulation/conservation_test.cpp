// SPDX-License-Identifier: GPL-3.0-or-later
//
// What elastic collisions conserve, but for the rounding of velocities: energy in a box, energy and
// momentum in free space, over many collisions.
//
// Contacts happen at exact times, and a wall changes the sign of a component exactly. So the sums
// change at collisions only, by the rounding of two velocities. `Elastic_collision` in
// collision_response_test.cpp bounds that for one collision: the energy of the two changes by less
// than 2^-48 of itself, and each component of the momentum by less than 2^-50 of the sum of the
// momenta of the two before and after. The sums of these bounds bound the change of a run.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/disc_runs.h"
#include "support/multiplier.h"

namespace kinetri::conservation_test {
namespace {

using Real = long double;

Real squared_length(const Vector_2& v) {
  return Real(v.x) * v.x + Real(v.y) * v.y;
}

// A fifth of it where CGAL checks every step.
std::uint64_t number_of_collisions() {
#ifdef NDEBUG
  constexpr std::uint64_t usual = 100'000;
#else
  constexpr std::uint64_t usual = 20'000;
#endif
  return test::cases<std::uint64_t>(usual);
}

/// Adds up how far the sums may have changed.
template <class Simulation>
class Bounds : public Simulation::Observer {
 public:
  explicit Bounds(Simulation& simulation) : simulation_(simulation) {
    simulation.add_observer(*this);
  }
  Bounds(const Bounds&) = delete;
  Bounds& operator=(const Bounds&) = delete;
  ~Bounds() override { simulation_.remove_observer(*this); }

  void before_event(const Event& event) override { add_momenta(event); }
  void after_event(const Event& event) override {
    add_momenta(event);
    if (event.kind != Event_kind::collision) return;
    for (const auto& id : {event.point_a, event.point_b}) {
      energy_ += 0x1p-48L * mass(*id) * squared_length(test::velocity(simulation_, *id));
    }
  }

  Real energy() const { return energy_; }
  Real momentum() const { return momentum_; }

 private:
  Real mass(Point_id id) const { return simulation_.mass(id); }

  void add_momenta(const Event& event) {
    if (event.kind != Event_kind::collision) return;
    for (const auto& id : {event.point_a, event.point_b}) {
      momentum_ +=
          0x1p-50L * mass(*id) * std::sqrt(squared_length(test::velocity(simulation_, *id)));
    }
  }

  Simulation& simulation_;
  Real energy_ = 0;
  Real momentum_ = 0;
};

/// Discs of the radii 0.5, 1, ..., 4 with the areas as masses.
struct Different_sizes {
  using Simulation = Simulation_2<Disc_kinetic_traits_2>;
  static Simulation make(std::size_t n, Simulation_options options) {
    std::vector<Disc_motion_2> motions;
    for (const Linear_motion_2& motion : test::discs_in_a_box(n, 0.2, 1)) {
      const double radius = 0.5 * static_cast<double>(1 + motions.size() % 8);
      motions.push_back({motion, radius, 0, 0});
      options.masses.push_back(radius * radius);
    }
    return Simulation(motions, options);
  }
};
/// Points with the radius 4 and equal masses.
struct Equal_sizes {
  using Simulation = Simulation_2<>;
  static Simulation make(std::size_t n, Simulation_options options) {
    options.radius = 4;
    return Simulation(test::discs_in_a_box(n, 0.2, 1), options);
  }
};

template <class Sizes>
class Conservation : public testing::Test {};

using All_sizes = testing::Types<Equal_sizes, Different_sizes>;
TYPED_TEST_SUITE(Conservation, All_sizes);

TYPED_TEST(Conservation, of_energy_in_a_box_over_many_collisions) {
  Simulation_options in_the_box = test::in_box(test::box_of(100));
  in_the_box.response = collide_elastically;
  auto simulation = TypeParam::make(100, in_the_box);
  const Bounds bounds(simulation);
  const test::Conserved before = test::conserved(simulation);
  const std::uint64_t collisions = number_of_collisions();
  while (test::count(simulation, Event_kind::collision) < collisions) simulation.step();
  const Real change = test::conserved(simulation).energy - before.energy;
  std::printf("%llu collisions: energy changed by %.3Lg of itself, bound %.3Lg\n",
              static_cast<unsigned long long>(collisions), change / before.energy,
              bounds.energy() / before.energy);
  EXPECT_LT(std::abs(change), bounds.energy());
  // Most of the rounding cancels.
  EXPECT_LT(std::abs(change / before.energy), 1e-12L);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TYPED_TEST(Conservation, of_energy_and_momentum_in_free_space_until_the_discs_have_dispersed) {
  Simulation_options options;
  options.response = collide_elastically;
  auto simulation = TypeParam::make(2500, options);
  const Bounds bounds(simulation);
  const test::Conserved before = test::conserved(simulation);
  simulation.advance_to(1000.0);
  const test::Conserved after = test::conserved(simulation);
  const Real change_x = after.momentum_x - before.momentum_x;
  const Real change_y = after.momentum_y - before.momentum_y;
  std::printf("%llu collisions: energy changed by %.3Lg of itself, momentum by %.3Lg, %.3Lg\n",
              static_cast<unsigned long long>(test::count(simulation, Event_kind::collision)),
              after.energy / before.energy - 1, change_x, change_y);
  EXPECT_GT(test::count(simulation, Event_kind::collision), 1000u);
  EXPECT_LT(std::abs(after.energy - before.energy), bounds.energy());
  EXPECT_LT(std::abs(change_x), bounds.momentum());
  EXPECT_LT(std::abs(change_y), bounds.momentum());
  EXPECT_LT(std::abs(after.energy / before.energy - 1), 1e-12L);
}

}  // namespace
}  // namespace kinetri::conservation_test
