// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2: the queue's entries.
#ifndef KINETRI_IMPL_SIMULATION_SCHEDULING_IMPL_H
#define KINETRI_IMPL_SIMULATION_SCHEDULING_IMPL_H

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/simulation/disc_numbers.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "kinetri/impl/triangulation/plain_loop.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::Queue_policy::entry_time(const Entry& entry) const -> Time {
  KINETRI_ASSERT(is_contact(entry.kind), "a scheduled change has its time");
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
  if (a.is_noted != b.is_noted) return !a.is_noted;
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

// The same node of the regions that the triangulation's queue has for an edge of the two points.
template <ContactKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::Queue_policy::part_of(const Subject& subject) const {
  const detail::Region_division& division =
      detail::Plain_loop<Triangulation>::division(simulation.triangulation_);
  if (subject.kind == Entry_kind::wall) return division.node_of(subject.point_a, subject.point_a);
  if (subject.kind == Entry_kind::collision) {
    return division.node_of(subject.point_a, subject.point_b);
  }
  return division.nodes() - 1;
}

template <ContactKineticTraits_2 Traits>
Queue_handle Simulation_2<Traits>::Queue_policy::handle(const Subject& subject) const {
  if (is_change(subject.kind)) {
    const auto change = simulation.scheduled_changes_.find(subject.point_b);
    return change == simulation.scheduled_changes_.end() ? no_event : change->second.event;
  }
  const Contacts* const contacts = simulation.find_contacts(subject.point_a);
  if (contacts == nullptr) return no_event;
  if (subject.kind == Entry_kind::wall) return contacts->wall_event;
  if (subject.kind == Entry_kind::vanish) return contacts->vanish_event;
  return simulation.find_pair({subject.point_a, subject.point_b});
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::Queue_policy::set_handle(const Subject& subject,
                                                    Queue_handle handle) const {
  if (is_change(subject.kind)) {
    simulation.scheduled_changes_.at(subject.point_b).event = handle;
    return;
  }
  const auto contacts = [&](Point_id id) -> Contacts& { return *simulation.find_contacts(id); };
  if (subject.kind == Entry_kind::wall) {
    contacts(subject.point_a).wall_event = handle;
  } else if (subject.kind == Entry_kind::vanish) {
    contacts(subject.point_a).vanish_event = handle;
  } else {
    const auto set = [&](Point_id id, Point_id other) {
      std::ranges::find(contacts(id).partners, other, &Partner::id)->event = handle;
    };
    set(subject.point_a, subject.point_b);
    set(subject.point_b, subject.point_a);
  }
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
  if (entry.is_event && is_contact(entry.kind)) {
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
    contacts_of(entry.point_a).wall_event = no_event;
  } else if (entry.kind == Entry_kind::collision) {
    forget_pair({entry.point_a, entry.point_b});
  } else if (entry.kind == Entry_kind::vanish) {
    contacts_of(entry.point_a).vanish_event = no_event;
  } else {
    --scheduled_entries_;
  }
}

// Returns the handle of the pair's entry; no_event if it has none.
template <ContactKineticTraits_2 Traits>
Queue_handle Simulation_2<Traits>::forget_pair(const Edge_ids& pair) {
  const Queue_handle event = forget_partner(pair[0], pair[1]);
  if (event != no_event) forget_partner(pair[1], pair[0]);
  return event;
}

// The same for the record that the first of the two points has.
template <ContactKineticTraits_2 Traits>
Queue_handle Simulation_2<Traits>::forget_partner(Point_id id, Point_id other) {
  Contacts* const contacts = find_contacts(id);
  if (contacts == nullptr) return no_event;
  auto& partners = contacts->partners;
  const auto partner = std::ranges::find(partners, other, &Partner::id);
  if (partner == partners.end()) return no_event;
  const Queue_handle event = partner->event;
  *partner = partners.back();
  partners.pop_back();
  return event;
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::note(const Subject& subject, Queue_handle handle) {
  if (subject.kind == Entry_kind::wall) {
    contacts_of(subject.point_a).wall_event = handle;
  } else {
    contacts_of(subject.point_a).partners.push_back({subject.point_b, handle});
    contacts_of(subject.point_b).partners.push_back({subject.point_a, handle});
  }
}

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::contacts_of(Point_id id) -> Contacts& {
  if (id >= contacts_.size()) contacts_.resize(triangulation_.next_id());
  if (contacts_[id] == nullptr) contacts_[id] = std::make_unique<Contacts>();
  return *contacts_[id];
}

// Schedules what the point does by itself: it has come or got another motion.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_single(Point_id id, const Time& after) {
  schedule_wall(id, after);
  schedule_vanishing(id);
}

// Schedules when the radius of a disc is 0, if it shrinks. Precondition: nothing is scheduled yet.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_vanishing(Point_id id) {
  if constexpr (has_radii) {
    if (triangulation_.motion(id).growth >= 0) return;
    const Time time = detail::zero_of_radius(triangulation_.motion(id));
    Entry entry;
    entry.kind = Entry_kind::vanish;
    entry.is_event = true;
    entry.point_a = id;
    entry.bounds = time.interval();
    contacts_of(id).vanish_event = queue_.push(entry, time);
  }
}

// Only the first of the walls that the point reaches has an entry.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_wall(Point_id id, const Time& after) {
  if (!options_.box) return;
  unschedule_wall(id);
  auto [first, certificate] = first_wall(id, after, certificate_counters_);
  contacts_of(id).wall_event = push(first, std::move(certificate));
}

// That entry, and the certificate that tells its time.
template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::first_wall(Point_id id, const Time& after,
                                      Certificate_counters& counters) const
    -> std::pair<Entry, Certificate> {
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
  return {first, std::move(first_certificate)};
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::unschedule_wall(Point_id id) {
  Contacts* const contacts = find_contacts(id);
  if (contacts == nullptr) return;
  const Queue_handle event = std::exchange(contacts->wall_event, no_event);
  if (event != no_event) discard(event);
}

// Schedules the next contact of a pair anew.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_pair(const Edge_ids& pair, bool is_edge, const Time& after) {
  if (!options_.response) return;
  unschedule_pair(pair);
  schedule_new_pair(pair, is_edge, after);
}

// Schedules the next contact of a pair that has no entry. Returns whether the discs may overlap
// just after `after`.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::schedule_new_pair(const Edge_ids& pair, bool is_edge,
                                             const Time& after) {
  Certificate certificate = pair_certificate(pair, after, traits_);
  certificate_counters_.count(certificate);
  const bool may_overlap = certificate.may_vanish;
  push_pair(pair, is_edge, std::move(certificate));
  return may_overlap;
}

// Puts the contact of the certificate of a pair that has no entry into the queue.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::push_pair(const Edge_ids& pair, bool is_edge, Certificate certificate) {
  Entry entry;
  entry.kind = Entry_kind::collision;
  entry.point_a = pair[0];
  entry.point_b = pair[1];
  entry.is_edge = is_edge;
  const Queue_handle event = push(entry, std::move(certificate));
  if (event != no_event) note(entry.subject(), event);
}

template <ContactKineticTraits_2 Traits>
Certificate Simulation_2<Traits>::pair_certificate(const Edge_ids& pair, const Time& after,
                                                   const Traits& traits) const {
  const Point_2& p = point(pair[0]);
  const Point_2& q = point(pair[1]);
  const Overlap* const overlap = find_overlap(pair);
  if (overlap == nullptr || !overlap->passes) {
    return traits.contact_certificate(p, q, diameter_, after);
  }
  Certificate result = traits.next_contact_certificate(p, q, diameter_, after);
  result.may_vanish = true;
  return result;
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::unschedule_pair(const Edge_ids& pair) {
  if (const Queue_handle event = forget_pair(pair); event != no_event) discard(event);
}

// Calls `function` with the points that a point has an edge to, or is linked with.
template <ContactKineticTraits_2 Traits>
template <class Function>
void Simulation_2<Traits>::for_each_neighbor(Point_id id, Function function) const {
  if (is_hidden(id)) return for_each_corner(id, function);
  detail::for_each_neighbor(triangulation_.triangulation(), triangulation_.vertex(id),
                            [&](auto neighbor) { function(neighbor->point().id()); });
  for_each_hidden_link(id, function);
}

// Schedules the pairs of points that have got other motions, come or gone, and have no entries of
// pairs; they are sorted.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_pairs(std::span<const Point_id> points) {
  for (const Point_id id : points) end_passes(id);
  for (const Point_id id : points) {
    if (triangulation_.contains(id)) schedule_edges(id, points);
  }
  update_overlaps(points);
  for (const Point_id id : points) {
    if (triangulation_.contains(id)) {
      schedule_pairs_beside(id);
    } else if (id < contacts_.size()) {
      contacts_[id].reset();
    }
  }
}

// Schedules what a point may touch, and notes which discs of neighbors overlap its own. It is one
// of `points`, of which those of smaller ids have been done.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_edges(Point_id id, std::span<const Point_id> points) {
  if (!options_.response) return;
  for_each_neighbor(id, [&](Point_id other) {
    const bool is_done = other < id && std::ranges::binary_search(points, other);
    if (is_done || !schedule_new_pair(edge_ids(id, other), true, current_time())) return;
    if (may_touch(id, other, traits_)) start_overlap(id, other, true);
  });
}

// Schedules the pairs that are watched because the disc of the point overlaps others.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_pairs_beside(Point_id id) {
  for (const Overlap& overlap : overlaps(id)) {
    for_each_pair_beside(id, overlap.id, overlap.is_edge,
                         [this](const Edge_ids& pair) { watch(pair, false, current_time()); });
  }
}

// Schedules the contacts of all points. Several threads make the certificates. Precondition:
// nothing is scheduled yet but changes.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_all() {
  schedule_all_walls();
  for (const Point_id id : present_points()) schedule_vanishing(id);
  if (options_.response) schedule_all_pairs();
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_all_walls() {
  if (!options_.box) return;
  struct Block {
    std::span<const Point_id> ids;
    Time after;
    std::vector<std::pair<Entry, Certificate>> first = {};
    Certificate_counters counters = {};
  };
  const std::vector<Point_id> ids = present_points();
  std::vector<Block> blocks;
  for (const auto block : detail::blocks_of(std::span(ids))) {
    blocks.push_back({block, current_time().detached()});
  }
  detail::for_each_in_parallel(blocks, [this](Block& block) {
    for (const Point_id id : block.ids) {
      block.first.push_back(first_wall(id, block.after, block.counters));
    }
  });
  for (Block& block : blocks) {
    certificate_counters_ += block.counters;
    for (auto& [entry, certificate] : block.first) {
      contacts_of(entry.point_a).wall_event = push(entry, std::move(certificate));
    }
    block = {};
  }
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_all_pairs() {
  struct Made {
    std::vector<std::pair<Edge_ids, Certificate>> contacts;
    Certificate_counters counters;
  };
  auto blocks = make_for_edges<Made>([this](const Edge_ids& edge, const Time& now, Made& made) {
    Certificate certificate = pair_certificate(edge, now, traits_);
    made.counters.count(certificate);
    if (certificate.kind == Certificate::Kind::never_fails) return;
    made.contacts.emplace_back(edge, std::move(certificate));
  });
  for (Made& block : blocks) {
    certificate_counters_ += block.counters;
    for (auto& [edge, certificate] : block.contacts) push_pair(edge, true, std::move(certificate));
    block = {};
  }
  keep_links();
  // Of each pair only once, however many discs overlap both.
  const Point_id ids = triangulation_.next_id();
  std::vector<Point_id> last_first(ids, no_point);
  const auto count_all = [](Point_id /*a*/, Point_id /*b*/) { return true; };
  for (Point_id id = 0; id < ids; ++id) {
    for_each_pair_of(id, count_all, [&](Point_id other) {
      if (std::exchange(last_first[other], id) != id) watch({id, other}, false, current_time());
    });
  }
}

// Calls make(edge, now, made) for each edge and link, with the ids of its ends and the present
// time. Several threads do so, each for the edges of some faces, for which it has an object `made`.
// Returns these, in the order of the faces.
template <ContactKineticTraits_2 Traits>
template <class Made, class Make>
std::vector<Made> Simulation_2<Traits>::make_for_edges(const Make& make) const {
  const auto& triangulation = triangulation_.triangulation();
  std::vector<Made> result;
  if (triangulation.dimension() < 2) {
    result.emplace_back();
    for (const Edge_ids& edge : triangulation_.finite_edge_ids()) {
      make(edge, current_time(), result.back());
    }
    for (const Point_id id : present_points()) {
      for_each_corner(
          id, [&](Point_id corner) { make(edge_ids(id, corner), current_time(), result.back()); });
    }
    return result;
  }
  using Face_handle = typename Triangulation::Triangulation::Face_handle;
  struct Block {
    std::span<const Face_handle> faces;
    Time now;
    Made made = {};
  };
  std::vector<Face_handle> faces;
  faces.reserve(triangulation.tds().faces().size());
  for (const Face_handle face : triangulation.all_face_handles()) faces.push_back(face);
  std::vector<Block> blocks;
  for (const auto block : detail::blocks_of(std::span(std::as_const(faces)))) {
    blocks.push_back({block, current_time().detached()});
  }
  detail::for_each_in_parallel(blocks, [&](Block& block) {
    for (const Face_handle face : block.faces) {
      for (int i = 0; i < 3; ++i) {
        const auto a = face->vertex(triangulation.ccw(i));
        const auto b = face->vertex(triangulation.cw(i));
        // An edge has two faces, which see its ends in opposite order.
        if (triangulation.is_infinite(a) || triangulation.is_infinite(b)) continue;
        const Edge_ids edge = {a->point().id(), b->point().id()};
        if (edge[0] < edge[1]) make(edge, block.now, block.made);
      }
      if constexpr (has_radii) {
        for (const auto& hidden : face->vertex_list()) {
          const Point_id id = hidden->point().id();
          for_each_corner(
              id, [&](Point_id corner) { make(edge_ids(id, corner), block.now, block.made); });
        }
      }
    }
  });
  for (Block& block : blocks) result.push_back(std::move(block.made));
  return result;
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::unschedule_single(Point_id id) {
  unschedule_wall(id);
  Contacts* const contacts = find_contacts(id);
  if (contacts == nullptr) return;
  if (const Queue_handle event = std::exchange(contacts->vanish_event, no_event);
      event != no_event) {
    discard(event);
  }
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::unschedule_pairs(Point_id id) {
  Contacts* const contacts = find_contacts(id);
  if (contacts == nullptr) return;
  for (const auto& [other, event] : contacts->partners) {
    forget_partner(other, id);
    discard(event);
  }
  contacts->partners.clear();
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_SCHEDULING_IMPL_H
