// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closest approaches of points or discs, over a run.
#ifndef KINETRI_OBSERVERS_CLOSEST_APPROACHES_H
#define KINETRI_OBSERVERS_CLOSEST_APPROACHES_H

#include <concepts>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/observers/gap_of_pair.h"
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
};

/// Traits of points, or discs, whose velocities are constant between events.
template <class Traits>
concept HasLinearMotion = ContactKineticTraits_2<Traits> &&
    std::same_as<Center_motion_of<typename Traits::Motion>, Linear_motion_2>;

/// An observer of a simulation that keeps the `number` pairs with the least gaps while they were
/// neighbors in the triangulation or overlapped, and for each pair the first time of its least gap.
/// A point that is erased and one that is inserted at the same time are a pair at that time. Discs
/// have the radius of the options, or radii of their own, which may differ and grow; without radii
/// the gap is the distance. A point that coincides with others for a while is a neighbor of the one
/// that hides it.
///
/// The first of the result is the closest approach of all pairs. For discs of one radius, and
/// points, the closest pair has an edge at any time. For discs with radii of their own, at any time
/// the pair with the least gap has an edge in the regular triangulation or overlaps (docs/MATH.md,
/// section 11). The further ones need not be the next ones of all pairs. Contacts that involve a
/// disc of radius 0 are an exception (section 8).
///
/// Gaps are compared exactly, even if they round to the same number. Cost: for each change of an
/// edge or overlap, or of a motion at one, some hundred floating-point operations, which exclude
/// most pairs; exact arithmetic for the others. For k points that are inserted or erased at one
/// time, O(k log k + number) such operations, and as many for each of their pairs that may be among
/// the nearest. Memory: O(edges + overlaps + number).
template <HasLinearMotion Traits = Linear_kinetic_traits_2>
class Closest_approaches : public Event_observer, private Overlap_observer {
  static constexpr bool has_radii = HasWeight<typename Traits::Motion>;

 public:
  /// Observes from the current time on. The simulation must outlive this object. Preconditions:
  /// number > 0; if discs have radii of their own, the simulation has a response, such as
  /// log_contact, because overlaps are not tracked without one.
  Closest_approaches(Simulation_2<Traits>& simulation, std::size_t number);
  ~Closest_approaches() override;

  Closest_approaches(const Closest_approaches&) = delete;
  Closest_approaches& operator=(const Closest_approaches&) = delete;

  /// The closest approaches so far, in order of the exact gap; for equal gaps the earlier first,
  /// then by ids. Cost: O(number log number) exact comparisons, and for each result some more that
  /// round its numbers.
  std::vector<Approach> approaches();

  /// True if events may name points, as contacts do: their edges are read.
  bool looks_at_triangulation() const override {
    return has_radii || simulation_.options().box || simulation_.options().response;
  }
  /// @{
  /// Called by the simulation; tracks edges and motions.
  void before_event(const Event& event) override;
  void after_event(const Event& event) override;
  void after_hiding(const Algebraic_number& time, std::span<const Point_id> points) override;
  /// @}

 private:
  // A pair that has an edge or overlaps, since that began or the last change of a motion.
  struct Piece {
    Disc_motion_2 p;
    Disc_motion_2 q;
    Algebraic_number since;
    bool is_edge = false;  // if not, the discs overlapped just after `since`
  };

  // The least gap of a piece.
  struct Candidate {
    Edge_ids points = {no_point, no_point};
    detail::Gap_of_pair<Disc_motion_2> least;
  };

  // A point that is inserted or erased, with its motion at that time.
  struct Passing {
    Point_id id;
    Disc_motion_2 disc;
  };

  static bool is_nearer(const Candidate& a, const Candidate& b);

  void after_change(std::span<const Point_id> points) override;
  void follow_link(Point_id id);
  Disc_motion_2 disc(Point_id id) const;
  bool has_changed(const Edge_ids& pair, const Piece& piece) const;
  void begin(const Edge_ids& pair, const Algebraic_number& time, bool is_edge);
  void begin_overlap(const Edge_ids& pair, const Algebraic_number& time);
  void end(const Edge_ids& pair, const Algebraic_number& time);
  void change_motion(Point_id id, const Algebraic_number& time);
  void examine(const Edge_ids& pair, const Piece& piece, const Algebraic_number& until);
  void note_passing(const Event& event);
  void examine_moment();
  void examine_nearest_by_order(const std::vector<Disc_motion_2>& gone,
                                const std::vector<Disc_motion_2>& come);
  void examine_at_moment(std::size_t gone, std::size_t come);
  void keep(Candidate candidate);
  void drop_all_but_nearest();

  Simulation_2<Traits>& simulation_;
  std::size_t number_;
  std::map<Edge_ids, Piece> pieces_;
  std::map<Point_id, Point_id> links_;  // points, and those that hide them
  // Of each piece without an edge both points, each with the other one.
  std::set<std::pair<Point_id, Point_id>> overlaps_;
  // The points of the present event that existed before it; and the points that have been erased
  // and inserted at one time.
  std::vector<Passing> named_;
  Algebraic_number moment_;
  std::vector<Passing> gone_;
  std::vector<Passing> come_;
  std::map<Edge_ids, Candidate> nearest_;
  // `number_` pairs have had this gap or a smaller one: pairs with greater gaps are not kept.
  double limit_;
};

extern template class Closest_approaches<Linear_kinetic_traits_2>;
extern template class Closest_approaches<Disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_CLOSEST_APPROACHES_H
