// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is read from logs is what was written: the events and motions of a run, number by number.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/io/event_log.h"
#include "kinetri/io/motion_log.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri::log_readers_test {
namespace {

// The events of a run.
class Events : public Event_observer {
 public:
  void after_event(const Event& event) override { events_.push_back(event); }
  const std::vector<Event>& events() const { return events_; }

 private:
  std::vector<Event> events_;
};

std::vector<Logged_event> events_in(const std::string& text) {
  std::istringstream in(text);
  return read_event_log(in, "e");
}

std::vector<Logged_motion> motions_in(const std::string& text) {
  std::istringstream in(text);
  return read_motion_log(in, "m");
}

template <class Function>
std::string error_of(Function function) {
  try {
    function();
  } catch (const Input_error& error) {
    return error.what();
  }
  return "no error";
}

const std::string event_header =
    "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,instant\n";
const std::string motion_header = "event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch\n";

TEST(Log_readers, events_and_motions_of_a_run_are_read_back) {
  Simulation_options options;
  options.box = Box_2{0, 0, 9, 7};
  options.radius = 0.5;
  options.response = swap_velocities;
  Simulation_2<> simulation({{{1, 1}, {2, 0.3}, 0},
                             {{5, 1.25}, {-1, 0.7}, 0},
                             {{3, 5}, {0.1, -1}, 0},
                             {{8, 6}, {-3, -0.9}, 0},
                             {{4, 3}, {0, 0.4}, 0}},
                            options);
  std::ostringstream event_text;
  std::ostringstream motion_text;
  Event_log_writer event_log(event_text);
  Motion_log_writer<> motion_log(motion_text, simulation.triangulation(), options.radius);
  Events seen;
  simulation.add_observer(event_log);
  simulation.add_observer(motion_log);
  simulation.add_observer(seen);
  simulation.advance_to(Algebraic_number(6));
  const Point_id id = simulation.insert({{8.5, 0.25}, {0.1, 0.2}, 6});
  simulation.erase(1);

  const std::vector<Logged_event> events = events_in(event_text.str());
  ASSERT_EQ(events.size(), seen.events().size());
  ASSERT_GT(events.size(), 20U);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event& expected = seen.events()[i];
    EXPECT_EQ(events[i].number, expected.number);
    EXPECT_EQ(events[i].kind, expected.kind);
    EXPECT_EQ(events[i].time, expected.time.tight_interval());
    EXPECT_EQ(events[i].removed, expected.removed);
    EXPECT_EQ(events[i].added, expected.added);
    EXPECT_EQ(events[i].point_a, expected.point_a);
    EXPECT_EQ(events[i].point_b, expected.point_b);
    EXPECT_EQ(events[i].line, i + 2);
  }

  const std::vector<Logged_motion> motions = motions_in(motion_text.str());
  ASSERT_GT(motions.size(), 10U);
  for (Point_id point = 0; point < 5; ++point) {
    EXPECT_EQ(motions[point].id, point);
    EXPECT_FALSE(motions[point].event);
  }
  std::vector<std::optional<Polynomial_disc_motion_2>> present(id + 1);
  for (const Logged_motion& row : motions) present[row.id] = row.motion;
  for (Point_id point = 0; point <= id; ++point) {
    ASSERT_EQ(present[point].has_value(), simulation.triangulation().contains(point));
    if (!present[point]) continue;
    Polynomial_disc_motion_2 expected = general_motion(simulation.triangulation().motion(point));
    expected.radius = options.radius;
    EXPECT_EQ(*present[point], expected);
  }
  EXPECT_FALSE(present[1]);
}

TEST(Log_readers, columns_may_be_in_any_order_and_blank_lines_are_skipped) {
  const auto motions = motions_in(
      "id,event,epoch,x,y,vx,vy,ax,ay,jx,jy,radius,growth\r\n\n3,7,0.5,1,2,3,4,5,6,7,8,9,10\r\n");
  ASSERT_EQ(motions.size(), 1U);
  EXPECT_EQ(motions[0].id, 3U);
  EXPECT_EQ(motions[0].event, 7U);
  EXPECT_EQ(motions[0].line, 3U);
  const Polynomial_motion_2 center = {{1, 2}, {3, 4}, {5, 6}, {7, 8}, 0.5};
  EXPECT_EQ(*motions[0].motion, (Polynomial_disc_motion_2{center, 9, 10, 0}));
}

TEST(Log_readers, what_is_wrong_in_an_event_log_is_said) {
  const auto error = [](const std::string& row) {
    return error_of([&] { events_in(event_header + row); });
  };
  EXPECT_EQ(error("0,flap,1,1,1,,,,,0,,0\n"),
            "e:2: the column kind is 'flap'; expected a kind of event, such as flip");
  EXPECT_EQ(error("-1,flip,1,1,1,0,1,2,3,,,0\n"),
            "e:2: the column event is '-1'; expected a whole number from 0 to "
            "18446744073709551615");
  EXPECT_EQ(error("0,flip,1,1,1,0,,2,3,,,0\n"),
            "e:2: the column removed_b is ''; expected a whole number from 0 to 4294967294");
  EXPECT_EQ(error("0,flip,1,,1,0,1,2,3,,,0\n"),
            "e:2: the column time_lo is empty; expected a number");
  EXPECT_EQ(error("0,flip,1,1,1,0,1,2,3\n"),
            "e:2: the row has 9 fields; expected 12, one for each column of the header");
  EXPECT_EQ(error_of([] { events_in(motion_header); }),
            "e:1: unknown column 'id'; expected a header line with the columns "
            "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,"
            "instant");
}

TEST(Log_readers, what_is_wrong_in_a_motion_log_is_said) {
  const auto error = [](const std::string& row) {
    return error_of([&] { motions_in(motion_header + row); });
  };
  EXPECT_EQ(error(",4294967295,0,0,0,0,0,0,0,0,0,0,0\n"),
            "m:2: the column id is '4294967295'; expected a whole number from 0 to 4294967294");
  EXPECT_EQ(error(",1,0,0,0,0,0,0,0,0,0,0,\n"),
            "m:2: the column epoch is empty; expected a number");
  EXPECT_EQ(error_of([] { motions_in("event,id\n"); }),
            "m:1: the column x is missing; expected a header line with the columns "
            "event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch");
}

}  // namespace
}  // namespace kinetri::log_readers_test
