// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 1, a first run: a boat sails through a field of buoys, and its neighbors change.
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>

#include <iostream>
#include <vector>

using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<>;

static void print_edges(const Triangulation& kdt) {
  for (const auto [a, b] : kdt.finite_edge_ids()) std::cout << ' ' << a << '-' << b;
  std::cout << '\n';
}

int main() {
  // Each motion is {position at time 0, velocity}. Points 0 to 3 are buoys and rest; point 4 is the
  // boat.
  const std::vector<kinetri::Linear_motion_2> motions = {
      {{0, 0}, {0, 0}}, {{6, 0}, {0, 0}}, {{6, 4}, {0, 0}}, {{0, 5}, {0, 0}}, {{2, -3}, {0.5, 1}}};

  Triangulation kdt(motions);
  std::cout << "t = 0:";
  print_edges(kdt);

  // From event to event, up to and including time 10.
  while (const std::size_t events = kdt.step(10)) {
    std::cout << "t = " << kdt.current_time().to_double() << ", events " << events << ':';
    print_edges(kdt);
  }
  kdt.advance_to(10);  // no event is left; this advances the clock

  if (!kdt.next_event_time()) std::cout << "no further event\n";
  const kinetri::Vector_2 position = rounded_place(kdt.motion(4), 10);
  std::cout << "at t = 10 the boat is at (" << position.x << ", " << position.y << ")\n";

  const bool is_right = kdt.audit(kinetri::Audit_level::certificates).passed();
  std::cout << (is_right ? "audit passed\n" : "audit failed\n");
  return is_right ? 0 : 1;
}
