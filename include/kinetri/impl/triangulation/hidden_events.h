// SPDX-License-Identifier: GPL-3.0-or-later
//
// Events of the hidden points of a kinetic regular triangulation. A hidden point is above the
// lifted triangle in whose projection it is, certified by one in-circle certificate and one
// orientation certificate for each side of the triangle. When it reaches a side, it is located
// anew; when it reaches the plane, it becomes a vertex.
//
// While the events of one time are executed, the recorded triangle of a hidden point may be wrong:
// then its certificate fails at once, and hidden points come after all edges. docs/MATH.md, section
// 11.
#ifndef KINETRI_IMPL_TRIANGULATION_HIDDEN_EVENTS_H
#define KINETRI_IMPL_TRIANGULATION_HIDDEN_EVENTS_H

#include <cstdint>

#include "kinetri/base/error.h"
#include "kinetri/impl/triangulation/updates.h"

namespace kinetri::detail {

/// Puts hidden points into the right triangles, or makes them vertices. Precondition: points have
/// weights.
template <class Traits>
class Kinetic_types<Traits>::Hidden_events {
 public:
  /// The others must outlive this object.
  Hidden_events(Topology& topology, Schedule& schedule, Event_reporter& reporter, Updates& updates)
      : topology_(topology),
        triangulation_(topology.triangulation()),
        schedule_(schedule),
        reporter_(reporter),
        updates_(updates) {}

  /// Executes the failure of a hidden point, whose entry has left the queue: the point gets another
  /// triangle, becomes a vertex, or neither. Precondition: the edges are right just after the
  /// present time. Returns false if the triangulation must be rebuilt.
  [[nodiscard]] bool execute(const Entry& failure) {
    const Vertex_handle v = failure.hidden;
    v->set_event(no_event);
    if (triangulation_.dimension() < 2) return false;
    const Location location = Topology::location_of_hidden(v);
    triangulation_.take_from_face(v);
    if (failure.index != plane_condition) {
      // It crosses a side of its triangle, or has been beyond it since it got this triangle.
      const bool has_just_crossed = failure.changes_sign && !reporter_.is_noting();
      const int i = topology_.with_mirror(Edge(location.face, failure.index)).there.second;
      const Location beyond = Topology::beyond(v->point(), location, failure.index);
      if (!triangulation_.is_infinite(beyond.face)) {
        updates_.hide_in(v, beyond);
        schedule_.schedule_hidden(v, schedule_.current_time(),
                                  has_just_crossed ? static_cast<std::uint8_t>(i) : no_condition);
        return true;
      }
    } else if (failure.changes_sign && updates_.is_inside(v->point(), location, true)) {
      updates_.reveal(v, location,
                      reporter_.is_noting() ? Certificate_state::any : Certificate_state::vanishes);
      return true;
    }
    updates_.show_current_time();
    return place(v, topology_.locate_from(v->point(), location));
  }

  /// Inserts a new point, or a hidden one that is in no list, at its location just after now.
  /// Returns false if the triangulation must be rebuilt.
  [[nodiscard]] bool place(Vertex_handle v, const Location& location) {
    const auto hide_now = [&](const Location& where) {
      if (!v->is_hidden()) reporter_.note_hidden(v->point().id(), true);
      updates_.hide_in(v, where);
    };
    if (location.locus == Triangulation::VERTEX) {
      // They coincide at all times: the heavier one hides the other.
      const auto side = triangulation_.geom_traits().power_side_of_oriented_power_circle_2_object();
      const bool is_heavier =
          side(topology_.corner(location.face, location.index),
               topology_.point_at(location, v->point())) == CGAL::ON_POSITIVE_SIDE;
      hide_now(location);
      if (is_heavier) return false;
      schedule_.schedule_hidden(v, schedule_.current_time());
    } else if (const Location above = topology_.hiding_face(v->point(), location);
               above.face != Face_handle()) {
      hide_now(above);
      schedule_.schedule_hidden(v, schedule_.current_time());
    } else if (v->is_hidden()) {
      // The edges are reported: they must not depend on the walk.
      updates_.reveal(v, topology_.at_least_hull_edge(v->point(), location));
    } else {
      updates_.put_in(v, location);
    }
    return true;
  }

 private:
  Topology& topology_;
  Triangulation& triangulation_;
  Schedule& schedule_;
  Event_reporter& reporter_;
  Updates& updates_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_HIDDEN_EVENTS_H
