// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event log: every event as a line of comma separated values, with a binary64 interval that
// certainly contains its exact time. The same run gives the same bytes: the text of a time depends
// on its value alone, not on how far it was refined.
#ifndef KINETRI_IO_EVENT_LOG_H
#define KINETRI_IO_EVENT_LOG_H

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/base/double_interval.h"

namespace kinetri {

/// The three fields of an exact time, as in "0.5,0.5,0.5": the binary64 number nearest to it, and
/// the bounds of its tightest binary64 interval, which are equal if it is a binary64 number, else
/// adjacent. All three have the fewest digits that read back exactly.
std::string time_fields(const Algebraic_number& time);

/// The columns of an event log.
enum class Event_columns {
  planar,    ///< those that Event_log_writer lists
  periodic,  ///< and at the end removed_offset,added_offset: see Event_log_writer
};

/// The text of an offset, as in "1 -2"; the two numbers are separated by a blank.
std::string offset_field(const Lattice_offset_2& offset);

/// An observer that writes each event as one line, after the event:
///
///   event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,instant
///
/// `time`, `time_lo` and `time_hi` are the time_fields. `instant` is the number of the first event
/// at the same exact time that this object has written: it distinguishes times with the same three
/// fields. Unused fields are empty.
///
/// In a periodic box each line ends with `,removed_offset,added_offset`: the offset_field of the
/// second end of the edge against the first (Periodic_edge). A collision has in added_offset that
/// of the image of point_b which point_a touches.
///
/// Errors are those of the stream. Cost: the times are rounded once for each instant.
class Event_log_writer : public Event_observer {
 public:
  /// Writes the header line. `out` must outlive this object. The events must be those of a
  /// triangulation in a periodic box if the columns are.
  explicit Event_log_writer(std::ostream& out, Event_columns columns = Event_columns::planar);

  /// False: a line is about the event alone.
  bool looks_at_triangulation() const override { return false; }
  /// Writes the line of the event.
  void after_event(const Event& event) override;

 private:
  std::ostream& out_;
  Event_columns columns_;
  std::optional<Algebraic_number> time_;  // of the last event
  std::string time_text_;                 // its three fields
  std::uint64_t instant_ = 0;             // the number of the first event at that time
};

/// An event of a log, at a time in the interval from `time_lo` to `time_hi`.
struct Logged_event : Basic_event<Double_interval> {
  std::size_t line = 0;  ///< of the file, counted from 1
};

/// Reads an event log. `name` stands for it in messages. Throws Input_error `name:line: ...` if a
/// column is missing or unknown, a row has too few or too many fields, a number is missing or
/// invalid, a kind is unknown, or only one end of an edge is given. Whether the events are those of
/// a run is not checked; `time` and `instant` are not read.
std::vector<Logged_event> read_event_log(std::istream& in, const std::string& name);

}  // namespace kinetri

#endif  // KINETRI_IO_EVENT_LOG_H
