// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges added and removed during a change that is reported as a whole.
#ifndef KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H
#define KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
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

/// Sorts elements by the names of their edges `edge_of(element)`: by the smaller id, the other one,
/// the offset. At each id there are few elements on average. O(k + n) for k elements, if they are
/// more than n / 8 for ids less than n; else O(k log k).
template <class Element, class Edge_of>
void sort_by_edge(std::vector<Element>& elements, const Edge_of& edge_of) {
  const auto key = [&](const Element& element) { return edge_key(edge_of(element)); };
  constexpr std::size_t ids_for_each_element = 8;
  std::size_t ids = 0;
  for (const Element& element : elements) {
    ids = std::max(ids, std::size_t{ids_of(edge_of(element))[0]} + 1);
  }
  if (ids > ids_for_each_element * elements.size()) {
    std::ranges::sort(elements, {}, key);
    return;
  }
  // By the smaller id by counting, then by the greater one.
  std::vector<std::uint32_t> ends(ids + 1);
  for (const Element& element : elements) ++ends[ids_of(edge_of(element))[0] + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Element> sorted(elements.size());
  for (const Element& element : elements) sorted[ends[ids_of(edge_of(element))[0]]++] = element;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : ends) {
    std::ranges::sort(sorted.begin() + begin, sorted.begin() + end, {}, key);
    begin = end;
  }
  elements = std::move(sorted);
}

/// Notes edges that are added and removed, possibly several times, and gives the net changes. For k
/// notes, the cost of sort_by_edge.
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
  std::vector<Change> take() {
    sort_by_edge(notes_, [](const Change& change) -> const Edge_name& { return change.edge; });
    std::vector<Change> result;
    for (const Change& note : notes_) {
      if (result.empty() || edge_key(result.back().edge) != edge_key(note.edge)) {
        result.push_back(note);
      } else {
        result.back().net += note.net;
      }
    }
    notes_.clear();
    return result;
  }

 private:
  std::vector<Change> notes_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H
