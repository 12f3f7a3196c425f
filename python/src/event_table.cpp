// SPDX-License-Identifier: GPL-3.0-or-later
#include "event_table.h"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <tuple>

namespace kinetri::python {

Kind_text row_text(Event_kind kind) {
  Kind_text result = {};
  const std::string_view text = name(kind);
  static_assert(std::string_view("hull_insert").size() <= std::tuple_size_v<Kind_text> &&
                std::string_view("hull_remove").size() <= std::tuple_size_v<Kind_text>);
  std::copy(text.begin(), text.end(), result.begin());
  return result;
}

template <class Row>
void Event_table<Row>::after_event(const Event& event) {
  if (!kinds_[static_cast<std::size_t>(event.kind)]) return;
  Event_row row;
  row.kind = row_text(event.kind);
  if (time_ && *time_ == event.time) {
    row.time = last_.time;
    row.time_lo = last_.time_lo;
    row.time_hi = last_.time_hi;
  } else {
    time_ = event.time;
    row.time = event.time.to_double();  // usually makes the bounds known
    const auto [lower, upper] = event.time.tight_interval();
    row.time_lo = lower;
    row.time_hi = upper;
  }
  if (event.removed) row.removed = *event.removed;
  if (event.added) row.added = *event.added;
  if (event.point_a) row.points[0] = *event.point_a;
  if (event.point_b) row.points[1] = *event.point_b;
  last_ = row;
  if constexpr (std::same_as<Row, Event_row>) {
    rows_.push_back(row);
  } else {
    rows_.push_back({row, event.removed_offset, event.added_offset});
  }
}

template class Event_table<Event_row>;
template class Event_table<Periodic_event_row>;

}  // namespace kinetri::python
