// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/nearest_neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "observers/random_runs.h"
#include "support/brute_force_simulator.h"
#include "support/disc_runs.h"
#include "support/precondition_error.h"
#include "support/random_walks.h"

namespace kinetri {

// For messages of failed tests.
void PrintTo(const Nearest_neighbor_change& change, std::ostream* out) {
  *out << change.id << ": " << change.before << " -> " << change.after << " at "
       << change.time.to_double();
}

bool operator==(const Nearest_neighbor_change& a, const Nearest_neighbor_change& b) {
  return a.time == b.time && a.id == b.id && a.before == b.before && a.after == b.after;
}

}  // namespace kinetri

namespace kinetri::nearest_neighbors_test {
namespace {

// ---- the oracle: all triples, in exact arithmetic ----

template <class Motion>
using Motions = std::map<Point_id, Motion>;
using Nearest = std::map<Point_id, Point_id>;

// Which motions the points have from which times on.
template <class Traits>
class History : public Event_observer {
 public:
  using Motion = typename Traits::Motion;

  explicit History(Simulation_2<Traits>& simulation) : simulation_(simulation) {
    for (Point_id id = 0; id < simulation.triangulation().next_id(); ++id) note(id);
    pieces.emplace_back(simulation.current_time(), now_);
    simulation.add_observer(*this);
  }

  void after_event(const Event& event) override {
    if (!event.point_a) return;
    note(*event.point_a);
    if (event.point_b) note(*event.point_b);
    if (pieces.back().first == event.time) {
      pieces.back().second = now_;
    } else {
      pieces.emplace_back(event.time, now_);
    }
  }

  std::vector<std::pair<Algebraic_number, Motions<Motion>>> pieces;

 private:
  void note(Point_id id) {
    const auto& triangulation = simulation_.triangulation();
    if (triangulation.contains(id)) {
      now_.insert_or_assign(id, triangulation.motion(id));
    } else {
      now_.erase(id);
    }
  }

  Simulation_2<Traits>& simulation_;
  Motions<Motion> now_;
};

template <class Motion>
Nearest nearest_at(const Motions<Motion>& motions, const Rational& t) {
  Nearest result;
  std::map<Point_id, test::Static_point> places;
  for (const auto& [id, motion] : motions) places.emplace(id, test::place_at(motion, t));
  for (const auto& [id, place] : places) {
    std::optional<Rational> least;
    for (const auto& [other, there] : places) {
      if (other == id) continue;
      const Rational distance = CGAL::squared_distance(place, there);
      if (least && distance >= *least) continue;
      least = distance;
      result[id] = other;
    }
  }
  return result;
}

// The times between `from` and `to` at which two points are equally near to a third one.
template <class Motion>
std::vector<Algebraic_number> times_of_ties(const Motions<Motion>& motions,
                                            const Algebraic_number& from,
                                            const Algebraic_number& to) {
  constexpr int degree = std::same_as<Motion, Linear_motion_2> ? 2 : 6;
  std::vector<Algebraic_number> times;
  for (const auto& [p, of_p] : motions) {
    for (const auto& [q, of_q] : motions) {
      for (const auto& [r, of_r] : motions) {
        if (p == q || p == r || q >= r) continue;
        const Polynomial difference = test::interpolate(
            degree, [&of_p = of_p, &of_q = of_q, &of_r = of_r](const Rational& t) {
              const auto place = test::place_at(of_p, t);
              return Rational(CGAL::squared_distance(place, test::place_at(of_q, t)) -
                              CGAL::squared_distance(place, test::place_at(of_r, t)));
            });
        if (difference.is_zero()) continue;
        for (const Real_root& root : real_roots(difference)) {
          if (root.value > from && root.value < to) times.push_back(root.value);
        }
      }
    }
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void add_changes(std::vector<Nearest_neighbor_change>& changes, const Algebraic_number& time,
                 const Nearest& before, const Nearest& after) {
  std::map<Point_id, std::pair<Point_id, Point_id>> differences;
  for (const auto& [id, nearest] : before) differences[id] = {nearest, no_point};
  for (const auto& [id, nearest] : after) {
    differences.emplace(id, std::pair(no_point, no_point)).first->second.second = nearest;
  }
  for (const auto& [id, change] : differences) {
    if (change.first != change.second) changes.push_back({time, id, change.first, change.second});
  }
}

// All changes from the first piece until `until`, and those at that time.
template <class Traits>
std::vector<Nearest_neighbor_change> expected_changes(const History<Traits>& history,
                                                      const Algebraic_number& until) {
  std::vector<Nearest_neighbor_change> result;
  Nearest now;
  for (std::size_t i = 0; i < history.pieces.size(); ++i) {
    const auto& [begin, motions] = history.pieces[i];
    const bool is_last = i + 1 == history.pieces.size();
    const Algebraic_number end =
        is_last ? Algebraic_number(Rational(until.upper() + 1)) : history.pieces[i + 1].first;
    std::vector<Algebraic_number> times = times_of_ties(motions, begin, end);
    times.push_back(end);
    Algebraic_number previous = begin;
    for (const Algebraic_number& time : times) {
      if (previous > until) break;
      const Nearest next = nearest_at(motions, simplest_between(previous, time));
      add_changes(result, previous, now, next);
      now = next;
      previous = time;
    }
  }
  return result;
}

// Watches a run from its start. `check` is to be called at its end.
template <class Traits>
class Watched_run {
 public:
  explicit Watched_run(Simulation_2<Traits>& simulation)
      : simulation_(simulation), history_(simulation), nearest_(simulation) {}

  Nearest_neighbors<Traits>& nearest() { return nearest_; }

  void check() {
    const Algebraic_number until = simulation_.current_time();
    const auto& changes = nearest_.changes();
    EXPECT_EQ(changes, expected_changes(history_, until));
    std::vector<Point_id> now(simulation_.triangulation().next_id(), no_point);
    for (const auto& change : changes) now[change.id] = change.after;
    EXPECT_EQ(nearest_.nearest_neighbors(), now);
  }

 private:
  Simulation_2<Traits>& simulation_;
  History<Traits> history_;
  Nearest_neighbors<Traits> nearest_;
};

template <class Traits>
void run_and_check(const std::vector<typename Traits::Motion>& motions, double until,
                   const Simulation_options& options = {}) {
  Simulation_2<Traits> simulation(motions, options);
  Watched_run<Traits> run(simulation);
  simulation.advance_to(until);
  run.check();
}

// ---- by hand ----

TEST(Nearest_neighbors, change_where_another_point_becomes_nearer) {
  Simulation_2<> simulation({{{0, 0}, {}, 0}, {{-2, 0}, {}, 0}, {{4, 0}, {-1, 0}, 0}}, {});
  Nearest_neighbors nearest(simulation);
  EXPECT_EQ(nearest.nearest_neighbors(), (std::vector<Point_id>{1, 0, 0}));
  simulation.advance_to(1.5);
  EXPECT_EQ(nearest.nearest_neighbor(0), 1u);
  simulation.advance_to(2.0);
  EXPECT_EQ(nearest.nearest_neighbor(0), 2u) << "just after the tie";
  simulation.advance_to(3.0);
  const std::vector<Nearest_neighbor_change> expected = {
      {0.0, 0, no_point, 1}, {0.0, 1, no_point, 0}, {0.0, 2, no_point, 0}, {2.0, 0, 1, 2}};
  EXPECT_EQ(nearest.changes(), expected);
  EXPECT_PRECONDITION_ERROR(nearest.nearest_neighbor(3), "there is no point with the id 3");
}

// Point 2 comes as near to 0 as 1 is, at t = 2, and goes away again.
TEST(Nearest_neighbors, do_not_change_at_a_tie_of_a_moment) {
  Simulation_2<> simulation({{{0, 0}, {}, 0}, {{-1, 0}, {}, 0}, {{-2, 1}, {1, 0}, 0}}, {});
  Nearest_neighbors nearest(simulation);
  simulation.advance_to(2.0);
  EXPECT_EQ(nearest.nearest_neighbor(0), 1u);
  EXPECT_EQ(Kinetic_queries_2(simulation.triangulation()).nearest_neighbor(0), 1u);
  simulation.advance_to(4.0);
  EXPECT_EQ(nearest.changes().size(), 4u) << "the start, and point 2, which is nearer to 1 first";
}

TEST(Nearest_neighbors, are_those_with_the_smallest_id_of_a_lasting_tie) {
  std::vector<Linear_motion_2> grid;
  for (int i = 0; i < 9; ++i) grid.push_back({{double(i % 3), double(i / 3)}, {1, 0}, 0});
  Simulation_2<> simulation(grid, {});
  Nearest_neighbors nearest(simulation);
  simulation.advance_to(5.0);
  EXPECT_EQ(nearest.nearest_neighbors(), (std::vector<Point_id>{1, 0, 1, 0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(nearest.changes().size(), 9u);
}

TEST(Nearest_neighbors, of_none_one_and_two_points) {
  Simulation_2<> simulation({}, {});
  Nearest_neighbors nearest(simulation);
  EXPECT_TRUE(nearest.nearest_neighbors().empty());
  const Point_id a = simulation.insert({{0, 0}, {}, 0});
  EXPECT_EQ(nearest.nearest_neighbor(a), std::nullopt);
  simulation.advance_to(1.0);
  const Point_id b = simulation.insert({{1, 0}, {}, 0});
  EXPECT_EQ(nearest.nearest_neighbor(a), b);
  simulation.advance_to(2.0);
  simulation.erase(a);
  EXPECT_EQ(nearest.nearest_neighbor(b), std::nullopt);
  const std::vector<Nearest_neighbor_change> expected = {
      {1.0, a, no_point, b}, {1.0, b, no_point, a}, {2.0, a, b, no_point}, {2.0, b, a, no_point}};
  EXPECT_EQ(nearest.changes(), expected);
}

TEST(Nearest_neighbors, give_changes_to_a_function_in_order) {
  std::vector<Nearest_neighbor_change> told;
  Simulation_2<> simulation(test::random_motions(20, 10, 1, 1), {});
  Nearest_neighbors kept(simulation);
  Nearest_neighbors given(simulation, [&](const auto& change) { told.push_back(change); });
  simulation.advance_to(5.0);
  EXPECT_TRUE(given.changes().empty());
  EXPECT_EQ(told, kept.changes());
  EXPECT_TRUE(
      std::ranges::is_sorted(told, [](const auto& a, const auto& b) { return a.time < b.time; }));
}

// A point that turns at the time of a tie, so that nothing changes after all.
TEST(Nearest_neighbors, report_what_happens_at_one_time_as_one_change) {
  Simulation_2<> simulation({{{0, 0}, {}, 0}, {{-2, 0}, {}, 0}, {{4, 0}, {-1, 0}, 0}}, {});
  Nearest_neighbors nearest(simulation);
  simulation.schedule_motion(2.0, 2, {{2, 0}, {1, 0}, 2});
  simulation.advance_to(3.0);
  EXPECT_EQ(nearest.nearest_neighbor(0), 1u);
  EXPECT_EQ(nearest.changes().size(), 3u);
}

// ---- against the oracle ----

TEST(Nearest_neighbors, of_random_motions_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run_and_check<Linear_kinetic_traits_2>(test::random_motions(12, 10, 1, seed), 10);
  }
}

TEST(Nearest_neighbors, of_degenerate_motions_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(12u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run_and_check<Linear_kinetic_traits_2>(test::grid_motions(8, 4, 1, seed), 4);
  }
}

// Points that pass through one another.
TEST(Nearest_neighbors, on_a_line_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Linear_motion_2> motions = test::grid_motions(7, 6, 2, seed);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      motions[i].position = {motions[i].position.x + 8 * motions[i].position.y, 0};
      motions[i].velocity.y = 0;
    }
    std::vector<Linear_motion_2> distinct;
    for (const auto& motion : motions) {
      if (std::ranges::find(distinct, motion) == distinct.end()) distinct.push_back(motion);
    }
    if (seed % 2 == 1) distinct.push_back({{3, 1}, {1, 0}, 0});
    run_and_check<Linear_kinetic_traits_2>(distinct, 20);
  }
}

TEST(Nearest_neighbors, of_accelerated_motions_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run_and_check<Polynomial_kinetic_traits_2>(test::polynomial_grid_motions(6, 4, 2, 3, seed), 2);
  }
}

TEST(Nearest_neighbors, of_points_between_walls_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run_and_check<Linear_kinetic_traits_2>(test::random_motions(7, 4, 2, seed), 3,
                                           test::in_box({0, 0, 4, 4}));
    Simulation_options options = test::discs(0.125, collide_elastically);
    options.box = Box_2{0, 0, 4, 4};
    run_and_check<Linear_kinetic_traits_2>(test::grid_motions(6, 4, 1, seed), 3, options);
  }
}

TEST(Nearest_neighbors, of_points_that_come_turn_and_go_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Simulation_2<> simulation(test::grid_motions(5, 4, 1, seed), {});
    Watched_run<Linear_kinetic_traits_2> run(simulation);
    const auto others = test::grid_motions(20, 4, 1, seed + 1000);
    for (std::size_t step = 0; step < others.size(); ++step) {
      if (random() % 3 != 0) {
        simulation.advance_to(simulation.current_time().to_double() +
                              0.25 * static_cast<double>(1 + random() % 4));
      }
      Linear_motion_2 motion = others[step];
      motion.epoch = simulation.current_time().to_double();
      test::change_at_random(simulation, motion, random);
    }
    run.check();
  }
}

TEST(Nearest_neighbors, of_tracks_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double fraction = seed % 2 == 0 ? 0 : 0x1p-10;
    const test::Tracks tracks = test::random_walks(8, seed, 0, fraction);
    const auto simulation = simulate_tracks(tracks, stays_of(tracks, {.from = 0}), 0, {}, {});
    Watched_run<Linear_kinetic_traits_2> run(*simulation);
    simulation->advance_to(60.0);
    run.check();
  }
}

// Whole tracks of real people, who stand still and walk side by side.
TEST(Nearest_neighbors, of_a_real_crowd_are_those_of_all_pairs) {
  const std::string path = KINETRI_SHARED_DATA "/crowd/biwi_eth.txt";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  test::Tracks tracks;
  for (const Track& track : read_tracks_file(path, Tracks_format::frames, 25).tracks) {
    tracks.emplace_back();
    for (const auto& seen : track.observations) tracks.back().push_back({seen.time, seen.place});
  }
  const double start = 30;
  const auto simulation =
      simulate_tracks(tracks, stays_of(tracks, {.from = start, .longest_gap = 1}), start);
  Nearest_neighbors nearest(*simulation);
  std::size_t compared = 0;
  for (double time = start + 0.03; time < start + 120; time += 0.17) {
    simulation->advance_to(time);
    Motions<Linear_motion_2> motions;
    const auto& triangulation = simulation->triangulation();
    std::vector<Point_id> expected(triangulation.next_id(), no_point);
    for (Point_id id = 0; id < triangulation.next_id(); ++id) {
      if (triangulation.contains(id)) motions.emplace(id, triangulation.motion(id));
    }
    for (const auto& [id, other] : nearest_at(motions, to_rational(time))) expected[id] = other;
    ASSERT_EQ(nearest.nearest_neighbors(), expected) << "at " << time;
    compared += motions.size();
  }
  EXPECT_GT(compared, 1000u);
  // The list tells the same at the end.
  std::vector<Point_id> now(simulation->triangulation().next_id(), no_point);
  for (const auto& change : nearest.changes()) now[change.id] = change.after;
  EXPECT_EQ(nearest.nearest_neighbors(), now);
}

// The simulation stops at events too: at irrational times.
TEST(Nearest_neighbors, between_steps_are_those_of_queries) {
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation_2<> simulation(test::random_motions(40, 10, 1, seed), {});
    Nearest_neighbors nearest(simulation);
    for (int step = 0; step < 50 && simulation.step() > 0; ++step) {
      EXPECT_EQ(nearest.nearest_neighbors(),
                Kinetic_queries_2(simulation.triangulation()).nearest_neighbors());
    }
  }
}

}  // namespace
}  // namespace kinetri::nearest_neighbors_test
