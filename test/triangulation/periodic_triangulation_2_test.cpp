// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangulations of points in periodic boxes, compared with brute force in integers, with the
// triangulation of copies in the plane, and with CGAL's periodic triangulation at single times.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Periodic_2_Delaunay_triangulation_2.h>
#include <CGAL/Periodic_2_Delaunay_triangulation_traits_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "kinetri/impl/triangulation/kinetic_core_impl.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/message_of.h"
#include "support/periodic_runs.h"
#include "support/precondition_error.h"
#include "support/torus_reference.h"
#include "triangulation/repair.h"
#include "triangulation/torus_topology.h"

namespace kinetri::periodic_triangulation_2_test {
namespace {

using test::audit;
using test::Face;
using test::faces_of;
using test::is_that_of_brute_force;
using test::normal_form;
using test::Periodic_log;
using test::Random;
using test::random_box;
using test::random_motions;
using test::square;
using Traits = Periodic_kinetic_traits_2;
using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;
using Time = Algebraic_number;

Kinetic kinetic_of(const Periodic_box_2& box, const std::vector<Linear_motion_2>& motions) {
  return Kinetic(motions, Time(0), Traits(box));
}

TEST(Periodic_triangulation_2, is_that_of_brute_force_after_each_event) {
  std::size_t instants = 0;
  std::size_t groups = 0;
  std::size_t skipped = 0;
  for (unsigned seed = 1; seed <= test::cases(24u); ++seed) {
    Random random(seed);
    const int range = std::array{2, 4, 9}[seed % 3];
    const Periodic_box_2 box = random_box(random, range);
    Kinetic kinetic =
        kinetic_of(box, random_motions(random, 1 + static_cast<int>(seed % 6), range));
    Periodic_log log(kinetic);
    kinetic.add_observer(log);
    ASSERT_EQ(audit(kinetic), "") << "seed " << seed;
    ASSERT_TRUE(is_that_of_brute_force(kinetic, skipped)) << "seed " << seed;
    for (int steps = 0; steps < 12; ++steps) {
      const std::size_t events = kinetic.step(Time(3));
      if (events == 0) break;
      ++instants;
      if (events > 1) ++groups;
      ASSERT_EQ(log.problem(kinetic), "") << "seed " << seed;
      ASSERT_EQ(audit(kinetic), "") << "seed " << seed << ", step " << steps;
      ASSERT_TRUE(is_that_of_brute_force(kinetic, skipped))
          << "seed " << seed << ", step " << steps;
    }
  }
  EXPECT_GT(instants, 100u);
  EXPECT_GT(groups, 20u);
  EXPECT_LE(skipped, instants / 50);
}

TEST(Periodic_triangulation_2, is_that_of_a_start_at_the_same_time) {
  std::size_t events = 0;
  for (unsigned seed = 1; seed <= test::cases(6u); ++seed) {
    Random random(seed);
    const Periodic_box_2 box = {{{40, 0}, {0, 0}, 0}, {{3, 30}, {20, 0}, 0}};
    const auto motions = random_motions(random, 40, 30);
    Kinetic kinetic = kinetic_of(box, motions);
    for (const double time : {0.25, 0.5, 1.0, 2.0}) {
      events += kinetic.advance_to(Time(time));
      const Kinetic other(motions, Time(time), Traits(box));
      ASSERT_EQ(kinetic.periodic_edges(), other.periodic_edges()) << "seed " << seed;
      ASSERT_EQ(faces_of(kinetic), faces_of(other)) << "seed " << seed;
    }
    ASSERT_EQ(audit(kinetic), "") << "seed " << seed;
  }
  EXPECT_GT(events, 1000u);
}

// ---- copies in the plane ----

// Copies in three cells on each side of the middle one: the vectors of the box are its shortest.
TEST(Periodic_triangulation_2, is_that_of_copies_in_the_plane) {
  constexpr int cells = 3;
  std::size_t events = 0;
  for (unsigned seed = 1; seed <= test::cases(3u); ++seed) {
    Random random(seed);
    const double shear = random(0, 1);
    const Periodic_box_2 box = {{{16, 0}, {1, 0}, 0}, {{0, 16}, {shear, random(0, 1) * 1.0}, 0}};
    const auto motions = random_motions(random, 6, 15);
    Kinetic kinetic = kinetic_of(box, motions);
    // Copy (x, y) of point i has the number that `images` has in its place.
    std::vector<test::Image> images;
    std::vector<Linear_motion_2> copies;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const auto wrapped = [&](int x, int y) {
        const auto& [a, b] = std::pair(box.first(), box.second());
        const auto at = [&](double p, double u, double v) { return p + x * u + y * v; };
        return Linear_motion_2{{at(motions[i].position.x, a.position.x, b.position.x),
                                at(motions[i].position.y, a.position.y, b.position.y)},
                               {at(motions[i].velocity.x, a.velocity.x, b.velocity.x),
                                at(motions[i].velocity.y, a.velocity.y, b.velocity.y)},
                               0};
      };
      const int x = -static_cast<int>(std::floor(motions[i].position.x / 16));
      const int y = -static_cast<int>(std::floor(motions[i].position.y / 16));
      for (int dx = -cells; dx <= cells; ++dx) {
        for (int dy = -cells; dy <= cells; ++dy) {
          images.emplace_back(static_cast<Point_id>(i), x + dx, y + dy);
          copies.push_back(wrapped(x + dx, y + dy));
        }
      }
    }
    Kinetic_delaunay_triangulation_2<> plane(copies);
    constexpr std::size_t middle = (2 * cells + 1) * (2 * cells + 1) / 2;
    for (int step = 0; step <= 16; ++step) {
      const Time time(step / 16.0);
      events += kinetic.advance_to(time);
      plane.advance_to(time);
      std::set<Face> faces;
      for (const auto face : plane.triangulation().finite_face_handles()) {
        const auto is_in_middle = [&](int i) {
          return face->vertex(i)->point().id() % (2 * middle + 1) == middle;
        };
        if (!is_in_middle(0) && !is_in_middle(1) && !is_in_middle(2)) continue;
        const auto image = [&](int i) { return images[face->vertex(i)->point().id()]; };
        faces.insert(normal_form({image(0), image(1), image(2)}));
      }
      ASSERT_EQ(faces_of(kinetic), std::vector<Face>(faces.begin(), faces.end()))
          << "seed " << seed << ", step " << step;
    }
  }
  EXPECT_GT(events, 60u);
}

// ---- CGAL's periodic triangulation ----

// All positions are multiples of 2^-20, exact in binary64.
TEST(Periodic_triangulation_2, is_that_of_cgal_at_many_times_in_a_square) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Periodic = CGAL::Periodic_2_Delaunay_triangulation_2<
      CGAL::Periodic_2_Delaunay_triangulation_traits_2<Kernel>>;
  Random random(1);
  const auto coordinate = [&] { return std::ldexp(random(0, (1 << 20) - 1), -20); };
  std::vector<Linear_motion_2> motions;
  for (int i = 0; i < 60; ++i) {
    const double x = coordinate();
    const double y = coordinate();
    const double vx = std::ldexp(random(-1024, 1024), -10);
    motions.push_back({{x, y}, {vx, std::ldexp(random(-1024, 1024), -10)}, 0});
  }
  Kinetic kinetic = kinetic_of(square(1), motions);
  for (unsigned k = 0; k < test::cases(10u); ++k) {
    const double time = k / 16.0;
    kinetic.advance_to(Time(time));
    std::map<Periodic::Point, test::Image> images;
    Periodic expected;
    for (Point_id id = 0; id < motions.size(); ++id) {
      const auto at = [&](double p, double v) { return p + v * time; };
      const double x = at(motions[id].position.x, motions[id].velocity.x);
      const double y = at(motions[id].position.y, motions[id].velocity.y);
      const Periodic::Point place(x - std::floor(x), y - std::floor(y));
      images[place] = {id, -static_cast<std::int64_t>(std::floor(x)),
                       -static_cast<std::int64_t>(std::floor(y))};
      expected.insert(place);
    }
    ASSERT_EQ(images.size(), motions.size());
    std::vector<Face> faces;
    for (auto it = expected.periodic_triangles_begin(Periodic::UNIQUE);
         it != expected.periodic_triangles_end(Periodic::UNIQUE); ++it) {
      const auto image = [&](std::size_t i) -> test::Image {
        const auto& [place, offset] = (*it)[i];
        const auto& [id, x, y] = images.at(place);
        return {id, x + offset.x(), y + offset.y()};
      };
      faces.push_back(normal_form({image(0), image(1), image(2)}));
    }
    std::ranges::sort(faces);
    ASSERT_EQ(faces_of(kinetic), faces) << "time " << time;
  }
  EXPECT_GT(kinetic.counters().number_of_events(), 100u);
}

// ---- reversal, snapshots ----

TEST(Periodic_triangulation_2, goes_back_and_forth) {
  std::size_t undone = 0;
  for (unsigned seed = 1; seed <= test::cases(10u); ++seed) {
    Random random(seed);
    const int range = std::array{2, 4, 30}[seed % 3];
    Periodic_box_2 box = random_box(random, range);
    while (box.collapse_after(Time(0)) && *box.collapse_after(Time(0)) <= Time(1.5)) {
      box = random_box(random, range);
    }
    Kinetic kinetic = kinetic_of(box, random_motions(random, 8, range));
    const std::vector<Face> faces = faces_of(kinetic);
    kinetic.advance_to(Time(1));
    const std::vector<Face> faces_at_1 = faces_of(kinetic);
    undone += kinetic.reverse();
    EXPECT_EQ(kinetic.traits().box(), mirrored(box));
    ASSERT_EQ(audit(kinetic), "") << "seed " << seed;
    Periodic_log log(kinetic);
    kinetic.add_observer(log);
    kinetic.advance_to(Time(0));
    ASSERT_EQ(audit(kinetic), "") << "seed " << seed;
    kinetic.reverse();
    EXPECT_EQ(log.problem(kinetic), "") << "seed " << seed;
    EXPECT_EQ(faces_of(kinetic), faces) << "seed " << seed;
    kinetic.advance_to(Time(1));
    EXPECT_EQ(faces_of(kinetic), faces_at_1) << "seed " << seed;
    kinetic.remove_observer(log);
  }
  EXPECT_GT(undone, 5u);
}

TEST(Periodic_triangulation_2, goes_on_from_a_snapshot) {
  Random random(3);
  const Periodic_box_2 box = {{{40, 0}, {0, 0}, 0}, {{3, 30}, {20, 0}, 0}};
  Kinetic kinetic = kinetic_of(box, random_motions(random, 30, 30));
  kinetic.advance_to(Time(0.5));
  Kinetic other = Kinetic::restore(kinetic.snapshot(), kinetic.traits());
  EXPECT_EQ(faces_of(other), faces_of(kinetic));
  EXPECT_EQ(other.advance_to(Time(1)), kinetic.advance_to(Time(1)));
  EXPECT_EQ(faces_of(other), faces_of(kinetic));
  EXPECT_EQ(other.counters().number_of_events(), kinetic.counters().number_of_events());
}

// ---- changes of points ----

TEST(Periodic_triangulation_2, follows_points_that_turn_jump_come_and_go) {
  for (unsigned seed = 1; seed <= test::cases(8u); ++seed) {
    Random random(seed);
    const int range = std::array{3, 9, 30}[seed % 3];
    const Periodic_box_2 box = {{{12, 1}, {1, 0}, 0}, {{-2, 11}, {2, 1}, 0}};
    Kinetic kinetic = kinetic_of(box, random_motions(random, 6, range));
    Periodic_log log(kinetic);
    kinetic.add_observer(log);
    for (int step = 0; step < 12; ++step) {
      const auto motion = [&] { return random_motions(random, 1, range).front(); };
      std::vector<Point_id> ids;
      for (Point_id id = 0; id < kinetic.next_id(); ++id) {
        if (kinetic.contains(id)) ids.push_back(id);
      }
      const auto some = [&] {
        return ids[static_cast<std::size_t>(random(0, static_cast<int>(ids.size()) - 1))];
      };
      switch (random(0, 4)) {
        case 0:
          kinetic.insert(motion());
          break;
        case 1:
          if (ids.size() > 1) kinetic.erase(some());
          break;
        case 2:
          kinetic.set_motion(some(), motion());
          break;
        case 3: {  // turns where it is
          const Point_id id = some();
          const std::vector<Point_id> one = {id};
          const std::vector<Vector_2> velocity = {{random(-3, 3) * 1.0, random(-3, 3) * 1.0}};
          kinetic.set_velocities(one, velocity);
          break;
        }
        default: {
          std::vector<Linear_motion_2> motions;
          for (std::size_t i = 0; i < ids.size(); ++i) motions.push_back(motion());
          kinetic.set_motions(ids, motions);
        }
      }
      ASSERT_EQ(audit(kinetic), "") << "seed " << seed << ", step " << step;
      ASSERT_EQ(log.problem(kinetic), "") << "seed " << seed << ", step " << step;
      kinetic.advance_to(Time(Rational(step + 1) / 4));
      ASSERT_EQ(audit(kinetic), "") << "seed " << seed << ", step " << step;
      ASSERT_EQ(log.problem(kinetic), "") << "seed " << seed << ", step " << step;
    }
    kinetic.remove_observer(log);
  }
}

// ---- steps ----

TEST(Periodic_triangulation_2, follows_points_that_are_moved_step_by_step) {
  for (unsigned seed = 1; seed <= test::cases(7u); ++seed) {
    Random random(seed);
    const int n = std::array{1, 2, 3, 5, 12, 40, 300}[seed % 7];
    const Periodic_box_2 box = {{{12, 1}, {1, 0}, 0}, {{-2, 11}, {2, 1}, 0}};
    const bool is_lattice = random(0, 1) == 0;
    const auto place = [&]() -> Vector_2 {
      if (is_lattice) return {random(-12, 12) * 1.0, random(-12, 12) * 1.0};
      return {random(-12000, 12000) / 1000.0, random(-12000, 12000) / 1000.0};
    };
    std::vector<Vector_2> places;
    std::vector<Linear_motion_2> motions;
    for (int i = 0; i < n; ++i) {
      places.push_back(place());
      motions.push_back({places.back(), {0, 0}, 0});
    }
    Kinetic kinetic = kinetic_of(box, motions);
    Periodic_log log(kinetic);
    kinetic.add_observer(log);
    for (int step = 1; step <= 8; ++step) {
      const double length = std::array{0.01, 0.1, 1.0}[static_cast<std::size_t>(step) % 3];
      for (Vector_2& p : places) {
        if (random(0, 20) == 0) p = place();  // jumps, to others too
        if (is_lattice && random(0, 2) > 0) continue;
        p = {p.x + length * random(-100, 100) / 100, p.y + length * random(-100, 100) / 100};
      }
      kinetic.set_positions(places);
      ASSERT_EQ(audit(kinetic), "") << "seed " << seed << ", step " << step;
      ASSERT_EQ(log.problem(kinetic), "") << "seed " << seed << ", step " << step;
      kinetic.advance_to(Time(step / 4.0));
      ASSERT_EQ(log.problem(kinetic), "") << "seed " << seed << ", step " << step;
    }
    ASSERT_EQ(audit(kinetic), "") << "seed " << seed;
    kinetic.remove_observer(log);
  }
}

// In steps: the triangulation of the ends, which may be in other boxes, with the events that a
// start with the velocities of the step has.
TEST(Periodic_triangulation_2, advances_through_positions) {
  Random random(5);
  const Periodic_box_2 box = {{{5, 0}, {0, 0}, 0}, {{0, 4}, {2, 0.5}, 0}};
  const auto places = [&](int n) {
    std::vector<Vector_2> result;
    for (int i = 0; i < n; ++i) {
      const double x = random(-80, 80) / 8.0;
      result.push_back({x, random(-80, 80) / 8.0});
    }
    return result;
  };
  std::vector<Linear_motion_2> motions;
  for (const Vector_2& place : places(12)) motions.push_back({place, {0, 0}, 0});
  Kinetic kinetic = kinetic_of(box, motions);
  std::size_t flips = 0;
  for (double now = 0; now < 3; now += 0.5) {
    const std::vector<Vector_2> ends = places(12);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const Vector_2 here = motions[i].position;
      motions[i] = {here, {(ends[i].x - here.x) * 2, (ends[i].y - here.y) * 2}, now};
    }
    Kinetic alone(motions, Time(now), Traits(box));
    const std::size_t expected = alone.advance_to(Time(now + 0.5));
    EXPECT_EQ(kinetic.advance_through(ends, 0.5), expected);
    flips += expected;
    for (std::size_t i = 0; i < motions.size(); ++i) motions[i] = {ends[i], {0, 0}, 0};
    const Kinetic made(motions, Time(now + 0.5), Traits(box));
    EXPECT_EQ(kinetic.current_time(), Time(now + 0.5));
    EXPECT_EQ(kinetic.periodic_edges(), made.periodic_edges());
    EXPECT_EQ(audit(kinetic), "");
  }
  EXPECT_GT(flips, 100u);

  // The box would have no area: nothing happens.
  Kinetic shrinking =
      kinetic_of({{{4, 0}, {-1, 0}, 0}, {{0, 4}, {0, 0}, 0}}, {{{1, 1}, {1, 2}, 0}});
  const std::vector<Vector_2> end = {{3, 3}};
  EXPECT_THROW(shrinking.advance_through(end, 4), Periodic_box_error);
  EXPECT_EQ(shrinking.motion(0).velocity, (Vector_2{1, 2}));
  EXPECT_EQ(shrinking.current_time(), Time(0));
  shrinking.advance_through(end, 3);
  EXPECT_EQ(shrinking.motion(0).position, end[0]);
}

TEST(Periodic_triangulation_2, is_repaired_after_small_steps_and_constructed_after_great_ones) {
  using Types = detail::Kinetic_types<Traits>;
  Random random(1);
  const auto coordinate = [&] { return random(-10000, 10000) / 1000.0; };
  std::vector<Linear_motion_2> motions;
  for (int i = 0; i < 400; ++i) {
    const double x = coordinate();
    motions.push_back({{x, coordinate()}, {0, 0}, 0});
  }
  for (const double length : {0.05, 0.1, 0.5, 20.0}) {
    detail::Kinetic_core<Traits> core(Traits(square(20)), Time(0));
    std::vector<Types::Point_2> points;
    std::vector<Types::Change> changes;
    for (Point_id id = 0; id < motions.size(); ++id) {
      points.emplace_back(motions[id], id);
      Linear_motion_2 moved = motions[id];
      moved.position.x += length * random(-100, 100) / 100;
      moved.position.y += length * random(-100, 100) / 100;
      changes.push_back({id, moved});
    }
    core.start_with(points, points.size());
    core.reporter.start_noting();
    Types::Repair repair(core.topology, core.reporter.notes(), core.schedule.current_time());
    EXPECT_EQ(repair.move(changes), length < 1) << "length " << length;
    if (length > 1) continue;
    std::vector<Linear_motion_2> after;
    for (const Types::Change& change : changes) after.push_back(*change.motion);
    EXPECT_EQ(core.topology.finite_edges(), kinetic_of(square(20), after).periodic_edges());
  }
}

TEST(Periodic_triangulation_2, is_empty_without_points) {
  Kinetic kinetic = kinetic_of(square(1), {});
  EXPECT_EQ(audit(kinetic), "");
  EXPECT_EQ(kinetic.next_event_time(), std::nullopt);
  EXPECT_TRUE(kinetic.periodic_edges().empty());
  const Point_id id = kinetic.insert({{0.5, 0.5}, {1, 0}, 0});
  EXPECT_EQ(kinetic.periodic_edges().size(), 3u);
  EXPECT_EQ(kinetic.finite_edge_ids(), std::vector<Edge_ids>(3, Edge_ids{0, 0}));
  EXPECT_EQ(audit(kinetic), "");
  kinetic.erase(id);
  EXPECT_TRUE(kinetic.periodic_edges().empty());
  EXPECT_EQ(audit(kinetic), "");
  kinetic.insert({{0.25, 7.5}, {1, 0}, 0});
  EXPECT_EQ(kinetic.advance_to(Time(100)), 0u);
  EXPECT_EQ(audit(kinetic), "");
}

// ---- points that are images of each other ----

TEST(Periodic_triangulation_2, hides_points_that_are_images_of_others) {
  const Periodic_box_2 box = {{{4, 0}, {0, 0}, 0}, {{0, 4}, {1, 0}, 0}};
  // Point 1 is point 0, moved by twice the second vector, which has a rate.
  const std::vector<Linear_motion_2> motions = {
      {{1, 1}, {0, 1}, 0}, {{1, 9}, {2, 1}, 0}, {{2, 3}, {0, 0}, 0}, {{1, 5}, {0, 1}, 0}};
  Kinetic kinetic = kinetic_of(box, motions);
  EXPECT_TRUE(kinetic.is_hidden(1));
  EXPECT_FALSE(kinetic.is_hidden(3)) << "moves away from the image";
  EXPECT_EQ(kinetic.coincident_points(0), std::vector<Point_id>{1});
  EXPECT_EQ(kinetic.periodic_edges().size(), 9u);
  EXPECT_EQ(audit(kinetic), "");
  kinetic.advance_to(Time(2));
  EXPECT_EQ(audit(kinetic), "");
  kinetic.set_motion(0, {{0, 0}, {0, 0}, 0});
  EXPECT_FALSE(kinetic.is_hidden(1));
  EXPECT_EQ(audit(kinetic), "");

  const auto refused = [&] { Kinetic(motions, Time(0), Traits(box), Coincident_points::refuse); };
  try {
    refused();
    ADD_FAILURE() << "expected an error";
  } catch (const Coincident_trajectories_error& error) {
    EXPECT_EQ(edge_ids(error.first(), error.second()), (Edge_ids{0, 1}));
  }
}

// ---- boxes that collapse ----

TEST(Periodic_triangulation_2, ends_before_its_box_loses_its_area) {
  const Periodic_box_2 box = {{{4, 0}, {-1, 0}, 0}, {{0, 4}, {0, 0}, 0}};
  Kinetic kinetic = kinetic_of(box, {{{1, 1}, {3, 1}, 0}, {{2, 3}, {-1, 2}, 0}});
  EXPECT_GT(kinetic.advance_to(Time(3)), 0u);
  EXPECT_EQ(test::message_of<Periodic_box_error>([&] { kinetic.advance_to(Time(4)); }),
            "the periodic box has no area at time 4; stop before that time, or change the rates of "
            "the lattice vectors");
  EXPECT_EQ(kinetic.current_time(), Time(3));
  for (int steps = 0; steps < 20 && kinetic.step() > 0; ++steps) {
    ASSERT_LT(kinetic.current_time(), Time(4));
  }
  EXPECT_EQ(audit(kinetic), "");
  // A point at rest in a box that shrinks in one direction only has finitely many events.
  Kinetic alone = kinetic_of(box, {{{1, 1}, {0, 0}, 0}});
  while (alone.step() > 0) ASSERT_LT(alone.current_time(), Time(4));
  EXPECT_EQ(alone.next_event_time(), std::nullopt);
  EXPECT_FALSE(alone.has_event_before(Time(5)));
  EXPECT_THROW(kinetic_of({{{4, 0}, {-1, 0}, 4}, {{0, 4}, {0, 0}, 0}}, {}).advance_to(Time(9)),
               Periodic_box_error);
  const Periodic_box_2 later = {{{-1, 0}, {1, 0}, 0}, {{0, 4}, {0, 0}, 0}};
  EXPECT_EQ(test::message_of<Periodic_box_error>([&] { kinetic_of(later, {}); }),
            "the periodic box has a negative area at time 0; the second lattice vector is to the "
            "right of the first: swap the two");
}

TEST(Periodic_triangulation_2, refuses_positions_beyond_2_to_the_31_boxes) {
  // The area of some of these boxes, and the number of boxes, are out of the range of binary64.
  for (const auto& [width, height, tilt, x] :
       std::vector<std::array<double, 4>>{{1, 1, 0, 1e10},
                                          {1e-170, 1e-170, 0, 1},
                                          {1e-300, 1e-300, 0, 1e300},
                                          {1e200, 1e200, 0, 1e300},
                                          {1e-300, 1e300, 0, 1},
                                          {10, 10, 1e300, 1}}) {
    const Periodic_box_2 box = {{{width, 0}, {0, 0}, 0}, {{tilt, height}, {0, 0}, 0}};
    EXPECT_EQ(test::message_of<Periodic_box_error>([&box, x = x] {
                kinetic_of(box, {{{0, 0}, {0, 0}, 0}, {{x, 1}, {0, 0}, 0}});
              }),
              "point 1 is 2^31 or more lattice vectors away from the periodic box, or from other "
              "points; give the position of an image that is closer")
        << width << ' ' << tilt;
  }
  Kinetic kinetic = kinetic_of(square(1), {{{0, 0}, {0, 0}, 0}, {{1e9 + 0.25, 0.25}, {0, 0}, 0}});
  EXPECT_EQ(audit(kinetic), "");
  EXPECT_THROW(kinetic.insert({{1e10, 0}, {0, 0}, 0}), Periodic_box_error);
  EXPECT_EQ(kinetic.next_id(), 2u) << "nothing has changed";
  EXPECT_EQ(kinetic.insert({{0.5, 0.5}, {0, 0}, 0}), 2u);
  EXPECT_EQ(audit(kinetic), "");
}

// Each is less than 2^31 boxes away, but not from each other.
TEST(Periodic_triangulation_2, names_points_whose_edge_has_an_offset_of_2_to_the_31) {
  const auto motions_with = [](double x) -> std::vector<Linear_motion_2> {
    return {{{0, 0}, {0, 0}, 0}, {{1.5e9 + 0.5, 0.5}, {0, 0}, 0}, {{x + 0.5, 0.25}, {0, 0}, 0}};
  };
  const auto expect_error = [](const auto& call) {
    try {
      call();
      ADD_FAILURE() << "no error";
    } catch (const Periodic_offset_error& error) {
      EXPECT_EQ(error.first(), 1u);
      EXPECT_EQ(error.second(), 2u);
      EXPECT_EQ(error.time(), Time(3));
      EXPECT_EQ(std::string(error.what()).substr(0, 32), "the image of point 2 next to poi");
    }
  };
  expect_error([&] { Kinetic(motions_with(-1.5e9), Time(3), Traits(square(1))); });
  Kinetic kinetic(motions_with(0), Time(3), Traits(square(1)));
  EXPECT_EQ(audit(kinetic), "");
  EXPECT_THROW(kinetic.set_motion(2, motions_with(-1.5e9)[2]), Periodic_box_error);
  EXPECT_THROW(kinetic.step(), Precondition_error) << "within the event";
}

// The given vectors are nearly parallel then; a start must not flip one edge after the other.
TEST(Periodic_triangulation_2, starts_at_a_late_time_of_a_sheared_box) {
  const Periodic_box_2 box = {{{1, 0}, {0, 0}, 0}, {{0, 1}, {1, 0}, 0}};
  const Kinetic kinetic({{{0.25, 0.5}, {0, 0}, 0}, {{0.5, 0.75}, {0, 0}, 0}}, Time(2147483000.0),
                        Traits(box));
  EXPECT_EQ(audit(kinetic), "");
  EXPECT_EQ(kinetic.periodic_edges().size(), 6u);
}

// As the lattice becomes flat, its short vectors have greater and greater offsets.
TEST(Periodic_triangulation_2, stays_within_an_event_after_an_offset_that_is_too_great) {
  const Periodic_box_2 box = {{{1, 0}, {0, 0}, 0}, {{std::sqrt(0.5), 1}, {0, -1}, 0}};
  Kinetic kinetic = kinetic_of(box, {{{0, 0}, {0, 0}, 0}});
  Time last;
  const std::string message = test::message_of<Error>([&] {
    try {
      while (kinetic.step() > 0) last = kinetic.current_time();
    } catch (const Periodic_offset_error& error) {
      EXPECT_EQ(error.first(), 0u);
      EXPECT_EQ(error.second(), 0u);
      EXPECT_LT(last, error.time());
      EXPECT_LT(error.time(), Time(1));
      EXPECT_EQ(error.time(), kinetic.current_time());
      throw;
    }
  });
  EXPECT_TRUE(message.starts_with("the image of point 0 next to point 0 is moved by (")) << message;
  EXPECT_PRECONDITION_ERROR(kinetic.step(),
                            "an exception has left the triangulation within an event; make another "
                            "one, or restore a snapshot");
}

}  // namespace
}  // namespace kinetri::periodic_triangulation_2_test
