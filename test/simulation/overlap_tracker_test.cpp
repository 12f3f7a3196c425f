// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/overlap_tracker.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "support/simulation_parts.h"

namespace kinetri::overlap_tracker_test {
namespace {

using detail::Contact_kind;
using Pairs = std::set<Edge_ids>;
using Part = test::Tracker_part<>;
using Discs = test::Tracker_part<Disc_kinetic_traits_2>;

Simulation_options passing(double radius) {
  Simulation_options options;
  options.radius = radius;
  options.response = log_contact;
  return options;
}

std::vector<Disc_motion_2> random_discs(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> radius(0, 1.5);
  std::vector<Disc_motion_2> discs;
  for (const auto& m : test::random_motions(n, 10, 1, seed))
    discs.push_back({m, radius(random), 0, 0});
  return discs;
}

template <class Any_part>
Pairs recorded_overlaps(const Any_part& part) {
  Pairs result;
  for (Point_id id = 0; id < part.geometry.number_of_ids(); ++id) {
    for (const auto& overlap : part.records.overlaps(id)) result.insert(edge_ids(id, overlap.disc));
  }
  return result;
}

/// The pairs that have to be watched: two at an edge; or, if radii differ, two that overlap; or two
/// of which a third disc overlaps both, at an edge to the greater one if all radii are equal.
template <class Any_part>
Pairs pairs_to_watch(const Any_part& part, const Pairs& overlaps, bool have_radii) {
  Pairs result;
  const Point_id n = part.geometry.number_of_ids();
  for (Point_id p = 0; p < n; ++p) {
    for (Point_id q = p + 1; q < n; ++q) {
      bool is_watched = part.geometry.is_edge({p, q}) || (have_radii && overlaps.contains({p, q}));
      for (Point_id w = 0; w < n; ++w) {
        is_watched = is_watched || (w != p && w != q && overlaps.contains(edge_ids(w, p)) &&
                                    overlaps.contains(edge_ids(w, q)) &&
                                    (have_radii || part.geometry.is_edge({w, q})));
      }
      if (is_watched) result.insert({p, q});
    }
  }
  return result;
}

/// Expects an entry of each of these pairs that ever comes into contact, and of no other pair.
template <class Any_part>
void expect_entries(const Any_part& part, const Pairs& pairs) {
  const Point_id n = part.geometry.number_of_ids();
  for (Point_id p = 0; p < n; ++p) {
    for (Point_id q = p + 1; q < n; ++q) {
      const Certificate known = part.schedule.pair_certificate({p, q}, part.geometry.current_time(),
                                                               part.setup.traits().exact());
      const bool is_to_have =
          pairs.contains({p, q}) && known.kind != Certificate::Kind::never_fails;
      const Queue_handle event = part.records.pair_event({p, q});
      EXPECT_EQ(event, part.records.pair_event({q, p}));
      EXPECT_EQ(event != no_event, is_to_have) << p << " and " << q;
      EXPECT_TRUE(event == no_event || part.tracker.is_watched({p, q})) << p << " and " << q;
    }
  }
}

TEST(Overlap_tracker, of_equal_discs_finds_all_overlaps_and_watches_what_they_ask_for) {
  for (unsigned seed = 1; seed <= test::cases(5u); ++seed) {
    SCOPED_TRACE(seed);
    Part part(test::random_motions(30, 10, 1, seed), passing(0.9));
    part.tracker.find_all();
    const Pairs overlaps = part.overlaps_at(Rational(0));
    EXPECT_EQ(recorded_overlaps(part), overlaps);
    part.tracker.schedule_all_pairs();
    expect_entries(part, pairs_to_watch(part, overlaps, false));
  }
}

TEST(Overlap_tracker, of_discs_finds_all_overlaps_and_watches_what_they_ask_for) {
  for (unsigned seed = 1; seed <= test::cases(5u); ++seed) {
    SCOPED_TRACE(seed);
    Discs part(random_discs(30, seed), passing(0));
    part.tracker.find_all();
    const Pairs overlaps = part.overlaps_at(Rational(0));
    EXPECT_EQ(recorded_overlaps(part), overlaps);
    part.tracker.schedule_all_pairs();
    expect_entries(part, pairs_to_watch(part, overlaps, true));
  }
}

TEST(Overlap_tracker, without_a_response_watches_nothing) {
  Simulation_options options;
  options.radius = 1;
  Part part(test::random_motions(30, 10, 1, 1), options);
  part.tracker.find_all();
  part.tracker.schedule_all_pairs();
  EXPECT_TRUE(recorded_overlaps(part).empty());
  EXPECT_TRUE(part.schedule.queue().empty());
}

/// Four points at the corners of a square with the diagonal from 0 to 2, none of which overlap.
struct Edges : testing::Test {
  Edges() {
    part.tracker.find_all();
    part.tracker.schedule_all_pairs();
  }
  void follow(const std::optional<Edge_ids>& removed, const std::optional<Edge_ids>& added) {
    detail::Edge_trail trail;
    trail.edges.push_back({removed, added});
    part.tracker.follow(trail, {});
  }
  Part part{
      {{{0, 0}, {1, 1}, 0}, {{9, 0}, {-1, 1}, 0}, {{8, 8}, {-1, -1}, 0}, {{0, 9}, {1, -1}, 0}},
      passing(1)};
};

TEST_F(Edges, that_come_are_watched_and_those_that_go_are_not) {
  ASSERT_TRUE(part.geometry.is_edge({0, 2}));
  ASSERT_NE(part.records.pair_event({0, 2}), no_event);
  ASSERT_EQ(part.records.pair_event({1, 3}), no_event);
  follow(Edge_ids{0, 2}, Edge_ids{1, 3});
  EXPECT_EQ(part.records.pair_event({0, 2}), no_event);
  EXPECT_NE(part.records.pair_event({1, 3}), no_event);
  follow(Edge_ids{1, 3}, std::nullopt);
  EXPECT_EQ(part.records.pair_event({1, 3}), no_event);
}

TEST_F(Edges, of_points_that_are_changing_are_left_to_their_change) {
  detail::Edge_trail trail;
  trail.edges.push_back({std::nullopt, Edge_ids{1, 3}});
  const std::vector<Point_id> changing = {3};
  part.tracker.follow(trail, changing);
  EXPECT_EQ(part.records.pair_event({1, 3}), no_event);
}

// Disc 1 overlaps both others, which have no edge: so their contact is watched, and no longer when
// one of the overlaps has ended.
TEST(Overlap, that_begins_and_ends_has_pairs_watched_that_long) {
  Part part({{{-1.5, 0}, {1, 0}, 0},
             {{0, 0.1}, {0, 0}, 0},
             {{1.5, 0}, {-1, 0}, 0},
             {{0, 5}, {0, 0}, 0},
             {{0, -0.2}, {0, 0}, 0}},
            passing(1));
  part.tracker.schedule_all_pairs();
  ASSERT_FALSE(part.geometry.is_edge({0, 2}));
  EXPECT_EQ(part.records.pair_event({0, 2}), no_event);
  part.tracker.start_overlap(0, 1, true);
  EXPECT_EQ(part.records.pair_event({0, 2}), no_event) << "one overlap is not enough";
  part.tracker.start_overlap(1, 2, true);
  ASSERT_NE(part.records.pair_event({0, 2}), no_event);
  EXPECT_FALSE(part.schedule.queue()[part.records.pair_event({0, 2})].is_edge);
  Pairs pairs;
  part.tracker.for_each_pair_of(
      0, [](Point_id, Point_id) { return true; },
      [&](Point_id other) {
        pairs.insert({0, other});
      });
  EXPECT_EQ(pairs, (Pairs{{0, 2}}));
  part.tracker.end_overlap(0, 1);
  EXPECT_EQ(part.records.pair_event({0, 2}), no_event);
  EXPECT_EQ(recorded_overlaps(part), (Pairs{{1, 2}}));
}

/// Two discs that are in contact at t = 2, and perhaps others.
struct Contact : testing::Test {
  void start(std::vector<Linear_motion_2> others) {
    others.insert(others.begin(), {{{0, 0}, {1, 0}, 0}, {{6, 0}, {-1, 0}, 0}});
    part.emplace(others, passing(1));
    part->tracker.find_all();
    part->tracker.schedule_all_pairs();
    part->triangulation.advance_to(2.0);
    ASSERT_TRUE(part->schedule.is_contact_due());
    contact = part->schedule.pop();
  }
  std::optional<Part> part;
  detail::Contact_entry contact;
};

TEST_F(Contact, that_is_let_pass_is_an_overlap_until_the_discs_have_separated) {
  start({{{3, 9}, {0, 0}, 0}});
  part->tracker.let_pass(0, 1, true);
  ASSERT_EQ(recorded_overlaps(*part), (Pairs{{0, 1}}));
  EXPECT_TRUE(part->records.find_overlap({0, 1})->passes);
  part->tracker.end_passes(0);
  EXPECT_EQ(recorded_overlaps(*part), (Pairs{{0, 1}})) << "they overlap from now on";
  part->triangulation.advance_to(4.5);
  part->tracker.end_passes(0);
  EXPECT_TRUE(recorded_overlaps(*part).empty());
}

TEST_F(Contact, of_a_time_by_itself_is_not_noted) {
  start({{{3, 9}, {0, 0}, 0}});
  EXPECT_FALSE(part->tracker.note_contact(contact));
  EXPECT_TRUE(part->schedule.queue().empty());
  EXPECT_TRUE(recorded_overlaps(*part).empty());
}

TEST_F(Contact, with_another_one_of_its_time_is_noted_and_goes_behind_that) {
  start({{{100, 0}, {1, 0}, 0}, {{106, 0}, {-1, 0}, 0}, {{50, 90}, {0, 0}, 0}});
  ASSERT_TRUE(part->tracker.note_contact(contact));
  EXPECT_EQ(recorded_overlaps(*part), (Pairs{{0, 1}}));
  EXPECT_EQ(part->schedule.pop().point_a, 2u);
  const auto noted = part->schedule.pop();
  EXPECT_EQ(noted.point_a, 0u);
  EXPECT_FALSE(part->tracker.note_contact(noted)) << "only once";
}

TEST(Points, with_other_motions_have_their_overlaps_and_pairs_anew) {
  for (unsigned seed = 1; seed <= test::cases(4u); ++seed) {
    SCOPED_TRACE(seed);
    Discs part(random_discs(20, seed), passing(0));
    part.tracker.find_all();
    part.tracker.schedule_all_pairs();
    const std::vector<Point_id> points = {3, 11};
    const auto others = random_discs(2, 50 + seed);
    auto& reporter = detail::Core_access::core(part.triangulation).reporter;
    reporter.keep_trail();
    for (std::size_t k = 0; k < 2; ++k) {
      part.schedule.unschedule_pairs(points[k]);
      part.triangulation.set_motion(points[k], others[k]);
    }
    part.tracker.follow(reporter.take_trail(), points);
    part.tracker.schedule_pairs(points);
    const Pairs overlaps = part.overlaps_at(Rational(0));
    EXPECT_EQ(recorded_overlaps(part), overlaps);
    expect_entries(part, pairs_to_watch(part, overlaps, true));
  }
}

}  // namespace
}  // namespace kinetri::overlap_tracker_test
