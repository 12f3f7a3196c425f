// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/observers/spanning_tree_rows.h"

#include <array>
#include <cstddef>
#include <limits>

namespace kinetri::detail {

std::string_view name(Spanning_tree_row_kind kind) {
  constexpr std::array<std::string_view, 6> names = {"start",   "remove", "add",
                                                     "longest", "least",  "greatest"};
  return names[static_cast<std::size_t>(kind)];
}

template <SimulationKineticTraits_2 Traits>
Spanning_tree_rows<Traits>::Spanning_tree_rows(Simulation_2<Traits>& simulation)
    : tree_(simulation), start_(simulation.current_time()), at_start_(tree_.edges()) {}

template <SimulationKineticTraits_2 Traits>
Spanning_tree_rows<Traits>::Spanning_tree_rows(Kinetic_triangulation_2<Traits>& triangulation)
    : tree_(triangulation), start_(triangulation.current_time()), at_start_(tree_.edges()) {}

template <SimulationKineticTraits_2 Traits>
std::vector<Spanning_tree_row> Spanning_tree_rows<Traits>::rows() {
  using Kind = Spanning_tree_row_kind;
  std::vector<Spanning_tree_row> result;
  const auto add_one = [&](const Algebraic_number& time, Kind kind, const auto& edge,
                           double length = std::numeric_limits<double>::quiet_NaN()) {
    result.push_back({time, kind, ids_of(edge), offset_of(edge), length});
  };
  const auto add = [&](const Algebraic_number& time, Kind kind, const auto& edges) {
    for (const auto& edge : edges) add_one(time, kind, edge);
  };
  add(start_, Kind::start, at_start_);
  const auto longest = tree_.longest_edges();
  auto next = longest.begin();
  const auto add_longest = [&] {
    if (next->edge) add_one(next->time, Kind::longest, *next->edge, next->length);
    ++next;
  };
  for (const auto& change : tree_.changes()) {
    while (next != longest.end() && next->time < change.time) add_longest();
    add(change.time, Kind::remove, change.removed);
    add(change.time, Kind::add, change.added);
  }
  while (next != longest.end()) add_longest();
  const auto add_range = [&](Kind kind, const auto& found) {
    if (found) add_one(found->time, kind, found->edge, found->range.to_double());
  };
  add_range(Kind::least, tree_.least_connecting_range());
  add_range(Kind::greatest, tree_.greatest_connecting_range());
  return result;
}

template class Spanning_tree_rows<Linear_kinetic_traits_2>;
template class Spanning_tree_rows<Polynomial_kinetic_traits_2>;
template class Spanning_tree_rows<Periodic_kinetic_traits_2>;

}  // namespace kinetri::detail
