// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/connected_components.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "observers/random_runs.h"
#include "support/component_oracle.h"
#include "support/disc_runs.h"
#include "support/precondition_error.h"
#include "support/random_walks.h"

namespace kinetri::connected_components_test {
namespace {

using test::Component_oracle;
using test::Partition;
using test::run_of;
using Kind = Component_event_kind;

std::size_t largest(const Partition& partition) {
  const auto sizes = partition.sizes();
  return sizes.empty() ? 0 : sizes.front();
}

bool joins(Kind kind) {
  return kind == Kind::insert || kind == Kind::merge;
}

// The events of one time: as many of each kind as the partitions say, what joins first, each about
// a pair whose link begins or ends, and the numbers at the time and just after it.
void expect_events_at(const Algebraic_number& time, std::span<const Component_event> events,
                      const Component_oracle& oracle, bool is_start) {
  const Partition at = oracle.partition(time, Time_side::at);
  const Partition after = oracle.partition(time, Time_side::after);
  const auto number = [&](Kind kind) {
    return static_cast<std::size_t>(std::ranges::count(events, kind, &Component_event::kind));
  };
  std::size_t components = at.sizes().size();
  std::size_t most = largest(at);
  const std::size_t goings = oracle.number_of_goings(time);
  EXPECT_EQ(number(Kind::erase), goings);
  EXPECT_EQ(number(Kind::split), after.sizes().size() + goings - at.sizes().size());
  if (is_start) {
    ASSERT_FALSE(events.empty());
    ASSERT_EQ(events.front().kind, Kind::start);
    EXPECT_EQ(events.front().components, components);
    EXPECT_EQ(events.front().largest, most);
    events = events.subspan(1);
  } else {
    const Partition before = oracle.partition(time, Time_side::before);
    const std::size_t comings = oracle.number_of_comings(time);
    components = before.sizes().size();
    most = largest(before);
    EXPECT_EQ(number(Kind::insert), comings);
    EXPECT_EQ(number(Kind::merge), before.sizes().size() + comings - at.sizes().size());
  }
  bool has_split = false;
  for (const Component_event& event : events) {
    if (!joins(event.kind) && !has_split) {
      has_split = true;
      EXPECT_EQ(components, at.sizes().size());
      EXPECT_EQ(most, largest(at));
    }
    EXPECT_EQ(joins(event.kind), !has_split) << "what joins comes first";
    if (event.kind == Kind::merge || event.kind == Kind::split) {
      const bool is_known = std::ranges::any_of(oracle.links(), [&](const auto& link) {
        return link.points == event.points &&
               (event.kind == Kind::merge ? link.times.begin : link.times.end) == time;
      });
      EXPECT_TRUE(is_known) << name(event.kind) << " of " << event.points[0] << ", "
                            << event.points[1];
    }
    components = event.components;
    most = event.largest;
  }
  EXPECT_EQ(components, after.sizes().size());
  EXPECT_EQ(most, largest(after));
}

// The sizes that the events tell, from the first one on, make up the numbers that they tell.
void expect_sizes_add_up(const std::vector<Component_event>& events,
                         const std::vector<std::size_t>& at_start) {
  std::multiset<std::size_t> sizes(at_start.begin(), at_start.end());
  for (const Component_event& event : events) {
    const auto [a, b] = event.sizes;
    const auto take = [&](std::size_t size) {
      const auto found = sizes.find(size);
      ASSERT_NE(found, sizes.end()) << name(event.kind) << " of a component of size " << size;
      sizes.erase(found);
    };
    if (event.kind == Kind::merge) {
      take(a);
      take(b);
      sizes.insert(a + b);
    } else if (event.kind == Kind::split) {
      take(a + b);
      sizes.insert({a, b});
    } else if (event.kind == Kind::insert) {
      sizes.insert(1);
    } else if (event.kind == Kind::erase) {
      take(1);
    }
    EXPECT_EQ(event.components, sizes.size());
    EXPECT_EQ(event.largest, sizes.empty() ? 0 : *sizes.rbegin());
  }
}

// All events up to `until`. The oracle knows what is after it.
void expect_events(const std::vector<Component_event>& events, const Component_oracle& oracle,
                   const Algebraic_number& until) {
  auto next = events.begin();
  bool is_start = true;
  for (const Algebraic_number& time : oracle.times()) {
    if (time > until) break;
    const auto first = next;
    while (next != events.end() && next->time == time) ++next;
    SCOPED_TRACE(testing::Message() << "at " << time);
    expect_events_at(time, {first, next}, oracle, is_start);
    if (testing::Test::HasFailure()) return;
    is_start = false;
  }
  ASSERT_EQ(next, events.end()) << "an event too many at " << next->time;
  expect_sizes_add_up(events, oracle.partition(events.front().time, Time_side::at).sizes());
}

// Runs to `until`, and compares with the oracle; a second run, which is asked at each instant, has
// the same components as a static partition.
template <class Traits, class Make>
void expect_right(const Make& make_simulation, double range, double until) {
  SCOPED_TRACE("range " + std::to_string(range));
  const auto simulation = make_simulation();
  test::Motion_recorder<Traits> motions(*simulation);
  Connected_components<Traits> components(*simulation, range);
  const std::vector<Edge_ids> pairs = {{0, 1}, {3, 2}, {1, 6}, {2, 7}};
  for (const Edge_ids& pair : pairs) components.watch(pair);
  const Algebraic_number start = simulation->current_time();
  simulation->advance_to(until);
  const std::vector<Component_event> events = components.events();
  std::vector<std::vector<Time_interval>> intervals;
  for (const Edge_ids& pair : pairs) intervals.push_back(components.connected_intervals(pair));
  simulation->advance_to(until + 1);
  const Component_oracle oracle(motions.pieces(), start, range);
  expect_events(events, oracle, until);
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
    const auto [a, b] = pairs[pair];
    const auto& found = intervals[pair];
    const auto expected = oracle.connected(a, b, until);
    ASSERT_EQ(found.size(), expected.size()) << a << " and " << b;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].begin, expected[i].begin);
      EXPECT_EQ(found[i].end, expected[i].end);
    }
  }
  if (testing::Test::HasFailure()) return;

  const auto again = make_simulation();
  Connected_components<Traits> asked(*again, range);
  const auto look = [&] {
    const Algebraic_number& now = again->current_time();
    const Partition expected = oracle.partition(now, Time_side::after);
    for (Point_id a = 0; a < again->triangulation().next_id(); ++a) {
      EXPECT_EQ(asked.contains(a), again->triangulation().contains(a));
      for (Point_id b = 0; b < a; ++b) {
        EXPECT_EQ(asked.are_connected(a, b), expected.are_joined(a, b)) << a << ", " << b;
      }
    }
    EXPECT_EQ(asked.number_of_components(), expected.sizes().size());
  };
  look();
  for (int k = 1; Algebraic_number(Rational(k, 7)) < Algebraic_number(until); ++k) {
    while (again->step(Rational(k, 7)) > 0) asked.largest();
    again->advance_to(Rational(k, 7));
    look();
  }
  again->advance_to(until);
  look();
  ASSERT_EQ(asked.events().size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Component_event& a = asked.events()[i];
    const Component_event& b = events[i];
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.components, b.components);
  }
}

// ---- known by construction ----

TEST(Connected_components, of_two_points_that_pass_begin_and_end_at_the_range) {
  Simulation_2<> simulation({{{0, 0}, {0, 0}, 0}, {{-5, 3}, {1, 0}, 0}}, {});
  Connected_components components(simulation, 5);
  components.watch({1, 0});
  simulation.advance_to(20.0);
  const auto& events = components.events();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].kind, Kind::start);
  EXPECT_EQ(events[0].time, Algebraic_number());
  EXPECT_EQ(events[0].components, 2u);
  EXPECT_EQ(events[0].largest, 1u);
  EXPECT_EQ(events[1].kind, Kind::merge);
  EXPECT_EQ(events[1].time, Algebraic_number(1.0));
  EXPECT_EQ(events[1].points, (Edge_ids{0, 1}));
  EXPECT_EQ(events[1].components, 1u);
  EXPECT_EQ(events[1].largest, 2u);
  EXPECT_EQ(events[2].kind, Kind::split);
  EXPECT_EQ(events[2].time, Algebraic_number(9.0));
  const auto connected = components.connected_intervals({0, 1});
  ASSERT_EQ(connected.size(), 1u);
  EXPECT_EQ(connected[0].begin, events[1].time);
  EXPECT_EQ(connected[0].end, events[2].time);
}

TEST(Connected_components, of_two_points_that_touch_the_range_join_for_a_moment) {
  Simulation_2<> simulation({{{0, 0}, {0, 0}, 0}, {{-5, 3}, {1, 0}, 0}}, {});
  Connected_components components(simulation, 3);
  simulation.advance_to(5.0);
  EXPECT_EQ(components.number_of_components(), 2u);
  const auto& events = components.events();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[1].kind, Kind::merge);
  EXPECT_EQ(events[2].kind, Kind::split);
  EXPECT_EQ(events[1].time, Algebraic_number(5.0));
  EXPECT_EQ(events[2].time, Algebraic_number(5.0));
}

// The point that connects two others goes, and one comes that does so elsewhere.
TEST(Connected_components, of_points_that_come_and_go_change_their_number_by_one_a_row) {
  Simulation_2<> simulation({{{0, 0}, {}, 0}, {{2, 0}, {}, 0}, {{1, 0}, {}, 0}}, {});
  Connected_components components(simulation, 1);
  simulation.advance_to(1.0);
  simulation.erase(2);
  simulation.advance_to(2.0);
  simulation.insert({{100, 0}, {}, 0});
  simulation.insert({{1, 0.1}, {}, 0});
  simulation.set_motion(0, {{1, 0.5}, {}, 0});
  using Row = std::tuple<double, Kind, Point_id, Point_id, std::size_t, std::size_t>;
  std::vector<Row> rows;
  for (const Component_event& event : components.events()) {
    rows.emplace_back(event.time.to_double(), event.kind, event.points[0], event.points[1],
                      event.components, event.largest);
  }
  EXPECT_EQ(rows, (std::vector<Row>{{0, Kind::start, no_point, no_point, 1, 3},
                                    {1, Kind::split, 0, 2, 2, 2},
                                    {1, Kind::split, 1, 2, 3, 1},
                                    {1, Kind::erase, 2, no_point, 2, 1},
                                    {2, Kind::insert, 3, no_point, 3, 1},
                                    {2, Kind::insert, 4, no_point, 4, 1},
                                    {2, Kind::merge, 0, 4, 3, 2}}));
}

TEST(Connected_components, refuses_a_range_that_is_none) {
  Simulation_2<> simulation({{{0, 0}, {}, 0}}, {});
  const auto message = "a range is at least 0 and finite";
  EXPECT_PRECONDITION_ERROR(Connected_components(simulation, -1), message);
  EXPECT_PRECONDITION_ERROR(
      Connected_components(simulation, std::numeric_limits<double>::infinity()), message);
  EXPECT_PRECONDITION_ERROR(
      Connected_components(simulation, std::numeric_limits<double>::quiet_NaN()), message);
  Connected_components components(simulation, 0);
  EXPECT_EQ(components.largest(), 1u);
  EXPECT_PRECONDITION_ERROR(components.watch({0, 0}), "a point is always connected with itself");
  EXPECT_PRECONDITION_ERROR(components.connected_intervals({0, 1}), "the pair is not watched");
}

TEST(Connected_components, of_no_points_are_none) {
  Simulation_2<> simulation(std::vector<Linear_motion_2>(), {});
  Connected_components components(simulation, 1);
  EXPECT_EQ(components.number_of_components(), 0u);
  simulation.advance_to(1.0);
  simulation.insert({{0, 0}, {}, 0});
  EXPECT_EQ(components.number_of_components(), 1u);
  simulation.advance_to(2.0);
  simulation.erase(0);
  EXPECT_EQ(components.largest(), 0u);
}

// The observation starts before there is a point.
TEST(Connected_components, of_points_that_come_later_start_with_none) {
  Simulation_2<> simulation(std::vector<Linear_motion_2>(), {});
  simulation.schedule_insert(1, {{0, 0}, {}, 1});
  simulation.schedule_insert(1, {{2, 0}, {}, 1});
  Connected_components components(simulation, 2);
  simulation.advance_to(1.0);
  using Row = std::tuple<double, Kind, std::size_t, std::size_t>;
  std::vector<Row> rows;
  for (const Component_event& event : components.events()) {
    rows.emplace_back(event.time.to_double(), event.kind, event.components, event.largest);
  }
  EXPECT_EQ(rows, (std::vector<Row>{{0, Kind::start, 0, 0},
                                    {1, Kind::insert, 1, 1},
                                    {1, Kind::insert, 2, 1},
                                    {1, Kind::merge, 1, 2}}));
}

// ---- compared with all pairs ----

TEST(Connected_components, are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto motions = test::random_motions(24, 10, 2, seed);
    for (const double range : {0.3, 1.5, 2.5}) {
      expect_right<Linear_kinetic_traits_2>(run_of(motions), range, 5);
    }
  }
}

// Places and velocities are small integers: exact touches of the range, many at one time, meetings.
TEST(Connected_components, are_those_of_all_pairs_where_much_happens_at_once) {
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto motions = test::grid_motions(14, 6, 1 + static_cast<int>(seed) % 2, seed);
    for (const double range : {0.0, 1.0, 2.0}) {
      expect_right<Linear_kinetic_traits_2>(run_of(motions), range, 6);
    }
  }
}

TEST(Connected_components, are_those_of_all_pairs_on_a_line) {
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto motions = test::grid_motions(40, 12, 2, seed);
    std::set<std::pair<double, double>> chosen;
    std::erase_if(motions, [&](Linear_motion_2& m) {
      m.position.y = m.velocity.y = 0;
      return !chosen.emplace(m.position.x, m.velocity.x).second || chosen.size() > 12;
    });
    for (const double range : {0.0, 1.0, 1.5}) {
      expect_right<Linear_kinetic_traits_2>(run_of(motions), range, 5);
    }
  }
}

TEST(Connected_components, are_those_of_all_pairs_on_accelerated_motions) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto grid = test::polynomial_grid_motions(9, 5, 2, 3, seed);
    const auto random = test::random_polynomial_motions(9, 6, 2, seed);
    expect_right<Polynomial_kinetic_traits_2>(run_of(grid), 2, 3);
    expect_right<Polynomial_kinetic_traits_2>(run_of(random), 1.5, 3);
  }
}

// With s = t - 1 the place is s^3 - 3 s + 4, which rises through 2 at s = -2 and touches it from
// above at s = 1.
TEST(Connected_components, of_accelerated_points_touch_the_range_after_they_have_parted) {
  const std::vector<Polynomial_motion_2> motions = {{{0, 0}, {0, 0}, {0, 0}, {0, 0}, 0},
                                                    {{4, 0}, {-3, 0}, {0, 0}, {6, 0}, 1}};
  Simulation_2<Polynomial_kinetic_traits_2> simulation(motions, {}, Algebraic_number(-1.125));
  Connected_components components(simulation, 2);
  simulation.advance_to(3.0);
  std::vector<std::pair<Kind, double>> found;
  for (const Component_event& event : components.events()) {
    found.emplace_back(event.kind, event.time.to_double());
  }
  EXPECT_EQ(found,
            (std::vector<std::pair<Kind, double>>{
                {Kind::start, -1.125}, {Kind::split, -1}, {Kind::merge, 2}, {Kind::split, 2}}));
}

TEST(Connected_components, are_those_of_all_pairs_through_walls_and_collisions) {
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto motions = test::discs_in_a_box(16, 2, seed);
    for (const Collision_response& response :
         {Collision_response(collide_elastically), Collision_response(erase_both)}) {
      const auto options = test::discs(test::box_of(16), 1, response);
      expect_right<Linear_kinetic_traits_2>(run_of(motions, options), 7, 4);
    }
  }
}

TEST(Connected_components, are_those_of_all_pairs_on_tracks_with_gaps) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double fraction = seed % 2 == 0 ? 0 : 0x1p-10;
    const test::Tracks tracks = test::random_walks(14, seed, 0, fraction);
    const auto stays = stays_of(tracks, {.from = 0, .longest_gap = 2.5});
    const auto make = [&] { return simulate_tracks(tracks, stays, 0); };
    for (const double range : {1.0, 3.0}) expect_right<Linear_kinetic_traits_2>(make, range, 20);
  }
}

// Points that come, go, turn and jump, several at one time.
TEST(Connected_components, are_those_of_all_pairs_through_scheduled_changes) {
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto make = test::scheduled_changes(12, 9, seed);
    for (const double range : {0.0, 1.0, 2.0}) {
      expect_right<Linear_kinetic_traits_2>(make, range, 6);
    }
  }
}

// They are in no triangulation together.
TEST(Connected_components, link_who_goes_with_who_comes_at_that_time) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {0, 0}, 0}, {{50, 0}, {0, 0}, 0}, {{0, 50}, {0, 0}, 0}};
  Simulation_2<> simulation(motions, {});
  Linear_motion_2 next_to_it;
  next_to_it.position = {2, 0};
  next_to_it.epoch = 4;
  simulation.schedule_insert(4, next_to_it);
  simulation.schedule_erase(4, 0);
  Connected_components components(simulation, 2);
  components.watch({0, 3});
  simulation.advance_to(8);
  std::vector<std::pair<Kind, Edge_ids>> found;
  for (const Component_event& event : components.events()) {
    EXPECT_EQ(event.time, Algebraic_number(event.kind == Kind::start ? 0.0 : 4.0));
    found.emplace_back(event.kind, event.points);
  }
  const std::vector<std::pair<Kind, Edge_ids>> expected = {{Kind::start, {no_point, no_point}},
                                                           {Kind::insert, {3, no_point}},
                                                           {Kind::merge, {0, 3}},
                                                           {Kind::split, {0, 3}},
                                                           {Kind::erase, {0, no_point}}};
  EXPECT_EQ(found, expected);
  const auto intervals = components.connected_intervals({0, 3});
  ASSERT_EQ(intervals.size(), 1U);
  EXPECT_EQ(intervals[0].begin, Algebraic_number(4.0));
  EXPECT_EQ(intervals[0].end, Algebraic_number(4.0));
}

// ---- recorded pedestrians ----

class Connected_crowd : public testing::TestWithParam<const char*> {};

TEST_P(Connected_crowd, has_the_components_of_all_pairs_between_frames) {
  const std::filesystem::path path =
      std::filesystem::path(KINETRI_SHARED_DATA) / "crowd" / GetParam();
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "no recorded tracks: " << path << " does not exist";
  }
  const Tracks_file file = read_tracks_file(path, Tracks_format::frames, 25);
  std::vector<std::vector<Observation_2>> tracks;
  for (const Track& track : file.tracks) {
    for (tracks.emplace_back(); const auto& [time, place, line] : track.observations) {
      tracks.back().push_back({time, place});
    }
  }
  const double from = tracks.front().front().time;
  const auto stays = stays_of(tracks, {.from = from, .until = from + 60, .longest_gap = 5});
  const auto simulation = simulate_tracks(tracks, stays, from);
  Connected_components components(*simulation, 2);
  for (int k = 1; k <= 120; ++k) {
    const Rational time = to_rational(from) + Rational(k, 2) - Rational(1, 7);
    simulation->advance_to(time);
    Partition expected;
    std::vector<std::pair<Point_id, test::Static_point>> places;
    for (Point_id id = 0; id < simulation->triangulation().next_id(); ++id) {
      if (!simulation->triangulation().contains(id)) continue;
      places.emplace_back(id, test::place_at(simulation->triangulation().motion(id), time));
      expected.add(id);
    }
    for (const auto& [a, p] : places) {
      for (const auto& [b, q] : places) {
        if (a < b && CGAL::squared_distance(p, q) <= 4) expected.join(a, b);
      }
    }
    EXPECT_EQ(components.number_of_components(), expected.sizes().size());
    EXPECT_EQ(components.largest(), largest(expected));
    for (const auto& [a, p] : places) {
      for (const auto& [b, q] : places) {
        EXPECT_EQ(components.are_connected(a, b), expected.are_joined(a, b)) << a << ", " << b;
      }
    }
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Recorded, Connected_crowd,
                         testing::Values("students003.txt", "biwi_eth.txt"), [](const auto& test) {
                           const std::string file = test.param;
                           return file.substr(0, file.find_first_of("_0."));
                         });

}  // namespace
}  // namespace kinetri::connected_components_test
