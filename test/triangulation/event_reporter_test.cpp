// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/event_reporter.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/kinetic_parts.h"
#include "support/precondition_error.h"

namespace kinetri::event_reporter_test {
namespace {

using test::resting;

/// What observers are called with, in words.
struct Log : Event_observer {
  void before_event(const Event& event) override {
    lines.push_back("before " + std::to_string(event.number) + " " + text(event));
    if (throws_before) throw std::runtime_error("observer");
  }
  void after_event(const Event& event) override { lines.push_back("after " + text(event)); }
  void after_rebuild(const Algebraic_number&, std::span<const Edge_ids> edges) override {
    std::string line = "touched";
    for (const auto& [a, b] : edges) line += " " + std::to_string(a) + "-" + std::to_string(b);
    lines.push_back(line);
  }
  void after_hiding(const Algebraic_number&, std::span<const Point_id> points) override {
    std::string line = "hidden";
    for (const Point_id id : points) line += " " + std::to_string(id);
    lines.push_back(line);
  }
  static std::string text(const Event& event) {
    std::ostringstream out;
    out << name(event.kind);
    if (event.point_a) out << ' ' << *event.point_a;
    if (event.removed) out << " -" << (*event.removed)[0] << '-' << (*event.removed)[1];
    if (event.added) out << " +" << (*event.added)[0] << '-' << (*event.added)[1];
    return out.str();
  }

  std::vector<std::string> lines;
  bool throws_before = false;
};
using Lines = std::vector<std::string>;

Event flip(const Edge_ids& removed, const Edge_ids& added) {
  return detail::flip_event(Event_kind::flip, {removed, added});
}

struct Event_reporter : testing::Test {
  test::Reporter_part<> part{{resting(0, 0), resting(9, 0), resting(0, 9), resting(2, 2)}, 5.0};
  detail::Event_reporter<Linear_kinetic_traits_2>& reporter = part.reporter;
  Log log;
};

TEST_F(Event_reporter, reports_an_event_around_what_makes_it_happen) {
  reporter.observers().add(log);
  for (int k = 0; k < 2; ++k) {
    reporter.report(flip({0, 2}, {1, 3}), [&] {
      EXPECT_TRUE(reporter.is_in_event());
      log.lines.push_back("change");
    });
  }
  EXPECT_EQ(log.lines, (Lines{"before 0 flip -0-2 +1-3", "change", "after flip -0-2 +1-3",
                              "before 1 flip -0-2 +1-3", "change", "after flip -0-2 +1-3"}));
  EXPECT_FALSE(reporter.is_in_event());
  EXPECT_EQ(part.counters.number_of_events(), 2u);
  EXPECT_EQ(reporter.events_in_instant(), 2u);
  reporter.begin_instant();
  EXPECT_EQ(reporter.events_in_instant(), 0u);
}

TEST_F(Event_reporter, tells_apexes_of_edges_to_the_infinite_vertex) {
  const Event leaves = flip({2, no_point}, {0, 1});
  EXPECT_EQ(leaves.apex, 2u);
  EXPECT_FALSE(leaves.removed);
  EXPECT_EQ(leaves.added, (Edge_ids{0, 1}));
}

TEST_F(Event_reporter, reports_noted_edges_by_what_they_are_in_the_end) {
  reporter.observers().add(log);
  reporter.start_noting();
  int changes = 0;
  reporter.report(flip({0, 2}, {1, 3}), [&] { ++changes; });
  reporter.report(flip({1, 3}, {0, 2}), [&] { ++changes; });
  reporter.note({0, 1}, -1);
  reporter.note({2, 3}, 1);
  EXPECT_EQ(log.lines, Lines()) << "nothing is reported while edges are noted";
  EXPECT_EQ(changes, 2);
  const Changed_edges changed = reporter.report_edges();
  EXPECT_EQ(log.lines,
            (Lines{"before 0 rebuild -0-1", "after rebuild -0-1", "before 1 rebuild +2-3",
                   "after rebuild +2-3", "touched 0-1 0-2 1-3 2-3"}));
  EXPECT_EQ(changed.removed, (std::vector<Edge_ids>{{0, 1}}));
  EXPECT_EQ(changed.added, (std::vector<Edge_ids>{{2, 3}}));
  EXPECT_FALSE(reporter.is_noting());
  EXPECT_TRUE(reporter.report_edges().removed.empty()) << "each only once";
}

TEST_F(Event_reporter, reports_points_whose_state_is_another_one_in_the_end) {
  reporter.observers().add(log);
  reporter.start_noting();
  reporter.report_point(Event_kind::reveal, 2, [] {});
  reporter.report_point(Event_kind::hide, 1, [] {});
  reporter.report_point(Event_kind::reveal, 1, [] {});
  reporter.report_point(Event_kind::hide, 0, [] {});
  reporter.note_hidden(7, true);  // not there
  reporter.report_edges();
  EXPECT_EQ(log.lines, (Lines{"before 0 hide 0", "after hide 0", "before 1 reveal 2",
                              "after reveal 2", "touched"}));
}

TEST_F(Event_reporter, reports_one_hidden_point_with_the_edges_that_go) {
  reporter.observers().add(log);
  reporter.report_point(Event_kind::hide, 3, [&] { reporter.note({0, 3}, -1); });
  EXPECT_EQ(log.lines, (Lines{"before 0 hide 3", "after hide 3", "before 1 rebuild -0-3",
                              "after rebuild -0-3", "touched 0-3"}));
}

TEST_F(Event_reporter, reports_what_has_happened_and_goes_on_noting) {
  reporter.observers().add(log);
  reporter.start_noting();
  reporter.note({0, 1}, 1);
  Event event;
  event.kind = Event_kind::trajectory;
  event.point_a = 3;
  reporter.report_happened({&event, 1});
  EXPECT_EQ(log.lines, (Lines{"before 0 trajectory 3", "after trajectory 3"}));
  EXPECT_EQ(reporter.report_edges().added, (std::vector<Edge_ids>{{0, 1}}));
}

TEST_F(Event_reporter, keeps_a_trail_once_it_is_asked_to) {
  EXPECT_FALSE(reporter.has_listeners());
  reporter.report(flip({0, 2}, {1, 3}), [] {});
  EXPECT_TRUE(reporter.take_trail().edges.empty());
  reporter.keep_trail();
  EXPECT_TRUE(reporter.has_listeners());
  reporter.report(flip({1, 3}, {0, 2}), [] {});
  reporter.start_noting();
  reporter.note({2, 3}, 1);
  reporter.report_edges();
  for (const Point_id id : {3u, 1u, 3u}) reporter.note_moved_hidden(id);
  reporter.report_hiding();
  const detail::Edge_trail trail = reporter.take_trail();
  ASSERT_EQ(trail.edges.size(), 2u);
  EXPECT_EQ(trail.edges[0].removed, (Edge_ids{1, 3}));
  EXPECT_EQ(trail.edges[0].added, (Edge_ids{0, 2}));
  EXPECT_EQ(trail.edges[1].removed, std::nullopt);
  EXPECT_EQ(trail.edges[1].added, (Edge_ids{2, 3}));
  EXPECT_EQ(trail.hidden, (std::vector<Point_id>{1, 3}));
  EXPECT_TRUE(reporter.take_trail().edges.empty());
}

TEST_F(Event_reporter, refuses_a_change_within_a_change) {
  const auto changing = reporter.start_change();
  EXPECT_PRECONDITION_ERROR(
      reporter.start_change(),
      "a change of the triangulation within an event, or while another change is made; make it "
      "when advance_to, step or the other change has returned");
}

TEST_F(Event_reporter, refuses_all_changes_once_an_observer_has_thrown) {
  reporter.observers().add(log);
  log.throws_before = true;
  bool has_happened = false;
  EXPECT_THROW(reporter.report(flip({0, 2}, {1, 3}), [&] { has_happened = true; }),
               std::runtime_error);
  EXPECT_FALSE(has_happened);
  EXPECT_EQ(part.counters.number_of_events(), 0u);
  EXPECT_PRECONDITION_ERROR(reporter.check_may_change(),
                            "an exception has left the triangulation within an event; "
                            "make another one, or restore a snapshot");
}

}  // namespace
}  // namespace kinetri::event_reporter_test
