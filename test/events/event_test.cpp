// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event's outside: the names in files and the order of an edge's ends.
#include "kinetri/events/event.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <vector>

namespace kinetri::event_test {
namespace {

// Outside programs read these names, and the order settles simultaneous events.
TEST(Event_kind, names_and_their_order_are_fixed) {
  const std::vector<std::string_view> expected = {
      "rebuild", "hull_insert", "hull_remove", "flip",  "hide",      "reveal",
      "wall",    "collision",   "insert",      "erase", "trajectory"};
  ASSERT_EQ(expected.size(), event_kinds);
  for (std::size_t i = 0; i < event_kinds; ++i) {
    EXPECT_EQ(name(static_cast<Event_kind>(i)), expected[i]);
  }
}

TEST(Edge_ids, have_the_smaller_id_first) {
  EXPECT_EQ(edge_ids(7, 3), (Edge_ids{3, 7}));
  EXPECT_EQ(edge_ids(3, 7), (Edge_ids{3, 7}));
  EXPECT_EQ(edge_ids(4, 4), (Edge_ids{4, 4}));
  static_assert(edge_ids(no_point, 0) == Edge_ids{0, no_point});
}

struct Recorder : Event_observer {
  void after_event(const Event& event) override { times.push_back(event.time); }
  std::vector<Algebraic_number> times;
};

TEST(Event_observer, may_override_one_call_only) {
  Recorder recorder;
  Event_observer& observer = recorder;
  const Event event{.number = 0, .kind = Event_kind::flip, .time = 5.0};
  observer.before_event(event);
  EXPECT_TRUE(recorder.times.empty());
  observer.after_event(event);
  EXPECT_EQ(recorder.times, std::vector<Algebraic_number>{5.0});
}

}  // namespace
}  // namespace kinetri::event_test
