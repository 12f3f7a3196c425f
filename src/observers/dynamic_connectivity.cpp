// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/dynamic_connectivity.h"

#include <algorithm>

#include "kinetri/impl/base/check.h"

namespace kinetri {

void Dynamic_connectivity::add_point(Point_id id) {
  KINETRI_PRECONDITION(!contains(id), "the point is in the graph already");
  if (id >= nodes_.size()) nodes_.resize(std::size_t{id} + 1);
  nodes_[id].component = new_component(1);
}

void Dynamic_connectivity::remove_point(Point_id id) {
  KINETRI_PRECONDITION(contains(id), "no such point");
  KINETRI_PRECONDITION(nodes_[id].neighbors.empty(), "a point that goes still has edges");
  set_size(nodes_[id].component, 0);
  nodes_[id].component = no_component;
}

bool Dynamic_connectivity::is_edge(const Edge_ids& edge) const {
  return contains(edge[0]) &&
         std::ranges::find(nodes_[edge[0]].neighbors, edge[1]) != nodes_[edge[0]].neighbors.end();
}

bool Dynamic_connectivity::add_edge(const Edge_ids& edge) {
  const auto [a, b] = edge;
  KINETRI_PRECONDITION(contains(a) && contains(b) && a != b, "an edge needs two points");
  const bool joins = component(a) != component(b);
  if (joins) {
    const bool is_a_smaller = size_of(a) < size_of(b);
    const Component joined = component(is_a_smaller ? b : a);
    Search& smaller = searches_of_ends_[0];
    begin(smaller, is_a_smaller ? a : b);
    while (look_at_neighbor(smaller, no_search) != Progress::is_done) {
    }
    give_to(smaller, joined);
  }
  nodes_[a].neighbors.push_back(b);
  nodes_[b].neighbors.push_back(a);
  return joins;
}

bool Dynamic_connectivity::remove_edge(const Edge_ids& edge) {
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
    KINETRI_PRECONDITION(contains(edge[end]), "no such edge");
    std::vector<Point_id>& neighbors = nodes_[edge[end]].neighbors;
    const auto found = std::ranges::find(neighbors, edge[1 - end]);
    KINETRI_PRECONDITION(found != neighbors.end(), "no such edge");
    *found = neighbors.back();
    neighbors.pop_back();
  }
  begin(searches_of_ends_[0], edge[0]);
  begin(searches_of_ends_[1], edge[1]);
  while (true) {
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      Search& search = searches_of_ends_[end];
      const std::uint64_t other = searches_of_ends_[1 - end].number;
      const Progress progress = look_at_neighbor(search, other);
      if (progress == Progress::meets) return false;
      if (progress == Progress::is_done) {
        give_to(search, new_component(0));
        return true;
      }
    }
  }
}

auto Dynamic_connectivity::component(Point_id id) const -> Component {
  KINETRI_PRECONDITION(contains(id), "no such point");
  return nodes_[id].component;
}

// ---- searches ----

void Dynamic_connectivity::begin(Search& search, Point_id id) {
  search.number = ++searches_;
  search.found.assign(1, id);
  search.next_point = 0;
  search.next_neighbor = 0;
  nodes_[id].seen = search.number;
}

// Examines one neighbor of the points found so far. The searches meet if `other` has found it.
auto Dynamic_connectivity::look_at_neighbor(Search& search, std::uint64_t other) -> Progress {
  while (search.next_point < search.found.size()) {
    const std::vector<Point_id>& neighbors = nodes_[search.found[search.next_point]].neighbors;
    if (search.next_neighbor == neighbors.size()) {
      ++search.next_point;
      search.next_neighbor = 0;
      continue;
    }
    const Point_id neighbor = neighbors[search.next_neighbor++];
    std::uint64_t& seen = nodes_[neighbor].seen;
    if (other != no_search && seen == other) return Progress::meets;
    if (seen != search.number) search.found.push_back(neighbor);
    seen = search.number;
    return Progress::goes_on;
  }
  return Progress::is_done;
}

// ---- components ----

// Moves the points of a complete search to another component.
void Dynamic_connectivity::give_to(const Search& search, Component to) {
  const Component from = component(search.found.front());
  const std::size_t number = search.found.size();
  for (const Point_id id : search.found) nodes_[id].component = to;
  set_size(from, sizes_[from] - number);
  set_size(to, sizes_[to] + number);
}

// A component of size 0 must get its size at once.
auto Dynamic_connectivity::new_component(std::size_t size) -> Component {
  if (free_components_.empty()) {
    sizes_.push_back(0);
    free_components_.push_back(static_cast<Component>(sizes_.size() - 1));
  }
  const Component component = free_components_.back();
  free_components_.pop_back();
  set_size(component, size);
  return component;
}

void Dynamic_connectivity::set_size(Component component, std::size_t size) {
  std::size_t& known = sizes_[component];
  if (known > 0) forget_size(known);
  if (size > 0) ++components_of_size_[size];
  if (known > 0 && size == 0) free_components_.push_back(component);
  known = size;
}

void Dynamic_connectivity::forget_size(std::size_t size) {
  const auto found = components_of_size_.find(size);
  if (--found->second == 0) components_of_size_.erase(found);
}

}  // namespace kinetri
