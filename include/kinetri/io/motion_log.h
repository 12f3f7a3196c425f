// SPDX-License-Identifier: GPL-3.0-or-later
//
// The motion log: the motion of each point at the start, and each change of it. Together with the
// event log it is a complete record of a run. docs/PROGRAM.md, section "Motions", describes its
// rows, and exactly how a motion continues after a contact.
#ifndef KINETRI_IO_MOTION_LOG_H
#define KINETRI_IO_MOTION_LOG_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/events/event.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

/// An observer that writes each motion that a point gets at an event as one line:
///
///   event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch
///
/// `event` is the number of the event; it is empty in the lines of the points at the start. The
/// other numbers are those of the motion, with the fewest digits that read back exactly; 0 if the
/// kind of motion has none. They are empty if the event erases the point. A collision has no line
/// for a point that keeps its motion.
///
/// Errors are those of the stream. Cost: O(1) for each line.
template <class Traits = Linear_kinetic_traits_2>
class Motion_log_writer : public Event_observer {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what is observed
  using Motion = typename Traits::Motion;                 ///< of the traits

  /// Writes the header line and the present motions. `radius` is that of all points if their
  /// motions have none (Simulation_options::radius). `out` and `triangulation` must outlive this
  /// object. Add it as an observer of the triangulation, or of the simulation that owns it.
  /// Preconditions: no motion has a weight besides its radius, now or later; the triangulation is
  /// not reversed while it is observed.
  Motion_log_writer(std::ostream& out, const Triangulation& triangulation, double radius = 0);

  /// False: it reads only the motions of the points that an event names, and these are current when
  /// observers are called.
  bool looks_at_triangulation() const override { return false; }
  /// Stores the motions that a collision may change.
  void before_event(const Event& event) override;

  /// Writes the lines of the event.
  void after_event(const Event& event) override;

 private:
  std::optional<Motion> motion_now(Point_id id) const;
  void write(std::optional<std::uint64_t> event, Point_id id, const std::optional<Motion>& motion);

  std::ostream& out_;
  const Triangulation& triangulation_;
  double radius_;
  std::array<std::optional<Motion>, 2> before_collision_;  // of point_a and of point_b
};

extern template class Motion_log_writer<Linear_kinetic_traits_2>;
extern template class Motion_log_writer<Polynomial_kinetic_traits_2>;
extern template class Motion_log_writer<Disc_kinetic_traits_2>;
extern template class Motion_log_writer<Polynomial_disc_kinetic_traits_2>;
extern template class Motion_log_writer<Periodic_kinetic_traits_2>;
extern template class Motion_log_writer<Periodic_disc_kinetic_traits_2>;

/// A row of a motion log.
struct Logged_motion {
  std::optional<std::uint64_t> event;              ///< the number of the event; none at the start
  Point_id id = no_point;                          ///< of the point
  std::optional<Polynomial_disc_motion_2> motion;  ///< from then on; none if it is erased
  std::size_t line = 0;                            ///< of the file, counted from 1
};

/// Reads a motion log. `name` stands for it in messages. Throws Input_error `name:line: ...` if a
/// column is missing or unknown, a row has too few or too many fields, a number is invalid, or some
/// numbers of a motion are missing.
std::vector<Logged_motion> read_motion_log(std::istream& in, const std::string& name);

}  // namespace kinetri

#endif  // KINETRI_IO_MOTION_LOG_H
