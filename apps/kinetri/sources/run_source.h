// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run simulates: points of a file, recorded tracks, or generated points.
#ifndef KINETRI_APPS_RUN_SOURCE_H
#define KINETRI_APPS_RUN_SOURCE_H

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/simulation/box_2.h"
#include "runs/run_settings.h"

namespace kinetri {

enum class Arithmetic;
struct Viewer_settings;

}  // namespace kinetri

namespace kinetri::app {

class Any_simulation;

/// The name of an input in messages. `path` may be "-".
std::string input_name(const std::string& path);

/// The title of a run of points in this file.
std::string title_of(const std::string& path);

/// The source of a run. By default points are named by their ids.
class Run_source {
 public:
  virtual ~Run_source() = default;

  /// The file, or "-"; empty if there is none.
  virtual std::string path() const = 0;

  /// Other files that read() reads.
  virtual std::vector<std::string> other_paths() const { return {}; }

  /// The path, if it is a points file that kinetri-verify can read; else empty.
  virtual std::string points_file() const { return {}; }

  /// A title for users.
  virtual std::string title() const;

  /// Reads the input. Must be called once, before everything below. Throws Input_error, and
  /// Usage_error if options do not fit the input.
  virtual void read() = 0;

  /// Must be called if this run continues the logs of an earlier one. Throws Input_error if files
  /// that the earlier run has written have changed, except those that this run replaces
  /// (`replaced`: Output_file::identity).
  virtual void expect_logs(const std::vector<std::string>& /*replaced*/) {}

  virtual std::size_t number_of_points() const = 0;
  virtual double from() const = 0;

  /// The time at which the run ends; none if --until-share ends it.
  virtual std::optional<double> until() const = 0;

  /// The frame rate of the input, if it consists of frames.
  virtual std::optional<Frame_rate> frame_rate() const { return std::nullopt; }

  /// The part of the plane that pictures have to show, if known.
  virtual std::optional<Box_2> extent() const { return std::nullopt; }

  /// The name of the response to contacts in `named_responses`.
  virtual std::string response() const = 0;

  /// The simulation at from(). Throws Input_error, naming the line.
  virtual Any_simulation make_simulation(Arithmetic arithmetic) const = 0;

  /// The time of the next change that the run has to make by make_change(), after the events that
  /// are due then; none if there is none up to until().
  virtual std::optional<double> next_change() const { return std::nullopt; }

  /// Makes that change. Throws Input_error if the run does not allow it.
  virtual void make_change(const Any_simulation& /*simulation*/) {}

  /// The error for two points that have the same trajectory after a contact or a change of motion.
  virtual Input_error coincidence(const Coincident_trajectories_error& error, double time) const;

  /// The name of the point in the input: its number, or the id of its track.
  virtual std::string name(Point_id id) const { return std::to_string(id); }

  /// The labels of the points by id; empty if the input has no labels.
  virtual std::vector<std::string> labels() const { return {}; }

  /// The points with this name in the input: one, or those of a track; possibly empty. By default
  /// the point with this number, which need not exist.
  virtual std::vector<Point_id> points_named(const std::string& name) const;

  /// A description of valid names, for messages.
  virtual std::string expected_name() const { return "the number of a point"; }

  /// Whether both points may exist at the same time.
  virtual bool are_there_together(Point_id /*a*/, Point_id /*b*/) const { return true; }

  /// The walkable area of the input as Well-Known Text; empty if it has none.
  virtual std::string walkable_area() const { return {}; }

  /// Remarks about the input for the user, a line each.
  virtual std::vector<std::string> remarks() const { return {}; }

  /// The line of the input with the point; 0 if there is none.
  virtual std::size_t line_of(Point_id /*id*/) const { return 0; }

  /// Writes the table of points, if they have names.
  virtual void write_points(std::ostream& /*out*/) const {}

  /// Adds what the page of --html shows about the source.
  virtual void describe(Viewer_settings& settings) const;

 protected:
  Run_source() = default;
  Run_source(const Run_source&) = default;
  Run_source& operator=(const Run_source&) = default;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_SOURCE_H
