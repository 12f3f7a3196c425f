// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/contact_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "support/brute_force_simulator.h"
#include "support/simulation_parts.h"

namespace kinetri::contact_schedule_test {
namespace {

using detail::Contact_kind;
using Part = test::Contact_schedule_part<>;

/// When, what, and of whom.
using Row = std::tuple<Algebraic_number, Contact_kind, Edge_ids>;

Simulation_options boxed(double radius = 0) {
  Simulation_options options;
  options.box = Box_2{0, 0, 10, 10};
  options.radius = radius;
  if (radius > 0) options.response = log_contact;
  return options;
}

/// Takes all events from the queue, one after the other.
template <class Any_part>
std::vector<Row> take_all(Any_part& part) {
  std::vector<Row> rows;
  for (part.schedule.settle(); !part.schedule.queue().empty(); part.schedule.settle()) {
    const Algebraic_number time = part.schedule.queue().time(part.schedule.queue().top());
    const auto entry = part.schedule.pop();
    if (!is_change(entry.kind)) {
      EXPECT_EQ(part.records.event(entry.subject()), no_event) << "its handle is gone";
    }
    rows.emplace_back(time, entry.kind, Edge_ids{entry.point_a, entry.point_b});
  }
  return rows;
}

TEST(Contact_schedule, has_the_first_wall_of_each_point_at_its_exact_time) {
  const auto motions = test::random_motions(40, 10, 3, 1);
  Part part(motions, boxed());
  part.schedule.schedule_all_singles();
  std::vector<Row> expected;
  for (Point_id id = 0; id < motions.size(); ++id) {
    const auto& [place, v, epoch] = motions[id];
    const auto time = [](double from, double speed) {
      return Rational(((speed > 0 ? Rational(10) : Rational(0)) - to_rational(from)) /
                      to_rational(speed));
    };
    const Rational x = time(place.x, v.x);
    const Rational y = time(place.y, v.y);
    const Point_id wall = x < y ? (v.x < 0 ? 0 : 1) : (v.y < 0 ? 2 : 3);
    expected.emplace_back(std::min(x, y), Contact_kind::wall, Edge_ids{id, wall});
  }
  std::ranges::sort(expected);
  EXPECT_EQ(take_all(part), expected);
}

TEST(Contact_schedule, has_the_contacts_of_pairs_at_their_exact_times) {
  const double radius = 0.375;
  const auto motions = test::random_motions(24, 10, 3, 2);
  Simulation_options options = boxed(radius);
  options.box.reset();
  Part part(motions, options);
  std::vector<Row> expected;
  for (Point_id a = 0; a < 24; ++a) {
    for (Point_id b = a + 1; b < 24; ++b) {
      const auto excess = [&](const Rational& t) {
        return Rational(
            CGAL::squared_distance(test::place_at(motions[a], t), test::place_at(motions[b], t)) -
            4 * to_rational(radius) * to_rational(radius));
      };
      if (excess(Rational(0)) <= 0) continue;  // they overlap already
      EXPECT_FALSE(part.schedule.schedule_new_pair({a, b}, false, 0.0));
      for (const Real_root& root : real_roots(test::interpolate(2, excess))) {
        if (root.value <= Algebraic_number(0.0)) continue;
        expected.emplace_back(root.value, Contact_kind::collision, Edge_ids{a, b});
        break;  // the second one is where they separate
      }
    }
  }
  ASSERT_GT(expected.size(), 10u);
  std::ranges::sort(expected);
  EXPECT_EQ(take_all(part), expected);
}

TEST(Contact_schedule, orders_what_is_at_one_time_by_kind_and_ids) {
  // At t = 2 points 0 and 2 are at the upper wall, 1 and 3 in contact, and disc 4 vanishes.
  using Discs = test::Contact_schedule_part<Disc_kinetic_traits_2>;
  const auto disc = [](double x, double y, double vx, double vy, double r, double growth = 0) {
    return Disc_motion_2{{{x, y}, {vx, vy}, 0}, r, growth, 0};
  };
  Simulation_options options = boxed();
  options.response = log_contact;
  Discs part({disc(1, 8, 0, 1, 0), disc(2, 2, 1, 0, 1), disc(9, 6, 0, 2, 0), disc(7, 2, -0.5, 0, 1),
              disc(5, 5, 0, 0, 2, -1)},
             options);
  const std::optional<Disc_motion_2> none;
  part.schedule.schedule_change(2.0, Contact_kind::insert, 9, disc(0, 0, 0, 0, 1));
  part.schedule.schedule_change(2.0, Contact_kind::trajectory, 1, disc(2, 2, 0, 0, 1));
  part.schedule.schedule_change(2.0, Contact_kind::erase, 3, none);
  part.schedule.schedule_new_pair({1, 3}, true, 0.0);
  part.schedule.schedule_all_singles();
  std::vector<std::pair<Contact_kind, Point_id>> kinds;
  for (const auto& [time, kind, ids] : take_all(part)) {
    if (time == Algebraic_number(2.0)) kinds.emplace_back(kind, ids[0]);
  }
  EXPECT_EQ(kinds, (std::vector<std::pair<Contact_kind, Point_id>>{{Contact_kind::wall, 0},
                                                                   {Contact_kind::wall, 2},
                                                                   {Contact_kind::collision, 1},
                                                                   {Contact_kind::erase, 3},
                                                                   {Contact_kind::trajectory, 1},
                                                                   {Contact_kind::insert, 9},
                                                                   {Contact_kind::vanish, 4}}));
}

/// Two discs that come into contact at t = 2, and a third one that rests.
struct Pair : testing::Test {
  Part part{{{{1, 5}, {1, 0}, 0}, {{7, 5}, {-1, 0}, 0}, {{5, 1}, {0, 0}, 0}}, boxed(1)};
};

TEST_F(Pair, that_is_unscheduled_leaves_nothing_at_either_point) {
  part.schedule.schedule_pair({0, 1}, true, 0.0);
  part.schedule.schedule_pair({0, 1}, true, 0.0);
  EXPECT_EQ(part.schedule.queue().size(), 1u) << "the second one takes the place of the first";
  EXPECT_EQ(part.counters.discarded_collisions, 1u);
  part.schedule.unschedule_pairs(1);
  EXPECT_TRUE(part.schedule.queue().empty());
  EXPECT_EQ(part.records.pair_event({0, 1}), no_event);
  EXPECT_EQ(part.records.pair_event({1, 0}), no_event);
  EXPECT_EQ(part.counters.discarded_collisions, 2u);
  part.schedule.unschedule_pair({0, 1});
  EXPECT_EQ(part.counters.discarded_collisions, 2u);
}

TEST_F(Pair, that_passes_has_no_contact_until_it_has_separated) {
  part.records.start_overlap(0, 1, true);
  part.records.mark_passing(0, 1, true);
  part.schedule.schedule_pair({0, 1}, true, 3.0);
  EXPECT_TRUE(take_all(part).empty()) << "two lines meet once";
  part.records.mark_passing(0, 1, false);
  part.schedule.schedule_pair({0, 1}, true, 2.0);
  EXPECT_EQ(take_all(part).size(), 1u);
}

TEST_F(Pair, is_not_scheduled_without_a_response) {
  part.setup.set_response(nullptr);
  part.schedule.schedule_pair({0, 1}, true, 0.0);
  EXPECT_TRUE(part.schedule.queue().empty());
}

TEST_F(Pair, is_due_at_its_time_and_not_before) {
  part.schedule.schedule_pair({0, 1}, true, 0.0);
  EXPECT_FALSE(part.schedule.is_contact_due());
  part.triangulation.advance_to(2.0);
  EXPECT_TRUE(part.schedule.is_contact_due());
  auto contact = part.schedule.pop();
  EXPECT_FALSE(part.schedule.is_contact_due());
  // Put back behind others of the same time that are not noted.
  contact.is_noted = true;
  part.schedule.put_contact(contact);
  auto other = contact;
  other.point_b = 2;
  other.is_noted = false;
  part.schedule.put_contact(other);
  EXPECT_EQ(part.schedule.pop().point_b, 2u);
  EXPECT_EQ(part.schedule.pop().point_b, 1u);
}

TEST(Wall, of_a_point_is_discarded_with_its_motion) {
  Part part({{{1, 5}, {1, 0}, 0}, {{5, 5}, {0, 0}, 0}}, boxed());
  part.schedule.schedule_single(0, 0.0);
  EXPECT_EQ(part.schedule.queue().size(), 1u);
  part.schedule.unschedule_single(0);
  part.schedule.unschedule_single(0);
  EXPECT_TRUE(part.schedule.queue().empty());
  EXPECT_EQ(part.counters.discarded_walls, 1u);
}

TEST(Change, keeps_its_motion_until_it_is_taken) {
  Part part({{{1, 5}, {1, 0}, 0}, {{5, 5}, {0, 0}, 0}}, boxed());
  const Linear_motion_2 motion = {{2, 2}, {1, 1}, 0};
  part.schedule.schedule_change(3.0, Contact_kind::trajectory, 1, motion);
  part.schedule.schedule_change(1.0, Contact_kind::trajectory, 7, motion);
  EXPECT_EQ(part.schedule.number_of_changes(), 2u);
  EXPECT_EQ(part.schedule.changes_in_queue(), 2u);
  part.schedule.settle();
  EXPECT_EQ(part.schedule.changes_in_queue(), 1u) << "point 7 is not there";
  EXPECT_EQ(part.schedule.motion_of(part.schedule.queue().top()), motion);
  const auto entry = part.schedule.pop();
  EXPECT_EQ(part.schedule.changes_in_queue(), 0u);
  const auto due = part.schedule.take_change(entry);
  EXPECT_EQ(due.motion, motion);
  EXPECT_EQ(part.schedule.take_change(entry).motion, std::nullopt) << "taken once";
  part.schedule.put_back(due);
  EXPECT_EQ(part.schedule.changes_in_queue(), 1u);
  EXPECT_EQ(part.schedule.queue().time(part.schedule.queue().top()), Algebraic_number(0.0));
  EXPECT_EQ(part.schedule.take_change(part.schedule.pop()).motion, motion);
}

}  // namespace
}  // namespace kinetri::contact_schedule_test
