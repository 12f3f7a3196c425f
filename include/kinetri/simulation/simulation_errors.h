// SPDX-License-Identifier: GPL-3.0-or-later
//
// The errors of simulations.
#ifndef KINETRI_SIMULATION_SIMULATION_ERRORS_H
#define KINETRI_SIMULATION_SIMULATION_ERRORS_H

#include <string>
#include <utility>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"

namespace kinetri {

/// A contact that cannot be executed.
class Contact_error : public Error {
 public:
  /// About the contact of the point, with the message that what() gives.
  Contact_error(Point_id point, const std::string& message) : Error(message), point_(point) {}
  /// The point; of two, the one with the smaller id.
  Point_id point() const noexcept { return point_; }

 private:
  Point_id point_;
};

/// Endless contacts: more at one time than allowed; or a resting contact of a point with a wall or
/// another point, which no new velocity separates; or ever more within less time, as those of discs
/// without free area, or with a response that adds energy (Zeno behavior). The last one is
/// estimated from the rate of contacts, which has increased 256 times and more, if they seem to be
/// infinitely many before the end of the call; a second call continues. A restored simulation
/// measures it from then on; in time windows (Simulation_2::set_threads) it is not measured.
///
/// The contact has not been executed and is due at the present time; until then the simulation is
/// as between two events, and so is its snapshot. Other motions of its points may let the run
/// continue.
class Endless_contacts_error : public Contact_error {
 public:
  using Contact_error::Contact_error;
};

/// After a contact, a position, velocity or acceleration is beyond the range of binary64.
class Contact_overflow_error : public Contact_error {
 public:
  using Contact_error::Contact_error;
};

/// A disc in a periodic box overlaps an image of itself, at the start or when it is inserted or
/// gets another motion; or the two have a contact, since the box shrinks or is sheared, or the disc
/// grows. In the second case the contact has not been executed and is due at the present time;
/// until then the simulation is as between two events, and so is its snapshot.
class Own_image_error : public Contact_error {
 public:
  /// About the disc and its image with the offset at the time, with the message that what() gives.
  Own_image_error(Point_id point, Lattice_offset_2 offset, Algebraic_number time,
                  const std::string& message)
      : Contact_error(point, message), offset_(offset), time_(std::move(time)) {}
  /// Of the image.
  Lattice_offset_2 offset() const noexcept { return offset_; }
  /// When, exactly.
  const Algebraic_number& time() const noexcept { return time_; }

 private:
  Lattice_offset_2 offset_;
  Algebraic_number time_;
};

/// Discs overlap at the start, or when one is inserted, and the options refuse that.
class Overlapping_discs_error : public Error {
 public:
  /// About the pairs, with the message that what() gives.
  Overlapping_discs_error(std::vector<Edge_ids> pairs, const std::string& message)
      : Error(message), pairs_(std::move(pairs)) {}
  /// All overlapping pairs, sorted. The id of an inserted point is the one that it would have got.
  const std::vector<Edge_ids>& pairs() const noexcept { return pairs_; }

 private:
  std::vector<Edge_ids> pairs_;
};

/// The radius of a disc is negative at the start, or when it is inserted or gets another motion; or
/// it shrinks, and would be negative after a time that the simulation was to pass.
class Negative_radius_error : public Error {
 public:
  /// About the radius of the point after the time, with the message that what() gives.
  Negative_radius_error(Point_id point, Algebraic_number time, const std::string& message)
      : Error(message), point_(point), time_(std::move(time)) {}
  /// The id that the point has, or would have got.
  Point_id point() const noexcept { return point_; }
  /// The time, exactly: at or just after it the radius is negative.
  const Algebraic_number& time() const noexcept { return time_; }

 private:
  Point_id point_;
  Algebraic_number time_;
};

/// A point is outside of the box at the start, or when it is inserted or given another motion.
class Outside_box_error : public Error {
 public:
  /// About the point, with the message that what() gives.
  Outside_box_error(Point_id point, const std::string& message) : Error(message), point_(point) {}
  /// The id that the point has, or would have got.
  Point_id point() const noexcept { return point_; }

 private:
  Point_id point_;
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_SIMULATION_ERRORS_H
