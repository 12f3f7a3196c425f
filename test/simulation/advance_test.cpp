// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simulations that advance to a time, beside the same ones that go there step by step: the same
// events, with the same numbers and exact times, and the same state.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "kinetri/simulation/tracks.h"
#include "support/disc_runs.h"
#include "support/message_of.h"
#include "support/precondition_error.h"
#include "support/random_walks.h"

namespace kinetri::advance_test {
namespace {

using test::count;
using test::in_box;
using test::Simulation;

// All events.
class Log : public Event_observer {
 public:
  explicit Log(bool looks) : looks_(looks) {}
  bool looks_at_triangulation() const override { return looks_; }
  void before_event(const Event& event) override { befores.push_back(event.number); }
  void after_event(const Event& event) override { events.push_back(event); }

  std::vector<std::uint64_t> befores;
  std::vector<Event> events;

 private:
  bool looks_;
};

bool are_same(const Event& a, const Event& b) {
  return a.number == b.number && a.kind == b.kind && a.time == b.time && a.removed == b.removed &&
         a.added == b.added && a.point_a == b.point_a && a.point_b == b.point_b;
}

std::string difference(const Log& one, const Log& other) {
  if (one.befores != other.befores) return "events before they happen";
  if (one.events.size() != other.events.size()) return "numbers of events";
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    if (!are_same(one.events[i], other.events[i])) return "event " + std::to_string(i);
  }
  return {};
}

// What differs, but counts of how the triangulation was found, and the counters of contacts.
template <class Traits>
std::string difference_of_states(const Simulation_2<Traits>& one,
                                 const Simulation_2<Traits>& other) {
  const auto a = one.snapshot();
  const auto b = other.snapshot();
  if (a.triangulation.time != b.triangulation.time) return "times";
  if (a.triangulation.motions != b.triangulation.motions) return "motions";
  if (one.triangulation().finite_edge_ids() != other.triangulation().finite_edge_ids()) {
    return "edges";
  }
  Triangulation_counters counts = a.triangulation.counters;
  counts.rechecks = b.triangulation.counters.rechecks;  // these tell how it was found
  counts.discarded = b.triangulation.counters.discarded;
  if (counts != b.triangulation.counters) return "counters";
  if (a.in_contact != b.in_contact) return "pairs in contact";
  if (a.scheduled.size() != b.scheduled.size()) return "numbers of scheduled changes";
  for (std::size_t i = 0; i < a.scheduled.size(); ++i) {
    if (a.scheduled[i].time != b.scheduled[i].time || a.scheduled[i].kind != b.scheduled[i].kind ||
        a.scheduled[i].point != b.scheduled[i].point ||
        a.scheduled[i].motion != b.scheduled[i].motion) {
      return "scheduled changes";
    }
  }
  if (a.certificates != b.certificates) return "certificates of contacts";
  const Contact_counters& c = one.contact_counters();
  const Contact_counters& d = other.contact_counters();
  if (c.instants != d.instants) return "instants with contacts alone";
  if (c.most_at_one_time != d.most_at_one_time) return "most contacts at one time";
  if (c.discarded_walls != d.discarded_walls) return "discarded walls";
  if (c.discarded_collisions != d.discarded_collisions) return "discarded collisions";
  if (c.queue.pushed != d.queue.pushed || c.queue.peak != d.queue.peak) return "the queue";
  return one.queue_size() == other.queue_size() ? "" : "sizes of queues";
}

// Goes to `time` step by step: what advance_to is to do. Each step goes to the time that is said to
// be that of the next event.
template <class Traits>
std::size_t step_to(Simulation_2<Traits>& simulation, const Algebraic_number& time) {
  std::size_t events = 0;
  for (;;) {
    const std::optional<Algebraic_number> next = simulation.next_event_time();
    const std::size_t more = simulation.step(time);
    if (more == 0) {
      EXPECT_FALSE(next && *next <= time);
      break;
    }
    // With weights it may be a time at which another triangle hides a point, which is no event.
    if constexpr (HasWeight<typename Traits::Motion>) {
      EXPECT_GE(simulation.current_time(), next);
    } else {
      EXPECT_EQ(simulation.current_time(), next);
    }
    events += more;
  }
  simulation.advance_to(time);
  return events;
}

// What differs where simulations, which `make` makes, go to times in turn: step by step; watched by
// one who looks, by one who does not, and by nobody.
template <class Make>
std::string difference_from_steps(const Make& make, const std::vector<Algebraic_number>& times) {
  const auto stepped = make();
  const auto looked_at = make();
  const auto listened_to = make();
  const auto alone = make();
  Log expected(true);
  Log looking(true);
  Log listening(false);
  stepped->add_observer(expected);
  looked_at->add_observer(looking);
  listened_to->add_observer(listening);
  for (const Algebraic_number& time : times) {
    const std::size_t events = step_to(*stepped, time);
    for (const auto* simulation : {&looked_at, &listened_to, &alone}) {
      const std::string who = simulation == &looked_at     ? " where somebody looks"
                              : simulation == &listened_to ? " where somebody listens"
                                                           : " where nobody does";
      if ((*simulation)->advance_to(time) != events) return "counts of events" + who;
      const std::string found = difference_of_states(*stepped, **simulation);
      if (!found.empty()) return found + who;
    }
    for (const Log* log : {&looking, &listening}) {
      const std::string found = difference(expected, *log);
      if (!found.empty()) return found + (log == &looking ? " looking" : " listening");
    }
  }
  return {};
}

const std::vector<Algebraic_number> some_times = {0.5, Rational(4, 3), 3.0, 3.0, 5.0};

TEST(Advance, past_walls_is_as_step_by_step) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const std::size_t n = 5 + 7 * seed;
    const auto motions = test::random_motions(n, 40, 5, seed);
    const auto make = [&] {
      return std::make_unique<Simulation>(motions, in_box({-1, -1, 41, 41}));
    };
    ASSERT_EQ(difference_from_steps(make, some_times), "") << "seed " << seed;
    const auto simulation = make();
    simulation->advance_to(5.0);
    EXPECT_GT(count(*simulation, Event_kind::wall), n / 4);
    EXPECT_GT(simulation->contact_counters().instants, n / 4);
  }
}

// Walls are reached, and points cocircular, at the same rational times.
TEST(Advance, past_walls_on_a_grid_is_as_step_by_step) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto motions = test::grid_motions(4 + seed % 20, 5 + static_cast<int>(seed % 9), 3, seed);
    const auto make = [&] {
      return std::make_unique<Simulation>(motions, in_box({-1, -1, 14, 14}));
    };
    ASSERT_EQ(difference_from_steps(make, some_times), "") << "seed " << seed;
  }
}

// Of points on a grid, at times at which there are events of the triangulation too.
void schedule_changes(Simulation& simulation, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto number = [&](int least, int greatest) {
    return least + static_cast<int>(random() % static_cast<std::uint64_t>(greatest - least + 1));
  };
  for (int i = 0; i < 30; ++i) {
    const double when = number(0, 20) / 4.0;
    const double x = number(0, 12) + i / 64.0;  // no two alike
    const double y = number(0, 12);
    const double vx = number(-2, 2);
    const Linear_motion_2 motion = {{x, y}, {vx, double(number(-2, 2))}, when};
    const auto id = static_cast<Point_id>(number(0, 7));
    switch (number(0, 3)) {
      case 0:
        simulation.schedule_insert(when, motion);
        break;
      case 1:
        simulation.schedule_erase(when, id);
        break;
      default:
        simulation.schedule_motion(when, id, motion);
    }
  }
}

TEST(Advance, past_scheduled_changes_is_as_step_by_step) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto motions = test::grid_motions(8 + seed % 9, 13, 2, seed);
    const auto make = [&] {
      auto simulation = std::make_unique<Simulation>(
          motions, seed % 3 == 0 ? in_box({-30, -30, 40, 40}) : Simulation_options());
      schedule_changes(*simulation, seed);
      return simulation;
    };
    ASSERT_EQ(difference_from_steps(make, some_times), "") << "seed " << seed;
  }
}

TEST(Advance, along_tracks_is_as_step_by_step) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const test::Tracks tracks = test::random_walks(20, seed);
    const auto make = [&] { return simulate_tracks(tracks, stays_of(tracks, {.from = 0}), 0); };
    ASSERT_EQ(difference_from_steps(make, {1.0, 2.5, Rational(16, 3), 20.0}), "")
        << "seed " << seed;
  }
}

TEST(Advance, of_accelerated_points_is_as_step_by_step) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const auto motions = test::random_polynomial_motions(20, 30, 3, seed);
    const auto make = [&] {
      return std::make_unique<Simulation_2<Polynomial_kinetic_traits_2>>(motions,
                                                                         in_box({-5, -5, 35, 35}));
    };
    ASSERT_EQ(difference_from_steps(make, {0.5, 1.25, 2.0}), "") << "seed " << seed;
  }
}

TEST(Advance, of_discs_that_collide_is_as_step_by_step) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const auto motions = test::discs_in_a_box(25, 0.2, seed);
    const auto make = [&] {
      return std::make_unique<Simulation>(
          motions,
          test::discs(test::box_of(25), 3, seed % 2 == 0 ? collide_elastically : log_contact));
    };
    ASSERT_EQ(difference_from_steps(make, {0.5, 1.25, 4.0}), "") << "seed " << seed;
  }
}

// The time stays that of the last event before a radius would be negative.
TEST(Advance, stops_where_a_disc_vanishes_as_step_by_step) {
  using Discs = Simulation_2<Disc_kinetic_traits_2>;
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::vector<Disc_motion_2> motions;
    for (const Linear_motion_2& m : test::random_motions(12, 20, 3, seed)) {
      motions.push_back({m, 2, motions.size() == 5 ? -1.0 : 0.25, 0});
    }
    motions[5].velocity = {};  // else a wall rounds the radius
    Discs stepped(motions, in_box({-1, -1, 21, 21}));
    Discs advanced(motions, in_box({-1, -1, 21, 21}));
    const std::string expected =
        test::message_of<Negative_radius_error>([&] { step_to(stepped, 9.0); });
    EXPECT_EQ(test::message_of<Negative_radius_error>([&] { advanced.advance_to(9.0); }), expected);
    EXPECT_NE(expected.find("the radius of disc 5 shrinks to 0 at t = 2 "), std::string::npos);
    EXPECT_GT(stepped.current_time(), 0.0);
    ASSERT_EQ(difference_of_states(stepped, advanced), "") << "seed " << seed;
    EXPECT_EQ(stepped.advance_to(2.0), advanced.advance_to(2.0));
    ASSERT_EQ(difference_of_states(stepped, advanced), "") << "seed " << seed;
  }
}

// ---- may_go_on ----

// Wherever it stops, the time is that of the last event, and what follows is the same.
TEST(Advance, stops_where_it_may_not_go_on) {
  const auto motions = test::random_motions(30, 40, 5, 3);
  for (const bool looks : {false, true}) {
    Simulation whole(motions, in_box({-1, -1, 41, 41}));
    Log expected(true);
    whole.add_observer(expected);
    whole.advance_to(2.0);
    std::size_t stops = 0;
    bool is_whole = false;
    while (!is_whole) {
      Simulation simulation(motions, in_box({-1, -1, 41, 41}));
      Log log(looks);
      simulation.add_observer(log);
      std::size_t asked = 0;
      is_whole = true;
      simulation.advance_to(2.0, [&] {
        EXPECT_TRUE(is_whole) << "asked again";
        EXPECT_EQ(simulation.triangulation().counters().number_of_events(), log.events.size());
        is_whole = asked++ < stops;
        return is_whole;
      });
      ++stops;
      if (!is_whole) {
        ASSERT_LE(log.events.size(), expected.events.size());
        ASSERT_EQ(simulation.current_time(),
                  log.events.empty() ? Algebraic_number(0.0) : log.events.back().time);
        // All events of that time have happened.
        ASSERT_TRUE(log.events.empty() || log.events.size() == expected.events.size() ||
                    expected.events[log.events.size()].time > log.events.back().time);
        simulation.advance_to(2.0);
      }
      ASSERT_EQ(difference(expected, log), "") << "stopped at " << stops;
      ASSERT_EQ(difference_of_states(whole, simulation), "") << "stopped at " << stops;
    }
    EXPECT_GT(2 * stops, whole.triangulation().counters().instants);
  }
}

TEST(Advance, that_may_not_go_on_at_all_changes_nothing) {
  Simulation simulation(test::random_motions(30, 40, 5, 3), {});
  EXPECT_EQ(simulation.advance_to(2.0, [] { return false; }), 0u);
  EXPECT_EQ(simulation.current_time(), Algebraic_number(0.0));
  EXPECT_EQ(simulation.triangulation().counters().number_of_events(), 0u);
}

// ---- observers that schedule changes ----

// Schedules two insertions at each tenth flip: one at its time, and one later.
class Scheduler : public Event_observer {
 public:
  Scheduler(Simulation& simulation, bool looks) : simulation_(simulation), looks_(looks) {
    simulation.add_observer(*this);
  }
  bool looks_at_triangulation() const override { return looks_; }
  void after_event(const Event& event) override {
    if (event.kind != Event_kind::flip || ++flips_ % 10 != 0) return;
    const double place = static_cast<double>(flips_) / 16;
    simulation_.schedule_insert(event.time, {{place, place}, {1, 0}, 0});
    simulation_.schedule_insert(event.time.to_double() + 0.125, {{place, 40 - place}, {0, 1}, 0});
  }

 private:
  Simulation& simulation_;
  bool looks_;
  std::size_t flips_ = 0;
};

TEST(Advance, executes_what_an_observer_schedules_as_step_by_step) {
  const auto motions = test::random_motions(20, 40, 5, 8);
  Simulation stepped(motions, {});
  Simulation advanced(motions, {});
  const Scheduler first(stepped, true);
  const Scheduler second(advanced, true);
  EXPECT_EQ(step_to(stepped, 2.0), advanced.advance_to(2.0));
  EXPECT_EQ(difference_of_states(stepped, advanced), "");
  EXPECT_GT(count(advanced, Event_kind::insert), 5u);
}

TEST(Advance, refuses_changes_scheduled_by_who_does_not_look) {
  Simulation simulation(test::random_motions(20, 40, 5, 8), {});
  const Scheduler scheduler(simulation, false);
  EXPECT_PRECONDITION_ERROR(
      simulation.advance_to(2.0),
      "an observer that does not look at the triangulation has scheduled a change; let its "
      "looks_at_triangulation() return true");
}

}  // namespace
}  // namespace kinetri::advance_test
