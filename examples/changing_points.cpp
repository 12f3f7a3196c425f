// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 5, insertion, turning, erasure: drones over a field appear, change course and leave. First
// by direct calls, then by a schedule.
#include <kinetri/simulation/simulation_2.h>

#include <iostream>
#include <vector>

using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<>;

static void print_edges(const Triangulation& kdt) {
  std::cout << "t = " << kdt.current_time().to_double() << ':';
  for (const auto [a, b] : kdt.finite_edge_ids()) std::cout << ' ' << a << '-' << b;
  std::cout << '\n';
}

static void by_calls(const std::vector<kinetri::Linear_motion_2>& drones) {
  Triangulation kdt(drones);
  kdt.advance_to(1);
  print_edges(kdt);

  // {position, velocity, epoch}: the point is at the position at the epoch, here at time 1.
  const kinetri::Point_id id = kdt.insert({{4, 3}, {0, 0.5}, 1});
  std::cout << "insert " << id << ", of degree " << kdt.triangulation().degree(kdt.vertex(id))
            << '\n';
  print_edges(kdt);

  // A new velocity from time 3 on. The id and the vertex stay the same.
  kdt.advance_to(3);
  kdt.set_motion(id, with_velocity_at(kdt.motion(id), {-1, 0}, 3));
  kdt.advance_to(4);
  print_edges(kdt);

  // Of two points with the same trajectory the one with the least id hides the other, until one of
  // them changes.
  const kinetri::Linear_motion_2 alone = kdt.motion(0);
  kdt.set_motion(0, kdt.motion(2));
  std::cout << "together: point 2 is " << (kdt.is_hidden(2) ? "hidden" : "not hidden") << '\n';
  print_edges(kdt);
  kdt.set_motion(0, alone);

  // The id is not used again.
  kdt.erase(id);
  std::cout << "erase " << id << ", the next id is " << kdt.next_id() << '\n';
  print_edges(kdt);
}

static void by_schedule(const std::vector<kinetri::Linear_motion_2>& drones) {
  // The same changes, known in advance. A simulation makes each one at its time.
  kinetri::Simulation_2<> simulation(drones, {});
  const kinetri::Point_id id = simulation.schedule_insert(1, {{4, 3}, {0, 0.5}, 1});
  simulation.schedule_motion(3, id, {{4, 4}, {-1, 0}, 3});
  simulation.schedule_erase(4, id);
  for (const double t : {1, 4}) {
    simulation.advance_to(t);
    print_edges(simulation.triangulation());
  }
}

int main() {
  const std::vector<kinetri::Linear_motion_2> drones = {
      {{0, 0}, {1, 0}}, {{8, 0}, {0, 1}}, {{9, 8}, {-1, 0}}, {{0, 7}, {0, -1}}};
  by_calls(drones);
  by_schedule(drones);
}
