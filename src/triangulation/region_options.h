// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options of optimistic parallel execution, and its counters.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_OPTIONS_H
#define KINETRI_SRC_TRIANGULATION_REGION_OPTIONS_H

#include <cstddef>
#include <cstdint>
#include <functional>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

/// Options of a run. The result does not depend on them.
struct Region_options {
  /// Their number is the greatest power of two up to this and up to 128; if 0, it follows from the
  /// number of points.
  std::size_t regions = 0;
  double events_per_vertex = 0.5;  ///< in a window, about; a fifth of it if discs collide
  /// If fewer events are expected, the sequential loop executes them.
  double least_events_per_vertex = 1;
  double events_per_division = 4;  ///< per vertex; after these, regions are chosen again
  /// The greatest overhead of windows, as a share of all events (Region_effort).
  double most_waste = 1.0 / 16;
  /// Windows need at least so many points per hidden point, since the sequential loop executes the
  /// events of hidden points.
  double points_per_hidden_one = 1000;
  /// The most events of a node in a window. It defers further ones; the root truncates the window.
  std::size_t most_flips = std::size_t{1} << 22;
  /// The bits of the version of a face, at most 24 (Flip_numbers). Fewer for tests.
  unsigned version_bits = 24;
  std::size_t flips_per_slice = 4096;  ///< events that one thread sorts. Fewer for tests
  std::size_t threads = 0;             ///< at most; 0: those of oneTBB's arena; 1: no parallelism
  /// If not 0, a seed for the order in which one thread executes tasks. For tests.
  std::uint64_t order_of_tasks = 0;
};

/// The default options with this number of threads.
inline Region_options with_threads(std::size_t threads) {
  Region_options options;
  options.threads = threads;
  return options;
}

/// Calls work(k) for each k below the count: in parallel, or in order if the options name one
/// thread.
void call_for_each_index(const Region_options& options, std::size_t count,
                         const std::function<void(std::size_t)>& work);

/// Calls work(element) for each element of a vector, in the same way.
template <class Vector, class Work>
void call_for_each(const Region_options& options, Vector& elements, const Work& work) {
  call_for_each_index(options, elements.size(), [&](std::size_t k) { work(elements[k]); });
}

/// Counts of a run. "Flips" here are all events, contacts too.
struct Region_counters {
  std::uint64_t windows = 0;            ///< windows executed
  std::uint64_t truncated_windows = 0;  ///< windows that were truncated
  std::uint64_t by_region = 0;  ///< flips that regions executed, including those rolled back later
  std::uint64_t by_union = 0;   ///< flips that unions of regions executed, likewise
  std::uint64_t by_root = 0;    ///< flips that the root executed, likewise
  std::uint64_t rolled_back = 0;  ///< flips rolled back because they were executed too early
  std::uint64_t truncated = 0;    ///< flips rolled back because their window was truncated
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_OPTIONS_H
