// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Overlap_tracker.
#ifndef KINETRI_SRC_SIMULATION_OVERLAP_TRACKER_IMPL_H
#define KINETRI_SRC_SIMULATION_OVERLAP_TRACKER_IMPL_H

#include <algorithm>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "simulation/contact_schedule_impl.h"
#include "simulation/overlap_tracker.h"

namespace kinetri::detail {

// ---- all points ----

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::find_all() {
  if (!setup_.has_response() && !setup_.options().refuses_overlaps) return;
  if constexpr (has_radii) {
    seeds_.clear();
    const std::vector<Point_id> points = geometry_.present_points();
    std::ranges::copy_if(points, std::back_inserter(seeds_),
                         [this](Point_id id) { return geometry_.is_seed(id); });
    geometry_.for_each_close_pair(points, [&](Point_id a, const Disc& b) {
      if (geometry_.may_touch(a, b)) {
        records_.start_overlap(a, b, geometry_.is_edge(pair_from(a, b)));
      }
    });
  } else {
    // A point that overlaps others overlaps a neighbor.
    std::vector<bool> has_overlaps(geometry_.number_of_ids());
    using Pairs = std::vector<Pair>;
    const auto blocks = geometry_.template make_for_edges<Pairs>(
        [this](const Pair& edge, const Time& now, Pairs& made) {
          if (geometry_.may_touch(ids_of(edge)[0], second_of(edge), geometry_.traits(), now)) {
            made.push_back(edge);
          }
        });
    for (const Pairs& block : blocks) {
      for (const Pair& edge : block) {
        for (const Point_id id : ids_of(edge)) has_overlaps[id] = true;
      }
    }
    for (const Point_id id : geometry_.present_points()) {
      if (!has_overlaps[id]) continue;
      for (const Disc& other : geometry_.overlapping_points(id, geometry_.traits())) {
        records_.start_overlap(id, other, geometry_.is_edge(pair_from(id, other)));
      }
    }
  }
}

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::schedule_all_pairs() {
  if (!setup_.has_response()) return;
  struct Made {
    std::vector<std::pair<Pair, Certificate>> contacts;
    Certificate_counters counters;
  };
  auto blocks = geometry_.template make_for_edges<Made>(
      [this](const Pair& edge, const Time& now, Made& made) {
        Certificate certificate = schedule_.pair_certificate(edge, now, geometry_.traits());
        made.counters.count(certificate);
        if (certificate.kind == Certificate::Kind::never_fails) return;
        made.contacts.emplace_back(edge, std::move(certificate));
      });
  for (Made& block : blocks) {
    schedule_.certificate_counters() += block.counters;
    for (auto& [edge, certificate] : block.contacts) {
      schedule_.push_pair(edge, true, std::move(certificate));
    }
    block = {};
  }
  keep_links();
  // Each pair once, even if several discs overlap both.
  const auto count_all = [](Point_id /*a*/, const Disc& /*b*/) { return true; };
  std::vector<Disc> others;
  for (Point_id id = 0; id < geometry_.number_of_ids(); ++id) {
    others.clear();
    for_each_pair_of(id, count_all, [&](const Disc& other) { others.push_back(other); });
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const Disc& other : others) watch(pair_from(id, other), false);
  }
}

// Stores the links of all points.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::keep_links() {
  if constexpr (has_radii) {
    records_.for_each([](Contact_record& record) { record.corners.clear(); });
    for (const Point_id id : geometry_.present_points()) {
      std::vector<Disc> corners = geometry_.corners_of(id);
      if (!corners.empty()) records_.of(id).corners = std::move(corners);
    }
  }
}

// ---- pairs that are watched ----

// Watches a pair, because it has an edge or a disc overlaps both.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::watch(const Pair& pair, bool is_edge) {
  const Queue_handle event = records_.pair_event(pair);
  if (event == no_event) {
    schedule_.schedule_pair(pair, is_edge, geometry_.current_time());
  } else if (is_edge) {
    schedule_.queue().amend(event, [](Contact_entry& entry) { entry.is_edge = true; });
  }
}

// Watches the pairs that follow from the overlap of a and b.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::watch_beside(Point_id a, const Disc& b,
                                                             bool is_edge, Points changing) {
  for_each_pair_beside(a, b, is_edge, [&](const Pair& pair) {
    if (!is_changing(pair, changing)) watch(pair, false);
  });
}

// Called when a reason to watch the pair has ended.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::unwatch(const Pair& pair) {
  if (records_.pair_event(pair) != no_event && !is_watched(pair)) schedule_.unschedule_pair(pair);
}

template <class Traits>
bool Simulation_types<Traits>::Overlap_tracker::is_watched(const Pair& pair) const {
  return schedule_.queue()[records_.pair_event(pair)].is_edge || is_overlapped(pair);
}

// Whether the pair is watched because of a disc that overlaps both or, with radii of their own,
// because they overlap.
template <class Traits>
bool Simulation_types<Traits>::Overlap_tracker::is_overlapped(const Pair& pair) const {
  const Point_id a = ids_of(pair)[0];
  const Disc b = second_of(pair);
  if constexpr (has_radii) {
    if (records_.find_overlap(pair) != nullptr) return true;
    if (records_.overlaps(id_of(b)).size() < records_.overlaps(a).size()) {
      return std::ranges::any_of(records_.overlaps(id_of(b)), [&](const Disc_overlap& overlap) {
        return records_.find_overlap(pair_from(a, beyond(b, overlap.disc))) != nullptr;
      });
    }
  }
  return std::ranges::any_of(records_.overlaps(a), [&](const Disc_overlap& overlap) {
    const Disc_overlap* const beside =
        records_.find_overlap(pair_from(id_of(overlap.disc), seen_from(overlap.disc, b)));
    return beside != nullptr && (has_radii || beside->is_edge);
  });
}

// Calls `function` with the pairs that are watched because the discs a and b overlap.
template <class Traits>
template <class Function>
void Simulation_types<Traits>::Overlap_tracker::for_each_pair_beside(Point_id a, const Disc& b,
                                                                     bool is_edge,
                                                                     Function function) const {
  if constexpr (has_radii) function(pair_of(a, b));
  const auto has_others = [&](Point_id p, const Disc& w) {
    return std::ranges::any_of(records_.overlaps(p),
                               [&w](const Disc_overlap& other) { return other.disc != w; });
  };
  if (!has_others(a, b) && !has_others(id_of(b), back_from(b, a))) return;
  const auto as_first = [&](Point_id p, const Disc& w) {
    for (const Disc_overlap& overlap : records_.overlaps(id_of(w))) {
      const Disc q = beyond(w, overlap.disc);
      if (has_radii ? q != geometry_.itself(p) : is_first(p, q) && overlap.is_edge) {
        function(pair_of(p, q));
      }
    }
  };
  as_first(a, b);
  as_first(id_of(b), back_from(b, a));
  if (!has_radii && is_edge) for_each_pair_over(pair_from(a, b), function);
}

template <class Traits>
template <class Counts, class Function>
void Simulation_types<Traits>::Overlap_tracker::for_each_pair_of(Point_id first,
                                                                 const Counts& counts,
                                                                 Function function) const {
  for (const Disc_overlap& between : records_.overlaps(first)) {
    if (!counts(first, between.disc)) continue;
    if (has_radii && is_first(first, between.disc)) function(between.disc);
    for (const Disc_overlap& overlap : records_.overlaps(id_of(between.disc))) {
      const Disc other = beyond(between.disc, overlap.disc);
      if (is_first(first, other) && (has_radii || overlap.is_edge) &&
          counts(id_of(between.disc), overlap.disc)) {
        function(other);
      }
    }
  }
}

// Calls `function` with the other pairs that are watched because of an edge. Precondition: the
// discs at its ends overlap.
template <class Traits>
template <class Function>
void Simulation_types<Traits>::Overlap_tracker::for_each_pair_over(const Pair& edge,
                                                                   Function function) const {
  const auto as_second = [&](Point_id w, const Disc& q) {
    for (const Disc_overlap& overlap : records_.overlaps(w)) {
      const Point_id p = id_of(overlap.disc);
      const Disc from_p = seen_from(overlap.disc, q);
      if (is_first(p, from_p)) function(pair_from(p, from_p));
    }
  };
  const Point_id a = ids_of(edge)[0];
  const Disc b = second_of(edge);
  as_second(a, b);
  as_second(id_of(b), back_from(b, a));
}

// ---- added and removed edges ----

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::follow(const Edge_trail& trail, Points changing) {
  for (const auto& [removed, added] : trail.edges) {
    if (removed) leave_edge(*removed);
    if (added) follow_edge(*added, changing);
  }
  for (const Point_id id : trail.hidden) {
    if (geometry_.contains(id)) follow_links(id, changing);
  }
}

// Whether one of the two is being changed.
template <class Traits>
bool Simulation_types<Traits>::Overlap_tracker::is_changing(const Pair& pair, Points changing) {
  return std::ranges::any_of(ids_of(pair),
                             [&](Point_id id) { return std::ranges::binary_search(changing, id); });
}

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::leave_edge(const Pair& edge) {
  const bool do_overlap = records_.find_overlap(edge) != nullptr;
  if (do_overlap) records_.mark_edge(edge, false);
  if (const Queue_handle event = records_.pair_event(edge); event != no_event) {
    if (is_overlapped(edge)) {
      schedule_.queue().amend(event, [](Contact_entry& entry) { entry.is_edge = false; });
    } else {
      schedule_.unschedule_pair(edge);
    }
  }
  if (do_overlap && !has_radii) {
    for_each_pair_over(edge, [this](const Pair& pair) { unwatch(pair); });
  }
}

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::follow_edge(const Pair& edge, Points changing) {
  if (!is_changing(edge, changing)) watch(edge, true);
  if (records_.find_overlap(edge) == nullptr) return;
  records_.mark_edge(edge, true);
  if (!has_radii) {
    for_each_pair_over(edge, [&](const Pair& pair) {
      if (!is_changing(pair, changing)) watch(pair, false);
    });
  }
}

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::follow_links(Point_id id, Points changing) {
  const std::vector<Disc> corners = geometry_.corners_of(id);
  const Contact_record* const known = records_.find(id);
  if (corners.empty() && (known == nullptr || known->corners.empty())) return;
  const std::vector<Disc> before = std::exchange(records_.of(id).corners, corners);
  for (const Disc& corner : before) {
    const Pair pair = pair_of(id, corner);
    if (!geometry_.is_edge(pair)) leave_edge(pair);
  }
  for (const Disc& corner : corners) {
    const Pair pair = pair_of(id, corner);
    follow_edge(pair, changing);
    // The point may stay on the boundary circle.
    if (is_changing(pair, changing) || records_.find_overlap(pair) != nullptr ||
        !geometry_.do_touch(id, corner, geometry_.current_time())) {
      continue;
    }
    records_.start_overlap(id, corner, true);
    watch_beside(id, corner, true, changing);
  }
}

// ---- points that change ----

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::schedule_pairs(Points points) {
  for (const Point_id id : points) end_passes(id);
  for (const Point_id id : points) {
    if (geometry_.contains(id)) schedule_edges(id, points);
  }
  update_overlaps(points);
  for (const Point_id id : points) {
    if (geometry_.contains(id)) {
      schedule_pairs_beside(id);
    } else {
      records_.forget_point(id);
    }
  }
}

// Schedules the contacts of a point at its edges, and records overlaps of neighbors. Points with
// smaller ids among `points` have been handled.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::schedule_edges(Point_id id, Points points) {
  if (!setup_.has_response()) return;
  geometry_.for_each_neighbor(id, [&](const Disc& other) {
    const bool is_done =
        id_of(other) == id ? !is_first(id, other)  // the edge to its own image comes twice
                           : id_of(other) < id && std::ranges::binary_search(points, id_of(other));
    if (is_done ||
        !schedule_.schedule_new_pair(pair_of(id, other), true, geometry_.current_time())) {
      return;
    }
    if (geometry_.may_touch(id, other)) records_.start_overlap(id, other, true);
  });
}

// Watches the pairs that follow from the overlaps of the point.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::schedule_pairs_beside(Point_id id) {
  for (const Disc_overlap& overlap : records_.overlaps(id)) {
    watch_beside(id, overlap.disc, overlap.is_edge);
  }
}

// ---- overlaps ----

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::start_overlap(Point_id a, const Disc& b,
                                                              bool is_edge) {
  records_.start_overlap(a, b, is_edge);
  watch_beside(a, b, is_edge);
}

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::start_pass(Point_id a, const Disc& b,
                                                           bool is_edge) {
  records_.start_overlap(a, b, is_edge);
  records_.mark_passing(a, b, true);
  watch_beside(a, b, is_edge);
}

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::end_overlap(Point_id a, const Disc& b) {
  const Disc other = b;  // it may be in the record
  const Disc_overlap* known = records_.find_overlap(pair_from(a, other));
  KINETRI_ASSERT(known != nullptr, "an overlap that is not recorded cannot end");
  const bool is_edge = known->is_edge;
  records_.forget_overlap(a, other);
  for_each_pair_beside(a, other, is_edge, [this](const Pair& pair) { unwatch(pair); });
}

template <class Traits>
bool Simulation_types<Traits>::Overlap_tracker::note_contact(const Contact_entry& contact) {
  if (contact.is_noted) return false;
  const Point_id a = contact.point_a;
  const Disc b = contact.disc_b();
  for (const Point_id id : {a, id_of(b)}) drop_overlaps(id);
  const auto overlaps_others = [&](Point_id id, const Disc& other) {
    return std::ranges::any_of(records_.overlaps(id),
                               [&](const Disc_overlap& overlap) { return overlap.disc != other; });
  };
  if (!overlaps_others(a, b) && !overlaps_others(id_of(b), back_from(b, a)) &&
      !schedule_.is_contact_due()) {
    return false;
  }
  Contact_entry noted = contact;
  noted.is_noted = true;
  schedule_.put_contact(noted);
  start_overlap(a, b, contact.is_edge);
  return true;
}

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::let_pass(Point_id a, const Disc& b, bool is_edge) {
  for (const Point_id id : {a, id_of(b)}) {
    end_passes(id);
    drop_overlaps(id);
    if constexpr (!has_radii) find_new_overlaps_of(id);
  }
  start_pass(a, b, is_edge);
  for (const Point_id id : {a, id_of(b)}) {
    if (!geometry_.is_without_area(id)) continue;
    find_new_overlaps_of(id);
    schedule_pairs_beside(id);
  }
}

template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::end_passes(Point_id id) {
  // A pair of images of one disc is in two of its records, which end together.
  for (std::size_t i = 0; i < records_.overlaps(id).size();) {
    const auto [other, passes, is_edge] = records_.overlaps(id)[i];
    if (passes && !is_passing(id, other)) {
      end_overlap(id, other);
    } else {
      ++i;
    }
  }
}

// Whether two discs that a response has let pass have not separated since. If their next contact is
// now, they have.
template <class Traits>
bool Simulation_types<Traits>::Overlap_tracker::is_passing(Point_id a, const Disc& b) {
  if (!geometry_.contains(a) || !geometry_.contains(id_of(b)) ||
      !geometry_.do_touch(a, b, geometry_.current_time())) {
    return false;
  }
  auto& queue = schedule_.queue();
  const Queue_handle event = records_.pair_event(pair_from(a, b));
  return event == no_event || !queue[event].is_event ||
         queue.time(queue[event]) > geometry_.current_time();
}

// Updates the overlaps of changed points; those at edges are recorded.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::update_overlaps(Points points) {
  if (!setup_.has_response()) return;
  for (const Point_id id : points) drop_overlaps(id);
  if constexpr (has_radii) {
    find_new_overlaps(points);
  } else {
    for (const Point_id id : points) find_new_overlaps_of(id);
  }
}

// Removes the overlaps that have ended: all of them if the point does not exist.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::drop_overlaps(Point_id id) {
  for (std::size_t i = 0; i < records_.overlaps(id).size();) {
    const auto [other, passes, is_edge] = records_.overlaps(id)[i];
    if (passes || (geometry_.contains(id) && geometry_.contains(id_of(other)) &&
                   geometry_.may_touch(id, other))) {
      ++i;
    } else {
      end_overlap(id, other);
    }
  }
}

// The overlaps of a point that are not at its edges are among those of the discs that it overlaps:
// all points of a path of edges from p to q, within the closed disc with diameter pq, overlap one
// another. If the discs of p and q overlap from now on and have an edge, the pair has an entry with
// is_edge: its contact is now.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::find_new_overlaps_of(Point_id id) {
  for (std::size_t i = 0; i < records_.overlaps(id).size(); ++i) {
    const Disc between = records_.overlaps(id)[i].disc;
    for (std::size_t k = 0; k < records_.overlaps(id_of(between)).size(); ++k) {
      const Disc other = beyond(between, records_.overlaps(id_of(between))[k].disc);
      if (other != geometry_.itself(id) && records_.find_overlap(pair_from(id, other)) == nullptr &&
          geometry_.contains(id_of(other)) && geometry_.may_touch(id, other)) {
        const Queue_handle event = records_.pair_event(pair_from(id, other));
        records_.start_overlap(id, other, event != no_event && schedule_.queue()[event].is_edge);
      }
    }
  }
}

// Records whether two discs overlap; in a periodic box, which images of the second one overlap.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::examine(Point_id a, Point_id b,
                                                        const Vectors& vectors) {
  geometry_.for_each_near(geometry_.point(a), b, vectors,
                          [&](const Disc& image) { examine(a, image); });
}
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::examine(Point_id a, const Disc& b) {
  if (b != geometry_.itself(a) && records_.find_overlap(pair_from(a, b)) == nullptr &&
      geometry_.may_touch(a, b)) {
    records_.start_overlap(a, b, geometry_.is_edge(pair_from(a, b)));
  }
}

// Finds the overlaps of discs with new motions.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::find_new_overlaps(Points points) {
  std::vector<Point_id> candidates = geometry_.discs_about(points);
  candidates.insert(candidates.end(), points.begin(), points.end());
  for (std::size_t i = 0, number = candidates.size(); i < number; ++i) {
    for (const Disc_overlap& overlap : records_.overlaps(candidates[i])) {
      candidates.push_back(id_of(overlap.disc));
    }
  }
  std::ranges::sort(candidates);
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  std::erase_if(candidates, [&](Point_id id) { return !geometry_.contains(id); });
  constexpr std::size_t few = 8;
  const Vectors vectors = geometry_.vectors();
  if (points.size() <= few) {
    for (const Point_id id : points) {
      if (!geometry_.contains(id)) continue;
      for (const Point_id other : candidates) examine(id, other, vectors);
    }
  } else {
    geometry_.for_each_close_pair(candidates, [&](Point_id a, const Disc& b) {
      if (std::ranges::binary_search(points, a) || std::ranges::binary_search(points, id_of(b))) {
        examine(a, b);
      }
    });
  }
  find_overlaps_of_seeds(points, vectors);
}

// A seed is a disc that grows, and its radius is 0 now. Discs whose boundary circles meet at its
// position may overlap it from now on without overlapping each other or being neighbors: so all
// discs are examined.
template <class Traits>
void Simulation_types<Traits>::Overlap_tracker::find_overlaps_of_seeds(Points points,
                                                                       const Vectors& vectors) {
  std::erase_if(seeds_, [&](Point_id id) { return !geometry_.is_seed(id); });
  for (const Point_id id : points) {
    if (!geometry_.contains(id)) continue;
    for (const Point_id seed : seeds_) examine(seed, id, vectors);
    if (!geometry_.is_seed(id)) continue;
    seeds_.push_back(id);
    bool is_touched = geometry_.is_hidden(id);
    geometry_.for_each_neighbor(id, [&](const Disc& other) {
      is_touched = is_touched || geometry_.do_touch(id, other, geometry_.current_time());
    });
    if (!is_touched) continue;
    for (const Point_id other : geometry_.present_points()) examine(id, other, vectors);
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_OVERLAP_TRACKER_IMPL_H
