// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 17, periodic boxes: a lattice of cells that is sheared, and one point alone.
#include <kinetri/kinetic/periodic_kinetic_traits_2.h>
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>

#include <iostream>
#include <vector>

using Traits = kinetri::Periodic_kinetic_traits_2;
using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<Traits>;

// Prints edges that are replaced. An offset says which image of the second point is meant.
struct Reporter : kinetri::Event_observer {
  void after_event(const kinetri::Event& event) override {
    if (event.kind != kinetri::Event_kind::flip) return;
    std::cout << "t = " << event.time.to_double() << ':';
    print(*event.removed, event.removed_offset);
    std::cout << " gives way to";
    print(*event.added, event.added_offset);
    std::cout << '\n';
  }
  static void print(const kinetri::Edge_ids& ids, const kinetri::Lattice_offset_2& offset) {
    std::cout << ' ' << ids[0] << '-' << ids[1] << " (" << offset.x << ", " << offset.y << ')';
  }
};

// One point, whose images are the corners of the box and its copies: three edges and two triangles.
static bool shear_one_point() {
  // Each lattice vector is {vector at time 0, its rate}.
  const kinetri::Periodic_box_2 box({{1, 0}, {0, 0}}, {{0, 1}, {1, 0}});
  Triangulation one({{{0.5, 0.5}, {0, 0}}}, 0, Traits(box));
  Reporter reporter;
  one.add_observer(reporter);
  one.advance_to(2);
  return one.audit(kinetri::Audit_level::certificates).passed();
}

// Eight points drift with the shear of their box: each keeps its place relative to the corners.
static bool shear_eight_points() {
  const double rate = 0.5;
  const kinetri::Periodic_box_2 box({{4, 0}, {0, 0}}, {{0, 4}, {4 * rate, 0}});
  std::vector<kinetri::Linear_motion_2> motions;
  for (const auto [x, y] : {kinetri::Vector_2{0.5, 0.25},
                            {2.25, 0.5},
                            {1.25, 1.5},
                            {3.25, 1.25},
                            {0.25, 2.5},
                            {2.5, 2.25},
                            {1.5, 3.5},
                            {3.5, 3.25}}) {
    motions.push_back({{x, y}, {rate * y, 0}});
  }
  Triangulation cells(motions, 0, Traits(box));
  for (const double strain : {0.5, 1.0, 1.5, 2.0}) {
    cells.advance_to(strain / rate);
    std::cout << "strain " << strain << ": " << cells.counters().number_of_events()
              << " events so far, " << cells.periodic_edges().size() << " edges\n";
  }
  return cells.audit(kinetri::Audit_level::certificates).passed();
}

int main() {
  const bool is_right = shear_one_point();
  return shear_eight_points() && is_right ? 0 : 1;
}
