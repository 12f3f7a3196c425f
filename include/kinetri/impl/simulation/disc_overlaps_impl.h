// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2: which discs overlap, where they have radii of their own.
//
// Overlaps begin with a contact, or with a new motion of a disc. Let some discs have new motions,
// let all overlaps of the others be known, and let p, which has a new motion, and q, which has
// none, overlap at the place x. Without the discs of new motions x would be in the power cell of a
// disc v: its power there is that of q at most, and so not positive. So v is q or overlaps it, and
// it overlaps p. Now there are three cases (docs/MATH.md, section 8):
//
// - x is in the cell of v still: v is an owner of a place in p (`owners_in`);
// - v has a cell, but one that has become smaller: its neighbors include a disc with a new motion;
// - v has none: the triangle that hides it has not been there before, and so has a corner that is a
//   disc with a new motion.
//
// All such v are found (`discs_about`); q is one of them, or overlaps one of them. Radii that are 0
// need more: see find_overlaps_of_seeds and let_pass.
#ifndef KINETRI_IMPL_SIMULATION_DISC_OVERLAPS_IMPL_H
#define KINETRI_IMPL_SIMULATION_DISC_OVERLAPS_IMPL_H

#include <algorithm>
#include <span>
#include <vector>

#include "kinetri/impl/simulation/disc_boxes.h"
#include "kinetri/impl/simulation/disc_numbers.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

namespace detail {

inline void sort_and_remove_duplicates(std::vector<Point_id>& ids) {
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace detail

// The discs of new motions, and all that may overlap one of them.
template <ContactKineticTraits_2 Traits>
template <HasWeight M>
void Simulation_2<Traits>::find_new_overlaps(std::span<const Point_id> points) {
  std::vector<Point_id> candidates = discs_about(points);
  candidates.insert(candidates.end(), points.begin(), points.end());
  for (std::size_t i = 0, number = candidates.size(); i < number; ++i) {
    for (const Overlap& overlap : overlaps(candidates[i])) candidates.push_back(overlap.id);
  }
  detail::sort_and_remove_duplicates(candidates);
  std::erase_if(candidates, [&](Point_id id) { return !triangulation_.contains(id); });
  const auto examine = [&](Point_id a, Point_id b) {
    if (find_overlap({a, b}) == nullptr && may_touch(a, b, traits_)) {
      start_overlap(a, b, is_edge({a, b}));
    }
  };
  constexpr std::size_t few = 8;
  if (points.size() <= few) {
    for (const Point_id id : points) {
      if (!triangulation_.contains(id)) continue;
      for (const Point_id other : candidates) {
        if (other != id) examine(id, other);
      }
    }
  } else {
    for_each_close_pair(candidates, [&](Point_id a, Point_id b) {
      if (std::ranges::binary_search(points, a) || std::ranges::binary_search(points, b)) {
        examine(a, b);
      }
    });
  }
  find_overlaps_of_seeds(points);
}

// A seed is a disc that grows from 0, and its radius is 0 now. Of discs about the place of a seed
// whose rims meet there, those that overlap the seed from now on need have no other sign of it than
// that they touch it: so these are found by looking at all.
template <ContactKineticTraits_2 Traits>
template <HasWeight M>
void Simulation_2<Traits>::find_overlaps_of_seeds(std::span<const Point_id> points) {
  const auto examine = [&](Point_id a, Point_id b) {
    if (a != b && find_overlap({a, b}) == nullptr && may_touch(a, b, traits_)) {
      start_overlap(a, b, is_edge({a, b}));
    }
  };
  std::erase_if(seeds_, [&](Point_id id) { return !is_seed(id); });
  for (const Point_id id : points) {
    if (!triangulation_.contains(id)) continue;
    for (const Point_id seed : seeds_) examine(seed, id);
    if (!is_seed(id)) continue;
    seeds_.push_back(id);
    bool is_touched = is_hidden(id);
    for_each_neighbor(id, [&](Point_id other) {
      is_touched = is_touched || traits_.do_touch(point(id), point(other), 0, current_time());
    });
    if (!is_touched) continue;
    for (const Point_id other : present_points()) examine(id, other);
  }
}

template <ContactKineticTraits_2 Traits>
template <HasWeight M>
bool Simulation_2<Traits>::is_seed(Point_id id) const {
  if (!triangulation_.contains(id)) return false;
  const Motion& disc = triangulation_.motion(id);
  if (disc.radius > 0 && disc.epoch <= current_time().interval().lower) return false;
  return disc.growth > 0 && detail::zero_of_radius(disc) == current_time();
}

// Finds all seeds.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::keep_seeds() {
  if constexpr (has_radii) {
    seeds_.clear();
    for (const Point_id id : present_points()) {
      if (is_seed(id)) seeds_.push_back(id);
    }
  }
}

// The discs v of the comment above, and others.
template <ContactKineticTraits_2 Traits>
template <HasWeight M>
std::vector<Point_id> Simulation_2<Traits>::discs_about(std::span<const Point_id> points) const {
  const auto& triangulation = triangulation_.triangulation();
  if (triangulation.dimension() < 2) return present_points();
  std::vector<Point_id> result;
  for (const Point_id id : points) {
    if (!triangulation_.contains(id)) continue;
    const std::vector<Point_id> owners = owners_in(id);
    result.insert(result.end(), owners.begin(), owners.end());
    if (is_hidden(id)) continue;
    for_each_neighbor(id, [&](Point_id other) { result.push_back(other); });
    detail::for_each_face_at(triangulation, triangulation_.vertex(id), [&](auto face) {
      for (const auto& hidden : face->vertex_list()) result.push_back(hidden->point().id());
    });
  }
  return result;
}

// The discs that have a place in the disc of the point in their power cells, and perhaps others
// that touch it. Those cells are connected, since the disc is; and all of them touch it, since the
// power of such a place is not positive. Precondition: the dimension is 2.
template <ContactKineticTraits_2 Traits>
template <HasWeight M>
std::vector<Point_id> Simulation_2<Traits>::owners_in(Point_id id) const {
  std::vector<Point_id> result = {owner_of_centre(id)};
  for (std::size_t i = 0; i < result.size(); ++i) {
    for_each_neighbor(result[i], [&](Point_id other) {
      if (std::ranges::find(result, other) == result.end() && may_touch(id, other, traits_)) {
        result.push_back(other);
      }
    });
  }
  return result;
}

// The disc in whose power cell the centre of a disc is just after the present time: mostly the disc
// itself. From a disc that has not the least power there an edge leads to one that has less.
template <ContactKineticTraits_2 Traits>
template <HasWeight M>
Point_id Simulation_2<Traits>::owner_of_centre(Point_id id) const {
  const auto& triangulation = triangulation_.triangulation();
  if (!is_hidden(id)) {
    Motion centre = triangulation_.motion(id);
    centre.radius = centre.growth = 0;
    bool is_in_none = true;
    for_each_neighbor(id, [&](Point_id other) {
      is_in_none = is_in_none &&
                   !traits_.do_touch(Point_2(centre, id), point(other), diameter_, current_time());
    });
    if (is_in_none) return id;
  }
  const auto compare_powers = triangulation.geom_traits().compare_power_distance_2_object();
  const Point_2& p = point(id);
  auto owner = triangulation_.vertex(id);
  if (is_hidden(id)) {
    const auto face = owner->face();
    owner = face->vertex(triangulation.is_infinite(face->vertex(0)) ? 1 : 0);
  }
  for (bool has_moved = true; has_moved;) {
    has_moved = false;
    auto best = owner;
    detail::for_each_neighbor(triangulation, owner, [&](auto other) {
      if (compare_powers(p, other->point(), best->point()) == CGAL::SMALLER) {
        best = other;
        has_moved = true;
      }
    });
    owner = best;
  }
  return owner->point().id();
}

// Calls `function` with the smaller and the greater id of each two of the discs that may touch now,
// and others.
template <ContactKineticTraits_2 Traits>
template <class Function>
void Simulation_2<Traits>::for_each_close_pair(std::span<const Point_id> ids,
                                               Function function) const {
  const Double_interval times = current_time().tight_interval();
  std::vector<detail::Disc_box> boxes;
  for (const Point_id id : ids) {
    boxes.push_back(detail::box_around(triangulation_.motion(id), id, times.lower, times));
  }
  detail::for_each_pair_of_boxes(
      boxes, [&](Point_id a, Point_id b) { function(std::min(a, b), std::max(a, b)); });
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_DISC_OVERLAPS_IMPL_H
