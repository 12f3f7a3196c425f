// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/dynamic_connectivity.h"

#include <algorithm>

#include "kinetri/algebra/number_types.h"
#include "kinetri/impl/base/check.h"

namespace kinetri {

void Wrapping_directions::add(const Offset_sum& net) {
  if (net == Offset_sum() || number_ == 2) return;
  if (number_ == 0) {
    first_ = net;
    number_ = 1;
  } else if (Integer(first_.x) * net.y != Integer(first_.y) * net.x) {
    number_ = 2;
  }
}

void Wrapping_directions::add(const Wrapping_directions& other) {
  if (other.number_ == 2) number_ = 2;
  if (other.number_ == 1) add(other.first_);
}

template <class Edge_name>
void Basic_dynamic_connectivity<Edge_name>::add_point(Point_id id) {
  KINETRI_PRECONDITION(!contains(id), "the point is in the graph already");
  if (id >= nodes_.size()) nodes_.resize(std::size_t{id} + 1);
  nodes_[id].component = new_component(1);
}

template <class Edge_name>
void Basic_dynamic_connectivity<Edge_name>::remove_point(Point_id id) {
  KINETRI_PRECONDITION(contains(id), "no such point");
  KINETRI_PRECONDITION(nodes_[id].neighbors.empty(), "a point that goes still has edges");
  set_size(nodes_[id].component, 0);
  nodes_[id].component = no_component;
}

template <class Edge_name>
bool Basic_dynamic_connectivity<Edge_name>::is_edge(const Edge_name& edge) const {
  const auto [id, other] = detail::ends_of(edge)[0];
  return contains(id) &&
         std::ranges::find(nodes_[id].neighbors, other) != nodes_[id].neighbors.end();
}

template <class Edge_name>
bool Basic_dynamic_connectivity<Edge_name>::add_edge(const Edge_name& edge) {
  const auto [a, b] = detail::ids_of(edge);
  KINETRI_PRECONDITION(contains(a) && contains(b) && (is_periodic || a != b),
                       "an edge needs two points");
  const bool joins = component(a) != component(b);
  if (joins) {
    const bool is_a_smaller = size_of(a) < size_of(b);
    const Component joined = component(is_a_smaller ? b : a);
    Search& smaller = searches_of_ends_[0];
    begin(smaller, is_a_smaller ? a : b);
    complete(smaller);
    if constexpr (is_periodic) {
      const Offset_sum shift = nodes_[a].place + edge.offset - nodes_[b].place;
      for (const Point_id id : smaller.found) {
        Offset_sum& place = nodes_[id].place;
        place = is_a_smaller ? place - shift : place - (Offset_sum() - shift);
      }
      Wrapping_directions wraps = wraps_[joined];
      wraps.add(wraps_[component(is_a_smaller ? a : b)]);
      set_wraps(joined, wraps);
    }
    give_to(smaller, joined);
  } else if constexpr (is_periodic) {
    Wrapping_directions wraps = wraps_[component(a)];
    wraps.add(nodes_[a].place + edge.offset - nodes_[b].place);
    set_wraps(component(a), wraps);
  }
  for (const auto& [id, other] : detail::ends_of(edge)) nodes_[id].neighbors.push_back(other);
  return joins;
}

template <class Edge_name>
bool Basic_dynamic_connectivity<Edge_name>::remove_edge(const Edge_name& edge) {
  for (const auto& [id, other] : detail::ends_of(edge)) {
    KINETRI_PRECONDITION(contains(id), "no such edge");
    std::vector<Neighbor>& neighbors = nodes_[id].neighbors;
    const auto found = std::ranges::find(neighbors, other);
    KINETRI_PRECONDITION(found != neighbors.end(), "no such edge");
    *found = neighbors.back();
    neighbors.pop_back();
  }
  const auto [a, b] = detail::ids_of(edge);
  // Cycles that go around need not go by another way, unless the searches have met at one image.
  const auto look_again = [&](Point_id id) {
    if constexpr (is_periodic) {
      Search& all = searches_of_ends_[0];
      begin(all, id);
      complete(all);
      place_anew(all);
    }
  };
  if (a == b) {
    look_again(a);
    return false;
  }
  begin(searches_of_ends_[0], a);
  begin(searches_of_ends_[1], b, detail::offset_of(edge));
  while (true) {
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      Search& search = searches_of_ends_[end];
      const std::uint64_t other = searches_of_ends_[1 - end].number;
      const Progress progress = look_at_neighbor(search, other);
      if (progress == Progress::meets) return false;
      if (progress == Progress::meets_around) {
        look_again(a);
        return false;
      }
      if (progress == Progress::is_done) {
        [[maybe_unused]] const Component before = component(a);
        give_to(search, new_component(0));
        if constexpr (is_periodic) {
          if (wraps_[before].number() == 0) return true;
          // All cycles are in the two parts.
          place_anew(search);
          if (wraps_[component(search.found.front())].number() > 0) look_again(end == 0 ? b : a);
        }
        return true;
      }
    }
  }
}

template <class Edge_name>
auto Basic_dynamic_connectivity<Edge_name>::component(Point_id id) const -> Component {
  KINETRI_PRECONDITION(contains(id), "no such point");
  return nodes_[id].component;
}

// ---- searches ----

template <class Edge_name>
void Basic_dynamic_connectivity<Edge_name>::begin(Search& search, Point_id id,
                                                  [[maybe_unused]] const Lattice_offset_2& offset) {
  search.number = ++searches_;
  search.found.assign(1, id);
  search.next_point = 0;
  search.next_neighbor = 0;
  nodes_[id].seen = search.number;
  if constexpr (is_periodic) nodes_[id].found_at = Offset_sum() + offset;
}

// Examines one neighbor of the points found so far. The searches meet if `other` has found it.
template <class Edge_name>
auto Basic_dynamic_connectivity<Edge_name>::look_at_neighbor(Search& search, std::uint64_t other)
    -> Progress {
  while (search.next_point < search.found.size()) {
    const Node& node = nodes_[search.found[search.next_point]];
    if (search.next_neighbor == node.neighbors.size()) {
      ++search.next_point;
      search.next_neighbor = 0;
      continue;
    }
    const Neighbor& neighbor = node.neighbors[search.next_neighbor++];
    const Point_id id = detail::id_of(neighbor);
    Node& next = nodes_[id];
    Place place = {};
    if constexpr (is_periodic) place = node.found_at + neighbor.offset;
    if (other != no_search && next.seen == other) {
      if constexpr (is_periodic) {
        if (next.found_at != place) return Progress::meets_around;
      }
      return Progress::meets;
    }
    if (next.seen != search.number) {
      search.found.push_back(id);
      next.found_at = place;
    }
    next.seen = search.number;
    return Progress::goes_on;
  }
  return Progress::is_done;
}

// Finds all points of the component.
template <class Edge_name>
void Basic_dynamic_connectivity<Edge_name>::complete(Search& search) {
  while (look_at_neighbor(search, no_search) != Progress::is_done) {
  }
}

// ---- wrapping ----

// Gives the points of a complete search the places at which it has found them, and their component
// the directions of its cycles.
template <class Edge_name>
void Basic_dynamic_connectivity<Edge_name>::place_anew(const Search& search) {
  if constexpr (is_periodic) {
    Wrapping_directions wraps;
    for (const Point_id id : search.found) nodes_[id].place = nodes_[id].found_at;
    for (const Point_id id : search.found) {
      for (const Neighbor& other : nodes_[id].neighbors) {
        wraps.add(nodes_[id].place + other.offset - nodes_[other.id].place);
      }
    }
    set_wraps(component(search.found.front()), wraps);
  }
}

template <class Edge_name>
void Basic_dynamic_connectivity<Edge_name>::set_wraps(Component component,
                                                      const Wrapping_directions& wraps) {
  Wrapping_directions& known = wraps_[component];
  wrapping_ -= known.number() > 0;
  wrapping_ += wraps.number() > 0;
  known = wraps;
}

// ---- components ----

// Moves the points of a complete search to another component.
template <class Edge_name>
void Basic_dynamic_connectivity<Edge_name>::give_to(const Search& search, Component to) {
  const Component from = component(search.found.front());
  const std::size_t number = search.found.size();
  for (const Point_id id : search.found) nodes_[id].component = to;
  set_size(from, sizes_[from] - number);
  set_size(to, sizes_[to] + number);
}

// A component of size 0 must get its size at once.
template <class Edge_name>
auto Basic_dynamic_connectivity<Edge_name>::new_component(std::size_t size) -> Component {
  if (free_components_.empty()) {
    sizes_.push_back(0);
    if constexpr (is_periodic) wraps_.emplace_back();
    free_components_.push_back(static_cast<Component>(sizes_.size() - 1));
  }
  const Component component = free_components_.back();
  free_components_.pop_back();
  set_size(component, size);
  return component;
}

template <class Edge_name>
void Basic_dynamic_connectivity<Edge_name>::set_size(Component component, std::size_t size) {
  std::size_t& known = sizes_[component];
  if (known > 0) forget_size(known);
  if (size > 0) ++components_of_size_[size];
  if (known > 0 && size == 0) {
    free_components_.push_back(component);
    if constexpr (is_periodic) set_wraps(component, {});
  }
  known = size;
}

template <class Edge_name>
void Basic_dynamic_connectivity<Edge_name>::forget_size(std::size_t size) {
  const auto found = components_of_size_.find(size);
  if (--found->second == 0) components_of_size_.erase(found);
}

template class Basic_dynamic_connectivity<Edge_ids>;
template class Basic_dynamic_connectivity<Periodic_edge>;

}  // namespace kinetri
