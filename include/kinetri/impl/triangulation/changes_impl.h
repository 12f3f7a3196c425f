// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2: changes of points at the present time. The edges
// that a change leaves violated have their events at the present time, and are flipped by these
// (docs/MATH.md, section 5).
#ifndef KINETRI_IMPL_TRIANGULATION_CHANGES_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_CHANGES_IMPL_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/impl/triangulation/region_runs.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

// ---- changes ----

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_motion(Point_id id, const Motion& motion) {
  const Change change = {id, motion};
  apply(Event_kind::trajectory, id, std::nullopt, {&change, 1});
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::erase(Point_id id) {
  const Change change = {id, std::nullopt};
  apply(Event_kind::erase, id, std::nullopt, {&change, 1});
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::apply(Event_kind kind, std::optional<Point_id> point_a,
                                            std::optional<Point_id> point_b,
                                            std::span<const Change> changes) {
  const detail::Flag_while changing = start_change();
  for (const auto& [id, motion] : changes) {
    KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
    KINETRI_PRECONDITION(!motion || is_finite(*motion), detail::not_finite_problem(id));
  }
  Event event;
  event.kind = kind;
  event.point_a = point_a;
  event.point_b = point_b;
  perform({&event, 1}, changes);
}

template <KineticTraits_2 Traits>
Point_id Kinetic_triangulation_2<Traits>::reserve_id() {
  const detail::Flag_while changing = start_change();
  return give_id();
}

template <KineticTraits_2 Traits>
Point_id Kinetic_triangulation_2<Traits>::give_id() {
  KINETRI_PRECONDITION(vertices_.size() + 1 < no_point, detail::too_many_points);
  vertices_.emplace_back();
  return static_cast<Point_id>(vertices_.size() - 1);
}

template <KineticTraits_2 Traits>
Point_id Kinetic_triangulation_2<Traits>::insert(const Motion& motion) {
  return insert(std::span(&motion, 1));
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::insert(const Motion& motion, Point_id id) {
  const detail::Flag_while changing = start_change();
  KINETRI_PRECONDITION(id < vertices_.size() && !contains(id),
                       "the id " + std::to_string(id) +
                           " is not one that waits for its point; take one that reserve_id gives");
  KINETRI_PRECONDITION(is_finite(motion), detail::not_finite_problem(id));
  change_all(Event_kind::insert, {{id, motion}});
}

// ---- changes of many points ----

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_motions(std::span<const Point_id> ids,
                                                  std::span<const Motion> motions) {
  const detail::Flag_while changing = start_change();
  KINETRI_PRECONDITION(ids.size() == motions.size(), std::to_string(ids.size()) + " ids and " +
                                                         std::to_string(motions.size()) +
                                                         " motions; expected a motion for each id");
  std::vector<Change> changes;
  changes.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(contains(ids[i]), detail::unknown_id_problem(ids[i]));
    KINETRI_PRECONDITION(is_finite(motions[i]), detail::not_finite_problem(ids[i]));
    changes.push_back({ids[i], motions[i]});
  }
  change_all(Event_kind::trajectory, std::move(changes));
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_velocities(std::span<const Point_id> ids,
                                                     std::span<const Vector_2> velocities) requires
    MotionWithVelocity_2<Motion> {
  detail::check_velocities(ids, velocities);
  const double now = current_time().to_double();
  std::vector<Motion> motions;
  motions.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(contains(ids[i]), detail::unknown_id_problem(ids[i]));
    motions.push_back(with_velocity_at(motion(ids[i]), velocities[i], now));
  }
  set_motions(ids, motions);
}

template <KineticTraits_2 Traits>
Point_id Kinetic_triangulation_2<Traits>::insert(std::span<const Motion> motions) {
  const detail::Flag_while changing = start_change();
  const auto first = next_id();
  KINETRI_PRECONDITION(motions.size() < no_point - vertices_.size(), detail::too_many_points);
  std::vector<Change> changes;
  changes.reserve(motions.size());
  for (const Motion& motion : motions) {
    const auto id = static_cast<Point_id>(first + changes.size());
    KINETRI_PRECONDITION(is_finite(motion), detail::not_finite_problem(id));
    changes.push_back({id, motion});
  }
  vertices_.resize(vertices_.size() + motions.size());
  try {
    change_all(Event_kind::insert, std::move(changes));
  } catch (const Coincident_trajectories_error&) {
    vertices_.resize(first);
    throw;
  }
  return first;
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::erase(std::span<const Point_id> ids) {
  const detail::Flag_while changing = start_change();
  std::vector<Change> changes;
  changes.reserve(ids.size());
  for (const Point_id id : ids) {
    KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
    changes.push_back({id, std::nullopt});
  }
  change_all(Event_kind::erase, std::move(changes));
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::change_all(Event_kind kind, std::vector<Change> changes) {
  if (changes.empty()) return;
  std::ranges::sort(changes, {}, &Change::point);
  const auto twice = std::ranges::adjacent_find(changes, {}, &Change::point);
  KINETRI_PRECONDITION(twice == changes.end(), "point " + std::to_string(twice->point) +
                                                   " is named twice; expected each point once");
  std::vector<Event> events(changes.size());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    events[i].kind = kind;
    events[i].point_a = changes[i].point;
  }
  perform(events, changes);
}

// Makes the changes and the flips that they make necessary, and reports the events, then the edges
// that have changed. What is refused is refused before anything is reported or changed.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::perform(std::span<const Event> events,
                                              std::span<const Change> changes) {
  Change_plan planned = plan(changes);
  if constexpr (is_weighted) note_weights(changes);
  report(events.front(), [&] {
    rebuilt_edges_.emplace();
    make_changes(changes, planned);
    execute_due_events();
  });
  auto edges = std::exchange(rebuilt_edges_, std::nullopt);
  for (const Event& event : events.subspan(1)) report(event, [] {});
  rebuilt_edges_ = std::move(edges);
  report_rebuild();
  report_hiding();
}

// How the changes are to be made. Throws if two points would have one trajectory.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::plan(std::span<const Change> changes) -> Change_plan {
  Change_plan result;
  find_turns(changes, result);
  if constexpr (is_weighted) check_turns_are_new(changes, result.turns);
  if (result.jumps.empty()) return result;
  constexpr std::size_t few = 8;
  if (triangulation_.dimension() < 2 ||
      result.jumps.size() > std::max(few, number_of_points_ / few)) {
    result.rebuilt = build_now(points_after(changes));
  } else {
    check_are_distinct(changes, result.jumps);
    locate_jumps(changes, result.jumps);
  }
  return result;
}

// Throws if a point that turns would have the trajectory and the weight of a hidden point, or is
// hidden itself and would have those of any point. Two points that have edges are in two places.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::check_turns_are_new(std::span<const Change> changes,
                                                          std::span<const Change> turns) const {
  if constexpr (is_weighted) {
    if (triangulation_.number_of_hidden_vertices() == 0 || turns.empty()) return;
    std::vector<Point_id> changed;
    for (const Change& change : changes) changed.push_back(change.point);
    std::ranges::sort(changed);
    for (const Change& change : turns) {
      const Point_2 point(*change.motion, change.point);
      const Location location = locate(point, vertices_[change.point]->face());
      hidden_points().check_is_new(point, location, changed);
    }
    std::vector<Jump> none;
    check_are_distinct(changes, none);
  }
}

// Whether so many points turn that everything is looked at anew.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::are_most(std::size_t points) const {
  constexpr std::size_t few = 16;
  return points > few && points > number_of_points_ / 4;
}

// Tells points that turn, so that only certificates change, from those that jump, come or go. The
// points turn one after the other, for as long as this looks at them.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::find_turns(std::span<const Change> changes,
                                                 Change_plan& plan) {
  std::vector<Point_2> before;
  const auto turn = [&](const Change& change) {
    const Vertex_handle v = vertices_[change.point];
    before.push_back(v->point());
    v->set_point(Point_2(*change.motion, change.point));
    plan.turns.push_back(change);
  };
  const auto undo_last = [&] {
    vertices_[plan.turns.back().point]->set_point(before.back());
    plan.turns.pop_back();
    before.pop_back();
  };
  const auto may_turn = [&](const Change& change) {
    return change.motion && contains(change.point) && triangulation_.dimension() == 2;
  };
  before.reserve(changes.size());
  plan.turns.reserve(changes.size());
  if (are_most(changes.size()) && std::ranges::all_of(changes, may_turn)) {
    for (const Change& change : changes) turn(change);
    if (!is_embedded(triangulation_, places_now())) {
      while (!before.empty()) undo_last();
    }
  }
  if (plan.turns.empty()) {
    for (const Change& change : changes) {
      if (may_turn(change)) {
        turn(change);
        if (is_hidden(change.point) || is_embedded_around(vertices_[change.point])) continue;
        undo_last();
      }
      plan.jumps.push_back({change});
    }
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    vertices_[plan.turns[i].point]->set_point(before[i]);
  }
}

// Throws if two of the points that change would have one trajectory. Puts the jumps into an order
// in which near ones follow one another: that of the vertices of a triangulation of the points.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::check_are_distinct(std::span<const Change> changes,
                                                         std::vector<Jump>& jumps) const {
  std::vector<Point_2> changed;
  for (const Change& change : changes) {
    if (change.motion) changed.emplace_back(*change.motion, change.point);
  }
  if (changed.size() < 2) return;
  const Triangulation of_changed = build_now(changed);
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

// Finds where the points come that jump or come. Throws if one would have the trajectory of another
// point, which does not change. Precondition: dimension 2.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::locate_jumps(std::span<const Change> changes,
                                                   std::span<Jump> jumps) const {
  std::vector<Point_id> changed;
  for (const Change& change : changes) changed.push_back(change.point);
  std::ranges::sort(changed);
  const auto changes_itself = [&](Vertex_handle v) {
    return std::ranges::binary_search(changed, v->point().id());
  };
  Face_handle near;  // where the point before comes
  for (Jump& jump : jumps) {
    const auto& [id, motion] = jump.change;
    if (!motion) continue;
    const Point_2 point(*motion, id);
    jump.location = locate(point, near == Face_handle() ? vertex_near(point)->face() : near);
    near = jump.location.face;
    const auto& [face, locus, i] = jump.location;
    if constexpr (is_weighted) {
      hidden_points().check_is_new(point, jump.location, changed);
    } else if (locus == Triangulation::VERTEX && !changes_itself(face->vertex(i))) {
      const Point_id other = face->vertex(i)->point().id();
      throw Coincident_trajectories_error(std::min(id, other), std::max(id, other));
    }
    for (int k = 0; k < 3; ++k) {
      const Vertex_handle v = face->vertex(k);
      if (!triangulation_.is_infinite(v) && !changes_itself(v)) jump.near = v;
    }
  }
}

// The points that there are after the changes, in the order of their ids.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::points_after(std::span<const Change> changes) const
    -> std::vector<Point_2> {
  std::vector<std::optional<Motion>> motions(vertices_.size());
  for (const Vertex_handle v : vertices_) {
    if (v != Vertex_handle()) motions[v->point().id()] = v->point().motion();
  }
  for (const Change& change : changes) motions[change.point] = change.motion;
  std::vector<Point_2> result;
  for (std::size_t id = 0; id < motions.size(); ++id) {
    if (motions[id]) result.emplace_back(*motions[id], static_cast<Point_id>(id));
  }
  return result;
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::make_changes(std::span<const Change> changes,
                                                   Change_plan& plan) {
  if (plan.rebuilt) {
    const auto set_points = [&] {
      for (const Change& change : changes) set_point(change);
    };
    return rebuild(set_points, std::move(plan.rebuilt));
  }
  make_turns(plan.turns);
  if (plan.jumps.empty()) return;
  execute_due_events();  // what takes a vertex out needs a triangulation that is Delaunay
  if (make_jumps(plan.jumps, plan.turns.empty())) return;
  rebuild([&] {
    for (const Jump& jump : plan.jumps) set_point(jump.change);
  });
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::make_turns(std::span<const Change> turns) {
  if (are_most(turns.size())) {
    queue_.clear();
    for (const Change& change : turns) set_point(change);
    return schedule_all();
  }
  if constexpr (detail::has_region_runs<Traits> && !is_weighted) {
    constexpr std::size_t turns_per_region = 8;  // fewer are made as fast one by one
    if (queue_.is_divided() && turns.size() >= turns_per_region * division_.regions) {
      return detail::Region_runs<Kinetic_triangulation_2>::make_turns(*this, turns);
    }
  }
  // Each edge once, also one that is around several of the points.
  std::vector<Two_sided_edge> edges;
  edges.reserve(16 * turns.size());
  std::vector<Vertex_handle> hidden;
  for (const Change& change : turns) {
    const Vertex_handle v = vertices_[change.point];
    if constexpr (is_weighted) {
      const auto add = [&](Vertex_handle h) {
        hidden_points().unschedule(h);
        hidden.push_back(h);
      };
      if (v->is_hidden()) {
        add(v);
        continue;
      }
      detail::for_each_face_at(triangulation_, v, [&](Face_handle face) {
        for (const Vertex_handle h : face->vertex_list()) add(h);
      });
    }
    unschedule_around(v, edges, counters_);
  }
  for (const Change& change : turns) set_point(change);
  schedule(edges, current_time());
  if constexpr (is_weighted) {
    for (const Vertex_handle h : hidden) {
      if (h->event() == no_event) hidden_points().schedule(h, current_time());
    }
  }
}

// Notes whether all weights are still equal after the changes.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::note_weights(std::span<const Change> changes) {
  if constexpr (is_weighted) {
    if (!weights_are_equal_) return;
    std::vector<Point_2> points;
    for (const Change& change : changes) {
      if (change.motion) points.emplace_back(*change.motion, change.point);
    }
    // One that stays, if there is one.
    const auto stays = [&](Vertex_handle v) {
      return v != Vertex_handle() &&
             std::ranges::find(changes, v->point().id(), &Change::point) == changes.end();
    };
    const auto stayer = std::ranges::find_if(vertices_, stays);
    if (stayer != vertices_.end()) points.push_back((*stayer)->point());
    weights_are_equal_ = have_equal_weights(points);
  }
}

// Takes out the points that jump or go, then puts in those that jump or come. Returns false where
// that would leave points on a line: then the points are to be set, and all is to be rebuilt.
// `are_located` says that nothing has changed since the points were located.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::make_jumps(std::span<const Jump> jumps, bool are_located) {
  for (const auto& [change, location, near] : jumps) {
    const Vertex_handle v = vertices_[change.point];
    if (v == Vertex_handle()) continue;
    if (!is_hidden(change.point) && triangulation_.test_dim_down(v)) return false;
    take_out(v);
    are_located = false;
    if (!change.motion) set_point(change);
  }
  for (const Jump& jump : jumps) {
    if (jump.change.motion) set_point(jump.change);
  }
  const std::uint64_t reconstructions = counters_.reconstructions;
  for (const auto& [change, location, near] : jumps) {
    if (!change.motion) continue;
    const Vertex_handle v = vertices_[change.point];
    const Face_handle start = near == Vertex_handle() ? Face_handle() : near->face();
    const Location there = are_located ? location : locate(v->point(), start);
    if constexpr (is_weighted) {
      hidden_points().place(v, there);
    } else {
      put_in(v, there);
    }
    execute_due_events();
    // All points are in a triangulation that has been rebuilt, as where one hides a lighter one in
    // its place.
    if (counters_.reconstructions != reconstructions) return true;
    are_located = false;
  }
  return true;
}

// Gives a vertex its new motion; makes it, or deletes it, where the point comes or goes.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_point(const Change& change) {
  Vertex_handle& v = vertices_[change.point];
  if (!change.motion) {
    if (v == Vertex_handle()) return;
    triangulation_.tds().delete_vertex(v);
    v = Vertex_handle();
    --number_of_points_;
    return;
  }
  if (v == Vertex_handle()) {
    v = triangulation_.tds().create_vertex();
    ++number_of_points_;
  }
  v->set_point(Point_2(*change.motion, change.point));
}

// Whether the triangles at `v` make left turns, and the hull is strictly convex at `v` and at its
// neighbors. Then `v`, which has moved, has left the triangulation properly embedded: the angles at
// an inner vertex add up to what they were, namely once around; a hull vertex sees its neighbors
// within less than half of that. Sufficient, not necessary.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::is_embedded_around(Vertex_handle v) const {
  const auto orientation = triangulation_.geom_traits().orientation_2_object();
  return is_embedded_around(
      v, current_bounds(), [&](Vertex_handle a, Vertex_handle b, Vertex_handle c) {
        return orientation(a->point(), b->point(), c->point()) == CGAL::LEFT_TURN;
      });
}

// The same at a time within `bounds`, with a predicate of the instant after it.
template <KineticTraits_2 Traits>
template <class Is_left_turn>
bool Kinetic_triangulation_2<Traits>::is_embedded_around(Vertex_handle v,
                                                         const Double_interval& bounds,
                                                         const Is_left_turn& is_left_turn) const {
  if constexpr (BatchKineticTraits_2<Traits>) {
    // Mostly it is an inner vertex of few neighbors.
    std::array<const Point_2*, 16> around;
    std::size_t number = 0;
    bool is_inner = true;
    detail::for_each_face_at(triangulation_, v, [&](Face_handle face, int i) {
      const Vertex_handle u = face->vertex(Triangulation::ccw(i));
      is_inner = is_inner && number < around.size() && !triangulation_.is_infinite(u);
      if (is_inner) around[number++] = &u->point();
    });
    if (is_inner && traits_.is_surrounded(v->point(), std::span(around).first(number), bounds)) {
      return true;
    }
  }
  Vertex_handle previous;  // hull neighbors, if v is on the hull
  Vertex_handle next;
  Vertex_handle before_previous;
  Vertex_handle after_next;
  auto face = triangulation_.incident_faces(v);
  const auto first = face;
  do {
    const int i = face->index(v);
    const Vertex_handle right = face->vertex(Triangulation::ccw(i));
    const Vertex_handle left = face->vertex(Triangulation::cw(i));
    const auto beyond = [&] { return triangulation_.tds().mirror_vertex(face, i); };
    if (triangulation_.is_infinite(left)) {
      previous = right;
      before_previous = beyond();
    } else if (triangulation_.is_infinite(right)) {
      next = left;
      after_next = beyond();
    } else if (!is_left_turn(v, right, left)) {
      return false;
    }
  } while (++face != first);
  if (previous == Vertex_handle()) return true;
  if (!is_left_turn(before_previous, previous, v) || !is_left_turn(v, next, after_next)) {
    return false;
  }
  bool is_embedded = true;
  detail::for_each_neighbor(triangulation_, v, [&](Vertex_handle u) {
    is_embedded = is_embedded && (u == next || is_left_turn(v, next, u)) &&
                  (u == previous || is_left_turn(v, u, previous));
  });
  return is_embedded;
}

// Where the point stands just after now, searched from `start`, or from anywhere. Precondition:
// dimension 2.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::locate(const Point_2& point, Face_handle start) const
    -> Location {
  Location result;
  result.face = triangulation_.locate(point, result.locus, result.index, start);
  return result;
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_CHANGES_IMPL_H
