// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/recording.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
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

// A triangle of the recording with these corners, counterclockwise.
Recorded_triangle recorded(std::size_t event, bool is_added, Point_id a, Point_id b, Point_id c) {
  return {event, is_added, triangle_ids(a, b, c), {}};
}
Recorded_triangle recorded(std::size_t event, bool is_added, const Periodic_image& a,
                           const Periodic_image& b, const Periodic_image& c) {
  const auto [corners, offsets] = periodic_triangle(a, b, c);
  return {event, is_added, corners, offsets};
}

// Those that are removed first.
void sort_triangles(std::vector<Recorded_triangle>& triangles) {
  std::ranges::sort(triangles, {}, [](const Recorded_triangle& triangle) {
    return std::tuple(triangle.is_added, triangle.corners, triangle.offsets);
  });
}

// Corner i of a face of the triangulation, as corner `from` sees it.
template <class Corner, class Face>
Corner corner_of(Face face, int i, int from) {
  const Point_id id = face->vertex(i)->point().id();
  if constexpr (std::same_as<Corner, Point_id>) {
    return id;
  } else {
    return {id, offset_between(face->offset(from), face->offset(i))};
  }
}

// The first end of an edge with this offset, and the second one.
template <class Corner>
std::array<Corner, 2> ends(const Edge_ids& ids, const Lattice_offset_2& offset) {
  if constexpr (std::same_as<Corner, Point_id>)
    return ids;
  else
    return {Periodic_image{ids[0], {}}, Periodic_image{ids[1], offset}};
}

template <class Corner>
std::array<Corner, 3> corners_of(const Recorded_triangle& triangle) {
  if constexpr (std::same_as<Corner, Point_id>)
    return triangle.corners;
  else
    return detail::images_of({triangle.corners, triangle.offsets});
}

// The net effect of the events of an interval of time.
class Merged_events {
 public:
  void add(const Recorded_event& event) {
    if (event.removed) --edges_[{*event.removed, event.removed_offset}];
    if (event.added) ++edges_[{*event.added, event.added_offset}];
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
    triangles_[{triangle.corners, triangle.offsets}] += triangle.is_added ? 1 : -1;
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
      if (net >= 0) continue;
      out.events.push_back(row);
      out.events.back().removed = edge.ids;
      out.events.back().removed_offset = edge.offset;
    }
    for (const auto& [edge, net] : edges_) {
      if (net <= 0) continue;
      out.events.push_back(row);
      out.events.back().added = edge.ids;
      out.events.back().added_offset = edge.offset;
    }
    const auto changed = [](const auto& change) { return change.second != 0; };
    if (std::ranges::none_of(triangles_, changed) && shown_.empty()) return;
    if (out.events.size() == first_row) out.events.push_back(row);
    for (const int change : {-1, 1}) {
      for (const auto& [triangle, net] : triangles_) {
        if (net != change) continue;
        out.triangles.push_back(
            {out.events.size() - 1, change > 0, triangle.corners, triangle.offsets});
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

  std::map<Periodic_edge, int> edges_;          // +1: added, -1: removed, 0: both
  std::map<Periodic_triangle, int> triangles_;  // the same
  std::map<Point_id, Point_id> shown_;          // the last of each point
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
  constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;
  std::vector<Recorded_triangle> triangles;
  for (const auto face : triangulation.triangulation().finite_face_handles()) {
    const auto corner = [face](int i) { return corner_of<Corner>(face, i, 0); };
    triangles.push_back(recorded(0, true, corner(0), corner(1), corner(2)));
    triangles_.insert(corners_of<Corner>(triangles.back()));
  }
  sort_triangles(triangles);
  for (const Recorded_triangle& triangle : triangles) {
    recording_.initial_triangles.push_back(triangle.corners);
    if (is_periodic) recording_.initial_offsets.push_back(triangle.offsets);
  }
  if constexpr (is_periodic) recording_.periodic_box = triangulation.traits().box();
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
                               event.point_a, event.point_b, std::nullopt, event.removed_offset,
                               event.added_offset});
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
  const auto change = [&changes](bool is_added, const Corner& p, const Corner& q, const Corner& r) {
    changes.push_back(recorded(0, is_added, p, q, r));
  };
  if (event.kind == Event_kind::flip) {
    const auto [p, q] = ends<Corner>(*event.removed, event.removed_offset);
    const Corner left = triangles_.apex(p, q);
    const Corner right = triangles_.apex(q, p);
    KINETRI_ASSERT(edge_ids(detail::id_of(left), detail::id_of(right)) == *event.added,
                   "the triangles at the edge are known");
    change(false, p, q, left);
    change(false, q, p, right);
    change(true, left, right, q);
    change(true, right, left, p);
  } else if constexpr (!PeriodicKineticTraits_2<Traits>) {  // a periodic box has no hull
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
  sort_triangles(changes);
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

// Calls function(end, apex) for the directed edges that begin at the point in the triangulation,
// until it returns true.
template <class Traits>
template <class Function>
void Recorder<Traits>::for_each_side(Point_id p, const Function& function) const {
  const auto& triangulation = triangulation_.triangulation();
  if (triangulation.dimension() < 2 || !triangulation_.contains(p)) return;
  if (triangulation_.is_hidden(p)) return;
  const auto vertex = triangulation_.vertex(p);
  const auto call = [&](auto face, int i) {
    // The infinite vertex has the id no_point.
    return function(corner_of<Corner>(face, triangulation.ccw(i), i),
                    corner_of<Corner>(face, triangulation.cw(i), i));
  };
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    for (const auto& [face, i] : triangulation.edges_opposite(vertex)) {
      if (call(face, i)) return;
    }
  } else {
    auto face = triangulation.incident_faces(vertex);
    const auto first = face;
    do {
      if (call(face, face->index(vertex))) return;
    } while (++face != first);
  }
}

// The apex of the triangle to the left of pq in the triangulation; its id is no_point if there is
// none. The point p is not moved.
template <class Traits>
auto Recorder<Traits>::apex_now(const Corner& p, const Corner& q) const -> Corner {
  Corner result = ends<Corner>({no_point, no_point}, {})[0];
  for_each_side(detail::id_of(p), [&](const Corner& end, const Corner& apex) {
    if (end != q) return false;
    result = apex;
    return true;
  });
  return result;
}

// Both directed edges of a pair; in a periodic box all that there are now, or have been recorded.
template <class Traits>
auto Recorder<Traits>::directed(const Edge_ids& pair) const -> std::vector<Directed> {
  if constexpr (!PeriodicKineticTraits_2<Traits>) {
    return {pair, {pair[1], pair[0]}};
  } else {
    std::vector<Directed> result;
    for (const Edge_ids& ends : {pair, Edge_ids{pair[1], pair[0]}}) {
      const Point_id p = ends[0];
      const Point_id q = ends[1];
      const auto add = [&](const Corner& end, const Corner& /*apex*/) {
        if (end.id == q) result.push_back({Corner{p, {}}, end});
        return false;
      };
      for (const auto& side : triangles_.sides(p)) add(side.end, side.apex);
      for_each_side(p, add);
    }
    return result;
  }
}

// The triangles that have changed since they were recorded, removed ones first, found by a search
// from the edges over changed triangles.
template <class Traits>
std::vector<Recorded_triangle> Recorder<Traits>::changed_triangles(
    std::span<const Edge_ids> edges) const {
  std::vector<Directed> sides;  // each begins at a point that is not moved
  const auto add_side = [&sides](const Corner& p, const Corner& q) {
    const Lattice_offset_2 offset = detail::offset_of(p);
    sides.push_back({detail::seen_from(offset, p), detail::seen_from(offset, q)});
  };
  for (const Edge_ids& pair : edges) {
    for (const auto& [p, q] : directed(pair)) add_side(p, q);
  }
  std::set<Directed> seen;
  const auto order = [](const Recorded_triangle& a, const Recorded_triangle& b) {
    return std::tie(a.is_added, a.corners, a.offsets) < std::tie(b.is_added, b.corners, b.offsets);
  };
  std::set<Recorded_triangle, decltype(order)> changes(order);
  while (!sides.empty()) {
    const auto [p, q] = sides.back();
    sides.pop_back();
    if (!seen.insert({p, q}).second) continue;
    const Corner before = triangles_.apex(p, q);
    const Corner after = apex_now(p, q);
    if (before == after) continue;
    for (const bool is_added : {false, true}) {
      const Corner& apex = is_added ? after : before;
      if (detail::id_of(apex) == no_point) continue;
      changes.insert(recorded(0, is_added, p, q, apex));
      add_side(q, apex);
      add_side(apex, p);
    }
  }
  return {changes.begin(), changes.end()};
}

// Adds the changes to the last row.
template <class Traits>
void Recorder<Traits>::record_triangles(std::span<const Recorded_triangle> changes) {
  for (const Recorded_triangle& triangle : changes) {
    const auto corners = corners_of<Corner>(triangle);
    triangle.is_added ? triangles_.insert(corners) : triangles_.erase(corners);
    recording_.triangles.push_back(triangle);
    recording_.triangles.back().event = recording_.events.size() - 1;
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
  recording_.periodic_box = result.periodic_box;
  result.until = recording_.from = triangulation_.current_time().to_double();
  return result;
}

template class Recorder<Linear_kinetic_traits_2>;
template class Recorder<Polynomial_kinetic_traits_2>;
template class Recorder<Disc_kinetic_traits_2>;
template class Recorder<Polynomial_disc_kinetic_traits_2>;
#ifndef KINETRI_WITHOUT_PERIODIC_BOXES
template class Recorder<Periodic_kinetic_traits_2>;
template class Recorder<Periodic_disc_kinetic_traits_2>;
#endif

}  // namespace kinetri
