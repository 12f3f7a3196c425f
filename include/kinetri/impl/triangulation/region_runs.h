// SPDX-License-Identifier: GPL-3.0-or-later
//
// Execution of events on several threads, as its callers see it (docs/PARALLEL.md). Defined in
// src/triangulation/regions.cpp for the library's own traits.
#ifndef KINETRI_IMPL_TRIANGULATION_REGION_RUNS_H
#define KINETRI_IMPL_TRIANGULATION_REGION_RUNS_H

#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>

#include "kinetri/impl/triangulation/kinetic_core.h"

namespace kinetri::detail {

/// Whether several threads can execute the events of these traits.
template <class Traits>
inline constexpr bool has_region_runs = std::is_same_v<Traits, Linear_kinetic_traits_2> ||
                                        std::is_same_v<Traits, Polynomial_kinetic_traits_2> ||
                                        std::is_same_v<Traits, Disc_kinetic_traits_2> ||
                                        std::is_same_v<Traits, Polynomial_disc_kinetic_traits_2>;

/// Whether `threads` threads (0: those of oneTBB's arena), as far as oneTBB allows them, may be
/// faster than the sequential loop for so many points.
bool may_pay_by_regions(std::size_t points, std::size_t threads);

/// The functions that a triangulation calls, with its number of threads.
template <class Traits>
struct Region_runs {
  using Core = Kinetic_core<Traits>;  ///< of the triangulation

  /// As advance_to of the triangulation, with the same result; see Region_run::advance_to.
  static std::size_t advance_to(Core& core, const Algebraic_number& until,
                                const std::function<bool()>& may_go_on);
  /// Gives points new motions at the present time. Precondition: the queue is in parts, the
  /// triangles stay embedded, and points have no weights.
  static void change_in_place(Core& core,
                              std::span<const typename Kinetic_types<Traits>::Change> changes);
  /// Merges the parts of the queue.
  static void join(Core& core);
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_REGION_RUNS_H
