// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts that coincide, against an oracle that looks at all pairs: points among discs, discs that
// touch others from within, and radii that grow from 0, on a grid, where several discs meet in one
// place at one time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/all_pairs_comparison.h"
#include "support/multiplier.h"

namespace kinetri::touching_discs_test {
namespace {

using Discs = std::vector<Disc_motion_2>;

Collision_response response_of(const std::string& name) {
  const auto named = std::ranges::find(named_responses, name, &Named_response::name);
  return named->response;
}

/// Discs of the radii 0 to 3 on a grid, with whole velocities. More than half of them are placed
/// where the rim of one before them is at the time 2.
class Grid_source {
 public:
  explicit Grid_source(unsigned seed) : random_(seed) {}

  Discs discs(std::size_t number, bool grow) {
    Discs result;
    while (result.size() < number) {
      const Disc_motion_2 disc = next(result, grow);
      if (std::ranges::none_of(result,
                               [&](const auto& other) { return same_trajectory(other, disc); })) {
        result.push_back(disc);
      }
    }
    return result;
  }

  /// At a whole time a point comes, turns or goes.
  test::All_pairs_change<Disc_motion_2> change(double time, std::size_t points, std::size_t number,
                                               const Discs& discs, bool grow) {
    Disc_motion_2 motion = next(discs, grow);
    motion.position.x += motion.velocity.x * time;
    motion.position.y += motion.velocity.y * time;
    motion.epoch = time;
    const auto inserted = static_cast<Point_id>(points + number / 3);
    if (number % 3 == 0) return {time, inserted, motion};
    const auto id = static_cast<Point_id>(one_of(0, static_cast<int>(points) - 1));
    if (number % 3 == 1) return {time, id, motion};
    return {time, id, std::nullopt};
  }

 private:
  int one_of(int least, int greatest) {
    return std::uniform_int_distribution<int>(least, greatest)(random_);
  }

  Disc_motion_2 next(const Discs& before, bool grow) {
    static constexpr std::array<double, 8> radii = {0, 0, 0, 1, 1, 2, 2, 3};
    static constexpr std::array<double, 6> growths = {0, 0, 0.5, 0.25, 1, -0.25};
    Disc_motion_2 disc;
    disc.position = {static_cast<double>(one_of(-6, 6)), static_cast<double>(one_of(-6, 6))};
    disc.velocity = {static_cast<double>(one_of(-2, 2)), static_cast<double>(one_of(-2, 2))};
    disc.radius = radii[static_cast<std::size_t>(one_of(0, 7))];
    if (one_of(0, 2) == 0) disc.velocity = {0, 0};
    if (grow) disc.growth = growths[static_cast<std::size_t>(one_of(0, 5))];
    if (disc.growth < 0 && disc.radius < 2) disc.growth = 0;
    if (!before.empty() && one_of(0, 2) > 0) {
      // On the rim of another at the time 2, or touching it from outside or inside.
      const auto& other =
          before[static_cast<std::size_t>(one_of(0, static_cast<int>(before.size()) - 1))];
      constexpr double time = 2;
      const double rim = other.radius + other.growth * time;
      const double own = disc.radius + disc.growth * time;
      const std::array<double, 3> distances = {rim, rim + own, std::abs(rim - own)};
      const double distance = distances[static_cast<std::size_t>(one_of(0, 2))];
      static constexpr std::array<Vector_2, 6> directions = {
          {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {0.6, 0.8}, {-0.8, 0.6}}};
      const Vector_2 direction = directions[static_cast<std::size_t>(one_of(0, 5))];
      const auto place = [&](double at, double v, double towards, double own_v) {
        return at + v * time + towards * distance - own_v * time;
      };
      disc.position = {place(other.position.x, other.velocity.x, direction.x, disc.velocity.x),
                       place(other.position.y, other.velocity.y, direction.y, disc.velocity.y)};
    }
    return disc;
  }

  std::mt19937_64 random_;
};

/// The name of the response; whether there is a box, radii grow, and points come, turn and go.
using Case = std::tuple<std::string, bool, bool, bool>;

class Touching : public testing::TestWithParam<Case> {};

TEST_P(Touching, discs_have_the_contacts_of_all_pairs) {
  const auto& [response, has_box, grow, change] = GetParam();
  test::All_pairs_totals totals;
  constexpr int seeds = 4;
  for (int seed = 1; seed <= test::cases(seeds); ++seed) {
    Grid_source source(static_cast<unsigned>(seed));
    Simulation_options options;
    options.response = response_of(response);
    if (has_box) {
      options.box = Box_2{-40, -40, 40, 40};
      options.rim_touches = seed % 2 == 0;
    }
    const Discs discs = source.discs(static_cast<std::size_t>(5 + seed % 8), grow);
    std::vector<test::All_pairs_change<Disc_motion_2>> changes;
    for (double time = 1; change && time < 6; ++time) {
      changes.push_back(source.change(time, discs.size(), changes.size(), discs, grow));
    }
    const std::string problem =
        test::difference_from_all_pairs<Disc_kinetic_traits_2>(discs, options, changes, 6, totals);
    ASSERT_EQ(problem, "") << "seed " << seed;
  }
  std::printf("%zu runs, %zu contacts, %zu ended pressed\n", totals.runs, totals.contacts,
              totals.pressed);
  EXPECT_GT(totals.contacts, totals.runs);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  const auto& [response, has_box, grow, change] = info.param;
  return response + (has_box ? "_in_a_box" : "_in_the_plane") + (grow ? "_growing" : "_constant") +
         (change ? "_with_changes" : "");
}

INSTANTIATE_TEST_SUITE_P(, Touching,
                         testing::Combine(testing::Values("log", "swap", "elastic", "stop",
                                                          "remove"),
                                          testing::Bool(), testing::Bool(), testing::Bool()),
                         case_name);

// A point enters a disc where another point stays on the rim: the two coincide at that time, and it
// is hidden from then on. (x, y, vx, vy, radius.)
TEST(Touching_point, enters_a_disc_where_another_point_is_on_the_rim) {
  const Discs discs = {{{{0, 0}, {0, 0}, 0}, 2, 0, 0},
                       {{{-2, 0}, {0, 0}, 0}, 0, 0, 0},
                       {{{-4, 0}, {1, 0}, 0}, 0, 0, 0},
                       {{{0, 9}, {0, 0}, 0}, 0.5, 0, 0}};
  Simulation_options options;
  options.response = log_contact;
  Simulation_2<Disc_kinetic_traits_2> simulation(discs, options);
  test::detail::Contact_recorder contacts;
  simulation.add_observer(contacts);
  while (simulation.step(Algebraic_number(7)) > 0) {
    EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  }
  ASSERT_EQ(contacts.events.size(), 1u);
  EXPECT_EQ(contacts.events[0].time, Algebraic_number(2));
  EXPECT_EQ(contacts.events[0].point_a, Point_id{0});
  EXPECT_EQ(contacts.events[0].point_b, Point_id{2});
  // If the point stops, it coincides with point 1 from then on.
  for (const Named_response& named : named_responses) {
    if (named.response == nullptr) continue;
    options.response = named.response;
    test::All_pairs_totals totals;
    EXPECT_EQ(test::difference_from_all_pairs<Disc_kinetic_traits_2>(discs, options, {}, 7, totals),
              "")
        << named.name;
    EXPECT_EQ(totals.contacts, 1u) << named.name;
  }
}

// Disc 0 is inside of disc 2 and touches it where disc 1 touches both. Discs 0 and 1 have no edge
// from then on: that they touch follows from the contact of 1 and 2 alone, which comes after
// theirs.
TEST(Touching_discs, come_in_the_order_of_their_ids) {
  const Discs discs = {{{{-1, 0}, {0, 0}, 0}, 1, 0, 0},    {{{6, 0}, {-1, 0}, 0}, 2, 0, 0},
                       {{{-3, 0}, {0, 0}, 0}, 3, 0, 0},    {{{1, 30}, {0, 0}, 0}, 1, 0, 0},
                       {{{-30, -31}, {0, 0}, 0}, 1, 0, 0}, {{{30, -29}, {0, 0}, 0}, 1, 0, 0}};
  Simulation_options options;
  options.response = log_contact;
  Simulation_2<Disc_kinetic_traits_2> simulation(discs, options);
  test::detail::Contact_recorder contacts;
  simulation.add_observer(contacts);
  simulation.advance_to(5);
  ASSERT_EQ(contacts.events.size(), 2u);
  EXPECT_EQ(contacts.events[0].time, Algebraic_number(4));
  EXPECT_EQ(contacts.events[0].point_a, Point_id{0});
  EXPECT_EQ(contacts.events[0].point_b, Point_id{1});
  EXPECT_EQ(contacts.events[1].time, Algebraic_number(4));
  EXPECT_EQ(contacts.events[1].point_a, Point_id{1});
  EXPECT_EQ(contacts.events[1].point_b, Point_id{2});
}

}  // namespace
}  // namespace kinetri::touching_discs_test
