// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closest approaches of points that are neighbors, over a run.
#ifndef KINETRI_SIMULATION_CLOSEST_APPROACHES_H
#define KINETRI_SIMULATION_CLOSEST_APPROACHES_H

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// The closest approach of two points.
struct Approach {
  Edge_ids points = {no_point, no_point};  ///< the ids, the smaller first
  Algebraic_number time;  ///< exact; rational if the distance has its minimum between turns
  /// The distance at that time, rounded to the nearest binary64 number, ties to even; infinite on
  /// overflow.
  double distance = 0;
};

/// An observer of a simulation that keeps the `number` pairs that came nearest to each other while
/// they were neighbors in the triangulation, and for each pair the first time at which it was
/// nearest. At any time the closest pair has an edge, so the first of the result is the closest
/// approach of all pairs.
///
/// Distances are compared exactly, even if they round to the same number. Cost: for each change of
/// an edge or of a motion at it some hundred floating-point operations, which prove for most pairs
/// that they are not near enough, and exact arithmetic for the others. Memory: O(edges + number).
class Closest_approaches : public Event_observer {
 public:
  /// Observes from the current time on. Precondition: number > 0. The simulation must outlive this
  /// object.
  Closest_approaches(Simulation_2<>& simulation, std::size_t number);
  ~Closest_approaches() override;

  Closest_approaches(const Closest_approaches&) = delete;
  Closest_approaches& operator=(const Closest_approaches&) = delete;

  /// The closest approaches so far, in order of exact distance; for equal distances the earlier
  /// first, then by ids. Cost: O(number log number) exact comparisons, and for each result some
  /// more that round its distance.
  std::vector<Approach> approaches();

  /// @{
  /// Called by the simulation; they track edges and motions.
  void before_event(const Event& event) override;
  void after_event(const Event& event) override;
  /// @}

 private:
  // A pair with an edge, since the last change of it or of a motion of its points.
  struct Piece {
    Linear_motion_2 p;
    Linear_motion_2 q;
    Algebraic_number since;
  };

  // The nearest place of a piece. The motions are those of the piece.
  struct Candidate {
    Edge_ids points = {no_point, no_point};
    Algebraic_number time;
    Linear_motion_2 p;
    Linear_motion_2 q;
    Double_interval squared_bounds;  // contain the squared distance
    mutable std::optional<Algebraic_number>
        squared_distance;  // made where the bounds do not decide
  };

  static const Algebraic_number& squared_distance(const Candidate& candidate);
  static bool is_nearer(const Candidate& a, const Candidate& b);

  void begin(const Edge_ids& pair, const Algebraic_number& time);
  void end(const Edge_ids& pair, const Algebraic_number& time);
  void examine(const Edge_ids& pair, const Piece& piece, const Algebraic_number& until);
  void keep(Candidate candidate);
  void drop_all_but_nearest();
  template <class Function>
  void for_each_pair_of(Point_id id, Function function) const;

  Simulation_2<>& simulation_;
  std::size_t number_;
  std::map<Edge_ids, Piece> pieces_;
  std::map<Edge_ids, Candidate> nearest_;
  // `number_` pairs have been at this squared distance or nearer: a pair that is certainly farther
  // is of no interest.
  double squared_limit_;
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_CLOSEST_APPROACHES_H
