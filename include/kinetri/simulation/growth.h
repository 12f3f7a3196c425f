// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs that grow in a box: the share of it that they cover, the time at which they cover a given
// one, and whether they are jammed.
#ifndef KINETRI_SIMULATION_GROWTH_H
#define KINETRI_SIMULATION_GROWTH_H

#include <cstdint>
#include <optional>

#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

// `Traits` is Disc_kinetic_traits_2 or Polynomial_disc_kinetic_traits_2.

/// The areas of the discs at the current time, over that of the box: the share of the box that they
/// cover, if they are inside and do not overlap. Rounded. O(n). Precondition: there is a box.
template <class Traits>
double covered_share(const Simulation_2<Traits>& simulation);

/// A time, now or later, at which the areas of the discs are at least `share` times that of the
/// box, if the radii grow until then as they do now: proved exactly. It is a few roundings after
/// the first such time, and the current time (rounded up) if it is already so. None if no radius
/// grows, or that time is beyond the range of binary64. Radii that shrink must not get to 0 before.
///
/// At each contact radii that grow are rounded down (`with_velocity_at`). So a simulation that has
/// advanced to this time may have to advance a little further: to the time that this function gives
/// then. It is there where it gives the current time. O(n), exact arithmetic. Precondition: there
/// is a box, and the share is positive and finite.
template <class Traits>
std::optional<double> time_of_share(const Simulation_2<Traits>& simulation, double share);

/// Notices that discs which grow and collide elastically are jammed: that they have no room left to
/// grow. They never stop: speeds and the rate of contacts go to infinity as the room goes to 0. So
/// the watch compares the mean path of a disc between two contacts with what the mean radius has
/// still to grow, and calls the discs jammed where the path is less than a quarter of that. In
/// dense packings the path is some three times the growth that closes the gaps, so that a twelfth
/// of what is to come would close them; in runs that reach their end it is longer than what is to
/// come by a factor of 4 and more.
///
/// This is a rule for giving up, computed in doubles; it decides nothing else. It depends on
/// nothing but the simulation, so it is repeatable.
class Jam_watch {
 public:
  /// `mean_radius`: what the radii are to be at the end, on average. A watch for discs that do not
  /// grow to it is never alarmed.
  explicit Jam_watch(double mean_radius) : mean_radius_(mean_radius) {}

  /// Whether the discs are jammed; to be called after each step. O(1) for most calls, O(n) for one
  /// after 32 contacts of each disc, on average, and after at least 10 000 contacts.
  template <class Traits>
  bool is_jammed(const Simulation_2<Traits>& simulation) {
    const auto& events = simulation.triangulation().counters().events;
    const std::uint64_t contacts = events[static_cast<std::size_t>(Event_kind::collision)] +
                                   events[static_cast<std::size_t>(Event_kind::wall)];
    return contacts >= next_ && look(simulation, contacts);
  }

 private:
  template <class Traits>
  bool look(const Simulation_2<Traits>& simulation, std::uint64_t contacts);

  double mean_radius_;
  std::uint64_t next_ = 0;      // the number of contacts at the next look
  std::uint64_t contacts_ = 0;  // at the last one
  std::optional<double> time_;  // of the last one
};

/// The mean of the radii at a time, if they grow until then as they do now, rounded. O(n).
/// Precondition: there is a disc.
template <class Traits>
double mean_radius(const Simulation_2<Traits>& simulation, double time);

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_GROWTH_H
