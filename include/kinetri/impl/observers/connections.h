// SPDX-License-Identifier: GPL-3.0-or-later
//
// The times at which given things are connected at a range.
#ifndef KINETRI_IMPL_OBSERVERS_CONNECTIONS_H
#define KINETRI_IMPL_OBSERVERS_CONNECTIONS_H

#include <cstddef>
#include <vector>

#include "kinetri/observers/connected_components.h"

namespace kinetri::detail {

/// Two things that were connected from `begin` to `end`, both included: a maximal interval of the
/// observed time.
struct Connection {
  std::size_t pair = 0;    ///< which pair, in the order in which they were given
  Algebraic_number begin;  ///< exact
  Algebraic_number end;    ///< exact; the present time if it has not ended
};

/// An observer of Connected_components for some pairs of things. A thing is a point, or several
/// points that exist one after the other, such as the stays of a recorded track: a pair of things
/// is a list of pairs of points, and is connected when one of these is.
template <DistanceKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Connections {
 public:
  using Pair = std::vector<Edge_ids>;  ///< of things; empty if the two never exist at one time

  /// @{
  /// Observes from the current time on. What is observed must outlive this object. Points need not
  /// exist yet. Precondition: the range is at least 0 and finite, and the points of each pair
  /// differ.
  Connections(Simulation_2<Traits>& simulation, double range, std::vector<Pair> pairs);
  Connections(Kinetic_triangulation_2<Traits>& triangulation, double range,
              std::vector<Pair> pairs);
  /// @}

  /// All connections up to the current time, by pair, then by time; disjoint.
  std::vector<Connection> connections();

 private:
  Connected_components<Traits> components_;
  std::vector<Pair> pairs_;
};

extern template class Connections<Linear_kinetic_traits_2>;
extern template class Connections<Polynomial_kinetic_traits_2>;
extern template class Connections<Periodic_kinetic_traits_2>;

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_OBSERVERS_CONNECTIONS_H
