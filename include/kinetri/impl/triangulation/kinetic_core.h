// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of a kinetic triangulation (docs/ARCHITECTURE.md).
#ifndef KINETRI_IMPL_TRIANGULATION_KINETIC_CORE_H
#define KINETRI_IMPL_TRIANGULATION_KINETIC_CORE_H

#include <cstddef>
#include <functional>
#include <span>

#include "kinetri/impl/triangulation/certification.h"
#include "kinetri/impl/triangulation/event_loop.h"
#include "kinetri/impl/triangulation/event_reporter.h"
#include "kinetri/impl/triangulation/point_changes.h"
#include "kinetri/impl/triangulation/schedule.h"
#include "kinetri/impl/triangulation/topology.h"
#include "kinetri/impl/triangulation/updates.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/triangulation/triangulation_counters.h"

namespace kinetri::detail {

/// The parts. A part uses those declared before it; Point_changes uses all.
template <class Traits>
struct Kinetic_types<Traits>::Kinetic_core {
  Kinetic_core(const Traits& traits, const Time& start)
      : topology({start, Time_side::after}),
        certification(traits, topology),
        schedule(certification, start, counters),
        reporter(topology, schedule, counters),
        updates(topology, certification, schedule, reporter),
        loop(topology, certification, schedule, reporter, updates),
        changes(*this) {}
  Kinetic_core(const Kinetic_core&) = delete;
  Kinetic_core& operator=(const Kinetic_core&) = delete;

  /// Makes the triangulation of the points, whose ids are less than `ids`, and its queue.
  void start_with(std::span<const Point_2> points, std::size_t ids);

  /// Executes the events up to `time`, on several threads if that may be faster; see
  /// Event_loop::run_to.
  std::size_t advance_to(const Time& time, const std::function<bool()>& may_go_on);
  /// Merges the parts of the queue that an execution on several threads has left, so that single
  /// events cost less.
  void join_parts();

  Triangulation_counters counters;
  Topology topology;
  Certification certification;
  Schedule schedule;
  Event_reporter reporter;
  Updates updates;
  Event_loop loop;
  Point_changes changes;
  Construction_seconds construction_seconds;
  std::size_t threads = 1;  ///< for advance_to; 0: those of oneTBB's arena
};

// Execution of events on several threads (docs/PARALLEL.md), for the library's own traits.

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

/// The parts that the library compiles for its own traits, in the plane and in periodic boxes.
#define KINETRI_PARTS_OF_ANY_SPACE(declaration, Traits)                                      \
  declaration class Kinetic_types<Traits>::Schedule::Policy;                                 \
  declaration class Divided_scheduler<Kinetic_types<Traits>::Entry,                          \
                                      Kinetic_types<Traits>::Schedule::Policy>;              \
  declaration const Algebraic_number& Kinetic_types<Traits>::Schedule::current_time() const; \
  declaration bool Kinetic_types<Traits>::Schedule::settle(const Algebraic_number*);         \
  declaration void Kinetic_types<Traits>::Schedule::schedule_all();                          \
  declaration class Kinetic_types<Traits>::Event_reporter;                                   \
  declaration class Kinetic_types<Traits>::Event_loop;                                       \
  declaration class Kinetic_types<Traits>::Change_planner;                                   \
  declaration class Kinetic_types<Traits>::Point_changes;                                    \
  declaration struct Kinetic_types<Traits>::Kinetic_core
/// In the plane; not all members of the first two are for periodic boxes.
#define KINETRI_KINETIC_PARTS(declaration, Traits)       \
  declaration class Kinetic_types<Traits>::Own_topology; \
  declaration class Kinetic_types<Traits>::Decisions;    \
  KINETRI_PARTS_OF_ANY_SPACE(declaration, Traits)
KINETRI_KINETIC_PARTS(extern template, Linear_kinetic_traits_2);
KINETRI_KINETIC_PARTS(extern template, Polynomial_kinetic_traits_2);
KINETRI_KINETIC_PARTS(extern template, Disc_kinetic_traits_2);
KINETRI_KINETIC_PARTS(extern template, Polynomial_disc_kinetic_traits_2);
KINETRI_PARTS_OF_ANY_SPACE(extern template, Periodic_kinetic_traits_2);
KINETRI_PARTS_OF_ANY_SPACE(extern template, Periodic_disc_kinetic_traits_2);

/// Access to the parts of a triangulation, for audits, queries and simulations.
struct Core_access {
  template <class KineticTriangulation>
  static auto& core(KineticTriangulation& kinetic) {
    return kinetic.core_;
  }
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_KINETIC_CORE_H
