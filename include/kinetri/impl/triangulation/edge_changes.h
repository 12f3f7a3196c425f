// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges added and removed during a change that is reported as a whole.
#ifndef KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H
#define KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H

#include <algorithm>
#include <vector>

#include "kinetri/events/event.h"

namespace kinetri::detail {

/// Notes edges that are added and removed, possibly several times, and gives the net changes. O(k
/// log k) for k notes.
class Edge_changes {
 public:
  struct Change {
    Edge_ids edge;
    int net;  ///< 1: added; -1: removed; 0: as it was before
  };

  /// Notes that the edge has been added (1) or removed (-1).
  void note(const Edge_ids& edge, int change) { notes_.push_back({edge, change}); }

  /// The noted edges, each once, in the order of their ids. Forgets the notes.
  std::vector<Change> take() {
    std::ranges::sort(notes_, {}, &Change::edge);
    std::vector<Change> result;
    for (const Change& note : notes_) {
      if (result.empty() || result.back().edge != note.edge) {
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
