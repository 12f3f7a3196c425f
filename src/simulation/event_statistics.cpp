// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/event_statistics.h"

#include "kinetri/simulation/event_statistics_impl.h"

namespace kinetri {

std::uint64_t Events_in_interval::number_of_events() const {
  return std::accumulate(events.begin(), events.end(), std::uint64_t{0});
}

// Halves, since the difference of two large numbers may be infinite.
double Events_in_interval::rate() const {
  return static_cast<double>(number_of_events()) / 2 / (to / 2 - from / 2);
}

template class Event_statistics<Algebraic_number>;

}  // namespace kinetri
