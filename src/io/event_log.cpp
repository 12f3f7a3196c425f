// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/event_log.h"

#include <fmt/format.h>

#include <iterator>
#include <ostream>
#include <string_view>

namespace kinetri {
namespace {

void append(fmt::memory_buffer& line, const std::optional<Edge_ids>& edge) {
  if (edge) {
    fmt::format_to(std::back_inserter(line), ",{},{}", (*edge)[0], (*edge)[1]);
  } else {
    line.append(std::string_view(",,"));
  }
}

void append(fmt::memory_buffer& line, const std::optional<Point_id>& point) {
  line.push_back(',');
  if (point) fmt::format_to(std::back_inserter(line), "{}", *point);
}

std::string three_fields(const Algebraic_number& time) {
  const Double_interval interval = time.tight_interval();
  return fmt::format("{},{},{}", time.to_double(), interval.lower, interval.upper);
}

}  // namespace

Event_log_writer::Event_log_writer(std::ostream& out) : out_(out) {
  out_ << "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b\n";
}

void Event_log_writer::after_event(const Event<Algebraic_number>& event) {
  if (!time_ || *time_ != event.time) {
    time_ = event.time;
    time_text_ = three_fields(event.time);
  }
  fmt::memory_buffer line;
  fmt::format_to(std::back_inserter(line), "{},{},{}", event.number, name(event.kind), time_text_);
  append(line, event.removed);
  append(line, event.added);
  append(line, event.point_a);
  append(line, event.point_b);
  line.push_back('\n');
  out_.write(line.data(), static_cast<std::streamsize>(line.size()));
}

}  // namespace kinetri
