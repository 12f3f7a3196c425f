// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2: which discs overlap, and which pairs are watched because of that.
//
// A pair (p, q), p < q, is watched if pq is an edge, or if there is an edge wq to a point w whose
// disc overlaps those of p and q. Let p and q come into contact. The points in the closed disc with
// diameter pq are connected by edges inside of it, so there is a path from p to q; if that is not
// the edge pq, then the last point before q is such a point w.
//
// Discs of any radii: pq is an edge of the regular triangulation, or there is a disc that overlaps
// both, whether it has edges or not (docs/MATH.md, section 8; disc_overlaps_impl.h). Two that
// overlap each other are watched too, as no other one need overlap them, and they need have no
// edge; and a hidden point of radius 0 and the corners of the triangle that hides it
// (hidden_links_impl.h), which count as edges here.
#ifndef KINETRI_IMPL_SIMULATION_OVERLAPS_IMPL_H
#define KINETRI_IMPL_SIMULATION_OVERLAPS_IMPL_H

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/simulation/shortest_text.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::overlaps(Point_id id) const -> const std::vector<Overlap>& {
  static const std::vector<Overlap> none;
  const Contacts* const contacts = find_contacts(id);
  return contacts == nullptr ? none : contacts->overlaps;
}

// The record of a pair that overlaps; null if there is none.
template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::find_overlap(const Edge_ids& pair) const -> const Overlap* {
  // Both have a record; a large disc may overlap many.
  const bool is_second_shorter = overlaps(pair[1]).size() < overlaps(pair[0]).size();
  const std::vector<Overlap>& shorter = overlaps(pair[is_second_shorter ? 1 : 0]);
  const auto overlap = std::ranges::find(shorter, pair[is_second_shorter ? 0 : 1], &Overlap::id);
  return overlap == shorter.end() ? nullptr : &*overlap;
}

template <ContactKineticTraits_2 Traits>
std::vector<Point_id> Simulation_2<Traits>::overlapping_discs(Point_id id) const {
  KINETRI_PRECONDITION(options_.response != nullptr,
                       "overlaps are followed only with a response; log_contact changes nothing");
  KINETRI_PRECONDITION(triangulation_.contains(id), detail::unknown_id_problem(id));
  const Traits exact = traits_.exact();
  std::vector<Point_id> result;
  for (const Overlap& overlap : overlaps(id)) {
    if (triangulation_.contains(overlap.id) && may_touch(id, overlap.id, traits_) &&
        exact.may_overlap(point(id), point(overlap.id), diameter_, current_time())) {
      result.push_back(overlap.id);
    }
  }
  std::ranges::sort(result);
  return result;
}

template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::is_hidden(Point_id id) const {
  return triangulation_.is_hidden(id);
}

// Whether the discs overlap just after the present time; or touch, if they have radii of their own.
// Or true if unsure.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::may_touch(Point_id a, Point_id b, const Traits& traits) const {
  return may_touch(a, b, traits, current_time());
}

// The same just after a time.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::may_touch(Point_id a, Point_id b, const Traits& traits,
                                     const Time& time) const {
  return traits.may_overlap(point(a), point(b), diameter_, time) ||
         (has_radii && traits.do_touch(point(a), point(b), diameter_, time));
}

// The points whose discs overlap that of a point just after the present time, and perhaps some
// whose discs almost do. Edges connect them to the point, and are walked along.
template <ContactKineticTraits_2 Traits>
std::vector<Point_id> Simulation_2<Traits>::overlapping_points(Point_id id,
                                                               const Traits& traits) const {
  std::vector<Point_id> result;
  const auto add_neighbors = [&](Point_id of) {
    for_each_neighbor(of, [&](Point_id other) {
      if (other != id && std::ranges::find(result, other) == result.end() &&
          may_touch(id, other, traits)) {
        result.push_back(other);
      }
    });
  };
  add_neighbors(id);
  for (std::size_t i = 0; i < result.size(); ++i) add_neighbors(result[i]);
  return result;
}

// Whether the triangulation has both points, with an edge. Entries and overlaps know that too,
// where it matters: they need no triangulation, and tell it faster. An edge of which nothing is
// known has no entry because its discs never touch.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::is_edge(const Edge_ids& pair) const {
  if (!triangulation_.contains(pair[0]) || !triangulation_.contains(pair[1])) return false;
  bool result = false;
  for_each_neighbor(pair[0], [&](Point_id other) { result = result || other == pair[1]; });
  return result;
}

// The handle of the entry of a pair; no_event if there is none.
template <ContactKineticTraits_2 Traits>
Queue_handle Simulation_2<Traits>::find_pair(const Edge_ids& pair) const {
  const Contacts* const contacts = find_contacts(pair[0]);
  if (contacts == nullptr) return no_event;
  const auto partner = std::ranges::find(contacts->partners, pair[1], &Partner::id);
  return partner == contacts->partners.end() ? no_event : partner->event;
}

// Whether there still is a reason to watch a pair that has an entry.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::is_watched(const Edge_ids& pair) const {
  return queue_[find_pair(pair)].is_edge || is_overlapped(pair);
}

// Whether the pair is watched because of a disc that overlaps both; or, of discs that have radii of
// their own, because they overlap each other.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::is_overlapped(const Edge_ids& pair) const {
  if constexpr (has_radii) {
    if (find_overlap(pair) != nullptr) return true;
    const bool is_second_shorter = overlaps(pair[1]).size() < overlaps(pair[0]).size();
    const Point_id few = pair[is_second_shorter ? 1 : 0];
    const Point_id many = pair[is_second_shorter ? 0 : 1];
    return std::ranges::any_of(overlaps(few), [&](const Overlap& overlap) {
      return find_overlap({overlap.id, many}) != nullptr;
    });
  }
  return std::ranges::any_of(overlaps(pair[0]), [&](const Overlap& overlap) {
    const Overlap* const beside = find_overlap({overlap.id, pair[1]});
    return beside != nullptr && beside->is_edge;
  });
}

// Schedules the contact of a pair that has none, as an edge has come or as a disc overlaps both.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::watch(const Edge_ids& pair, bool is_edge, const Time& after) {
  const Queue_handle event = find_pair(pair);
  if (event == no_event) {
    schedule_pair(pair, is_edge, after);
  } else if (is_edge) {
    queue_.amend(event, [](Entry& entry) { entry.is_edge = true; });
  }
}

// The same, unless `change` schedules the pair's contact later.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::watch_unless_changing(const Edge_ids& pair, bool is_edge,
                                                 const Time& after) {
  if (!is_changing(pair)) watch(pair, is_edge, after);
}

// Whether one of the two is being changed.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::is_changing(const Edge_ids& pair) const {
  return std::ranges::any_of(
      pair, [&](Point_id id) { return std::ranges::binary_search(changing_points_, id); });
}

// To be called when a reason to watch the pair has gone.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::unwatch(const Edge_ids& pair) {
  if (find_pair(pair) != no_event && !is_watched(pair)) unschedule_pair(pair);
}

// Calls `function` with the pairs that are watched because the discs of a and b overlap. `is_edge`
// says whether there is an edge between them.
template <ContactKineticTraits_2 Traits>
template <class Function>
void Simulation_2<Traits>::for_each_pair_beside(Point_id a, Point_id b, bool is_edge,
                                                Function function) const {
  if constexpr (has_radii) function(edge_ids(a, b));
  // Mostly the two overlap no others.
  const auto has_others = [&](Point_id p, Point_id w) {
    return std::ranges::any_of(overlaps(p), [w](const Overlap& other) { return other.id != w; });
  };
  if (!has_others(a, b) && !has_others(b, a)) return;
  const auto as_first = [&](Point_id p, Point_id w) {
    for (const Overlap& overlap : overlaps(w)) {
      if (has_radii ? p != overlap.id : p < overlap.id && overlap.is_edge) {
        function(edge_ids(p, overlap.id));
      }
    }
  };
  as_first(a, b);
  as_first(b, a);
  if (!has_radii && is_edge) for_each_pair_over({a, b}, function);
}

// Calls `function` with the greater point of each pair that is watched because of a disc that
// overlaps both, and of which `first` is the smaller one; perhaps more than once. counts(a, b) says
// whether a record of an overlap counts.
template <ContactKineticTraits_2 Traits>
template <class Counts, class Function>
void Simulation_2<Traits>::for_each_pair_of(Point_id first, const Counts& counts,
                                            Function function) const {
  for (const Overlap& between : overlaps(first)) {
    if (!counts(first, between.id)) continue;
    if (has_radii && first < between.id) function(between.id);
    for (const Overlap& overlap : overlaps(between.id)) {
      if (first < overlap.id && (has_radii || overlap.is_edge) && counts(between.id, overlap.id)) {
        function(overlap.id);
      }
    }
  }
}

// Calls `function` with the pairs that are watched because of an edge, but for its own ends.
// Precondition: the discs at the ends overlap.
template <ContactKineticTraits_2 Traits>
template <class Function>
void Simulation_2<Traits>::for_each_pair_over(const Edge_ids& edge, Function function) const {
  const auto [a, b] = edge;
  for (const Overlap& overlap : overlaps(a)) {
    if (overlap.id < b) function(Edge_ids{overlap.id, b});
  }
  for (const Overlap& overlap : overlaps(b)) {
    if (overlap.id < a) function(Edge_ids{overlap.id, a});
  }
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::find_all_overlaps() {
  if (!options_.response && !options_.refuses_overlaps) return;
  if constexpr (has_radii) {
    keep_seeds();
    for_each_close_pair(present_points(), [&](Point_id a, Point_id b) {
      if (may_touch(a, b, traits_)) start_overlap(a, b, is_edge({a, b}));
    });
  } else {
    // A point that overlaps others overlaps a neighbor.
    std::vector<bool> has_overlaps(triangulation_.next_id());
    using Pairs = std::vector<Edge_ids>;
    const auto blocks =
        make_for_edges<Pairs>([this](const Edge_ids& edge, const Time& now, Pairs& made) {
          if (may_touch(edge[0], edge[1], traits_, now)) made.push_back(edge);
        });
    for (const Pairs& block : blocks) {
      for (const auto& [a, b] : block) has_overlaps[a] = has_overlaps[b] = true;
    }
    for (const Point_id id : present_points()) {
      if (!has_overlaps[id]) continue;
      for (const Point_id other : overlapping_points(id, traits_)) {
        start_overlap(id, other, is_edge({id, other}));
      }
    }
  }
}

template <ContactKineticTraits_2 Traits>
std::vector<Point_id> Simulation_2<Traits>::present_points() const {
  std::vector<Point_id> result;
  for (Point_id id = 0; id < triangulation_.next_id(); ++id) {
    if (triangulation_.contains(id)) result.push_back(id);
  }
  return result;
}

// Whether the discs overlap at the present time, exactly; touching is not enough.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::do_overlap(const Point_2& p, const Point_2& q) const {
  return traits_.do_touch(p, q, diameter_, current_time()) &&
         sign_at(contact_polynomial(p, q, diameter_), current_time()) == CGAL::NEGATIVE;
}

// Precondition: all overlaps are known.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::refuse_overlaps() const {
  std::vector<Edge_ids> pairs;
  for (const Point_id id : present_points()) {
    for (const Overlap& overlap : overlaps(id)) {
      if (id < overlap.id && do_overlap(point(id), point(overlap.id))) {
        pairs.push_back({id, overlap.id});
      }
    }
  }
  refuse(std::move(pairs));
}

// For a point that is to be inserted. O(n).
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::refuse_overlaps_of(const Point_2& p) const {
  std::vector<Edge_ids> pairs;
  for (const Point_id id : present_points()) {
    if (do_overlap(point(id), p)) pairs.push_back(edge_ids(id, p.id()));
  }
  refuse(std::move(pairs));
}

// Throws if there are such pairs.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::refuse(std::vector<Edge_ids> pairs) const {
  if (pairs.empty()) return;
  std::ranges::sort(pairs);
  const auto [a, b] = pairs.front();
  const std::string message =
      "discs " + std::to_string(a) + " and " + std::to_string(b) +
      " overlap at t = " + detail::text(current_time()) +
      (pairs.size() > 1 ? ", and " + std::to_string(pairs.size() - 1) + " more pairs" : "") +
      "; expected discs that are apart or touch";
  throw Overlapping_discs_error(std::move(pairs), message);
}

// Makes a record of a pair that overlaps, if there is none. `is_edge` is false too where that is
// not known because the two do not overlap.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::start_overlap(Point_id a, Point_id b, bool is_edge) {
  if (find_overlap({a, b}) == nullptr) {
    contacts_of(a).overlaps.push_back({b, false, is_edge});
    contacts_of(b).overlaps.push_back({a, false, is_edge});
  } else if (is_edge) {
    amend_overlap({a, b}, [](Overlap& overlap) { overlap.is_edge = true; });
  }
}

// Calls `amend` with both records of a pair that overlaps.
template <ContactKineticTraits_2 Traits>
template <class Amend>
void Simulation_2<Traits>::amend_overlap(const Edge_ids& pair, const Amend& amend) {
  amend(*std::ranges::find(contacts_of(pair[0]).overlaps, pair[1], &Overlap::id));
  amend(*std::ranges::find(contacts_of(pair[1]).overlaps, pair[0], &Overlap::id));
}

// Forgets a pair that has a record. The points need not be there any more.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::end_overlap(Point_id a, Point_id b) {
  const bool is_edge = find_overlap({a, b})->is_edge;
  const auto forget = [this](Point_id id, Point_id other) {
    std::erase_if(contacts_of(id).overlaps,
                  [&](const Overlap& overlap) { return overlap.id == other; });
  };
  forget(a, b);
  forget(b, a);
  for_each_pair_beside(a, b, is_edge, [this](const Edge_ids& pair) { unwatch(pair); });
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::mark_passing(Point_id a, Point_id b, bool passes) {
  amend_overlap({a, b}, [&](Overlap& overlap) { overlap.passes = passes; });
}

// Two discs in contact that overlap from now on, and have no contact until they have separated.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::let_pass(Point_id a, Point_id b, bool is_edge) {
  for (const Point_id id : {a, b}) {
    end_passes(id);
    drop_overlaps(id);
    if constexpr (!has_radii) find_new_overlaps_of(id);
  }
  start_overlap(a, b, is_edge);
  mark_passing(a, b, true);
  for_each_pair_beside(a, b, is_edge,
                       [this](const Edge_ids& pair) { watch(pair, false, current_time()); });
  for (const Point_id id : {a, b}) {
    if (!is_without_area(id)) continue;
    find_new_overlaps_of(id);
    schedule_pairs_beside(id);
  }
}

// Ends the passes of a point that are over, because the discs have separated: to be called before
// the point gets another motion, with which it may come into contact again.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::end_passes(Point_id id) {
  if (std::ranges::none_of(overlaps(id), &Overlap::passes)) return;
  const std::vector<Overlap> known = overlaps(id);
  for (const Overlap& overlap : known) {
    if (overlap.passes && !is_passing(id, overlap.id)) end_overlap(id, overlap.id);
  }
}

// Whether two discs that a response has let pass have not separated since. They have where their
// next contact, which is after that, is now.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::is_passing(Point_id a, Point_id b) {
  if (!triangulation_.contains(a) || !triangulation_.contains(b) ||
      !traits_.do_touch(point(a), point(b), diameter_, current_time())) {
    return false;
  }
  const Queue_handle event = find_pair({a, b});
  return event == no_event || !queue_[event].is_event ||
         queue_.time(queue_[event]) > current_time();
}

// Brings the overlaps of points that have got other motions, come or gone up to date, where those
// at edges are known.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::update_overlaps(std::span<const Point_id> points) {
  if (!options_.response) return;
  for (const Point_id id : points) drop_overlaps(id);
  if constexpr (has_radii) {
    find_new_overlaps(points);
  } else {
    for (const Point_id id : points) find_new_overlaps_of(id);
  }
}

// Forgets the overlaps that are over: all of them if the point is not there any more.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::drop_overlaps(Point_id id) {
  for (std::size_t i = 0; i < overlaps(id).size();) {
    const auto [other, passes, is_edge] = overlaps(id)[i];
    if (passes || (triangulation_.contains(id) && triangulation_.contains(other) &&
                   may_touch(id, other, traits_))) {
      ++i;
    } else {
      end_overlap(id, other);
    }
  }
}

// The overlaps of a point that are not at its edges are among those of the discs that it overlaps:
// all points of a path of edges from p to q, within the closed disc with diameter pq, overlap one
// another. If the discs of p and q do overlap from now on, and there is an edge between them, the
// pair has an entry that says so: its contact is now.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::find_new_overlaps_of(Point_id id) {
  for (std::size_t i = 0; i < overlaps(id).size(); ++i) {
    const Point_id between = overlaps(id)[i].id;
    for (std::size_t k = 0; k < overlaps(between).size(); ++k) {
      const Point_id other = overlaps(between)[k].id;
      if (other != id && find_overlap({id, other}) == nullptr && triangulation_.contains(other) &&
          may_touch(id, other, traits_)) {
        const Queue_handle event = find_pair({id, other});
        start_overlap(id, other, event != no_event && queue_[event].is_edge);
      }
    }
  }
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_OVERLAPS_IMPL_H
