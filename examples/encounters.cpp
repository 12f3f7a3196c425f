// SPDX-License-Identifier: GPL-3.0-or-later
#include <kinetri/observers/connected_components.h>
#include <kinetri/observers/encounters.h>

#include <iostream>
#include <vector>

int main() {
  // Boats with radios, in kilometers and hours. A radio reaches 5 km.
  const std::vector<kinetri::Linear_motion_2> boats = {
      {{0, 0}, {8, 0}},    // eastward
      {{24, 3}, {-8, 0}},  // westward
      {{12, -9}, {0, 6}},  // a ferry, northward
      {{4, 6}, {8, -1}},   // eastward, and a little southward
      {{10, 5}, {0, 0}},   // at anchor
  };
  const double range = 5;
  kinetri::Simulation_2<> simulation(boats, {});
  kinetri::Encounters<> encounters(simulation, range);
  kinetri::Connected_components<> components(simulation, range);
  components.watch({0, 1});
  simulation.advance_to(3);

  std::cout << "who hears whom:\n";
  for (const kinetri::Encounter& encounter : encounters.encounters()) {
    std::cout << encounter.points[0] << " and " << encounter.points[1] << ": from "
              << encounter.begin.to_double() << " to " << encounter.end.to_double()
              << ", nearest at " << encounter.closest.to_double() << ": " << encounter.distance
              << " km\n";
  }

  std::cout << "\nthe network:\n";
  for (const kinetri::Component_event& event : components.events()) {
    std::cout << event.time.to_double() << ' ' << name(event.kind);
    if (event.kind != kinetri::Component_event_kind::start) {
      std::cout << ' ' << event.points[0] << '-' << event.points[1];
    }
    std::cout << ": parts " << event.components << ", boats in the largest " << event.largest
              << '\n';
  }

  std::cout << "\na message gets from 0 to 1:\n";
  for (const kinetri::Time_interval& interval : components.connected_intervals({0, 1})) {
    std::cout << "from " << interval.begin.to_double() << " to " << interval.end.to_double()
              << '\n';
  }
}
