// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Contact_turns.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_TURNS_IMPL_H
#define KINETRI_SRC_SIMULATION_CONTACT_TURNS_IMPL_H

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/plain_loop.h"
#include "simulation/contact_turns.h"

namespace kinetri::detail {

template <class Simulation>
bool Contact_turns<Simulation>::can_run(const Simulation& simulation) {
  const auto& options = simulation.options_;
  return options.max_contacts_per_instant > 0 &&
         (!options.response || options.response_is_pure || is_pure(options.response)) &&
         !is_log_contact(options.response) && !is_erase_both(options.response) &&
         simulation.overlap_observers_.empty() &&
         std::ranges::none_of(simulation.observers_, &Event_observer::looks_at_triangulation);
}

// ---- the plain loop ----

template <class Simulation>
bool Contact_turns<Simulation>::settle(const Time& until) {
  simulation_->settle();
  return !queue().empty() &&
         queue().is_due(queue().top(), until.interval(), [&]() -> const Time& { return until; });
}

template <class Simulation>
void Contact_turns<Simulation>::run_to(const Time& until, const std::function<bool()>& may_go_on) {
  while (may_go_on == nullptr || may_go_on()) {
    if (simulation_->step_in_parts(&until) > 0) continue;
    Plain_loop<typename Simulation::Triangulation>::run_to(simulation_->triangulation_, until);
    return;
  }
}

// ---- the queue ----

template <class Simulation>
template <class In_parallel>
void Contact_turns<Simulation>::divide(std::size_t count, const In_parallel& in_parallel) {
  using Subject = typename Simulation::Subject;
  constexpr Point_id points_per_block = 2048;
  struct Block {
    Point_id first;
    Point_id last;
    std::vector<Subject> changes = {};
  };
  std::vector<Block> blocks;
  const Point_id ids = simulation_->triangulation_.next_id();
  for (Point_id first = 0; first < ids; first += points_per_block) {
    blocks.push_back({first, std::min(ids, first + points_per_block)});
  }
  Block& of_changes = blocks.emplace_back(Block{ids, ids});
  queue().for_each([&](const Entry& entry) {
    if (!is_contact(entry)) of_changes.changes.push_back(entry.subject());
  });
  const auto for_each_subject = [this](const Block& block, const auto& function) {
    for (Point_id id = block.first; id < block.last; ++id) {
      const auto* const contacts = simulation_->find_contacts(id);
      if (contacts == nullptr) continue;
      if (contacts->wall_event != no_event) function(Subject{Entry_kind::wall, id, no_point});
      for (const auto& [other, event] : contacts->partners) {
        if (id < other) function(Subject{Entry_kind::collision, id, other});
      }
    }
    for (const Subject& change : block.changes) function(change);
  };
  queue().distribute(count, blocks, for_each_subject, in_parallel);
}

template <class Simulation>
std::array<Point_id, 2> Contact_turns<Simulation>::points(const Entry& entry) {
  return {entry.point_a, entry.kind == Entry_kind::collision ? entry.point_b : no_point};
}

template <class Simulation>
auto Contact_turns<Simulation>::pair(const Edge_ids& pair) -> Entry {
  Entry result;
  result.kind = Entry_kind::collision;
  result.point_a = pair[0];
  result.point_b = pair[1];
  result.is_edge = true;
  return result;
}

template <class Simulation>
template <class Function>
void Contact_turns<Simulation>::for_each_handle(Point_id id, const Function& function) const {
  const auto* const contacts = simulation_->find_contacts(id);
  if (contacts == nullptr) return;
  if (contacts->wall_event != no_event) function(contacts->wall_event);
  if (!has_pairs()) return;
  for (const auto& partner : contacts->partners) function(partner.event);
}

// ---- contacts ----

template <class Simulation>
auto Contact_turns<Simulation>::changes(const Entry& entry, const Time& now) const
    -> std::vector<Change> {
  std::vector<Change> result;
  // A radius that shrinks ends at another time then.
  const auto is_for_loop = [this](Point_id id) {
    const auto* const contacts = simulation_->find_contacts(id);
    return passing_.contains(id) || (contacts != nullptr && contacts->vanish_event != no_event);
  };
  if (std::ranges::any_of(points(entry), is_for_loop)) return result;
  try {
    if (entry.kind == Entry_kind::wall) {
      result.push_back(simulation_->reflection(entry.point_a, entry.point_b, now));
    } else {
      result = simulation_->collision(entry.point_a, entry.point_b, now);
    }
  } catch (...) {
    return {};  // the plain loop throws it again, in its turn
  }
  if (std::ranges::any_of(result, [](const Change& change) { return !change.motion; })) return {};
  return result;
}

template <class Simulation>
auto Contact_turns<Simulation>::certificate(const Entry& entry, const Time& after,
                                            Certificate_counters& counters) const
    -> std::pair<Entry, Certificate> {
  if (entry.kind == Entry_kind::wall) {
    return simulation_->first_wall(entry.point_a, after, counters);
  }
  std::pair<Entry, Certificate> result = {
      entry, simulation_->traits_.contact_certificate(simulation_->point(entry.point_a),
                                                      simulation_->point(entry.point_b),
                                                      simulation_->diameter_, after)};
  counters.count(result.second);
  return result;
}

template <class Simulation>
template <class Put>
void Contact_turns<Simulation>::for_each_contact(Points points, const Time& now,
                                                 Certificate_counters& counters,
                                                 const Put& put) const {
  const auto put_both = [&put](std::pair<Entry, Certificate>&& contact) {
    put(contact.first, std::move(contact.second));
  };
  if (simulation_->options_.box) {
    for (const Point_id id : points) put_both(simulation_->first_wall(id, now, counters));
  }
  if (!has_pairs()) return;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point_id id = points[k];
    simulation_->for_each_neighbor(id, [&](Point_id other) {
      if (is_one(points.first(k), other)) return;
      put_both(certificate(pair(edge_ids(id, other)), now, counters));
    });
  }
}

template <class Simulation>
bool Contact_turns<Simulation>::certify(const std::array<Point_id, 2>& points, Points turned,
                                        const Time& now, Certificate_counters& counters,
                                        std::vector<std::pair<Entry, Certificate>>& result) const {
  bool may_go_on = true;
  bool are_neighbors = points[1] == no_point || !has_pairs();
  for_each_contact(turned, now, counters, [&](const Entry& entry, Certificate&& known) {
    if (entry.kind == Entry_kind::collision) {
      if (is_one(points, entry.point_a) && is_one(points, entry.point_b)) {
        are_neighbors = true;
      } else if (known.may_vanish && do_meet(entry.point_a, entry.point_b, now)) {
        may_go_on = false;
      }
    }
    result.emplace_back(entry, std::move(known));
  });
  if (!has_pairs()) return true;
  if constexpr (Simulation::has_radii) {
    // Discs that have a place of this one in their power cells; see Simulation_2::owners_in.
    for (const Point_id id : turned) {
      for (const Point_id partner : points) {
        if (partner == id || partner == no_point) continue;
        if (is_centre_in(id, partner, now)) may_go_on = false;
        simulation_->for_each_neighbor(partner, [&](Point_id other) {
          if (!is_one(points, other) && do_meet(id, other, now)) may_go_on = false;
        });
      }
    }
  }
  for (const Point_id id : points) {
    if (id == no_point || is_one(turned, id)) continue;
    simulation_->for_each_neighbor(id, [&](Point_id other) {
      if (!is_one(points, other) && do_meet(id, other, now)) may_go_on = false;
    });
  }
  return may_go_on && are_neighbors;
}

template <class Simulation>
bool Contact_turns<Simulation>::do_meet(Point_id a, Point_id b, const Time& now) const {
  return simulation_->may_touch(a, b, simulation_->traits_, now);
}

// Whether the centre of a disc is in another one.
template <class Simulation>
bool Contact_turns<Simulation>::is_centre_in(Point_id id, Point_id other, const Time& now) const {
  auto centre = simulation_->point(id).motion();
  if constexpr (Simulation::has_radii) centre.radius = centre.growth = 0;
  return simulation_->traits_.do_touch(typename Simulation::Point_2(centre, id),
                                       simulation_->point(other), simulation_->diameter_, now);
}

// ---- windows ----

template <class Simulation>
bool Contact_turns<Simulation>::begin_window(double begin) {
  scheduled_ = simulation_->scheduled_;
  auto& contacts = simulation_->contacts_;
  contacts.resize(simulation_->triangulation_.next_id());
  if (!has_pairs()) return true;
  if (Simulation::has_radii &&
      (simulation_->triangulation_.number_of_hidden_points() > 0 || !have_areas())) {
    return false;
  }
  // Two that have just touched are apart at the next event, if they are not now.
  const Time first(begin);
  if (drop_overlaps(std::max(first, simulation_->current_time()))) return true;
  put_passes_back();
  return false;
}

// Whether all radii are positive, unless for a moment. Only changes that are no contacts make one
// 0.
template <class Simulation>
bool Contact_turns<Simulation>::have_areas() {
  const auto& triangulation = simulation_->triangulation_;
  const auto& events = triangulation.counters().events;
  const std::uint64_t changes = events[static_cast<std::size_t>(Event_kind::insert)] +
                                events[static_cast<std::size_t>(Event_kind::trajectory)];
  if (changes_ == changes) return have_areas_;
  changes_ = changes;
  have_areas_ = true;
  if constexpr (Simulation::has_radii) {
    for (Point_id id = 0; id < triangulation.next_id() && have_areas_; ++id) {
      if (!triangulation.contains(id)) continue;
      const auto& disc = triangulation.motion(id);
      have_areas_ = disc.radius > 0 || disc.growth != 0;
    }
  }
  return have_areas_;
}

// Forgets the overlaps that are over at a time up to which nothing happens. Returns whether all of
// them are.
template <class Simulation>
bool Contact_turns<Simulation>::drop_overlaps(const Time& time) {
  const auto& contacts = simulation_->contacts_;
  for (Point_id id = 0; id < contacts.size(); ++id) {
    if (contacts[id] == nullptr) continue;
    const auto overlaps = contacts[id]->overlaps;
    for (const auto& [other, passes, is_edge] : overlaps) {
      if (simulation_->triangulation_.contains(id) && simulation_->triangulation_.contains(other) &&
          do_meet(id, other, time)) {
        return false;
      }
      simulation_->end_overlap(id, other);
      if (!passes) continue;
      passes_.push_back({id, other});
      passing_.insert({id, other});
    }
  }
  return true;
}

template <class Simulation>
void Contact_turns<Simulation>::put_passes_back() {
  for (const auto& [a, b] : passes_) {
    const bool is_edge = simulation_->is_edge({a, b});
    simulation_->start_overlap(a, b, is_edge);
    simulation_->mark_passing(a, b, true);
    simulation_->for_each_pair_beside(a, b, is_edge, [this](const Edge_ids& pair) {
      simulation_->watch(pair, false, simulation_->current_time());
    });
  }
  passes_.clear();
  passing_.clear();
}

template <class Simulation>
void Contact_turns<Simulation>::end_turn(const std::array<Point_id, 2>& points) {
  const auto [a, b] = points;
  if (b == no_point || !do_meet(a, b, simulation_->current_time())) return;
  const bool is_edge = simulation_->is_edge({a, b});
  simulation_->start_overlap(a, b, is_edge);
  simulation_->for_each_pair_beside(a, b, is_edge, [this](const Edge_ids& beside) {
    simulation_->watch(beside, false, simulation_->current_time());
  });
}

template <class Simulation>
void Contact_turns<Simulation>::end_window() {
  put_passes_back();
  KINETRI_PRECONDITION(simulation_->scheduled_ == scheduled_,
                       "an observer that does not look at the triangulation has scheduled a "
                       "change; let its looks_at_triangulation() return true");
}

template <class Simulation>
void Contact_turns<Simulation>::start_anew() {
  // By number: one that was being moved to another part may be in both.
  std::map<Point_id, std::pair<Entry, Time>> changes;
  for (std::size_t p = 0; p < queue().number_of_parts(); ++p) {
    const Part& part = queue().part(p);
    part.for_each([&](const Entry& entry) {
      if (!Simulation::is_change(entry.kind)) return;
      changes.try_emplace(entry.point_b, entry, part.time_of(entry));
    });
  }
  queue().clear();
  for (auto& contacts : simulation_->contacts_) {
    if (contacts == nullptr) continue;
    contacts->wall_event = contacts->vanish_event = no_event;
    contacts->partners.clear();
  }
  for (auto& [number, change] : changes) {
    auto& [entry, time] = change;
    simulation_->scheduled_changes_.at(number).event = queue().push(entry, std::move(time));
  }
  for (const auto& [a, b] : passes_) {
    simulation_->start_overlap(a, b, simulation_->is_edge({a, b}));
    simulation_->mark_passing(a, b, true);
  }
  passes_.clear();
  passing_.clear();
  simulation_->find_all_overlaps();
  simulation_->schedule_all();
}

template <class Simulation>
void Contact_turns<Simulation>::count(std::uint64_t contacts) {
  simulation_->counters_.instants += contacts;
  simulation_->counters_.most_at_one_time =
      std::max<std::uint64_t>(simulation_->counters_.most_at_one_time, contacts > 0 ? 1 : 0);
}

template <class Simulation>
void Contact_turns<Simulation>::count(const Certificate_counters& counted) {
  simulation_->certificate_counters_ += counted;
}

template <class Simulation>
void Contact_turns<Simulation>::count(const Discarded& discarded) {
  simulation_->counters_.discarded_walls += discarded.walls;
  simulation_->counters_.discarded_collisions += discarded.collisions;
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_TURNS_IMPL_H
