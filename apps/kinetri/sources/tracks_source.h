// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file of recorded tracks as the source of a run.
#ifndef KINETRI_APPS_TRACKS_SOURCE_H
#define KINETRI_APPS_TRACKS_SOURCE_H

#include <optional>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "kinetri/simulation/tracks.h"
#include "sources/run_source.h"

namespace kinetri::app {

struct Tracks_settings {
  std::string tracks;  ///< a path, or "-"
  Tracks_format format = Tracks_format::rows;
  double fps = 1;                     ///< for Tracks_format::frames
  std::optional<double> from;         ///< without one, the first observation
  std::optional<double> until;        ///< without one, the last
  std::optional<double> longest_gap;  ///< without one, there is none
  std::optional<double> radius;       ///< of discs whose contacts are logged
};

class Tracks_source final : public Run_source {
 public:
  explicit Tracks_source(Tracks_settings settings) : settings_(std::move(settings)) {}

  std::string path() const override { return settings_.tracks; }
  void read() override;
  std::size_t number_of_points() const override { return stays_.size(); }
  double from() const override { return from_; }
  double until() const override { return until_; }
  /// That of all observations, if there are any.
  std::optional<Box_2> extent() const override { return extent_; }
  std::string response() const override { return settings_.radius ? "log" : "none"; }
  Any_simulation make_simulation(Arithmetic arithmetic) const override;
  Input_error coincidence(const Coincident_trajectories_error& error, double time) const override;
  std::string name(Point_id id) const override { return file_.tracks[stays_[id].track].id; }
  std::vector<std::string> names() const override;
  std::vector<std::string> remarks() const override;
  void write_points(std::ostream& out) const override;

 private:
  void check_velocities() const;

  Tracks_settings settings_;
  Tracks_file file_;
  std::vector<std::vector<Observation_2>> observations_;  // by track
  std::vector<Stay> stays_;                               // by point id
  double from_ = 0;
  double until_ = 0;
  std::optional<Box_2> extent_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_TRACKS_SOURCE_H
