// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/cell_areas.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "kinetri/impl/base/check.h"
#include "observers/limited_cell.h"
#include "observers/sides_of_cell.h"
#include "triangulation/torus_topology.h"
#include "triangulation/triangulation_at_time.h"

namespace kinetri {

void Cell_limits::check(bool is_in_periodic_box) const {
  KINETRI_PRECONDITION(!is_in_periodic_box || !walkable,
                       "a walkable area in a periodic box, whose images have no walls; expected "
                       "no walkable area");
  KINETRI_PRECONDITION(
      is_in_periodic_box || walkable || cutoff < std::numeric_limits<double>::infinity(),
      "cells of points on the convex hull are unbounded; expected a walkable area, or a cutoff, or "
      "both");
  KINETRI_PRECONDITION(
      cutoff >= 1e-150 && (cutoff <= 1e150 || std::isinf(cutoff)),
      "the cutoff is " + std::to_string(cutoff) + "; expected a distance between 1e-150 and 1e150");
}

namespace {

template <KineticTraits_2 Traits>
class Areas_now {
 public:
  using Kinetic = Kinetic_triangulation_2<Traits>;
  using At_time = detail::Triangulation_at_time<Traits>;
  using Vertex = typename At_time::Vertex;

  Areas_now(const Kinetic& triangulation, const Cell_limits& limits)
      : kinetic_(triangulation),
        at_(std::make_unique<detail::Queried<Traits, Traits>>(triangulation),
            triangulation.current_time()),
        at_time_(triangulation.traits(), triangulation.current_time()),
        cell_(limits, is_periodic),
        areas_(triangulation.next_id()) {
    cell_.set_reach(at_time_.reach());
  }

  std::vector<Cell_area> areas() {
    find_places();
    for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
      if (kinetic_.contains(id) && !kinetic_.is_hidden(id) && areas_[id].id == no_point) {
        measure(vertex(id));
      }
    }
    std::vector<Cell_area> result;
    for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
      if (!kinetic_.contains(id)) continue;
      areas_[id].id = id;
      result.push_back(areas_[id]);
    }
    return result;
  }

 private:
  static constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;

  static Point_id id(const Vertex& v) { return At_time::id(v); }
  Vertex vertex(Point_id id) const {
    if constexpr (is_periodic) {
      return at_.vertex({id, {}});
    } else {
      return at_.vertex(id);
    }
  }

  // In a periodic box each image has a position of its own.
  void find_places() {
    if constexpr (!is_periodic) {
      places_.resize(kinetic_.next_id());
      for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
        if (kinetic_.contains(id)) places_[id] = at_time_.place(at_.point(vertex(id)));
      }
    }
  }
  detail::Ball_2 place(const Vertex& v) const {
    if constexpr (is_periodic) {
      return at_time_.place(at_.point(v));
    } else {
      return places_[id(v)];
    }
  }

  // The cell of `v` and of all vertices that are alike: these are connected by edges.
  void measure(const Vertex& v) {
    sides_.half_planes.clear();
    sides_.displacement = 0;
    sides_.is_empty = false;
    neighbors_.clear();
    const auto& point = at_.point(v);
    const detail::Ball_2 here = place(v);
    std::vector<Vertex> alike = {v};
    const auto examine = [&](const Vertex& u) {
      const auto& other = at_.point(u);
      const detail::Ball_2 there = place(u);
      if (at_time_.are_alike(point, here, other, there)) {
        if (std::ranges::find(alike, u) == alike.end()) alike.push_back(u);
      } else if (!kinetic_.is_hidden(id(u))) {
        at_time_.add(point, here, other, there, sides_);
        neighbors_.push_back(other);
      }
    };
    for (std::size_t i = 0; i < alike.size(); ++i) {
      const Vertex between = alike[i];
      if (kinetic_.is_hidden(id(between))) continue;
      at_.for_each_neighbor(between, examine);
      at_.for_each_hidden_near(between, examine);
    }
    Point_id first = id(v);
    for (const Vertex& u : alike) {
      areas_[id(u)].id = id(u);
      first = std::min(first, id(u));
    }
    // A periodic box has no walls, for which the position would matter.
    areas_[first] = cell_.measure(sides_, is_periodic ? detail::Ball_2() : here,
                                  detail::Exact_cell_at_time(at_time_, point, neighbors_));
    areas_[first].id = first;
    if (kinetic_.number_of_hidden_points() > 0) share_area(first);
  }

  // Among the point and those that it hides since they coincide with it for a while.
  void share_area(Point_id shown) {
    const std::vector<Point_id> others = kinetic_.coincident_points(shown);
    if (others.empty()) return;
    const auto count = static_cast<double>(1 + others.size());
    Cell_area& area = areas_[shown];
    area.error = (area.error + 0x1p-52 * area.area) / count;
    area.area /= count;
    for (const Point_id other : others) areas_[other] = area;
  }

  const Kinetic& kinetic_;
  At_time at_;
  detail::Sides_at_time<Traits> at_time_;
  detail::Limited_cell cell_;
  std::vector<detail::Ball_2> places_;  // by id; in the plane
  std::vector<Cell_area> areas_;        // by id; without an id if not measured yet
  detail::Sides_of_cell sides_;
  std::vector<Certified_point_2<Traits>> neighbors_;
};

}  // namespace

template <KineticTraits_2 Traits>
std::vector<Cell_area> cell_areas(const Kinetic_triangulation_2<Traits>& triangulation,
                                  const Cell_limits& limits) {
  return Areas_now<Traits>(triangulation, limits).areas();
}

template std::vector<Cell_area> cell_areas(const Kinetic_triangulation_2<Linear_kinetic_traits_2>&,
                                           const Cell_limits&);
template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Polynomial_kinetic_traits_2>&, const Cell_limits&);
template std::vector<Cell_area> cell_areas(const Kinetic_triangulation_2<Disc_kinetic_traits_2>&,
                                           const Cell_limits&);
template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>&, const Cell_limits&);
template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Periodic_kinetic_traits_2>&, const Cell_limits&);
template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Periodic_disc_kinetic_traits_2>&, const Cell_limits&);

}  // namespace kinetri
