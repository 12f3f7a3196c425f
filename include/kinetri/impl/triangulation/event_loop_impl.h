// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_TRIANGULATION_EVENT_LOOP_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_EVENT_LOOP_IMPL_H

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/event_loop.h"
#include "kinetri/impl/triangulation/updates_impl.h"

namespace kinetri::detail {

template <class Traits>
std::size_t Kinetic_types<Traits>::Event_loop::run_to(const Time& time,
                                                      const std::function<bool()>& may_go_on) {
  std::size_t events = 0;
  bool goes_on = true;
  while (goes_on && schedule_.settle(&time)) {
    goes_on = may_go_on == nullptr || may_go_on();
    if (goes_on) events += run_instant();
  }
  if (goes_on) schedule_.set_current_time(time);
  updates_.show_current_time();
  return events;
}

template <class Traits>
std::size_t Kinetic_types<Traits>::Event_loop::run_instant() {
  std::size_t events = 0;
  within_event([&] { events = run_events_of_instant(); });
  return events;
}

// In a periodic box an offset may be too great.
template <class Traits>
template <class Function>
void Kinetic_types<Traits>::Event_loop::within_event(const Function& function) {
  if constexpr (is_periodic) {
    schedule_.with_time_of_errors([&] { reporter_.within_event(function); });
  } else {
    function();
  }
}

template <class Traits>
std::size_t Kinetic_types<Traits>::Event_loop::run_events_of_instant() {
  auto& queue = schedule_.queue();
  reporter_.begin_instant();
  is_hull_flat_ = false;
  if (queue.top().kind == Entry_kind::coincidence) {
    schedule_.set_current_time(queue.time(queue.top()));
    updates_.show_current_time();
    set_coincident_points_aside();
  } else {
    schedule_.set_current_time(queue.top());
    if (!reporter_.observers().empty()) updates_.show_current_time();
    execute(queue.pop());
  }
  execute_due_events();
  put_points_back();
  reporter_.report_edges();
  reporter_.report_hiding();
  const std::uint64_t events = reporter_.events_in_instant();
  Triangulation_counters& counters = reporter_.counters();
  ++counters.instants;
  if (events > 1) ++counters.batches;
  if (is_hull_flat_) ++counters.flat_hulls;
  counters.largest_instant = std::max(counters.largest_instant, events);
  return static_cast<std::size_t>(events);
}

template <class Traits>
void Kinetic_types<Traits>::Event_loop::execute_due_events() {
  do {
    while (schedule_.settle_now()) execute(schedule_.queue().pop());
  } while (retry_postponed());
}

template <class Traits>
void Kinetic_types<Traits>::Event_loop::execute(const Entry& failure) {
  KINETRI_ASSERT(failure.kind >= Entry_kind::hull_insert,
                 "an event is a failure, and coincident points have been set aside");
  if constexpr (is_weighted) {
    if (failure.is_hidden()) {
      Hidden_events hidden(topology_, schedule_, reporter_, updates_);
      if (!hidden.execute(failure)) rebuild();
      return;
    }
  }
  const Edge_with_mirror edge = topology_.with_mirror(failure.edge());
  const auto now = [this]() -> const Time& { return schedule_.current_time(); };
  const auto decision =
      Decisions(certification_).decide(failure, edge, schedule_.current_bounds(), now);
  is_hull_flat_ = is_hull_flat_ || decision.is_hull_flat;
  switch (decision.action) {
    case Action::flip:
      return updates_.flip(edge, event_kind_of(failure.kind));
    case Action::hide:
      Topology::set_event(edge, no_event);
      if constexpr (is_weighted) updates_.hide(decision.hidden);
      return;
    case Action::reschedule:
      Schedule::forget_entry(edge);
      return schedule_.schedule({&edge, 1}, now());
    case Action::postpone:
      Topology::set_event(edge, no_event);
      postponed_.push_back(Topology::name_of(edge.here));
      return;
    case Action::rebuild:
      return rebuild();
  }
}

template <class Traits>
void Kinetic_types<Traits>::Event_loop::rebuild() {
  points_set_aside_.clear();
  postponed_.clear();
  if (!rest_of_changes_) return updates_.rebuild();
  ++reporter_.counters().reconstructions;
  updates_.rebuild(rest_of_changes_);
}

template <class Traits>
bool Kinetic_types<Traits>::Event_loop::execute_due_events_within(
    std::function<void()> set_points) {
  struct Forget {  // also if memory is missing
    std::function<void()>& function;
    ~Forget() { function = nullptr; }
  };
  const std::uint64_t before = reporter_.counters().reconstructions;
  rest_of_changes_ = std::move(set_points);
  const Forget forget{rest_of_changes_};
  execute_due_events();
  return reporter_.counters().reconstructions != before;
}

// Schedules the postponed edges again if there was a change since the last call, and reconstructs
// the triangulation otherwise. Returns whether there were any, as there may be with weights.
template <class Traits>
bool Kinetic_types<Traits>::Event_loop::retry_postponed() {
  if constexpr (is_weighted) return retry_postponed_edges();
  return false;
}

template <class Traits>
bool Kinetic_types<Traits>::Event_loop::retry_postponed_edges() {
  if (postponed_.empty()) return false;
  const bool is_stuck = updates_.number_of_changes() == changes_before_retry_;
  changes_before_retry_ = updates_.number_of_changes();
  if (is_stuck) {
    rebuild();
    return true;
  }
  for (const Edge_name& name : std::exchange(postponed_, {})) {
    const std::optional<Edge> edge = topology_.find(name);
    if (!edge || edge->first->event(edge->second) != no_event) continue;
    const Edge_with_mirror both = topology_.with_mirror(*edge);
    schedule_.schedule({&both, 1}, schedule_.current_time());
  }
  return true;
}

// ---- points that coincide ----

// Takes the points that coincide now out of the triangulation, but for one at each position, as the
// triangulation was just before: all other events of this time concern distinct points. Points that
// meet share edges just before, so that the points at one position are connected by edges whose
// ends coincide; these edges are first in the queue.
template <class Traits>
void Kinetic_types<Traits>::Event_loop::set_coincident_points_aside() {
  auto& queue = schedule_.queue();
  reporter_.start_noting();
  Coincident_groups groups;
  while (schedule_.settle_now() && queue.top().kind == Entry_kind::coincidence) {
    const Edge edge = queue.pop().edge();
    Topology::set_event(topology_.with_mirror(edge), no_event);
    const auto [a, b] = Topology::ids_of(edge);
    groups.link(a, b);
  }
  // Locating each point again may take a long walk.
  constexpr std::size_t few = 8;
  const bool are_many =
      groups.number_of_points() > std::max(few, topology_.number_of_vertices() / few);
  if (are_many || topology_.triangulation().dimension() < 2 || !topology_.are_weights_equal()) {
    return rebuild();
  }
  topology_.set_instant({schedule_.current_time(), Time_side::before});
  for (const auto& [least, id] : groups.others()) {
    if (!topology_.can_take_out(topology_.vertex(id)) || !updates_.take_out(topology_.vertex(id))) {
      return rebuild();
    }
    points_set_aside_.push_back({topology_.vertex(id), topology_.vertex(least)});
    ++reporter_.counters().points_set_aside;
  }
  updates_.show_current_time();
}

// Inserts the removed points again, one after the other, at their positions just after now.
template <class Traits>
void Kinetic_types<Traits>::Event_loop::put_points_back() {
  while (!points_set_aside_.empty()) {
    const auto [v, companion] = points_set_aside_.back();
    points_set_aside_.pop_back();
    updates_.put_in(v, topology_.locate(v->point(), companion->face()));
    execute_due_events();
  }
}

// ---- reversal of time ----

// Just before the mirrored time the triangulation is Delaunay; the events of that time are executed
// as in `run_instant`. If a triangle is flat, as it is if points meet, everything is rebuilt.
template <class Traits>
void Kinetic_types<Traits>::Event_loop::reverse() {
  schedule_.queue().clear();
  schedule_.set_current_time(-schedule_.current_time());
  for (const Vertex_handle v : topology_.vertices()) {
    if (v == Vertex_handle()) continue;
    topology_.set_point({v->point().id(), mirrored(v->point().motion())});
  }
  topology_.twins().for_each_motion([](const Motion& motion) { return mirrored(motion); });
  if constexpr (is_periodic) {
    certification_.set_traits(certification_.traits().mirrored());
    topology_.set_traits(certification_.traits());
    schedule_.set_end(certification_.traits().box().collapse_after(schedule_.current_time()));
  }
  updates_.show_current_time();
  within_event([&] {
    if (has_flat_triangle()) {
      rebuild();
    } else {
      schedule_.schedule_all();
      execute_due_events();
    }
    reporter_.report_edges();
  });
}

// Whether a triangle is flat at the present time, or the points are on a line.
template <class Traits>
bool Kinetic_types<Traits>::Event_loop::has_flat_triangle() const {
  const Triangulation& triangulation = topology_.triangulation();
  if (triangulation.dimension() < 2) return true;
  const auto now =
      certification_.traits().instantaneous_traits({schedule_.current_time(), Time_side::at});
  return std::ranges::any_of(triangulation.finite_face_handles(), [&](Face_handle face) {
    return now.orientation_2_object()(topology_.corner(face, 0), topology_.corner(face, 1),
                                      topology_.corner(face, 2)) == CGAL::COLLINEAR;
  });
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_EVENT_LOOP_IMPL_H
