// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/observers/connections.h"

#include <algorithm>
#include <utility>

namespace kinetri::detail {
namespace {

template <class Traits>
void watch_pairs(Connected_components<Traits>& components,
                 const std::vector<std::vector<Edge_ids>>& pairs) {
  for (const std::vector<Edge_ids>& pair : pairs) {
    for (const Edge_ids& points : pair) components.watch(points);
  }
}

}  // namespace

template <DistanceKineticTraits_2 Traits>
Connections<Traits>::Connections(Simulation_2<Traits>& simulation, double range,
                                 std::vector<Pair> pairs)
    : components_(simulation, range), pairs_(std::move(pairs)) {
  watch_pairs(components_, pairs_);
}

template <DistanceKineticTraits_2 Traits>
Connections<Traits>::Connections(Kinetic_triangulation_2<Traits>& triangulation, double range,
                                 std::vector<Pair> pairs)
    : components_(triangulation, range), pairs_(std::move(pairs)) {
  watch_pairs(components_, pairs_);
}

template <DistanceKineticTraits_2 Traits>
std::vector<Connection> Connections<Traits>::connections() {
  std::vector<Connection> result;
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    std::vector<Time_interval> intervals;
    for (const Edge_ids& points : pairs_[pair]) {
      for (Time_interval& interval : components_.connected_intervals(points)) {
        intervals.push_back(std::move(interval));
      }
    }
    std::ranges::sort(intervals, {}, &Time_interval::begin);
    for (auto& [begin, end] : intervals) result.push_back({pair, std::move(begin), std::move(end)});
  }
  return result;
}

template class Connections<Linear_kinetic_traits_2>;
template class Connections<Polynomial_kinetic_traits_2>;
template class Connections<Periodic_kinetic_traits_2>;

}  // namespace kinetri::detail
