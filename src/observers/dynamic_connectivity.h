// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connected components of a changing graph.
#ifndef KINETRI_SRC_OBSERVERS_DYNAMIC_CONNECTIVITY_H
#define KINETRI_SRC_OBSERVERS_DYNAMIC_CONNECTIVITY_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "kinetri/impl/events/basic_event.h"

namespace kinetri {

/// A graph whose vertices are points, and its connected components with their sizes. It knows
/// neither geometry nor time.
///
/// Cost: to add an edge that joins two components, O(points and edges of the smaller one). To
/// remove an edge, alternating searches from both ends until they meet or one is complete: O(points
/// and edges of the side that is complete first) if the component splits; else O(edges visited
/// until the searches meet), few if the edge is on a short cycle, and O(edges of the component) at
/// worst. All else O(1), except for the logarithm of the number of different sizes. Memory:
/// O(points + edges). (Structures with a polylogarithmic bound for every change are slower if
/// components are small or cycles short: J. Holm, K. de Lichtenberg, M. Thorup, Poly-logarithmic
/// deterministic fully-dynamic algorithms for connectivity, Journal of the ACM 48(4), 2001.)
class Dynamic_connectivity {
 public:
  /// Identifies a component until one of its edges or points changes.
  using Component = std::uint32_t;

  /// Whether the point is in the graph.
  bool contains(Point_id id) const {
    return id < nodes_.size() && nodes_[id].component != no_component;
  }
  /// Adds a point as a component of its own. Precondition: !contains(id).
  void add_point(Point_id id);
  /// Removes a point. Precondition: contains(id), and it has no edges.
  void remove_point(Point_id id);

  /// Whether there is that edge. O(degree of the first end).
  bool is_edge(const Edge_ids& edge) const;
  /// Adds an edge; returns whether it has joined two components. Precondition: the graph contains
  /// both ends, which differ, and not the edge.
  bool add_edge(const Edge_ids& edge);
  /// Removes an edge; returns whether that has split a component. Precondition: is_edge(edge).
  bool remove_edge(const Edge_ids& edge);

  /// The component of a point. Precondition: contains(id).
  Component component(Point_id id) const;
  /// The number of points in the component of a point. Precondition: contains(id).
  std::size_t size_of(Point_id id) const { return sizes_[component(id)]; }
  /// Whether the graph contains both and there is a path from one to the other.
  bool are_connected(Point_id a, Point_id b) const {
    return contains(a) && contains(b) && nodes_[a].component == nodes_[b].component;
  }
  /// The number of components.
  std::size_t number_of_components() const { return sizes_.size() - free_components_.size(); }
  /// The number of points in a component that has the most; 0 if there is none.
  std::size_t largest() const {
    return components_of_size_.empty() ? 0 : components_of_size_.rbegin()->first;
  }

 private:
  static constexpr Component no_component = std::numeric_limits<Component>::max();
  static constexpr std::uint64_t no_search = 0;

  struct Node {
    Component component = no_component;
    std::vector<Point_id> neighbors;
    std::uint64_t seen = no_search;  // the last search that has found it
  };

  // A search: the points that it has found, and its position among their neighbors.
  struct Search {
    std::uint64_t number = no_search;
    std::vector<Point_id> found;
    std::size_t next_point = 0;
    std::size_t next_neighbor = 0;
  };

  enum class Progress : std::uint8_t { goes_on, meets, is_done };

  void begin(Search& search, Point_id id);
  Progress look_at_neighbor(Search& search, std::uint64_t other);
  void give_to(const Search& search, Component component);
  Component new_component(std::size_t size);
  void set_size(Component component, std::size_t size);
  void forget_size(std::size_t size);

  std::vector<Node> nodes_;         // by id
  std::vector<std::size_t> sizes_;  // by component; 0 if it is free
  std::vector<Component> free_components_;
  std::map<std::size_t, std::size_t> components_of_size_;  // sizes that occur only
  std::uint64_t searches_ = no_search;
  std::array<Search, 2> searches_of_ends_;  // members for their memory
};

}  // namespace kinetri

#endif  // KINETRI_SRC_OBSERVERS_DYNAMIC_CONNECTIVITY_H
