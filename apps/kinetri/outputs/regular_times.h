// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regular times in a run, each rounded from its exact value, so that they do not depend on how they
// are computed.
#ifndef KINETRI_APPS_REGULAR_TIMES_H
#define KINETRI_APPS_REGULAR_TIMES_H

#include <cstddef>
#include <optional>
#include <vector>

namespace kinetri::app {

/// The times from + k / per_time, k = 0, 1, ..., rounded, up to `until`; none if there are more
/// than `most`. If several round to one number, it occurs once. Precondition: from <= until are
/// finite, per_time > 0.
std::optional<std::vector<double>> regular_times(double from, double until, double per_time,
                                                 std::size_t most);

/// The times k / per_time, for whole numbers k of either sign, rounded, from `from` up to `until`;
/// else as regular_times.
std::optional<std::vector<double>> multiples(double from, double until, double per_time,
                                             std::size_t most);

/// The ends of `intervals` intervals of equal length from `from` to `until`, rounded, each number
/// once. Precondition: from <= until are finite, intervals > 0.
std::vector<double> evenly_spaced_times(double from, double until, std::size_t intervals);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_REGULAR_TIMES_H
