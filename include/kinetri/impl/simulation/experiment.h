// SPDX-License-Identifier: GPL-3.0-or-later
//
// The experiment of the paper that Kinetri starts from (Computation of Topologic Events in Kinetic
// Delaunay Triangulation using Sturm Sequences of Polynomials, section 6.1): discs in a square box,
// some of which move. It is compared with the discrete approach of section 2: at each time step
// every point that has moved is removed and inserted again.
#ifndef KINETRI_IMPL_SIMULATION_EXPERIMENT_H
#define KINETRI_IMPL_SIMULATION_EXPERIMENT_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// The setting; the defaults are the paper's.
struct Experiment_setting {
  std::size_t points = 100;  ///< number of points
  std::size_t movers = 100;  ///< number of moving points, at most `points`; the others rest
  std::uint64_t seed = 1;    ///< of the random positions and velocities
  double side = 100;         ///< side of the box [0, side]^2
  double speed = 5;          ///< velocity components are uniform in [-speed, speed)
  double diameter = 1;       ///< of the discs; random positions, so some discs may overlap
  double size_ratio = 1;     ///< diameter of the discs of odd ids over `diameter`: 1 or more
  double duration = 10;      ///< the run is from time 0 to this time
  Collision_response response = swap_velocities;  ///< response to contacts of discs

  /// Whether there are discs of two sizes.
  bool has_sizes() const { return size_ratio != 1; }
  /// The area fraction that the discs cover if they do not overlap, rounded.
  double covered_share() const;
};

/// The greatest area fraction that discs of two sizes may cover.
inline constexpr double greatest_covered_share = 0.25;

/// The points of the setting, at random positions; the first `movers` of them move. Discs of one
/// size may overlap. Precondition: movers <= points.
std::vector<Linear_motion_2> experiment_motions(const Experiment_setting& setting);

/// The same with their radii. No two overlap: a disc that would overlap one of those before it, or
/// a larger one, gets another random position. Preconditions: movers <= points; size_ratio >= 1;
/// the area fraction is at most `greatest_covered_share`.
std::vector<Disc_motion_2> experiment_discs(const Experiment_setting& setting);

/// The box and the discs of the setting: for experiment_discs if there are discs of two sizes, and
/// else for experiment_motions.
Simulation_options experiment_options(const Experiment_setting& setting);

/// The counts of a run, and its duration including construction.
struct Experiment_result {
  Triangulation_counters events;      ///< of the triangulation
  Contact_counters contacts;          ///< of walls and discs
  Certificate_counters certificates;  ///< of topology and contacts together
  double seconds = 0;                 ///< wall-clock time
};

/// Runs the experiment once, with experiment_discs if there are discs of two sizes. Preconditions
/// as for these.
Experiment_result run_experiment(const Experiment_setting& setting);

/// A run of the discrete approach compared with the kinetic run on the same motions. An *edge
/// change* is one edge removed or added: two for a flip, one for a hull event.
struct Discrete_comparison {
  double step = 0;                     ///< time step
  double seconds = 0;                  ///< of the discrete approach, with its first triangulation
  double kinetic_seconds = 0;          ///< of the kinetic run
  std::uint64_t topologic_events = 0;  ///< flips, hull events, and discs hidden and revealed
  std::uint64_t edge_changes = 0;      ///< edges removed or added by these events and by rebuilds
  /// Edge changes that are not visible between two successive steps.
  std::uint64_t edge_changes_missed = 0;
  std::uint64_t contacts = 0;  ///< pairs of discs that begin to overlap
  /// Contacts that are not visible at any step: the discs never overlap there and, if their sizes
  /// differ, have an edge.
  std::uint64_t contacts_missed = 0;
};

/// Compares the two approaches for each of the time steps. Discs pass through each other (the
/// response is log_contact), because the discrete approach sees contacts only as overlaps.
/// Precondition: each step is greater than 0.
std::vector<Discrete_comparison> compare_with_discrete_steps(const Experiment_setting& setting,
                                                             const std::vector<double>& steps);

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_EXPERIMENT_H
