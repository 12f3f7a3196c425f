// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/event_log.h"

#include <ostream>

#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

void append_edge(std::string& line, const std::optional<Edge_ids>& edge) {
  if (edge) {
    append(line, ',', (*edge)[0], ',', (*edge)[1]);
  } else {
    line += ",,";
  }
}

void append_offset(std::string& line, bool has_offset, const Lattice_offset_2& offset) {
  line += ',';
  if (has_offset) line += offset_field(offset);
}

void append_point(std::string& line, const std::optional<Point_id>& point) {
  line += ',';
  if (point) append(line, *point);
}

}  // namespace

std::string time_fields(const Algebraic_number& time) {
  const double nearest = time.to_double();  // mostly computes the bounds too
  const Double_interval interval = time.tight_interval();
  return joined(nearest, ',', interval.lower, ',', interval.upper);
}

std::string offset_field(const Lattice_offset_2& offset) {
  return joined(offset.x, ' ', offset.y);
}

Event_log_writer::Event_log_writer(std::ostream& out, Event_columns columns)
    : out_(out), columns_(columns) {
  out_ << "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,"
          "instant"
       << (columns == Event_columns::periodic ? ",removed_offset,added_offset\n" : "\n");
}

void Event_log_writer::after_event(const Event& event) {
  if (!time_ || *time_ != event.time) {
    time_ = event.time;
    time_text_ = time_fields(event.time);
    instant_ = event.number;
  }
  std::string line;
  append(line, event.number, ',', name(event.kind), ',', time_text_);
  append_edge(line, event.removed);
  append_edge(line, event.added);
  append_point(line, event.point_a);
  append_point(line, event.point_b);
  append(line, ',', instant_);
  if (columns_ == Event_columns::periodic) {
    const bool is_contact = event.kind == Event_kind::collision;
    append_offset(line, event.removed.has_value(), event.removed_offset);
    append_offset(line, event.added.has_value() || is_contact, event.added_offset);
  }
  line += '\n';
  out_ << line;
}

}  // namespace kinetri
