// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a kinetic triangulation reports to its observers, and counts.
#ifndef KINETRI_IMPL_TRIANGULATION_EVENT_REPORTER_H
#define KINETRI_IMPL_TRIANGULATION_EVENT_REPORTER_H

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/base/flag_while.h"
#include "kinetri/impl/events/observer_list.h"
#include "kinetri/impl/triangulation/edge_changes.h"
#include "kinetri/impl/triangulation/schedule.h"
#include "kinetri/triangulation/triangulation_counters.h"

namespace kinetri::detail {

/// The event of a flip in a periodic box, without number and time.
inline Event flip_event(Event_kind kind,
                        const std::pair<Periodic_edge, Periodic_edge>& removed_and_added) {
  const auto& [removed, added] = removed_and_added;
  Event event;
  event.kind = kind;
  event.removed = removed.ids;
  event.removed_offset = removed.offset;
  event.added = added.ids;
  event.added_offset = added.offset;
  return event;
}

/// The event of a flip in the plane. The infinite vertex has the id no_point.
inline Event flip_event(Event_kind kind, const std::pair<Edge_ids, Edge_ids>& removed_and_added) {
  Event event;
  event.kind = kind;
  for (const auto& [ids, edge] : {std::pair(removed_and_added.first, &event.removed),
                                  {removed_and_added.second, &event.added}}) {
    // The finite end of an infinite edge: no_point is the greater id.
    if (ids[1] == no_point) {
      event.apex = ids[0];
    } else {
      *edge = ids;
    }
  }
  return event;
}

/// Edges, and links of twins with the points that hide them, added and removed in that order; and
/// hidden points that may have other triangles now. In a periodic box links have no names.
template <class Edge_name>
struct Basic_edge_trail {
  struct Step {
    std::optional<Edge_name> removed;
    std::optional<Edge_name> added;
  };
  std::vector<Step> edges;
  std::vector<Point_id> hidden;
};
using Edge_trail = Basic_edge_trail<Edge_ids>;  ///< in the plane

/// Observers, counts, and edges that are reported together.
///
/// While edges are noted, no event is reported; at the end their net changes are, as `rebuild`
/// events.
template <class Traits>
class Kinetic_types<Traits>::Event_reporter {
 public:
  using Edge_trail = Basic_edge_trail<Edge_name>;

  /// The others must outlive this object.
  Event_reporter(const Topology& topology, const Schedule& schedule,
                 Triangulation_counters& counters)
      : topology_(topology), schedule_(schedule), counters_(counters) {}
  Event_reporter(const Event_reporter&) = delete;
  Event_reporter& operator=(const Event_reporter&) = delete;

  // ---- reentrancy ----

  /// Throws Precondition_error within another change, or if an observer has thrown.
  void check_may_change() const {
    KINETRI_PRECONDITION(!is_changing_,
                         "a change of the triangulation within an event, or while another change "
                         "is made; make it when advance_to, step or the other change has returned");
    KINETRI_PRECONDITION(!is_in_event_,
                         "an exception has left the triangulation within an event; make another "
                         "one, or restore a snapshot");
  }
  [[nodiscard]] Flag_while start_change() {
    check_may_change();
    return Flag_while(is_changing_);
  }
  /// Whether an event is reported, or edges are noted.
  bool is_in_event() const { return is_in_event_ || notes_.edges.has_value(); }
  /// Sets whether an event is reported, for code that calls observers itself; stays true if one
  /// throws.
  void set_in_event(bool is_in_event) { is_in_event_ = is_in_event; }
  /// Calls a function within an event, in which the triangulation stays if that throws.
  template <class Function>
  void within_event(const Function& function) {
    const bool was_in_event = std::exchange(is_in_event_, true);
    function();
    is_in_event_ = was_in_event;
  }

  // ---- events ----

  Observer_list<Event_observer>& observers() { return observers_; }
  const Observer_list<Event_observer>& observers() const { return observers_; }
  Triangulation_counters& counters() { return counters_; }

  bool has_observers() const { return !observers_.empty(); }
  /// Whether events or edges must be reported or noted; else counting is enough.
  bool has_listeners() const { return notes_.edges || keeps_trail_ || !observers_.empty(); }

  /// From now on keeps added and removed edges and links for the owner of the triangulation.
  void keep_trail() { keeps_trail_ = true; }
  Edge_trail take_trail() { return std::exchange(trail_, {}); }
  void trail(const typename Edge_trail::Step& step) {
    if (keeps_trail_) trail_.edges.push_back(step);
  }

  /// Calls change(), which executes the event, and observers before and after it. While edges are
  /// noted, only notes the edges of the event.
  template <class Change>
  void report(Event event, const Change& change) {
    if (notes_.edges) {
      if (event.removed) notes_.edges->note(named(*event.removed, event.removed_offset), -1);
      if (event.added) notes_.edges->note(named(*event.added, event.added_offset), 1);
      return change();
    }
    event.number = counters_.number_of_events();
    if (!observers_.empty()) event.time = schedule_.current_time();
    within_event([&] {
      observers_.call([&](Event_observer& observer) { observer.before_event(event); });
      change();
      count_event(event.kind);
      if (event.removed || event.added) {
        trail({named(event.removed, event.removed_offset), named(event.added, event.added_offset)});
      }
      observers_.call([&](Event_observer& observer) { observer.after_event(event); });
    });
  }

  /// Reports that change() hides or reveals a point, and the edges that this adds or removes.
  template <class Change>
  void report_point(Event_kind kind, Point_id point, const Change& change) {
    if (notes_.edges) {
      note_hidden(point, kind == Event_kind::hide);
      return change();
    }
    Event event;
    event.kind = kind;
    event.point_a = point;
    report(event, [&] {
      notes_.edges.emplace();
      change();
    });
    report_edges();
  }

  /// Reports events that have happened already, also while edges are noted.
  void report_happened(std::span<const Event> events) {
    auto edges = std::exchange(notes_.edges, std::nullopt);
    for (const Event& event : events) report(event, [] {});
    notes_.edges = std::move(edges);
  }

  void count_event(Event_kind kind) { count_events(kind, 1); }
  void count_events(Event_kind kind, std::size_t number) {
    counters_.events[static_cast<std::size_t>(kind)] += number;
    events_in_instant_ += number;
  }
  void begin_instant() { events_in_instant_ = 0; }
  std::uint64_t events_in_instant() const { return events_in_instant_; }

  // ---- edges that are reported together ----

  bool is_noting() const { return notes_.edges.has_value(); }
  /// Notes edges from now on, until report_edges().
  void start_noting() {
    if (!notes_.edges) notes_.edges.emplace();
  }
  /// @{
  /// As those of notes().
  void note(const Edge_name& edge, int change) { notes_.note(edge, change); }
  void note_hidden(Point_id point, bool is_hidden, std::optional<Point_id> by = std::nullopt) {
    notes_.note_hidden(point, is_hidden, by);
  }
  void note_moved_hidden(Point_id point) { notes_.note_moved_hidden(point); }
  /// @}
  Change_notes<Edge_name>& notes() { return notes_; }

  /// If edges are noted, ends that: reports the net changes of hidden points and edges, then all
  /// edges that were touched (after_rebuild). Returns the net changes of edges.
  Changed_edges report_edges();
  /// Reports which hidden points may have other triangles (after_hiding).
  void report_hiding();

 private:
  void report_points();
  static Edge_name named(const Edge_ids& ids, [[maybe_unused]] Lattice_offset_2 offset) {
    if constexpr (is_periodic) {
      return {ids, offset};
    } else {
      return ids;
    }
  }

  static std::optional<Edge_name> named(const std::optional<Edge_ids>& ids,
                                        Lattice_offset_2 offset) {
    return ids ? std::optional(named(*ids, offset)) : std::nullopt;
  }

  const Topology& topology_;
  const Schedule& schedule_;
  Triangulation_counters& counters_;
  Observer_list<Event_observer> observers_;
  Change_notes<Edge_name> notes_;
  Edge_trail trail_;
  bool keeps_trail_ = false;
  std::uint64_t events_in_instant_ = 0;
  bool is_changing_ = false;  // during a function that changes the triangulation
  bool is_in_event_ = false;
};

template <class Traits>
void Kinetic_types<Traits>::Event_reporter::report_points() {
  auto points = std::exchange(notes_.points, {});
  std::ranges::stable_sort(points, {}, &Change_notes<Edge_name>::Hiding::point);
  for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
    const auto& [id, is_hidden, by] = points[first];
    while (last < points.size() && points[last].point == id) ++last;
    // Changes alternate.
    if ((last - first) % 2 == 0 || !topology_.contains(id)) continue;
    Event event;
    event.kind = is_hidden ? Event_kind::hide : Event_kind::reveal;
    event.point_a = id;
    event.point_b = is_hidden ? points[last - 1].by : by;
    report(event, [] {});
  }
}

template <class Traits>
Changed_edges Kinetic_types<Traits>::Event_reporter::report_edges() {
  Changed_edges result;
  if (!notes_.edges) return result;
  const auto changes = notes_.edges->take();
  notes_.edges.reset();
  report_points();
  const bool are_heard = has_listeners();
  const auto report_all = [&](int net, std::optional<Edge_ids> Event::*edge,
                              Lattice_offset_2 Event::*offset, std::vector<Edge_ids>& ids) {
    for (const auto& change : changes) {
      if (change.net != net) continue;
      ids.push_back(ids_of(change.edge));
      if (!are_heard) continue;
      Event event;
      event.kind = Event_kind::rebuild;
      event.*edge = ids.back();
      event.*offset = offset_of(change.edge);
      report(event, [] {});
    }
    if (!are_heard) count_events(Event_kind::rebuild, ids.size());
  };
  report_all(-1, &Event::removed, &Event::removed_offset, result.removed);
  report_all(1, &Event::added, &Event::added_offset, result.added);
  if (observers_.empty()) return result;
  std::vector<Edge_ids> touched;
  for (const auto& change : changes) {
    if (touched.empty() || touched.back() != ids_of(change.edge)) {
      touched.push_back(ids_of(change.edge));
    }
  }
  within_event([&] {
    observers_.call([&](Event_observer& observer) {
      observer.after_rebuild(schedule_.current_time(), touched);
    });
  });
  return result;
}

template <class Traits>
void Kinetic_types<Traits>::Event_reporter::report_hiding() {
  if (notes_.moved_hidden.empty()) return;
  std::vector<Point_id> points = std::exchange(notes_.moved_hidden, {});
  if (observers_.empty() && !keeps_trail_) return;
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (keeps_trail_) trail_.hidden.insert(trail_.hidden.end(), points.begin(), points.end());
  within_event([&] {
    observers_.call(
        [&](Event_observer& observer) { observer.after_hiding(schedule_.current_time(), points); });
  });
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_EVENT_REPORTER_H
