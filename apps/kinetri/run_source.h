// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run simulates: points of a file, or recorded tracks.
#ifndef KINETRI_APPS_RUN_SOURCE_H
#define KINETRI_APPS_RUN_SOURCE_H

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri::app {

/// The name of an input in messages. `path` is a path, or "-".
inline std::string input_name(const std::string& path) {
  return path == "-" ? "standard input" : path;
}

/// A simulation of one of the kinds of motion.
using Any_simulation = std::variant<std::unique_ptr<Simulation_2<>>,
                                    std::unique_ptr<Simulation_2<Polynomial_kinetic_traits_2>>>;

/// The source of a run.
class Run_source {
 public:
  virtual ~Run_source() = default;

  /// The file, or "-".
  virtual const std::string& path() const = 0;

  /// Reads the input. To be called once, before everything below. Throws Input_error, and
  /// Usage_error where options do not go with what was read.
  virtual void read() = 0;

  virtual std::size_t number_of_points() const = 0;
  virtual double from() const = 0;
  virtual double until() const = 0;

  /// What pictures of the run have to show, where the source knows that.
  virtual std::optional<Box_2> extent() const { return std::nullopt; }

  /// The name of the response to contacts in `named_responses`.
  virtual std::string response() const = 0;

  /// The simulation at from(). Throws Input_error, naming the line.
  virtual Any_simulation make_simulation(Arithmetic arithmetic) const = 0;

  /// What to say of two points that a contact or a turn has left on one trajectory.
  virtual Input_error coincidence(const Coincident_trajectories_error& error,
                                  double time) const = 0;

  /// The point in the words of the input: its number, or the id of its track.
  virtual std::string name(Point_id id) const = 0;

  /// What a user should know of what was read; one line each.
  virtual std::vector<std::string> remarks() const = 0;

  /// A table of the points, for sources whose points have names.
  virtual void write_points(std::ostream& out) const = 0;

 protected:
  Run_source() = default;
  Run_source(const Run_source&) = default;
  Run_source& operator=(const Run_source&) = default;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_SOURCE_H
