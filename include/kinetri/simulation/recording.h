// SPDX-License-Identifier: GPL-3.0-or-later
//
// A recorded run: the edges and triangles at the start, the trajectories, the events, and the
// triangles that each event changes, so that it can be played forward and backward without
// predicates.
#ifndef KINETRI_SIMULATION_RECORDING_H
#define KINETRI_SIMULATION_RECORDING_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/base/double_interval.h"
#include "kinetri/impl/simulation/triangle_map.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/simulation/box_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

/// An exact time, rounded for display.
struct Recorded_time {
  double nearest = 0;           ///< the time, rounded to nearest
  Double_interval bounds = {};  ///< binary64 bounds of the time; equal if it is a binary64 number

  friend bool operator==(const Recorded_time&, const Recorded_time&) = default;
};

/// An event with a rounded time.
using Recorded_event = Basic_event<Recorded_time>;

/// The motion of a point from an event on.
struct Recorded_motion {
  std::optional<std::size_t> event;  ///< index of the event in the recording; none: from the start
  Point_id point = no_point;         ///< the point
  /// The new motion, with radius and weight if points have them; none: the point is erased.
  std::optional<Polynomial_disc_motion_2> motion;
};

/// Which point has the vertex of a point, from an event on: another one that coincides with it for
/// a while and hides it (Coincident_points), or itself.
struct Recorded_coincidence {
  std::optional<std::size_t> event;  ///< index of the event in the recording; none: from the start
  Point_id point = no_point;         ///< the point
  Point_id shown = no_point;         ///< the point that has its vertex

  friend bool operator==(const Recorded_coincidence&, const Recorded_coincidence&) = default;
};

/// A triangle that an event removes or adds.
struct Recorded_triangle {
  std::size_t event = 0;      ///< index of the event in the recording
  bool is_added = false;      ///< whether it is added; else it is removed
  Triangle_ids corners = {};  ///< counterclockwise, the least id first
  /// In a periodic box it is a Periodic_triangle, with these.
  std::array<Lattice_offset_2, 2> offsets = {};

  friend bool operator==(const Recorded_triangle&, const Recorded_triangle&) = default;
};

/// A recorded run. To play it, begin with `initial_edges`, `initial_triangles` and the motions
/// without an event. At each event, in order, remove and add its edge, remove and add the triangles
/// that name it, and set the motions and the shown points that name it. A point that `coincidences`
/// does not name has its own vertex.
///
/// `events` has the events of the run. If triangles change or are inverted although no edge changes
/// (points meet, or all points are collinear for an instant), there is a row of the kind rebuild
/// without an edge, which is not an event of the run: its number is that of the next event.
///
/// In a periodic box the edges at the start are the sides of the triangles at the start, which have
/// offsets, as do the edges of events.
///
/// Hidden points are those without an edge, if any point has one; and those that coincide with the
/// point that is shown.
struct Recording {
  double from = 0;                              ///< the start, rounded
  double until = 0;                             ///< the end, rounded
  std::optional<Periodic_box_2> periodic_box;   ///< the box, if it is periodic
  std::vector<Edge_ids> initial_edges;          ///< just after the start, sorted
  std::vector<Triangle_ids> initial_triangles;  ///< just after the start, sorted
  /// In a periodic box, of each triangle at the start (Periodic_triangle); else empty.
  std::vector<std::array<Lattice_offset_2, 2>> initial_offsets;
  std::vector<Recorded_motion> motions;            ///< by event; those of the start first
  std::vector<Recorded_coincidence> coincidences;  ///< by event; those of the start first
  std::vector<Recorded_event> events;              ///< in exact order of time
  std::vector<Recorded_triangle> triangles;        ///< by event; those that it removes first
  std::uint64_t events_in_all = 0;                 ///< events of the run, recorded or left out
  /// Whether events are left out. Then the events of an interval of time are replaced by their net
  /// effect, at the time of the last of them: edges by rows of the kind rebuild, new motions by
  /// rows of the kind trajectory, insert and erase. Edges and triangles are those of the exact
  /// triangulation just after each time of a row; between two such times they are the earlier ones.
  bool is_thinned = false;
};

/// Observes a run and records it. Cost of an event: the degrees of the ends of its edges; also
/// O(rows log rows) at most once in `most_rows` / 2 events. Memory: O(points + rows). It does not
/// read the triangulation at flips, so these may be reported late.
template <class Traits = Linear_kinetic_traits_2>
class Recorder : public Event_observer {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what is observed
  using Time = Algebraic_number;                          ///< of events

  /// Records `triangulation` from its current time up to the time `until`. Add the recorder as an
  /// observer of the triangulation, or of the simulation that owns it. If there are more than
  /// `most_rows` events, the recording is thinned to at most that many rows, or to the net changes
  /// of the whole run if these are more. Preconditions: until is finite; most_rows > 0.
  Recorder(const Triangulation& triangulation, double until, std::size_t most_rows);

  bool looks_at_triangulation() const override { return false; }
  /// Records the event.
  void after_event(const Event& event) override;

  /// Records the changed triangles.
  void after_rebuild(const Time& time, std::span<const Edge_ids> edges) override;

  /// Records which of points that coincide is shown.
  void after_hiding(const Time& time, std::span<const Point_id> points) override;

  /// The recording up to the current time of the triangulation. Precondition: not called during an
  /// event.
  Recording recording() const;

  /// The part recorded since the last call, or since the start, up to the current time of the
  /// triangulation; it is removed from this object. A later part continues the one before: only the
  /// first part has edges, triangles, motions and coincidences of the start. Preconditions: not
  /// called during an event; the recording is not thinned (`most_rows`).
  Recording take();

 private:
  void set_time(const Time& time);
  void expect_row(const Time& time);
  void record_motion(Point_id id, std::optional<std::size_t> event);
  void record_coincidence(Point_id id, std::optional<std::size_t> event);
  using Corner = std::conditional_t<PeriodicKineticTraits_2<Traits>, Periodic_image, Point_id>;
  using Directed = std::array<Corner, 2>;
  template <class Function>
  void for_each_side(Point_id p, const Function& function) const;
  Corner apex_now(const Corner& p, const Corner& q) const;
  std::vector<Directed> directed(const Edge_ids& pair) const;
  void record_flip(const Event& event);
  std::vector<Recorded_triangle> changed_triangles(std::span<const Edge_ids> edges) const;
  void record_triangles(std::span<const Recorded_triangle> changes);
  void thin_if_needed();
  void thin(Recording& recording, std::size_t most_rows) const;

  const Triangulation& triangulation_;
  std::size_t most_rows_;
  std::size_t limit_;                       // of rows before the next thinning
  std::optional<Time> time_;                // of the last row
  Recorded_time rounded_time_;              // the same
  detail::Triangle_map<Corner> triangles_;  // after what has been recorded
  std::map<Point_id, Point_id> shown_;      // the same: of hidden points that coincide with others
  Recording recording_;  // up to the last event; until is the end that is expected
};

extern template class Recorder<Linear_kinetic_traits_2>;
extern template class Recorder<Polynomial_kinetic_traits_2>;
extern template class Recorder<Disc_kinetic_traits_2>;
extern template class Recorder<Polynomial_disc_kinetic_traits_2>;
extern template class Recorder<Periodic_kinetic_traits_2>;
extern template class Recorder<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_RECORDING_H
