// SPDX-License-Identifier: GPL-3.0-or-later
//
// Encounters: which points are in range of one another, and when.
//
// A pair that comes in range has an edge then, or a third point is in range of both and has an edge
// with one of them (docs/MATH.md, section 14). So few pairs are *candidates*: each is certified
// once for each motion, and enters a queue if it will come in range. A pair that ceases to be a
// candidate stays in the queue: its time is right as long as its motions do not change.
#ifndef KINETRI_OBSERVERS_ENCOUNTERS_H
#define KINETRI_OBSERVERS_ENCOUNTERS_H

#include <memory>
#include <vector>

#include "kinetri/impl/observers/neighbor_names.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// Two points, or discs, that were in range of each other from `begin` to `end`, both included.
struct Encounter {
  Edge_ids points = {no_point, no_point};  ///< the ids, the smaller first
  Algebraic_number begin;                  ///< exact
  Algebraic_number end;                    ///< exact; the present time if it has not ended
  Algebraic_number closest;                ///< the first time at which their gap was least, exact
  /// The distance of the centers at that time, rounded to the nearest binary64 number, ties to
  /// even; infinite on overflow.
  double distance = 0;
  double gap = 0;  ///< the gap at that time, rounded in the same way; of points, the distance
  /// In a periodic box, `points` and this are a Periodic_edge: the encounter is that of the first
  /// point with this image of the second one. Else zero.
  Lattice_offset_2 offset = {};
};

namespace detail {
template <DistanceKineticTraits_2 Traits>
class Encounter_tracker;
}  // namespace detail

/// All encounters: of each pair the times at which its gap is at most `range`. The gap is the
/// distance of two points less the radii of their discs, which are those of the motions (HasWeight)
/// or the radius of the options. A gap of just `range` counts, so an encounter may be one moment.
///
/// No encounter begins before the observation or before both points exist, and none ends after the
/// current time or after one of the two is erased. An encounter continues through a change of
/// motion if the two are in range at that time under the motions before and after it; of several
/// changes of a point at one time only the last counts, unless this object is called in between. A
/// point that is erased and one that is inserted at the same time may have an encounter at that
/// time. All of it is exact.
///
/// In a periodic box encounters are those of images: of a point with each image that comes in range
/// of it, be it of another point or of itself, once for each pair modulo the lattice
/// (Periodic_edge). So the range may be greater than the box, and a point in range of two images of
/// another one has two encounters. Offsets are against the positions as given: if a motion moves a
/// point to another image of itself, its encounters end and others begin. A point that is erased
/// and one that is inserted at the same time have no encounter there. An offset of 2^31 or more, of
/// images that far from the positions as given, is a Periodic_box_error of the call that advances
/// time. A range of more than 865 lengths of the shortest lattice vector at the start, or
/// discs as large as that, are a Periodic_box_error too. Discs with radii of their own may be
/// larger than the box, and overlap images of themselves, if the simulation allows that.
///
/// Cost: for each new edge and each encounter some certificates, in proportion to the number of
/// points in range of one; for each encounter two entries of a queue. Least gaps are computed on
/// request. Memory: O(n + encounters). For discs with radii of their own a second simulation, of
/// enlarged discs, runs beside the observed one; its cost is that of the observed one with a
/// response, and a certificate for each pair that overlaps there.
template <DistanceKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Encounters {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what is observed

  /// Observes from the current time on. The simulation must outlive this object. Throws
  /// Precondition_error if `range` is negative or not finite, or if a radius enlarged by half of it
  /// is not finite.
  Encounters(Simulation_2<Traits>& simulation, double range);
  /// The same of a triangulation of points.
  Encounters(Triangulation& triangulation,
             double range) requires(!HasWeight<typename Traits::Motion>);
  ~Encounters();

  /// As given to the constructor.
  double range() const;

  /// All encounters up to the current time, also those that have not ended, in the order of
  /// `begin`, then of ids, then of the offset. Cost: O(m log m) comparisons of times for m
  /// encounters, and the rounding of the least distance of those that have not ended or have ended
  /// since the last call: some hundred floating-point operations for most points in linear motion,
  /// else exact arithmetic.
  std::vector<Encounter> encounters();

  /// Counts of certificates.
  const Certificate_counters& certificate_counters() const;
  /// Counts of entries of the queue.
  const Queue_counters& queue_counters() const;

 private:
  std::unique_ptr<detail::Encounter_tracker<Traits>> tracker_;
};

/// The traits follow from the simulation.
template <DistanceKineticTraits_2 Traits>
Encounters(Simulation_2<Traits>&, double) -> Encounters<Traits>;

extern template class Encounters<Linear_kinetic_traits_2>;
extern template class Encounters<Polynomial_kinetic_traits_2>;
extern template class Encounters<Disc_kinetic_traits_2>;
extern template class Encounters<Polynomial_disc_kinetic_traits_2>;
extern template class Encounters<Periodic_kinetic_traits_2>;
extern template class Encounters<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_ENCOUNTERS_H
