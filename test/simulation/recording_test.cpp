// SPDX-License-Identifier: GPL-3.0-or-later
//
// A recording that is played shows the edges, the triangles and the motions that the run had at
// each time; where it is thinned, at each time that is left.
#include "kinetri/simulation/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/simulation/tracks.h"
#include "support/disc_runs.h"
#include "support/motions.h"
#include "support/precondition_error.h"
#include "support/triangles.h"

namespace kinetri::recording_test {
namespace {

using Motions = std::map<Point_id, Polynomial_disc_motion_2>;

// What there is just after a time.
struct State {
  std::vector<Edge_ids> edges;
  std::set<Triangle_ids> triangles;
  Motions motions;

  friend bool operator==(const State&, const State&) = default;
};

Polynomial_disc_motion_2 disc(const Linear_motion_2& motion) {
  return {{motion.position, motion.velocity, {}, {}, motion.epoch}};
}
Polynomial_disc_motion_2 disc(const Polynomial_motion_2& motion) {
  return {motion};
}
Polynomial_disc_motion_2 disc(const Disc_motion_2& motion) {
  return {disc(static_cast<const Linear_motion_2&>(motion)), motion.radius, motion.growth,
          motion.weight};
}
Polynomial_disc_motion_2 disc(const Polynomial_disc_motion_2& motion) {
  return motion;
}

template <class Triangulation>
State state_of(const Triangulation& triangulation) {
  State result;
  result.edges = triangulation.finite_edge_ids();
  result.triangles = test::triangles_of(triangulation);
  for (Point_id id = 0; id < triangulation.next_id(); ++id) {
    if (triangulation.contains(id)) result.motions[id] = disc(triangulation.motion(id));
  }
  return result;
}

// A run, watched step by step, and its recording.
struct Watched_run {
  State start;
  std::vector<std::pair<Algebraic_number, State>> instants;
  std::uint64_t events = 0;
  Recording recording;
};

// Appends a part of a recording (Recorder::take).
void append(Recording& recording, const Recording& part) {
  EXPECT_EQ(part.from, recording.until);
  EXPECT_TRUE(part.initial_edges.empty());
  EXPECT_TRUE(part.initial_triangles.empty());
  const std::size_t rows = recording.events.size();
  recording.until = part.until;
  recording.events_in_all += part.events_in_all;
  recording.events.insert(recording.events.end(), part.events.begin(), part.events.end());
  for (Recorded_motion motion : part.motions) {
    ASSERT_TRUE(motion.event);
    *motion.event += rows;
    recording.motions.push_back(motion);
  }
  for (Recorded_coincidence coincidence : part.coincidences) {
    ASSERT_TRUE(coincidence.event);
    *coincidence.event += rows;
    recording.coincidences.push_back(coincidence);
  }
  for (Recorded_triangle triangle : part.triangles) {
    triangle.event += rows;
    recording.triangles.push_back(triangle);
  }
}

void expect_equal(const Recording& a, const Recording& b) {
  EXPECT_EQ(a.from, b.from);
  EXPECT_EQ(a.until, b.until);
  EXPECT_EQ(a.events_in_all, b.events_in_all);
  EXPECT_EQ(a.initial_edges, b.initial_edges);
  EXPECT_EQ(a.initial_triangles, b.initial_triangles);
  EXPECT_EQ(a.coincidences, b.coincidences);
  EXPECT_EQ(a.triangles, b.triangles);
  const auto of_motion = [](const Recorded_motion& motion) {
    return std::tuple(motion.event, motion.point, motion.motion);
  };
  EXPECT_TRUE(std::ranges::equal(a.motions, b.motions, {}, of_motion, of_motion));
  const auto of_event = [](const Recorded_event& event) {
    return std::tuple(event.number, event.kind, event.time, event.removed, event.added,
                      event.point_a, event.point_b);
  };
  EXPECT_TRUE(std::ranges::equal(a.events, b.events, {}, of_event, of_event));
}

// Also records the run in parts, one for each step, which must make the same recording.
template <class Traits>
Watched_run watch(Simulation_2<Traits>& simulation, double until, std::size_t most_rows) {
  Watched_run result;
  result.start = state_of(simulation.triangulation());
  Recorder<Traits> recorder(simulation.triangulation(), until, most_rows);
  Recorder<Traits> parts(simulation.triangulation(), until, 1'000'000'000);
  simulation.add_observer(recorder);
  simulation.add_observer(parts);
  Recording whole = parts.take();
  while (const std::size_t events = simulation.step(Algebraic_number(until))) {
    result.events += events;
    append(whole, parts.take());
    result.instants.emplace_back(simulation.current_time(), state_of(simulation.triangulation()));
  }
  simulation.advance_to(Algebraic_number(until));
  append(whole, parts.take());
  result.recording = recorder.recording();
  if (!result.recording.is_thinned) expect_equal(whole, result.recording);
  simulation.remove_observer(recorder);
  simulation.remove_observer(parts);
  return result;
}

// Plays the recording, and compares at each time of a row.
void expect_plays(const Watched_run& run) {
  const Recording& recording = run.recording;
  std::set<Edge_ids> edges(recording.initial_edges.begin(), recording.initial_edges.end());
  test::Triangle_player triangles(recording);
  Motions motions;
  auto motion = recording.motions.begin();
  for (; motion != recording.motions.end() && !motion->event; ++motion) {
    ASSERT_TRUE(motion->motion);
    motions[motion->point] = *motion->motion;
  }
  const auto now = [&] {
    return State{{edges.begin(), edges.end()}, triangles.triangles(), motions};
  };
  EXPECT_EQ(now(), run.start);
  auto instant = run.instants.begin();
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    const Recorded_event& event = recording.events[i];
    triangles.execute(i);
    if (event.removed) {
      EXPECT_EQ(edges.erase(*event.removed), 1u) << "row " << i;
    }
    if (event.added) {
      EXPECT_TRUE(edges.insert(*event.added).second) << "row " << i;
    }
    for (; motion != recording.motions.end() && motion->event == i; ++motion) {
      EXPECT_TRUE(motion->point == event.point_a || motion->point == event.point_b);
      EXPECT_NE(motions.contains(motion->point), event.kind == Event_kind::insert) << "row " << i;
      if (motion->motion) {
        motions[motion->point] = *motion->motion;
      } else {
        EXPECT_EQ(motions.erase(motion->point), 1u) << "row " << i;
      }
    }
    if (i + 1 < recording.events.size() && recording.events[i + 1].time == event.time) continue;
    const auto is_meant = [&](const auto& other) {
      return other.first.to_double() == event.time.nearest;
    };
    instant = std::find_if(instant, run.instants.end(), is_meant);
    ASSERT_NE(instant, run.instants.end()) << "row " << i << " is at no instant";
    EXPECT_EQ(event.time.bounds, instant->first.tight_interval());
    EXPECT_EQ(now(), instant->second) << "after row " << i << ", t = " << event.time.nearest;
  }
  EXPECT_EQ(motion, recording.motions.end());
  EXPECT_TRUE(triangles.is_at_end());
  if (!run.instants.empty()) {
    EXPECT_EQ(now(), run.instants.back().second);
  }
  EXPECT_EQ(recording.events_in_all, run.events);
}

TEST(Recording, plays_flips) {
  Simulation_2<> simulation(test::random_motions(60, 80, 5, 1), {}, -1.5);
  const Watched_run run = watch(simulation, 6, 100'000);
  EXPECT_GT(run.events, 100u);
  EXPECT_FALSE(run.recording.is_thinned);
  EXPECT_EQ(run.recording.events.size(), run.events);
  EXPECT_EQ(run.recording.from, -1.5);
  EXPECT_EQ(run.recording.until, 6);
  EXPECT_EQ(run.recording.motions.size(), 60u);
  expect_plays(run);
}

TEST(Recording, plays_walls_and_collisions) {
  for (const auto response : {collide_elastically, erase_both, log_contact}) {
    Simulation_2<> simulation(test::random_motions(60, 40, 5, 2),
                              test::discs({0, 0, 40, 40}, 0.5, response));
    const Watched_run run = watch(simulation, 5, 100'000);
    EXPECT_GT(run.recording.motions.size(), 80u);
    expect_plays(run);
  }
}

// Discs of many sizes that pass over each other, so that some are hidden for a while.
template <class Traits, class Disc>
void expect_plays_hidden_points(const std::vector<Disc>& discs) {
  Simulation_2<Traits> simulation(discs, {});
  EXPECT_GT(simulation.triangulation().number_of_hidden_points(), 0u);
  const Watched_run run = watch(simulation, 4, 100'000);
  const auto& counts = simulation.triangulation().counters().events;
  EXPECT_GT(counts[static_cast<std::size_t>(Event_kind::hide)], 5u);
  EXPECT_GT(counts[static_cast<std::size_t>(Event_kind::reveal)], 5u);
  EXPECT_EQ(run.recording.motions.size(), discs.size());
  expect_plays(run);
  Simulation_2<Traits> again(discs, {});
  const Watched_run thinned = watch(again, 4, 60);
  EXPECT_TRUE(thinned.recording.is_thinned);
  expect_plays(thinned);
}

TEST(Recording, plays_discs_that_hide_each_other) {
  std::vector<Disc_motion_2> discs;
  std::vector<Polynomial_disc_motion_2> bent;
  for (const Linear_motion_2& m : test::random_motions(60, 60, 5, 14)) {
    const auto i = static_cast<double>(discs.size());
    discs.push_back({m, std::fmod(7 * i, 11) * 1.5, std::fmod(i, 3) / 4, i < 5 ? -20.0 : 0});
    bent.push_back(disc(discs.back()));
    bent.back().acceleration = {std::fmod(i, 3) - 1, -1};
  }
  expect_plays_hidden_points<Disc_kinetic_traits_2>(discs);
  expect_plays_hidden_points<Polynomial_disc_kinetic_traits_2>(bent);
}

TEST(Recording, plays_degenerate_instants) {
  // A lattice whose points meet.
  std::vector<Linear_motion_2> motions;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      motions.push_back({{x * 4.0, y * 4.0}, {(x * y) % 3 - 1.0, (x + 2 * y) % 3 - 1.0}});
    }
  }
  Simulation_2<> simulation(motions, {});
  const Watched_run run = watch(simulation, 12, 100'000);
  EXPECT_GT(simulation.triangulation().counters().events[0], 0u) << "no rebuild";
  EXPECT_LT(run.instants.size(), run.events) << "no simultaneous events";
  expect_plays(run);
}

// Discs that hide each other on a lattice: no edge comes that is there.
TEST(Recording, plays_degenerate_instants_of_discs) {
  std::uint64_t hides = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::vector<Disc_motion_2> discs;
    const auto size = 4 + static_cast<int>(seed % 40);
    for (const Linear_motion_2& m : test::grid_motions(5 + seed, size, 3, seed)) {
      const std::size_t i = discs.size();
      discs.push_back(
          {m, static_cast<double>(i * (seed + 3) % 3), static_cast<double>(seed % 3), 0});
    }
    Simulation_2<Disc_kinetic_traits_2> simulation(discs, {});
    const Watched_run run = watch(simulation, 4, 100'000);
    hides +=
        simulation.triangulation().counters().events[static_cast<std::size_t>(Event_kind::hide)];
    ASSERT_NO_FATAL_FAILURE(expect_plays(run)) << "seed " << seed;
  }
  EXPECT_GT(hides, 100u);
}

// Points 2 and 3 meet on the hull at t = 1 and go through each other. Before, 2 is inside the
// triangle 0 1 3; after, 3 is inside 0 1 2. All six edges stay, and no event is reported.
const std::vector<Linear_motion_2> passing = {
    {{-4, 0}, {}}, {{4, 0}, {}}, {{0, 2}, {0, 1}}, {{0, 4}, {0, -1}}, {{0, -50}, {}}};

TEST(Recording, has_triangles_that_change_without_an_event) {
  Simulation_2<> simulation(passing, {});
  const Watched_run run = watch(simulation, 1.5, 100);
  EXPECT_EQ(run.events, 0u);
  ASSERT_EQ(run.recording.events.size(), 1u);
  const Recorded_event& row = run.recording.events[0];
  EXPECT_EQ(row.kind, Event_kind::rebuild);
  EXPECT_EQ(row.number, 0u);
  EXPECT_EQ(row.time.nearest, 1);
  EXPECT_FALSE(row.removed || row.added || row.point_a || row.point_b);
  EXPECT_EQ(run.start.edges, simulation.triangulation().finite_edge_ids());
  const std::set<Triangle_ids> last = test::triangles_of(simulation.triangulation());
  EXPECT_NE(run.start.triangles, last);
  test::Triangle_player triangles(run.recording);
  EXPECT_EQ(triangles.triangles(), run.start.triangles);
  triangles.execute(0);
  EXPECT_EQ(triangles.triangles(), last);
}

TEST(Recording, has_triangles_that_turn_over_without_an_event) {
  // All points are on the x axis at t = 1.
  const std::vector<Linear_motion_2> motions = {
      {{-9, -1}, {0, 1}}, {{9, -1}, {0, 1}}, {{1, 3}, {0, -3}}};
  Simulation_2<> simulation(motions, {});
  const Watched_run run = watch(simulation, 2, 100);
  EXPECT_EQ(run.events, 0u);
  EXPECT_EQ(run.recording.initial_triangles, (std::vector<Triangle_ids>{{0, 1, 2}}));
  EXPECT_EQ(run.recording.triangles,
            (std::vector<Recorded_triangle>{{0, false, {0, 1, 2}}, {0, true, {0, 2, 1}}}));
  ASSERT_EQ(run.recording.events.size(), 1u);
  EXPECT_EQ(run.recording.events[0].time.nearest, 1);
}

TEST(Recording, of_triangles_that_change_without_an_event_may_be_thinned) {
  std::vector<Linear_motion_2> motions = passing;
  for (const Linear_motion_2& m : test::random_motions(40, 40, 5, 10)) {
    motions.push_back({{m.position.x, m.position.y - 100}, m.velocity});
  }
  Simulation_2<> simulation(motions, {});
  const Watched_run run = watch(simulation, 6, 60);
  EXPECT_TRUE(run.recording.is_thinned);
  expect_plays(run);
}

TEST(Recording, plays_points_that_come_turn_and_go) {
  std::vector<std::vector<Observation_2>> tracks;
  const auto motions = test::random_motions(40, 30, 4, 3);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    auto& track = tracks.emplace_back();
    for (std::size_t k = i % 7; k < 12; k += 1 + i % 3) {
      const double turn = k % 2 == 0 ? 1 : -0.5;
      track.push_back({static_cast<double>(k),
                       {motions[i].position.x + turn * motions[i].velocity.x,
                        motions[i].position.y + turn * motions[i].velocity.y}});
    }
  }
  const auto stays = stays_of(tracks, {0, 12});
  const auto run_with = [&](std::size_t most_rows) {
    const auto simulation = simulate_tracks(tracks, stays, 0, {}, {});
    return watch(*simulation, 12, most_rows);
  };
  const Watched_run run = run_with(100'000);
  EXPECT_FALSE(run.recording.is_thinned);
  expect_plays(run);
  const Watched_run thinned = run_with(200);
  EXPECT_TRUE(thinned.recording.is_thinned);
  expect_plays(thinned);
}

TEST(Recording, plays_points_that_accelerate) {
  std::vector<Polynomial_motion_2> motions;
  for (const Linear_motion_2& m : test::random_motions(30, 30, 3, 4)) {
    motions.push_back({m.position, m.velocity, {0, -1}, {m.velocity.y / 4, 0}, 0});
  }
  Simulation_2<Polynomial_kinetic_traits_2> simulation(motions, {});
  const Watched_run run = watch(simulation, 5, 100'000);
  EXPECT_GT(run.events, 20u);
  expect_plays(run);
}

TEST(Recording, is_thinned_to_exact_instants) {
  for (const std::size_t most_rows : {450u, 700u, 1000u}) {
    Simulation_2<> simulation(test::random_motions(60, 40, 5, 5),
                              test::discs({0, 0, 40, 40}, 0.25, collide_elastically));
    const Watched_run run = watch(simulation, 16, most_rows);
    ASSERT_GT(run.events, 1500u);
    EXPECT_TRUE(run.recording.is_thinned);
    EXPECT_LE(run.recording.events.size(), most_rows);
    // Not more than is needed: a quarter of the limit is left.
    EXPECT_GE(4 * run.recording.events.size(), most_rows) << most_rows;
    expect_plays(run);
  }
}

TEST(Recording, has_no_parts_once_it_is_thinned) {
  Simulation_2<> simulation(test::random_motions(30, 30, 5, 9), {});
  Recorder<> recorder(simulation.triangulation(), 10, 2);
  simulation.add_observer(recorder);
  simulation.advance_to(10);
  EXPECT_PRECONDITION_ERROR(recorder.take(), "parts of a recording that is thinned");
}

TEST(Recording, of_many_changes_is_thinned_to_the_difference_of_start_and_end) {
  Simulation_2<> simulation(test::random_motions(60, 60, 5, 6), {});
  const Watched_run run = watch(simulation, 8, 1);
  EXPECT_TRUE(run.recording.is_thinned);
  std::vector<Edge_ids> difference;
  std::ranges::set_symmetric_difference(run.start.edges, run.instants.back().second.edges,
                                        std::back_inserter(difference));
  EXPECT_EQ(run.recording.events.size(), difference.size());
  expect_plays(run);
}

TEST(Recording, of_an_instant_may_be_thinned) {
  // Everything happens at the only time that there is: points are inserted and erased.
  Simulation_2<> simulation(test::random_motions(20, 20, 5, 7), {});
  Recorder<> recorder(simulation.triangulation(), 0, 50);
  simulation.add_observer(recorder);
  const State start = state_of(simulation.triangulation());
  for (const Linear_motion_2& motion : test::random_motions(30, 20, 5, 8)) {
    const Point_id id = simulation.insert(motion);
    if (id % 2 == 0) simulation.erase(id);
  }
  const Recording recording = recorder.recording();
  EXPECT_TRUE(recording.is_thinned);
  Watched_run run;
  run.start = start;
  run.instants.emplace_back(0.0, state_of(simulation.triangulation()));
  run.recording = recording;
  run.events = simulation.triangulation().counters().number_of_events();
  expect_plays(run);
}

TEST(Recording, of_nothing_is_empty) {
  Simulation_2<> simulation(std::vector<Linear_motion_2>{}, {}, 2.0);
  const Watched_run run = watch(simulation, 2, 10);
  EXPECT_TRUE(run.recording.events.empty());
  EXPECT_TRUE(run.recording.motions.empty());
  EXPECT_EQ(run.recording.from, 2);
  EXPECT_EQ(run.recording.until, 2);
  EXPECT_PRECONDITION_ERROR(Recorder<>(simulation.triangulation(), 3, 0), "a recording of no rows");
  EXPECT_PRECONDITION_ERROR(Recorder<>(simulation.triangulation(), 1.0 / 0.0, 1),
                            "the end of a recording is not finite");
}

TEST(Recording, says_how_far_it_got) {
  Simulation_2<> simulation(test::random_motions(30, 30, 5, 9), {});
  Recorder<> recorder(simulation.triangulation(), 100, 1000);
  simulation.add_observer(recorder);
  simulation.step();
  const Recording recording = recorder.recording();
  EXPECT_EQ(recording.until, simulation.current_time().to_double());
  EXPECT_EQ(recording.events.back().time.nearest, recording.until);
}

// ---- periodic boxes ----

struct Periodic_state {
  std::vector<Periodic_edge> edges;
  std::set<Periodic_triangle> triangles;

  friend bool operator==(const Periodic_state&, const Periodic_state&) = default;
};

// Each triangle by the least of its three names.
template <class Traits>
Periodic_state state_of(const Kinetic_triangulation_2<Traits>& triangulation) {
  Periodic_state result = {triangulation.periodic_edges(), {}};
  for (const auto face : triangulation.triangulation().finite_face_handles()) {
    std::set<Periodic_triangle> names;
    for (int i = 0; i < 3; ++i) {
      const std::array<int, 3> corners = {i, (i + 1) % 3, (i + 2) % 3};
      Periodic_triangle name;
      for (std::size_t k = 0; k < 3; ++k) {
        name.corners[k] = face->vertex(corners[k])->point().id();
        if (k == 0) continue;
        const Lattice_offset_2 from = face->offset(i);
        const Lattice_offset_2 to = face->offset(corners[k]);
        name.offsets[k - 1] = {to.x - from.x, to.y - from.y};
      }
      names.insert(name);
    }
    EXPECT_TRUE(result.triangles.insert(*names.begin()).second);
  }
  return result;
}

// Advances by an instant, up to `until`; returns whether there was one.
constexpr auto step_only = [](auto& kinetic, double until) {
  return kinetic.step(Algebraic_number(until)) > 0;
};

// Plays a recording of a run in a periodic box. Returns the number of rows.
template <class Motion, class Step = decltype(step_only)>
std::size_t expect_plays_in_box(const std::vector<Motion>& motions, const Periodic_box_2& box,
                                double until, std::size_t most_rows, Step step = step_only) {
  using Traits = Basic_periodic_kinetic_traits_2<Motion>;
  Kinetic_triangulation_2<Traits> kinetic(motions, 0, Traits(box));
  Recorder<Traits> recorder(kinetic, until, most_rows);
  Recorder<Traits> parts(kinetic, until, 1'000'000'000);
  kinetic.add_observer(recorder);
  kinetic.add_observer(parts);
  const Periodic_state start = state_of(kinetic);
  std::map<double, Periodic_state> instants;  // the last one of those that round to a number
  Recording whole = parts.take();
  while (step(kinetic, until)) {
    append(whole, parts.take());
    instants[kinetic.current_time().to_double()] = state_of(kinetic);
  }
  kinetic.advance_to(Algebraic_number(until));
  append(whole, parts.take());
  const Recording recording = recorder.recording();
  if (!recording.is_thinned) expect_equal(whole, recording);
  EXPECT_EQ(recording.periodic_box, box);

  EXPECT_EQ(recording.initial_edges, [&] {
    std::vector<Edge_ids> ids;
    for (const Periodic_edge& edge : start.edges) ids.push_back(edge.ids);
    return ids;
  }());
  std::set<Periodic_edge> edges(start.edges.begin(), start.edges.end());
  std::set<Periodic_triangle> triangles;
  for (std::size_t i = 0; i < recording.initial_triangles.size(); ++i) {
    triangles.insert({recording.initial_triangles[i], recording.initial_offsets[i]});
  }
  EXPECT_EQ(triangles, start.triangles);
  auto triangle = recording.triangles.begin();
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    const Recorded_event& event = recording.events[i];
    if (event.removed) {
      EXPECT_EQ(edges.erase({*event.removed, event.removed_offset}), 1u) << "row " << i;
    }
    if (event.added) {
      EXPECT_TRUE(edges.insert({*event.added, event.added_offset}).second) << "row " << i;
    }
    for (; triangle != recording.triangles.end() && triangle->event == i; ++triangle) {
      const Periodic_triangle changed = {triangle->corners, triangle->offsets};
      if (triangle->is_added) {
        EXPECT_TRUE(triangles.insert(changed).second) << "row " << i;
      } else {
        EXPECT_EQ(triangles.erase(changed), 1u) << "row " << i;
      }
    }
    if (i + 1 < recording.events.size() && recording.events[i + 1].time == event.time) continue;
    const auto instant = instants.find(event.time.nearest);
    if (instant == instants.end()) {
      ADD_FAILURE() << "row " << i << " is at no instant";
      continue;
    }
    const Periodic_state now = {{edges.begin(), edges.end()}, triangles};
    EXPECT_EQ(now, instant->second) << "after row " << i << ", t = " << event.time.nearest;
  }
  EXPECT_EQ(triangle, recording.triangles.end());
  EXPECT_EQ((Periodic_state{{edges.begin(), edges.end()}, triangles}), state_of(kinetic));
  kinetic.remove_observer(recorder);
  kinetic.remove_observer(parts);
  return recording.events.size();
}

TEST(Recording, plays_runs_in_periodic_boxes) {
  const Periodic_box_2 sheared({{10, 0}, {0, 0}}, {{3, 9}, {5, 0}});
  for (const std::size_t points : {0U, 1U, 2U, 3U, 7U, 40U}) {
    const auto motions = test::random_motions(points, 10, 3, 4);
    const std::size_t rows = expect_plays_in_box(motions, sheared, 4, 100'000);
    EXPECT_GT(rows + (points == 0 ? 1 : 0), points) << points;
  }
}

// Discs of any radii, some of which are hidden for a while.
TEST(Recording, plays_runs_of_discs_in_periodic_boxes) {
  const Periodic_box_2 sheared({{10, 0}, {0, 0}}, {{3, 9}, {5, 0}});
  for (const std::size_t points : {1U, 3U, 40U}) {
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : test::random_motions(points, 10, 3, 6)) {
      const auto number = static_cast<double>(discs.size());
      discs.push_back({motion, 0.5 * std::fmod(number, 5), 0.01 * number, 0});
    }
    const std::size_t rows = expect_plays_in_box(discs, sheared, 4, 100'000);
    EXPECT_GT(rows, points) << points;
  }
}

TEST(Recording, plays_degenerate_instants_in_periodic_boxes) {
  std::vector<Linear_motion_2> motions;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) {
      motions.push_back({{x * 4.0, y * 4.0}, {(x * y) % 3 - 1.0, (x + 2 * y) % 3 - 1.0}});
    }
  }
  EXPECT_GT(expect_plays_in_box(motions, {{{16, 0}, {0, 0}}, {{0, 16}, {0, 0}}}, 12, 100'000),
            100u);
}

TEST(Recording, plays_changes_of_points_in_periodic_boxes) {
  const Periodic_box_2 sheared({{10, 0}, {0, 0}}, {{3, 9}, {5, 0}});
  std::mt19937 random(3);
  const auto number = [&random](int most) {
    return std::uniform_int_distribution<int>(-8 * most, 8 * most)(random) / 8.0;
  };
  // Between the events of the run, changes of one or of many points.
  int changes = 0;
  const auto change = [&](Kinetic_triangulation_2<Periodic_kinetic_traits_2>& kinetic,
                          double until) {
    const double next = until * (changes + 1) / 61;
    if (changes == 60) return step_only(kinetic, until);
    if (step_only(kinetic, next)) return true;
    ++changes;
    kinetic.advance_to(Algebraic_number(next));
    std::vector<Point_id> ids;
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (kinetic.contains(id)) ids.push_back(id);
    }
    std::ranges::shuffle(ids, random);
    const auto motion = [&] {
      return Linear_motion_2{{number(20), number(20)}, {number(2), number(2)}};
    };
    if (changes % 4 == 0) {
      ids.resize(ids.size() / 2);
      std::vector<Linear_motion_2> all;
      for (std::size_t i = 0; i < ids.size(); ++i) all.push_back(motion());
      kinetic.set_motions(ids, all);
    } else if (changes % 4 == 1) {
      kinetic.insert(motion());
    } else if (changes % 4 == 2 && ids.size() > 1) {
      kinetic.erase(ids.front());
    } else {
      kinetic.set_motion(ids.front(), motion());
    }
    return true;
  };
  const auto motions = test::random_motions(8, 10, 3, 4);
  EXPECT_GT(expect_plays_in_box(motions, sheared, 4, 100'000, change), 300u);
}

TEST(Recording, is_thinned_in_periodic_boxes) {
  const Periodic_box_2 sheared({{10, 0}, {0, 0}}, {{0, 10}, {-5, 0}});
  const auto motions = test::random_motions(30, 10, 5, 8);
  EXPECT_LE(expect_plays_in_box(motions, sheared, 8, 300), 300u);
}

}  // namespace
}  // namespace kinetri::recording_test
