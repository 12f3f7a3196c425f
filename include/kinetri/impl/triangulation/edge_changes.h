// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges added and removed during a change that is reported as a whole.
#ifndef KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H
#define KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/events/event.h"

namespace kinetri::detail {

/// A number in the order of the edges, which is faster to compare.
inline std::uint64_t edge_key(const Edge_ids& edge) {
  return std::uint64_t{edge[0]} << 32 | edge[1];
}

/// The same of the edges of a periodic box.
inline std::pair<std::uint64_t, Lattice_offset_2> edge_key(const Periodic_edge& edge) {
  return {edge_key(edge.ids), edge.offset};
}

/// @{
/// The ends of a named edge, and the offset of the second one against the first.
inline const Edge_ids& ids_of(const Edge_ids& edge) {
  return edge;
}
inline const Edge_ids& ids_of(const Periodic_edge& edge) {
  return edge.ids;
}
inline Lattice_offset_2 offset_of(const Edge_ids& /*edge*/) {
  return {};
}
inline Lattice_offset_2 offset_of(const Periodic_edge& edge) {
  return edge.offset;
}
/// @}

/// @{
/// The id of a point, or of an image of a point in a periodic box.
constexpr Point_id id_of(Point_id point) {
  return point;
}
constexpr Point_id id_of(const Periodic_image& image) {
  return image.id;
}
/// @}

/// Sorts edges by the smaller id, the other one, the offset. O(k + n) for k edges, if they are more
/// than n / 8 for ids less than n; else O(k log k).
template <class Edge_name>
void sort_edges(std::vector<Edge_name>& edges);

/// Notes edges that are added and removed, possibly several times, and gives the net changes. For k
/// notes, the cost of sort_edges.
template <class Edge_name>
class Edge_changes {
 public:
  struct Change {
    Edge_name edge;
    int net;  ///< 1: added; -1: removed; 0: as it was before
  };

  /// Notes that the edge has been added (1) or removed (-1).
  void note(const Edge_name& edge, int change) { notes_.push_back({edge, change}); }

  /// The noted edges, each once, in the order of their names. Forgets the notes.
  std::vector<Change> take();

 private:
  std::vector<Change> notes_;
};

/// Changes that are reported together.
template <class Edge_name>
struct Change_notes {
  struct Hiding {
    Point_id point;
    bool is_hidden;
    std::optional<Point_id> by;
  };

  /// An edge was added (1) or removed (-1). Precondition: edges are noted.
  void note(const Edge_name& edge, int change) { edges->note(edge, change); }
  /// A point has been hidden or revealed, while edges are noted; by another point, if that is
  /// given.
  void note_hidden(Point_id point, bool is_hidden, std::optional<Point_id> by = std::nullopt) {
    points.push_back({point, is_hidden, by});
  }
  /// A hidden point may have another triangle.
  void note_moved_hidden(Point_id point) { moved_hidden.push_back(point); }

  std::optional<Edge_changes<Edge_name>> edges;  ///< while edges are noted
  std::vector<Hiding> points;                    ///< hidden or revealed meanwhile
  std::vector<Point_id> moved_hidden;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H
