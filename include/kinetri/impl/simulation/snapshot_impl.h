// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2: how its state is taken out and put back.
#ifndef KINETRI_IMPL_SIMULATION_SNAPSHOT_IMPL_H
#define KINETRI_IMPL_SIMULATION_SNAPSHOT_IMPL_H

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::snapshot() const -> Snapshot {
  KINETRI_PRECONDITION(
      !is_within_instant_,
      "a snapshot within an instant; take it when advance_to or step has returned");
  Snapshot result;
  result.triangulation = triangulation_.snapshot();
  result.options = options_;
  result.options.response = nullptr;
  result.has_response = options_.response != nullptr;
  result.counters = counters_;
  result.certificates = certificate_counters_;
  for (Point_id a = 0; a < contacts_.size(); ++a) {
    for (const Overlap& overlap : overlaps(a)) {
      if (overlap.passes && a < overlap.id) result.in_contact.push_back({a, overlap.id});
    }
  }
  std::ranges::sort(result.in_contact);
  std::vector<Entry> changes;
  queue_.for_each([&](const Entry& entry) {
    if (is_change(entry.kind)) changes.push_back(entry);
  });
  std::ranges::sort(changes, {}, &Entry::point_b);
  for (const Entry& change : changes) {
    result.scheduled.push_back({queue_.time_of(change).detached(),
                                change.kind == Entry_kind::erase    ? Event_kind::erase
                                : change.kind == Entry_kind::insert ? Event_kind::insert
                                                                    : Event_kind::trajectory,
                                change.point_a, scheduled_changes_.at(change.point_b).motion});
  }
  return result;
}

template <ContactKineticTraits_2 Traits>
Simulation_2<Traits>::Simulation_2(Restoration /*restores*/, const Snapshot& snapshot,
                                   Collision_response response, const Traits& traits)
    : traits_(traits),
      options_(snapshot.options),
      diameter_(2 * snapshot.options.radius),
      triangulation_(Triangulation::restore(snapshot.triangulation, traits)),
      certificate_counters_(snapshot.certificates),
      counters_(snapshot.counters) {
  KINETRI_PRECONDITION(
      !snapshot.has_response == !response,
      "a response where the snapshot's simulation had none, or none where it had one; pass one "
      "if and only if has_response is set");
  options_.response = std::move(response);
  if (const std::string problem = options_problem(); !problem.empty()) {
    throw Snapshot_error("the snapshot's options cannot be used: " + problem);
  }
  if (options_.masses.size() > triangulation_.next_id()) {
    throw Snapshot_error("the snapshot has more masses than point ids");
  }
  counters_.queue = {};
  make_walls();
  if (options_.response) triangulation_.add_observer(*this);
  restore_contacts(snapshot);
  restore_changes(snapshot);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::restore_contacts(const Snapshot& snapshot) {
  find_all_overlaps();
  for (std::size_t i = 0; i < snapshot.in_contact.size(); ++i) {
    const auto [a, b] = snapshot.in_contact[i];
    if (!options_.response || a >= b || !triangulation_.contains(a) ||
        !triangulation_.contains(b) || (i > 0 && !(snapshot.in_contact[i - 1] < Edge_ids{a, b}))) {
      throw Snapshot_error("the snapshot has points " + std::to_string(a) + " and " +
                           std::to_string(b) +
                           " in contact; expected two points that are there, once, and a response");
    }
    start_overlap(a, b, is_edge({a, b}));
    mark_passing(a, b, true);
  }
  for (Point_id id = 0; id < triangulation_.next_id(); ++id) {
    if (!triangulation_.contains(id)) continue;
    const auto refuse = [&](const Error& error) {
      throw Snapshot_error(std::string("the snapshot cannot be used: ") + error.what());
    };
    try {
      check_place(point(id));
    } catch (const Outside_box_error& error) {
      refuse(error);
    } catch (const Negative_radius_error& error) {
      refuse(error);
    }
  }
  schedule_all();
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::restore_changes(const Snapshot& snapshot) {
  std::vector<bool> is_inserted(triangulation_.next_id());
  for (const auto& [time, kind, id, motion] : snapshot.scheduled) {
    const bool is_insert = kind == Event_kind::insert;
    const bool is_erase = kind == Event_kind::erase;
    if ((!is_insert && !is_erase && kind != Event_kind::trajectory) ||
        motion.has_value() == is_erase || (motion && !is_finite(*motion)) ||
        id >= triangulation_.next_id() || time < current_time() ||
        (is_insert && (triangulation_.contains(id) || is_inserted[id]))) {
      throw Snapshot_error(
          "the snapshot has a scheduled change of point " + std::to_string(id) +
          " that cannot be made; expected an insertion, a new motion or an erasure of a point that "
          "has an id, not in the past");
    }
    if (is_insert) is_inserted[id] = true;
    schedule(time.detached(),
             is_insert  ? Entry_kind::insert
             : is_erase ? Entry_kind::erase
                        : Entry_kind::trajectory,
             id, motion);
  }
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_SNAPSHOT_IMPL_H
