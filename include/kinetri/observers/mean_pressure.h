// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pressure of discs that collide in a periodic box, and a thermostat.
#ifndef KINETRI_OBSERVERS_MEAN_PRESSURE_H
#define KINETRI_OBSERVERS_MEAN_PRESSURE_H

#include <cstdint>
#include <memory>

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

namespace detail {
template <PeriodicKineticTraits_2 Traits>
class Pressure_tracker;
}  // namespace detail

/// The kinetic energy now: half the sum of mass times squared speed, rounded. In a periodic box
/// speeds are relative to its flow (Periodic_box_2::flow_at): so it does not matter which image of
/// a point is meant, up to rounding, which grows with the distance from the box. O(n).
template <class Traits>
double kinetic_energy(const Simulation_2<Traits>& simulation);

/// A thermostat: multiplies all velocities by one factor such that kinetic_energy() is `energy`, up
/// to rounding; in a periodic box velocities relative to its flow. Nothing changes if the
/// energy is that already. One call of Simulation_2::set_velocities, which says what is rounded.
/// Long runs in a box that shears, shrinks or grows, and those of growing discs, call it now and
/// then: otherwise their energy changes without bound. (Velocity rescaling: L. V. Woodcock,
/// Isothermal molecular dynamics calculations for liquid salts, Chemical Physics Letters 10, 1971.)
/// Preconditions: `energy` is finite and not negative; kinetic_energy() is positive. O(n), and what
/// set_velocities costs.
template <class Traits>
void set_kinetic_energy(Simulation_2<Traits>& simulation, double energy);

/// The mean pressure over an interval of time. All numbers are rounded.
struct Pressure_2 {
  double from = 0;               ///< the start of the interval
  double until = 0;              ///< its end
  std::uint64_t collisions = 0;  ///< number of contacts, (from, until]
  double energy = 0;             ///< kinetic_energy() at `until`
  /// @{
  /// The components of the pressure tensor, which is symmetric: xy is the momentum along x that
  /// passes in the direction y through a line parallel to x, per unit of length and time.
  double xx = 0;
  double xy = 0;
  double yy = 0;
  /// @}

  /// The pressure: half the trace of the tensor.
  double pressure() const { return (xx + yy) / 2; }
};

/// An observer of discs that collide in a periodic box, which has no wall to measure the pressure
/// at. The tensor is the mean over time of
///
///     (sum of m u u^T over the discs + sum of q r^T over the collisions, per unit of time) / area
///
/// with the mass m and the velocity u of a disc relative to the flow of the box, and, at a
/// collision, the momentum q that the second disc gets from the first one, and the vector r from
/// the center of the first one to that of the image it touches. Source: the virial theorem; for the
/// tensor and for boxes that move D. J. Evans and G. P. Morriss, Statistical Mechanics of
/// Nonequilibrium Liquids, 2008, chapter 3.
///
/// The first sum is integrated over time exactly, up to rounding, in a box of constant area; if the
/// area changes, by Simpson's rule between two changes of a disc's velocity. If no disc grows,
/// elastic collisions (collide_elastically) change the energy only by the work of the box: in a
/// sheared box by -area * rate * xy per unit of time. Of responses that do not conserve momentum q
/// is the mean of the two changes; discs that are erased exchange none. A mass of
/// Simulation_2::set_mass counts from the next change of the disc, or interval, on.
///
/// The observer looks at the triangulation, so one thread executes the events. Cost: O(1) for each
/// event, O(n) for each interval.
template <PeriodicKineticTraits_2 Traits>
class Mean_pressure {
 public:
  /// Observes from the current time on. The simulation must outlive this object.
  explicit Mean_pressure(Simulation_2<Traits>& simulation);
  ~Mean_pressure();

  /// The mean from the end of the last interval, at first the start, to the current time, which is
  /// the end of this one. Precondition: time has advanced between them by more than rounding.
  Pressure_2 next();

 private:
  std::unique_ptr<detail::Pressure_tracker<Traits>> tracker_;
};

extern template class Mean_pressure<Periodic_kinetic_traits_2>;
extern template class Mean_pressure<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_MEAN_PRESSURE_H
