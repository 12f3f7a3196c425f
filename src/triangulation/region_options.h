// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the events of windows of time are executed by several threads, and counts of what has been
// done.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_OPTIONS_H
#define KINETRI_SRC_TRIANGULATION_REGION_OPTIONS_H

#include <cstddef>
#include <cstdint>
#include <functional>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

/// How a run by regions is made. The result does not depend on it.
struct Region_options {
  /// How many: the greatest power of two up to this and to 128; by the number of points if 0.
  std::size_t regions = 0;
  double events_per_vertex = 0.5;  ///< in a window, about; a fifth of it where discs collide
  /// With fewer events to come, as it seems, the sequential loop executes them.
  double least_events_per_vertex = 1;
  double events_per_division = 4;  ///< a vertex, after which regions are made anew
  /// The share of all events that windows may cost more than the sequential loop; see
  /// Region_effort.
  double most_waste = 1.0 / 16;
  /// Of how many points at most one is hidden. What happens to those is left to the sequential
  /// loop.
  double points_per_hidden_one = 1000;
  /// Of a node in a window. It leaves what is more to the node above it; the root truncates the
  /// window.
  std::size_t most_flips = std::size_t{1} << 22;
  /// Of the versions of faces: a face has room for 24 (Flip_numbers). Fewer for tests.
  unsigned stamp_bits = 24;
  std::size_t flips_per_slice = 4096;  ///< that one thread puts in order. Fewer for tests
  std::size_t threads = 0;  ///< at most; 0: those of oneTBB's arena; 1: one region after the other
  /// If not 0, the order in which one thread takes regions and other tasks: another one for each
  /// number. For tests.
  std::uint64_t order_of_tasks = 0;
};

/// The options of a run with so many threads.
inline Region_options with_threads(std::size_t threads) {
  Region_options options;
  options.threads = threads;
  return options;
}

/// Calls work(k) for each k below the count, as the options say: in parallel, or one after the
/// other.
void call_for_each_index(const Region_options& options, std::size_t count,
                         const std::function<void(std::size_t)>& work);

/// Calls work(element) for each element of a vector, in the same way.
template <class Vector, class Work>
void call_for_each(const Region_options& options, Vector& elements, const Work& work) {
  call_for_each_index(options, elements.size(), [&](std::size_t k) { work(elements[k]); });
}

/// What a run by regions has done. Contacts are counted as flips.
struct Region_counters {
  std::uint64_t windows = 0;    ///< of time
  std::uint64_t cuts = 0;       ///< windows that were truncated
  std::uint64_t by_region = 0;  ///< flips that regions executed, those rolled back included
  std::uint64_t by_union = 0;   ///< flips that unions of regions executed, the same
  std::uint64_t by_rest = 0;    ///< flips that the root executed, the same
  std::uint64_t undone = 0;     ///< flips that were rolled back since they came too early
  std::uint64_t cut_off = 0;    ///< flips that were rolled back since their window was truncated
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_OPTIONS_H
