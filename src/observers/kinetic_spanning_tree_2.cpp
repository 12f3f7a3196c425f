// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/kinetic_spanning_tree_2.h"

#include "observers/spanning_tree.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::Kinetic_spanning_tree_2(Simulation_2<Traits>& simulation)
    : tree_(std::make_unique<detail::Spanning_tree<Traits>>(simulation)) {}

template <ContactKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::Kinetic_spanning_tree_2(Triangulation& triangulation)
    : tree_(std::make_unique<detail::Spanning_tree<Traits>>(triangulation)) {}

template <ContactKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::~Kinetic_spanning_tree_2() = default;

template <ContactKineticTraits_2 Traits>
std::vector<Edge_ids> Kinetic_spanning_tree_2<Traits>::edges() {
  return tree_->edges();
}

template <ContactKineticTraits_2 Traits>
bool Kinetic_spanning_tree_2<Traits>::is_edge(const Edge_ids& edge) {
  return tree_->is_edge(edge);
}

template <ContactKineticTraits_2 Traits>
const std::vector<Spanning_tree_change>& Kinetic_spanning_tree_2<Traits>::changes() {
  return tree_->history().changes();
}

template <ContactKineticTraits_2 Traits>
std::vector<Longest_edge> Kinetic_spanning_tree_2<Traits>::longest_edges() {
  return tree_->history().longest_edges();
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::connecting_range() {
  return tree_->history().connecting_range(tree_->present_time());
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::least_connecting_range() {
  return tree_->history().extreme_range(false, tree_->present_time());
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::greatest_connecting_range() {
  return tree_->history().extreme_range(true, tree_->present_time());
}

template class Kinetic_spanning_tree_2<Linear_kinetic_traits_2>;
template class Kinetic_spanning_tree_2<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
