// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/proximity_graphs.h"

#include <algorithm>
#include <unordered_set>

#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri {
namespace {

template <class Traits>
class Edge_tests {
 public:
  using Kinetic = Kinetic_triangulation_2<Traits>;
  using Topology = typename Kinetic::Triangulation;
  using Vertex_handle = typename Kinetic::Vertex_handle;
  using Edge = typename Kinetic::Edge;

  explicit Edge_tests(const Kinetic& kinetic)
      : kinetic_(kinetic), topology_(kinetic.triangulation()) {}

  // The points opposite the edge suffice: if r is outside of the circle with the diameter pq,
  // points on its side that are within that circle are within the empty circle through p, q and r
  // as well. No third point is between the ends of an edge.
  bool is_gabriel(const Edge& edge) const {
    if (topology_.dimension() < 2) return true;
    const auto [face, i] = edge;
    const Vertex_handle p = face->vertex(Topology::cw(i));
    const Vertex_handle q = face->vertex(Topology::ccw(i));
    return sees_acute_angle(face->vertex(i), p, q) &&
           sees_acute_angle(topology_.mirror_vertex(face, i), p, q);
  }

  // The points nearer to p than q is are connected with p by edges among themselves (docs/MATH.md,
  // section 8), so a search from p finds all of them.
  bool is_relative_neighbor(const Edge& edge) const {
    if (!is_gabriel(edge)) return false;
    if (topology_.dimension() < 2) return true;
    const auto [face, i] = edge;
    const Vertex_handle p = face->vertex(Topology::cw(i));
    const Vertex_handle q = face->vertex(Topology::ccw(i));
    std::vector<Vertex_handle> within = {p};
    std::unordered_set<Point_id> seen = {p->point().id(), q->point().id()};
    bool is_empty = true;
    for (std::size_t next = 0; next < within.size() && is_empty; ++next) {
      detail::for_each_neighbor(topology_, within[next], [&](Vertex_handle r) {
        if (!seen.insert(r->point().id()).second || !is_nearer(p, r, q)) return;
        within.push_back(r);
        if (is_nearer(q, r, p)) is_empty = false;
      });
    }
    return is_empty;
  }

  // The edges that pass a test, and those of hidden points with the points that coincide with them,
  // sorted.
  template <class Test>
  std::vector<Edge_ids> all(const Test& is_edge_of_graph) const {
    std::vector<Edge_ids> result;
    for (const Edge& edge : topology_.finite_edges()) {
      if (!is_edge_of_graph(edge)) continue;
      const auto& [face, i] = edge;
      result.push_back(edge_ids(face->vertex(Topology::cw(i))->point().id(),
                                face->vertex(Topology::ccw(i))->point().id()));
    }
    if (kinetic_.number_of_hidden_points() > 0) {
      for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
        if (!kinetic_.contains(id) || !kinetic_.is_hidden(id)) continue;
        result.push_back(edge_ids(kinetic_.vertex(id)->point().id(), id));
      }
    }
    std::ranges::sort(result);
    return result;
  }

 private:
  bool sees_acute_angle(Vertex_handle r, Vertex_handle p, Vertex_handle q) const {
    return topology_.is_infinite(r) ||
           sign_just_after(scalar_product_polynomial(p->point(), r->point(), q->point()),
                           kinetic_.current_time()) == CGAL::POSITIVE;
  }

  // Whether r is nearer to p than q is.
  bool is_nearer(Vertex_handle p, Vertex_handle r, Vertex_handle q) const {
    return topology_.geom_traits().compare_distance_2_object()(p->point(), r->point(),
                                                               q->point()) == CGAL::SMALLER;
  }

  const Kinetic& kinetic_;
  const Topology& topology_;
};

}  // namespace

template <class Traits>
requires HasNearestNeighbors<Traits> && PlanarKineticTraits_2<Traits> std::vector<Edge_ids>
gabriel_edges(const Kinetic_triangulation_2<Traits>& triangulation) {
  const Edge_tests<Traits> tests(triangulation);
  return tests.all([&](const auto& e) { return tests.is_gabriel(e); });
}

template <class Traits>
requires HasNearestNeighbors<Traits> && PlanarKineticTraits_2<Traits> std::vector<Edge_ids>
relative_neighbor_edges(const Kinetic_triangulation_2<Traits>& triangulation) {
  const Edge_tests<Traits> tests(triangulation);
  return tests.all([&](const auto& e) { return tests.is_relative_neighbor(e); });
}

KINETRI_PROXIMITY_GRAPHS(template, Linear_kinetic_traits_2);
KINETRI_PROXIMITY_GRAPHS(template, Polynomial_kinetic_traits_2);

}  // namespace kinetri
