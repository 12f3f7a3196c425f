// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regular triangulations of discs in periodic boxes, compared with brute force in integers and with
// the regular triangulation of copies in the plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/message_of.h"
#include "support/periodic_runs.h"
#include "support/torus_reference.h"

namespace kinetri::periodic_regular_triangulation_2_test {
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
using Traits = Periodic_disc_kinetic_traits_2;
using Kinetic = Kinetic_regular_triangulation_2<Traits>;
using Time = Algebraic_number;

Kinetic kinetic_of(const Periodic_box_2& box, const std::vector<Disc_motion_2>& discs) {
  return Kinetic(discs, Time(0), Traits(box));
}

/// What weights there are.
enum class Weights { radii, growing, any };

std::vector<Disc_motion_2> random_discs(Random& random, int number, int range, Weights weights) {
  std::vector<Disc_motion_2> result;
  for (const Linear_motion_2& center : random_motions(random, number, range)) {
    const double radius = random(0, range);
    const double growth = weights == Weights::radii ? 0 : random(-1, 1);
    const double weight = weights == Weights::any ? random(-2 * range, 2 * range) : 0;
    result.push_back({center, radius, growth, weight});
  }
  return result;
}

std::string text(const Periodic_box_2& box, const std::vector<Disc_motion_2>& discs) {
  std::ostringstream out;
  const auto print = [&](const Linear_motion_2& m) {
    out << "{{" << m.position.x << ", " << m.position.y << "}, {" << m.velocity.x << ", "
        << m.velocity.y << "}, " << m.epoch << "}";
  };
  out << "{";
  print(box.first());
  out << ", ";
  print(box.second());
  out << "}, {";
  for (const Disc_motion_2& d : discs) {
    out << "\n  {";
    print(d);
    out << ", " << d.radius << ", " << d.growth << ", " << d.weight << "},";
  }
  out << "}";
  return out.str();
}

std::uint64_t number_of(const Kinetic& kinetic, Event_kind kind) {
  return kinetic.counters().events[static_cast<std::size_t>(kind)];
}

/// A time before the box loses its area: just before that, hidden points may cross infinitely many
/// triangles, which are no events.
Time end_of(const Periodic_box_2& box) {
  const auto collapse = box.collapse_after(Time(0));
  return collapse ? Time(std::min(3.0, 0.875 * collapse->to_double())) : Time(3.0);
}

// ---- brute force ----

TEST(Periodic_regular_triangulation_2, is_that_of_brute_force_after_each_event) {
  std::size_t instants = 0;
  std::size_t groups = 0;
  std::uint64_t hidden = 0;
  std::uint64_t revealed = 0;
  std::size_t alone = 0;
  std::size_t skipped = 0;
  for (unsigned seed = 1; seed <= test::cases(120u); ++seed) {
    Random random(seed);
    const int range = std::array{2, 3, 5}[seed % 3];
    const Periodic_box_2 box = random_box(random, range);
    const auto weights = std::array{Weights::radii, Weights::growing, Weights::any}[seed / 3 % 3];
    const auto discs = random_discs(random, 1 + static_cast<int>(seed % 6), range, weights);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text(box, discs));
    Kinetic kinetic = kinetic_of(box, discs);
    Periodic_log log(kinetic);
    kinetic.add_observer(log);
    ASSERT_EQ(audit(kinetic), "");
    ASSERT_TRUE(is_that_of_brute_force(kinetic, skipped));
    for (int steps = 0; steps < 6; ++steps) {
      const std::size_t events = kinetic.step(end_of(box));
      if (events == 0) break;
      ++instants;
      if (events > 1) ++groups;
      if (kinetic.number_of_points() - kinetic.number_of_hidden_points() == 1) ++alone;
      ASSERT_EQ(log.problem(kinetic), "") << "step " << steps;
      ASSERT_EQ(audit(kinetic), "") << "step " << steps;
      ASSERT_TRUE(is_that_of_brute_force(kinetic, skipped)) << "step " << steps;
    }
    hidden += number_of(kinetic, Event_kind::hide);
    revealed += number_of(kinetic, Event_kind::reveal);
    kinetic.remove_observer(log);
  }
  EXPECT_GT(instants, 250u);
  EXPECT_LE(skipped, instants / 50);
  EXPECT_GT(groups, 50u);
  EXPECT_GT(hidden, 25u);
  EXPECT_GT(revealed, 25u);
  EXPECT_GT(alone, 5u);
}

TEST(Periodic_regular_triangulation_2, is_that_of_a_start_at_the_same_time) {
  std::size_t events = 0;
  std::size_t hidden = 0;
  for (unsigned seed = 1; seed <= test::cases(6u); ++seed) {
    Random random(seed);
    const Periodic_box_2 box = {{{40, 0}, {0, 0}, 0}, {{3, 30}, {20, 0}, 0}};
    auto discs = random_discs(random, 60, 30, Weights::growing);
    for (Disc_motion_2& d : discs) d.radius /= 4;
    Kinetic kinetic = kinetic_of(box, discs);
    for (const double time : {0.25, 0.5, 1.0, 2.0}) {
      events += kinetic.advance_to(Time(time));
      const Kinetic other(discs, Time(time), Traits(box));
      ASSERT_EQ(kinetic.periodic_edges(), other.periodic_edges()) << "seed " << seed;
      ASSERT_EQ(faces_of(kinetic), faces_of(other)) << "seed " << seed;
      ASSERT_EQ(Periodic_log::hidden_points(kinetic), Periodic_log::hidden_points(other));
      hidden += kinetic.number_of_hidden_points();
    }
    ASSERT_EQ(audit(kinetic), "") << "seed " << seed;
  }
  EXPECT_GT(events, 1000u);
  EXPECT_GT(hidden, 100u);
}

// ---- copies in the plane ----

// Copies in three cells on each side of the middle one: the vectors of the box are its shortest.
TEST(Periodic_regular_triangulation_2, is_that_of_copies_in_the_plane) {
  constexpr int cells = 3;
  constexpr std::size_t copies_of_each = (2 * cells + 1) * (2 * cells + 1);
  constexpr std::size_t middle = copies_of_each / 2;
  std::size_t events = 0;
  std::size_t hidden = 0;
  for (unsigned seed = 1; seed <= test::cases(3u); ++seed) {
    Random random(seed);
    const double shear = random(0, 1);
    const Periodic_box_2 box = {{{16, 0}, {1, 0}, 0}, {{0, 16}, {shear, random(0, 1) * 1.0}, 0}};
    auto discs = random_discs(random, 8, 15, Weights::growing);
    for (Disc_motion_2& d : discs) d.radius /= 2;
    Kinetic kinetic = kinetic_of(box, discs);
    // Copy (x, y) of point i has the number that `images` has in its place.
    std::vector<test::Image> images;
    std::vector<Disc_motion_2> copies;
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const int x = -static_cast<int>(std::floor(discs[i].position.x / 16));
      const int y = -static_cast<int>(std::floor(discs[i].position.y / 16));
      for (int dx = x - cells; dx <= x + cells; ++dx) {
        for (int dy = y - cells; dy <= y + cells; ++dy) {
          images.emplace_back(static_cast<Point_id>(i), dx, dy);
          Disc_motion_2& copy = copies.emplace_back(discs[i]);
          const auto move = [&](int number, const Linear_motion_2& vector) {
            copy.position.x += number * vector.position.x;
            copy.position.y += number * vector.position.y;
            copy.velocity.x += number * vector.velocity.x;
            copy.velocity.y += number * vector.velocity.y;
          };
          move(dx, box.first());
          move(dy, box.second());
        }
      }
    }
    Kinetic_regular_triangulation_2<> plane(copies);
    for (int step = 0; step <= 16; ++step) {
      const Time time(step / 16.0);
      events += kinetic.advance_to(time);
      plane.advance_to(time);
      std::set<Face> faces;
      for (const auto face : plane.triangulation().finite_face_handles()) {
        const auto is_in_middle = [&](int i) {
          return face->vertex(i)->point().id() % copies_of_each == middle;
        };
        if (!is_in_middle(0) && !is_in_middle(1) && !is_in_middle(2)) continue;
        const auto image = [&](int i) { return images[face->vertex(i)->point().id()]; };
        faces.insert(normal_form({image(0), image(1), image(2)}));
      }
      ASSERT_EQ(faces_of(kinetic), std::vector<Face>(faces.begin(), faces.end()))
          << "seed " << seed << ", step " << step;
      for (Point_id id = 0; id < discs.size(); ++id) {
        const auto copy = static_cast<Point_id>(id * copies_of_each + middle);
        ASSERT_EQ(kinetic.is_hidden(id), plane.is_hidden(copy)) << "seed " << seed << ", " << id;
        if (kinetic.is_hidden(id)) ++hidden;
      }
    }
  }
  EXPECT_GT(events, 60u);
  EXPECT_GT(hidden, 20u);
}

// ---- equal weights ----

// The Delaunay triangulation and the regular one of discs of one size have the same events.
TEST(Periodic_regular_triangulation_2, of_equal_discs_is_the_Delaunay_triangulation) {
  for (unsigned seed = 1; seed <= test::cases(12u); ++seed) {
    Random random(seed);
    const int range = std::array{2, 9}[seed % 2];
    const Periodic_box_2 box = random_box(random, range);
    const auto motions = random_motions(random, 8, range);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& m : motions) discs.push_back({m, 0.5, 0, 0});
    Kinetic kinetic = kinetic_of(box, discs);
    Kinetic_delaunay_triangulation_2<Periodic_kinetic_traits_2> delaunay(
        motions, Time(0), Periodic_kinetic_traits_2(box));
    ASSERT_EQ(faces_of(kinetic), faces_of(delaunay)) << "seed " << seed;
    for (int steps = 0; steps < 12; ++steps) {
      const std::size_t events = kinetic.step(Time(3));
      ASSERT_EQ(events, delaunay.step(Time(3))) << "seed " << seed;
      ASSERT_EQ(kinetic.current_time(), delaunay.current_time()) << "seed " << seed;
      ASSERT_EQ(faces_of(kinetic), faces_of(delaunay)) << "seed " << seed;
      if (events == 0) break;
    }
    ASSERT_EQ(audit(kinetic), "") << "seed " << seed;
  }
}

// ---- reversal, snapshots ----

TEST(Periodic_regular_triangulation_2, goes_back_and_forth) {
  std::size_t undone = 0;
  for (unsigned seed = 1; seed <= test::cases(20u); ++seed) {
    Random random(seed);
    const int range = std::array{2, 4, 30}[seed % 3];
    Periodic_box_2 box = random_box(random, range);
    while (box.collapse_after(Time(0)) && *box.collapse_after(Time(0)) <= Time(1.5)) {
      box = random_box(random, range);
    }
    const auto discs = random_discs(random, 8, range, Weights::any);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text(box, discs));
    Kinetic kinetic = kinetic_of(box, discs);
    const std::vector<Face> faces = faces_of(kinetic);
    kinetic.advance_to(Time(1));
    const std::vector<Face> faces_at_1 = faces_of(kinetic);
    Periodic_log log(kinetic);
    kinetic.add_observer(log);
    undone += kinetic.reverse();
    EXPECT_EQ(kinetic.traits().box(), mirrored(box));
    ASSERT_EQ(audit(kinetic), "");
    kinetic.advance_to(Time(0));
    ASSERT_EQ(audit(kinetic), "");
    kinetic.reverse();
    EXPECT_EQ(log.problem(kinetic), "");
    EXPECT_EQ(faces_of(kinetic), faces);
    kinetic.advance_to(Time(1));
    EXPECT_EQ(faces_of(kinetic), faces_at_1);
    kinetic.remove_observer(log);
  }
  EXPECT_GT(undone, 5u);
}

TEST(Periodic_regular_triangulation_2, goes_on_from_a_snapshot) {
  Random random(3);
  const Periodic_box_2 box = {{{40, 0}, {0, 0}, 0}, {{3, 30}, {20, 0}, 0}};
  Kinetic kinetic = kinetic_of(box, random_discs(random, 30, 30, Weights::growing));
  kinetic.advance_to(Time(0.5));
  Kinetic other = Kinetic::restore(kinetic.snapshot(), kinetic.traits());
  EXPECT_EQ(faces_of(other), faces_of(kinetic));
  EXPECT_EQ(other.advance_to(Time(1)), kinetic.advance_to(Time(1)));
  EXPECT_EQ(faces_of(other), faces_of(kinetic));
  EXPECT_EQ(other.counters().number_of_events(), kinetic.counters().number_of_events());
  EXPECT_GT(kinetic.number_of_hidden_points(), 0u);
}

// ---- changes of points ----

TEST(Periodic_regular_triangulation_2, follows_discs_that_turn_grow_jump_come_and_go) {
  std::size_t most_hidden = 0;
  for (unsigned seed = 1; seed <= test::cases(8u); ++seed) {
    Random random(seed);
    const int range = std::array{2, 3, 9}[seed % 3];
    const Periodic_box_2 box =
        seed % 2 == 0 ? square(range) : Periodic_box_2({{12, 1}, {1, 0}, 0}, {{-2, 11}, {2, 1}, 0});
    const auto weights = std::array{Weights::radii, Weights::growing, Weights::any}[seed / 3 % 3];
    Kinetic kinetic = kinetic_of(box, random_discs(random, 6, range, weights));
    Periodic_log log(kinetic);
    kinetic.add_observer(log);
    for (int step = 0; step < 12; ++step) {
      const auto motion = [&] { return random_discs(random, 1, range, weights).front(); };
      std::vector<Point_id> ids;
      for (Point_id id = 0; id < kinetic.next_id(); ++id) {
        if (kinetic.contains(id)) ids.push_back(id);
      }
      const auto some = [&] {
        return ids[static_cast<std::size_t>(random(0, static_cast<int>(ids.size()) - 1))];
      };
      const int choice = random(0, 7);
      switch (choice) {
        case 0:
          kinetic.insert(motion());
          break;
        case 1:
          kinetic.insert(std::vector{motion(), motion()});
          break;
        case 2:
          if (ids.size() > 1) kinetic.erase(some());
          break;
        case 3:
          kinetic.set_motion(some(), motion());
          break;
        case 4: {  // turns where it is, also with another growth
          const Point_id id = some();
          const double now = kinetic.current_time().to_double();
          const Vector_2 velocity = {random(-3, 3) * 1.0, random(-3, 3) * 1.0};
          Disc_motion_2 changed = with_velocity_at(kinetic.motion(id), velocity, now);
          if (weights != Weights::radii) changed.growth = random(-1, 1);
          kinetic.set_motion(id, changed);
          break;
        }
        case 5: {  // another radius alone
          const Point_id id = some();
          Disc_motion_2 changed = kinetic.motion(id);
          changed.radius = random(0, range);
          kinetic.set_motion(id, changed);
          break;
        }
        case 6: {
          const std::vector<Point_id> two = {ids.front(), ids.back()};
          if (two[0] != two[1]) kinetic.set_motions(two, std::vector{motion(), motion()});
          break;
        }
        default: {
          std::vector<Disc_motion_2> motions;
          for (std::size_t i = 0; i < ids.size(); ++i) motions.push_back(motion());
          kinetic.set_motions(ids, motions);
        }
      }
      SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step) + ", choice " +
                   std::to_string(choice));
      ASSERT_EQ(audit(kinetic), "");
      ASSERT_EQ(log.problem(kinetic), "");
      kinetic.advance_to(Time(Rational(step + 1) / 4));
      ASSERT_EQ(audit(kinetic), "");
      ASSERT_EQ(log.problem(kinetic), "");
      most_hidden = std::max(most_hidden, kinetic.number_of_hidden_points());
    }
    kinetic.remove_observer(log);
  }
  EXPECT_GT(most_hidden, 4u);
}

// More points, of which few change: one by one.
TEST(Periodic_regular_triangulation_2, changes_a_few_of_many_discs_without_a_reconstruction) {
  Random random(1);
  const auto coordinate = [&] { return random(-20000, 20000) / 1000.0; };
  const auto disc = [&]() -> Disc_motion_2 {
    const double x = coordinate();
    const double y = coordinate();
    const double vx = random(-100, 100) / 100.0;
    return {{{x, y}, {vx, random(-100, 100) / 100.0}, 0},
            random(0, 250) / 100.0,
            random(-10, 10) / 100.0,
            0};
  };
  std::vector<Disc_motion_2> discs;
  for (int i = 0; i < 150; ++i) discs.push_back(disc());
  Kinetic kinetic = kinetic_of(square(40), discs);
  Periodic_log log(kinetic);
  kinetic.add_observer(log);
  for (int step = 1; step <= 24; ++step) {
    const auto some = [&] { return static_cast<Point_id>(random(0, 149)); };
    switch (step % 4) {
      case 0:
        kinetic.insert(disc());
        break;
      case 1:
        if (const Point_id id = some(); kinetic.contains(id)) kinetic.erase(id);
        break;
      case 2:
        if (const Point_id id = some(); kinetic.contains(id)) kinetic.set_motion(id, disc());
        break;
      default:
        kinetic.insert(std::vector{disc(), disc(), disc()});
    }
    ASSERT_EQ(audit(kinetic), "") << "step " << step;
    ASSERT_EQ(log.problem(kinetic), "") << "step " << step;
    kinetic.advance_to(Time(step / 64.0));
    ASSERT_EQ(log.problem(kinetic), "") << "step " << step;
  }
  ASSERT_EQ(audit(kinetic), "");
  EXPECT_GT(kinetic.number_of_hidden_points(), 5u);
  EXPECT_EQ(kinetic.counters().reconstructions, 0u);
  kinetic.remove_observer(log);
}

// ---- steps ----

TEST(Periodic_regular_triangulation_2, follows_discs_that_are_moved_step_by_step) {
  for (unsigned seed = 1; seed <= test::cases(3u); ++seed) {
    Random random(seed);
    const int n = std::array{1, 5, 300}[seed % 3];
    const bool are_equal = random(0, 1) == 0;
    const auto place = [&]() -> Vector_2 {
      return {random(-12000, 12000) / 1000.0, random(-12000, 12000) / 1000.0};
    };
    std::vector<Vector_2> places;
    std::vector<Disc_motion_2> discs;
    for (int i = 0; i < n; ++i) {
      places.push_back(place());
      discs.push_back({{places.back(), {0, 0}, 0}, are_equal ? 1 : random(0, 200) / 100.0, 0, 0});
    }
    Kinetic kinetic = kinetic_of({{{12, 1}, {1, 0}, 0}, {{-2, 11}, {2, 1}, 0}}, discs);
    Periodic_log log(kinetic);
    kinetic.add_observer(log);
    for (int step = 1; step <= 6; ++step) {
      const double length = std::array{0.01, 0.1, 1.0}[static_cast<std::size_t>(step) % 3];
      for (Vector_2& p : places) {
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

// A large disc has so many triangles that a hidden point whose triangle is flipped away is far from
// the one that is looked at first.
TEST(Periodic_regular_triangulation_2, finds_hidden_points_among_the_many_triangles_of_a_disc) {
  for (unsigned seed = 1; seed <= test::cases(1u); ++seed) {
    Random random(seed);
    std::vector<Disc_motion_2> discs = {{{{0, 0}, {0, 0}, 0}, 12, 0, 0}};
    for (int i = 0; i < 400; ++i) {
      const auto coordinate = [&](double scale) { return random(-10000, 10000) * scale; };
      const double x = coordinate(0.002);
      const double y = coordinate(0.002);
      const double vx = coordinate(0.0002);
      const double vy = coordinate(0.0002);
      discs.push_back({{{x, y}, {vx, vy}, 0}, random(0, 300) * 0.01, 0, 0});
    }
    Kinetic kinetic = kinetic_of(square(40), discs);
    for (int step = 1; step <= 8; ++step) {
      kinetic.advance_to(Time(step / 8.0));
      ASSERT_EQ(audit(kinetic), "") << "seed " << seed << ", step " << step;
    }
  }
}

// One weight that both have becomes another while one disc jumps, when the other one would hide it.
TEST(Periodic_regular_triangulation_2, takes_another_weight_of_all_while_a_disc_jumps) {
  const Periodic_box_2 box = {{{2, 0}, {-1, 1}, 0}, {{0, 2}, {0, 0}, 0}};
  const auto disc = [](double x, double y, double radius) {
    return Disc_motion_2{{{x, y}, {0, 0}, 0}, radius, 0, 0};
  };
  Kinetic kinetic(std::vector{disc(2.01953125, 2, 1), disc(-4.22417, 3.54752, 1)}, Time(0.09375),
                  Traits(box));
  const std::vector<Point_id> ids = {0, 1};
  const std::vector<Disc_motion_2> after = {disc(-2.98438, -3, 2), disc(-4, -1, 2)};
  kinetic.set_motions(ids, after);
  EXPECT_EQ(audit(kinetic), "");
  EXPECT_EQ(faces_of(kinetic), faces_of(Kinetic(after, Time(0.09375), Traits(box))));
}

// ---- hidden points ----

// A disc is hidden by images of others, and never by its own.
TEST(Periodic_regular_triangulation_2, hides_discs_by_images_of_others) {
  const Disc_motion_2 large = {{{0, 0}, {0, 0}, 0}, 2, 0, 0};
  const Disc_motion_2 grown = {{{2, 1}, {0, 0}, 0}, 0, 1, 0};
  Kinetic kinetic = kinetic_of(square(4), {large, grown});
  // Its power to itself is 0, and to the images of the other one 2^2 + 1 - 4 = 1 and more.
  EXPECT_FALSE(kinetic.is_hidden(1));
  EXPECT_EQ(kinetic.periodic_edges().size(), 6u);
  // At (2, 2) only if it has the weight 4 - 8 = -4.
  Kinetic two = kinetic_of(square(4), {large, {{{2, 2}, {0, 0}, 0}, 0, 0, -5}});
  EXPECT_TRUE(two.is_hidden(1));
  EXPECT_EQ(two.periodic_edges().size(), 3u);
  const auto hidden = two.vertex(1);
  EXPECT_EQ(hidden->face()->vertex(0)->point().id(), 0u);
  EXPECT_EQ(audit(two), "");
  // A disc that grows hides the other one in the end, and then is alone.
  Kinetic alone =
      kinetic_of(square(4), {{{{0, 0}, {0, 0}, 0}, 1, 1, 0}, {{{1, 0}, {1, 0}, 0}, 1, 0, 0}});
  EXPECT_FALSE(alone.is_hidden(1));
  alone.advance_to(Time(5));
  EXPECT_TRUE(alone.is_hidden(1));
  EXPECT_EQ(alone.periodic_edges().size(), 3u);
  EXPECT_EQ(audit(alone), "");
  alone.erase(0);
  EXPECT_FALSE(alone.is_hidden(1));
  EXPECT_EQ(audit(alone), "");
  // One disc, of any size, is visible.
  Kinetic single = kinetic_of(square(1), {{{{0.5, 7}, {3, 1}, 0}, 9, 2, -100}});
  single.advance_to(Time(7));
  EXPECT_FALSE(single.is_hidden(0));
  EXPECT_EQ(audit(single), "");
}

TEST(Periodic_regular_triangulation_2, hides_discs_that_are_images_of_others) {
  const Periodic_box_2 box = {{{4, 0}, {0, 0}, 0}, {{0, 4}, {1, 0}, 0}};
  // Disc 1 is disc 0, moved by twice the second vector, which has a rate; disc 2 is smaller, and
  // disc 4 the same as that; disc 5 is larger. Disc 3 is elsewhere.
  const auto disc = [](double x, double y, double vx, double vy, double radius) {
    return Disc_motion_2{{{x, y}, {vx, vy}, 0}, radius, 0, 0};
  };
  const std::vector<Disc_motion_2> discs = {disc(1, 1, 0, 1, 1),   disc(1, 9, 2, 1, 1),
                                            disc(5, 1, 0, 1, 0.5), disc(2, 3, 0, 0, 1),
                                            disc(1, 5, 1, 1, 0.5), disc(9, 1, 0, 1, 1.5)};
  Kinetic kinetic = kinetic_of(box, discs);
  EXPECT_EQ(kinetic.coincident_points(0), std::vector<Point_id>{1});
  EXPECT_EQ(kinetic.coincident_points(4), std::vector<Point_id>{2});
  EXPECT_EQ(Periodic_log::hidden_points(kinetic), (std::vector<Point_id>{0, 1, 2, 4}));
  EXPECT_EQ(audit(kinetic), "");
  kinetic.advance_to(Time(2));
  EXPECT_EQ(audit(kinetic), "");
  kinetic.erase(5);
  EXPECT_EQ(Periodic_log::hidden_points(kinetic), (std::vector<Point_id>{1, 2, 4}));
  EXPECT_EQ(audit(kinetic), "");
  kinetic.set_motion(0, disc(0, 0, 0, 0, 1));
  EXPECT_EQ(Periodic_log::hidden_points(kinetic), (std::vector<Point_id>{2, 4}));
  EXPECT_EQ(audit(kinetic), "");
  kinetic.insert(discs[5]);
  EXPECT_EQ(Periodic_log::hidden_points(kinetic), (std::vector<Point_id>{1, 2, 4}));
  EXPECT_EQ(audit(kinetic), "");
  const auto refused = [&] { Kinetic(discs, Time(0), Traits(box), Coincident_points::refuse); };
  EXPECT_THROW(refused(), Coincident_trajectories_error);
}

// Faces have several corners at one vertex, and a hidden disc may be at any of them.
TEST(Periodic_regular_triangulation_2, finds_discs_that_coincide_with_hidden_ones_at_a_vertex) {
  const Periodic_box_2 box = {{{1, 0}, {0, 0}, 0}, {{0, 1}, {1, 0}, 0}};
  Random random(5);
  for (unsigned run = 0; run < test::cases(40u); ++run) {
    std::vector<Disc_motion_2> discs;
    for (int i = 0; i < 2; ++i) {
      const double x = random(0, 7) / 8.0;
      const double y = random(0, 7) / 8.0;
      const double vx = random(-2, 2) / 4.0;
      discs.push_back({{{x, y}, {vx, random(-2, 2) / 4.0}, 0}, 1, 0, 0});
    }
    // At the center of a large disc.
    const Disc_motion_2 small = {center(discs[0]), 0.25, 0, 0};
    discs.push_back(small);
    Kinetic kinetic = kinetic_of(box, discs);
    for (int k = 1; k < 6; ++k) {
      kinetic.advance_to(Time(Rational(13 * k, 10)));
      Disc_motion_2 image = small;
      const int l = random(-1, 1);
      image.position.x += random(-3, 3);
      image.position.y += l;
      image.velocity.x += l;
      const Point_id id = kinetic.insert(image);
      ASSERT_EQ(kinetic.coincident_points(id).size(), static_cast<std::size_t>(k)) << run;
    }
    kinetic.erase(0);
    ASSERT_EQ(audit(kinetic), "") << run;
  }
}

}  // namespace
}  // namespace kinetri::periodic_regular_triangulation_2_test
