// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "support/kinetic_parts.h"

namespace kinetri::schedule_test {
namespace {

using detail::Entry_kind;
using test::resting;
using Part = test::Schedule_part<>;
using Topology = Part::Topology;

/// What an entry is about: when, which kind, which edge.
using Failure = std::tuple<Algebraic_number, Entry_kind, Edge_ids>;

/// The failures of all edges, in the order of time, then of kinds, then of ids.
std::vector<Failure> expected_failures(const Part& part) {
  std::vector<Failure> result;
  for (const auto& edge : part.all_edges()) {
    const auto failure = part.failure(edge, part.schedule.current_time());
    if (failure) result.emplace_back(failure->second, failure->first, Topology::ids_of(edge.here));
  }
  std::ranges::sort(result);
  return result;
}

/// Takes the failures out of the queue, one after the other.
std::vector<Failure> take_failures(Part& part, const Algebraic_number* until = nullptr) {
  std::vector<Failure> result;
  auto& queue = part.schedule.queue();
  while (part.schedule.settle(until)) {
    const Algebraic_number time = queue.time(queue.top());
    const auto entry = queue.pop();
    result.emplace_back(time, entry.kind, Topology::ids_of(entry.edge()));
    Topology::set_event(part.topology.with_mirror(entry.edge()), no_event);
  }
  return result;
}

// On a grid many edges fail at one time.
TEST(Schedule, has_the_failures_of_all_edges_in_order) {
  std::size_t at_one_time = 0;
  for (unsigned seed = 1; seed <= test::cases(8u); ++seed) {
    SCOPED_TRACE(seed);
    Part part(seed % 2 == 0 ? test::grid_motions(24, 5, 1, seed)
                            : test::random_motions(24, 10, 1, seed));
    ASSERT_EQ(part.problem(), "");
    const std::vector<Failure> expected = expected_failures(part);
    for (std::size_t i = 1; i < expected.size(); ++i) {
      if (std::get<0>(expected[i - 1]) == std::get<0>(expected[i])) ++at_one_time;
    }
    EXPECT_EQ(take_failures(part), expected);
    EXPECT_TRUE(part.schedule.queue().empty());
  }
  EXPECT_GT(at_one_time, 50u);
}

TEST(Schedule, is_settled_up_to_a_time_and_no_further) {
  Part part(test::random_motions(24, 10, 1, 1));
  const std::vector<Failure> expected = expected_failures(part);
  const Algebraic_number middle = std::get<0>(expected[expected.size() / 2]);
  const std::vector<Failure> taken = take_failures(part, &middle);
  ASSERT_EQ(taken.size(), expected.size() / 2 + 1) << "what fails at that time is one of them";
  EXPECT_TRUE(std::ranges::equal(taken, std::span(expected).first(taken.size())));
  EXPECT_EQ(part.schedule.current_time(), Algebraic_number(0.0)) << "nothing has happened";
}

TEST(Schedule, looks_for_a_failure_before_a_time_and_changes_nothing) {
  const Part part(test::random_motions(24, 10, 1, 2));
  const Algebraic_number first = std::get<0>(expected_failures(part).front());
  const auto rechecks = part.counters.rechecks;
  const auto size = part.schedule.queue().size();
  EXPECT_FALSE(part.schedule.has_failure_before(first));
  EXPECT_TRUE(part.schedule.has_failure_before(Rational(first.upper() + Rational(1, 1000))));
  EXPECT_EQ(part.counters.rechecks, rechecks);
  EXPECT_EQ(part.schedule.queue().size(), size);
}

TEST(Schedule, without_an_edge_has_no_entry_of_it_until_it_is_scheduled_again) {
  Part part({resting(0, 0), resting(2, 0), resting(2, 2), {{0, 3}, {0, -1}}});
  const auto edge = part.edge(0, 2);
  ASSERT_EQ(expected_failures(part).front(),
            Failure(Algebraic_number(1.0), Entry_kind::flip, Edge_ids{0, 2}));
  ASSERT_TRUE(part.schedule.settle(nullptr));
  const std::size_t size = part.schedule.queue().size();
  part.schedule.unschedule(edge);
  Topology::set_event(edge, no_event);
  EXPECT_EQ(part.schedule.queue().size(), size - 1);
  EXPECT_EQ(part.counters.discarded[static_cast<std::size_t>(Event_kind::flip)], 1u);
  part.schedule.unschedule(edge);
  EXPECT_EQ(part.schedule.queue().size(), size - 1) << "it has no entry any more";
  part.schedule.schedule({&edge, 1}, 0.0);
  EXPECT_EQ(part.problem(), "");
  EXPECT_EQ(take_failures(part).front(),
            Failure(Algebraic_number(1.0), Entry_kind::flip, Edge_ids{0, 2}));
}

TEST(Schedule, around_a_vertex_leaves_other_edges_alone) {
  Part part(test::random_motions(24, 10, 1, 3));
  const std::vector<Failure> expected = expected_failures(part);
  const auto v = part.topology.vertex(5);
  part.schedule.unschedule_around(v);
  const std::string problem = part.problem();
  EXPECT_NE(problem.find("fails and has no entry"), std::string::npos) << problem;
  part.schedule.schedule_around(v, Certificate_state::any);
  EXPECT_EQ(part.problem(), "");
  // The same with the list of the edges, each once.
  std::vector<Part::Edge_with_mirror> edges;
  Triangulation_counters counters;
  part.schedule.unschedule_around(v, edges, counters);
  part.schedule.unschedule_around(v, edges, counters);
  EXPECT_EQ(edges.size(), 2 * part.topology.triangulation().degree(v));
  part.schedule.schedule(edges, 0.0);
  EXPECT_EQ(part.problem(), "");
  EXPECT_EQ(take_failures(part), expected);
}

// The time of a failure is made when somebody asks for it; until then its bounds are known.
TEST(Present_time, may_be_that_of_a_failure_and_is_exact) {
  Part part(test::random_motions(24, 10, 1, 4));
  const auto [time, kind, ids] = expected_failures(part).front();
  ASSERT_TRUE(part.schedule.settle(nullptr));
  part.schedule.set_current_time(part.schedule.queue().top());
  const Double_interval bounds = part.schedule.current_bounds();
  EXPECT_LE(Algebraic_number(bounds.lower), time);
  EXPECT_GE(Algebraic_number(bounds.upper), time);
  EXPECT_TRUE(part.schedule.settle_now()) << "the failure itself is due";
  EXPECT_EQ(part.schedule.current_time(), time);
  part.schedule.queue().pop();
  EXPECT_FALSE(part.schedule.settle_now());
  part.schedule.set_current_time(Algebraic_number(7.0));
  EXPECT_EQ(part.schedule.current_time(), Algebraic_number(7.0));
}

TEST(Schedule, after_a_flip_is_that_of_the_new_edges) {
  Part part(test::random_motions(24, 10, 1, 5));
  auto& queue = part.schedule.queue();
  while (part.schedule.settle(nullptr) && queue.top().kind != Entry_kind::flip) queue.pop();
  part.schedule.set_current_time(queue.top());
  const auto edge = part.topology.with_mirror(queue.pop().edge());
  auto outer = part.topology.outer_edges(edge);
  for (const auto& side : outer) part.schedule.unschedule(side);
  part.schedule.schedule_after_flip(part.topology.flip(edge, outer), outer);
  EXPECT_EQ(part.problem(), "");
}

TEST(Schedule, of_collinear_points_and_of_none_is_empty_where_nothing_fails) {
  EXPECT_TRUE(Part({}).schedule.queue().empty());
  Part line({resting(0, 0), resting(1, 0), {{5, 0}, {-2, 0}}});
  EXPECT_EQ(take_failures(line),
            (std::vector{Failure(Algebraic_number(2.0), Entry_kind::coincidence, Edge_ids{1, 2})}));
}

}  // namespace
}  // namespace kinetri::schedule_test
