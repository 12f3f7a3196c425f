// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/kinetic_spanning_tree_2.h"

#include "observers/spanning_tree.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::Kinetic_spanning_tree_2(Simulation_2<Traits>& simulation)
    : Edge_follower<Traits>(simulation) {
  start();
}

template <ContactKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::Kinetic_spanning_tree_2(Triangulation& triangulation)
    : Edge_follower<Traits>(triangulation) {
  start();
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::start() {
  tree_ = std::make_shared<detail::Spanning_tree<Traits>>(this->graph(), this->traits(), now(),
                                                          this->graph().edges());
}

template <ContactKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::now() const -> const Time& {
  return this->triangulation().current_time();
}

template <ContactKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::present() -> const detail::Spanning_tree<Traits>& {
  this->update();
  tree_->look(now());
  return *tree_;
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::advance(const Time& time) {
  tree_->advance(time);
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::before_change(std::span<const Edge_ids> removed,
                                                    std::span<const Changed_point> points) {
  tree_->before_change(removed, points);
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::change(const Time& /*time*/,
                                             std::span<const Edge_ids> /*removed*/,
                                             std::span<const Edge_ids> added,
                                             std::span<const Changed_point> /*points*/) {
  tree_->change(added);
}

template <ContactKineticTraits_2 Traits>
std::vector<Edge_ids> Kinetic_spanning_tree_2<Traits>::edges() {
  return present().edges();
}

template <ContactKineticTraits_2 Traits>
bool Kinetic_spanning_tree_2<Traits>::is_edge(const Edge_ids& edge) {
  return present().is_edge(edge);
}

template <ContactKineticTraits_2 Traits>
const std::vector<Spanning_tree_change>& Kinetic_spanning_tree_2<Traits>::changes() {
  return present().history().changes();
}

template <ContactKineticTraits_2 Traits>
std::vector<Longest_edge> Kinetic_spanning_tree_2<Traits>::longest_edges() {
  return present().history().longest_edges();
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::connecting_range() {
  return present().history().connecting_range(now());
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::least_connecting_range() {
  return present().history().extreme_range(false, now());
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::greatest_connecting_range() {
  return present().history().extreme_range(true, now());
}

template class Kinetic_spanning_tree_2<Linear_kinetic_traits_2>;
template class Kinetic_spanning_tree_2<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
