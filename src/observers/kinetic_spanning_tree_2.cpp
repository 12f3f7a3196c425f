// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/kinetic_spanning_tree_2.h"

#include "observers/spanning_tree.h"

namespace kinetri {

template <SimulationKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::Kinetic_spanning_tree_2(Simulation_2<Traits>& simulation)
    : tree_(std::make_unique<detail::Spanning_tree<Traits>>(simulation)) {}

template <SimulationKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::Kinetic_spanning_tree_2(Triangulation& triangulation)
    : tree_(std::make_unique<detail::Spanning_tree<Traits>>(triangulation)) {}

template <SimulationKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::~Kinetic_spanning_tree_2() = default;

template <SimulationKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::edges() -> std::vector<Edge> {
  return tree_->edges();
}

template <SimulationKineticTraits_2 Traits>
bool Kinetic_spanning_tree_2<Traits>::is_edge(const Edge& edge) {
  return tree_->is_edge(edge);
}

template <SimulationKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::changes() -> const std::vector<Spanning_tree_change>& {
  return tree_->history().changes();
}

template <SimulationKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::longest_edges() -> std::vector<Longest_edge> {
  return tree_->history().longest_edges();
}

template <SimulationKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::connecting_range() -> std::optional<Connecting_range> {
  return tree_->history().connecting_range(tree_->present_time());
}

template <SimulationKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::least_connecting_range() -> std::optional<Connecting_range> {
  return tree_->history().extreme_range(false, tree_->present_time());
}

template <SimulationKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::greatest_connecting_range()
    -> std::optional<Connecting_range> {
  return tree_->history().extreme_range(true, tree_->present_time());
}

template class Kinetic_spanning_tree_2<Linear_kinetic_traits_2>;
template class Kinetic_spanning_tree_2<Polynomial_kinetic_traits_2>;
template class Kinetic_spanning_tree_2<Periodic_kinetic_traits_2>;

}  // namespace kinetri
