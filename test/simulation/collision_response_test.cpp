// SPDX-License-Identifier: GPL-3.0-or-later
//
// The velocities that the responses give, by themselves: masses, and discs that grow.
#include "kinetri/simulation/collision_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "kinetri/simulation/simulation_2.h"
#include "support/disc_runs.h"
#include "support/multiplier.h"
#include "support/precondition_error.h"

namespace kinetri::collision_response_test {
namespace {

using test::discs;
using test::Simulation;
using test::velocity;

using Real = long double;

/// Numbers of many sizes, of both signs.
class Random_contacts {
 public:
  explicit Random_contacts(unsigned seed) : random_(seed) {}

  double number(int least_exponent, int greatest_exponent) {
    std::uniform_real_distribution<double> fraction(-1, 1);
    std::uniform_int_distribution<int> exponent(least_exponent, greatest_exponent);
    return std::ldexp(fraction(random_), exponent(random_));
  }
  Vector_2 vector(int least_exponent, int greatest_exponent) {
    const double x = number(least_exponent, greatest_exponent);
    return {x, number(least_exponent, greatest_exponent)};
  }
  /// Of discs that approach, in exact arithmetic that is good enough for the purpose.
  Contact_2 contact() {
    Contact_2 result;
    result.would_approach = [](const Vector_2&, const Vector_2&) { return false; };
    do {
      result.separation = vector(-3, 3);
      result.velocity_a = vector(-10, 10);
      result.velocity_b = vector(-10, 10);
    } while (result.separation == Vector_2() || relative(result) >= 0);
    return result;
  }
  /// The relative velocity along the line of centers, positive where the centers part.
  static Real relative(const Contact_2& c) {
    return along(c, Real(c.velocity_b.x) - c.velocity_a.x, Real(c.velocity_b.y) - c.velocity_a.y);
  }
  static Real along(const Contact_2& c, Real x, Real y) {
    const Real nx = c.separation.x;
    const Real ny = c.separation.y;
    return (x * nx + y * ny) / std::sqrt(nx * nx + ny * ny);
  }

 private:
  std::mt19937_64 random_;
};

/// What the response was before there were masses and growths, as it stood.
Contact_response_2 of_equal_masses(const Contact_2& contact) {
  Vector_2 n = contact.separation;
  const double length = std::max(std::abs(n.x), std::abs(n.y));
  if (length == 0) return {};
  const int exponent = -std::ilogb(length);
  n = {std::scalbn(n.x, exponent), std::scalbn(n.y, exponent)};
  const auto size_of = [](const Vector_2& v) { return std::max(std::abs(v.x), std::abs(v.y)); };
  const double greatest = std::max(size_of(contact.velocity_a), size_of(contact.velocity_b));
  const double scale = greatest > 0x1p1000 ? 0x1p10 : 1;
  const Vector_2 a = {contact.velocity_a.x / scale, contact.velocity_a.y / scale};
  const Vector_2 b = {contact.velocity_b.x / scale, contact.velocity_b.y / scale};
  const double impulse = ((b.x - a.x) * n.x + (b.y - a.y) * n.y) / (n.x * n.x + n.y * n.y);
  const auto velocities = [&](double along) {
    const Vector_2 change = {along * n.x, along * n.y};
    return Contact_response_2{Vector_2{(a.x + change.x) * scale, (a.y + change.y) * scale},
                              Vector_2{(b.x - change.x) * scale, (b.y - change.y) * scale}};
  };
  Contact_response_2 result = velocities(impulse);
  if (contact.is_pressed) return result;
  const double size = std::max(size_of(a), size_of(b)) / size_of(n);
  for (double further =
           size * std::numeric_limits<double>::epsilon() + std::numeric_limits<double>::min();
       contact.would_approach(*result.velocity_a, *result.velocity_b); further *= 2) {
    if (further > size) return {};
    result = velocities(impulse - further);
  }
  return result;
}

TEST(Elastic_collision, of_equal_masses_is_what_it_was_bit_for_bit) {
  Random_contacts random(1);
  for (int i = 0; i < test::cases(10000); ++i) {
    Contact_2 contact = random.contact();
    if (i % 3 == 0) contact.velocity_a.x *= 0x1p1008;
    const double mass = std::abs(random.number(-500, 500)) + 0x1p-600;
    contact.is_pressed = i % 5 == 0;
    // As if the first velocities would still approach.
    int asked = 0;
    contact.would_approach = [&](const Vector_2&, const Vector_2&) { return ++asked % 4 != 0; };
    const Contact_response_2 expected = of_equal_masses(contact);
    contact.mass_a = contact.mass_b = mass;
    asked = 0;
    const Contact_response_2 found = collide_elastically(contact);
    ASSERT_EQ(found.velocity_a, expected.velocity_a);
    ASSERT_EQ(found.velocity_b, expected.velocity_b);
  }
}

TEST(Elastic_collision, conserves_momentum_and_energy_whatever_the_masses) {
  Random_contacts random(2);
  Real worst_momentum = 0;
  Real worst_energy = 0;
  for (int i = 0; i < test::cases(10000); ++i) {
    Contact_2 contact = random.contact();
    contact.mass_a = std::abs(random.number(-20, 20)) + 0x1p-30;
    contact.mass_b = std::abs(random.number(-20, 20)) + 0x1p-30;
    const Contact_response_2 after = collide_elastically(contact);
    const Real m = contact.mass_a;
    const Real k = contact.mass_b;
    for (double Vector_2::*axis : {&Vector_2::x, &Vector_2::y}) {
      const Real before = m * contact.velocity_a.*axis + k * contact.velocity_b.*axis;
      const Real change = m * (*after.velocity_a).*axis + k * (*after.velocity_b).*axis - before;
      const auto size = [](const Vector_2& v) { return std::hypot(Real(v.x), Real(v.y)); };
      const Real terms = m * (size(contact.velocity_a) + size(*after.velocity_a)) +
                         k * (size(contact.velocity_b) + size(*after.velocity_b));
      worst_momentum = std::max(worst_momentum, std::abs(change) / terms);
    }
    const auto energy = [&](const Vector_2& a, const Vector_2& b) {
      return m * (Real(a.x) * a.x + Real(a.y) * a.y) + k * (Real(b.x) * b.x + Real(b.y) * b.y);
    };
    const Real before = energy(contact.velocity_a, contact.velocity_b);
    const Real change = energy(*after.velocity_a, *after.velocity_b) / before - 1;
    worst_energy = std::max(worst_energy, std::abs(change));
  }
  // A few units in the last place.
  EXPECT_LT(worst_momentum, 0x1p-50L);
  EXPECT_LT(worst_energy, 0x1p-48L);
}

TEST(Elastic_collision, of_growing_discs_parts_the_rims_as_fast_as_they_came) {
  Random_contacts random(3);
  for (int i = 0; i < test::cases(10000); ++i) {
    Contact_2 contact = random.contact();
    contact.mass_a = std::abs(random.number(-4, 4)) + 0x1p-10;
    contact.mass_b = std::abs(random.number(-4, 4)) + 0x1p-10;
    contact.growth_a = random.number(-8, 8);
    contact.growth_b = random.number(-8, 8);
    const Real growth = Real(contact.growth_a) + contact.growth_b;
    if (Random_contacts::relative(contact) >= growth) continue;
    const Contact_response_2 after = collide_elastically(contact);
    const Real expected = 2 * growth - Random_contacts::relative(contact);
    const Real found =
        Random_contacts::along(contact, Real(after.velocity_b->x) - after.velocity_a->x,
                               Real(after.velocity_b->y) - after.velocity_a->y);
    const Real size = std::abs(growth) + std::abs(contact.velocity_a.x) +
                      std::abs(contact.velocity_a.y) + std::abs(contact.velocity_b.x) +
                      std::abs(contact.velocity_b.y);
    ASSERT_LT(std::abs(found - expected), 0x1p-48L * size);
    // Momentum is conserved along both axes.
    const Real m = contact.mass_a;
    const Real k = contact.mass_b;
    for (double Vector_2::*axis : {&Vector_2::x, &Vector_2::y}) {
      const Real change = m * (Real((*after.velocity_a).*axis) - contact.velocity_a.*axis) +
                          k * (Real((*after.velocity_b).*axis) - contact.velocity_b.*axis);
      ASSERT_LT(std::abs(change), 0x1p-48L * (m + k) * size);
    }
  }
}

TEST(Elastic_collision, with_a_mass_beyond_all_measure_is_one_with_a_wall) {
  Contact_2 contact;
  contact.separation = {2, 0};
  contact.velocity_a = {3, 1};
  contact.velocity_b = {-1, 2};
  contact.mass_a = 1e-300;
  contact.mass_b = 1e300;
  contact.would_approach = [](const Vector_2&, const Vector_2&) { return false; };
  const Contact_response_2 after = collide_elastically(contact);
  EXPECT_EQ(*after.velocity_a, (Vector_2{-5, 1}));
  EXPECT_EQ(*after.velocity_b, (Vector_2{-1, 2}));
}

// ---- masses in a simulation ----

TEST(Masses, of_three_to_one_exchange_velocities_as_the_textbook_says) {
  Simulation_options options = discs(1, collide_elastically);
  options.masses = {3, 1, 1};
  Simulation simulation({{{0, 0}, {1, 0}, 0}, {{5, 0}, {-1, 0}, 0}, {{2, 9}, {0, 0}, 0}}, options);
  simulation.advance_to(2.0);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{0, 0}));
  EXPECT_EQ(velocity(simulation, 1), (Vector_2{2, 0}));
}

TEST(Masses, of_points_that_come_later_are_one_or_given) {
  Simulation_options options = discs(1, collide_elastically);
  Simulation simulation({{{0, 0}, {1, 0}, 0}, {{2, 9}, {0, 0}, 0}}, options);
  const Point_id heavy = simulation.insert({{5, 0}, {-1, 0}, 0}, 3);
  EXPECT_EQ(simulation.mass(heavy), 3);
  EXPECT_EQ(simulation.mass(0), 1);
  const Point_id later = simulation.schedule_insert(1.0, {{20, 0}, {0, 0}, 0}, 7);
  const Point_id unit = simulation.schedule_insert(1.0, {{30, 0}, {0, 0}, 0});
  simulation.advance_to(2.0);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{-2, 0}));
  EXPECT_EQ(velocity(simulation, heavy), (Vector_2{0, 0}));
  EXPECT_EQ(simulation.mass(later), 7);
  EXPECT_EQ(simulation.mass(unit), 1);
  simulation.set_mass(unit, 2);
  EXPECT_EQ(simulation.options().masses, (std::vector<double>{1, 1, 3, 7, 2}));
}

TEST(Masses, of_an_inserted_point_are_known_to_observers) {
  struct Observer : Event_observer {
    explicit Observer(const Simulation& simulation) : simulation_(simulation) {}
    void after_event(const Event& event) override {
      if (event.kind == Event_kind::insert) mass = simulation_.mass(*event.point_a);
    }
    double mass = 0;
    const Simulation& simulation_;
  };
  Simulation_options options = discs(1, collide_elastically);
  options.refuses_overlaps = true;
  Simulation simulation({{{0, 0}, {0, 0}, 0}}, options);
  Observer observer(simulation);
  simulation.add_observer(observer);
  simulation.insert({{5, 0}, {0, 0}, 0}, 3);
  EXPECT_EQ(observer.mass, 3);
  EXPECT_THROW(simulation.insert({{6, 0}, {0, 0}, 0}, 7), Overlapping_discs_error);
  EXPECT_EQ(simulation.options().masses, (std::vector<double>{1, 3}));
  const Simulation restored = Simulation::restore(simulation.snapshot(), collide_elastically);
  EXPECT_EQ(restored.mass(1), 3);
}

TEST(Masses, are_in_snapshots) {
  Simulation_options options = discs(1, collide_elastically);
  options.masses = {3, 1, 1};
  Simulation simulation({{{0, 0}, {1, 0}, 0}, {{5, 0}, {-1, 0}, 0}, {{2, 9}, {0, 0}, 0}}, options);
  auto snapshot = simulation.snapshot();
  Simulation restored = Simulation::restore(snapshot, collide_elastically);
  restored.advance_to(2.0);
  EXPECT_EQ(velocity(restored, 0), (Vector_2{0, 0}));
  snapshot.options.masses = {3, 1, 1, 1};
  EXPECT_THROW(Simulation::restore(snapshot, collide_elastically), Snapshot_error);
  snapshot.options.masses = {0};
  EXPECT_THROW(Simulation::restore(snapshot, collide_elastically), Snapshot_error);
}

TEST(Masses, that_have_no_meaning_are_refused) {
  const std::vector<Linear_motion_2> motions = {{{0, 0}, {1, 0}, 0}, {{5, 0}, {-1, 0}, 0}};
  Simulation_options options = discs(1, collide_elastically);
  options.masses = {1};
  EXPECT_PRECONDITION_ERROR(Simulation(motions, options), "masses, but not one for each point");
  for (const double mass : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    options.masses = {1, mass};
    EXPECT_PRECONDITION_ERROR(Simulation(motions, options),
                              "the mass of point 1 is not positive and finite");
    Simulation simulation(motions, discs(1, collide_elastically));
    EXPECT_PRECONDITION_ERROR(simulation.insert({{9, 9}, {0, 0}, 0}, mass),
                              "the mass of point 2 is not positive and finite");
    EXPECT_PRECONDITION_ERROR(simulation.schedule_insert(1.0, {{9, 9}, {0, 0}, 0}, mass),
                              "the mass of point 2 is not positive and finite");
    EXPECT_PRECONDITION_ERROR(simulation.set_mass(0, mass),
                              "the mass of point 0 is not positive and finite");
    EXPECT_EQ(simulation.triangulation().next_id(), 2u);
  }
  Simulation simulation(motions, options = discs(1, collide_elastically));
  EXPECT_PRECONDITION_ERROR(simulation.set_mass(2, 1),
                            "no point has the id 2; ask contains(id) first");
}

}  // namespace
}  // namespace kinetri::collision_response_test
