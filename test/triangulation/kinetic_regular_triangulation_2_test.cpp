// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic regular triangulation against CGAL's static one, event by event.
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/multiplier.h"

namespace kinetri {
namespace {

using test::multiplier;

using Kinetic = Kinetic_regular_triangulation_2<>;

Disc_motion_2 disc(double x, double y, double vx, double vy, double radius, double growth = 0,
                   double weight = 0) {
  return {{{x, y}, {vx, vy}, 0}, radius, growth, weight};
}

std::string text(const std::vector<Disc_motion_2>& discs) {
  std::ostringstream out;
  out.precision(17);
  for (const Disc_motion_2& d : discs) {
    out << "disc(" << d.position.x << ", " << d.position.y << ", " << d.velocity.x << ", "
        << d.velocity.y << ", " << d.radius << ", " << d.growth << ", " << d.weight << "),\n";
  }
  return out.str();
}

// Audits after each event up to `until`; at most `most` instants.
template <class Triangulation>
void run_audited(Triangulation& kinetic, double until, int most, Audit_level level) {
  const auto start = kinetic.audit(level);
  ASSERT_TRUE(start.passed()) << "at the start: " << start.failures.front();
  for (int i = 0; i < most && kinetic.step(Algebraic_number(until)) > 0; ++i) {
    const auto report = kinetic.audit(level);
    ASSERT_TRUE(report.passed()) << "after instant " << i << " at "
                                 << kinetic.current_time().to_double() << ": "
                                 << report.failures.front();
  }
}

// Random discs in a square of side 10; on a lattice if `step` is not zero.
std::vector<Disc_motion_2> random_discs(std::mt19937_64& random, std::size_t points, double step,
                                        double largest_radius, double largest_growth,
                                        double largest_weight) {
  const auto number = [&](double from, double to) {
    const double x = from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
    return step == 0 ? x : std::round(x / step) * step;
  };
  std::vector<Disc_motion_2> discs;
  while (discs.size() < points) {
    const Disc_motion_2 d =
        disc(number(0, 10), number(0, 10), number(-1, 1), number(-1, 1), number(0, largest_radius),
             number(-largest_growth, largest_growth), number(-largest_weight, largest_weight));
    const auto is_alike = [&](const Disc_motion_2& other) { return same_trajectory(d, other); };
    if (std::ranges::none_of(discs, is_alike)) discs.push_back(d);
  }
  return discs;
}

TEST(Kinetic_regular_triangulation, of_random_discs_is_that_of_CGAL_after_each_event) {
  std::mt19937_64 random(1);
  std::uint64_t hidden_events = 0;
  for (int run = 0; run < 30 * multiplier(); ++run) {
    const auto discs = random_discs(random, 30, 0, 2.5, 0.2, 0);
    SCOPED_TRACE("run " + std::to_string(run));
    Kinetic kinetic(discs);
    run_audited(kinetic, 4, 60, Audit_level::certificates);
    if (HasFatalFailure()) return;
    hidden_events += kinetic.counters().events[static_cast<std::size_t>(Event_kind::hide)] +
                     kinetic.counters().events[static_cast<std::size_t>(Event_kind::reveal)];
    EXPECT_EQ(kinetic.counters().reconstructions, 0u);
  }
  EXPECT_GT(hidden_events, 100u);
}

TEST(Kinetic_regular_triangulation, of_few_points_with_any_weights_is_that_of_CGAL) {
  std::mt19937_64 random(2);
  for (int run = 0; run < 300 * multiplier(); ++run) {
    const auto discs = random_discs(random, static_cast<std::size_t>(1 + run % 9), 0, 3, 1, 4);
    SCOPED_TRACE("run " + std::to_string(run) + "\n" + text(discs));
    Kinetic kinetic(discs);
    run_audited(kinetic, 10, 100, Audit_level::certificates);
    if (HasFatalFailure()) return;
  }
}

TEST(Kinetic_regular_triangulation, of_discs_on_a_lattice_is_that_of_CGAL) {
  std::mt19937_64 random(3);
  for (int run = 0; run < 300 * multiplier(); ++run) {
    const double step = run % 2 == 0 ? 1 : 2;
    const auto discs = random_discs(random, static_cast<std::size_t>(1 + run % 9), step, 4, 1, 4);
    SCOPED_TRACE("run " + std::to_string(run) + "\n" + text(discs));
    Kinetic kinetic(discs);
    run_audited(kinetic, 10, 100, Audit_level::certificates);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace kinetri
