// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Watched_contacts.
#ifndef KINETRI_SRC_SIMULATION_WATCHED_CONTACTS_IMPL_H
#define KINETRI_SRC_SIMULATION_WATCHED_CONTACTS_IMPL_H

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "events/distribute.h"
#include "kinetri/impl/base/check.h"
#include "simulation/known_responses.h"
#include "simulation/watched_contacts.h"

namespace kinetri::detail {

template <class Traits>
bool Watched_contacts<Traits>::can_run(const Core& core) {
  const Simulation_options& options = core.setup.options();
  return options.max_contacts_per_instant != 0 &&
         (!options.response || options.response_is_pure || is_pure(options.response)) &&
         !is_log_contact(options.response) && !is_erase_both(options.response) &&
         core.loop.overlap_observers().empty() &&
         !core.kinetic().reporter.observers().any_of(
             [](const Event_observer& observer) { return observer.looks_at_triangulation(); });
}

// ---- the queue ----

template <class Traits>
template <class In_parallel>
void Watched_contacts<Traits>::divide(std::size_t count, const In_parallel& in_parallel) {
  using Subject = typename Types::Subject;
  constexpr Point_id points_per_block = 2048;
  struct Block {
    Point_id first;
    Point_id last;
    std::vector<Subject> changes = {};
  };
  std::vector<Block> blocks;
  const Point_id ids = geometry_.number_of_ids();
  for (Point_id first = 0; first < ids; first += points_per_block) {
    blocks.push_back({first, std::min(ids, first + points_per_block)});
  }
  Block& of_changes = blocks.emplace_back(Block{ids, ids});
  queue().for_each([&](const Entry& entry) {
    if (is_contact(entry.kind)) return;
    of_changes.changes.push_back(entry.subject());
    if (is_change(entry.kind)) moving_.emplace_back(entry, queue().time_of(entry));
  });
  const auto for_each_subject = [this](const Block& block, const auto& function) {
    for (Point_id id = block.first; id < block.last; ++id) {
      const auto* const contacts = records_.find(id);
      if (contacts == nullptr) continue;
      if (contacts->wall_event != no_event) function(Subject{Contact_kind::wall, id, no_point});
      for (const auto& [other, event] : contacts->partners) {
        if (is_first(id, other)) function(entry_of(pair_from(id, other)).subject());
      }
    }
    for (const Subject& change : block.changes) function(change);
  };
  queue().distribute(count, blocks, for_each_subject, in_parallel);
  moving_.clear();
}

template <class Traits>
auto Watched_contacts<Traits>::entry_of(const Pair& pair) -> Entry {
  Entry result;
  result.kind = Contact_kind::collision;
  result.set_pair(pair);
  result.is_edge = true;
  return result;
}

template <class Traits>
template <class Function>
void Watched_contacts<Traits>::for_each_handle(Point_id id, const Function& function) const {
  const auto* const contacts = records_.find(id);
  if (contacts == nullptr) return;
  if (contacts->wall_event != no_event) function(contacts->wall_event);
  if (!has_pairs()) return;
  for (const auto& partner : contacts->partners) function(partner.event);
}

// ---- contacts ----

template <class Traits>
auto Watched_contacts<Traits>::changes(const Entry& entry, const Time& now) const
    -> std::vector<Change> {
  std::vector<Change> result;
  // After the contact a shrinking radius reaches zero at another time.
  const auto is_for_loop = [this](Point_id id) {
    const auto* const contacts = records_.find(id);
    return passing_.contains(id) || (contacts != nullptr && contacts->vanish_event != no_event);
  };
  if (std::ranges::any_of(points(entry), is_for_loop)) return result;
  try {
    result = core_.outcomes.changes(entry, now);
  } catch (...) {
    return {};  // the sequential loop throws it again
  }
  if (std::ranges::any_of(result, [](const Change& change) { return !change.motion; })) return {};
  return result;
}

template <class Traits>
auto Watched_contacts<Traits>::certificate(const Entry& entry, const Time& after,
                                           Certificate_counters& counters) const
    -> std::pair<Entry, Certificate> {
  if (entry.kind == Contact_kind::wall) {
    return schedule_.first_wall(entry.point_a, after, counters);
  }
  std::pair<Entry, Certificate> result = {
      entry, geometry_.traits().contact_certificate(
                 geometry_.point_of(geometry_.itself(entry.point_a)),
                 geometry_.point_of(entry.disc_b()), core_.setup.diameter(), after)};
  counters.count(result.second);
  return result;
}

template <class Traits>
template <class Put>
void Watched_contacts<Traits>::for_each_contact(Points points, const Time& now,
                                                Certificate_counters& counters,
                                                const Put& put) const {
  const auto put_both = [&put](std::pair<Entry, Certificate>&& contact) {
    put(contact.first, std::move(contact.second));
  };
  if (core_.setup.has_box()) {
    for (const Point_id id : points) put_both(schedule_.first_wall(id, now, counters));
  }
  if (!has_pairs()) return;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point_id id = points[k];
    geometry_.for_each_neighbor(id, [&](const Disc& other) {
      if (is_one(points.first(k), id_of(other))) return;
      put_both(certificate(entry_of(pair_of(id, other)), now, counters));
    });
  }
}

template <class Traits>
bool Watched_contacts<Traits>::certify(const Entry& contact, Points changed, const Time& now,
                                       Certificate_counters& counters,
                                       std::vector<std::pair<Entry, Certificate>>& result) const {
  bool may_go_on = true;
  const bool is_of_wall = contact.kind == Contact_kind::wall;
  bool are_neighbors = is_of_wall || !has_pairs();
  const auto is_contact = [&](const Pair& pair) { return !is_of_wall && pair == contact.pair(); };
  const auto examine = [&](Point_id id, const Disc& other) {
    if (!is_contact(pair_of(id, other)) && do_meet(id, other, now)) may_go_on = false;
  };
  for_each_contact(changed, now, counters, [&](const Entry& entry, Certificate&& known) {
    if (entry.kind == Contact_kind::collision) {
      if (is_contact(entry.pair())) {
        are_neighbors = true;
      } else if (known.may_be_zero && do_meet(entry.pair(), now)) {
        may_go_on = false;
      }
    }
    result.emplace_back(entry, std::move(known));
  });
  if (!has_pairs()) return true;
  if (is_of_wall) return may_go_on;
  const Disc b = contact.disc_b();
  for (const auto& [id, partner] :
       {std::pair(contact.point_a, b), std::pair(id_of(b), back_from(b, contact.point_a))}) {
    if (!is_one(changed, id)) {
      geometry_.for_each_neighbor(id, [&, id = id](const Disc& other) { examine(id, other); });
      continue;
    }
    if constexpr (has_radii) {
      // Discs whose power cells meet this one; see Disc_geometry::owners_in.
      if (is_center_in(id, partner, now)) may_go_on = false;
      geometry_.for_each_neighbor(id_of(partner),
                                  [&, id = id, partner = partner](const Disc& beside) {
                                    const Disc other = beyond(partner, beside);
                                    if (other != geometry_.itself(id)) examine(id, other);
                                  });
    }
  }
  return may_go_on && are_neighbors;
}

template <class Traits>
bool Watched_contacts<Traits>::do_meet(Point_id a, const Disc& b, const Time& now) const {
  return geometry_.may_touch(a, b, geometry_.traits(), now);
}

// Whether the center of a disc is in another one.
template <class Traits>
bool Watched_contacts<Traits>::is_center_in(Point_id id, const Disc& other, const Time& now) const {
  auto center = geometry_.motion(id);
  if constexpr (has_radii) center.radius = center.growth = 0;
  const typename Types::Point_2 point(center, id);
  return geometry_.traits().do_touch(geometry_.point_of(point, geometry_.itself(id)),
                                     geometry_.point_of(other), core_.setup.diameter(), now);
}

// ---- windows ----

template <class Traits>
bool Watched_contacts<Traits>::begin_window(double begin) {
  scheduled_ = schedule_.number_of_changes();
  records_.make_room(geometry_.number_of_ids());
  // Points that coincide for a while have no vertex that a region could own.
  if (!core_.kinetic().topology.twins().empty()) return false;
  if (!has_pairs()) return true;
  if (has_radii && (core_.triangulation.number_of_hidden_points() > 0 || !have_areas())) {
    return false;
  }
  // Discs that have just touched are apart at the next event.
  const Time first(begin);
  if (drop_overlaps(std::max(first, geometry_.current_time()))) return true;
  put_passes_back();
  return false;
}

// Whether all radii are positive, except at single times. Contacts do not change that.
template <class Traits>
bool Watched_contacts<Traits>::have_areas() {
  const auto& triangulation = core_.triangulation;
  const auto& events = triangulation.counters().events;
  const std::uint64_t changes = events[static_cast<std::size_t>(Event_kind::insert)] +
                                events[static_cast<std::size_t>(Event_kind::trajectory)];
  if (changes_ == changes) return have_areas_;
  changes_ = changes;
  have_areas_ = true;
  if constexpr (has_radii) {
    for (Point_id id = 0; id < triangulation.next_id() && have_areas_; ++id) {
      if (!triangulation.contains(id)) continue;
      const auto& disc = triangulation.motion(id);
      have_areas_ = disc.radius > 0 || disc.growth != 0;
    }
  }
  return have_areas_;
}

// Removes the overlaps that have ended at a time before which no event happens. Returns whether all
// have.
template <class Traits>
bool Watched_contacts<Traits>::drop_overlaps(const Time& time) {
  for (Point_id id = 0; id < records_.size(); ++id) {
    const std::vector<typename Types::Disc_overlap> overlaps = records_.overlaps(id);
    for (const auto& [other, passes, is_edge] : overlaps) {
      if (geometry_.contains(id) && geometry_.contains(id_of(other)) && do_meet(id, other, time)) {
        return false;
      }
      tracker_.end_overlap(id, other);
      if (!passes) continue;
      passes_.push_back(pair_from(id, other));
      passing_.insert({id, id_of(other)});
    }
  }
  return true;
}

template <class Traits>
void Watched_contacts<Traits>::put_passes_back() {
  for (const Pair& pair : passes_) {
    tracker_.start_pass(ids_of(pair)[0], second_of(pair), geometry_.is_edge(pair));
  }
  passes_.clear();
  passing_.clear();
}

template <class Traits>
void Watched_contacts<Traits>::end_contact(const Pair& pair) {
  if (!do_meet(pair, geometry_.current_time())) return;
  tracker_.start_overlap(ids_of(pair)[0], second_of(pair), geometry_.is_edge(pair));
}

template <class Traits>
void Watched_contacts<Traits>::end_window() {
  put_passes_back();
  KINETRI_PRECONDITION(schedule_.number_of_changes() == scheduled_,
                       "an observer that does not look at the triangulation has scheduled a "
                       "change; let its looks_at_triangulation() return true");
}

template <class Traits>
void Watched_contacts<Traits>::start_anew() {
  // By number: a change that was being moved to another part may be in both, or in none.
  std::map<Point_id, std::pair<Entry, Time>> changes;
  for (const auto& [entry, time] : moving_) {
    changes.try_emplace(entry.point_b, entry, time);
  }
  moving_.clear();
  for (std::size_t p = 0; p < queue().number_of_parts(); ++p) {
    const Part& part = queue().part(p);
    part.for_each([&](const Entry& entry) {
      if (!is_change(entry.kind)) return;
      changes.try_emplace(entry.point_b, entry, part.time_of(entry));
    });
  }
  queue().clear();
  records_.for_each([](typename Types::Contact_record& record) {
    record.wall_event = record.vanish_event = no_event;
    record.partners.clear();
  });
  for (auto& [number, change] : changes) {
    auto& [entry, time] = change;
    const Queue_handle handle = queue().push(entry, std::move(time));
    schedule_.policy().set_handle(entry.subject(), handle);
  }
  for (const Pair& pair : passes_) {
    records_.start_overlap(ids_of(pair)[0], second_of(pair), geometry_.is_edge(pair));
    records_.mark_passing(ids_of(pair)[0], second_of(pair), true);
  }
  passes_.clear();
  passing_.clear();
  tracker_.find_all();
  core_.schedule_all();
}
}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_WATCHED_CONTACTS_IMPL_H
