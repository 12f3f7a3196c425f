// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exceptions of the library. Every exception that it throws on purpose derives from
// kinetri::Error.
#ifndef KINETRI_BASE_ERROR_H
#define KINETRI_BASE_ERROR_H

#include <cstddef>
#include <stdexcept>
#include <string>

#include "kinetri/base/ids.h"

namespace kinetri {

/// Base of every exception that Kinetri throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller broke a stated precondition (see KINETRI_PRECONDITION).
class Precondition_error : public Error {
 public:
  using Error::Error;
};

/// An internal invariant does not hold: a bug in Kinetri, never the user's fault.
class Internal_error : public Error {
 public:
  using Error::Error;
};

/// Input data that cannot be used. `what()` reads `FILE:LINE: what is wrong; what was expected`;
/// the line is left out if it has no meaning (line 0).
class Input_error : public Error {
 public:
  /// Makes that message. Lines count from 1.
  Input_error(const std::string& file, std::size_t line, const std::string& message)
      : Error(line == 0 ? file + ": " + message
                        : file + ":" + std::to_string(line) + ": " + message) {}
};

/// A file cannot be written. `what()` reads `FILE: what is wrong, what was expected`.
class Output_error : public Error {
 public:
  using Error::Error;
};

/// A snapshot that is not the state of any triangulation or simulation.
class Snapshot_error : public Error {
 public:
  using Error::Error;
};

/// Two points would have the same trajectory (and, with weights, the same weight): no triangulation
/// has both as vertices. Thrown if such points are refused (Coincident_points).
class Coincident_trajectories_error : public Error {
 public:
  /// Of the points with these ids, which the message names.
  Coincident_trajectories_error(Point_id first, Point_id second)
      : Error("points " + std::to_string(first) + " and " + std::to_string(second) +
              " are at the same place with the same velocity; expected distinct trajectories: "
              "remove one of them or change its motion"),
        first_(first),
        second_(second) {}

  /// @{
  /// The ids, as given to the constructor.
  Point_id first() const noexcept { return first_; }
  Point_id second() const noexcept { return second_; }
  /// @}

 private:
  Point_id first_;
  Point_id second_;
};

}  // namespace kinetri

#endif  // KINETRI_BASE_ERROR_H
