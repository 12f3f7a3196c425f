// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/kinetic_runs.h"
#include "support/multiplier.h"
#include "support/position_runs.h"
#include "support/precondition_error.h"
#include "support/random_choices.h"

namespace kinetri::set_positions_test {
namespace {

using test::Kinetic_delaunay;
using Places = std::vector<Vector_2>;

std::vector<Linear_motion_2> resting(const Places& places) {
  std::vector<Linear_motion_2> result;
  for (const Vector_2& place : places) result.push_back({place, {}, 0});
  return result;
}

// Makes the steps, and compares the result of each with a new triangulation, and with what events
// tell.
class Steps {
 public:
  explicit Steps(const Places& places) : kinetic_(resting(places)) {}

  std::string move(const Places& places) {
    test::Hidden_follower<Kinetic_delaunay> follower(kinetic_);
    kinetic_.set_positions(places);
    kinetic_.remove_observer(follower);
    std::string problem = test::difference_from_new(kinetic_);
    if (problem.empty()) problem = test::audit_problem(kinetic_, Audit_level::certificates);
    if (problem.empty()) problem = follower.problem;
    if (problem.empty() && follower.edges != test::edges_of(kinetic_)) problem = "edges of events";
    return problem;
  }
  Kinetic_delaunay& kinetic() { return kinetic_; }

 private:
  Kinetic_delaunay kinetic_;
};

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}

  double whole(int size) {
    return static_cast<double>(std::uniform_int_distribution<int>(0, size)(random_));
  }
  double between(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }
  bool one_in(unsigned n) { return random_() % n == 0; }

 private:
  std::mt19937_64 random_;
};

TEST(Set_positions, of_small_steps_is_the_triangulation_of_the_new_positions) {
  for (unsigned seed = 0; seed < test::cases(7u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::size_t n = seed % 4 == 0 ? 300 : 40;
    const double side = std::sqrt(static_cast<double>(n));
    Places places(n);
    for (Vector_2& place : places) {
      place = {random.between(0, side), random.between(0, side)};
      if (seed % 3 == 1) place = {place.x * place.x / side, place.y / 8};  // clustered, and a strip
    }
    Steps steps(places);
    for (const double length : {1e-9, 0.01, 0.03, 0.1, 0.1, 0.3, 1.0, 0.03}) {
      for (Vector_2& place : places) {
        place = {place.x + random.between(-length, length),
                 place.y + random.between(-length, length)};
      }
      ASSERT_EQ(steps.move(places), "") << "step " << length;
    }
  }
}

// Many cocircular, collinear and coinciding points.
TEST(Set_positions, on_a_grid_is_the_triangulation_of_the_new_positions) {
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int size = seed % 2 == 0 ? 40 : 8;
    Places places;
    std::set<std::pair<double, double>> taken;
    for (int i = 0; i < 60; ++i) {
      const Vector_2 place = {random.whole(size), random.whole(size)};
      if (taken.emplace(place.x, place.y).second) places.push_back(place);
    }
    Steps steps(places);
    for (int step = 0; step < 12; ++step) {
      const unsigned rarely = step % 3 == 0 ? 3 : 30;
      for (Vector_2& place : places) {
        if (!random.one_in(rarely)) continue;
        place = {place.x + random.whole(2) - 1, place.y + random.whole(2) - 1};
      }
      ASSERT_EQ(steps.move(places), "") << "step " << step;
    }
  }
}

TEST(Set_positions, may_move_points_across_the_others_and_the_hull) {
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Places places(80);
    for (Vector_2& place : places) place = {random.between(0, 9), random.between(0, 9)};
    Steps steps(places);
    for (int step = 0; step < 10; ++step) {
      for (int k = 0; k < 3; ++k) {  // far, also out of the hull, or onto another point
        Vector_2& place = places[static_cast<std::size_t>(random.whole(79))];
        place = {random.between(-3, 12), random.between(-3, 12)};
        if (random.one_in(4)) place = places[static_cast<std::size_t>(random.whole(79))];
      }
      ASSERT_EQ(steps.move(places), "") << "step " << step;
    }
  }
}

TEST(Set_positions, of_all_points_to_a_line_a_position_and_back) {
  Places places;
  for (int i = 0; i < 36; ++i) places.push_back({static_cast<double>(i % 6), std::floor(i / 6.0)});
  Places line = places;
  for (Vector_2& place : line) place.y = 0;
  Places slant;
  for (std::size_t i = 0; i < places.size(); ++i) {
    slant.push_back({static_cast<double>(i), 2 * static_cast<double>(i)});
  }
  const Places one(places.size(), {1, 1});
  Steps steps(places);
  for (const Places& next : {line, places, slant, places, one, places}) {
    ASSERT_EQ(steps.move(next), "");
  }
}

// Sequences in which steps of every kind follow each other.
template <class Kinetic>
void check_runs(unsigned runs, std::size_t most_points) {
  std::size_t hidden = 0;
  std::size_t refused = 0;
  for (unsigned seed = 0; seed < test::cases(runs); ++seed) {
    test::Random_choices random(seed);
    const bool is_grid = seed % 2 == 0;
    test::Position_run<Kinetic, test::Random_choices> run(
        random, {seed % 8 == 1 ? 4 * most_points : most_points, is_grid ? 9 : 16, is_grid});
    ASSERT_EQ(run.problem(20), "") << "seed " << seed;
    hidden += run.hidden_seen();
    refused += run.refused();
  }
  EXPECT_GT(hidden, runs);
  EXPECT_GT(refused, runs / 20);
}

TEST(Set_positions, of_every_kind_with_other_changes_between) {
  check_runs<test::Kinetic_delaunay>(100, 60);
}

TEST(Set_positions, of_every_kind_of_points_with_weights) {
  check_runs<Kinetic_regular_triangulation_2<>>(50, 40);
}

TEST(Set_positions, of_every_kind_of_points_that_accelerate) {
  check_runs<Kinetic_delaunay_triangulation_2<Polynomial_kinetic_traits_2>>(25, 40);
}

// The triangulation goes on as a new one does.
TEST(Set_positions, may_be_followed_by_motion_and_other_changes) {
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Places places(50);
    for (Vector_2& place : places) place = {random.between(0, 7), random.between(0, 7)};
    Steps steps(places);
    Kinetic_delaunay& kinetic = steps.kinetic();
    for (int step = 0; step < 4; ++step) {
      for (Vector_2& place : places) {
        place = {place.x + random.between(-0.1, 0.1), place.y + random.between(-0.1, 0.1)};
      }
      ASSERT_EQ(steps.move(places), "");
      std::vector<Point_id> ids;
      std::vector<Linear_motion_2> motions;
      for (Point_id id = 0; id < 50; ++id) {
        ids.push_back(id);
        motions.push_back({places[id],
                           {random.between(-1, 1), random.between(-1, 1)},
                           kinetic.current_time().to_double()});
      }
      kinetic.set_motions(ids, motions);
      Kinetic_delaunay made(motions, kinetic.current_time());
      const auto next = made.next_event_time();
      ASSERT_TRUE(next.has_value());
      EXPECT_FALSE(kinetic.has_event_before(*next));
      EXPECT_TRUE(kinetic.has_event_before(Algebraic_number(next->tight_interval().upper + 1e-9)));
      test::Event_recorder expected(made);
      test::Event_recorder events(kinetic);
      const Algebraic_number end(kinetic.current_time().to_double() + 0.5);
      made.advance_to(end);
      kinetic.advance_to(end);
      kinetic.remove_observer(events);
      ASSERT_EQ(kinetic.finite_edge_ids(), made.finite_edge_ids());
      ASSERT_EQ(events.events.size(), expected.events.size());
      ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
      for (Point_id id = 0; id < 50; ++id) places[id] = rounded_place(motions[id], end.to_double());
    }
    kinetic.set_positions(places);
    kinetic.erase(7);
    EXPECT_EQ(kinetic.insert({{3, 3.5}, {1, 0}, 0}), 50u);
    EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  }
}

// How far apart adjacent faces are in memory on average: 0 side by side, 1/3 at random.
double distance_in_memory(const Kinetic_delaunay& kinetic) {
  std::map<const void*, double> number;  // in the order of the container
  double next = 0;
  for (const auto face : kinetic.triangulation().finite_face_handles()) number[&*face] = next++;
  double sum = 0;
  double pairs = 0;
  for (const auto face : kinetic.triangulation().finite_face_handles()) {
    for (int i = 0; i < 3; ++i) {
      const auto beyond = number.find(&*face->neighbor(i));
      if (beyond == number.end()) continue;
      sum += std::abs(number[&*face] - beyond->second);
      ++pairs;
    }
  }
  return sum / pairs / next;
}

TEST(Set_positions, keeps_adjacent_faces_near_each_other_in_memory) {
  constexpr std::size_t n = 1000;
  Random random(7);
  std::vector<Vector_2> polar(n);  // radius and angle
  for (Vector_2& point : polar) point = {random.between(1, 10), random.between(0, 6.28)};
  Places places(n);
  const auto turn = [&](double time) {
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = polar[i].y + time / polar[i].x;
      places[i] = {polar[i].x * std::cos(angle), polar[i].x * std::sin(angle)};
    }
  };
  turn(0);
  Kinetic_delaunay kinetic(resting(places));
  for (double time = 0; time < 200; time += 0.25) {
    turn(time);
    kinetic.set_positions(places);
  }
  EXPECT_LT(distance_in_memory(kinetic), 5 * distance_in_memory(Kinetic_delaunay(resting(places))));
}

TEST(Set_positions, computes_certificates_only_when_time_goes_on) {
  Places places;
  for (int i = 0; i < 100; ++i) places.push_back({std::sin(i), std::cos(1.7 * i)});
  Kinetic_delaunay kinetic(resting(places));
  const auto before = kinetic.certificate_counters().created;
  for (Vector_2& place : places) place.x *= 1.01;
  kinetic.set_positions(places);
  EXPECT_EQ(kinetic.certificate_counters().created, before);
  EXPECT_EQ(kinetic.next_event_time(), std::nullopt);
  EXPECT_GT(kinetic.certificate_counters().created, before);
}

Places random_places(std::size_t n, Random& random) {
  Places result;
  for (std::size_t k = 0; k < n; ++k) {
    result.push_back({random.between(0, 10), random.between(0, 10)});
  }
  return result;
}

// The events are those of a triangulation of points that start with the velocities of the step.
TEST(Advance_through, executes_the_events_on_the_way_and_ends_at_the_positions) {
  std::size_t all_events = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Kinetic_delaunay kinetic(resting(random_places(60, random)));
    std::vector<Point_id> ids(60);
    std::iota(ids.begin(), ids.end(), 0);
    for (double now = 0; now < 2; now += 0.25) {
      if (now == 1) ids = {3, 7, 20, 41};
      const Places ends = random_places(ids.size(), random);
      std::vector<Linear_motion_2> motions;
      for (Point_id id = 0; id < 60; ++id) motions.push_back(kinetic.motion(id));
      for (std::size_t k = 0; k < ids.size(); ++k) {
        const Vector_2 here = motions[ids[k]].position;
        motions[ids[k]] = {here, {(ends[k].x - here.x) / 0.25, (ends[k].y - here.y) / 0.25}, now};
      }
      Kinetic_delaunay alone(motions, Algebraic_number(now));
      const std::size_t events = alone.advance_to(Algebraic_number(now + 0.25));
      EXPECT_EQ(ids.size() == 60 ? kinetic.advance_through(ends, 0.25)
                                 : kinetic.advance_through(ids, ends, 0.25),
                events);
      all_events += events;
      EXPECT_EQ(kinetic.current_time(), Algebraic_number(now + 0.25));
      for (std::size_t k = 0; k < ids.size(); ++k) {
        EXPECT_EQ(kinetic.motion(ids[k]).position, ends[k]);
        EXPECT_EQ(kinetic.motion(ids[k]).velocity, Vector_2());
      }
      EXPECT_EQ(test::difference_from_new(kinetic), "");
    }
  }
  EXPECT_GT(all_events, 1000U);
}

// Also the motions on the way: from the rounded position, by the rounded quotient.
TEST(Advance_through, tells_observers_what_happens_on_the_way_and_then_the_ends) {
  Random random(2);
  const std::size_t n = 30;
  std::vector<Linear_motion_2> motions;
  for (const Vector_2& place : random_places(n, random)) {
    motions.push_back({place, {random.between(-1, 1), random.between(-1, 1)}, 0.1});
  }
  Kinetic_delaunay kinetic(motions, Algebraic_number(0.1));
  kinetic.advance_to(Algebraic_number(0.3));
  std::vector<Linear_motion_2> on_the_way;
  const double end = 0.3 + 0.7;
  const Places ends = random_places(n, random);
  for (Point_id id = 0; id < n; ++id) {
    const Vector_2 here = rounded_position(Image_motion_2{motions[id]}, Algebraic_number(0.3));
    on_the_way.push_back(
        {here, {(ends[id].x - here.x) / (end - 0.3), (ends[id].y - here.y) / (end - 0.3)}, 0.3});
  }
  struct Recorder : Event_observer {
    explicit Recorder(Kinetic_delaunay& observed) : kinetic(observed) {
      kinetic.add_observer(*this);
    }
    void after_event(const Event& event) override {
      events.push_back(event);
      motion_of_7.push_back(kinetic.motion(7));
    }
    Kinetic_delaunay& kinetic;
    std::vector<Event> events;
    std::vector<Linear_motion_2> motion_of_7;
  };
  Kinetic_delaunay alone(on_the_way, Algebraic_number(0.3));
  Recorder expected(alone);
  alone.advance_to(Algebraic_number(end));
  Recorder recorder(kinetic);
  EXPECT_EQ(kinetic.advance_through(ends, 0.7), expected.events.size());
  const auto is_change = [](const Event& event) {
    return event.kind == Event_kind::trajectory || event.kind == Event_kind::rebuild;
  };
  std::vector<Event> flips;
  std::size_t changes = 0;
  for (std::size_t i = 0; i < recorder.events.size(); ++i) {
    const Event& event = recorder.events[i];
    if (is_change(event)) {
      if (event.kind == Event_kind::trajectory) ++changes;
      EXPECT_TRUE(event.time == Algebraic_number(0.3) || event.time == Algebraic_number(end));
      continue;
    }
    EXPECT_EQ(recorder.motion_of_7[i].velocity, on_the_way[7].velocity);
    flips.push_back(event);
  }
  EXPECT_EQ(changes, 2 * n);
  ASSERT_GT(flips.size(), 20u);
  ASSERT_EQ(flips.size(), expected.events.size());
  for (std::size_t i = 0; i < flips.size(); ++i) {
    EXPECT_EQ(flips[i].time, expected.events[i].time);
    EXPECT_EQ(flips[i].removed, expected.events[i].removed);
    EXPECT_EQ(flips[i].added, expected.events[i].added);
  }
  EXPECT_EQ(test::difference_from_new(kinetic), "");
}

TEST(Advance_through, leaves_the_points_on_the_way_if_an_observer_throws) {
  struct Thrower : Event_observer {
    void before_event(const Event& event) override {
      if (event.kind == Event_kind::hull_remove) throw std::runtime_error("stop");
    }
  };
  Kinetic_delaunay kinetic(resting({{0, 0}, {9, 0}, {0, 9}, {5, 5}}));
  Thrower thrower;
  kinetic.add_observer(thrower);
  EXPECT_THROW(kinetic.advance_through(Places{{0, 0}, {9, 0}, {0, 9}, {3, 3}}, 0.5),
               std::runtime_error);
  EXPECT_EQ(kinetic.current_time(), Algebraic_number(0.125));
  EXPECT_EQ(kinetic.motion(3).velocity, (Vector_2{-4, -4}));
  kinetic.remove_observer(thrower);
  EXPECT_THROW(kinetic.advance_to(Algebraic_number(1)), Precondition_error);
}

TEST(Advance_through, ends_on_the_way_if_points_would_stay_at_one_position) {
  Kinetic_delaunay kinetic(resting({{0, 0}, {8, 0}, {0, 8}, {4, 4}}), {}, {},
                           Coincident_points::refuse);
  EXPECT_THROW(kinetic.advance_through(Places{{0, 0}, {8, 0}, {0, 8}, {0, 8}}, 2),
               Coincident_trajectories_error);
  EXPECT_EQ(kinetic.current_time(), Algebraic_number(2));
  EXPECT_EQ(kinetic.motion(3).velocity, (Vector_2{-2, 2}));
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  EXPECT_EQ(kinetic.advance_through(Places{{0, 0}, {8, 0}, {0, 8}, {-4, 12}}, 2), 0u);
}

TEST(Advance_through, a_refused_duration_or_position_changes_nothing) {
  Random random(1);
  const Places places = random_places(40, random);
  Kinetic_delaunay kinetic(resting(places));
  const std::vector<Edge_ids> edges = kinetic.finite_edge_ids();
  for (const double duration : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(kinetic.advance_through(places, duration), Precondition_error);
  }
  EXPECT_PRECONDITION_ERROR(kinetic.advance_through(places, -1),
                            "a duration of -1.000000 from time 0.000000; expected one that ends "
                            "later, at a finite time");
  Places wrong = places;
  wrong[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_PRECONDITION_ERROR(kinetic.advance_through(wrong, 1),
                            "the position of point 3 is not finite; expected two finite numbers");
  // A velocity that overflows.
  wrong[3].y = 1e308;
  EXPECT_THROW(kinetic.advance_through(wrong, 1e-9), Precondition_error);
  EXPECT_EQ(kinetic.current_time(), Algebraic_number(0));
  EXPECT_EQ(kinetic.finite_edge_ids(), edges);
}

TEST(Set_positions, that_are_refused_change_nothing) {
  Places places;
  for (int i = 0; i < 40; ++i) places.push_back({std::sin(i), std::cos(1.7 * i)});
  Kinetic_delaunay kinetic(resting(places));
  const auto edges = kinetic.finite_edge_ids();
  Places wrong = places;
  wrong[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(kinetic.set_positions(wrong), Precondition_error);
  wrong = places;
  wrong.pop_back();
  EXPECT_PRECONDITION_ERROR(kinetic.set_positions(wrong),
                            "40 points and 39 positions; expected a position for each point");
  const std::vector<Point_id> twice = {4, 5, 4};
  EXPECT_PRECONDITION_ERROR(kinetic.set_positions(twice, Places(3)),
                            "point 4 is named twice; expected each point once");
  EXPECT_PRECONDITION_ERROR(kinetic.set_positions(twice, Places(2)),
                            "3 ids and 2 positions; expected as many of each");
  const std::vector<Point_id> unknown = {40};
  EXPECT_THROW(kinetic.set_positions(unknown, Places(1)), Precondition_error);
  EXPECT_EQ(kinetic.finite_edge_ids(), edges);
  for (Point_id id = 0; id < 40; ++id) EXPECT_EQ(kinetic.motion(id).position, places[id]);
  Kinetic_delaunay refusing(resting(places), {}, {}, Coincident_points::refuse);
  EXPECT_THROW(refusing.set_positions(Places(40)), Coincident_trajectories_error);
  EXPECT_EQ(refusing.finite_edge_ids(), edges);
}

}  // namespace
}  // namespace kinetri::set_positions_test
