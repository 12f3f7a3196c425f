// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 3, walls and discs: curling stones on a sheet of ice.
#include <kinetri/simulation/simulation_2.h>

#include <iostream>
#include <vector>

using Simulation = kinetri::Simulation_2<>;
using Time = Simulation::Time;

// Prints contacts, and ignores all other events.
struct Contacts : kinetri::Event_observer {
  void after_event(const kinetri::Event& event) override {
    if (event.kind == kinetri::Event_kind::wall) {
      std::cout << "t = " << event.time.to_double() << ": stone " << *event.point_a
                << " hits a wall\n";
    } else if (event.kind == kinetri::Event_kind::collision) {
      std::cout << "t = " << event.time.to_double() << ": stone " << *event.point_a
                << " hits stone " << *event.point_b << '\n';
    }
  }
};

static void print_stones(const Simulation& simulation) {
  const double t = simulation.current_time().to_double();
  double energy = 0;
  for (kinetri::Point_id id = 0; id < simulation.triangulation().number_of_points(); ++id) {
    const auto& motion = simulation.triangulation().motion(id);
    const auto& [vx, vy] = motion.velocity;
    const auto [x, y] = rounded_place(motion, t);
    std::cout << "  stone " << id << " at (" << x << ", " << y << "), velocity (" << vx << ", "
              << vy << ")\n";
    energy += (vx * vx + vy * vy) / 2;
  }
  std::cout << "  energy " << energy << '\n';
}

int main() {
  const std::vector<kinetri::Linear_motion_2> stones = {
      {{2, 4}, {2, 0}},    // hits stone 1
      {{8, 4}, {0, 0}},    // rests, and then hits stone 2
      {{12, 4}, {0, 0}},   // rests
      {{3, 3}, {-1, -1}},  // slides into a corner
      {{9, 7}, {0, 0}}};   // rests, and is never hit

  kinetri::Simulation_options options;
  options.box = kinetri::Box_2{0, 0, 16, 8};  // xmin, ymin, xmax, ymax
  options.radius = 0.5;
  options.rim_touches = true;  // the boundaries of the stones touch the walls, not their centers
  options.response = kinetri::collide_elastically;

  Contacts contacts;  // outlives the simulation
  Simulation simulation(stones, options);
  simulation.add_observer(contacts);
  print_stones(simulation);
  simulation.advance_to(8);
  print_stones(simulation);

  std::cout << "edges at t = 8:";
  for (const auto [a, b] : simulation.triangulation().finite_edge_ids()) {
    std::cout << ' ' << a << '-' << b;
  }
  std::cout << '\n';
  return simulation.audit(kinetri::Audit_level::certificates).passed() ? 0 : 1;
}
