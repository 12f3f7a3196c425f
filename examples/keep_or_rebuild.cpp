// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 9, keep or rebuild: birds turn at every step, all at once, and the triangulation is kept.
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>
#include <kinetri/triangulation/queries_2.h>

#include <cstddef>
#include <iostream>
#include <vector>

using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<>;

// Each bird follows the nearest one if that has a smaller id. One call changes all velocities that
// differ. Returns their number.
static std::size_t turn(Triangulation& kdt, double now) {
  const auto nearest = kinetri::Kinetic_queries_2(kdt, now).nearest_neighbors();
  std::vector<kinetri::Point_id> ids;
  std::vector<kinetri::Linear_motion_2> motions;
  for (kinetri::Point_id id = 0; id < kdt.next_id(); ++id) {
    const kinetri::Vector_2 velocity = kdt.motion(nearest[id]).velocity;
    if (nearest[id] > id || velocity == kdt.motion(id).velocity) continue;
    ids.push_back(id);
    motions.push_back(with_velocity_at(kdt.motion(id), velocity, now));
  }
  kdt.set_motions(ids, motions);
  return ids.size();
}

int main() {
  const std::vector<kinetri::Linear_motion_2> birds = {
      {{0, 0}, {1, 1}},  {{4, 1}, {-1, 2}},  {{9, 2.5}, {-2, 1}}, {{1, 6.5}, {1, -1}},
      {{5, 5}, {0, -1}}, {{8, 7}, {-1, -1}}, {{3, 9}, {0.5, -2}}, {{12, 5.5}, {-2, 0.5}}};
  Triangulation kdt(birds);
  for (double now = 0; now < 5; ++now) {
    const std::size_t turned = turn(kdt, now);
    const std::size_t events = kdt.advance_to(now + 1);
    std::cout << "from t = " << now << " to " << now + 1 << ": turned " << turned << ", events "
              << events << '\n';
  }
}
