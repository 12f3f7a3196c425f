// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 8, exact times and audits: two event times that doubles cannot distinguish, simultaneous
// events, and an audit that fails.
#include <kinetri/algebra/real_roots.h>
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>

#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

using Triangulation = kinetri::Kinetic_delaunay_triangulation_2<>;
using Time = kinetri::Algebraic_number;

// Three points rest on the unit circle. A fourth one leaves it, from (x, 0) in direction (1, 1).
static std::vector<kinetri::Linear_motion_2> leaving(double x) {
  return {{{-1, 0}, {0, 0}}, {{0, -1}, {0, 0}}, {{0, 1}, {0, 0}}, {{x, 0}, {1, 1}}};
}

static void compare_times() {
  Triangulation first(leaving(0));
  Triangulation second(leaving(0x1p-60));
  const Time a = *first.next_event_time();
  const Time b = *second.next_event_time();

  std::cout << std::setprecision(17);
  std::cout << "a = " << a.to_double() << ", root of " << a.polynomial() << '\n';
  std::cout << "b = " << b.to_double() << '\n';
  const auto [lower, upper] = b.tight_interval();
  std::cout << "  between " << lower << "\n      and " << upper << '\n';
  std::cout << "as doubles " << (a.to_double() == b.to_double() ? "equal" : "not equal")
            << ", but b " << (b < a ? "is before" : "is not before") << " a\n";

  // Isolating intervals can be refined to any width.
  b.refine_to(kinetri::Rational(1, 1'000'000'000));
  std::cout << "isolated to " << (b.upper() - b.lower() <= 1e-9 ? "a billionth" : "more") << '\n';
  const kinetri::Rational between = kinetri::simplest_between(b, a);
  std::cout << "b < " << between << " < a\n";
}

static void simultaneous_events() {
  // Two rows of a lattice. The upper row moves; all its cells become squares at the same time.
  std::vector<kinetri::Linear_motion_2> motions;
  for (int x = 0; x < 9; ++x) motions.push_back({{2.0 * x, 0}, {0, 0}});
  for (int x = 0; x < 9; ++x) motions.push_back({{2.0 * x + 0.5, 1}, {1, 0}});
  Triangulation kdt(motions);
  const std::size_t events = kdt.step();
  const Time& t = kdt.current_time();
  std::cout << "events " << events << " at t = " << t << (t.is_known_rational() ? ", rational" : "")
            << '\n';
}

static void audits() {
  Triangulation kdt(leaving(0));
  const std::vector<kinetri::Audit_level> levels = {
      kinetri::Audit_level::links, kinetri::Audit_level::embedding, kinetri::Audit_level::delaunay,
      kinetri::Audit_level::reference, kinetri::Audit_level::certificates};
  for (const auto level : levels) std::cout << kdt.audit(level).passed() << ' ';
  std::cout << "at the start\n";

  // Do not do this: it bypasses set_motion, and so the triangulation is not updated.
  kdt.vertex(3)->point() = kinetri::Moving_point_2({{3, 0}, {-1, 0}}, 3);
  for (const auto level : levels) std::cout << kdt.audit(level).passed() << ' ';
  std::cout << "after that\n";
  for (const std::string& failure : kdt.audit(levels.back()).failures) std::cout << failure << '\n';
}

int main() {
  compare_times();
  simultaneous_events();
  audits();
}
