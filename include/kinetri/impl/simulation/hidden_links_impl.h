// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2: the pairs that are watched because a triangle hides a point of
// radius 0.
//
// A point of radius 0 that enters a disc has no area in common with it, so that the places which
// the two share belong to no third disc that could tell of their contact. Its neighbors do, or, if
// it is hidden, the corners of the triangle that hides it: one of them contains the point as well
// (docs/MATH.md, section 8). So to the simulation these corners are its neighbors: they are linked.
#ifndef KINETRI_IMPL_SIMULATION_HIDDEN_LINKS_IMPL_H
#define KINETRI_IMPL_SIMULATION_HIDDEN_LINKS_IMPL_H

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

// Whether the radius of a disc is 0 from now on.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::is_without_area(Point_id id) const {
  if constexpr (has_radii) {
    const Motion& disc = triangulation_.motion(id);
    return disc.radius == 0 && disc.growth == 0;
  }
  return false;
}

// Calls `function` with the corners that a point is linked with: none unless it is hidden, and its
// radius is 0. In dimensions below 2 an edge or a vertex hides it.
template <ContactKineticTraits_2 Traits>
template <class Function>
void Simulation_2<Traits>::for_each_corner(Point_id id, Function function) const {
  if (!is_hidden(id) || !is_without_area(id)) return;
  const auto& triangulation = triangulation_.triangulation();
  const int dimension = triangulation.dimension();
  if (dimension == 0) return function(triangulation.finite_vertex()->point().id());
  const auto face = triangulation_.vertex(id)->face();
  for (int i = 0; i <= dimension; ++i) {
    if (!triangulation.is_infinite(face->vertex(i))) function(face->vertex(i)->point().id());
  }
}

// Calls `function` with the hidden points that a vertex is linked with.
template <ContactKineticTraits_2 Traits>
template <class Function>
void Simulation_2<Traits>::for_each_hidden_link(Point_id id, Function function) const {
  if constexpr (has_radii) {
    if (triangulation_.number_of_hidden_points() == 0) return;
    const auto& triangulation = triangulation_.triangulation();
    if (triangulation.dimension() < 2) {
      for (const Point_id hidden : present_points()) {
        for_each_corner(hidden, [&](Point_id corner) {
          if (corner == id) function(hidden);
        });
      }
      return;
    }
    detail::for_each_face_at(triangulation, triangulation_.vertex(id), [&](auto face) {
      for (const auto& hidden : face->vertex_list()) {
        const Point_id other = hidden->point().id();
        if (is_without_area(other)) function(other);
      }
    });
  }
}

// Hidden points may have other triangles.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::after_hiding(const Time& time, std::span<const Point_id> points) {
  for (const Point_id id : points) {
    if (triangulation_.contains(id)) follow_links(id, time);
  }
}

// Brings the links of a point up to date, at the time `after`.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::follow_links(Point_id id, const Time& after) {
  const std::vector<Point_id> corners = corners_of(id);
  const Contacts* const known = find_contacts(id);
  if (corners.empty() && (known == nullptr || known->corners.empty())) return;
  const std::vector<Point_id> before = std::exchange(contacts_of(id).corners, corners);
  for (const Point_id corner : before) {
    const Edge_ids pair = edge_ids(id, corner);
    if (!is_edge(pair)) leave_edge(pair);
  }
  for (const Point_id corner : corners) {
    const Edge_ids pair = edge_ids(id, corner);
    follow_edge(pair, after);
    // The point may stay on the rim.
    if (is_changing(pair) || find_overlap(pair) != nullptr ||
        !traits_.do_touch(point(id), point(corner), diameter_, after)) {
      continue;
    }
    start_overlap(id, corner, true);
    for_each_pair_beside(id, corner, true, [&](const Edge_ids& beside) {
      watch_unless_changing(beside, false, after);
    });
  }
}

// The corners that a point is linked with.
template <ContactKineticTraits_2 Traits>
std::vector<Point_id> Simulation_2<Traits>::corners_of(Point_id id) const {
  std::vector<Point_id> result;
  for_each_corner(id, [&](Point_id corner) { result.push_back(corner); });
  return result;
}

// Keeps the links of all points, at the start.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::keep_links() {
  for (const auto& contacts : contacts_) {
    if (contacts != nullptr) contacts->corners.clear();
  }
  if (triangulation_.number_of_hidden_points() == 0) return;
  for (const Point_id id : present_points()) {
    std::vector<Point_id> corners = corners_of(id);
    if (!corners.empty()) contacts_of(id).corners = std::move(corners);
  }
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_HIDDEN_LINKS_IMPL_H
