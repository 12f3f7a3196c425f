// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 10, discs of any size: a storm that hides an island, and grains with masses.
#include <kinetri/simulation/simulation_2.h>
#include <kinetri/triangulation/kinetic_regular_triangulation_2.h>

#include <iostream>
#include <vector>

using Regular = kinetri::Kinetic_regular_triangulation_2<>;
using Simulation = kinetri::Simulation_2<kinetri::Disc_kinetic_traits_2>;

// Prints what happens to points, and ignores the edges.
struct Reporter : kinetri::Event_observer {
  void after_event(const kinetri::Event& event) override {
    if (!event.point_a) return;
    std::cout << "t = " << event.time.to_double() << ": " << name(event.kind) << ' '
              << *event.point_a;
    if (event.point_b) std::cout << " and " << *event.point_b;
    std::cout << '\n';
  }
};

// A storm passes over an island that lies between three others.
static bool hide_an_island() {
  const std::vector<kinetri::Disc_motion_2> discs = {
      // {{position, velocity}, radius at time 0, growth of the radius}
      {{{-20, -10}, {0, 0}}, 1},
      {{{20, -10}, {0, 0}}, 1},
      {{{0, 30}, {0, 0}}, 1},
      {{{0, 1}, {0, 0}}, 1},           // the island
      {{{-12, 0}, {1, 0}}, 3, 0.25}};  // the storm
  Reporter reporter;
  Regular regular(discs);
  regular.add_observer(reporter);
  regular.advance_to(12);
  std::cout << "at t = 12, island 3 is " << (regular.is_hidden(3) ? "hidden" : "a vertex")
            << "; edges:";
  for (const auto [a, b] : regular.finite_edge_ids()) std::cout << ' ' << a << '-' << b;
  std::cout << '\n';
  regular.advance_to(40);
  return regular.audit(kinetri::Audit_level::certificates).passed();
}

static void print_energy(const Simulation& simulation) {
  double energy = 0;
  for (kinetri::Point_id id = 0; id < simulation.triangulation().number_of_points(); ++id) {
    const auto& [vx, vy] = simulation.triangulation().motion(id).velocity;
    energy += simulation.mass(id) * (vx * vx + vy * vy) / 2;
  }
  std::cout << "t = " << simulation.current_time().to_double() << ": energy " << energy << '\n';
}

// A large grain, a small one, and a speck between walls. The masses are the areas, up to a factor.
static bool let_grains_collide() {
  const std::vector<kinetri::Disc_motion_2> grains = {
      {{{4, 5}, {1, 0}}, 2}, {{{10, 5}, {0, 0}}, 1}, {{{13, 5}, {0, 0}}, 0.5}};
  kinetri::Simulation_options options;
  options.box = kinetri::Box_2{0, 0, 20, 10};
  options.rim_touches = true;  // the boundary of each disc
  options.response = kinetri::collide_elastically;
  options.masses = {4, 1, 0.25};
  options.refuses_overlaps = true;
  Reporter reporter;
  Simulation simulation(grains, options);
  simulation.add_observer(reporter);
  print_energy(simulation);
  simulation.advance_to(12);
  print_energy(simulation);
  return simulation.audit(kinetri::Audit_level::certificates).passed();
}

int main() {
  const bool is_right = hide_an_island();
  return let_grains_collide() && is_right ? 0 : 1;
}
