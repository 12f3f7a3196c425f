// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which points were neighbors in the triangulation, and when: the lifetimes of its edges.
//
// When points move, two neighbors separate and two others become neighbors instead: a neighbor
// exchange, called T1 process in foams and tissues. At that time the four cells share a vertex of
// the Voronoi diagram; one ridge shrinks to that vertex, and the other one grows from it.
//
// Source of the name: D. Weaire, N. Rivier, Soap, cells and statistics: random patterns in two
// dimensions, Contemporary Physics 25, 1984.
#ifndef KINETRI_OBSERVERS_NEIGHBOR_LIVES_H
#define KINETRI_OBSERVERS_NEIGHBOR_LIVES_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// Why a lifetime begins or ends.
enum class Life_limit : std::uint8_t {
  run,       ///< the observation begins or ends
  point,     ///< a point is inserted or erased: one of the two, or a neighbor of both
  exchange,  ///< anything else: the motions, or a point jumps, or begins or ceases to coincide
};

/// The name in files: "run", "point", "exchange".
const char* name(Life_limit limit);

/// A lifetime of an edge.
struct Neighbor_life {
  Edge_ids points = {no_point, no_point};  ///< the ids, the smaller first
  Algebraic_number begin;                  ///< just after it they are neighbors; exact
  Algebraic_number end;                    ///< just before it; later than `begin`; exact
  Life_limit begins_by = Life_limit::run;  ///< why it begins
  Life_limit ends_by = Life_limit::run;    ///< why it ends
  /// Whether the ridge between the two cells was shorter than the threshold throughout; false
  /// without a threshold.
  bool is_short = false;
  /// In a periodic box, `points` and this are a Periodic_edge: the first point and this image of
  /// the second one were neighbors. Else zero.
  Lattice_offset_2 offset = {};
};

/// The neighbor exchanges in which a point gains or loses a neighbor. Each exchange of two pairs
/// concerns four points.
struct Point_exchanges {
  Point_id id = no_point;  ///< the point
  Algebraic_number from;   ///< the beginning of its presence
  Algebraic_number until;  ///< its erasure, or the present time
  std::size_t gained = 0;  ///< neighbors, by exchanges
  std::size_t lost = 0;    ///< neighbors, by exchanges
  /// Of gained + lost, those by short exchanges: they begin or end a short lifetime.
  std::size_t short_ones = 0;
};

namespace detail {
template <DistanceKineticTraits_2 Traits>
class Life_recorder;
}  // namespace detail

/// An observer that records the lifetime of every edge of a triangulation. An edge that is removed
/// and added again at one time has one lifetime. A new motion of a point does not end the lifetimes
/// of its edges; if the point jumps, lifetimes of edges that it does not have at the new position
/// end by exchange.
///
/// *By a point*: a lifetime begins or ends by a point if each end of the edge is inserted or
/// erased, or is a neighbor of such a point, at that time. An exchange between such neighbors at
/// exactly that time is not distinguished.
///
/// *Short ridges.* With a threshold, a lifetime is short if the length of its ridge, the common
/// side of the two Voronoi cells (with weights: power cells), is less than the threshold from its
/// begin to its end, both included; at a time at which points meet, the length is the limit before
/// and after it. That is decided exactly: the squared length is a quotient of two polynomials in
/// time, of degrees 10 and 8 for linear motion, whose common divisor is divided out. For a present
/// edge it is decided up to the present time. The ridge of a hull edge is unbounded, and not short.
/// If an exchange is reversed before the new ridge has reached the threshold, the lifetime between
/// is short, and so are both exchanges. (If several exchanges at one time concern the
/// quadrilateral, it is not known which pair replaces which: the exchange is then short only for
/// the two points of the short lifetime.) The two lifetimes before and after it are not joined.
///
/// *In a periodic box* edges are those of images, so that two points may have several lifetimes at
/// a time, each with its own offset. The edges from a point to its own image count twice in its
/// exchanges, as the point has two such neighbors. The lengths of ridges are those of the cells of
/// the torus, and no ridge is unbounded but that of two points that coincide for a while. Offsets
/// are against the positions as given: if a motion moves a point to another image of itself, its
/// lifetimes end and others begin. An offset of 2^31 or more is a Periodic_box_error.
///
/// Cost: O(log n) for each edge that changes, and O(degree) for each new motion. With a threshold,
/// also predicates for the five edges around it, and until the ridge of an edge has reached the
/// threshold, bounds of its length for each of its quadrilaterals, or a polynomial if these do not
/// decide. Memory: O(n), and two exact times for each lifetime.
template <DistanceKineticTraits_2 Traits>
class Neighbor_lives {
 public:
  using Time = Algebraic_number;                          ///< of lifetimes
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what is observed

  /// @{
  /// Observes from the current time on. Precondition: the threshold is positive and finite.
  explicit Neighbor_lives(Simulation_2<Traits>& simulation,
                          std::optional<double> ridge_threshold = std::nullopt);
  explicit Neighbor_lives(Triangulation& triangulation,
                          std::optional<double> ridge_threshold = std::nullopt);
  /// @}
  ~Neighbor_lives();

  /// All lifetimes up to now, in the exact order of their begin, then of the ids. Those of present
  /// edges end at the current time, by the end of the run; those that have begun at the current
  /// time are left out. Cost: O(m log m) exact comparisons for m lifetimes.
  std::vector<Neighbor_life> lives();

  /// The exchanges of each point that has ever existed, in the order of the ids. An exchange at the
  /// current time counts.
  std::vector<Point_exchanges> exchanges();

 private:
  std::unique_ptr<detail::Life_recorder<Traits>> recorder_;
};

extern template class Neighbor_lives<Linear_kinetic_traits_2>;
extern template class Neighbor_lives<Polynomial_kinetic_traits_2>;
extern template class Neighbor_lives<Disc_kinetic_traits_2>;
extern template class Neighbor_lives<Polynomial_disc_kinetic_traits_2>;
extern template class Neighbor_lives<Periodic_kinetic_traits_2>;
extern template class Neighbor_lives<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_NEIGHBOR_LIVES_H
