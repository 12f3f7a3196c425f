// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 5, insertion, turning, erasure: drones over a field come, change their course, and go,
// while time runs. First by hand, then by a schedule.
#include <kinetri/simulation/simulation_2.h>

#include <iostream>
#include <vector>

namespace {

using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<>;

void print_edges(const Triangulation& kdt) {
  std::cout << "t = " << kdt.current_time().to_double() << ':';
  for (const auto [a, b] : kdt.finite_edge_ids()) std::cout << ' ' << a << '-' << b;
  std::cout << '\n';
}

const std::vector<kinetri::Linear_motion_2> drones = {
    {{0, 0}, {1, 0}}, {{8, 0}, {0, 1}}, {{9, 8}, {-1, 0}}, {{0, 7}, {0, -1}}};

void by_hand() {
  Triangulation kdt(drones);
  kdt.advance_to(1);
  print_edges(kdt);

  // A motion holds for all times. The third part is its epoch: the time at which the point is at
  // the place, here (4, 3) at time 1. What was before has been and is not changed.
  const auto newcomer = kdt.insert({{4, 3}, {0, 0.5}, 1});
  const kinetri::Point_id id = newcomer->point().id();
  std::cout << "insert " << id << ", of degree " << kdt.triangulation().degree(newcomer) << '\n';
  print_edges(kdt);

  // From where it is at time 3 it goes on with another velocity: its handle stays, and its id.
  kdt.advance_to(3);
  kdt.set_motion(newcomer, turned(kdt.motion(id), {-1, 0}, 3));
  kdt.advance_to(4);
  print_edges(kdt);

  // Two points that go the same way for ever could not both be vertices.
  try {
    kdt.set_motion(kdt.vertex(0), kdt.motion(2));
  } catch (const kinetri::Coincident_trajectories_error& error) {
    std::cout << "refused: " << error.what() << '\n';  // and nothing has changed
  }

  // Erased: its handle is not valid any more, and its id is never given again.
  kdt.erase(newcomer);
  std::cout << "erase " << id << ", the next id is " << kdt.next_id() << '\n';
  print_edges(kdt);
}

void by_schedule() {
  // The same changes, known beforehand. A simulation makes each at its time, between the events.
  kinetri::Simulation_2<> simulation(drones, {});
  const kinetri::Point_id id = simulation.schedule_insert(1, {{4, 3}, {0, 0.5}, 1});
  simulation.schedule_motion(3, id, {{4, 4}, {-1, 0}, 3});
  simulation.schedule_erase(4, id);
  for (const double t : {1, 4}) {
    simulation.advance_to(t);
    print_edges(simulation.triangulation());
  }
}

}  // namespace

int main() {
  by_hand();
  by_schedule();
}
