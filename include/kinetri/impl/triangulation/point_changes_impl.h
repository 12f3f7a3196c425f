// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_POINT_CHANGES_IMPL_H

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
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
    Vertex_changes planned = plan(changes);
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

template <class Traits>
auto Kinetic_types<Traits>::Point_changes::plan(std::span<const Change> changes) -> Vertex_changes {
  Vertex_changes result;
  result.changes = changes;
  if (!topology_.twins().empty()) separate_twins(result);
  for (;;) {
    std::vector<Edge_ids> coincident;
    result.plan = plan_vertices(result.changes, coincident);
    if (coincident.empty()) return result;
    topology_.check_may_coincide(coincident);
    join_twins(coincident, result);
  }
}

// Replaces changes of twins by those of vertices. A twin that changes leaves its group; if a point
// that hides others changes, the one with the least id gets a vertex in its place.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::separate_twins(Vertex_changes& planned) const {
  const auto& twins = topology_.twins();
  std::vector<Point_id> changed;
  for (const Change& change : planned.changes) changed.push_back(change.point);
  std::ranges::sort(changed);
  for (const Change& change : planned.changes) {
    if (twins.contains(change.point)) {
      planned.separated.push_back(change.point);
      if (change.motion) planned.storage.push_back(change);
      continue;
    }
    planned.storage.push_back(change);
    for (const Point_id id : twins.hidden_by(change.point)) {
      if (std::ranges::binary_search(changed, id)) continue;
      planned.heirs.push_back(id);
      planned.storage.push_back({id, twins.twin(id).point.motion()});
      break;
    }
  }
  std::ranges::sort(planned.storage, {}, &Change::point);
  planned.changes = planned.storage;
}

// Of the vertices that would coincide after the changes, keeps the one with the least id; the
// others become twins.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::join_twins(std::span<const Edge_ids> coincident,
                                                      Vertex_changes& planned) const {
  Coincident_groups groups;
  for (const auto& [a, b] : coincident) groups.link(a, b);
  std::map<Point_id, Point_id> shown;
  for (const auto& [least, id] : groups.others()) shown.emplace(id, least);
  std::vector<Change> changes;
  for (const Change& change : planned.changes) {
    const auto joined = shown.find(change.point);
    if (joined == shown.end()) {
      changes.push_back(change);
    } else {
      planned.joined.push_back({Point_2(*change.motion, change.point), joined->second});
      if (topology_.has_vertex(change.point)) changes.push_back({change.point, std::nullopt});
      shown.erase(joined);
    }
  }
  for (const auto& [id, least] : shown) {
    planned.joined.push_back({topology_.point(id), least});
    changes.push_back({id, std::nullopt});
  }
  std::ranges::sort(changes, {}, &Change::point);
  planned.storage = std::move(changes);
  planned.changes = planned.storage;
}

// Plans changes of vertices. If points would coincide, appends some pairs of them to `coincident`,
// at least one; then the plan has no use.
template <class Traits>
auto Kinetic_types<Traits>::Point_changes::plan_vertices(std::span<const Change> changes,
                                                         std::vector<Edge_ids>& coincident)
    -> Plan {
  Plan result;
  result.moves = move_at_once(changes);
  if (result.moves) return result;
  find_changes_in_place(changes, result);
  if constexpr (is_weighted) find_coincident_in_place(changes, result.in_place, coincident);
  if (result.jumps.empty()) return result;
  constexpr std::size_t few = 8;
  if (triangulation_.dimension() < 2 ||
      result.jumps.size() > std::max(few, topology_.number_of_vertices() / few)) {
    result.rebuilt = updates_.build_now(points_after(changes), coincident);
  } else {
    sort_jumps(changes, result.jumps, coincident);
    locate_jumps(changes, result.jumps, coincident);
  }
  return result;
}

// Finds points that change in place and get the trajectory and weight of another point, of which at
// least one is hidden: two visible points have different positions.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::find_coincident_in_place(
    std::span<const Change> changes, std::span<const Change> in_place,
    std::vector<Edge_ids>& coincident) const {
  if constexpr (is_weighted) {
    if (topology_.number_of_hidden_vertices() == 0 || in_place.empty()) return;
    std::vector<Point_id> changed;
    for (const Change& change : changes) changed.push_back(change.point);
    std::ranges::sort(changed);
    for (const Change& change : in_place) {
      const Point_2 point(*change.motion, change.point);
      const Location location = topology_.locate(point, topology_.vertex(change.point)->face());
      topology_.find_coincident(point, location, changed, coincident);
    }
    std::vector<Jump> none;
    sort_jumps(changes, none, coincident);
  }
}

// Whether so many points change in place that all certificates are recomputed.
template <class Traits>
bool Kinetic_types<Traits>::Point_changes::should_schedule_all(std::size_t points) const {
  constexpr std::size_t few = 16;
  return points > few && points > topology_.number_of_vertices() / 4;
}

// Whether so many points change, and all of them stay vertices, that they move at once. If
// coincident points are refused, that would find them too late.
template <class Traits>
bool Kinetic_types<Traits>::Point_changes::move_at_once(std::span<const Change> changes) const {
  const auto stays = [&](const Change& change) {
    return change.motion && topology_.has_vertex(change.point);
  };
  return !topology_.refuses_twins() && triangulation_.dimension() == 2 &&
         should_schedule_all(changes.size()) && std::ranges::all_of(changes, stays);
}

// Separates points that change in place from the others. Meanwhile points have their new motions,
// one after the other. A hidden point jumps if a vertex does.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::find_changes_in_place(std::span<const Change> changes,
                                                                 Plan& plan) {
  std::vector<Point_2> before;
  const auto set = [&](const Change& change) {
    const Vertex_handle v = topology_.vertex(change.point);
    before.push_back(v->point());
    v->set_point(Point_2(*change.motion, change.point));
    plan.in_place.push_back(change);
  };
  const auto undo_last = [&] {
    topology_.vertex(plan.in_place.back().point)->set_point(before.back());
    plan.in_place.pop_back();
    before.pop_back();
  };
  const auto may_stay = [&](const Change& change) {
    return change.motion && topology_.has_vertex(change.point) && triangulation_.dimension() == 2;
  };
  before.reserve(changes.size());
  plan.in_place.reserve(changes.size());
  if (should_schedule_all(changes.size()) && std::ranges::all_of(changes, may_stay)) {
    for (const Change& change : changes) set(change);
    if (!Kinetic_types<Traits>::Static_construction::is_embedded(triangulation_,
                                                                 schedule_.current_time())) {
      while (!before.empty()) undo_last();
    }
  }
  if (plan.in_place.empty()) {
    for (const Change& change : changes) {
      if (may_stay(change)) {
        set(change);
        if (topology_.is_hidden(change.point) ||
            is_embedded_around(topology_.vertex(change.point))) {
          continue;
        }
        undo_last();
      }
      plan.jumps.push_back({change});
    }
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    topology_.vertex(plan.in_place[i].point)->set_point(before[i]);
  }
  if constexpr (is_weighted) {
    // Otherwise it might get the motion and weight of a vertex that is still there.
    const auto is_visible = [&](const Jump& jump) {
      return topology_.has_vertex(jump.change.point) && !topology_.is_hidden(jump.change.point);
    };
    if (std::ranges::none_of(plan.jumps, is_visible)) return;
    const auto hidden = std::stable_partition(
        plan.in_place.begin(), plan.in_place.end(),
        [&](const Change& change) { return !topology_.is_hidden(change.point); });
    for (auto change = hidden; change != plan.in_place.end(); ++change) {
      plan.jumps.push_back({*change});
    }
    plan.in_place.erase(hidden, plan.in_place.end());
  }
}

template <class Traits>
bool Kinetic_types<Traits>::Point_changes::is_embedded_around(Vertex_handle v) const {
  if constexpr (is_periodic) {
    bool is_embedded = true;
    for_each_face_at(triangulation_, v, [&](Face_handle face) {
      is_embedded = is_embedded && triangulation_.orientation(face) == CGAL::LEFT_TURN;
    });
    return is_embedded;
  } else {
    const auto orientation = triangulation_.geom_traits().orientation_2_object();
    return certification_.is_embedded_around(
        v, schedule_.current_bounds(), [&](Vertex_handle a, Vertex_handle b, Vertex_handle c) {
          return orientation(a->point(), b->point(), c->point()) == CGAL::LEFT_TURN;
        });
  }
}

// Finds changed points that would have one trajectory. Sorts the jumps so that near ones follow
// each other, as the vertices of a triangulation of the points.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::sort_jumps(std::span<const Change> changes,
                                                      std::vector<Jump>& jumps,
                                                      std::vector<Edge_ids>& coincident) const {
  std::vector<Point_2> changed;
  for (const Change& change : changes) {
    if (change.motion) changed.emplace_back(*change.motion, change.point);
  }
  if (changed.size() < 2) return;
  const Triangulation of_changed = updates_.build_now(changed, coincident);
  const auto id = [](const Jump& jump) { return jump.change.point; };
  std::ranges::sort(jumps, {}, id);
  std::vector<Jump> in_order;
  in_order.reserve(jumps.size());
  std::vector<bool> is_in_order;
  for (const Jump& jump : jumps) {
    if (!jump.change.motion) in_order.push_back(jump);
    is_in_order.push_back(!jump.change.motion);
  }
  for (const Vertex_handle v : of_changed.finite_vertex_handles()) {
    const auto jump = std::ranges::lower_bound(jumps, v->point().id(), {}, id);
    if (jump == jumps.end() || id(*jump) != v->point().id()) continue;
    in_order.push_back(*jump);
    is_in_order[static_cast<std::size_t>(jump - jumps.begin())] = true;
  }
  for (std::size_t i = 0; i < jumps.size(); ++i) {  // hidden among those that change
    if (!is_in_order[i]) in_order.push_back(jumps[i]);
  }
  jumps = std::move(in_order);
}

// Locates points that jump or are inserted, and finds those that would have the trajectory of an
// unchanged point. Precondition: dimension 2.
template <class Traits>
void Kinetic_types<Traits>::Point_changes::locate_jumps(std::span<const Change> changes,
                                                        std::span<Jump> jumps,
                                                        std::vector<Edge_ids>& coincident) const {
  std::vector<Point_id> changed;
  for (const Change& change : changes) changed.push_back(change.point);
  std::ranges::sort(changed);
  const auto changes_itself = [&](Vertex_handle v) {
    return std::ranges::binary_search(changed, v->point().id());
  };
  Face_handle near;  // the location of the point before
  for (Jump& jump : jumps) {
    const auto& [id, motion] = jump.change;
    if (!motion) continue;
    const Point_2 point(*motion, id);
    const auto face_near = [&] {
      return topology_.vertex_near(point, schedule_.current_time().to_double())->face();
    };
    jump.location = topology_.locate(point, near == Face_handle() ? face_near() : near);
    near = jump.location.face;
    if constexpr (is_weighted) {
      topology_.find_coincident(point, jump.location, changed, coincident);
    } else if (jump.location.locus == Triangulation::VERTEX) {
      const Vertex_handle there = near->vertex(jump.location.index);
      if (!changes_itself(there)) coincident.push_back(edge_ids(id, there->point().id()));
    }
    for (int k = 0; k < 3; ++k) {
      const Vertex_handle v = near->vertex(k);
      if (!triangulation_.is_infinite(v) && !changes_itself(v)) jump.near = v;
    }
  }
}

// The points after the changes, in the order of their ids.
template <class Traits>
auto Kinetic_types<Traits>::Point_changes::points_after(std::span<const Change> changes) const
    -> std::vector<Point_2> {
  std::vector<const Change*> change_of(topology_.vertices().size(), nullptr);
  for (const Change& change : changes) change_of[change.point] = &change;
  std::vector<Point_2> result;
  for (std::size_t id = 0; id < change_of.size(); ++id) {
    const Vertex_handle v = topology_.vertices()[id];
    if (const Change* const change = change_of[id]; change != nullptr) {
      if (change->motion) result.emplace_back(*change->motion, change->point);
    } else if (v != Vertex_handle()) {
      result.push_back(v->point());
    }
  }
  return result;
}

// ---- the changes ----

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

template <class Traits>
bool Kinetic_types<Traits>::Point_changes::repair(std::span<const Change> changes) {
  if constexpr (is_periodic) {
    if (topology_.are_weights_equal()) {
      return Torus_repair(topology_, schedule_, reporter_, updates_).move(changes);
    }
  } else if constexpr (has_library_geometry) {
    return From_places<Geometry>::move(topology_, reporter_.notes(), schedule_.current_time(),
                                       changes);
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
  if (should_schedule_all(changes.size())) {
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
      for_each_face_at(triangulation_, v, [&](Face_handle face) {
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
