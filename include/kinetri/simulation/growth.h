// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs that grow in a box: the area fraction that they cover, the time at which they cover a given
// fraction, and whether they are jammed.
#ifndef KINETRI_SIMULATION_GROWTH_H
#define KINETRI_SIMULATION_GROWTH_H

#include <cstdint>
#include <optional>
#include <vector>

#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

// `Traits` is Disc_kinetic_traits_2 or Polynomial_disc_kinetic_traits_2.

/// The sum of the areas of the discs at the current time over the area of the box: their area
/// fraction, if they are inside and do not overlap. Rounded. O(n). Precondition: there is a box.
template <class Traits>
double covered_share(const Simulation_2<Traits>& simulation);

/// A time, now or later, at which the area fraction is at least `share`, if the radii grow until
/// then as they do now: proved exactly. It is a few roundings after the first such time, or the
/// current time (rounded up) if the fraction is reached already. None if no radius grows, or if
/// that time is beyond the range of binary64. Radii that shrink must not reach 0 before.
///
/// At each contact growing radii are rounded down (`with_velocity_at`). So call this function again
/// after advancing to its result, and advance further until it returns the current time. O(n),
/// exact arithmetic. Precondition: there is a box, and `share` is positive and finite.
template <class Traits>
std::optional<double> time_of_share(const Simulation_2<Traits>& simulation, double share);

/// Whether a disc that grows as it does now is as wide or as high as the box at `time` or before,
/// exactly: it then has no free area left before `time`, if its boundary circle touches the walls.
/// False without a box. O(n).
template <class Traits>
bool does_disc_fill_box(const Simulation_2<Traits>& simulation, double time);

/// Detects that growing discs are jammed: they have no free area left to grow, between one another
/// or between walls that their boundary circles touch. Speeds and the rate of contacts then go to
/// infinity, with any response that gives discs new motions, and with walls. Non-colliding contacts
/// (Simulation_2::number_of_passes) do not count.
///
/// Discs are jammed if the mean path of a disc between two contacts is less than a quarter of the
/// growth that the mean radius still lacks. In dense packings the path is some three times the
/// growth that closes the gaps, so a twelfth of the missing growth would close them; in runs that
/// reach their end the path is at least 4 times the missing growth.
///
/// This is a heuristic in binary64 that decides only when to give up. It depends on the simulation
/// alone, so it is repeatable. A watch that observes the simulation (Simulation_2::add_observer)
/// also finds which discs are jammed.
class Jam_watch : public Event_observer {
 public:
  /// `mean_radius` is the mean of the radii at the end. If the radii are not to grow to it, discs
  /// are never jammed.
  explicit Jam_watch(double mean_radius) : mean_radius_(mean_radius) {}
  /// A watch of a run that ends at `time`, until which radii grow as they do at each call.
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

  /// The discs that had at least half as many contacts as any other between the last two
  /// measurements, sorted: the jammed ones, once is_jammed() is true. Empty if the watch does not
  /// observe the simulation.
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
  std::optional<double> end_;                     // of the run, if constructed by until()
  std::uint64_t next_ = 0;                        // the number of contacts at the next measurement
  std::uint64_t contacts_ = 0;                    // at the last one
  std::optional<double> time_;                    // of the last one
  std::vector<std::uint64_t> contacts_of_discs_;  // since then
  std::vector<Point_id> jammed_discs_;
};

/// The mean of the radii at a time, if they grow until then as they do now, rounded. O(n).
/// Precondition: there is a disc.
template <class Traits>
double mean_radius(const Simulation_2<Traits>& simulation, double time);

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_GROWTH_H
