// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event log: every event as a line of comma separated values, with a binary64 interval that
// certainly contains its exact time. The same run gives the same bytes: the text of a time depends
// on its value alone, not on how far it was refined.
#ifndef KINETRI_IO_EVENT_LOG_H
#define KINETRI_IO_EVENT_LOG_H

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/events/event.h"

namespace kinetri {

/// The three fields of an exact time, as in "0.5,0.5,0.5": the binary64 number nearest to it, and
/// the bounds of its tightest binary64 interval, which are equal if it is a binary64 number, else
/// adjacent. All three have the fewest digits that read back exactly.
std::string time_fields(const Algebraic_number& time);

/// An observer that writes each event as one line, after the event:
///
///   event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,instant
///
/// `time`, `time_lo` and `time_hi` are the time_fields. `instant` is the number of the first event
/// at the same exact time that this object has written: it distinguishes times with the same three
/// fields. Unused fields are empty.
///
/// Errors are those of the stream. Cost: the times are rounded once for each instant.
class Event_log_writer : public Event_observer {
 public:
  /// Writes the header line. `out` must outlive this object.
  explicit Event_log_writer(std::ostream& out);

  /// False: a line is about the event alone.
  bool looks_at_triangulation() const override { return false; }
  /// Writes the line of the event.
  void after_event(const Event& event) override;

 private:
  std::ostream& out_;
  std::optional<Algebraic_number> time_;  // of the last event
  std::string time_text_;                 // its three fields
  std::uint64_t instant_ = 0;             // the number of the first event at that time
};

}  // namespace kinetri

#endif  // KINETRI_IO_EVENT_LOG_H
