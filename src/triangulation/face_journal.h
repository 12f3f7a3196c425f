// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the schedule and the observers follow the changes of a torus.
#ifndef KINETRI_SRC_TRIANGULATION_FACE_JOURNAL_H
#define KINETRI_SRC_TRIANGULATION_FACE_JOURNAL_H

#include <algorithm>
#include <vector>

#include "kinetri/impl/triangulation/updates.h"

namespace kinetri::detail {

/// The faces that a change of the torus has changed or created, whose edges are scheduled anew.
/// Their edges leave the queue, and are noted, before the first of their faces changes. So do the
/// points that they hide. `leaving` is the vertex that is removed, if one is.
template <class Traits>
class Kinetic_types<Traits>::Updates::Face_journal : public Triangulation::Journal {
 public:
  explicit Face_journal(Updates& updates, Vertex_handle leaving = {})
      : updates_(updates), leaving_(leaving) {}

  void before_change(Face_handle face) override {
    if (is_known(face)) return;
    if constexpr (is_weighted) {
      const std::vector<Taken_point> taken = updates_.take_hidden({&face, 1}, leaving_);
      hidden_.insert(hidden_.end(), taken.begin(), taken.end());
    }
    for (int i = 0; i < 3; ++i) {
      const Edge_with_mirror edge = updates_.topology_.with_mirror(Edge(face, i));
      if (is_known(edge.there.first)) continue;
      updates_.note_edge(edge.here, -1);
      if (!updates_.schedule_.is_deferred()) updates_.schedule_.unschedule(edge);
      Topology::set_event(edge, no_event);
    }
    created(face);
  }
  void created(Face_handle face) override {
    faces_.push_back(face);
    face->tds_data().mark_in_conflict();
  }
  void deleted(Face_handle face) override { std::erase(faces_, face); }

  /// `state` is that of the certificates of edges at `v`.
  void schedule(Vertex_handle v = {}, Certificate_state state = Certificate_state::any) {
    std::vector<Edge_with_mirror> edges;
    for (const Face_handle face : faces_) {
      face->tds_data().clear();
      for (int i = 0; i < 3; ++i) {
        if (face->event(i) == Topology::listed) continue;
        const Edge_with_mirror& edge =
            edges.emplace_back(updates_.topology_.with_mirror(Edge(face, i)));
        updates_.note_edge(edge.here, 1);
        Topology::set_event(edge, Topology::listed);
      }
    }
    if (!updates_.schedule_.is_deferred()) {
      const auto at_v = std::partition(edges.begin(), edges.end(), [&](const Edge_with_mirror& e) {
        const auto& [face, i] = e.here;
        return state == Certificate_state::any || (face->vertex(Triangulation::cw(i)) != v &&
                                                   face->vertex(Triangulation::ccw(i)) != v);
      });
      const auto& now = updates_.schedule_.current_time();
      updates_.schedule_.schedule({edges.begin(), at_v}, now);
      updates_.schedule_.schedule({at_v, edges.end()}, now, state);
    }
    if constexpr (is_weighted) updates_.put_hidden(hidden_, faces_);
  }

 private:
  static bool is_known(Face_handle face) { return face->tds_data().is_in_conflict(); }

  Updates& updates_;
  Vertex_handle leaving_;
  std::vector<Face_handle> faces_;
  std::vector<Taken_point> hidden_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_FACE_JOURNAL_H
