// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edges that come and go during a change that is reported as a whole.
#ifndef KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H
#define KINETRI_IMPL_TRIANGULATION_EDGE_CHANGES_H

#include <algorithm>
#include <vector>

#include "kinetri/events/event.h"

namespace kinetri::detail {

/// Notes edges that are added and removed, in any order and as often as it happens, and adds up at
/// the end. O(k log k) for k notes.
class Edge_changes {
 public:
  /// An edge, and what became of it.
  struct Change {
    Edge_ids edge;
    int net;  ///< 1: added; -1: removed; 0: as it was before
  };

  /// Notes that the edge has been added (1) or removed (-1).
  void note(const Edge_ids& edge, int change) { notes_.push_back({edge, change}); }

  /// The edges that have been noted, each once, in the order of their ids. Nothing is noted then.
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
