// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of a kinetic triangulation and its schedule at the present time: a flip, a vertex added
// or removed, a reconstruction.
#ifndef KINETRI_IMPL_TRIANGULATION_UPDATES_H
#define KINETRI_IMPL_TRIANGULATION_UPDATES_H

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/certification.h"
#include "kinetri/impl/triangulation/decisions.h"
#include "kinetri/impl/triangulation/event_reporter.h"
#include "kinetri/impl/triangulation/schedule.h"
#include "kinetri/impl/triangulation/topology.h"

namespace kinetri::detail {

/// Changes faces, and schedules their edges and hidden points anew. Edges that a change leaves
/// violated just after the present time fail at that time.
template <class Traits>
class Kinetic_types<Traits>::Updates {
 public:
  /// The others must outlive this object.
  Updates(Topology& topology, const Certification& certification, Schedule& schedule,
          Event_reporter& reporter)
      : topology_(topology),
        certification_(certification),
        schedule_(schedule),
        reporter_(reporter),
        triangulation_(topology.triangulation()) {}

  /// Sets the predicates of the triangulation to the instant just after the present time.
  void show_current_time() { topology_.set_instant({schedule_.current_time(), Time_side::after}); }

  /// Flips an edge, finite or infinite, whose entry has left the queue, and reports the event.
  void flip(const Edge_with_mirror& edge, Event_kind kind);

  /// Removes a vertex from the triangulation, which stays Delaunay at the instant of its
  /// predicates. The vertex stays, without faces. The points that its faces hid are hidden by
  /// others, or revealed. Precondition: edges are noted.
  /// In a periodic box the result may be false: then everything must be rebuilt; and if weights
  /// differ, what is left to do for a regular triangulation fails at the present time.
  bool take_out(Vertex_handle v);
  /// Inserts a vertex without faces at its position: it splits the triangle or edge that it is in.
  /// Inside the hull edges are flipped as in a static triangulation, before any certificate is
  /// made. `state` is that of the certificates of its edges. Precondition: edges are noted.
  void put_in(Vertex_handle v, const Location& location,
              Certificate_state state = Certificate_state::any);

  /// Makes a hidden point, which is in no list, visible: event `reveal`. `state` is that of the
  /// certificates of its edges.
  void reveal(Vertex_handle v, const Location& location,
              Certificate_state state = Certificate_state::any);
  /// Hides a vertex of degree 3, of which one neighbor may be the infinite vertex: event `hide`.
  void hide(Vertex_handle v);
  /// Hides the vertex in the face at the location or, if that is infinite, in the finite one beside
  /// it.
  void hide_in(Vertex_handle v, const Location& location) {
    topology_.hide_in(v, location);
    reporter_.note_moved_hidden(v->point().id());
  }
  /// Whether a point is in the face at the location just after the present time.
  bool is_inside(const Point_2& point, const Location& location, bool strictly = false) const;

  /// Reconstructs the triangulation just after the present time, also at degenerate times.
  void rebuild() {
    ++reporter_.counters().reconstructions;
    rebuild([] {});
  }
  /// The same with changed points: change_vertices() inserts, erases or moves them; `rebuilt`, if
  /// given, is the triangulation of the points after that.
  template <class Change_vertices>
  void rebuild(const Change_vertices& change_vertices,
               std::optional<Triangulation> rebuilt = std::nullopt);
  /// The triangulation of points just after the present time; see Static_construction::build.
  Triangulation build_now(std::span<const Point_2> points, std::vector<Edge_ids>& coincident) const;

  std::uint64_t number_of_changes() const { return changes_; }

  /// The number of events, other than new motions, since the faces were constructed, when neighbors
  /// were near each other in memory. They change edges, and so which faces are neighbors.
  std::uint64_t events_since_construction() const { return events() - events_before_construction_; }

 private:
  class Face_journal;

  std::uint64_t events() const {
    const Triangulation_counters& counters = reporter_.counters();
    return counters.number_of_events() -
           counters.events[static_cast<std::size_t>(Event_kind::trajectory)];
  }
  void take_out_hidden(Vertex_handle v);
  bool take_out_on_torus(Vertex_handle v);
  bool take_out_in_plane(Vertex_handle v);
  Location merge_faces(Vertex_handle v);
  void put_in_in_plane(Vertex_handle v, const Location& location, Certificate_state state);
  void flip_link(Vertex_handle v);
  std::vector<Taken_point> take_hidden(std::span<const Face_handle> faces,
                                       Vertex_handle leaving = {});
  void put_hidden(std::span<const Taken_point> hidden, std::span<const Face_handle> faces);
  void note_edge(const Edge& edge, int change) { reporter_.note(Topology::name_of(edge), change); }
  auto note() {
    return [this](const Edge_name& edge, int change) { reporter_.note(edge, change); };
  }

  Topology& topology_;
  const Certification& certification_;
  Schedule& schedule_;
  Event_reporter& reporter_;
  Triangulation& triangulation_;
  std::uint64_t changes_ = 0;
  std::uint64_t events_before_construction_ = 0;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_UPDATES_H
