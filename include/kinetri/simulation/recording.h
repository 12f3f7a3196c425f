// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run, recorded: the edges at the start, the trajectories, and the events, so that it can be
// played forward and backward without computing anything anew. Viewers are made from it.
#ifndef KINETRI_SIMULATION_RECORDING_H
#define KINETRI_SIMULATION_RECORDING_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinetri/base/double_interval.h"
#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/kinetic/polynomial_motion_2.h"
#include "kinetri/simulation/box_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

/// An exact time as it is shown.
struct Recorded_time {
  double nearest = 0;           ///< the binary64 number nearest to it
  Double_interval bounds = {};  ///< that number twice if it is the time, else the two around it

  friend bool operator==(const Recorded_time&, const Recorded_time&) = default;
};

/// An event with its time as it is shown.
using Recorded_event = Event<Recorded_time>;

/// What a point does from an event on.
struct Recorded_motion {
  std::optional<std::size_t> event;           ///< its index in the recording; none: from the start
  Point_id point = no_point;                  ///< which one
  std::optional<Polynomial_motion_2> motion;  ///< none: it is not there any more
};

/// A recorded run. Playing it: begin with `initial_edges` and the motions without an event; at each
/// event, in order, remove and add its edges, and take over the motions that name it.
struct Recording {
  double from = 0;                       ///< the start, rounded
  double until = 0;                      ///< how far it got
  std::vector<Edge_ids> initial_edges;   ///< just after the start, sorted
  std::vector<Recorded_motion> motions;  ///< in the order of events, those of the start first
  std::vector<Recorded_event> events;    ///< in exact order of time
  std::uint64_t events_in_all = 0;       ///< how many the run had, left out ones included
  /// Whether events are left out: those of an interval of time are then replaced by what they come
  /// to, at the time of the last of them: edges by rows of the kind rebuild, new motions by rows of
  /// the kind trajectory, insert and erase. The edges just after each time of a row are still those
  /// of the exact triangulation; those between two times are the ones of the earlier.
  bool is_thinned = false;
};

/// Observes a run and records it. Cost: some operations an event, and O(rows log rows) once in
/// `most_rows` / 2 events or less often. Memory: O(points + rows).
template <class Traits = Linear_kinetic_traits_2>
class Recorder : public Event_observer<typename Traits::Time> {
 public:
  using Triangulation = Kinetic_delaunay_triangulation_2<Traits>;  ///< what is observed
  using Time = typename Traits::Time;                              ///< of the traits

  /// Records what happens in `triangulation` from its present on, up to the time `until`. To be
  /// added as its observer, or as one of the simulation that owns it. If there are more than
  /// `most_rows` events, the recording is thinned to at most that many rows, or, where the first
  /// and the last triangulation differ in more, to what they differ in. Precondition: until is
  /// finite; most_rows > 0.
  Recorder(const Triangulation& triangulation, double until, std::size_t most_rows);

  /// Records the event.
  void after_event(const Event<Time>& event) override;

  /// The recording up to the present of the triangulation. Not to be called within an event.
  Recording recording() const;

 private:
  void record_motion(Point_id id, std::optional<std::size_t> event);
  void thin(Recording& recording, std::size_t most_rows) const;

  const Triangulation& triangulation_;
  std::size_t most_rows_;
  std::size_t limit_;           // of rows before the next thinning
  std::optional<Time> time_;    // of the last event
  Recorded_time rounded_time_;  // the same
  Recording recording_;         // up to the last event; until is the end that is expected
};

extern template class Recorder<Linear_kinetic_traits_2>;
extern template class Recorder<Polynomial_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_RECORDING_H
