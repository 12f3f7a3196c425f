// SPDX-License-Identifier: GPL-3.0-or-later
//
// The times of the frames of a run.
#ifndef KINETRI_APPS_FRAME_TIMES_H
#define KINETRI_APPS_FRAME_TIMES_H

#include <optional>
#include <vector>

#include "runs/run_settings.h"

namespace kinetri::app {

/// From `from` on up to `until`, at the rate; without one, 101 times. Throws Usage_error if they
/// are too many.
std::vector<double> frame_times(double from, double until, const std::optional<Frame_rate>& rate);

/// The times of the frames 0, 1, 2 and so on of an input, and -1, -2 and so on, that are neither
/// before `from` nor after `until`: each is the frame divided by the rate, rounded, as it is where
/// the input is read. Throws Usage_error if they are too many.
std::vector<double> times_of_input(double from, double until, const Frame_rate& rate);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_FRAME_TIMES_H
