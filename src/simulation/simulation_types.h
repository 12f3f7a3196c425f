// SPDX-License-Identifier: GPL-3.0-or-later
//
// The common types of the parts of a simulation.
#ifndef KINETRI_SRC_SIMULATION_SIMULATION_TYPES_H
#define KINETRI_SRC_SIMULATION_SIMULATION_TYPES_H

#include <optional>
#include <type_traits>

#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"
#include "simulation/contact_records.h"

namespace kinetri::detail {

template <class Traits>
struct Simulation_core;

/// The types of the traits and of the triangulation, and the parts of a simulation.
template <class Traits>
struct Simulation_types {
  using Triangulation = Kinetic_triangulation_2<Traits>;
  using Kinetic_core = detail::Kinetic_core<Traits>;
  using Motion = typename Traits::Motion;
  using Point_2 = typename Traits::Point_2;
  using Change = Point_change<Motion>;
  using Time = Algebraic_number;

  /// Whether discs have radii of their own.
  static constexpr bool has_radii = HasWeight<Motion>;
  /// Whether points are in a periodic box.
  static constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;

  /// How one disc names another, and what names two (image_names.h).
  using Disc = std::conditional_t<is_periodic, Periodic_image, Point_id>;
  using Pair = typename Kinetic_types<Traits>::Edge_name;
  /// What certificates of contacts take: in the plane, the point.
  using Image_2 = typename Kinetic_types<Traits>::Image_2;

  using Contact_entry = Basic_contact_entry<Disc>;
  using Contact_subject = Basic_contact_subject<Disc>;
  using Contact_record = Basic_contact_record<Disc>;
  using Contact_records = Basic_contact_records<Disc>;
  using Disc_overlap = Basic_disc_overlap<Disc>;
  using Edge_trail = Basic_edge_trail<Pair>;
  using Entry = Contact_entry;
  using Subject = Contact_subject;

  /// A scheduled change that has left the queue, with its new motion.
  struct Due_change {
    Entry entry;
    std::optional<Motion> motion;
  };

  // The parts, each in the header of its name. Each uses only those above it.
  class Simulation_setup;
  class Disc_geometry;
  class Contact_schedule;
  class Overlap_tracker;
  class Contact_outcomes;
  class Contact_loop;
  class Simulation_auditor;

  using Simulation_core = detail::Simulation_core<Traits>;  ///< all of them
};

// The parts that others use.
template <class Traits>
using Disc_geometry = typename Simulation_types<Traits>::Disc_geometry;
template <class Traits>
using Contact_schedule = typename Simulation_types<Traits>::Contact_schedule;
template <class Traits>
using Overlap_tracker = typename Simulation_types<Traits>::Overlap_tracker;

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_SIMULATION_TYPES_H
