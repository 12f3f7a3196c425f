// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closest approaches of points that are neighbors, over a run.
#ifndef KINETRI_SIMULATION_CLOSEST_APPROACHES_H
#define KINETRI_SIMULATION_CLOSEST_APPROACHES_H

#include <cstddef>
#include <map>
#include <vector>

#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// How near two points came, and when.
struct Approach {
  Edge_ids points = {no_point, no_point};  ///< the two
  Algebraic_number time;  ///< exact: rational where the distance has its minimum between turns
  double distance = 0;    ///< at that time, rounded
};

/// Observes a simulation and keeps, of all pairs, the `number` that came nearest to each other
/// while they had an edge of the triangulation; of each pair the time at which it was nearest. At
/// any time the closest pair has an edge, so that the first of them is the closest approach of all.
///
/// Cost: some twenty floating-point operations for each change of an edge or of a motion at it;
/// exact arithmetic only for a pair that is nearer than those known. Memory: O(edges + number).
class Closest_approaches : public Event_observer<Algebraic_number> {
 public:
  /// Observes from now on. Precondition: number > 0. The simulation must outlive this object.
  Closest_approaches(Simulation_2<>& simulation, std::size_t number);
  ~Closest_approaches() override;

  Closest_approaches(const Closest_approaches&) = delete;
  Closest_approaches& operator=(const Closest_approaches&) = delete;

  /// Those until now, nearest first; of equal distances the earlier first, then by ids.
  std::vector<Approach> approaches();

  /// @{
  /// Follows the edges and the motions.
  void before_event(const Event<Algebraic_number>& event) override;
  void after_event(const Event<Algebraic_number>& event) override;
  /// @}

 private:
  // A pair with an edge, since the last change of it or of a motion of its points.
  struct Piece {
    Linear_motion_2 p;
    Linear_motion_2 q;
    Algebraic_number since;
  };

  void begin(const Edge_ids& pair, const Algebraic_number& time);
  void end(const Edge_ids& pair, const Algebraic_number& time);
  void look_at(const Edge_ids& pair, const Piece& piece, const Algebraic_number& until);
  void keep(const Approach& approach);
  void forget_far_ones();
  template <class Function>
  void for_each_pair_of(Point_id id, Function function) const;

  Simulation_2<>& simulation_;
  std::size_t number_;
  std::map<Edge_ids, Piece> pieces_;
  std::map<Edge_ids, Approach> nearest_;
  double limit_;  // a distance beyond this is of no interest any more
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_CLOSEST_APPROACHES_H
