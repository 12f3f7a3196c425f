// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/cell_areas.h"

#include <algorithm>
#include <cmath>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "observers/limited_cell.h"
#include "observers/sides_of_cell.h"

namespace kinetri {

void Cell_limits::check() const {
  KINETRI_PRECONDITION(walkable || cutoff < std::numeric_limits<double>::infinity(),
                       "cells of points on the convex hull are unbounded; expected a walkable "
                       "area, or a cutoff, or both");
  KINETRI_PRECONDITION(
      cutoff >= 1e-150 && (cutoff <= 1e150 || std::isinf(cutoff)),
      "the cutoff is " + std::to_string(cutoff) + "; expected a distance between 1e-150 and 1e150");
}

namespace {

template <PlanarKineticTraits_2 Traits>
class Areas_now {
 public:
  using Kinetic = Kinetic_triangulation_2<Traits>;
  using Vertex_handle = typename Kinetic::Vertex_handle;

  Areas_now(const Kinetic& triangulation, const Cell_limits& limits)
      : kinetic_(triangulation),
        at_time_(triangulation.traits(), triangulation.current_time()),
        cell_(limits),
        places_(triangulation.next_id()),
        areas_(triangulation.next_id()) {}

  std::vector<Cell_area> areas() {
    for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
      if (kinetic_.contains(id)) places_[id] = at_time_.place(kinetic_.vertex(id)->point());
    }
    for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
      if (kinetic_.contains(id) && !kinetic_.is_hidden(id) && areas_[id].id == no_point) {
        measure(kinetic_.vertex(id));
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
  static Point_id id(Vertex_handle v) { return v->point().id(); }

  bool are_alike(Vertex_handle v, Vertex_handle u) const {
    return at_time_.are_alike(v->point(), places_[id(v)], u->point(), places_[id(u)]);
  }

  // Calls `function` with each neighbor of `v`, and with each hidden point of its faces.
  template <class Function>
  void for_each_near(Vertex_handle v, Function function) const {
    const auto& topology = kinetic_.triangulation();
    detail::for_each_neighbor(topology, v, function);
    if constexpr (HasWeight<typename Traits::Motion>) {
      if (topology.number_of_hidden_vertices() == 0) return;
      if (topology.dimension() == 2) {
        detail::for_each_face_at(topology, v, [&](auto face) {
          for (const Vertex_handle h : face->vertex_list()) function(h);
        });
      } else {
        for (auto h = topology.hidden_vertices_begin(); h != topology.hidden_vertices_end(); ++h) {
          function(Vertex_handle(h));
        }
      }
    }
  }

  // The cell of `v` and of all vertices that are alike: these are connected by edges.
  void measure(Vertex_handle v) {
    sides_.half_planes.clear();
    sides_.displacement = 0;
    sides_.is_empty = false;
    neighbors_.clear();
    std::vector<Vertex_handle> alike = {v};
    for (std::size_t i = 0; i < alike.size(); ++i) {
      const Vertex_handle here = alike[i];
      if (kinetic_.is_hidden(id(here))) continue;
      for_each_near(here, [&](Vertex_handle u) {
        if (are_alike(v, u)) {
          if (std::ranges::find(alike, u) == alike.end()) alike.push_back(u);
        } else if (!kinetic_.is_hidden(id(u))) {
          at_time_.add(v->point(), places_[id(v)], u->point(), places_[id(u)], sides_);
          neighbors_.push_back(&u->point());
        }
      });
    }
    Point_id first = id(v);
    for (const Vertex_handle u : alike) {
      areas_[id(u)].id = id(u);
      first = std::min(first, id(u));
    }
    areas_[first] = cell_.measure(sides_, places_[id(v)],
                                  detail::Exact_cell_at_time(at_time_, v->point(), neighbors_));
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
  detail::Sides_at_time<Traits> at_time_;
  detail::Limited_cell cell_;
  std::vector<detail::Ball_2> places_;  // by id
  std::vector<Cell_area> areas_;        // by id; without an id if not measured yet
  detail::Sides_of_cell sides_;
  std::vector<const typename Traits::Point_2*> neighbors_;
};

}  // namespace

template <PlanarKineticTraits_2 Traits>
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

}  // namespace kinetri
