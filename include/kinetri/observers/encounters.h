// SPDX-License-Identifier: GPL-3.0-or-later
//
// Encounters: which points come near one another, from when until when.
//
// A pair that comes in range has an edge then, or a point that both have in range already and that
// has an edge with one of the two (docs/MATH.md, section 14). So few pairs are *candidates*: these
// are certified apart once for each motion, and those that will come in range wait in a queue. No
// pair leaves the queue because it is no candidate any more; its time stays right as long as the
// two motions do.
#ifndef KINETRI_OBSERVERS_ENCOUNTERS_H
#define KINETRI_OBSERVERS_ENCOUNTERS_H

#include <memory>
#include <span>
#include <vector>

#include "kinetri/impl/observers/edge_follower.h"

namespace kinetri {

/// Two points, or discs, that were in range of each other from `begin` to `end`, both included.
struct Encounter {
  Edge_ids points = {no_point, no_point};  ///< the ids, the smaller first
  Algebraic_number begin;                  ///< exact
  Algebraic_number end;                    ///< exact; the present time if it goes on
  Algebraic_number closest;                ///< the first time at which their gap was least, exact
  /// The distance of the centres at that time, rounded to the nearest binary64 number, ties to
  /// even; infinite on overflow.
  double distance = 0;
  double gap = 0;  ///< the gap at that time, rounded in the same way; of points, the distance
};

/// Is told of encounters, in the order of time.
class Encounter_observer {
 public:
  virtual ~Encounter_observer() = default;
  /// The two are in range from `time` on. Must neither change what is observed nor ask the object
  /// that tells of it. May be called when time has gone on: must not look at the triangulation.
  virtual void begins(const Edge_ids& points, const Algebraic_number& time) = 0;
  /// The two were in range up to `time`. As above.
  virtual void ends(const Edge_ids& points, const Algebraic_number& time) = 0;

 protected:
  Encounter_observer() = default;
  /// @{
  /// For the copies of derived classes.
  Encounter_observer(const Encounter_observer&) = default;
  Encounter_observer& operator=(const Encounter_observer&) = default;
  /// @}
};

namespace detail {
template <ContactKineticTraits_2 Traits>
class Encounter_tracker;
}  // namespace detail

/// All encounters: of each pair the times at which its gap is at most `range`. The gap is the
/// distance of two points less the radii of their discs, which are those of the motions (HasWeight)
/// or the radius of the options. A gap of just `range` counts, so an encounter may be one moment.
///
/// An encounter that begins at the start, or when one of the two comes, begins there; one that has
/// not ended ends now, or when one of the two leaves. It goes on through a change of motion if the
/// two are in range at that time under the motions before and after it; of several changes of a
/// point at one time, as far as this object has not been asked in between, only the last one
/// counts. A point that leaves is still there at the time at which it does, for one that comes
/// then. All of it is exact.
///
/// Cost: for each edge that comes and for each encounter some certificates, in proportion to the
/// number of points in range of one; for each encounter two entries of a queue. The least gaps are
/// found when they are asked for. Memory: O(n + encounters). Discs with radii of their own are
/// followed by a simulation of enlarged discs beside the observed one, which costs as much as it
/// does with a response to contacts, and a certificate for each pair that overlaps there.
template <ContactKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Encounters final : public Edge_follower<Traits> {
 public:
  using typename Edge_follower<Traits>::Triangulation;
  using typename Edge_follower<Traits>::Motion;
  using typename Edge_follower<Traits>::Point_2;
  using typename Edge_follower<Traits>::Time;

  /// Observes from the current time on. The simulation must outlive this object. Throws
  /// Precondition_error if `range` is negative or not finite, or is too large for a disc of that
  /// radius to have a finite one.
  Encounters(Simulation_2<Traits>& simulation, double range);
  /// The same of a triangulation of points.
  Encounters(Triangulation& triangulation, double range) requires(!HasWeight<Motion>)
      : Edge_follower<Traits>(triangulation), range_(range) {
    start(0);
  }
  ~Encounters() override;

  /// As given to the constructor.
  double range() const { return range_; }

  /// All encounters up to the current time, those that go on included, in the order of `begin`,
  /// then of ids. Cost: O(m log m) comparisons of times for m encounters, and for each that has
  /// ended since the last call, and each that goes on, the rounding of its least distance: some
  /// hundred floating-point operations where that is certain (points in linear motion), else exact
  /// arithmetic.
  std::vector<Encounter> encounters();

  /// The points in range of a point at the current time, sorted. Precondition: the triangulation
  /// contains it.
  std::vector<Point_id> in_range(Point_id id);

  /// @{
  /// Has the observer told of what happens from the next call of it on; it must outlive this object
  /// or be removed, which it may do when it is called.
  void add_encounter_observer(Encounter_observer& observer);
  void remove_encounter_observer(Encounter_observer& observer);
  /// @}

  /// Counts of the certificates made here.
  const Certificate_counters& certificate_counters() const;
  /// Counts of the entries of the queue.
  const Queue_counters& queue_counters() const;

 private:
  using typename Edge_follower<Traits>::Changed_point;

  void start(double radius);
  void advance(const Time& time) override;
  void before_change(std::span<const Edge_ids> removed,
                     std::span<const Changed_point> points) override;
  void change(const Time& time, std::span<const Edge_ids> removed, std::span<const Edge_ids> added,
              std::span<const Changed_point> points) override;

  double range_;
  // Not shared, but of a type that is incomplete here.
  std::shared_ptr<detail::Encounter_tracker<Traits>> tracker_;
};

extern template class Encounters<Linear_kinetic_traits_2>;
extern template class Encounters<Polynomial_kinetic_traits_2>;
extern template class Encounters<Disc_kinetic_traits_2>;
extern template class Encounters<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_ENCOUNTERS_H
