// SPDX-License-Identifier: GPL-3.0-or-later
//
// Observers of a simulation in a periodic box tell what observers of a triangulation tell whose
// points get the same motions at the same times. Those of triangulations have oracles of their own.
#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "kinetri/observers/connected_components.h"
#include "kinetri/observers/encounters.h"
#include "kinetri/observers/nearest_neighbors.h"
#include "support/multiplier.h"

namespace kinetri::periodic_simulation_observers_test {
namespace {

using Traits = Periodic_kinetic_traits_2;
using Simulation = Simulation_2<Traits>;
using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;

/// The points that have collided since `ids` was cleared.
struct Changed_points : Event_observer {
  void after_event(const Event& event) override {
    if (event.kind != Event_kind::collision) return;
    for (const auto& id : {event.point_a, event.point_b}) ids.insert(*id);
  }
  std::set<Point_id> ids;
};

std::vector<Linear_motion_2> motions_on_grid(std::mt19937& random, int columns, double spacing) {
  std::vector<Linear_motion_2> result;
  const auto rate = [&] { return static_cast<double>(static_cast<int>(random() % 7) - 3); };
  for (int i = 0; i < columns * columns; ++i) {
    const double vx = rate();
    result.push_back({{spacing * (i % columns), spacing * (i / columns)}, {vx, rate()}, 0});
  }
  return result;
}

TEST(Observers_of_a_periodic_simulation, tell_what_those_of_a_triangulation_tell) {
  constexpr double radius = 0.75;
  constexpr double range = 2;  // of centers
  std::size_t contacts = 0;
  std::size_t across = 0;
  std::size_t changes = 0;
  std::size_t merges = 0;
  std::size_t meetings = 0;
  for (unsigned seed = 1; seed <= test::cases(6u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const int columns = 2 + static_cast<int>(seed % 3);
    const double side = 4.0 * columns;
    const double shear = seed % 2 == 0 ? 0 : 0.5;
    const Traits traits({{{side, 0}, {0, 0}, 0}, {{0, side}, {shear, 0}, 0}});
    const auto motions = motions_on_grid(random, columns, 4);
    Simulation_options options;
    options.radius = radius;
    options.response = collide_elastically;
    Simulation simulation(motions, options, 0, traits);
    Kinetic kinetic(motions, Algebraic_number(), traits);

    Changed_points changed;
    simulation.add_observer(changed);
    Connected_components components(simulation, range);
    Connected_components same_components(kinetic, range);
    Nearest_neighbors nearest(simulation);
    Nearest_neighbors same_nearest(kinetic);
    Encounters encounters(simulation, range - 2 * radius);
    Encounters same_encounters(kinetic, range);

    while (simulation.step(3) > 0) {
      kinetic.advance_to(simulation.current_time());
      if (changed.ids.empty()) continue;
      std::vector<Point_id> ids(changed.ids.begin(), changed.ids.end());
      std::vector<Linear_motion_2> after;
      for (const Point_id id : ids) after.push_back(simulation.triangulation().motion(id));
      contacts += ids.size() / 2;
      kinetic.set_motions(ids, after);
      changed.ids.clear();
    }
    simulation.advance_to(3);
    kinetic.advance_to(3);

    const auto& events = components.events();
    const auto& same_events = same_components.events();
    ASSERT_EQ(events.size(), same_events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_EQ(events[i].time, same_events[i].time);
      EXPECT_EQ(events[i].kind, same_events[i].kind);
      EXPECT_EQ(events[i].points, same_events[i].points);
      EXPECT_EQ(events[i].offset, same_events[i].offset);
      across += events[i].offset != Lattice_offset_2{};
      merges += events[i].kind == Component_event_kind::merge;
    }

    const auto& moves = nearest.changes();
    const auto& same_moves = same_nearest.changes();
    ASSERT_EQ(moves.size(), same_moves.size());
    for (std::size_t i = 0; i < moves.size(); ++i) {
      EXPECT_EQ(moves[i].time, same_moves[i].time);
      EXPECT_EQ(moves[i].id, same_moves[i].id);
      EXPECT_EQ(moves[i].after, same_moves[i].after);
      EXPECT_EQ(moves[i].after_offset, same_moves[i].after_offset);
    }
    changes += moves.size();

    const auto met = encounters.encounters();
    const auto same_met = same_encounters.encounters();
    ASSERT_EQ(met.size(), same_met.size());
    for (std::size_t i = 0; i < met.size(); ++i) {
      EXPECT_EQ(met[i].begin, same_met[i].begin);
      EXPECT_EQ(met[i].end, same_met[i].end);
      EXPECT_EQ(met[i].closest, same_met[i].closest);
      EXPECT_EQ(met[i].points, same_met[i].points);
      EXPECT_EQ(met[i].offset, same_met[i].offset);
      EXPECT_EQ(met[i].distance, same_met[i].distance);
      EXPECT_NEAR(met[i].gap, met[i].distance - 2 * radius, 1e-15);
    }
    meetings += met.size();
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(contacts, 50U);
  EXPECT_GT(across, 10U);
  EXPECT_GT(changes, 200U);
  EXPECT_GT(merges, 20U);
  EXPECT_GT(meetings, 50U);
}

}  // namespace
}  // namespace kinetri::periodic_simulation_observers_test
