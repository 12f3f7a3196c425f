// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_TRIANGULATION_CHANGE_PLANNER_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_CHANGE_PLANNER_IMPL_H

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/change_planner.h"
#include "kinetri/impl/triangulation/updates_impl.h"

namespace kinetri::detail {

template <class Traits>
auto Kinetic_types<Traits>::Change_planner::plan(std::span<const Change> changes)
    -> Vertex_changes {
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
void Kinetic_types<Traits>::Change_planner::separate_twins(Vertex_changes& planned) const {
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
void Kinetic_types<Traits>::Change_planner::join_twins(std::span<const Edge_ids> coincident,
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
auto Kinetic_types<Traits>::Change_planner::plan_vertices(std::span<const Change> changes,
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
void Kinetic_types<Traits>::Change_planner::find_coincident_in_place(
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

template <class Traits>
bool Kinetic_types<Traits>::Change_planner::should_schedule_all(std::size_t points) const {
  constexpr std::size_t few = 16;
  return points > few && points > topology_.number_of_vertices() / 4;
}

// Whether so many points change, and all of them stay vertices, that they move at once. If
// coincident points are refused, that would find them too late.
template <class Traits>
bool Kinetic_types<Traits>::Change_planner::move_at_once(std::span<const Change> changes) const {
  const auto stays = [&](const Change& change) {
    return change.motion && topology_.has_vertex(change.point);
  };
  return !topology_.refuses_twins() && triangulation_.dimension() == 2 &&
         should_schedule_all(changes.size()) && std::ranges::all_of(changes, stays);
}

// Separates points that change in place from the others. While it runs, the points examined so far
// have their new motions. If a vertex does not change in place, no hidden point does.
template <class Traits>
void Kinetic_types<Traits>::Change_planner::find_changes_in_place(std::span<const Change> changes,
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
bool Kinetic_types<Traits>::Change_planner::is_embedded_around(Vertex_handle v) const {
  const auto orientation = triangulation_.geom_traits().orientation_2_object();
  return certification_.is_embedded_around(v, schedule_.current_bounds(),
                                           [&](const auto& p, const auto& q, const auto& r) {
                                             return orientation(p, q, r) == CGAL::LEFT_TURN;
                                           });
}

// Finds changed points that would have one trajectory. Sorts the jumps so that near ones follow
// each other, as the vertices of a triangulation of the points.
template <class Traits>
void Kinetic_types<Traits>::Change_planner::sort_jumps(std::span<const Change> changes,
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
void Kinetic_types<Traits>::Change_planner::locate_jumps(std::span<const Change> changes,
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
auto Kinetic_types<Traits>::Change_planner::points_after(std::span<const Change> changes) const
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

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_CHANGE_PLANNER_IMPL_H
