// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs that grow in a box: the share of it that they cover, the time at which they cover a given
// one, and whether they are jammed.
#ifndef KINETRI_SIMULATION_GROWTH_H
#define KINETRI_SIMULATION_GROWTH_H

#include <cstdint>
#include <optional>
#include <vector>

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

/// Whether a disc that grows as it does now is as wide or as high as the box at `time` or before,
/// exactly: then it has no room left before `time`, if its rim touches the walls. False without a
/// box. O(n).
template <class Traits>
bool does_disc_fill_box(const Simulation_2<Traits>& simulation, double time);

/// Notices that discs which grow are jammed: that they have no room left to grow, between one
/// another or between walls that their rims touch. They never stop: speeds and the rate of contacts
/// go to infinity as the room goes to 0. That does not depend on the response: it is enough that
/// contacts give discs new motions, as those with walls do. Contacts at which both discs keep their
/// motions (Simulation_2::number_of_passes) do not count.
///
/// The watch compares the mean path of a disc between two contacts with what the mean radius has
/// still to grow, and calls the discs jammed where the path is less than a quarter of that. In
/// dense packings the path is some three times the growth that closes the gaps, so that a twelfth
/// of what is to come would close them; in runs that reach their end it is longer than what is to
/// come by a factor of 4 and more.
///
/// This is a rule for giving up, computed in doubles; it decides nothing else. It depends on
/// nothing but the simulation, so it is repeatable. A watch that observes the simulation
/// (Simulation_2::add_observer) can say which discs are jammed.
class Jam_watch : public Event_observer {
 public:
  /// `mean_radius`: what the radii are to be at the end, on average. A watch for discs that do not
  /// grow to it is never alarmed.
  explicit Jam_watch(double mean_radius) : mean_radius_(mean_radius) {}
  /// A watch of a run that ends at `time`: the discs that grow are to do so until then, each as at
  /// the time of a look.
  static Jam_watch until(double time) {
    Jam_watch result(0);
    result.end_ = time;
    return result;
  }

  /// Whether the discs are jammed; to be called after each step. O(1) for most calls, O(n) for one
  /// after 32 contacts of each disc, on average, and after at least 10 000 contacts.
  template <class Traits>
  bool is_jammed(const Simulation_2<Traits>& simulation) {
    const auto& events = simulation.triangulation().counters().events;
    const std::uint64_t contacts = events[static_cast<std::size_t>(Event_kind::collision)] +
                                   events[static_cast<std::size_t>(Event_kind::wall)] -
                                   simulation.number_of_passes();
    return contacts >= next_ && look(simulation, contacts);
  }

  /// The discs that had at least half as many contacts as any other between the last two looks,
  /// sorted: once the watch is alarmed, those that are jammed. Empty if it is no observer of the
  /// simulation.
  const std::vector<Point_id>& jammed_discs() const noexcept { return jammed_discs_; }

  bool looks_at_triangulation() const override { return false; }
  void after_event(const Event& event) override;

 private:
  template <class Traits>
  bool look(const Simulation_2<Traits>& simulation, std::uint64_t contacts);
  template <class Traits>
  double growth_to_come(const Simulation_2<Traits>& simulation) const;
  void find_jammed_discs();

  double mean_radius_;
  std::optional<double> end_;   // of the run, if the mean radius is to be that of then
  std::uint64_t next_ = 0;      // the number of contacts at the next look
  std::uint64_t contacts_ = 0;  // at the last one
  std::optional<double> time_;  // of the last one
  std::vector<std::uint64_t> contacts_of_discs_;  // since then
  std::vector<Point_id> jammed_discs_;
};

/// The mean of the radii at a time, if they grow until then as they do now, rounded. O(n).
/// Precondition: there is a disc.
template <class Traits>
double mean_radius(const Simulation_2<Traits>& simulation, double time);

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_GROWTH_H
