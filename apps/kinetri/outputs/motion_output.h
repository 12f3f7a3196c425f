// SPDX-License-Identifier: GPL-3.0-or-later
//
// The motion log of a simulation of any kind of motion.
#ifndef KINETRI_APPS_MOTION_OUTPUT_H
#define KINETRI_APPS_MOTION_OUTPUT_H

#include <iosfwd>
#include <memory>

#include "kinetri/events/event.h"
#include "sources/any_simulation.h"

namespace kinetri::app {

/// Writes the present motions, and from now on each change; see Motion_log_writer. `out` and the
/// result must exist as long as the simulation runs.
std::unique_ptr<Event_observer> follow_motions(std::ostream& out, const Any_simulation& simulation);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_MOTION_OUTPUT_H
