// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/recording.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "kinetri/impl/base/check.h"

namespace kinetri {
namespace {

// Whether the points of such an event keep their motions.
bool is_of_topology(Event_kind kind) {
  return kind < Event_kind::wall;
}

bool is_one_flip(Event_kind kind) {
  return kind == Event_kind::flip || kind == Event_kind::hull_insert ||
         kind == Event_kind::hull_remove;
}

// The net effect of the events of an interval of time.
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

  void add(const Recorded_coincidence& coincidence) {
    shown_[coincidence.point] = coincidence.shown;
  }

  void add(const Recorded_triangle& triangle) {
    triangles_[triangle.corners] += triangle.is_added ? 1 : -1;
  }

  // Appends the net effect as rows with the number and time of `last`, the last event.
  void write(const Recorded_event& last, Recording& out) const {
    const std::size_t first_row = out.events.size();
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
    const auto changed = [](const auto& change) { return change.second != 0; };
    if (std::ranges::none_of(triangles_, changed) && shown_.empty()) return;
    if (out.events.size() == first_row) out.events.push_back(row);
    for (const int change : {-1, 1}) {
      for (const auto& [corners, net] : triangles_) {
        if (net == change) out.triangles.push_back({out.events.size() - 1, change > 0, corners});
      }
    }
    for (const auto& [id, shown] : shown_) {
      out.coincidences.push_back({out.events.size() - 1, id, shown});
    }
  }

 private:
  struct Point_change {
    bool was_there = true;
    std::optional<Polynomial_disc_motion_2> motion;
  };

  static Recorded_event with_edge(Recorded_event row,
                                  std::optional<Edge_ids> Recorded_event::*field,
                                  const Edge_ids& edge) {
    row.*field = edge;
    return row;
  }

  std::map<Edge_ids, int> edges_;          // +1: added, -1: removed, 0: both
  std::map<Triangle_ids, int> triangles_;  // the same
  std::map<Point_id, Point_id> shown_;     // the last of each point
  std::map<Point_id, Point_change> points_;
};

// Merges the events of each of the successive intervals of time; all, if the interval is as long as
// the recording.
Recording merged(const Recording& recording, double interval) {
  const bool is_divided = interval < recording.until - recording.from;
  const auto number_of_interval = [&](const Recorded_event& event) {
    return is_divided ? std::floor((event.time.nearest - recording.from) / interval) : 0;
  };
  Recording result = recording;
  result.is_thinned = true;
  result.events.clear();
  const auto is_of_event = [](const auto& recorded) { return recorded.event.has_value(); };
  auto motion = std::ranges::find_if(recording.motions, is_of_event);
  result.motions.assign(recording.motions.begin(), motion);
  auto coincidence = std::ranges::find_if(recording.coincidences, is_of_event);
  result.coincidences.assign(recording.coincidences.begin(), coincidence);
  result.triangles.clear();
  auto triangle = recording.triangles.begin();
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
      for (; coincidence != recording.coincidences.end() && *coincidence->event == end;
           ++coincidence) {
        merged_events.add(*coincidence);
      }
      for (; triangle != recording.triangles.end() && triangle->event == end; ++triangle) {
        merged_events.add(*triangle);
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
      record_coincidence(static_cast<Point_id>(id), std::nullopt);
    }
  }
  for (const auto face : triangulation.triangulation().finite_face_handles()) {
    const auto id = [face](int i) { return face->vertex(i)->point().id(); };
    recording_.initial_triangles.push_back(triangle_ids(id(0), id(1), id(2)));
    triangles_.insert(recording_.initial_triangles.back());
  }
  std::ranges::sort(recording_.initial_triangles);
}

template <class Traits>
void Recorder<Traits>::set_time(const Time& time) {
  if (time_ && *time_ == time) return;
  time_ = time;
  rounded_time_ = {time.to_double(), time.tight_interval()};
}

template <class Traits>
void Recorder<Traits>::record_motion(Point_id id, std::optional<std::size_t> event) {
  Recorded_motion& motion = recording_.motions.emplace_back();
  motion.event = event;
  motion.point = id;
  if (triangulation_.contains(id)) motion.motion = general_motion(triangulation_.motion(id));
}

// Records which point is shown in the place of the point, if that has changed.
template <class Traits>
void Recorder<Traits>::record_coincidence(Point_id id, std::optional<std::size_t> event) {
  const Point_id shown = triangulation_.contains(id) ? triangulation_.vertex(id)->point().id() : id;
  const auto before = shown_.find(id);
  if (shown == (before == shown_.end() ? id : before->second)) return;
  recording_.coincidences.push_back({event, id, shown});
  if (shown == id) {
    shown_.erase(before);
  } else {
    shown_.insert_or_assign(id, shown);
  }
}

template <class Traits>
void Recorder<Traits>::after_event(const Event& event) {
  set_time(event.time);
  ++recording_.events_in_all;
  const std::size_t index = recording_.events.size();
  recording_.events.push_back({event.number, event.kind, rounded_time_, event.removed, event.added,
                               event.point_a, event.point_b});
  if (!is_of_topology(event.kind)) {
    if (event.point_a) record_motion(*event.point_a, index);
    if (event.point_b) record_motion(*event.point_b, index);
  }
  if (is_one_flip(event.kind)) record_flip(event);
  thin_if_needed();
}

// Records the triangles that a flip removes and adds, without the triangulation, which may have
// changed further. At the hull there is one triangle more or less.
template <class Traits>
void Recorder<Traits>::record_flip(const Event& event) {
  std::vector<Recorded_triangle> changes;
  const auto change = [&changes](bool is_added, Point_id p, Point_id q, Point_id r) {
    changes.push_back({0, is_added, triangle_ids(p, q, r)});
  };
  if (event.kind == Event_kind::flip) {
    const auto [p, q] = *event.removed;
    const Point_id left = triangles_.apex(p, q);
    const Point_id right = triangles_.apex(q, p);
    KINETRI_ASSERT(edge_ids(left, right) == *event.added, "the triangles at the edge are known");
    change(false, p, q, left);
    change(false, q, p, right);
    change(true, left, right, q);
    change(true, right, left, p);
  } else {
    const bool is_added = event.kind == Event_kind::hull_remove;
    const auto [p, q] = is_added ? *event.added : *event.removed;
    const Point_id apex = *event.apex;
    // The new triangle is on the free side.
    const bool is_left =
        is_added ? triangles_.apex(q, apex) == no_point : triangles_.apex(p, q) == apex;
    if (is_left) {
      change(is_added, p, q, apex);
    } else {
      change(is_added, q, p, apex);
    }
  }
  std::ranges::sort(changes, {}, [](const Recorded_triangle& triangle) {
    return std::pair(triangle.is_added, triangle.corners);
  });
  record_triangles(changes);
}

// Other kinds of events are reported when the triangulation is already in the state of this call.
template <class Traits>
void Recorder<Traits>::after_rebuild(const Time& time, std::span<const Edge_ids> edges) {
  const std::vector<Recorded_triangle> changes = changed_triangles(edges);
  if (changes.empty()) return;
  expect_row(time);
  record_triangles(changes);
  thin_if_needed();
}

template <class Traits>
void Recorder<Traits>::after_hiding(const Time& time, std::span<const Point_id> points) {
  const std::size_t before = recording_.coincidences.size();
  for (const Point_id id : points) record_coincidence(id, 0);
  if (recording_.coincidences.size() == before) return;
  expect_row(time);
  for (std::size_t i = before; i < recording_.coincidences.size(); ++i) {
    recording_.coincidences[i].event = recording_.events.size() - 1;
  }
  thin_if_needed();
}

// Adds a row without an edge, unless the last row is of the time and not a flip.
template <class Traits>
void Recorder<Traits>::expect_row(const Time& time) {
  const bool is_reported = !recording_.events.empty() && time_ && *time_ == time &&
                           !is_one_flip(recording_.events.back().kind);
  if (is_reported) return;
  set_time(time);
  Recorded_event& row = recording_.events.emplace_back();
  row.number = triangulation_.counters().number_of_events();
  row.kind = Event_kind::rebuild;
  row.time = rounded_time_;
}

// The apex of the triangle to the left of pq in the triangulation, no_point if there is none.
template <class Traits>
Point_id Recorder<Traits>::apex_now(Point_id p, Point_id q) const {
  const auto& triangulation = triangulation_.triangulation();
  if (triangulation.dimension() < 2 || !triangulation_.contains(p)) return no_point;
  if (triangulation_.is_hidden(p)) return no_point;
  const auto vertex = triangulation_.vertex(p);
  auto face = triangulation.incident_faces(vertex);
  const auto first = face;
  do {
    const int i = face->index(vertex);
    if (face->vertex(triangulation.ccw(i))->point().id() == q) {
      // The infinite vertex has the id no_point.
      return face->vertex(triangulation.cw(i))->point().id();
    }
  } while (++face != first);
  return no_point;
}

// The triangles that have changed since they were recorded, removed ones first, found by a search
// from the edges over changed triangles.
template <class Traits>
std::vector<Recorded_triangle> Recorder<Traits>::changed_triangles(
    std::span<const Edge_ids> edges) const {
  std::vector<Edge_ids> sides;  // directed
  for (const auto& [a, b] : edges) {
    sides.push_back({a, b});
    sides.push_back({b, a});
  }
  std::set<Edge_ids> seen;
  std::set<Triangle_ids> removed;
  std::set<Triangle_ids> added;
  while (!sides.empty()) {
    const auto [p, q] = sides.back();
    sides.pop_back();
    if (!seen.insert({p, q}).second) continue;
    const Point_id before = triangles_.apex(p, q);
    const Point_id after = apex_now(p, q);
    if (before == after) continue;
    for (const Point_id apex : {before, after}) {
      if (apex == no_point) continue;
      (apex == before ? removed : added).insert(triangle_ids(p, q, apex));
      sides.push_back({q, apex});
      sides.push_back({apex, p});
    }
  }
  std::vector<Recorded_triangle> result;
  for (const Triangle_ids& corners : removed) result.push_back({0, false, corners});
  for (const Triangle_ids& corners : added) result.push_back({0, true, corners});
  return result;
}

// Adds the changes to the last row.
template <class Traits>
void Recorder<Traits>::record_triangles(std::span<const Recorded_triangle> changes) {
  for (const auto& [event, is_added, corners] : changes) {
    is_added ? triangles_.insert(corners) : triangles_.erase(corners);
    recording_.triangles.push_back({recording_.events.size() - 1, is_added, corners});
  }
}

// Thins to half of the limit, to amortize the cost. If even the net effect of all events has more
// rows, the limit grows.
template <class Traits>
void Recorder<Traits>::thin_if_needed() {
  if (recording_.events.size() <= limit_) return;
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

template <class Traits>
Recording Recorder<Traits>::take() {
  KINETRI_PRECONDITION(!recording_.is_thinned, "parts of a recording that is thinned");
  Recording result;
  std::swap(result, recording_);
  recording_.until = result.until;
  result.until = recording_.from = triangulation_.current_time().to_double();
  return result;
}

template class Recorder<Linear_kinetic_traits_2>;
template class Recorder<Polynomial_kinetic_traits_2>;
template class Recorder<Disc_kinetic_traits_2>;
template class Recorder<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri
