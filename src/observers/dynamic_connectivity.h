// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connected components of a changing graph; in a periodic box, also in how many directions they
// wrap around it.
#ifndef KINETRI_SRC_OBSERVERS_DYNAMIC_CONNECTIVITY_H
#define KINETRI_SRC_OBSERVERS_DYNAMIC_CONNECTIVITY_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <type_traits>
#include <vector>

#include "kinetri/impl/observers/neighbor_names.h"

namespace kinetri {

/// A sum of offsets of lattice vectors.
struct Offset_sum {
  std::int64_t x = 0;  ///< of the first lattice vector
  std::int64_t y = 0;  ///< of the second

  friend bool operator==(const Offset_sum&, const Offset_sum&) = default;
  friend Offset_sum operator+(const Offset_sum& a, const Lattice_offset_2& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend Offset_sum operator-(const Offset_sum& a, const Offset_sum& b) {
    return {a.x - b.x, a.y - b.y};
  }
};

/// The directions in which a component wraps: the space that is spanned by the net offsets of its
/// cycles, which are those of paths from an image of a point to another image of that point.
class Wrapping_directions {
 public:
  /// 0, 1 or 2.
  int number() const { return number_; }
  /// Adds a net offset, or all of another component.
  void add(const Offset_sum& net);
  void add(const Wrapping_directions& other);

 private:
  int number_ = 0;
  Offset_sum first_;  // if there is one direction, a vector that has it
};

/// A graph whose vertices are points, and its connected components with their sizes. It knows
/// neither geometry nor time. `Edge_name` is Edge_ids, or in a periodic box Periodic_edge: then
/// several edges may have the same ends, and an edge both ends at one point.
///
/// A component wraps around the box if one of its cycles has a net offset other than zero. Each
/// point has a place, a sum of offsets; of an edge from p to q, the place of p and the offset, less
/// the place of q, is a net offset of a cycle. That is union-find with displacements to the root,
/// as in J. Machta, Y. S. Choi, A. Lucke, T. Schweizer, L. M. Chayes, Invaded cluster algorithm for
/// Potts models, Physical Review E 54, 1996, and M. E. J. Newman, R. M. Ziff, Fast Monte Carlo
/// algorithm for site or bond percolation, Physical Review E 64, 2001, section II.E; here edges are
/// removed, too.
///
/// Cost: to add an edge that joins two components, O(points and edges of the smaller one). To
/// remove an edge, alternating searches from both ends until they meet or one is complete: O(points
/// and edges of the side that is complete first) if the component splits; else O(edges visited
/// until the searches meet), few if the edge is on a short cycle, and O(edges of the component) at
/// worst. All else O(1), except for the logarithm of the number of different sizes. Memory:
/// O(points + edges). (Structures with a polylogarithmic bound for every change are slower if
/// components are small or cycles short: J. Holm, K. de Lichtenberg, M. Thorup, Poly-logarithmic
/// deterministic fully-dynamic algorithms for connectivity, Journal of the ACM 48(4), 2001.)
template <class Edge_name>
class Basic_dynamic_connectivity {
 public:
  /// What names a neighbor of a point.
  using Neighbor =
      std::conditional_t<std::is_same_v<Edge_name, Periodic_edge>, Periodic_image, Point_id>;
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
  bool is_edge(const Edge_name& edge) const;
  /// Adds an edge; returns whether it has joined two components. Precondition: the graph contains
  /// both ends, which differ in the plane, and not the edge.
  bool add_edge(const Edge_name& edge);
  /// Removes an edge; returns whether that has split a component. If the component wraps, and the
  /// searches from both ends do not meet at one image, that costs O(edges of the component).
  /// Precondition: is_edge(edge).
  bool remove_edge(const Edge_name& edge);

  /// The component of a point. Precondition: contains(id).
  Component component(Point_id id) const;
  /// The number of points in the component of a point. Precondition: contains(id).
  std::size_t size_of(Point_id id) const { return sizes_[component(id)]; }
  /// Whether the graph contains both and there is a path from one to the other.
  bool are_connected(Point_id a, Point_id b) const {
    return contains(a) && contains(b) && nodes_[a].component == nodes_[b].component;
  }
  /// In how many independent directions the component of a point wraps around a periodic box: 0, 1
  /// or 2. Precondition: contains(id).
  int wrapping_directions(Point_id id) const {
    if constexpr (is_periodic) return wraps_[component(id)].number();
    return 0;
  }
  /// The number of components that wrap.
  std::size_t number_of_wrapping_components() const { return wrapping_; }
  /// The number of components.
  std::size_t number_of_components() const { return sizes_.size() - free_components_.size(); }
  /// The number of points in a component that has the most; 0 if there is none.
  std::size_t largest() const {
    return components_of_size_.empty() ? 0 : components_of_size_.rbegin()->first;
  }

 private:
  static constexpr Component no_component = std::numeric_limits<Component>::max();
  static constexpr std::uint64_t no_search = 0;
  static constexpr bool is_periodic = std::is_same_v<Edge_name, Periodic_edge>;

  // In a periodic box. Invariant: the places of the ends of each edge, and its offset, have a net
  // offset of the directions in which the component wraps.
  struct No_place {};
  using Place = std::conditional_t<is_periodic, Offset_sum, No_place>;

  struct Node {
    Component component = no_component;
    std::vector<Neighbor> neighbors;
    std::uint64_t seen = no_search;             // the last search that has found it
    [[no_unique_address]] Place place = {};     // against the other points of the component
    [[no_unique_address]] Place found_at = {};  // by that search, against its first point
  };

  // A search: the points that it has found, and its position among their neighbors.
  struct Search {
    std::uint64_t number = no_search;
    std::vector<Point_id> found;
    std::size_t next_point = 0;
    std::size_t next_neighbor = 0;
  };

  // Two searches meet at one image, or at different images of one point.
  enum class Progress : std::uint8_t { goes_on, meets, meets_around, is_done };

  void begin(Search& search, Point_id id, const Lattice_offset_2& offset = {});
  Progress look_at_neighbor(Search& search, std::uint64_t other);
  void complete(Search& search);
  void place_anew(const Search& search);
  void set_wraps(Component component, const Wrapping_directions& wraps);
  void give_to(const Search& search, Component component);
  Component new_component(std::size_t size);
  void set_size(Component component, std::size_t size);
  void forget_size(std::size_t size);

  std::vector<Node> nodes_;         // by id
  std::vector<std::size_t> sizes_;  // by component; 0 if it is free
  std::vector<Component> free_components_;
  std::map<std::size_t, std::size_t> components_of_size_;  // sizes that occur only
  std::vector<Wrapping_directions> wraps_;                 // by component, in a periodic box
  std::size_t wrapping_ = 0;  // the number of those that have directions
  std::uint64_t searches_ = no_search;
  std::array<Search, 2> searches_of_ends_;  // members for their memory
};

extern template class Basic_dynamic_connectivity<Edge_ids>;
extern template class Basic_dynamic_connectivity<Periodic_edge>;

/// In the plane.
using Dynamic_connectivity = Basic_dynamic_connectivity<Edge_ids>;

}  // namespace kinetri

#endif  // KINETRI_SRC_OBSERVERS_DYNAMIC_CONNECTIVITY_H
