// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 16, Sturm sequences: how many roots a certificate has, and which of them are events.
#include <kinetri/algebra/real_roots.h>
#include <kinetri/algebra/sturm_sequence.h>
#include <kinetri/kinetic/certificate_polynomials.h>
#include <kinetri/triangulation/kinetic_delaunay_triangulation_2.h>

#include <iostream>
#include <optional>
#include <vector>

using kinetri::Polynomial;
using Motions = std::vector<kinetri::Linear_motion_2>;

static void counts() {
  // Coefficients by ascending power.
  const kinetri::Sturm_sequence sequence(Polynomial{1, 0, -10, 0, 1});
  for (const Polynomial& term : sequence.terms()) std::cout << term << '\n';
  std::cout << "V: " << sequence.sign_changes_at_minus_infinity() << " ... "
            << sequence.sign_changes_at(0) << " at 0, " << sequence.sign_changes_at(1)
            << " at 1 ... " << sequence.sign_changes_at_plus_infinity() << '\n';
  const kinetri::Interval_end zero{0, false};
  std::cout << "roots in (0, 1] " << sequence.count(zero, kinetri::Interval_end{1, true})
            << ", above 0 " << sequence.count(zero, std::nullopt) << ", all " << sequence.count()
            << '\n';
}

// The edge between the first two points, with the third one to its left: Delaunay while this is
// positive.
static Polynomial certificate(const Motions& motions) {
  std::vector<kinetri::Moving_point_2> points;
  for (const auto& motion : motions) points.emplace_back(motion);
  return primitive_part(-in_circle_polynomial(points[0], points[1], points[2], points[3]));
}

static void show(const char* title, const Motions& motions) {
  const Polynomial f = certificate(motions);
  std::cout << title << ": " << f << '\n';
  if (!f.is_zero()) {
    for (const kinetri::Real_root& root : real_roots(f)) {
      std::cout << "  root " << root.value << ", multiplicity " << root.multiplicity << '\n';
    }
    std::cout << "  last term " << kinetri::Sturm_sequence(f).terms().back() << '\n';
  }
  const std::optional<kinetri::Algebraic_number> failure = failure_time(f, 0.0);
  if (failure) std::cout << "  fails at " << *failure << '\n';
  kinetri::Kinetic_delaunay_triangulation_2<> kdt(motions);
  std::cout << "  events until 2.5: " << kdt.advance_to(2.5) << '\n';
}

int main() {
  counts();
  show("touch",
       {{{0, 1}, {0, 0}}, {{0, -1}, {0, 0}}, {{1.5, 0}, {-0.5, 0}}, {{-0.5, 1}, {-0.5, -1}}});
  show("growing square",
       {{{0, 1}, {0, 1}}, {{0, -1}, {0, -1}}, {{1, 0}, {1, 0}}, {{-1, 0}, {-1, 0}}});
  show("triple root", {{{1, 1}, {-1, 0}}, {{0, -1}, {0, 0}}, {{1, -1}, {0, 1}}, {{-1, 0}, {0, 0}}});
}
