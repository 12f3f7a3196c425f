// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2. Include this only where the class is instantiated for a kinetic
// traits class of your own; it is compiled into the library for both kinds of motion.
#ifndef KINETRI_SIMULATION_SIMULATION_2_IMPL_H
#define KINETRI_SIMULATION_SIMULATION_2_IMPL_H

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/simulation/contact_runs.h"
#include "kinetri/impl/simulation/disc_numbers.h"
#include "kinetri/impl/simulation/shortest_text.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

// ---- construction ----

template <ContactKineticTraits_2 Traits>
Simulation_2<Traits>::Simulation_2(const std::vector<Motion>& motions,
                                   const Simulation_options& options, const Time& start,
                                   const Traits& traits)
    : traits_(traits),
      options_(options),
      diameter_(2 * options.radius),
      triangulation_(motions, start, traits) {
  KINETRI_PRECONDITION(options_problem().empty(), options_problem());
  KINETRI_PRECONDITION(options_.masses.empty() || options_.masses.size() == motions.size(),
                       "masses, but not one for each point");
  make_walls();
  for (Point_id id = 0; id < motions.size(); ++id) check_place(point(id));
  if (options_.response) triangulation_.add_observer(*this);
  find_all_overlaps();
  if (options_.refuses_overlaps) refuse_overlaps();
  schedule_all();
}

// What is wrong with the options; empty if nothing is.
template <ContactKineticTraits_2 Traits>
std::string Simulation_2<Traits>::options_problem() const {
  if (!std::isfinite(diameter_) || !(options_.radius >= 0)) {
    return "the radius is negative, or the diameter is not finite";
  }
  if (has_radii && options_.radius != 0) {
    return "a radius for all discs, which have their own; leave it 0";
  }
  if (!has_radii && options_.response && options_.radius == 0)
    return "the radius is 0, and discs without one never touch";
  for (Point_id id = 0; id < options_.masses.size(); ++id) {
    const std::string problem = detail::mass_problem(id, options_.masses[id]);
    if (!problem.empty()) return problem;
  }
  if (!options_.box) return {};
  const auto& [xmin, ymin, xmax, ymax] = *options_.box;
  if (!std::isfinite(xmin) || !std::isfinite(ymin) || !std::isfinite(xmax) ||
      !std::isfinite(ymax) || !(xmin < xmax && ymin < ymax)) {
    return "the box has no area or is not finite";
  }
  const Rational diameter = to_rational(diameter_);
  if (options_.rim_touches && (to_rational(xmax) - to_rational(xmin) <= diameter ||
                               to_rational(ymax) - to_rational(ymin) <= diameter)) {
    return "the box is not wider and higher than a disc whose rim touches it";
  }
  return {};
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::make_walls() {
  if (!options_.box) return;
  walls_ = options_.box->walls(options_.rim_touches ? options_.radius : 0);
  for (Wall_2& wall : walls_) wall.rim = has_radii && options_.rim_touches;
}

// Checks a motion from the present time on.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::check_place(const Point_2& p) const {
  if constexpr (has_radii) check_radius(p);
  if (!options_.box) return;
  for (const Wall_2& wall : walls_) {
    if (traits_.is_inside(p, wall, current_time())) continue;
    const double time = current_time().to_double();
    const Vector_2 place = rounded_place(p.motion(), time);
    throw Outside_box_error(
        p.id(), "point " + std::to_string(p.id()) +
                    " is outside of the box at t = " + detail::text(time) + ": at " +
                    detail::text(place.x) + ", " + detail::text(place.y) +
                    (wall.clearance > 0 || wall.rim ? ", its rim" : "") + " beyond the " +
                    std::string(name(wall.side)) + " side at " + detail::text(wall.position) +
                    "; expected every point inside of the box or on its sides");
  }
}

template <ContactKineticTraits_2 Traits>
template <HasWeight M>
void Simulation_2<Traits>::check_radius(const Point_2& p) const {
  const Motion& disc = p.motion();
  KINETRI_PRECONDITION(!options_.response || disc.weight == 0,
                       "disc " + std::to_string(p.id()) +
                           " has a weight besides its radius; discs that collide have none");
  const auto is_negative = [&] {
    if (disc.growth == 0) return disc.radius < 0;
    const Time zero = detail::zero_of_radius(disc);
    return disc.growth > 0 ? current_time() < zero : current_time() > zero;
  };
  if (!is_negative()) return;
  throw Negative_radius_error(p.id(), current_time().detached(),
                              "the radius of disc " + std::to_string(p.id()) +
                                  " is negative at t = " + detail::text(current_time()) + ": " +
                                  detail::text(disc.radius) +
                                  " at t = " + detail::text(disc.epoch) + ", with the growth " +
                                  detail::text(disc.growth) + "; expected a radius of 0 or more");
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::refuse_vanishing(Point_id id, const Time& time) const {
  throw Negative_radius_error(
      id, time.detached(),
      "the radius of disc " + std::to_string(id) + " shrinks to 0 at t = " + detail::text(time) +
          " and would be negative after that; expected an end at that time or before, or another "
          "motion of the disc by then");
}

// ---- calls within calls ----

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::check_may_change() const {
  KINETRI_PRECONDITION(!is_changing_,
                       "a change of the simulation within an event, or while another change is "
                       "made; make it when advance_to, step or the other change has returned, or "
                       "schedule it");
  check_is_whole();
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::check_is_whole() const {
  KINETRI_PRECONDITION(!is_within_contact_ || is_changing_,
                       "an error has left the simulation within a contact; make another one, or "
                       "restore a snapshot");
  if (!is_changing_) detail::Plain_loop<Triangulation>::check_may_change(triangulation_);
}

// ---- time ----

template <ContactKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::advance_to(const Time& time,
                                             const std::function<bool()>& may_go_on) {
  const detail::Flag_while changing = start_change();
  KINETRI_PRECONDITION(
      time >= current_time(),
      "the time to advance to is in the past; take the present one or a later one");
  if constexpr (detail::has_region_runs<Traits>) {
    if (may_run_by_regions()) {
      return detail::Contact_runs<Simulation_2>::advance_to(*this, time, may_go_on);
    }
  }
  join_parts_of_contacts();
  std::size_t events = 0;
  while (may_go_on == nullptr || may_go_on()) {
    if (can_run_triangulation()) {
      if (!run_triangulation(time, may_go_on, events)) break;
      if (!may_be_due(time)) {  // a step would put parts together
        events += triangulation_.advance_to(time);
        break;
      }
    }
    const std::size_t more = step(&time);
    if (more == 0) {
      triangulation_.advance_to(time);
      break;
    }
    events += more;
  }
  return events;
}

// Whether what happens to the triangulation changes nothing in the queue. With a response, contacts
// of edges come and go; an observer that looks on may schedule changes.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::can_run_triangulation() const {
  return !options_.response &&
         std::ranges::none_of(observers_, &Event_observer::looks_at_triangulation);
}

// Lets the triangulation run to a time before the first entry of the queue, or to `until`, and adds
// its events. Returns whether it may go on. Not up to the time of the entry, since it is to be
// known whether the triangulation has events then; not where a radius ends, since that is refused
// at the time of the last event.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::run_triangulation(const Time& until,
                                             const std::function<bool()>& may_go_on,
                                             std::size_t& events) {
  settle();
  Time end = until;
  if (!queue_.empty()) {
    if (queue_.top().kind == Entry_kind::vanish) return true;
    const Time before(
        std::nextafter(queue_.top().bounds.lower, -std::numeric_limits<double>::infinity()));
    if (before <= current_time()) return true;
    if (before < until) end = before;
  }
  bool goes_on = true;
  std::function<bool()> ask;
  if (may_go_on != nullptr) ask = [&] { return goes_on = may_go_on(); };
  const std::uint32_t scheduled = scheduled_;
  events += triangulation_.advance_to(end, ask);
  KINETRI_PRECONDITION(scheduled_ == scheduled,
                       "an observer that does not look at the triangulation has scheduled a "
                       "change; let its looks_at_triangulation() return true");
  return goes_on;
}

// Whether an entry of the queue may be at or before a time. Where a radius ends, who steps knows.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::may_be_due(const Time& time) {
  settle();
  if (queue_.empty()) return false;
  return queue_.top().kind == Entry_kind::vanish ||
         queue_.is_due(queue_.top(), time.interval(), [&]() -> const Time& { return time; });
}

// Whether a run by regions may execute contacts and be faster.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::may_run_by_regions() const {
  if constexpr (detail::has_region_runs<Traits>) {
    return (options_.box || options_.response) &&
           detail::may_pay_by_regions(triangulation_.number_of_points(), threads_) &&
           detail::Contact_runs<Simulation_2>::can_run(*this);
  }
  return false;
}

// Ends what runs by regions have left divided.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::join_parts() {
  join_parts_of_contacts();
  detail::Plain_loop<Triangulation>::join(triangulation_);
}

// The same, if runs by regions have executed contacts.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::join_parts_of_contacts() {
  if constexpr (detail::has_region_runs<Traits>) {
    if (queue_.is_divided()) detail::Contact_runs<Simulation_2>::join(*this);
  }
}

template <ContactKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::step(const Time* until) {
  join_parts();
  return step_in_parts(until);
}

// The same where the queues may stay in parts.
template <ContactKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::step_in_parts(const Time* until) {
  using Loop = detail::Plain_loop<Triangulation>;
  settle();
  if (queue_.empty()) {  // it need not be after a flip
    const std::size_t events = Loop::step(triangulation_, until);
    return events > 0 ? events + execute_due_entries() : 0;
  }
  const Time first = queue_.time(queue_.top());
  // A radius may become 0, but not less.
  const bool is_end = queue_.top().kind == Entry_kind::vanish;
  const bool is_due = until == nullptr || (is_end ? first < *until : first <= *until);
  const std::size_t events = Loop::step(triangulation_, is_due ? &first : until);
  if (events == 0) {
    if (!is_due) return 0;
    if (is_end) refuse_vanishing(queue_.top().point_a, first);
    Loop::run_to(triangulation_, first);
  }
  const std::size_t due_events = execute_due_entries();
  if (events == 0) ++counters_.instants;
  return events + due_events;
}

// Takes what is no event from the front of the queue.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::settle() {
  queue_.settle([](const Entry& /*entry*/) { return true; },
                [this](std::span<const Entry> entries) {
                  for (const Entry& entry : entries) recheck(entry);
                });
}

// Checks a certificate again, or drops a change of a point that is not there. The entry has left
// the queue.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::recheck(const Entry& entry) {
  forget(entry);
  if (entry.kind == Entry_kind::wall) {
    schedule_wall(entry.point_a, Time(entry.bounds.lower));
  } else if (entry.kind == Entry_kind::collision) {
    schedule_pair({entry.point_a, entry.point_b}, entry.is_edge, Time(entry.bounds.lower));
  } else {
    take_scheduled_motion(entry);
  }
}

// ---- the events of one time ----

template <ContactKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::execute_due_entries() {
  is_within_instant_ = true;  // and stays so if something throws
  const std::uint64_t events_before = triangulation_.counters().number_of_events();
  std::vector<Due_change> postponed;
  const auto put_back = [&] {
    for (const Due_change& change : postponed) {
      push_change(current_time(), change.entry, change.motion);
    }
  };
  try {
    execute_due_entries(postponed);
  } catch (const Endless_contacts_error&) {
    put_back();
    is_within_instant_ = is_within_contact_;
    throw;
  } catch (...) {
    put_back();
    throw;
  }
  is_within_instant_ = false;
  return static_cast<std::size_t>(triangulation_.counters().number_of_events() - events_before);
}

// What is in `postponed` when this throws has not been made, and is to be kept.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::execute_due_entries(std::vector<Due_change>& postponed) {
  std::uint64_t contacts = 0;
  std::uint64_t turning = 0;
  bool may_turn_together = true;
  const auto execute_due = [&] {
    const auto is_due = [&] {
      settle();
      return !queue_.empty() && queue_.top().kind != Entry_kind::vanish &&
             queue_.time(queue_.top()) <= current_time();
    };
    while (is_due()) {
      const Entry entry = pop();
      if (entry.kind == Entry_kind::trajectory && may_turn_together) {
        std::vector<Due_change> turns = pop_turns(entry);
        if (try_turns(turns)) continue;
        // One after the other, as one of them cannot be made, or not yet.
        may_turn_together = false;
        for (const Due_change& turn : turns) {
          push_change(current_time(), turn.entry, turn.motion);
        }
        continue;
      }
      if (is_change(entry.kind)) {
        const Due_change change = {entry, take_scheduled_motion(entry)};
        if (!try_change(change)) postponed.push_back(change);
        continue;
      }
      if (entry.kind == Entry_kind::collision && note_contact(entry)) continue;
      ++contacts;
      is_within_contact_ = true;
      execute_contact(entry, turning);
      is_within_contact_ = false;
    }
  };
  execute_due();
  // A change may have to wait for another one of the same time, which takes away the point whose
  // trajectory it leads to.
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

// Whether the first entry is a contact, and is now.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::is_contact_due() {
  const auto may_be_due = [&] {
    return !queue_.empty() && queue_.top().bounds.lower <= current_time().interval().upper;
  };
  if (!may_be_due()) return false;
  settle();
  return may_be_due() && is_contact(queue_.top().kind) &&
         queue_.time(queue_.top()) <= current_time();
}

// All contacts of one time are found before the first of them is executed: where discs overlap
// because of a contact, there may be others that are watched because of that overlap
// (docs/MATH.md, section 8). So the overlap that begins with a contact of now, which has left the
// queue, is noted, and the contact goes back behind those that are not noted. Returns false where
// there is nothing to note: no other contact is now, and the two overlap no others.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::note_contact(const Entry& contact) {
  if (contact.is_noted) return false;
  const Point_id a = contact.point_a;
  const Point_id b = contact.point_b;
  for (const Point_id id : {a, b}) drop_overlaps(id);
  const auto overlaps_others = [&](Point_id id, Point_id other) {
    return std::ranges::any_of(overlaps(id),
                               [&](const Overlap& overlap) { return overlap.id != other; });
  };
  if (!overlaps_others(a, b) && !overlaps_others(b, a) && !is_contact_due()) return false;
  Entry noted = contact;
  noted.is_noted = true;
  note(noted.subject(), queue_.push(noted, current_time()));
  start_overlap(a, b, contact.is_edge);
  for_each_pair_beside(a, b, contact.is_edge,
                       [this](const Edge_ids& pair) { watch(pair, false, current_time()); });
  return true;
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::check_limit(const Entry& entry, std::uint64_t turning) const {
  if (turning <= options_.max_contacts_per_instant) return;
  throw Endless_contacts_error(
      entry.point_a,
      "more than " + std::to_string(options_.max_contacts_per_instant) +
          " contacts at t = " + detail::text(current_time()) + ", the last one of point " +
          std::to_string(entry.point_a) +
          (entry.kind == Entry_kind::wall ? " and a wall"
                                          : " and point " + std::to_string(entry.point_b)) +
          "; expected that time goes on: let the points touch one by one, or take another "
          "response");
}

}  // namespace kinetri

#include "kinetri/impl/simulation/audit_impl.h"
#include "kinetri/impl/simulation/changes_impl.h"
#include "kinetri/impl/simulation/contacts_impl.h"
#include "kinetri/impl/simulation/disc_overlaps_impl.h"
#include "kinetri/impl/simulation/hidden_links_impl.h"
#include "kinetri/impl/simulation/overlaps_impl.h"
#include "kinetri/impl/simulation/scheduling_impl.h"
#include "kinetri/impl/simulation/snapshot_impl.h"

#endif  // KINETRI_SIMULATION_SIMULATION_2_IMPL_H
