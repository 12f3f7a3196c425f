// SPDX-License-Identifier: GPL-3.0-or-later
//
// Encounters of discs with radii of their own in periodic boxes, compared with the quadratics of
// all pairs of images.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "kinetri/observers/encounters.h"
#include "observers/random_runs.h"
#include "support/image_pairs.h"
#include "support/precondition_error.h"

namespace kinetri::periodic_encounters_discs_test {
namespace {

using Traits = Periodic_disc_kinetic_traits_2;
using Simulation = Simulation_2<Traits>;
using Discs = std::vector<Disc_motion_2>;

constexpr double end = 3;

Disc_motion_2 disc(const Vector_2& position, const Vector_2& velocity, double radius,
                   double growth = 0, double epoch = 0) {
  return {{position, velocity, epoch}, radius, growth, epoch};
}

Periodic_box_2 square(double side) {
  return {{{side, 0}, {0, 0}, 0}, {{0, side}, {0, 0}, 0}};
}

Simulation_options responding(const Collision_response& response) {
  Simulation_options options;
  options.response = response;
  return options;
}

/// A simulation with encounters and with all motions.
struct Observed {
  Observed(const Discs& discs, const Simulation_options& options, const Periodic_box_2& in,
           double gap_range)
      : box(in),
        range(gap_range),
        simulation(discs, options, 0, Traits(box)),
        recorder(simulation),
        encounters(simulation, range) {}

  /// The encounters by brute force.
  std::vector<Encounter> expected() const {
    std::vector<Encounter> result;
    test::for_each_pair_of_images(box, recorder.legs(), range, end,
                                  [&](const Periodic_edge& pair, const auto& p, const auto& q) {
                                    test::add_encounters(p, q, pair, 0, range, false, result);
                                  });
    test::sort_encounters(result);
    return result;
  }

  Periodic_box_2 box;
  double range;
  Simulation simulation;
  test::Leg_recorder<Traits> recorder;
  Encounters<Traits> encounters;
};

/// What the encounters of all runs of a test had.
struct Totals {
  void add(const std::vector<Encounter>& found) {
    number += found.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
      own += found[i].points[0] == found[i].points[1];
      touches += found[i].begin == found[i].end;
      overlaps += found[i].gap < 0;
      several += i > 0 && found[i].points == found[i - 1].points;
    }
  }
  std::size_t number = 0;
  std::size_t own = 0;
  std::size_t touches = 0;
  std::size_t overlaps = 0;
  std::size_t several = 0;
};

// ---- by hand ----

TEST(Periodic_encounters_of_discs, are_about_gaps_across_the_border) {
  Observed run({disc({9, 5}, {1, 0}, 0.5), disc({4, 5}, {0, 0}, 1)}, {}, square(10), 1);
  run.simulation.advance_to(3.0);
  const auto found = run.encounters.encounters();
  ASSERT_EQ(found.size(), 1U);
  // The distance to the image at 14 falls from 5; it is 2.5 at the time 2.5.
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].offset, (Lattice_offset_2{1, 0}));
  EXPECT_EQ(found[0].begin, Algebraic_number(2.5));
  EXPECT_EQ(found[0].closest, Algebraic_number(3.0));
  EXPECT_EQ(found[0].distance, 2);
  EXPECT_EQ(found[0].gap, 0.5);
}

TEST(Periodic_encounters_of_discs, with_own_images_begin_as_they_grow) {
  // The gap of the disc and its images (1, 0) is 4 - 2 t, of (1, 1) and its like sqrt(32) - 2 t, of
  // (2, 0) 8 - 2 t.
  Observed run({disc({1, 1}, {1, 3}, 0, 1)}, {}, square(4), 2);
  run.simulation.advance_to(3.0);
  const auto found = run.encounters.encounters();
  ASSERT_EQ(found.size(), 6U);
  for (const std::size_t i : {0U, 1U}) EXPECT_EQ(found[i].begin, Algebraic_number(1.0));
  for (const std::size_t i : {4U, 5U}) EXPECT_EQ(found[i].begin, Algebraic_number(3.0));
  EXPECT_EQ(found[5].offset, (Lattice_offset_2{2, 0}));
  EXPECT_EQ(found[0].gap, -2);
}

// The Voronoi cells of the centers, and the power cells, of the two large discs have no common
// side.
TEST(Periodic_encounters_of_discs, need_no_edge) {
  Observed run(
      {disc({2, 10}, {1, 0}, 3), disc({-2, 10}, {-1, 0}, 3), disc({10, 10 + 1e-3}, {0, 0}, 1e-6)},
      {}, square(20), 4);
  run.simulation.advance_to(end);
  const auto found = run.encounters.encounters();
  test::expect_equal(found, run.expected());
  // In range at the start, and again across the border.
  const auto is_of_large = [](const Encounter& e) { return e.points == Edge_ids{0, 1}; };
  EXPECT_EQ(std::ranges::count_if(found, is_of_large), 2);
}

// From then on the one with the smaller id hides the other one. Neither overlaps anything before.
TEST(Periodic_encounters_of_discs, are_those_of_discs_that_come_to_coincide) {
  for (const Point_id mover : {0U, 1U}) {
    Observed run({disc({1, 1}, {1, 0}, 0.5), disc({6, 6}, {1, 0}, 0.5)}, {}, square(10), 0);
    run.simulation.advance_to(1.0);
    Disc_motion_2 motion = run.simulation.triangulation().motion(1 - mover);
    motion.position.x += 10;
    run.simulation.set_motion(mover, motion);
    EXPECT_EQ(run.simulation.triangulation().coincident_points(mover), std::vector{1 - mover});
    run.simulation.advance_to(2.0);
    const auto found = run.encounters.encounters();
    EXPECT_EQ(found.size(), 1U);
    test::expect_equal(found, run.expected());
  }
}

TEST(Periodic_encounters_of_discs, refuse_a_range_without_finite_radii) {
  Simulation simulation({disc({0, 0}, {1, 0}, 0x1.8p1023)}, {}, 0, Traits(square(10)));
  EXPECT_PRECONDITION_ERROR(Encounters(simulation, 0x1.8p1023),
                            "the range is too large: the sum of a radius and half of it is not "
                            "finite; expected a smaller one");
}

TEST(Periodic_encounters_of_discs, refuse_a_range_with_images_beyond_all_offsets) {
  Simulation simulation({disc({0, 0}, {1, 0}, 1)}, {}, 0, Traits(square(10)));
  EXPECT_THROW(Encounters(simulation, 1e12), Periodic_box_error);
}

// ---- all pairs of images ----

constexpr std::array<double, 5> ranges = {0, 1, 2, 1.5, 3};

Discs random_discs(std::mt19937& random, std::size_t number, int greatest_radius,
                   double epoch = 0) {
  const auto integer = [&](int least, int most) {
    return double(least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1)));
  };
  Discs result;
  while (result.size() < number) {
    const double x = integer(-5, 5);
    const double y = integer(-5, 5);
    const double vx = integer(-2, 2);
    const double vy = integer(-2, 2);
    const double radius = integer(0, 2 * greatest_radius) / 2;
    // No radius is negative up to the end.
    const double growth = integer(0, 2) > 0 ? 0 : radius >= 1 ? integer(-2, 2) / 8 : 0.25;
    result.push_back(disc({x, y}, {vx, vy}, radius, growth, epoch));
  }
  return result;
}

TEST(Periodic_encounters_of_discs, are_those_of_all_pairs_of_images) {
  Totals totals;
  for (unsigned seed = 0; seed < test::cases(28u); ++seed) {
    std::mt19937 random(seed);
    const unsigned kind = seed % test::periodic_box_kinds;
    const double range = ranges[seed % ranges.size()];
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + test::periodic_box_kind(kind) +
                 ", range " + std::to_string(range));
    const Periodic_box_2 box =
        test::random_periodic_box(random, static_cast<int>(kind), seed % 3 == 0 ? 3 : 6, end);
    Observed run(random_discs(random, 1 + seed / 4 % 5, seed % 2 == 0 ? 1 : 3), {}, box, range);
    run.simulation.advance_to(1.0);
    if (seed % 2 == 0) static_cast<void>(run.encounters.encounters());
    run.simulation.advance_to(end);
    const auto found = run.encounters.encounters();
    test::expect_equal(found, run.expected());
    if (testing::Test::HasFailure()) return;
    totals.add(found);
  }
  EXPECT_GT(totals.number, 600U);
  EXPECT_GT(totals.own, 90U);
  EXPECT_GT(totals.touches, 5U);
  EXPECT_GT(totals.overlaps, 150U);
  EXPECT_GT(totals.several, 150U);
}

// Radii from 2^-12 on, in a wide box: hidden discs, and no short numbers.
TEST(Periodic_encounters_of_discs, of_many_sizes_are_those_of_all_pairs_of_images) {
  Totals totals;
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    std::mt19937_64 random(seed);
    const double range = seed % 2 == 0 ? 0.5 : 3;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Periodic_box_2 box({{20, 0}, {0, 0}, 0}, {{3, 20}, {seed % 3 - 1.0, 0}, 0});
    const auto real = [&](double least, double most) {
      return std::uniform_real_distribution<double>(least, most)(random);
    };
    Discs discs;
    for (int i = 0; i < 24; ++i) {
      const double x = real(-40, 40);
      const double y = real(-40, 40);
      const double vx = real(-3, 3);
      const double vy = real(-3, 3);
      discs.push_back(
          disc({x, y}, {vx, vy}, 6 * std::exp2(real(-12, 0)), seed % 3 == 0 ? real(0, 0.25) : 0));
    }
    Observed run(discs, {}, box, range);
    run.simulation.advance_to(end);
    const auto found = run.encounters.encounters();
    test::expect_equal(found, run.expected());
    if (testing::Test::HasFailure()) return;
    totals.add(found);
  }
  EXPECT_GT(totals.number, 350U);
}

/// A disc turns, jumps, moves to another image of itself, comes or goes, or coincides with an image
/// of another one; or all get other motions.
class Changes {
 public:
  Changes(Observed& run, std::mt19937& random) : run_(run), random_(random) {}

  void change() {
    Simulation& simulation = run_.simulation;
    const auto& triangulation = simulation.triangulation();
    const double now = simulation.current_time().to_double();
    const auto id = integer(triangulation.next_id());
    const unsigned what = integer(7);
    const auto other = integer(triangulation.next_id());
    Disc_motion_2 motion = random_discs(random_, 1, 2, now)[0];
    if (what == 0 && triangulation.next_id() < 8) {
      simulation.insert(motion);
    } else if (!triangulation.contains(id)) {
      return;
    } else if (what == 1 && triangulation.number_of_points() > 1) {
      simulation.erase(id);
    } else if (what == 2) {
      simulation.set_motion(id, motion);
    } else if (what == 3) {
      if (!triangulation.contains(other)) return;
      motion = triangulation.motion(other);
      const Linear_motion_2 there = center(image_of(motion, {}, &run_.box)).motion;
      const Linear_motion_2& a = run_.box.first();
      motion.position = {there.position.x + a.position.x + there.epoch * a.velocity.x,
                         there.position.y + a.position.y + there.epoch * a.velocity.y};
      motion.velocity = {there.velocity.x + a.velocity.x, there.velocity.y + a.velocity.y};
      simulation.set_motion(id, motion);
    } else if (what == 4) {
      std::vector<Point_id> ids;
      for (Point_id each = 0; each < triangulation.next_id(); ++each) {
        if (triangulation.contains(each)) ids.push_back(each);
      }
      simulation.set_motions(ids, random_discs(random_, ids.size(), 2, now));
    } else {
      const Vector_2 velocity = {double(integer(5)) - 2, double(integer(5)) - 2};
      simulation.set_velocities({&id, 1}, {&velocity, 1});
    }
  }
  unsigned integer(unsigned below) { return static_cast<unsigned>(random_() % below); }

 private:
  Observed& run_;
  std::mt19937& random_;
};

TEST(Periodic_encounters_of_discs, that_change_are_those_of_all_pairs_of_images) {
  std::size_t hidden = 0;
  std::size_t coincident = 0;
  Totals totals;
  for (unsigned seed = 0; seed < test::cases(40u); ++seed) {
    std::mt19937 random(seed);
    const unsigned kind = seed % test::periodic_box_kinds;
    const double range = ranges[seed % ranges.size()];
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + test::periodic_box_kind(kind) +
                 ", range " + std::to_string(range));
    const Periodic_box_2 box =
        test::random_periodic_box(random, static_cast<int>(kind), seed % 3 == 0 ? 4 : 6, end);
    Observed run(random_discs(random, 1 + seed / 4 % 5, 1), {}, box, range);
    Changes changes(run, random);
    const auto& triangulation = run.simulation.triangulation();
    while (run.simulation.current_time() < Algebraic_number(end)) {
      const unsigned number = changes.integer(4);
      for (unsigned i = 0; i < number; ++i) changes.change();
      hidden += triangulation.number_of_hidden_points();
      for (Point_id id = 0; id < triangulation.next_id(); ++id) {
        coincident +=
            triangulation.contains(id) && !triangulation.coincident_points(id).empty() ? 1U : 0U;
      }
      run.simulation.advance_to(run.simulation.current_time().to_double() + 0.5);
      if (changes.integer(4) == 0) static_cast<void>(run.encounters.encounters());
    }
    const auto found = run.encounters.encounters();
    test::expect_equal(found, run.expected());
    if (testing::Test::HasFailure()) return;
    totals.add(found);
  }
  EXPECT_GT(hidden, 30U);
  EXPECT_GT(coincident, 15U);
  EXPECT_GT(totals.own, 90U);
}

TEST(Periodic_encounters_of_discs, that_collide_are_those_of_all_pairs_of_images) {
  std::size_t contacts = 0;
  for (const auto response : {collide_elastically, log_contact, erase_both}) {
    for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
      const double range = ranges[seed % ranges.size()];
      SCOPED_TRACE("seed " + std::to_string(seed) + ", range " + std::to_string(range));
      std::mt19937_64 random(seed);
      const Periodic_box_2 box({{12, 0}, {0, 0}, 0}, {{0, 12}, {seed % 2 == 0 ? 0 : 1.0, 0}, 0});
      Discs discs;
      for (const auto& motion : test::random_motions(8, 12, 3, seed)) {
        discs.push_back({motion, std::uniform_real_distribution<double>(0.1, 1.5)(random), 0, 0});
      }
      Observed run(discs, responding(response), box, range);
      run.simulation.advance_to(end);
      test::expect_equal(run.encounters.encounters(), run.expected());
      if (testing::Test::HasFailure()) return;
      const auto& counts = run.simulation.triangulation().counters().events;
      contacts += counts[static_cast<std::size_t>(Event_kind::collision)];
    }
  }
  EXPECT_GT(contacts, 40U);
}

// ---- cost ----

// With the density the same, the certificates for each event or encounter do not become more.
TEST(Periodic_encounters_of_discs, ask_for_few_certificates) {
  std::vector<double> costs;
  for (const std::size_t n : {100U, 400U}) {
    const double side = 10 * std::sqrt(double(n));
    std::mt19937_64 random(1);
    Discs discs;
    for (const auto& motion : test::random_motions(n, side, 5, 1)) {
      discs.push_back({motion, std::uniform_real_distribution<double>(0, 4)(random), 0, 0});
    }
    Simulation simulation(discs, {}, 0, Traits(square(side)));
    Encounters encounters(simulation, 6);
    const std::size_t events = simulation.advance_to(1.0);
    const std::size_t number = encounters.encounters().size();
    EXPECT_GT(number, n);
    costs.push_back(double(encounters.certificate_counters().created) / double(events + number));
  }
  for (const double cost : costs) EXPECT_LT(cost, 4) << "certificates for an event or encounter";
}

}  // namespace
}  // namespace kinetri::periodic_encounters_discs_test
