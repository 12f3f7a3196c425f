// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/observers/spanning_tree_rows.h"

#include <array>
#include <cstddef>

namespace kinetri::detail {

std::string_view name(Spanning_tree_row_kind kind) {
  constexpr std::array<std::string_view, 6> names = {"start",   "remove", "add",
                                                     "longest", "least",  "greatest"};
  return names[static_cast<std::size_t>(kind)];
}

template <ContactKineticTraits_2 Traits>
Spanning_tree_rows<Traits>::Spanning_tree_rows(Simulation_2<Traits>& simulation)
    : tree_(simulation), start_(simulation.current_time()), at_start_(tree_.edges()) {}

template <ContactKineticTraits_2 Traits>
Spanning_tree_rows<Traits>::Spanning_tree_rows(Kinetic_triangulation_2<Traits>& triangulation)
    : tree_(triangulation), start_(triangulation.current_time()), at_start_(tree_.edges()) {}

template <ContactKineticTraits_2 Traits>
std::vector<Spanning_tree_row> Spanning_tree_rows<Traits>::rows() {
  using Kind = Spanning_tree_row_kind;
  std::vector<Spanning_tree_row> result;
  const auto add = [&](const Algebraic_number& time, Kind kind,
                       const std::vector<Edge_ids>& edges) {
    for (const Edge_ids& edge : edges) result.push_back({time, kind, edge});
  };
  add(start_, Kind::start, at_start_);
  const std::vector<Longest_edge> longest = tree_.longest_edges();
  auto next = longest.begin();
  const auto add_longest = [&] {
    if (next->edge) result.push_back({next->time, Kind::longest, *next->edge, next->length});
    ++next;
  };
  for (const Spanning_tree_change& change : tree_.changes()) {
    while (next != longest.end() && next->time < change.time) add_longest();
    add(change.time, Kind::remove, change.removed);
    add(change.time, Kind::add, change.added);
  }
  while (next != longest.end()) add_longest();
  const auto add_range = [&](Kind kind, const std::optional<Connecting_range>& found) {
    if (!found) return;
    result.push_back({found->time, kind, found->edge, found->range.to_double()});
  };
  add_range(Kind::least, tree_.least_connecting_range());
  add_range(Kind::greatest, tree_.greatest_connecting_range());
  return result;
}

template class Spanning_tree_rows<Linear_kinetic_traits_2>;
template class Spanning_tree_rows<Polynomial_kinetic_traits_2>;

}  // namespace kinetri::detail
