// SPDX-License-Identifier: GPL-3.0-or-later
//
// When two given things are connected at a range.
#ifndef KINETRI_IMPL_OBSERVERS_CONNECTIONS_H
#define KINETRI_IMPL_OBSERVERS_CONNECTIONS_H

#include <cstddef>
#include <vector>

#include "kinetri/observers/connected_components.h"

namespace kinetri::detail {

/// Two things that were connected from `begin` to `end`, both included, and not just before and
/// just after, as far as that was observed.
struct Connection {
  std::size_t pair = 0;    ///< which pair, in the order in which they were given
  Algebraic_number begin;  ///< exact
  Algebraic_number end;    ///< exact; the present time if it goes on
};

/// An observer of Connected_components for some pairs of things. A thing is a point, or several
/// points of which one leaves before the next one comes, such as the stays of a recorded track: a
/// pair of things is a list of pairs of points, and it is connected when one of these is.
template <ContactKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Connections {
 public:
  using Pair = std::vector<Edge_ids>;  ///< of things; empty if the two are never there at one time

  /// @{
  /// Observes from the current time on; the object must not outlive what it observes. Points need
  /// not be there yet. Precondition: the range is at least 0 and finite, and the points of each
  /// pair differ.
  Connections(Simulation_2<Traits>& simulation, double range, std::vector<Pair> pairs);
  Connections(Kinetic_triangulation_2<Traits>& triangulation, double range,
              std::vector<Pair> pairs);
  /// @}

  /// All connections up to the current time: for one pair after the other, in the order of time,
  /// disjoint.
  std::vector<Connection> connections();

 private:
  Connected_components<Traits> components_;
  std::vector<Pair> pairs_;
};

extern template class Connections<Linear_kinetic_traits_2>;
extern template class Connections<Polynomial_kinetic_traits_2>;

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_OBSERVERS_CONNECTIONS_H
