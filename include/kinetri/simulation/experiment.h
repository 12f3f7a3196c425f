// SPDX-License-Identifier: GPL-3.0-or-later
//
// The experiment of the paper that Kinetri starts from (Computation of Topologic Events in Kinetic
// Delaunay Triangulation using Sturm Sequences of Polynomials, section 6.1): discs in a square box,
// of which a share moves. And the discrete approach of its section 2, which it is compared with: at
// time steps each point that has moved is removed and reinserted.
#ifndef KINETRI_SIMULATION_EXPERIMENT_H
#define KINETRI_SIMULATION_EXPERIMENT_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// The setting; the defaults are the paper's.
struct Experiment_setting {
  std::size_t points = 100;  ///< how many there are
  std::size_t movers = 100;  ///< at most `points`; the others rest until something hits them
  std::uint64_t seed = 1;    ///< of places and velocities
  double side = 100;         ///< of the box [0, side]^2
  double speed = 5;          ///< velocity components are uniform in [-speed, speed)
  double diameter = 1;       ///< of the discs; places are random, so that some may overlap
  double duration = 10;      ///< from the time 0 on
  Collision_response response = swap_velocities;  ///< what discs do that touch
};

/// The points of the setting: random places; the first ones move.
std::vector<Linear_motion_2> experiment_motions(const Experiment_setting& setting);

/// The box and the discs of the setting.
Simulation_options experiment_options(const Experiment_setting& setting);

/// What a run did, and how long it took, construction included.
struct Experiment_result {
  Triangulation_counters events;      ///< what happened
  Contact_counters contacts;          ///< of walls and discs
  Certificate_counters certificates;  ///< of topology and contacts together
  double seconds = 0;                 ///< of wall time
};

/// Runs the experiment once.
Experiment_result run_experiment(const Experiment_setting& setting);

/// A run by the discrete approach beside the kinetic run on the same motion. An *edge change* is
/// one edge removed or added; a flip makes two, an event of the hull one.
struct Discrete_comparison {
  double step = 0;             ///< of time
  double seconds = 0;          ///< of removing and inserting, and of the first triangulation
  double kinetic_seconds = 0;  ///< of the kinetic run
  std::uint64_t topologic_events = 0;  ///< flips and events of the hull
  std::uint64_t edge_changes = 0;      ///< that these and rebuilds make
  /// Of these, those that do not show between one step and the next.
  std::uint64_t edge_changes_missed = 0;
  std::uint64_t contacts = 0;  ///< pairs of discs that come to overlap
  /// Of these, those whose discs do not overlap at any step.
  std::uint64_t contacts_missed = 0;
};

/// Compares the two for each of the time steps. Discs pass through each other here (the response is
/// log_contact), since an overlap is all that the discrete approach can see of a contact.
/// Precondition: each step is greater than 0.
std::vector<Discrete_comparison> compare_with_discrete_steps(const Experiment_setting& setting,
                                                             const std::vector<double>& steps);

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_EXPERIMENT_H
