// SPDX-License-Identifier: GPL-3.0-or-later
//
// Counts of events: by kind, by interval of time, by point, and at one time.
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

/// The events of an interval of time: after `from`, up to and at `to`, as those that happen between
/// advance_to(from) and advance_to(to). Those at `from` belong to the first interval, too.
struct Events_in_interval {
  double from = 0;           ///< where the interval begins
  double to = 0;             ///< where it ends; greater than `from`
  Event_counts events = {};  ///< how many, by kind

  /// The events of all kinds together.
  std::uint64_t number_of_events() const;
  /// Events in a unit of time, rounded.
  double rate() const;
};

/// Observes a triangulation or a simulation, which it is added to by add_observer, and counts each
/// event once it has happened. Times are compared exactly. Cost: some operations an event, and a
/// binary search among the intervals. Memory: O(greatest id + intervals), for any number of events.
template <class Time = Algebraic_number>
class Event_statistics : public Event_observer<Time> {
 public:
  /// Without intervals.
  Event_statistics() = default;

  /// With intervals of equal length, up to rounding, from `from` to `to`; events outside are only
  /// counted in all. Precondition: from < to are finite, intervals > 0, and not so many that two of
  /// their ends are the same binary64 number.
  Event_statistics(double from, double to, std::size_t intervals);

  /// Counts the event.
  void after_event(const Event<Time>& event) override;

  /// The events of all kinds together, those outside of the intervals included.
  std::uint64_t number_of_events() const;
  /// The same by kind.
  const Event_counts& events() const { return events_; }
  /// The intervals, in the order of time; empty if none were asked for.
  const std::vector<Events_in_interval>& intervals() const { return intervals_; }

  /// The number of events that concerned the point: as an end of the edge that was removed or of
  /// the one that was added, or as the point that came, left, turned, hit a wall or collided. Each
  /// event counts once.
  std::uint64_t events_of(Point_id id) const;

  /// The number of distinct times of events.
  std::uint64_t instants() const { return instants_; }
  /// The largest number of events at one time; 0 without events.
  std::uint64_t largest_instant() const { return largest_instant_; }
  /// The first time with so many, exactly; none without events.
  const std::optional<Time>& largest_instant_time() const { return largest_instant_time_; }

  /// The time from the first event to the last one, divided by the number of steps from event to
  /// event, of which those between events at one time take no time; rounded. None if there are
  /// fewer than two events.
  std::optional<double> mean_time_between_events() const;

  /// A summary in some lines for people: totals, kinds, intervals, the points with most events.
  friend std::ostream& operator<<(std::ostream& out, const Event_statistics& statistics) {
    statistics.write(out);
    return out;
  }

 private:
  Event_counts* counts_at(const Time& time);
  void count_points(const Event<Time>& event);
  std::vector<Point_id> busiest_points(std::size_t number) const;
  void write(std::ostream& out) const;

  Event_counts events_ = {};
  std::vector<Events_in_interval> intervals_;
  std::vector<std::uint64_t> events_of_points_;  // by id
  std::uint64_t instants_ = 0;
  std::uint64_t present_instant_ = 0;  // events at the time of the last one
  std::uint64_t largest_instant_ = 0;
  std::optional<Time> largest_instant_time_;
  std::optional<Time> first_time_;
  std::optional<Time> last_time_;
};

extern template class Event_statistics<Algebraic_number>;

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_EVENT_STATISTICS_H
