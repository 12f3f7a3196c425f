// SPDX-License-Identifier: GPL-3.0-or-later
//
// Observers that store the events of a run, as rows of a NumPy array or as objects.
#ifndef KINETRI_PYTHON_EVENT_TABLE_H
#define KINETRI_PYTHON_EVENT_TABLE_H

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/events/event.h"

namespace kinetri::python {

/// The kind of an event as text of NumPy, padded with zeros.
using Kind_text = std::array<char32_t, 12>;

/// A row of the array of events, which NumPy sees as the fields of `kinetri.event_dtype`. There is
/// no padding: NumPy drops padding when it concatenates arrays, which changes the type.
struct Event_row {
  Kind_text kind = {};
  double time = 0;     ///< rounded to nearest
  double time_lo = 0;  ///< the tightest binary64 bounds
  double time_hi = 0;
  Edge_ids removed = {no_point, no_point};
  Edge_ids added = {no_point, no_point};
  std::array<Point_id, 2> points = {no_point, no_point};
};
static_assert(sizeof(Event_row) ==
              sizeof(Kind_text) + 3 * sizeof(double) + 2 * sizeof(Edge_ids) + 2 * sizeof(Point_id));

/// The row of an event in a periodic box: the fields of `kinetri.periodic_event_dtype`.
struct Periodic_event_row {
  Event_row event;
  Lattice_offset_2 removed_offset;
  Lattice_offset_2 added_offset;
};
static_assert(sizeof(Periodic_event_row) == sizeof(Event_row) + 2 * sizeof(Lattice_offset_2));

/// The kind's name in a row.
Kind_text row_text(Event_kind kind);

/// Stores the events of some kinds as rows, Event_row or Periodic_event_row. The time of
/// simultaneous events is rounded once.
template <class Row>
class Event_table : public Event_observer {
 public:
  using Kinds = std::array<bool, event_kinds>;  ///< by Event_kind, whether its events are kept

  explicit Event_table(const Kinds& kinds) : kinds_(kinds) {}

  bool looks_at_triangulation() const override { return false; }
  void after_event(const Event& event) override;

  /// Rows so far; the table is empty then.
  std::vector<Row> take() { return std::exchange(rows_, {}); }

 private:
  Kinds kinds_;
  std::vector<Row> rows_;
  Event_row last_;                        // for its time
  std::optional<Algebraic_number> time_;  // of the last row
};

/// Stores the events themselves.
class Event_list : public Event_observer {
 public:
  bool looks_at_triangulation() const override { return false; }
  void after_event(const Event& event) override { events_.push_back(event); }

  /// The events so far; the list is empty then.
  std::vector<Event> take() { return std::exchange(events_, {}); }

 private:
  std::vector<Event> events_;
};

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_EVENT_TABLE_H
