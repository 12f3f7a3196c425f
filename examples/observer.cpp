// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 2, observers: ships cross a strait. An observer records which ships are neighbors, and
// since when.
#include <kinetri/simulation/event_statistics.h>
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>

#include <iostream>
#include <map>
#include <vector>

using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<>;
using Time = Triangulation::Time;

// Prints each event. If an edge is removed, prints since when it existed.
class Neighborhoods : public kinetri::Event_observer {
 public:
  explicit Neighborhoods(const Triangulation& kdt) {
    for (const kinetri::Edge_ids& edge : kdt.finite_edge_ids()) since_[edge] = kdt.current_time();
  }

  void after_event(const kinetri::Event& event) override {
    std::cout << event.number << ": t = " << event.time.to_double() << ' ' << name(event.kind);
    if (event.removed) {
      const auto [a, b] = *event.removed;
      std::cout << ", removes " << a << '-' << b;
      const double since = since_.at(*event.removed).to_double();
      if (since > 0) std::cout << " (since " << since << ')';
      since_.erase(*event.removed);
    }
    if (event.added) {
      const auto [a, b] = *event.added;
      std::cout << ", adds " << a << '-' << b;
      since_[*event.added] = event.time;  // the exact time
    }
    std::cout << '\n';
  }

 private:
  std::map<kinetri::Edge_ids, Time> since_;
};

int main() {
  const std::vector<kinetri::Linear_motion_2> ships = {
      {{0, 0}, {2, 0}},    // eastward
      {{0, 6}, {2, 0}},    // eastward
      {{20, 1}, {-2, 0}},  // westward
      {{20, 7}, {-2, 0}},  // westward
      {{9, -12}, {0, 2}},  // a ferry, northward
  };
  Triangulation kdt(ships);

  Neighborhoods neighborhoods(kdt);
  kinetri::Event_statistics statistics(0, 10, 2);  // two intervals, [0, 5] and [5, 10]
  kdt.add_observer(neighborhoods);
  kdt.add_observer(statistics);
  kdt.advance_to(10);
  kdt.remove_observer(neighborhoods);  // before they are destroyed
  kdt.remove_observer(statistics);

  std::cout << '\n' << statistics;
  std::cout << "events of the ferry: " << statistics.events_of(4) << '\n';
}
