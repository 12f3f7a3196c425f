// SPDX-License-Identifier: GPL-3.0-or-later
#include <kinetri/kinetri.h>

#include <iostream>

int main() {
  // {position at time 0, velocity}: three corners of a square; a point falls through the fourth.
  const std::vector<kinetri::Linear_motion_2> motions = {
      {{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}, {{2, 2}, {0, 0}}, {{0, 3}, {0, -1}}};
  kinetri::Kinetic_delaunay_triangulation_2<> kdt(motions);
  std::cout << "first event at t = " << kdt.next_event_time()->to_double() << '\n';
  kdt.advance_to(1.5);  // executes every event up to and including t = 1.5
  for (auto [a, b] : kdt.finite_edge_ids()) std::cout << a << " - " << b << '\n';
  return kdt.audit(kinetri::Audit_level::certificates).passed() ? 0 : 1;
}
