// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closest approaches of points or discs, over a run, in the plane and in periodic boxes.
#ifndef KINETRI_OBSERVERS_CLOSEST_APPROACHES_H
#define KINETRI_OBSERVERS_CLOSEST_APPROACHES_H

#include <concepts>
#include <cstddef>
#include <memory>
#include <vector>

#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// The closest approach of two points: the least gap between the boundary circles of their discs.
/// The gap is the distance of the centers minus both radii; it is negative if the discs overlap.
struct Approach {
  Edge_ids points = {no_point, no_point};  ///< the ids, the smaller first
  Algebraic_number time;  ///< exact; rational if no motion changes at it and no radius grows
  /// The distance of the centers at that time, rounded to the nearest binary64 number, ties to
  /// even; infinite on overflow.
  double distance = 0;
  double gap = 0;  ///< the gap at that time, rounded in the same way; of points, the distance
  /// In a periodic box, `points` and this are a Periodic_edge: the approach is that of the first
  /// point and this image of the second one. Else zero.
  Lattice_offset_2 offset = {};
};

/// Traits of points, or discs, whose velocities are constant between events.
template <class Traits>
concept HasLinearMotion = SimulationKineticTraits_2<Traits> &&
    std::same_as<Center_motion_of<typename Traits::Motion>, Linear_motion_2>;

namespace detail {
template <HasLinearMotion Traits>
class Approach_tracker;
}  // namespace detail

/// An observer of a simulation that keeps the `number` pairs with the least gaps while they were
/// neighbors in the triangulation or their discs overlapped or touched, and for each pair the first
/// time of its least gap. Discs have the radius of the options, or radii of their own, which may
/// differ and grow; without radii the gap is the distance. A point that coincides with others for a
/// while is a neighbor of the one that hides it. A point that is erased and one that is inserted at
/// the same time are a pair at that time. Of several changes of a point at one time only the last
/// counts, unless this object is called in between.
///
/// The first of the result is the closest approach of all pairs. For discs of one radius, and
/// points, the closest pair has an edge at any time. For discs with radii of their own, at any time
/// the pair with the least gap has an edge in the regular triangulation or overlaps (docs/MATH.md,
/// section 11). The further ones need not be the next ones of all pairs.
///
/// In a periodic box pairs are those of images, once for each pair modulo the lattice: also of a
/// point and its own image, and two points may have several. Offsets are against the positions as
/// given: if a motion moves a point to another image of itself, its pairs have other offsets from
/// then on. A point that is erased and one that is inserted at the same time are no pair there.
/// Discs with radii of their own may be larger than the box, and overlap images of themselves, if
/// the simulation allows that. Section 18 has the proof.
///
/// Gaps are compared exactly, even if they round to the same number. Cost: for each change of an
/// edge or overlap, or of a motion at one, some hundred floating-point operations, which exclude
/// most pairs; exact arithmetic for the others. For k points that are inserted or erased at one
/// time, O(k log k + number) such operations, and as many for each of their pairs that may be among
/// the nearest. For discs with radii of their own a second simulation, which tracks overlaps, runs
/// beside the observed one; its cost is that of the observed one with a response. Memory: O(edges +
/// overlaps + number).
template <HasLinearMotion Traits = Linear_kinetic_traits_2>
class Closest_approaches {
 public:
  /// Observes from the current time on. The simulation must outlive this object. Precondition:
  /// number > 0.
  Closest_approaches(Simulation_2<Traits>& simulation, std::size_t number);
  ~Closest_approaches();

  Closest_approaches(const Closest_approaches&) = delete;
  Closest_approaches& operator=(const Closest_approaches&) = delete;

  /// The closest approaches so far, in order of the exact gap; for equal gaps the earlier first,
  /// then by ids, then by the offset. Cost: O(number log number) exact comparisons, and for each
  /// result some more that round its numbers.
  std::vector<Approach> approaches();

 private:
  std::unique_ptr<detail::Approach_tracker<Traits>> tracker_;
};

extern template class Closest_approaches<Linear_kinetic_traits_2>;
extern template class Closest_approaches<Disc_kinetic_traits_2>;
extern template class Closest_approaches<Periodic_kinetic_traits_2>;
extern template class Closest_approaches<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_CLOSEST_APPROACHES_H
