// SPDX-License-Identifier: GPL-3.0-or-later
//
// The logs of a run as the source of a run: the points that it began with, and the changes that
// were made of them while it ran.
#ifndef KINETRI_APPS_REPLAY_SOURCE_H
#define KINETRI_APPS_REPLAY_SOURCE_H

#include <memory>
#include <string>

#include "sources/points_source.h"
#include "sources/run_source.h"

namespace kinetri::app {

/// `settings.points` is a motion log, and `events` the event log of the same run, which `settings`
/// has the start, the box and the response of; radii are those of the motion log. Changes that are
/// no contacts are made as the logs say. So are those of elastic collisions, since no log has
/// masses. With a periodic box the run is one in that box.
std::unique_ptr<Run_source> replay_source(const Points_settings& settings,
                                          const std::string& events);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_REPLAY_SOURCE_H
