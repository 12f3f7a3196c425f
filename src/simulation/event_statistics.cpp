// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/event_statistics.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <numeric>
#include <ostream>
#include <sstream>

#include "kinetri/impl/base/check.h"

namespace kinetri {

std::uint64_t Events_in_interval::number_of_events() const {
  return std::accumulate(events.begin(), events.end(), std::uint64_t{0});
}

// Halves, since the difference of two large numbers may be infinite.
double Events_in_interval::rate() const {
  return static_cast<double>(number_of_events()) / 2 / (to / 2 - from / 2);
}

Event_statistics::Event_statistics(double from, double to, std::size_t intervals) {
  KINETRI_PRECONDITION(
      std::isfinite(from) && std::isfinite(to) && from < to,
      "the intervals of event statistics need two finite ends, the first one less");
  KINETRI_PRECONDITION(intervals > 0, "event statistics over no interval; take one or more");
  double lower = from;
  for (std::size_t i = 1; i <= intervals; ++i) {
    const double upper =
        std::lerp(from, to, static_cast<double>(i) / static_cast<double>(intervals));
    KINETRI_PRECONDITION(
        lower < upper, "the intervals are too short to tell their ends apart; take fewer of them");
    intervals_.push_back({lower, upper, {}});
    lower = upper;
  }
}

void Event_statistics::after_event(const Event& event) {
  const auto kind = static_cast<std::size_t>(event.kind);
  ++events_[kind];
  if (Event_counts* counts = counts_at(event.time)) ++(*counts)[kind];
  count_points(event);
  if (!last_time_ || *last_time_ != event.time) {
    ++instants_;
    present_instant_ = 0;
    last_time_ = event.time;
    if (!first_time_) first_time_ = event.time;
  }
  if (++present_instant_ > largest_instant_) {
    largest_instant_ = present_instant_;
    largest_instant_time_ = event.time;
  }
}

// The counts of the interval that contains the time; null if there is none.
Event_counts* Event_statistics::counts_at(const Algebraic_number& time) {
  if (intervals_.empty() || time < Algebraic_number(intervals_.front().from)) return nullptr;
  const auto interval = std::ranges::partition_point(
      intervals_, [&](const Events_in_interval& i) { return Algebraic_number(i.to) < time; });
  return interval == intervals_.end() ? nullptr : &interval->events;
}

void Event_statistics::count_points(const Event& event) {
  std::array<Point_id, 6> points;
  points.fill(no_point);
  if (event.removed) std::ranges::copy(*event.removed, points.begin());
  if (event.added) std::ranges::copy(*event.added, points.begin() + 2);
  if (event.point_a) points[4] = *event.point_a;
  if (event.point_b) points[5] = *event.point_b;
  std::ranges::sort(points);
  const auto end = std::unique(points.begin(), points.end());
  for (auto point = points.begin(); point != end && *point != no_point; ++point) {
    if (*point >= events_of_points_.size()) events_of_points_.resize(std::size_t{*point} + 1);
    ++events_of_points_[*point];
  }
}

std::uint64_t Event_statistics::number_of_events() const {
  return std::accumulate(events_.begin(), events_.end(), std::uint64_t{0});
}

std::uint64_t Event_statistics::events_of(Point_id id) const {
  return id < events_of_points_.size() ? events_of_points_[id] : 0;
}

std::optional<double> Event_statistics::mean_time_between_events() const {
  const std::uint64_t events = number_of_events();
  if (events < 2) return std::nullopt;
  return (last_time_->to_double() - first_time_->to_double()) / static_cast<double>(events - 1);
}

// Most events first; of equally many the smaller id.
std::vector<Point_id> Event_statistics::busiest_points(std::size_t number) const {
  std::vector<Point_id> result;
  for (Point_id id = 0; id < events_of_points_.size(); ++id) {
    if (events_of_points_[id] > 0) result.push_back(id);
  }
  const auto end = result.begin() + static_cast<std::ptrdiff_t>(std::min(number, result.size()));
  std::ranges::partial_sort(result, end, [&](Point_id a, Point_id b) {
    const std::uint64_t of_a = events_of_points_[a];
    const std::uint64_t of_b = events_of_points_[b];
    return of_a != of_b ? of_a > of_b : a < b;
  });
  result.erase(end, result.end());
  return result;
}

void Event_statistics::write(std::ostream& out) const {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  const auto write_kinds = [&](const Event_counts& events) {
    const char* separator = ": ";
    for (std::size_t kind = 0; kind < event_kinds; ++kind) {
      if (events[kind] == 0) continue;
      text << separator << name(static_cast<Event_kind>(kind)) << ' ' << events[kind];
      separator = ", ";
    }
    text << '\n';
  };
  text << "events " << number_of_events();
  write_kinds(events_);
  if (first_time_) {
    text << "times of events " << instants_ << ", from " << first_time_->to_double() << " to "
         << last_time_->to_double() << '\n'
         << "most events at one time " << largest_instant_ << ", at "
         << largest_instant_time_->to_double() << '\n';
  }
  if (const auto mean = mean_time_between_events()) {
    text << "mean time between events " << *mean << '\n';
  }
  for (const Point_id id : busiest_points(5)) {
    text << "point " << id << ": events " << events_of(id) << '\n';
  }
  for (const Events_in_interval& interval : intervals_) {
    text << "from " << interval.from << " to " << interval.to << ": events "
         << interval.number_of_events() << ", rate " << interval.rate();
    write_kinds(interval.events);
  }
  out << text.str();
}

}  // namespace kinetri
