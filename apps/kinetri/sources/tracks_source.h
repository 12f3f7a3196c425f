// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file of recorded tracks as the source of a run.
#ifndef KINETRI_APPS_TRACKS_SOURCE_H
#define KINETRI_APPS_TRACKS_SOURCE_H

#include <memory>
#include <optional>
#include <string>

#include "kinetri/io/tracks_file.h"
#include "kinetri/triangulation/coincident_points.h"
#include "sources/run_source.h"

namespace kinetri::app {

struct Tracks_settings {
  std::string tracks;                 ///< a path, or "-"
  Tracks_file_options reading;        ///< options for reading the file
  std::optional<double> from;         ///< default: the first observation
  std::optional<double> until;        ///< default: the last one
  std::optional<double> longest_gap;  ///< default: no limit
  Coincident_points coincident = Coincident_points::hide;
  bool logs_contacts = false;    ///< of discs
  std::optional<double> radius;  ///< of all discs, instead of the column of the tracks
};

std::unique_ptr<Run_source> tracks_source(const Tracks_settings& settings);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_TRACKS_SOURCE_H
