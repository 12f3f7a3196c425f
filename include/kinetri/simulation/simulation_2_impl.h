// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2. Include this only where the class is instantiated for a kinetic
// traits class of one's own; it is compiled into the library for both kinds of motion.
#ifndef KINETRI_SIMULATION_SIMULATION_2_IMPL_H
#define KINETRI_SIMULATION_SIMULATION_2_IMPL_H

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "kinetri/base/check.h"
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/triangulation/detail/incident.h"
#include "kinetri/triangulation/detail/point_problems.h"

namespace kinetri {

namespace detail {

/// The shortest text that reads back as `x`.
inline std::string text(double x) {
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
  return std::string(buffer.data(), end);
}

}  // namespace detail

// ---- construction ----

template <ContactKineticTraits_2 Traits>
Simulation_2<Traits>::Simulation_2(const std::vector<Motion>& motions,
                                   const Simulation_options& options, const Time& start,
                                   const Traits& traits)
    : traits_(traits),
      options_(options),
      diameter_(2 * options.radius),
      triangulation_(motions, start, traits) {
  const char* const problem = options_problem();
  KINETRI_PRECONDITION(problem == nullptr, problem);
  if (options_.box) walls_ = options_.box->walls(options_.rim_touches ? options_.radius : 0);
  for (Point_id id = 0; id < motions.size(); ++id) check_inside(point(id));
  triangulation_.add_observer(*this);
  for (Point_id id = 0; id < motions.size(); ++id) schedule_wall(id, start);
  for (const Edge_ids& edge : triangulation_.finite_edge_ids()) schedule_pair(edge, start);
}

// What is wrong with the options; null if nothing is.
template <ContactKineticTraits_2 Traits>
const char* Simulation_2<Traits>::options_problem() const {
  if (!std::isfinite(diameter_) || !(options_.radius >= 0)) {
    return "the radius is negative or not finite";
  }
  if (options_.response && options_.radius == 0)
    return "the radius is 0, and discs without one never touch";
  if (!options_.box) return nullptr;
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
  return nullptr;
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::check_inside(const Point_2& p) const {
  if (!options_.box) return;
  for (const Wall_2& wall : walls_) {
    if (traits_.is_inside(p, wall, current_time())) continue;
    const double time = current_time().to_double();
    const Vector_2 place = rounded_place(p.motion(), time);
    constexpr std::array<const char*, 4> sides = {"left", "right", "lower", "upper"};
    throw Outside_box_error(p.id(), "the point is outside of the box at t = " + detail::text(time) +
                                        ": at " + detail::text(place.x) + ", " +
                                        detail::text(place.y) +
                                        (wall.clearance > 0 ? ", its rim" : "") + " beyond the " +
                                        sides[static_cast<std::size_t>(wall.side)] + " side at " +
                                        detail::text(wall.position) +
                                        "; expected every point inside of the box or on its sides");
  }
}

// ---- scheduling ----

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::Queue_policy::entry_time(const Entry& entry) const -> Time {
  KINETRI_ASSERT(entry.kind <= Entry_kind::collision, "a scheduled change has its time");
  if (!entry.is_event) return Time(entry.bounds.lower);
  const Traits& traits = simulation.traits_;
  const Point_2& p = simulation.point(entry.point_a);
  if (entry.kind == Entry_kind::wall) {
    return traits.wall_failure(p, simulation.walls_[entry.point_b], entry.bounds);
  }
  return traits.contact_failure(p, simulation.point(entry.point_b), simulation.diameter_,
                                entry.bounds);
}

template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::Queue_policy::precedes(const Entry& a, const Entry& b) const {
  if (a.kind != b.kind) return a.kind < b.kind;
  return std::pair(a.point_a, a.point_b) < std::pair(b.point_a, b.point_b);
}

// A change of a point that is not there is no event either: the point will not be there at the time
// of the change, since an insertion before that would be before it in the queue.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::Queue_policy::is_recheck(const Entry& entry) const {
  if (!entry.is_event) return true;
  return (entry.kind == Entry_kind::erase || entry.kind == Entry_kind::trajectory) &&
         !simulation.triangulation_.contains(entry.point_a);
}

// Puts the entry into the queue with the contact of the certificate, or the time to check it again.
// Returns no_event if there never is a contact.
template <ContactKineticTraits_2 Traits>
Queue_handle Simulation_2<Traits>::push(Entry entry, Certificate certificate) {
  if (certificate.kind == Certificate::Kind::never_fails) return no_event;
  entry.bounds = certificate.bounds;
  entry.is_event = certificate.kind == Certificate::Kind::fails;
  if (!certificate.failure) return queue_.emplace(entry);
  return queue_.push(entry, std::move(*certificate.failure));
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::discard(Queue_handle handle) {
  const Entry entry = queue_.erase(handle);
  if (entry.is_event && entry.kind <= Entry_kind::collision) {
    ++(entry.kind == Entry_kind::wall ? counters_.discarded_walls : counters_.discarded_collisions);
  }
}

// Takes the first entry from the queue.
template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::pop() -> Entry {
  const Entry entry = queue_.pop();
  forget(entry);
  return entry;
}

// Forgets the handle of an entry that has left the queue.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::forget(const Entry& entry) {
  if (entry.kind == Entry_kind::wall) {
    contacts_.at(entry.point_a).wall_event = no_event;
  } else if (entry.kind == Entry_kind::collision) {
    forget_partner(contacts_.at(entry.point_a), entry.point_b);
  } else {
    --scheduled_entries_;
  }
}

// Returns the handle of the partner's entry; none if there is no such partner.
template <ContactKineticTraits_2 Traits>
Queue_handle Simulation_2<Traits>::forget_partner(Contacts& contacts, Point_id b) {
  auto& partners = contacts.partners;
  const auto partner = std::ranges::find(partners, b, &Partner::id);
  if (partner == partners.end()) return no_event;
  const Queue_handle event = partner->event;
  *partner = partners.back();
  partners.pop_back();
  return event;
}

// Only the first of the walls that the point reaches has an entry.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_wall(Point_id id, const Time& after) {
  if (!options_.box) return;
  unschedule_wall(id);
  Entry first;
  first.point_a = id;
  Certificate first_certificate;
  // The exact time of a certificate that does not hold for all time.
  const auto time = [&](const Certificate& certificate, Point_id wall) {
    if (certificate.kind == Certificate::Kind::holds) return Time(certificate.bounds.lower);
    return certificate.failure ? *certificate.failure
                               : traits_.wall_failure(point(id), walls_[wall], certificate.bounds);
  };
  for (Point_id wall = 0; wall < walls_.size(); ++wall) {
    Certificate certificate = traits_.wall_certificate(point(id), walls_[wall], after);
    certificate_counters_.count(certificate);
    if (certificate.kind == Certificate::Kind::never_fails) continue;
    const auto is_earlier = [&] {
      if (first_certificate.kind == Certificate::Kind::never_fails) return true;
      if (certificate.bounds.upper < first_certificate.bounds.lower) return true;
      if (certificate.bounds.lower > first_certificate.bounds.upper) return false;
      return time(certificate, wall) < time(first_certificate, first.point_b);
    };
    if (!is_earlier()) continue;
    first.point_b = wall;
    first_certificate = std::move(certificate);
  }
  contacts_[id].wall_event = push(first, std::move(first_certificate));
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::unschedule_wall(Point_id id) {
  const auto contacts = contacts_.find(id);
  if (contacts == contacts_.end()) return;
  const Queue_handle event = std::exchange(contacts->second.wall_event, no_event);
  if (event != no_event) discard(event);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_pair(const Edge_ids& pair, const Time& after) {
  if (!options_.response) return;
  const auto [a, b] = pair;
  Contacts& contacts = contacts_[a];
  if (const Queue_handle old = forget_partner(contacts, b); old != no_event) discard(old);
  Entry entry;
  entry.kind = Entry_kind::collision;
  entry.point_a = a;
  entry.point_b = b;
  Certificate certificate = pair_certificate(contacts, {a, b}, after, traits_);
  certificate_counters_.count(certificate);
  const Queue_handle event = push(entry, std::move(certificate));
  if (event != no_event) contacts.partners.push_back({b, event});
}

// The certificate of the next contact of a pair; `contacts` are those of its first point.
template <ContactKineticTraits_2 Traits>
Certificate Simulation_2<Traits>::pair_certificate(const Contacts& contacts, const Edge_ids& pair,
                                                   const Time& after, const Traits& traits) const {
  const auto [a, b] = pair;
  if (std::ranges::find(contacts.touching, b) != contacts.touching.end()) {
    return traits.next_contact_certificate(point(a), point(b), diameter_, after);
  }
  return traits.contact_certificate(point(a), point(b), diameter_, after);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::unschedule_pair(const Edge_ids& pair) {
  const auto contacts = contacts_.find(pair[0]);
  if (contacts == contacts_.end()) return;
  const Queue_handle event = forget_partner(contacts->second, pair[1]);
  if (event != no_event) discard(event);
}

template <ContactKineticTraits_2 Traits>
template <class Function>
void Simulation_2<Traits>::for_each_neighbor(Point_id id, Function function) const {
  detail::for_each_neighbor(triangulation_.triangulation(), triangulation_.vertex(id),
                            [&](auto neighbor) { function(neighbor->point().id()); });
}

// Of the neighbor `scheduled`, if there is one, the pair has been done.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_contacts(Point_id id, Point_id scheduled) {
  schedule_wall(id, current_time());
  if (!options_.response) return;
  for_each_neighbor(id, [&](Point_id other) {
    if (other != scheduled) schedule_pair(edge_ids(id, other), current_time());
  });
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::unschedule_contacts(Point_id id) {
  unschedule_wall(id);
  if (!options_.response) return;
  for_each_neighbor(id, [&](Point_id other) { unschedule_pair(edge_ids(id, other)); });
}

// ---- time ----

template <ContactKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::advance_to(const Time& time) {
  KINETRI_PRECONDITION(
      time >= current_time(),
      "the time to advance to is in the past; take the present one or a later one");
  std::size_t events = 0;
  while (const std::size_t more = step(&time)) events += more;
  triangulation_.advance_to(time);
  return events;
}

template <ContactKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::step(const Time* until) {
  settle();
  if (queue_.empty()) return until != nullptr ? triangulation_.step(*until) : triangulation_.step();
  const Time first = queue_.time(queue_.top());
  const bool is_due = until == nullptr || first <= *until;
  const std::size_t events = triangulation_.step(is_due ? first : *until);
  if (events == 0) {
    if (!is_due) return 0;
    triangulation_.advance_to(first);
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
    schedule_pair({entry.point_a, entry.point_b}, Time(entry.bounds.lower));
  } else {
    take_scheduled_motion(entry);
  }
}

// ---- what is due ----

template <ContactKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::execute_due_entries() {
  is_within_instant_ = true;  // and stays so if something throws
  const std::uint64_t events_before = triangulation_.counters().number_of_events();
  std::vector<Due_change> postponed;
  try {
    execute_due_entries(postponed);
  } catch (...) {
    for (const Due_change& change : postponed) {
      push_change(current_time(), change.entry, change.motion);
    }
    throw;
  }
  is_within_instant_ = false;
  return static_cast<std::size_t>(triangulation_.counters().number_of_events() - events_before);
}

// What is in `postponed` when this throws has not been made, and is to be kept.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::execute_due_entries(std::vector<Due_change>& postponed) {
  std::uint64_t contacts = 0;
  const auto execute_due = [&] {
    for (settle(); !queue_.empty() && queue_.time(queue_.top()) <= current_time(); settle()) {
      const Entry entry = pop();
      if (entry.kind > Entry_kind::collision) {
        const Due_change change = {entry, take_scheduled_motion(entry)};
        if (!try_change(change)) postponed.push_back(change);
        continue;
      }
      check_limit(entry, ++contacts);
      if (entry.kind == Entry_kind::wall) {
        hit_wall(entry.point_a, entry.point_b);
      } else {
        collide(entry.point_a, entry.point_b);
      }
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

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::check_limit(const Entry& entry, std::uint64_t contacts) const {
  if (contacts <= options_.max_contacts_per_instant) return;
  throw Endless_contacts_error(
      "more than " + std::to_string(options_.max_contacts_per_instant) +
      " contacts at t = " + detail::text(current_time().to_double()) + ", the last one of point " +
      std::to_string(entry.point_a) +
      (entry.kind == Entry_kind::wall ? " and a wall"
                                      : " and point " + std::to_string(entry.point_b)) +
      "; expected that time goes on: let the points touch one by one, or take another response");
}

// ---- changes ----

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule(const Time& time, Entry_kind kind, Point_id id,
                                    const std::optional<Motion>& motion) {
  KINETRI_PRECONDITION(time >= current_time(),
                       "a change in the past; take the present time or a later one");
  KINETRI_PRECONDITION(id < triangulation_.next_id(),
                       "no point has the id " + std::to_string(id) +
                           "; take one that insert or schedule_insert gave");
  KINETRI_PRECONDITION(!motion || is_finite(*motion), detail::not_finite_problem(id));
  Entry entry;
  entry.point_a = id;
  entry.point_b = scheduled_++;
  entry.kind = kind;
  entry.is_event = true;
  push_change(time, entry, motion);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::push_change(const Time& time, Entry entry,
                                       const std::optional<Motion>& motion) {
  entry.bounds = time.interval();
  if (motion) scheduled_motions_.emplace(entry.point_b, *motion);
  queue_.push(entry, time);
  ++scheduled_entries_;
}

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::take_scheduled_motion(const Entry& change) -> std::optional<Motion> {
  const auto node = scheduled_motions_.extract(change.point_b);
  return node ? std::optional(node.mapped()) : std::nullopt;
}

template <ContactKineticTraits_2 Traits>
Point_id Simulation_2<Traits>::schedule_insert(const Time& time, const Motion& motion) {
  const Point_id id = triangulation_.reserve_id();
  schedule(time, Entry_kind::insert, id, motion);
  return id;
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_motion(const Time& time, Point_id id, const Motion& motion) {
  schedule(time, Entry_kind::trajectory, id, motion);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_erase(const Time& time, Point_id id) {
  schedule(time, Entry_kind::erase, id, std::nullopt);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::execute_change(const Due_change& change) {
  const Point_id id = change.entry.point_a;
  if (change.entry.kind == Entry_kind::erase) {
    erase(id);
  } else if (change.entry.kind == Entry_kind::insert) {
    check_inside(Point_2(*change.motion, id));
    triangulation_.insert(*change.motion, id);
    schedule_contacts(id, no_point);
  } else if (triangulation_.contains(id)) {  // else it has left while the change was postponed
    set_motion(id, *change.motion);
  }
}

// Likewise; returns false if another point has the trajectory that the change leads to.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::try_change(const Due_change& change) {
  try {
    execute_change(change);
    return true;
  } catch (const Coincident_trajectories_error&) {
    return false;
  }
}

template <ContactKineticTraits_2 Traits>
Point_id Simulation_2<Traits>::insert(const Motion& motion) {
  check_inside(Point_2(motion, triangulation_.next_id()));
  const Point_id id = triangulation_.insert(motion);
  schedule_contacts(id, no_point);
  return id;
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::set_motion(Point_id id, const Motion& motion) {
  check_inside(Point_2(motion, id));
  const typename Triangulation::Change moved = {id, motion};
  change(Event_kind::trajectory, {&id, 1}, {&moved, 1});
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::erase(Point_id id) {
  const typename Triangulation::Change gone = {id, std::nullopt};
  change(Event_kind::erase, {&id, 1}, {&gone, 1});
}

// ---- contacts ----

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::hit_wall(Point_id id, std::size_t wall) {
  const double time = current_time().to_double();
  const Motion& motion = triangulation_.motion(id);
  Vector_2 velocity = rounded_velocity(motion, time);
  double& component = walls_[wall].is_vertical() ? velocity.x : velocity.y;
  component = -component;
  const typename Triangulation::Change reflected = {id,
                                                    clamped_with_velocity(motion, velocity, time)};
  change(Event_kind::wall, {&id, 1}, {&reflected, 1});
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::collide(Point_id a, Point_id b) {
  const double time = current_time().to_double();
  const Motion& motion_a = triangulation_.motion(a);
  const Motion& motion_b = triangulation_.motion(b);
  const Vector_2 place_a = rounded_place(motion_a, time);
  const Vector_2 place_b = rounded_place(motion_b, time);
  const auto would_approach = [&](const Vector_2& velocity_a, const Vector_2& velocity_b) {
    return traits_.do_approach(Point_2(clamped_with_velocity(motion_a, velocity_a, time), a),
                               Point_2(clamped_with_velocity(motion_b, velocity_b, time), b),
                               current_time());
  };
  const Contact_response_2 response =
      options_.response({time,
                         a,
                         b,
                         {place_b.x - place_a.x, place_b.y - place_a.y},
                         rounded_velocity(motion_a, time),
                         rounded_velocity(motion_b, time),
                         would_approach});

  std::array<typename Triangulation::Change, 2> changes;
  std::size_t number = 0;
  const auto add = [&](Point_id id, const Motion& motion, bool erases,
                       const std::optional<Vector_2>& velocity) {
    if (erases) {
      changes[number++] = {id, std::nullopt};
    } else if (velocity && *velocity != rounded_velocity(motion, time)) {
      changes[number++] = {id, clamped_with_velocity(motion, *velocity, time)};
    }
  };
  add(a, motion_a, response.erases_a, response.velocity_a);
  add(b, motion_b, response.erases_b, response.velocity_b);
  if (number == 0) {
    leave_in_contact(a, b);
    triangulation_.apply(Event_kind::collision, a, b, {});
    return schedule_pair(edge_ids(a, b), current_time());
  }
  const std::array<Point_id, 2> points = {a, b};
  change(Event_kind::collision, points, {changes.data(), number});
}

// Makes the changes of one contact, with the contacts of its points scheduled before and after.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::change(Event_kind kind, std::span<const Point_id> points,
                                  std::span<const typename Triangulation::Change> changes) {
  for (const Point_id id : points) unschedule_contacts(id);
  const auto second = points.size() > 1 ? std::optional(points[1]) : std::nullopt;
  const auto schedule_anew = [&] {
    for (const Point_id id : points) part_from_others(id);
    for (const Point_id id : points) {
      if (!triangulation_.contains(id)) {
        contacts_.erase(id);
        continue;
      }
      const Point_id first = points.front();
      schedule_contacts(id, id != first && triangulation_.contains(first) ? first : no_point);
    }
  };
  changing_points_ = points;
  try {
    triangulation_.apply(kind, points[0], second, changes);
  } catch (const Coincident_trajectories_error&) {
    changing_points_ = {};
    schedule_anew();
    throw;
  }
  changing_points_ = {};
  schedule_anew();
}

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::clamped_with_velocity(const Motion& motion, const Vector_2& velocity,
                                                 double time) const -> Motion {
  Motion result = with_velocity_at(motion, velocity, time);
  if (!options_.box) return result;
  const Double_interval times = current_time().tight_interval();
  for (const Wall_2& wall : walls_) result = clamped_inside(result, wall, times);
  return result;
}

// Follows the edges of the triangulation. While points change, `change` schedules their contacts.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::after_event(const Event& event) {
  if (!options_.response) return;
  if (event.removed) unschedule_pair(*event.removed);
  if (!event.added) return;
  const bool is_scheduled_later = std::ranges::any_of(
      *event.added, [&](Point_id id) { return std::ranges::count(changing_points_, id) > 0; });
  if (!is_scheduled_later) schedule_pair(*event.added, event.time);
}

// ---- discs in contact ----

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::leave_in_contact(Point_id a, Point_id b) {
  const auto add = [this](Point_id id, Point_id other) {
    std::vector<Point_id>& touching = contacts_[id].touching;
    if (std::ranges::find(touching, other) == touching.end()) touching.push_back(other);
  };
  add(a, b);
  add(b, a);
}

// Of a point that has a new motion, or none, those that it does not overlap now are no longer in
// contact with it. As long as two keep their motions, next_contact_certificate knows.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::part_from_others(Point_id id) {
  const auto contacts = contacts_.find(id);
  if (contacts == contacts_.end()) return;
  std::erase_if(contacts->second.touching, [&](Point_id other) {
    if (triangulation_.contains(id) && triangulation_.contains(other) &&
        traits_.do_overlap(point(id), point(other), diameter_, current_time())) {
      return false;
    }
    std::erase(contacts_.at(other).touching, id);
    return true;
  });
}

// ---- counters and audit ----

template <ContactKineticTraits_2 Traits>
Contact_counters Simulation_2<Traits>::contact_counters() const {
  Contact_counters result = counters_;
  result.queue = queue_.counters();
  return result;
}

template <ContactKineticTraits_2 Traits>
Certificate_counters Simulation_2<Traits>::certificate_counters() const {
  Certificate_counters result = triangulation_.certificate_counters();
  return result += certificate_counters_;
}

template <ContactKineticTraits_2 Traits>
Audit_report Simulation_2<Traits>::audit(Audit_level level) const {
  Audit_report report = triangulation_.audit(level);
  const auto fail = [&](std::string text) { report.failures.push_back(std::move(text)); };
  const auto pair_name = [](Point_id a, Point_id b) {
    return "points " + std::to_string(a) + " and " + std::to_string(b);
  };
  if (!queue_.is_valid()) fail("the queue of contacts is out of order");
  if (!queue_.empty() && queue_.time_of(queue_.top()) < current_time())
    fail("a contact has been missed");
  const std::vector<Edge_ids> edges = triangulation_.finite_edge_ids();
  const Contacts none;
  const auto contacts = [&](Point_id id) -> const Contacts& {
    const auto found = contacts_.find(id);
    return found == contacts_.end() ? none : found->second;
  };
  std::size_t entries = 0;
  std::size_t points_with_contacts = 0;
  for (Point_id a = 0; a < triangulation_.next_id(); ++a) {
    if (!triangulation_.contains(a)) continue;
    points_with_contacts += contacts_.count(a);
    if (contacts(a).wall_event != no_event) ++entries;
    for (const auto& [b, event] : contacts(a).partners) {
      ++entries;
      if (!std::ranges::binary_search(edges, edge_ids(a, b))) {
        fail(pair_name(a, b) + " have a contact but no edge");
      }
    }
  }
  if (points_with_contacts != contacts_.size()) fail("a point that is not there has contacts");
  entries += scheduled_entries_;
  if (entries != queue_.size()) fail("the queue of contacts holds others than those of the points");
  if (!report.passed() || level < Audit_level::delaunay) return report;

  // The time of the contact that the queue holds, and of the one that is to be found.
  const auto compare = [&](const std::string& what, Queue_handle event,
                           const std::optional<Time>& expected) {
    if (event == no_event) {
      if (expected) fail(what + " will have a contact that is not scheduled");
    } else if (!queue_[event].is_event) {
      if (expected && *expected < queue_.time_of(queue_[event]))
        fail(what + " have a contact before the next check");
    } else if (!expected || *expected != queue_.time_of(queue_[event])) {
      fail(what + " have a contact at another time than scheduled, or none");
    }
  };
  const Traits exact = traits_.exact();
  for (Point_id id = 0; options_.box && id < triangulation_.next_id(); ++id) {
    if (!triangulation_.contains(id)) continue;
    std::optional<Time> first;
    for (const Wall_2& wall : walls_) {
      if (!exact.is_inside(point(id), wall, current_time())) {
        fail("point " + std::to_string(id) + " is outside of the box");
      }
      if (level < Audit_level::certificates) continue;
      const Certificate certificate = exact.wall_certificate(point(id), wall, current_time());
      if (certificate.failure && (!first || *certificate.failure < *first)) {
        first = *certificate.failure;
      }
    }
    if (level < Audit_level::certificates) continue;
    compare("point " + std::to_string(id), contacts(id).wall_event, first);
  }
  if (!options_.response || level < Audit_level::certificates) return report;
  for (const auto& [a, b] : edges) {
    const auto& partners = contacts(a).partners;
    const auto partner = std::ranges::find(partners, b, &Partner::id);
    const Certificate certificate = pair_certificate(contacts(a), {a, b}, current_time(), exact);
    compare(pair_name(a, b), partner == partners.end() ? no_event : partner->event,
            certificate.failure ? std::optional(*certificate.failure) : std::nullopt);
  }
  return report;
}

}  // namespace kinetri

#include "kinetri/simulation/detail/snapshot_impl.h"

#endif  // KINETRI_SIMULATION_SIMULATION_2_IMPL_H
