// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time that runs backwards: what has happened comes again, mirrored.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "support/kinetic_runs.h"

namespace kinetri::reverse_test {
namespace {

using Polynomial_delaunay = Kinetic_delaunay_triangulation_2<Polynomial_kinetic_traits_2>;

Event_kind mirrored(Event_kind kind) {
  if (kind == Event_kind::hull_insert) return Event_kind::hull_remove;
  if (kind == Event_kind::hull_remove) return Event_kind::hull_insert;
  return kind;
}

// The events in mirrored order and time, each undone.
std::vector<test::Kinetic_event> mirrored(std::vector<test::Kinetic_event> events) {
  std::ranges::reverse(events);
  for (test::Kinetic_event& event : events) {
    event.kind = mirrored(event.kind);
    event.time = -event.time;
    std::swap(event.removed, event.added);
  }
  return events;
}

// Forward to `until`, which is no time of an event, and back: one event at a time.
template <class Kinetic, class Motions>
void expect_way_back(const Motions& motions, double until) {
  Kinetic kinetic(motions);
  const auto initial = kinetic.finite_edge_ids();
  test::Event_recorder forward(kinetic);
  kinetic.advance_to(until);
  kinetic.remove_observer(forward);
  ASSERT_GT(forward.events.size(), 20u);

  EXPECT_EQ(kinetic.reverse(), 0u);
  EXPECT_EQ(kinetic.current_time(), Algebraic_number(-until));
  test::Event_recorder back(kinetic);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  kinetic.advance_to(0.0);
  kinetic.remove_observer(back);
  EXPECT_EQ(test::difference(mirrored(forward.events), back.events), "");
  EXPECT_EQ(kinetic.finite_edge_ids(), initial);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");

  // And forth again.
  kinetic.reverse();
  for (Point_id id = 0; id < motions.size(); ++id) EXPECT_EQ(kinetic.motion(id), motions[id]);
  test::Event_recorder again(kinetic);
  kinetic.advance_to(until);
  EXPECT_EQ(test::difference(forward.events, again.events), "");
  kinetic.remove_observer(again);
}

TEST(Reverse, gives_the_initial_triangulation_and_the_mirrored_events) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_way_back<test::Kinetic_delaunay>(test::random_motions(80, 80, 5, seed), 6);
    expect_way_back<Polynomial_delaunay>(test::random_polynomial_motions(30, 40, 4, seed), 3);
  }
}

// Of degenerate points, reversed at the time of an event too, each state is Delaunay.
template <class Kinetic, class Motions>
void expect_audited_way_back(const Motions& motions) {
  Kinetic kinetic(motions);
  test::Event_recorder recorder(kinetic);
  for (int turns = 0; turns < 12; ++turns) {
    // A step or two forward, then back from there.
    for (int i = 0; i <= turns % 3; ++i) kinetic.step();
    const Algebraic_number now = kinetic.current_time();
    const std::size_t before = recorder.events.size();
    const std::size_t undone = kinetic.reverse();
    EXPECT_EQ(recorder.events.size() - before, undone);
    EXPECT_EQ(kinetic.current_time(), -now);
    for (std::size_t i = before; i < recorder.events.size(); ++i) {
      EXPECT_EQ(recorder.events[i].time, -now);
    }
    EXPECT_EQ(test::edges_of(kinetic), recorder.edges);
    ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
    kinetic.step();
    ASSERT_EQ(test::audit_problem(kinetic, Audit_level::reference), "");
  }
}

TEST(Reverse, at_degenerate_instants_leaves_delaunay_triangulations) {
  for (unsigned seed = 0; seed < test::cases(15u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_audited_way_back<test::Kinetic_delaunay>(
        test::grid_motions(2 + seed % 7, 3 + static_cast<int>(seed % 3), 1, seed));
    expect_audited_way_back<Polynomial_delaunay>(
        test::polynomial_grid_motions(2 + seed % 5, 3, 1, 3, seed));
    if (HasFatalFailure()) return;
  }
}

TEST(Reverse, of_no_point_and_of_one_only_turns_the_clock) {
  test::Kinetic_delaunay none{std::vector<Linear_motion_2>{}};
  none.advance_to(2.0);
  EXPECT_EQ(none.reverse(), 0u);
  EXPECT_EQ(none.current_time(), Algebraic_number(-2.0));
  test::Kinetic_delaunay one({{{1, 2}, {3, 4}, 0}});
  EXPECT_EQ(one.reverse(), 0u);
  EXPECT_EQ(one.motion(0), (Linear_motion_2{{1, 2}, {-3, -4}, 0}));
}

}  // namespace
}  // namespace kinetri::reverse_test
