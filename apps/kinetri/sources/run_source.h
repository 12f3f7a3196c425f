// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run simulates: points of a file, recorded tracks, or points that the program makes.
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

/// The name of an input in messages. `path` is a path, or "-".
std::string input_name(const std::string& path);

/// The source of a run. By default its points are called by their ids.
class Run_source {
 public:
  virtual ~Run_source() = default;

  /// The file, or "-"; empty if there is none.
  virtual std::string path() const = 0;

  /// The file, if it has the points at the start: x, y, vx, vy, ... Else empty.
  virtual std::string points_file() const { return {}; }

  /// What it is, for people.
  virtual std::string title() const;

  /// Reads the input. To be called once, before everything below. Throws Input_error, and
  /// Usage_error where options do not go with what was read.
  virtual void read() = 0;

  /// To be called if the run continues the event log of the one that the source takes up. Throws
  /// Input_error if files which that one has written are not as it left them. Those that are
  /// `replaced` by this run (Output_file::identity) do not matter.
  virtual void expect_logs(const std::vector<std::string>& /*replaced*/) {}

  virtual std::size_t number_of_points() const = 0;
  virtual double from() const = 0;

  /// The time at which the run ends; none if a share that the discs cover ends it.
  virtual std::optional<double> until() const = 0;

  /// The rate of the frames that the input consists of, if it has any.
  virtual std::optional<Frame_rate> frame_rate() const { return std::nullopt; }

  /// What pictures of the run have to show, where the source knows that.
  virtual std::optional<Box_2> extent() const { return std::nullopt; }

  /// The name of the response to contacts in `named_responses`.
  virtual std::string response() const = 0;

  /// The simulation at from(). Throws Input_error, naming the line.
  virtual Any_simulation make_simulation(Arithmetic arithmetic) const = 0;

  /// What to say of two points that a contact or a change of motion has left on one trajectory.
  virtual Input_error coincidence(const Coincident_trajectories_error& error, double time) const;

  /// The point in the words of the input: its number, or the id of its track.
  virtual std::string name(Point_id id) const { return std::to_string(id); }

  /// The labels of the points, by id, if the input has labels; else empty.
  virtual std::vector<std::string> labels() const { return {}; }

  /// The points that the input calls by that name: one, or those of a track. None if there are
  /// none. By default the point of that number, which need not exist.
  virtual std::vector<Point_id> points_named(const std::string& name) const;

  /// What names are, for messages.
  virtual std::string expected_name() const { return "the number of a point"; }

  /// Whether there is a time at which both points may be there.
  virtual bool are_there_together(Point_id /*a*/, Point_id /*b*/) const { return true; }

  /// Where points can be, as Well-Known Text, if the input has that; else empty.
  virtual std::string walkable_area() const { return {}; }

  /// What a user should know of what was read; one line each.
  virtual std::vector<std::string> remarks() const { return {}; }

  /// The line of the input that a point comes from; 0 where there is none.
  virtual std::size_t line_of(Point_id /*id*/) const { return 0; }

  /// A table of the points, for sources whose points have names.
  virtual void write_points(std::ostream& /*out*/) const {}

  /// Adds what the page of --html says of the source.
  virtual void describe(Viewer_settings& settings) const;

 protected:
  Run_source() = default;
  Run_source(const Run_source&) = default;
  Run_source& operator=(const Run_source&) = default;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_SOURCE_H
