// SPDX-License-Identifier: GPL-3.0-or-later
//
// The counts against naive ones, of a list of all events.
#include "kinetri/simulation/event_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "support/disc_runs.h"
#include "support/motions.h"
#include "support/precondition_error.h"

namespace kinetri::event_statistics_test {
namespace {

using test::discs;
using test::Recorder;
using Statistics = Event_statistics;
using Events = std::vector<Event>;

bool concerns(const Event& event, Point_id id) {
  const auto is_end = [&](const std::optional<Edge_ids>& edge) {
    return edge && ((*edge)[0] == id || (*edge)[1] == id);
  };
  return is_end(event.removed) || is_end(event.added) || event.point_a == id || event.point_b == id;
}

Event_counts counts(const Events& events, auto condition) {
  Event_counts result = {};
  for (const auto& event : events) {
    if (condition(event)) ++result[static_cast<std::size_t>(event.kind)];
  }
  return result;
}

void expect_counts(const Statistics& statistics, const Events& events, Point_id ids) {
  EXPECT_EQ(statistics.number_of_events(), events.size());
  EXPECT_EQ(statistics.events(), counts(events, [](const auto&) { return true; }));
  bool is_first = true;
  for (const Events_in_interval& interval : statistics.intervals()) {
    const auto is_in = [&](const auto& event) {
      const auto lower = compare(event.time, to_rational(interval.from));
      return (lower == CGAL::LARGER || (is_first && lower == CGAL::EQUAL)) &&
             compare(event.time, to_rational(interval.to)) != CGAL::LARGER;
    };
    EXPECT_EQ(interval.events, counts(events, is_in)) << interval.from << " to " << interval.to;
    const auto number = static_cast<std::uint64_t>(std::ranges::count_if(events, is_in));
    EXPECT_EQ(interval.number_of_events(), number);
    EXPECT_DOUBLE_EQ(interval.rate() * (interval.to - interval.from), static_cast<double>(number));
    is_first = false;
  }
  for (Point_id id = 0; id < ids; ++id) {
    EXPECT_EQ(statistics.events_of(id),
              static_cast<std::uint64_t>(std::ranges::count_if(
                  events, [&](const auto& event) { return concerns(event, id); })))
        << "point " << id;
  }
  EXPECT_EQ(statistics.events_of(ids), 0u);
  std::uint64_t instants = 0;
  std::uint64_t largest = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (i > 0 && events[i].time == events[i - 1].time) continue;
    ++instants;
    const auto number = static_cast<std::uint64_t>(std::ranges::count_if(
        events, [&](const auto& event) { return event.time == events[i].time; }));
    largest = std::max(largest, number);
  }
  EXPECT_EQ(statistics.instants(), instants);
  EXPECT_EQ(statistics.largest_instant(), largest);
  ASSERT_EQ(statistics.mean_time_between_events().has_value(), events.size() > 1);
  if (events.size() > 1) {
    double sum = 0;
    for (std::size_t i = 1; i < events.size(); ++i) {
      sum += events[i].time.to_double() - events[i - 1].time.to_double();
    }
    const double mean = sum / static_cast<double>(events.size() - 1);
    EXPECT_NEAR(*statistics.mean_time_between_events(), mean, 1e-12 * (1 + mean));
  }
}

TEST(Event_statistics, of_grids_is_that_of_the_list_of_all_events) {
  std::uint64_t largest = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_delaunay_triangulation_2<> kinetic(test::grid_motions(12, 4, 1, seed));
    Recorder recorder;
    Statistics statistics(0.5, 3.5, 6);
    kinetic.add_observer(recorder);
    kinetic.add_observer(statistics);
    kinetic.advance_to(5.0);
    expect_counts(statistics, recorder.events, 12);
    largest = std::max(largest, statistics.largest_instant());
  }
  EXPECT_GT(largest, 3u);
}

TEST(Event_statistics, of_discs_that_come_and_go_in_a_box_is_that_of_the_list_of_all_events) {
  const std::size_t n = 36;
  const Simulation_options options = discs(test::box_of(n), 2, collide_elastically);
  Simulation_2<> simulation(test::discs_in_a_box(n, 2, 3), options);
  for (const Point_id id : {3u, 17u}) simulation.schedule_erase(1.5, id);
  simulation.schedule_motion(1.0, 5, {{12, 7}, {1, 2}, 1});
  simulation.schedule_insert(2.0, {{21, 14}, {1, 2}, 2});
  Recorder recorder;
  Statistics statistics(0, 3, 7);
  simulation.add_observer(recorder);
  simulation.add_observer(statistics);
  simulation.advance_to(3.0);
  expect_counts(statistics, recorder.events, n + 1);
  for (const Event_kind kind : {Event_kind::flip, Event_kind::wall, Event_kind::collision,
                                Event_kind::insert, Event_kind::erase, Event_kind::trajectory}) {
    EXPECT_GT(statistics.events()[static_cast<std::size_t>(kind)], 0u) << name(kind);
  }
}

// Events at the ends of intervals, and beside them by less than binary64 can tell.
TEST(Event_statistics, intervals_are_open_below_and_closed_above) {
  const Rational tiny(Integer(1), Integer(1) << 200);
  Events events;
  for (const int end : {0, 1, 2, 3}) {
    for (const int side : {-1, 0, 1}) {
      events.push_back(
          {.kind = Event_kind::wall, .time = Rational(end + side * tiny), .point_a = 2});
    }
  }
  Statistics statistics(0, 3, 3);
  for (const auto& event : events) statistics.after_event(event);
  ASSERT_EQ(statistics.intervals().size(), 3u);
  EXPECT_EQ(statistics.intervals()[0].number_of_events(), 4u);  // 0, 0+, 1-, 1
  EXPECT_EQ(statistics.intervals()[1].number_of_events(), 3u);
  EXPECT_EQ(statistics.intervals()[2].number_of_events(), 3u);
  EXPECT_EQ(statistics.intervals()[2].rate(), 3.0);
  expect_counts(statistics, events, 3);
}

TEST(Event_statistics, a_point_counts_once_in_an_event) {
  Statistics statistics;
  statistics.after_event({.kind = Event_kind::collision,
                          .time = 1.0,
                          .removed = Edge_ids{1, 2},
                          .added = Edge_ids{2, 7},
                          .point_a = 1,
                          .point_b = 7});
  for (const Point_id id : {1u, 2u, 7u}) EXPECT_EQ(statistics.events_of(id), 1u);
  for (const Point_id id : {0u, 3u, 8u, no_point}) EXPECT_EQ(statistics.events_of(id), 0u);
}

TEST(Event_statistics, without_events_is_empty) {
  const Statistics statistics(-1, 1, 2);
  expect_counts(statistics, {}, 3);
  std::ostringstream text;
  text << statistics;
  EXPECT_EQ(text.str(),
            "events 0\n"
            "from -1 to 0: events 0, rate 0\n"
            "from 0 to 1: events 0, rate 0\n");
}

TEST(Event_statistics, is_summed_up_for_people) {
  Statistics statistics(0, 4, 2);
  statistics.after_event(
      {.kind = Event_kind::flip, .time = 1.0, .removed = Edge_ids{0, 1}, .added = Edge_ids{2, 3}});
  statistics.after_event({.kind = Event_kind::wall, .time = 1.5, .point_a = 2});
  statistics.after_event({.kind = Event_kind::wall, .time = 1.5, .point_a = 3});
  statistics.after_event(
      {.kind = Event_kind::flip, .time = 2.5, .removed = Edge_ids{3, 4}, .added = Edge_ids{5, 6}});
  std::ostringstream text;
  text << statistics;
  EXPECT_EQ(text.str(),
            "events 4: flip 2, wall 2\n"
            "times of events 3, from 1 to 2.5\n"
            "most events at one time 2, at 1.5\n"
            "mean time between events 0.5\n"
            "point 3: events 3\n"
            "point 2: events 2\n"
            "point 0: events 1\n"
            "point 1: events 1\n"
            "point 4: events 1\n"
            "from 0 to 2: events 3, rate 1.5: flip 1, wall 2\n"
            "from 2 to 4: events 1, rate 0.5: flip 1\n");
}

TEST(Event_statistics, refuses_intervals_that_are_none) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_PRECONDITION_ERROR(
      Statistics(1, 1, 1),
      "the intervals of event statistics need two finite ends, the first one less");
  EXPECT_PRECONDITION_ERROR(
      Statistics(2, 1, 1),
      "the intervals of event statistics need two finite ends, the first one less");
  EXPECT_PRECONDITION_ERROR(
      Statistics(0, infinity, 1),
      "the intervals of event statistics need two finite ends, the first one less");
  EXPECT_PRECONDITION_ERROR(
      Statistics(std::numeric_limits<double>::quiet_NaN(), 1, 1),
      "the intervals of event statistics need two finite ends, the first one less");
  EXPECT_PRECONDITION_ERROR(Statistics(0, 1, 0),
                            "event statistics over no interval; take one or more");
  EXPECT_PRECONDITION_ERROR(
      Statistics(1, 1.0000000000000002, 2),
      "the intervals are too short to tell their ends apart; take fewer of them");
  const double largest = std::numeric_limits<double>::max();
  const Statistics wide(-largest, largest, 2);
  EXPECT_EQ(wide.intervals()[0].to, 0.0);
  EXPECT_EQ(wide.intervals()[1].rate(), 0.0);
}

}  // namespace
}  // namespace kinetri::event_statistics_test
