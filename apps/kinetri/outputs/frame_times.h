// SPDX-License-Identifier: GPL-3.0-or-later
//
// The times of the frames of a run.
#ifndef KINETRI_APPS_FRAME_TIMES_H
#define KINETRI_APPS_FRAME_TIMES_H

#include <optional>
#include <vector>

#include "runs/run_settings.h"

namespace kinetri::app {

/// The times from `from` to `until` at the rate; without one, 101 times. Throws Usage_error if
/// there are too many.
std::vector<double> frame_times(double from, double until, const std::optional<Frame_rate>& rate);

/// The times from `from` to `until` of frames of an input, whose numbers may be negative: each is
/// the number divided by the rate, rounded as when the input is read. Throws Usage_error if there
/// are too many.
std::vector<double> times_of_input(double from, double until, const Frame_rate& rate);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_FRAME_TIMES_H
