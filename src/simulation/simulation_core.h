// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of a simulation. Each owns its state, and uses only parts above it.
#ifndef KINETRI_SRC_SIMULATION_SIMULATION_CORE_H
#define KINETRI_SRC_SIMULATION_SIMULATION_CORE_H

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "kinetri/simulation/simulation_options.h"
#include "simulation/contact_loop.h"
#include "simulation/contact_outcomes.h"
#include "simulation/contact_records.h"
#include "simulation/contact_schedule.h"
#include "simulation/disc_geometry.h"
#include "simulation/overlap_tracker.h"
#include "simulation/simulation_setup.h"

namespace kinetri::detail {

/// | Part | owns | does not know |
/// |---|---|---|
/// | setup | options, masses | points |
/// | triangulation | the motions of points, the present time | discs |
/// | geometry (const) | | the queue |
/// | records | handles and overlaps of each point | positions, times |
/// | schedule | the queue of contacts and changes | why a pair is watched |
/// | tracker | discs that grow from 0 | what a contact does |
/// | outcomes (const) | | the queue |
/// | loop | whether an instant is incomplete | |
template <class Traits>
struct Simulation_core {
  using Types = Simulation_types<Traits>;
  using Triangulation = typename Types::Triangulation;
  using Kinetic_core = typename Types::Kinetic_core;
  using Time = Algebraic_number;

  /// `make` returns the triangulation.
  template <class Make_triangulation>
  Simulation_core(const Traits& traits, const Simulation_options& options,
                  const Make_triangulation& make)
      : setup(traits, options), triangulation(make()) {}
  Simulation_core(const Simulation_core&) = delete;
  Simulation_core& operator=(const Simulation_core&) = delete;

  /// The parts of the triangulation.
  Kinetic_core& kinetic() { return Core_access::core(triangulation); }
  const Kinetic_core& kinetic() const { return Core_access::core(triangulation); }

  /// The discs that overlap that of a point just after the present time, exactly; sorted.
  /// Precondition: there is a response, and the point.
  std::vector<typename Types::Disc> overlapping_discs(Point_id id) const;
  /// In a periodic box, throws Own_image_error if a disc overlaps an image of itself.
  void check_own_images() const;
  /// Finds all overlaps. Precondition: check_own_images.
  void start();
  /// Schedules the contacts of all points. Precondition: all overlaps are recorded; only changes
  /// are scheduled.
  void schedule_all() {
    schedule.schedule_all_singles();
    tracker.schedule_all_pairs();
  }

  /// As Simulation_2::advance_to.
  std::size_t advance_to(const Time& time, const std::function<bool()>& may_go_on);
  /// As Simulation_2::step.
  std::size_t step(const Time* until) {
    join_parts();
    return loop.step(until);
  }
  /// Merges the shards of the queues, into which several threads may have split them.
  void join_parts();

  Contact_counters counters;  ///< except those of the queue
  typename Types::Simulation_setup setup;
  Triangulation triangulation;
  Disc_geometry<Traits> geometry{setup, triangulation};
  typename Types::Contact_records records;
  Contact_schedule<Traits> schedule{geometry, records, kinetic().schedule.division(), counters};
  Overlap_tracker<Traits> tracker{geometry, records, schedule};
  typename Types::Contact_outcomes outcomes{geometry};
  typename Types::Contact_loop loop{kinetic(), setup,   geometry, records,
                                    schedule,  tracker, outcomes, counters};
  std::size_t threads = 1;  ///< that advance_to may use

 private:
  bool may_run_by_regions() const;
  bool can_run_triangulation() const;
  void join_contacts();
};

/// The parts compiled into the library for its own traits.
#define KINETRI_SIMULATION_PARTS(declaration, Traits)           \
  declaration class Simulation_types<Traits>::Simulation_setup; \
  declaration class Simulation_types<Traits>::Contact_schedule; \
  declaration class Simulation_types<Traits>::Contact_outcomes; \
  declaration class Simulation_types<Traits>::Contact_loop;     \
  declaration struct Simulation_core<Traits>
KINETRI_SIMULATION_PARTS(extern template, Linear_kinetic_traits_2);
KINETRI_SIMULATION_PARTS(extern template, Polynomial_kinetic_traits_2);
KINETRI_SIMULATION_PARTS(extern template, Disc_kinetic_traits_2);
KINETRI_SIMULATION_PARTS(extern template, Polynomial_disc_kinetic_traits_2);
KINETRI_SIMULATION_PARTS(extern template, Periodic_kinetic_traits_2);
KINETRI_SIMULATION_PARTS(extern template, Periodic_disc_kinetic_traits_2);

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_SIMULATION_CORE_H
