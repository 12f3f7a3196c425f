// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Gabriel graph and the relative neighborhood graph of moving points: filters of the edges of
// a kinetic Delaunay triangulation.
//
// Every edge of the relative neighborhood graph is one of the Gabriel graph, and each of these is
// in every Delaunay triangulation. So cocircular points make no difference. The edge from a point
// to a nearest neighbor, and a minimum spanning tree, are in both.
#ifndef KINETRI_OBSERVERS_PROXIMITY_GRAPHS_H
#define KINETRI_OBSERVERS_PROXIMITY_GRAPHS_H

#include <vector>

#include "kinetri/events/event.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

/// The edges of the Gabriel graph just after the current time, exactly, sorted: the pairs of points
/// a and b with no other point inside the circle whose diameter is ab, or on it. So |ac|^2 + |bc|^2
/// > |ab|^2 for each other point c. Of points that coincide for a while, the one that hides the
/// others stands for all in this definition; each of the others has one edge, with it.
///
/// Cost: for each edge of the triangulation the signs of two polynomials.
///
/// Source: K. R. Gabriel, R. R. Sokal, A new statistical approach to geographic variation analysis,
/// Systematic Zoology 18, 1969. That the points opposite of the edge suffice: D. W. Matula, R. R.
/// Sokal, Properties of Gabriel graphs relevant to geographic variation research and the clustering
/// of points in the plane, Geographical Analysis 12, 1980.
template <class Traits>
requires HasNearestNeighbors<Traits> && PlanarKineticTraits_2<Traits> std::vector<Edge_ids>
gabriel_edges(const Kinetic_triangulation_2<Traits>& triangulation);

/// The edges of the relative neighborhood graph just after the current time, exactly, sorted: the
/// pairs of points a and b with no other point c that is nearer to both than they are to each
/// other, max(|ac|, |bc|) < |ab|. Points that coincide for a while are treated as by gabriel_edges.
///
/// Cost: that of gabriel_edges and, for each of its edges, a comparison of distances for each point
/// that is nearer to one end than the other end is, and for the neighbors of these: O(1) for most
/// edges of evenly spread points, and O(n) at worst.
///
/// Source: G. T. Toussaint, The relative neighbourhood graph of a finite planar set, Pattern
/// Recognition 12, 1980.
template <class Traits>
requires HasNearestNeighbors<Traits> && PlanarKineticTraits_2<Traits> std::vector<Edge_ids>
relative_neighbor_edges(const Kinetic_triangulation_2<Traits>& triangulation);

/// @cond
#define KINETRI_PROXIMITY_GRAPHS(declaration, Traits)                                      \
  declaration std::vector<Edge_ids> gabriel_edges(const Kinetic_triangulation_2<Traits>&); \
  declaration std::vector<Edge_ids> relative_neighbor_edges(const Kinetic_triangulation_2<Traits>&)
KINETRI_PROXIMITY_GRAPHS(extern template, Linear_kinetic_traits_2);
KINETRI_PROXIMITY_GRAPHS(extern template, Polynomial_kinetic_traits_2);
/// @endcond

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_PROXIMITY_GRAPHS_H
