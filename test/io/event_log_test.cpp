// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event log: outside programs read these lines.
#include "kinetri/io/event_log.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace kinetri::event_log_test {
namespace {

using Log_event = Event;

constexpr const char* header =
    "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,"
    "instant\n";

std::string log_of(const std::vector<Log_event>& events) {
  std::ostringstream out;
  Event_log_writer writer(out);
  for (const Log_event& event : events) {
    writer.before_event(event);
    writer.after_event(event);
  }
  return out.str();
}

Algebraic_number square_root(int radicand) {
  return {Polynomial({Integer(-radicand), Integer(0), Integer(1)}), Rational(0),
          Rational(radicand)};
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result(1);
  for (const char c : line) {
    if (c == ',') {
      result.emplace_back();
    } else if (c != '\n') {
      result.back() += c;
    }
  }
  return result;
}

double read_back(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  EXPECT_TRUE(error == std::errc() && stop == end) << text;
  return value;
}

TEST(Event_log, has_offsets_in_a_periodic_box) {
  std::ostringstream out;
  Event_log_writer writer(out, Event_columns::periodic);
  Log_event flip = {0, Event_kind::flip, Algebraic_number(2), Edge_ids{0, 0}, Edge_ids{1, 3}};
  flip.removed_offset = {0, 1};
  flip.added_offset = {-2, 7};
  writer.after_event(flip);
  writer.after_event({1, Event_kind::rebuild, Algebraic_number(2), {}, Edge_ids{1, 2}});
  writer.after_event({2, Event_kind::insert, Algebraic_number(3), {}, {}, 4});
  Log_event collision = {3, Event_kind::collision, Algebraic_number(3), {}, {}, 4, 5};
  collision.added_offset = {0, -1};
  writer.after_event(collision);
  EXPECT_EQ(out.str(),
            "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,"
            "instant,removed_offset,added_offset\n"
            "0,flip,2,2,2,0,0,1,3,,,0,0 1,-2 7\n"
            "1,rebuild,2,2,2,,,1,2,,,0,,0 0\n"
            "2,insert,3,3,3,,,,,4,,2,,\n"
            "3,collision,3,3,3,,,,,4,5,2,,0 -1\n");
}

TEST(Event_log, begins_with_its_header) {
  EXPECT_EQ(log_of({}), header);
}

TEST(Event_log, writes_the_fields_of_each_kind) {
  const Algebraic_number time(0.5);
  EXPECT_EQ(
      log_of({
          {.number = 0,
           .kind = Event_kind::flip,
           .time = time,
           .removed = Edge_ids{1, 12},
           .added = Edge_ids{0, 4294967294}},
          {.number = 1, .kind = Event_kind::hull_insert, .time = time, .removed = Edge_ids{2, 3}},
          {.number = 2, .kind = Event_kind::hull_remove, .time = time, .added = Edge_ids{4, 5}},
          {.number = 3, .kind = Event_kind::wall, .time = time, .point_a = 6},
          {.number = 4, .kind = Event_kind::collision, .time = time, .point_a = 7, .point_b = 8},
          {.number = 18446744073709551615U,
           .kind = Event_kind::rebuild,
           .time = time,
           .added = Edge_ids{0, 9}},
      }),
      std::string(header) +
          "0,flip,0.5,0.5,0.5,1,12,0,4294967294,,,0\n"
          "1,hull_insert,0.5,0.5,0.5,2,3,,,,,0\n"
          "2,hull_remove,0.5,0.5,0.5,,,4,5,,,0\n"
          "3,wall,0.5,0.5,0.5,,,,,6,,0\n"
          "4,collision,0.5,0.5,0.5,,,,,7,8,0\n"
          "18446744073709551615,rebuild,0.5,0.5,0.5,,,0,9,,,0\n");
}

TEST(Event_log, times_that_are_no_binary_numbers_lie_strictly_between_two) {
  const std::vector<Algebraic_number> times = {
      Algebraic_number(Rational(-1, 3)), Algebraic_number(Rational(1, 10)), square_root(2),
      Algebraic_number(Rational(Integer(1), Integer("1000000000000000000000000")))};
  std::vector<Log_event> events;
  for (const Algebraic_number& time : times) events.push_back({.number = 0, .time = time});
  std::istringstream log(log_of(events));
  std::string line;
  std::getline(log, line);
  for (const Algebraic_number& time : times) {
    std::getline(log, line);
    const double nearest = read_back(fields(line)[2]);
    const double lower = read_back(fields(line)[3]);
    const double upper = read_back(fields(line)[4]);
    EXPECT_TRUE(compare(time, to_rational(lower)) == CGAL::LARGER) << line;
    EXPECT_TRUE(compare(time, to_rational(upper)) == CGAL::SMALLER) << line;
    EXPECT_EQ(std::nextafter(lower, std::numeric_limits<double>::infinity()), upper) << line;
    EXPECT_TRUE(nearest == lower || nearest == upper) << line;
  }
}

TEST(Event_log, numbers_read_back_exactly) {
  const std::vector<double> times = {1e-300,      0.1,  1.0 / 3,
                                     123456789.0, 1e22, 1.7976931348623157e308};
  std::vector<Log_event> events;
  for (const double time : times) events.push_back({.number = 0, .time = time});
  std::istringstream log(log_of(events));
  std::string line;
  std::getline(log, line);
  for (const double time : times) {
    std::getline(log, line);
    for (const std::size_t column : {2U, 3U, 4U}) EXPECT_EQ(read_back(fields(line)[column]), time);
  }
}

// Simultaneous events share the text of their time; it must not be kept for the next instant, and a
// time that is equal but represented otherwise prints the same.
TEST(Event_log, each_instant_prints_its_own_time) {
  const Algebraic_number two_as_root(Polynomial({Integer(-4), Integer(0), Integer(1)}), Rational(1),
                                     Rational(5));
  const std::string log = log_of({{.number = 0, .time = 1.0},
                                  {.number = 1, .time = 1.0},
                                  {.number = 2, .time = 2.0},
                                  {.number = 3, .time = two_as_root},
                                  {.number = 4, .time = 3.0}});
  EXPECT_EQ(log, std::string(header) +
                     "0,flip,1,1,1,,,,,,,0\n"
                     "1,flip,1,1,1,,,,,,,0\n"
                     "2,flip,2,2,2,,,,,,,2\n"
                     "3,flip,2,2,2,,,,,,,2\n"
                     "4,flip,3,3,3,,,,,,,4\n");
}

// sqrt(2) and a number 2^-199 or less above it, which have one binary64 interval.
TEST(Event_log, instants_tell_apart_times_of_one_interval) {
  const Algebraic_number root = square_root(2);
  root.refine_to(Rational(1, Integer(1) << 200));
  const Rational above = root.isolating_interval().upper + Rational(1, Integer(1) << 200);
  const std::string log = log_of({{.number = 5, .time = root},
                                  {.number = 6, .time = square_root(2)},
                                  {.number = 7, .time = Algebraic_number(above)},
                                  {.number = 8, .time = Algebraic_number(above)}});
  std::istringstream in(log);
  std::string line;
  std::getline(in, line);
  std::vector<std::string> instants;
  std::vector<std::string> times;
  while (std::getline(in, line)) {
    instants.push_back(fields(line).back());
    times.push_back(fields(line)[3] + ' ' + fields(line)[4]);
  }
  EXPECT_EQ(instants, (std::vector<std::string>{"5", "5", "7", "7"}));
  EXPECT_EQ(times, std::vector<std::string>(4, times.front()));
}

// The bytes depend on the value, not on the work done on it.
TEST(Event_log, does_not_depend_on_refinement) {
  const Algebraic_number coarse = square_root(3);
  const Algebraic_number fine = square_root(3);
  fine.refine_to(Rational(1, Integer(1) << 200));
  EXPECT_EQ(log_of({{.number = 0, .time = coarse}}), log_of({{.number = 0, .time = fine}}));
}

}  // namespace
}  // namespace kinetri::event_log_test
