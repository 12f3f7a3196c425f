// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/recording.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "kinetri/base/check.h"

namespace kinetri {
namespace {

Polynomial_motion_2 as_polynomial(const Linear_motion_2& motion) {
  return polynomial_motion(motion);
}
const Polynomial_motion_2& as_polynomial(const Polynomial_motion_2& motion) {
  return motion;
}

// What the events of an interval of time come to.
class Merged_events {
 public:
  void add(const Recorded_event& event) {
    if (event.removed) --edges_[*event.removed];
    if (event.added) ++edges_[*event.added];
  }

  void add(const Recorded_event& event, const Recorded_motion& motion) {
    const auto [place, is_first] = points_.try_emplace(motion.point);
    if (is_first) place->second.was_there = event.kind != Event_kind::insert;
    place->second.motion = motion.motion;
  }

  // Appends them as rows like `last`, the last of the events.
  void write(const Recorded_event& last, Recording& out) const {
    Recorded_event row;
    row.number = last.number;
    row.time = last.time;
    for (const auto& [id, change] : points_) {
      if (!change.was_there && !change.motion) continue;
      row.kind = !change.was_there ? Event_kind::insert
                 : change.motion   ? Event_kind::trajectory
                                   : Event_kind::erase;
      row.point_a = id;
      out.motions.push_back({out.events.size(), id, change.motion});
      out.events.push_back(row);
    }
    row.kind = Event_kind::rebuild;
    row.point_a.reset();
    for (const auto& [edge, net] : edges_) {
      if (net < 0) out.events.push_back(with_edge(row, &Recorded_event::removed, edge));
    }
    for (const auto& [edge, net] : edges_) {
      if (net > 0) out.events.push_back(with_edge(row, &Recorded_event::added, edge));
    }
  }

 private:
  struct Point_change {
    bool was_there = true;
    std::optional<Polynomial_motion_2> motion;
  };

  static Recorded_event with_edge(Recorded_event row,
                                  std::optional<Edge_ids> Recorded_event::*field,
                                  const Edge_ids& edge) {
    row.*field = edge;
    return row;
  }

  std::map<Edge_ids, int> edges_;  // +1: added, -1: removed, 0: both
  std::map<Point_id, Point_change> points_;
};

// Merges the events of each of the intervals of time that follow each other from the start on; all,
// if one interval is as long as the recording.
Recording merged(const Recording& recording, double interval) {
  const bool is_divided = interval < recording.until - recording.from;
  const auto number_of_interval = [&](const Recorded_event& event) {
    return is_divided ? std::floor((event.time.nearest - recording.from) / interval) : 0;
  };
  Recording result = recording;
  result.is_thinned = true;
  result.events.clear();
  auto motion = std::ranges::find_if(recording.motions, &std::optional<std::size_t>::has_value,
                                     &Recorded_motion::event);
  result.motions.assign(recording.motions.begin(), motion);
  const auto& events = recording.events;
  for (std::size_t first = 0, end = 0; first < events.size(); first = end) {
    Merged_events merged_events;
    for (end = first; end < events.size() &&
                      number_of_interval(events[end]) == number_of_interval(events[first]);
         ++end) {
      merged_events.add(events[end]);
      for (; motion != recording.motions.end() && *motion->event == end; ++motion) {
        merged_events.add(events[end], *motion);
      }
    }
    merged_events.write(events[end - 1], result);
  }
  return result;
}

}  // namespace

template <class Traits>
Recorder<Traits>::Recorder(const Triangulation& triangulation, double until, std::size_t most_rows)
    : triangulation_(triangulation), most_rows_(most_rows), limit_(most_rows) {
  KINETRI_PRECONDITION(std::isfinite(until), "the end of a recording is not finite");
  KINETRI_PRECONDITION(most_rows > 0, "a recording of no rows");
  recording_.from = triangulation.current_time().to_double();
  recording_.until = until;
  recording_.initial_edges = triangulation.finite_edge_ids();
  for (std::size_t id = 0; id < triangulation.next_id(); ++id) {
    if (triangulation.contains(static_cast<Point_id>(id))) {
      record_motion(static_cast<Point_id>(id), std::nullopt);
    }
  }
}

template <class Traits>
void Recorder<Traits>::record_motion(Point_id id, std::optional<std::size_t> event) {
  Recorded_motion& motion = recording_.motions.emplace_back();
  motion.event = event;
  motion.point = id;
  if (triangulation_.contains(id)) motion.motion = as_polynomial(triangulation_.motion(id));
}

template <class Traits>
void Recorder<Traits>::after_event(const Event<Time>& event) {
  if (!time_ || *time_ != event.time) {
    time_ = event.time;
    rounded_time_ = {event.time.to_double(), event.time.tight_interval()};
  }
  ++recording_.events_in_all;
  const std::size_t index = recording_.events.size();
  recording_.events.push_back({event.number, event.kind, rounded_time_, event.removed, event.added,
                               event.point_a, event.point_b});
  if (event.point_a) record_motion(*event.point_a, index);
  if (event.point_b) record_motion(*event.point_b, index);
  if (recording_.events.size() <= limit_) return;
  // To half of the limit, so that the next time is some way off. Where even all events together
  // come to more, it is the limit that gives way.
  thin(recording_, limit_ / 2);
  limit_ = std::max(limit_, 2 * recording_.events.size());
}

template <class Traits>
void Recorder<Traits>::thin(Recording& recording, std::size_t most_rows) const {
  const double duration = recording.until - recording.from;
  double interval = duration / static_cast<double>(limit_);
  Recording thinned;
  do {
    interval *= 2;
    thinned = merged(recording, interval);
  } while (thinned.events.size() > most_rows && interval < duration);
  recording = std::move(thinned);
}

template <class Traits>
Recording Recorder<Traits>::recording() const {
  Recording result = recording_;
  if (result.events.size() > most_rows_) thin(result, most_rows_);
  result.until = triangulation_.current_time().to_double();
  return result;
}

template class Recorder<Linear_kinetic_traits_2>;
template class Recorder<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
