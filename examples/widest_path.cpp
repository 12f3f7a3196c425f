// SPDX-License-Identifier: GPL-3.0-or-later
//
// How wide a ship can leave a harbor while boats cross its entrance, and when the path closes.
#include <kinetri/observers/widest_path.h>
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <vector>

using Sea = kinetri::Kinetic_delaunay_triangulation_2<>;
using kinetri::Algebraic_number;
using kinetri::Vector_2;

static const Vector_2 berth = {3, 3.25};
static const Vector_2 open_sea = {20, 3.25};

// Piles at rest around the harbor, which is open between (8, 1) and (8, 5), and two boats.
static std::vector<kinetri::Linear_motion_2> piles_and_boats() {
  std::vector<kinetri::Linear_motion_2> points;
  for (int x = 0; x <= 8; ++x) {
    for (const double y : {0.0, 6.0}) points.push_back({{double(x), y}, {0, 0}});
  }
  for (int y = 1; y <= 5; ++y) points.push_back({{0, double(y)}, {0, 0}});
  points.push_back({{8, 1}, {0, 0}});
  points.push_back({{8, 5}, {0, 0}});
  points.push_back({{8.25, 9}, {0, -1}});     // crosses the entrance
  points.push_back({{13, -2}, {-0.5, 0.5}});  // comes in
  return points;
}

// The first time up to `until` at which no path for a ship of this width is left. Each round finds
// the bottleneck path, the widest one, which stays the widest at least until one of its gaps is too
// narrow or the triangulation changes.
static std::optional<Algebraic_number> closing_time(Sea& sea, double width, double until) {
  while (true) {
    const kinetri::Widest_path path = widest_path(sea, berth, open_sea);
    std::optional<Algebraic_number> next = end_of_path(sea, path, width);
    if (next && *next == sea.current_time()) return next;
    const auto event = sea.next_event_time();
    if (event && (!next || *event < *next)) next = event;
    if (!next || *next > Algebraic_number(until)) return std::nullopt;
    sea.advance_to(*next);
  }
}

static void print_path(const Sea& sea) {
  const kinetri::Widest_path path = widest_path(sea, berth, open_sea);
  const double t = sea.current_time().to_double();
  const auto [a, b] = *path.narrowest;
  const Vector_2 p = rounded_place(sea.motion(a), t);
  const Vector_2 q = rounded_place(sea.motion(b), t);
  std::cout << "t = " << t << ": " << path.gaps.size() << " gaps; the narrowest, between " << a
            << " and " << b << ", is " << std::hypot(p.x - q.x, p.y - q.y) << " wide\n";
}

int main() {
  {
    Sea sea(piles_and_boats());
    for (const double t : {0.0, 5.0, 6.0, 8.0, 14.0}) {
      sea.advance_to(t);
      print_path(sea);
    }
  }
  bool is_right = true;
  for (const double width : {3.5, 2.5, 2.0, 1.75}) {
    Sea sea(piles_and_boats());
    std::cout << "a ship of width " << width;
    if (const auto time = closing_time(sea, width, 15)) {
      const kinetri::Widest_path path = widest_path(sea, berth, open_sea);
      std::cout << ": the way closes at t = " << time->to_double() << ", between "
                << (*path.narrowest)[0] << " and " << (*path.narrowest)[1] << ";\n    " << *time
                << '\n';
    } else {
      std::cout << ": the way is open until t = 15\n";
    }
    is_right = sea.audit(kinetri::Audit_level::certificates).passed() && is_right;
  }
  return is_right ? 0 : 1;
}
