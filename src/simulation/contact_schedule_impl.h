// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Contact_schedule.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_SCHEDULE_IMPL_H
#define KINETRI_SRC_SIMULATION_CONTACT_SCHEDULE_IMPL_H

#include <tuple>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "simulation/contact_schedule.h"
#include "simulation/disc_geometry_impl.h"

namespace kinetri::detail {

// ---- the policy ----

template <class Traits>
auto Simulation_types<Traits>::Contact_schedule::Policy::entry_time(const Entry& entry) const
    -> Time {
  KINETRI_ASSERT(is_contact(entry.kind), "a scheduled change has its time");
  if (!entry.is_event) return Time(entry.bounds.lower);
  const Simulation_setup& setup = schedule_.setup_;
  const Disc_geometry& geometry = schedule_.geometry_;
  if constexpr (!is_periodic) {
    if (entry.kind == Contact_kind::wall) {
      return setup.traits().wall_failure(geometry.point(entry.point_a),
                                         setup.walls()[entry.point_b], entry.bounds);
    }
  }
  return setup.traits().contact_failure(geometry.point_of(geometry.itself(entry.point_a)),
                                        geometry.point_of(entry.disc_b()), setup.diameter(),
                                        entry.bounds);
}

template <class Traits>
bool Simulation_types<Traits>::Contact_schedule::Policy::precedes(const Entry& a,
                                                                  const Entry& b) const {
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.is_noted != b.is_noted) return !a.is_noted;
  return std::tie(a.point_a, a.point_b, a.offset) < std::tie(b.point_a, b.point_b, b.offset);
}

// A change of a point that does not exist is dropped: it will not exist at that time, since its
// insertion would come first in the queue.
template <class Traits>
bool Simulation_types<Traits>::Contact_schedule::Policy::is_recheck(const Entry& entry) const {
  if (!entry.is_event) return true;
  return (entry.kind == Contact_kind::erase || entry.kind == Contact_kind::trajectory) &&
         !schedule_.geometry_.contains(entry.point_a);
}

// The node of the regions for an edge of the two points.
template <class Traits>
inline std::size_t Simulation_types<Traits>::Contact_schedule::Policy::part_of(
    const Subject& subject) const {
  const Region_division& division = schedule_.division_;
  if (subject.kind == Contact_kind::wall) return division.node_of(subject.point_a, subject.point_a);
  if (subject.kind == Contact_kind::collision) {
    return division.node_of(subject.point_a, subject.point_b);
  }
  return division.nodes() - 1;
}

template <class Traits>
inline Queue_handle Simulation_types<Traits>::Contact_schedule::Policy::handle(
    const Subject& subject) const {
  if (!is_change(subject.kind)) return schedule_.records_.event(subject);
  const auto change = schedule_.changes_.find(subject.point_b);
  return change == schedule_.changes_.end() ? no_event : change->second.event;
}

template <class Traits>
inline void Simulation_types<Traits>::Contact_schedule::Policy::set_handle(
    const Subject& subject, Queue_handle handle) const {
  if (!is_change(subject.kind)) return schedule_.records_.set_event(subject, handle);
  schedule_.changes_.at(subject.point_b).event = handle;
}

// ---- the queue ----

// Pushes the entry with the time of the contact, or of the next check. Returns no_event if the
// certificate never fails.
template <class Traits>
Queue_handle Simulation_types<Traits>::Contact_schedule::push(Entry entry,
                                                              Certificate certificate) {
  if (certificate.kind == Certificate::Kind::never_fails) return no_event;
  entry.bounds = certificate.bounds;
  entry.is_event = certificate.kind == Certificate::Kind::fails;
  if (!certificate.failure) return queue_.emplace(entry);
  return queue_.push(entry, std::move(*certificate.failure));
}

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::discard(Queue_handle handle) {
  const Entry entry = queue_.erase(handle);
  if (entry.is_event && is_contact(entry.kind)) {
    ++(entry.kind == Contact_kind::wall ? counters_.discarded_walls
                                        : counters_.discarded_collisions);
  }
}

template <class Traits>
auto Simulation_types<Traits>::Contact_schedule::pop() -> Entry {
  const Entry entry = queue_.pop();
  forget(entry);
  return entry;
}

// Removes the handle of an entry that has left the queue.
template <class Traits>
void Simulation_types<Traits>::Contact_schedule::forget(const Entry& entry) {
  if (is_change(entry.kind)) {
    --changes_in_queue_;
  } else {
    records_.forget_event(entry.subject());
  }
}

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::settle() {
  queue_.settle([](const Entry& /*entry*/) { return true; },
                [this](std::span<const Entry> entries) {
                  for (const Entry& entry : entries) recheck(entry);
                });
}

// Checks a certificate again, or drops a change of a point that does not exist.
template <class Traits>
void Simulation_types<Traits>::Contact_schedule::recheck(const Entry& entry) {
  forget(entry);
  if (entry.kind == Contact_kind::wall) {
    schedule_wall(entry.point_a, Time(entry.bounds.lower));
  } else if (entry.kind == Contact_kind::collision) {
    schedule_pair(entry.pair(), entry.is_edge, Time(entry.bounds.lower));
  } else {
    take_motion(entry);
  }
}

template <class Traits>
bool Simulation_types<Traits>::Contact_schedule::is_contact_due() {
  const Time& now = geometry_.current_time();
  const auto may_be_due = [&] {
    return !queue_.empty() && queue_.top().bounds.lower <= now.interval().upper;
  };
  if (!may_be_due()) return false;
  settle();
  return may_be_due() && is_contact(queue_.top().kind) && queue_.time(queue_.top()) <= now;
}

// ---- single points ----

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::schedule_single(Point_id id, const Time& after) {
  schedule_wall(id, after);
  schedule_radius_end(id);
}

// Schedules the time at which a shrinking radius reaches zero. Precondition: it is not scheduled.
template <class Traits>
void Simulation_types<Traits>::Contact_schedule::schedule_radius_end(Point_id id) {
  if constexpr (has_radii) {
    if (geometry_.motion(id).growth >= 0) return;
    const Time time = zero_of_radius(geometry_.motion(id));
    Entry entry;
    entry.kind = Contact_kind::vanish;
    entry.is_event = true;
    entry.point_a = id;
    entry.bounds = time.interval();
    records_.add_event(entry.subject(), queue_.push(entry, time));
  }
}

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::schedule_wall(Point_id id, const Time& after) {
  if (!setup_.has_box()) return;
  auto [first, certificate] = first_wall(id, after, certificate_counters_);
  records_.add_event(first.subject(), push(first, std::move(certificate)));
}

template <class Traits>
auto Simulation_types<Traits>::Contact_schedule::first_wall(Point_id id, const Time& after,
                                                            Certificate_counters& counters) const
    -> std::pair<Entry, Certificate> {
  Entry first;
  first.point_a = id;
  Certificate first_certificate;
  if constexpr (!is_periodic) {
    const auto& traits = setup_.traits();
    const Point_2& point = geometry_.point(id);
    // The exact time of a certificate that may fail.
    const auto time = [&](const Certificate& certificate, Point_id wall) {
      if (certificate.kind == Certificate::Kind::holds) return Time(certificate.bounds.lower);
      return certificate.failure
                 ? *certificate.failure
                 : traits.wall_failure(point, setup_.walls()[wall], certificate.bounds);
    };
    for (Point_id wall = 0; wall < setup_.walls().size(); ++wall) {
      Certificate certificate = traits.wall_certificate(point, setup_.walls()[wall], after);
      counters.count(certificate);
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
  }
  return {first, std::move(first_certificate)};
}

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::unschedule_single(Point_id id) {
  Contact_record* const record = records_.find(id);
  if (record == nullptr) return;
  for (Queue_handle* const handle : {&record->wall_event, &record->vanish_event}) {
    const Queue_handle event = std::exchange(*handle, no_event);
    if (event != no_event) discard(event);
  }
}

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::schedule_all_singles() {
  const std::vector<Point_id> ids = geometry_.present_points();
  if (setup_.has_box()) {
    struct Block {
      std::span<const Point_id> ids;
      Time after;
      std::vector<std::pair<Entry, Certificate>> first = {};
      Certificate_counters counters = {};
    };
    std::vector<Block> blocks;
    for (const auto block : blocks_of(std::span(ids))) {
      blocks.push_back({block, geometry_.current_time().detached()});
    }
    for_each_in_parallel(blocks, [this](Block& block) {
      for (const Point_id id : block.ids) {
        block.first.push_back(first_wall(id, block.after, block.counters));
      }
    });
    for (Block& block : blocks) {
      certificate_counters_ += block.counters;
      for (auto& [entry, certificate] : block.first) {
        records_.add_event(entry.subject(), push(entry, std::move(certificate)));
      }
      block = {};
    }
  }
  for (const Point_id id : ids) schedule_radius_end(id);
}

// ---- pairs ----

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::schedule_pair(const Pair& pair, bool is_edge,
                                                               const Time& after) {
  if (!setup_.has_response()) return;
  unschedule_pair(pair);
  schedule_new_pair(pair, is_edge, after);
}

template <class Traits>
bool Simulation_types<Traits>::Contact_schedule::schedule_new_pair(const Pair& pair, bool is_edge,
                                                                   const Time& after) {
  Certificate certificate = pair_certificate(pair, after, setup_.traits());
  certificate_counters_.count(certificate);
  const bool may_overlap = certificate.may_be_zero;
  push_pair(pair, is_edge, std::move(certificate));
  return may_overlap;
}

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::push_pair(const Pair& pair, bool is_edge,
                                                           Certificate certificate) {
  Entry entry;
  entry.kind = Contact_kind::collision;
  entry.set_pair(pair);
  entry.is_edge = is_edge;
  const Queue_handle event = push(entry, std::move(certificate));
  if (event != no_event) records_.add_event(entry.subject(), event);
}

template <class Traits>
Certificate Simulation_types<Traits>::Contact_schedule::pair_certificate(
    const Pair& pair, const Time& after, const Traits& traits) const {
  const auto& p = geometry_.point_of(geometry_.itself(ids_of(pair)[0]));
  const auto& q = geometry_.point_of(second_of(pair));
  const Disc_overlap* const overlap = records_.find_overlap(pair);
  if (overlap == nullptr || !overlap->passes) {
    return traits.contact_certificate(p, q, setup_.diameter(), after);
  }
  Certificate result = traits.next_contact_certificate(p, q, setup_.diameter(), after);
  result.may_be_zero = true;
  return result;
}

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::unschedule_pair(const Pair& pair) {
  if (const Queue_handle event = records_.forget_pair(pair); event != no_event) discard(event);
}

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::unschedule_pairs(Point_id id) {
  Contact_record* const record = records_.find(id);
  if (record == nullptr) return;
  for (const auto& [other, event] : record->partners) {
    if (id_of(other) != id) {
      records_.forget_partner(id_of(other), back_from(other, id));
    } else if (!is_first(id, other)) {
      continue;  // the pair of a point with its own image is in the list twice
    }
    discard(event);
  }
  record->partners.clear();
}

// ---- changes ----

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::schedule_change(
    const Time& time, Contact_kind kind, Point_id id, const std::optional<Motion>& motion) {
  Entry entry;
  entry.point_a = id;
  entry.point_b = scheduled_++;
  entry.kind = kind;
  entry.is_event = true;
  push_change(time, entry, motion);
}

template <class Traits>
void Simulation_types<Traits>::Contact_schedule::push_change(const Time& time, Entry entry,
                                                             const std::optional<Motion>& motion) {
  entry.bounds = time.interval();
  changes_[entry.point_b] = {motion, queue_.push(entry, time)};
  ++changes_in_queue_;
}

template <class Traits>
auto Simulation_types<Traits>::Contact_schedule::take_motion(const Entry& change)
    -> std::optional<Motion> {
  const auto node = changes_.extract(change.point_b);
  return node ? node.mapped().motion : std::nullopt;
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_SCHEDULE_IMPL_H
