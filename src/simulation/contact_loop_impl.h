// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Contact_loop.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_LOOP_IMPL_H
#define KINETRI_SRC_SIMULATION_CONTACT_LOOP_IMPL_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "simulation/contact_loop.h"
#include "simulation/overlap_tracker_impl.h"

namespace kinetri::detail {

// ---- time ----

template <class Traits>
std::size_t Simulation_types<Traits>::Contact_loop::step(const Time* until) {
  until_ = until;
  schedule_.settle();
  auto& queue = schedule_.queue();
  const auto step_triangulation = [this](const Time* end) {
    return core_.loop.step(end, [this] { tracker_.follow(core_.reporter.take_trail(), {}); });
  };
  if (queue.empty()) {  // a flip may schedule a contact
    const std::size_t events = step_triangulation(until);
    return events > 0 ? events + execute_due_entries() : 0;
  }
  const Time first = queue.time(queue.top());
  // A radius may reach zero at `until`.
  const bool is_end = queue.top().kind == Contact_kind::vanish;
  const bool is_due = until == nullptr || (is_end ? first < *until : first <= *until);
  const std::size_t events = step_triangulation(is_due ? &first : until);
  if (events == 0) {
    if (!is_due) return 0;
    if (is_end) refuse_negative_radius(queue.top().point_a, first);
    core_.loop.run_to(first, nullptr);
  }
  const std::size_t due_events = execute_due_entries();
  if (events == 0) ++counters_.instants;
  return events + due_events;
}

template <class Traits>
void Simulation_types<Traits>::Contact_loop::run_to(const Time& until,
                                                    const std::function<bool()>& may_go_on) {
  while (may_go_on == nullptr || may_go_on()) {
    if (step(&until) > 0) continue;
    core_.loop.run_to(until, nullptr);
    return;
  }
}

template <class Traits>
bool Simulation_types<Traits>::Contact_loop::may_be_due(const Time& time) {
  schedule_.settle();
  auto& queue = schedule_.queue();
  if (queue.empty()) return false;
  return queue.top().kind == Contact_kind::vanish ||
         queue.is_due(queue.top(), time.interval(), [&]() -> const Time& { return time; });
}

// Not up to the time of the first entry, since `step` counts the triangulation's events then; not
// if a radius reaches zero first, since that error is thrown at the time of the last event.
template <class Traits>
bool Simulation_types<Traits>::Contact_loop::run_triangulation(
    const Time& until, const std::function<bool()>& may_go_on, std::size_t& events) {
  schedule_.settle();
  const auto& queue = schedule_.queue();
  Time end = until;
  if (!queue.empty()) {
    if (queue.top().kind == Contact_kind::vanish) return true;
    const Time before(
        std::nextafter(queue.top().bounds.lower, -std::numeric_limits<double>::infinity()));
    if (before <= current_time()) return true;
    if (before < until) end = before;
  }
  bool goes_on = true;
  std::function<bool()> ask;
  if (may_go_on != nullptr) ask = [&] { return goes_on = may_go_on(); };
  const std::uint32_t scheduled = schedule_.number_of_changes();
  events += core_.advance_to(end, ask);
  KINETRI_PRECONDITION(schedule_.number_of_changes() == scheduled,
                       "an observer that does not look at the triangulation has scheduled a "
                       "change; let its looks_at_triangulation() return true");
  return goes_on;
}

template <class Traits>
void Simulation_types<Traits>::Contact_loop::refuse_negative_radius(Point_id id, const Time& time) {
  throw Negative_radius_error(
      id, time.detached(),
      "the radius of disc " + std::to_string(id) + " shrinks to 0 at t = " + text(time) +
          " and would be negative after that; expected an end at that time or before, or another "
          "motion of the disc by then");
}

// ---- the events of one time ----

template <class Traits>
std::size_t Simulation_types<Traits>::Contact_loop::execute_due_entries() {
  is_within_instant_ = true;  // stays true after an exception
  const std::uint64_t events_before = core_.counters.number_of_events();
  std::vector<Due_change> postponed;
  const auto put_back = [&] {
    for (const Due_change& change : postponed) schedule_.put_back(change);
  };
  try {
    execute_due_entries(postponed);
  } catch (const Contact_error&) {  // the contact may be due again
    put_back();
    is_within_instant_ = is_within_contact_;
    throw;
  } catch (...) {
    put_back();
    throw;
  }
  is_within_instant_ = false;
  return static_cast<std::size_t>(core_.counters.number_of_events() - events_before);
}

// If this throws, `postponed` has changes that have not been made.
template <class Traits>
void Simulation_types<Traits>::Contact_loop::execute_due_entries(
    std::vector<Due_change>& postponed) {
  auto& queue = schedule_.queue();
  std::uint64_t contacts = 0;
  std::uint64_t velocity_changes = 0;
  bool may_set_together = true;
  const auto execute_due = [&] {
    const auto is_due = [&] {
      schedule_.settle();
      return !queue.empty() && queue.top().kind != Contact_kind::vanish &&
             queue.time(queue.top()) <= current_time();
    };
    while (is_due()) {
      const Entry entry = schedule_.pop();
      if (entry.kind == Contact_kind::trajectory && may_set_together) {
        std::vector<Due_change> new_motions = pop_new_motions(entry);
        if (try_set_motions(new_motions)) continue;
        // One of them cannot be made, or not yet: make them one by one.
        may_set_together = false;
        for (const Due_change& new_motion : new_motions) schedule_.put_back(new_motion);
        continue;
      }
      if (is_change(entry.kind)) {
        const Due_change change = schedule_.take_change(entry);
        if (!try_change(change)) postponed.push_back(change);
        continue;
      }
      refuse_own_image(entry);
      if (entry.kind == Contact_kind::collision && tracker_.note_contact(entry)) continue;
      ++contacts;
      is_within_contact_ = true;
      execute_contact(entry, velocity_changes);
      is_within_contact_ = false;
    }
  };
  execute_due();
  // A change to the trajectory of another point may have to wait for the change of that point.
  while (!postponed.empty()) {
    const auto waiting = std::ranges::find_if(
        postponed, [&](const Due_change& change) { return try_change(change); });
    if (waiting == postponed.end()) {
      const Due_change hopeless = postponed.front();
      postponed.erase(postponed.begin());
      execute_change(hopeless);  // throws
    } else {
      postponed.erase(waiting);
    }
    execute_due();
  }
  counters_.most_at_one_time = std::max(counters_.most_at_one_time, contacts);
}

// ---- contacts ----

// Executes a contact that has left the queue. Counts contacts at one time that change points.
template <class Traits>
void Simulation_types<Traits>::Contact_loop::execute_contact(const Entry& contact,
                                                             std::uint64_t& velocity_changes) {
  const std::vector<Change> changes = changes_of(contact, velocity_changes);
  const std::array<Point_id, 2> points = {contact.point_a, contact.point_b};
  if (contact.kind == Contact_kind::wall) {
    return change(std::span(points).first(1), [&] { apply(contact, changes); });
  }
  const Pair pair = contact.pair();
  if (records_.find_overlap(pair) != nullptr) {
    records_.mark_passing(contact.point_a, contact.disc_b(), false);  // they had separated
  }
  if (!changes.empty()) return change(points, [&] { apply(contact, changes); });
  ++passes_;
  tracker_.let_pass(contact.point_a, contact.disc_b(), contact.is_edge);
  apply(contact, changes);
  schedule_.schedule_pair(pair, contact.is_edge, current_time());
}

// The changes of points by a contact. Before an Endless_contacts_error the contact returns to the
// queue.
template <class Traits>
auto Simulation_types<Traits>::Contact_loop::changes_of(const Entry& contact,
                                                        std::uint64_t& velocity_changes)
    -> std::vector<Change> {
  try {
    std::vector<Change> result = outcomes_.changes(contact, current_time());
    if (!result.empty()) {
      check_limit(contact, ++velocity_changes);
      if (zeno_watch_.count()) check_accumulation(contact);
    }
    return result;
  } catch (const Endless_contacts_error&) {
    schedule_.put_contact(contact);
    is_within_contact_ = false;
    throw;
  }
}

// The points of a contact, as in "point 0 and a wall".
template <class Entry>
std::string named_points_of(const Entry& entry) {
  return "point " + std::to_string(entry.point_a) +
         (entry.kind == Contact_kind::wall ? " and a wall"
                                           : " and point " + std::to_string(entry.point_b));
}

template <class Traits>
void Simulation_types<Traits>::Contact_loop::check_limit(const Entry& entry,
                                                         std::uint64_t velocity_changes) const {
  const std::uint64_t most = setup_.options().max_contacts_per_instant.value_or(
      10'000 + 100 * std::uint64_t{geometry_.number_of_ids()});
  if (velocity_changes <= most) return;
  throw Endless_contacts_error(
      entry.point_a, "more than " + std::to_string(most) + " contacts at t = " +
                         text(current_time()) + ", the last one of " + named_points_of(entry) +
                         "; expected that time goes on: let the points touch one by one, or take "
                         "another response");
}

// Contacts that accumulate before the end of the call.
template <class Traits>
void Simulation_types<Traits>::Contact_loop::check_accumulation(const Entry& entry) {
  const double now = current_time().to_double();
  const auto found = zeno_watch_.look(now, geometry_.number_of_ids());
  // As far beyond as it is ahead, since it is estimated.
  if (!found || (until_ != nullptr && Time(2 * found->point - now) >= *until_)) return;
  throw Endless_contacts_error(
      entry.point_a,
      "contacts without end before about t = " + text(found->point) + ": their rate is " +
          std::to_string(std::llround(found->rate / found->rate_before)) + " times that of t = " +
          text(found->began) + ", the last one is of " + named_points_of(entry) +
          "; expected room between the points and a response that adds no energy: let the run end "
          "before, take smaller, fewer or slower growing discs, a slower box, or another response");
}

// Throws, before the contact, if it is that of a disc with an image of itself, which it may not
// overlap.
template <class Traits>
void Simulation_types<Traits>::Contact_loop::refuse_own_image(
    [[maybe_unused]] const Entry& contact) {
  if constexpr (is_periodic) {
    if (contact.kind != Contact_kind::collision || contact.point_a != contact.point_b ||
        setup_.lets_images_overlap()) {
      return;
    }
    schedule_.put_contact(contact);
    throw_own_image_error(contact.disc_b(), current_time());
  }
}

// Makes the changes of a contact in the triangulation, which reports it.
template <class Traits>
void Simulation_types<Traits>::Contact_loop::apply(const Entry& contact,
                                                   std::span<const Change> changes) {
  Event event;
  event.kind = contact.kind == Contact_kind::wall ? Event_kind::wall : Event_kind::collision;
  event.point_a = contact.point_a;
  if (contact.kind == Contact_kind::collision) event.point_b = contact.point_b;
  if constexpr (is_periodic) event.added_offset = contact.offset;
  const Flag_while changing = core_.reporter.start_change();
  core_.changes.perform({&event, 1}, changes);
}

// Changes the points, which are sorted: removes their entries before, and schedules them after.
template <class Traits>
template <class Make_changes>
void Simulation_types<Traits>::Contact_loop::change(std::span<const Point_id> points,
                                                    const Make_changes& make_changes) {
  for (const Point_id id : points) {
    tracker_.end_passes(id);
    schedule_.unschedule_single(id);
    schedule_.unschedule_pairs(id);
  }
  const auto schedule_anew = [&] {
    tracker_.follow(core_.reporter.take_trail(), points);
    if constexpr (has_radii) {
      for (const Point_id id : points) {
        if (setup_.has_response() && geometry_.contains(id)) tracker_.follow_links(id, points);
      }
    }
    for (const Point_id id : points) {
      if (geometry_.contains(id)) schedule_.schedule_single(id, current_time());
    }
    tracker_.schedule_pairs(points);
    overlap_observers_.call([&](Overlap_observer& observer) { observer.after_change(points); });
  };
  try {
    make_changes();
  } catch (...) {  // nothing has changed
    schedule_anew();
    throw;
  }
  schedule_anew();
}

// ---- changes ----

template <class Traits>
void Simulation_types<Traits>::Contact_loop::insert(const Motion& motion,
                                                    std::optional<Point_id> reserved) {
  const Point_id id = reserved.value_or(geometry_.number_of_ids());
  KINETRI_PRECONDITION(is_finite(motion), not_finite_problem(id));
  const Point_2 p(motion, id);
  setup_.check_place(p, current_time());
  if constexpr (is_periodic) geometry_.check_own_images({&p, 1});
  if (setup_.options().refuses_overlaps) refuse_overlaps_of(p);
  change({&id, 1}, [&] {
    const Flag_while changing = core_.reporter.start_change();
    if (!reserved) core_.topology.give_ids(1);
    try {
      core_.changes.change_all(Event_kind::insert, {{id, motion}});
    } catch (const Coincident_trajectories_error&) {
      if (!reserved) core_.topology.take_back_ids(id);
      throw;
    }
  });
}

template <class Traits>
void Simulation_types<Traits>::Contact_loop::set_motions(std::span<const Point_id> ids,
                                                         std::span<const Motion> motions) {
  KINETRI_PRECONDITION(ids.size() == motions.size(), std::to_string(ids.size()) + " ids and " +
                                                         std::to_string(motions.size()) +
                                                         " motions; expected a motion for each id");
  std::vector<Change> changes;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(geometry_.contains(ids[i]), unknown_id_problem(ids[i]));
    KINETRI_PRECONDITION(is_finite(motions[i]), not_finite_problem(ids[i]));
    setup_.check_place(Point_2(motions[i], ids[i]), current_time());
    changes.push_back({ids[i], motions[i]});
  }
  if constexpr (is_periodic && has_radii) {
    std::vector<Point_2> changed;
    for (const Change& change : changes) changed.emplace_back(*change.motion, change.point);
    geometry_.check_own_images(changed);
  }
  std::vector<Point_id> points(ids.begin(), ids.end());
  std::ranges::sort(points);
  const auto twice = std::ranges::adjacent_find(points);
  KINETRI_PRECONDITION(twice == points.end(), named_twice_problem(*twice));
  change(points, [&] {
    const Flag_while changing = core_.reporter.start_change();
    core_.changes.change_all(Event_kind::trajectory, changes);
  });
}

template <class Traits>
void Simulation_types<Traits>::Contact_loop::erase(Point_id id) {
  KINETRI_PRECONDITION(geometry_.contains(id), unknown_id_problem(id));
  change({&id, 1}, [&] {
    const Flag_while changing = core_.reporter.start_change();
    core_.changes.change_all(Event_kind::erase, {{id, std::nullopt}});
  });
}

template <class Traits>
void Simulation_types<Traits>::Contact_loop::execute_change(const Due_change& change) {
  const Point_id id = change.entry.point_a;
  if (change.entry.kind == Contact_kind::erase) {
    erase(id);
  } else if (change.entry.kind == Contact_kind::insert) {
    insert(*change.motion, id);
  } else if (geometry_.contains(id)) {  // else it has left while the change was postponed
    set_motions({&id, 1}, {&*change.motion, 1});
  }
}

// Makes a change. Returns false if another point has the new trajectory.
template <class Traits>
bool Simulation_types<Traits>::Contact_loop::try_change(const Due_change& change) {
  try {
    execute_change(change);
    return true;
  } catch (const Coincident_trajectories_error&) {
    return false;
  }
}

// Removes the new motions from the queue that can be set together with the first one, which has
// been removed.
template <class Traits>
auto Simulation_types<Traits>::Contact_loop::pop_new_motions(const Entry& first)
    -> std::vector<Due_change> {
  auto& queue = schedule_.queue();
  std::vector<Due_change> result = {schedule_.take_change(first)};
  const auto is_next = [&] {
    schedule_.settle();
    return !queue.empty() && queue.top().kind == Contact_kind::trajectory &&
           queue.top().point_a != result.back().entry.point_a &&
           queue.time(queue.top()) <= current_time();
  };
  while (is_next()) result.push_back(schedule_.take_change(schedule_.pop()));
  return result;
}

// Sets the new motions together. Returns false, and does nothing, if that is not possible.
template <class Traits>
bool Simulation_types<Traits>::Contact_loop::try_set_motions(
    std::span<const Due_change> new_motions) {
  std::vector<Point_id> ids;
  std::vector<Motion> motions;
  for (const auto& [entry, motion] : new_motions) {
    ids.push_back(entry.point_a);
    motions.push_back(*motion);
  }
  try {
    set_motions(ids, motions);
    return true;
  } catch (const Outside_box_error&) {
    return false;
  } catch (const Negative_radius_error&) {
    return false;
  } catch (const Own_image_error&) {
    return false;
  } catch (const Coincident_trajectories_error&) {
    return false;
  }
}

// ---- overlaps that are refused ----

template <class Traits>
void Simulation_types<Traits>::Contact_loop::refuse_overlaps() const {
  std::vector<Edge_ids> pairs;
  for (const Point_id id : geometry_.present_points()) {
    if constexpr (is_periodic) {  // links of points that coincide have no names
      const Point_id shown = geometry_.shown(id);
      if (shown != id && setup_.diameter() > 0) pairs.push_back(edge_ids(shown, id));
    }
    for (const Disc_overlap& overlap : records_.overlaps(id)) {
      if (is_first(id, overlap.disc) &&
          geometry_.do_overlap(geometry_.point_of(geometry_.itself(id)),
                               geometry_.point_of(overlap.disc))) {
        pairs.push_back({id, id_of(overlap.disc)});
      }
    }
  }
  refuse(std::move(pairs));
}

// For a point that is to be inserted. O(n).
template <class Traits>
void Simulation_types<Traits>::Contact_loop::refuse_overlaps_of(const Point_2& p) const {
  std::vector<Edge_ids> pairs;
  const auto vectors = geometry_.vectors();
  for (const Point_id id : geometry_.present_points()) {
    if (geometry_.does_overlap_image(p, id, vectors)) pairs.push_back(edge_ids(id, p.id()));
  }
  refuse(std::move(pairs));
}

// Throws if there are such pairs.
template <class Traits>
void Simulation_types<Traits>::Contact_loop::refuse(std::vector<Edge_ids> pairs) const {
  if (pairs.empty()) return;
  std::ranges::sort(pairs);
  const auto [a, b] = pairs.front();
  const std::string message =
      "discs " + std::to_string(a) + " and " + std::to_string(b) +
      " overlap at t = " + text(current_time()) +
      (pairs.size() > 1 ? ", and " + std::to_string(pairs.size() - 1) + " more pairs" : "") +
      "; expected discs that are apart or touch";
  throw Overlapping_discs_error(std::move(pairs), message);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_LOOP_IMPL_H
