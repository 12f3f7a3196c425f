// SPDX-License-Identifier: GPL-3.0-or-later
//
// Counts of events: by kind, by time interval, by point, and per instant.
#ifndef KINETRI_SIMULATION_EVENT_STATISTICS_H
#define KINETRI_SIMULATION_EVENT_STATISTICS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"

namespace kinetri {

/// Numbers of events, by Event_kind.
using Event_counts = std::array<std::uint64_t, event_kinds>;

/// The events of the time interval (from, to]: the events that advance_to(to) executes after
/// advance_to(from). The first interval also includes events at `from`.
struct Events_in_interval {
  double from = 0;           ///< start of the interval
  double to = 0;             ///< end of the interval; greater than `from`
  Event_counts events = {};  ///< number of events by kind

  /// The number of events of all kinds.
  std::uint64_t number_of_events() const;
  /// Events per unit of time, rounded.
  double rate() const;
};

/// An observer of a triangulation or a simulation (`add_observer`) that counts events. Times are
/// compared exactly. Cost: O(log intervals) per event. Memory: O(greatest id + intervals),
/// independent of the number of events.
class Event_statistics : public Event_observer {
 public:
  /// Without intervals.
  Event_statistics() = default;

  /// With `intervals` intervals of equal length, up to rounding, from `from` to `to`. Events
  /// outside are only counted in the totals. Preconditions: from < to, both finite; intervals > 0;
  /// the ends of all intervals are distinct binary64 numbers.
  Event_statistics(double from, double to, std::size_t intervals);

  /// False: only counts events.
  bool looks_at_triangulation() const override { return false; }
  /// Counts the event.
  void after_event(const Event& event) override;

  /// The number of events of all kinds, including events outside the intervals.
  std::uint64_t number_of_events() const;
  /// The number of events by kind, including events outside the intervals.
  const Event_counts& events() const { return events_; }
  /// The intervals in order of time; empty if constructed without intervals.
  const std::vector<Events_in_interval>& intervals() const { return intervals_; }

  /// The number of events that involve the point: as an end of the removed or added edge, or as a
  /// point that was inserted or erased, got another motion, hit a wall or collided. Each event
  /// counts once.
  std::uint64_t events_of(Point_id id) const;

  /// The number of distinct times of events.
  std::uint64_t instants() const { return instants_; }
  /// The largest number of events at one time; 0 without events.
  std::uint64_t largest_instant() const { return largest_instant_; }

  /// The time from the first to the last event, divided by the number of events minus one; rounded.
  /// Simultaneous events count with a difference of zero. None for fewer than two events.
  std::optional<double> mean_time_between_events() const;

  /// Writes a summary as text: totals, kinds, the points with most events, intervals.
  friend std::ostream& operator<<(std::ostream& out, const Event_statistics& statistics) {
    statistics.write(out);
    return out;
  }

 private:
  Event_counts* counts_at(const Algebraic_number& time);
  void count_points(const Event& event);
  std::vector<Point_id> busiest_points(std::size_t number) const;
  void write(std::ostream& out) const;

  Event_counts events_ = {};
  std::vector<Events_in_interval> intervals_;
  std::vector<std::uint64_t> events_of_points_;  // by id
  std::uint64_t instants_ = 0;
  std::uint64_t present_instant_ = 0;  // events at the time of the last one
  std::uint64_t largest_instant_ = 0;
  std::optional<Algebraic_number> largest_instant_time_;  // the first one
  std::optional<Algebraic_number> first_time_;
  std::optional<Algebraic_number> last_time_;
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_EVENT_STATISTICS_H
