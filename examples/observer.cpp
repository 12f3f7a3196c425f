// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 2, observers: what happens, as it happens. Ships cross a strait; an observer keeps who was
// whose neighbor, and for how long.
#include <kinetri/simulation/event_statistics.h>
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>

#include <iostream>
#include <map>
#include <vector>

namespace {

using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<>;
using Time = Triangulation::Time;
using Event = kinetri::Event<Time>;

// Prints each event, and how long an edge had been there that goes.
class Neighborhoods : public kinetri::Event_observer<Time> {
 public:
  explicit Neighborhoods(const Triangulation& kdt) {
    for (const kinetri::Edge_ids& edge : kdt.finite_edge_ids()) since_[edge] = kdt.current_time();
  }

  void after_event(const Event& event) override {
    std::cout << event.number << ": t = " << event.time.to_double() << ' ' << name(event.kind);
    if (event.removed) {
      const auto [a, b] = *event.removed;
      std::cout << ", " << a << " and " << b << " part";
      const double since = since_.at(*event.removed).to_double();
      if (since > 0) std::cout << ", neighbors since " << since;
      since_.erase(*event.removed);
    }
    if (event.added) {
      const auto [a, b] = *event.added;
      std::cout << ", " << a << " and " << b << " meet";
      since_[*event.added] = event.time;  // exact; nothing has been rounded
    }
    std::cout << '\n';
  }

 private:
  std::map<kinetri::Edge_ids, Time> since_;
};

}  // namespace

int main() {
  const std::vector<kinetri::Linear_motion_2> ships = {
      {{0, 0}, {2, 0}},    // eastward
      {{0, 6}, {2, 0}},    // likewise
      {{20, 1}, {-2, 0}},  // westward
      {{20, 7}, {-2, 0}},  // likewise
      {{9, -12}, {0, 2}},  // the ferry, northward
  };
  Triangulation kdt(ships);

  Neighborhoods neighborhoods(kdt);
  kinetri::Event_statistics<> statistics(0, 10, 2);  // by halves of the time from 0 to 10
  kdt.add_observer(neighborhoods);
  kdt.add_observer(statistics);
  kdt.advance_to(10);
  kdt.remove_observer(neighborhoods);

  std::cout << '\n' << statistics;
  std::cout << "of the ferry: " << statistics.events_of(4) << '\n';
}
