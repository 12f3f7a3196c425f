// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_IMPL_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/change_planner_impl.h"
#include "kinetri/impl/triangulation/event_loop_impl.h"
#include "kinetri/impl/triangulation/kinetic_core.h"
#include "kinetri/impl/triangulation/point_changes.h"

namespace kinetri::detail {

template <class Traits>
void Kinetic_types<Traits>::Point_changes::change_all(Event_kind kind,
                                                      std::vector<Change> changes) {
  if (changes.empty()) return;
  if (!std::ranges::is_sorted(changes, {}, &Change::point)) {
    std::ranges::sort(changes, {}, &Change::point);
  }
  const auto twice = std::ranges::adjacent_find(changes, {}, &Change::point);
  KINETRI_PRECONDITION(twice == changes.end(), named_twice_problem(twice->point));
  std::vector<Event> events(reporter_.has_observers() ? changes.size() : 1);
  for (std::size_t i = 0; i < events.size(); ++i) {
    events[i].kind = kind;
    events[i].point_a = changes[i].point;
  }
  perform(events, changes);
  reporter_.count_events(kind, changes.size() - events.size());
}

template <class Traits>
Changed_edges Kinetic_types<Traits>::Point_changes::perform(std::span<const Event> events,
                                                            std::span<const Change> changes) {
  Changed_edges links;
  schedule_.with_time_of_errors([&] {
    Vertex_changes planned = planner_.plan(changes);
    if constexpr (is_weighted) note_weights(planned);
    reporter_.report(events.front(), [&] {
      reporter_.start_noting();
      note_separated(planned);
      make(planned);
      if (!schedule_.is_deferred()) loop_.execute_due_events();
      links = set_twins(planned);
    });
  });
  reporter_.report_happened(events.subspan(1));
  // A link may have the ends of an edge that is added or removed. In a periodic box a simulation of
  // discs has none.
  if constexpr (!is_periodic) {
    for (const Edge_ids& link : links.removed) reporter_.trail({link, std::nullopt});
  }
  Changed_edges result = reporter_.report_edges();
  if constexpr (!is_periodic) {
    for (const Edge_ids& link : links.added) reporter_.trail({std::nullopt, link});
  }
  reporter_.report_hiding();
  return result;
}

// ---- the plan ----

// Notes whether all weights are still equal: after the changes, and while these are made one after
// the other, when some points have weights from before.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::note_weights(const Vertex_changes& planned) {
  if (!topology_.are_weights_equal()) return;
  const std::span<const Change> changes = planned.changes;
  const Plan& plan = planned.plan;
  const bool are_at_once = plan.rebuilt || (plan.jumps.empty() && !plan.moves);
  std::vector<Point_2> points;
  for (const Change& change : changes) {
    if (change.motion) points.emplace_back(*change.motion, change.point);
  }
  // One point whose present weight counts too, if there is any.
  const auto counts = [&](Vertex_handle v) {
    return v != Vertex_handle() &&
           (!are_at_once ||
            std::ranges::find(changes, v->point().id(), &Change::point) == changes.end());
  };
  const auto other = std::ranges::find_if(topology_.vertices(), counts);
  if (other != topology_.vertices().end()) points.push_back((*other)->point());
  topology_.set_weights_equal(Topology::have_equal_weights(points));
}

// Notes that twins which leave their group are not hidden by it any more.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::note_separated(const Vertex_changes& planned) {
  for (const auto& list : {planned.separated, planned.heirs}) {
    for (const Point_id id : list) {
      reporter_.note_hidden(id, false, topology_.twins().twin(id).shown);
    }
  }
}

// Updates the groups of twins, when the vertices have been changed. Returns the changes of the
// links between twins and the points that hide them.
template <class Traits>
Changed_edges Kinetic_types<Traits>::Point_changes::set_twins(const Vertex_changes& planned) {
  auto& twins = topology_.twins();
  std::map<Point_id, std::optional<Point_id>> shown_before;  // of points whose groups may change
  const auto note = [&](Point_id id) {
    shown_before[id] = twins.contains(id) ? std::optional(twins.twin(id).shown) : std::nullopt;
  };
  for (const Point_id id : planned.separated) note(id);
  for (const Point_id id : planned.heirs) {
    for (const Point_id other : twins.hidden_by(twins.twin(id).shown)) note(other);
  }
  for (const Joined& joined : planned.joined) {
    note(joined.point.id());
    for (const Point_id other : twins.hidden_by(joined.point.id())) note(other);
  }
  for (const Point_id id : planned.separated) twins.take_out(id);
  for (const Point_id id : planned.heirs) twins.show(id);
  for (const Joined& joined : planned.joined) twins.hide(joined.point, joined.shown);
  // Only now: the point that hides one may have become a twin itself.
  for (const Joined& joined : planned.joined) {
    const Point_id id = joined.point.id();
    reporter_.note_hidden(id, true, twins.twin(id).shown);
  }
  Changed_edges links;
  for (const auto& [id, before] : shown_before) {
    reporter_.note_moved_hidden(id);
    const auto now = twins.contains(id) ? std::optional(twins.twin(id).shown) : std::nullopt;
    if (now == before) continue;
    if (before) links.removed.push_back({*before, id});
    if (now) links.added.push_back({*now, id});
  }
  return links;
}

template <class Traits>
void Kinetic_types<Traits>::Point_changes::make(Vertex_changes& planned) {
  const std::span<const Change> changes = planned.changes;
  Plan& plan = planned.plan;
  if (plan.moves) return move(planned);
  const auto set_points = [&] {
    for (const Change& change : changes) set_point(change);
  };
  if (plan.rebuilt) return updates_.rebuild(set_points, std::move(plan.rebuilt));
  schedule_.schedule_deferred();
  // Hidden points leave first: a point that changes in place may get the motion and weight of one.
  const auto is_hidden = [&](const Jump& jump) {
    return topology_.has_vertex(jump.change.point) && topology_.is_hidden(jump.change.point);
  };
  const std::span<const Jump> jumps = plan.jumps;
  const auto others = is_weighted
                          ? std::stable_partition(plan.jumps.begin(), plan.jumps.end(), is_hidden)
                          : plan.jumps.begin();
  const auto hidden = static_cast<std::size_t>(others - plan.jumps.begin());
  take_out(jumps.first(hidden));
  change_in_place(plan.in_place);
  if (jumps.empty()) return;
  // Removing a vertex requires a Delaunay triangulation.
  if (loop_.execute_due_events_within(set_points)) return;
  if (!take_out(jumps.subspan(hidden))) return updates_.rebuild(set_points);
  // On a torus with weights that leaves edges that fail now, and searches would not end.
  if (is_periodic && is_weighted && loop_.execute_due_events_within(set_points)) return;
  put_in(jumps, plan.in_place.empty());
}

// Moves all points. If that fails, constructs the triangulation, without the points that coincide
// with others.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::move(Vertex_changes& planned) {
  updates_.show_current_time();
  if (repair(planned.changes)) return schedule_.defer();
  std::vector<Point_2> points = topology_.points();
  std::vector<Edge_ids> coincident;
  Triangulation rebuilt = updates_.build_now(points, coincident);
  while (!coincident.empty()) {
    Coincident_groups groups;
    for (const auto& [a, b] : coincident) groups.link(a, b);
    std::vector<Point_id> others;  // sorted
    for (const auto& [least, id] : groups.others()) {
      planned.joined.push_back({topology_.point(id), least});
      others.push_back(id);
    }
    std::erase_if(points, [&](const Point_2& point) {
      return std::ranges::binary_search(others, point.id());
    });
    coincident.clear();
    rebuilt = updates_.build_now(points, coincident);
  }
  const auto remove_joined = [&] {
    for (const Joined& joined : planned.joined) set_point({joined.point.id(), std::nullopt});
  };
  updates_.rebuild(remove_joined, std::move(rebuilt));
}

// Returns false if the triangulation must be constructed. After many events that is done to have
// neighbors near each other in memory: else steps take up to twice as long.
template <class Traits>
bool Kinetic_types<Traits>::Point_changes::repair(std::span<const Change> changes) {
  constexpr std::size_t events_per_point = 32;
  if (updates_.events_since_construction() <= events_per_point * topology_.number_of_vertices()) {
    if constexpr (is_periodic) {
      if (topology_.are_weights_equal()) {
        return Repair(topology_, reporter_.notes(), schedule_.current_time()).move(changes);
      }
    } else if constexpr (has_library_geometry) {
      return From_places<Geometry>::move(topology_, reporter_.notes(), schedule_.current_time(),
                                         changes);
    }
  }
  for (const Change& change : changes) topology_.set_point(change);
  return false;
}

// Changes the vertex of a point before a reconstruction.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::set_point(const Change& change) {
  const Point_id id = change.point;
  if (!change.motion && topology_.has_vertex(id) && topology_.is_hidden(id)) {
    reporter_.note_hidden(id, false);
  }
  topology_.set_point(change);
}

template <class Traits>
void Kinetic_types<Traits>::Point_changes::change_in_place(std::span<const Change> changes) {
  if (planner_.should_schedule_all(changes.size())) {
    schedule_.queue().clear();
    for (const Change& change : changes) topology_.set_point(change);
    return schedule_.schedule_all();
  }
  if constexpr (has_region_runs<Traits> && !is_weighted) {
    constexpr std::size_t changes_per_region = 8;  // for fewer, one thread is as fast
    if (schedule_.queue().is_divided() &&
        changes.size() >= changes_per_region * number_of_regions(schedule_.division())) {
      return Region_runs<Traits>::change_in_place(core_, changes);
    }
  }
  // Each edge once, even if it is at several of the points.
  std::vector<Edge_with_mirror> edges;
  edges.reserve(16 * changes.size());
  std::vector<Vertex_handle> hidden;
  for (const Change& change : changes) {
    const Vertex_handle v = topology_.vertex(change.point);
    if constexpr (is_weighted) {
      const auto add = [&](Vertex_handle h) {
        schedule_.unschedule_hidden(h);
        hidden.push_back(h);
      };
      if (v->is_hidden()) {
        add(v);
        continue;
      }
      for_each_face_at(topology_.triangulation(), v, [&](Face_handle face) {
        for (const Vertex_handle h : face->vertex_list()) add(h);
      });
    }
    schedule_.unschedule_around(v, edges, reporter_.counters());
  }
  for (const Change& change : changes) topology_.set_point(change);
  schedule_.schedule(edges, schedule_.current_time());
  if constexpr (is_weighted) {
    for (const Vertex_handle h : hidden) {
      if (h->event() == no_event) schedule_.schedule_hidden(h, schedule_.current_time());
    }
  }
}

// Removes the points that jump or are erased. Returns false if only collinear points would be left:
// then the caller sets the points and rebuilds.
template <class Traits>
bool Kinetic_types<Traits>::Point_changes::take_out(std::span<const Jump> jumps) {
  for (const auto& [change, location, near] : jumps) {
    const Vertex_handle v = topology_.vertex(change.point);
    if (v == Vertex_handle()) continue;
    if (!topology_.is_hidden(change.point) && !topology_.can_take_out(v)) return false;
    if (!updates_.take_out(v)) return false;
    if (!change.motion) topology_.set_point(change);
  }
  return true;
}

// Inserts the points that jump or are new. `are_located`: nothing has changed since the points were
// located, unless points have been removed.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::put_in(std::span<const Jump> jumps, bool are_located) {
  for (const Jump& jump : jumps) {
    if (topology_.has_vertex(jump.change.point) || !jump.change.motion) are_located = false;
    if (jump.change.motion) topology_.set_point(jump.change);
  }
  const std::uint64_t reconstructions = reporter_.counters().reconstructions;
  for (const auto& [change, location, near] : jumps) {
    if (!change.motion) continue;
    const Vertex_handle v = topology_.vertex(change.point);
    const Face_handle start = near == Vertex_handle() ? Face_handle() : near->face();
    const Location there = are_located ? location : topology_.locate(v->point(), start);
    if (!place(v, there)) loop_.rebuild();
    loop_.execute_due_events();
    // A rebuilt triangulation has all points; it is rebuilt, for example, if a point hides a
    // lighter one at its position.
    if (reporter_.counters().reconstructions != reconstructions) return;
    are_located = false;
  }
}

// Inserts a vertex without faces. Returns false if the triangulation must be rebuilt.
template <class Traits>
bool Kinetic_types<Traits>::Point_changes::place(Vertex_handle v, const Location& location) {
  if constexpr (is_weighted) {
    return Hidden_events(topology_, schedule_, reporter_, updates_).place(v, location);
  } else {
    updates_.put_in(v, location);
    return true;
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_IMPL_H
