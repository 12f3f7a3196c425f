// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which points were neighbors in the triangulation, from when until when: the lives of its edges.
//
// Where points move, two neighbors part and two others meet in their place: a neighbor exchange, or
// T1 process, as it is called of foams and tissues. The four cells meet in one vertex of the
// Voronoi diagram; the ridge between the two that part shrinks to that vertex, and the ridge
// between the two that meet grows from it.
//
// Source of the name: D. Weaire, N. Rivier, Soap, cells and statistics: random patterns in two
// dimensions, Contemporary Physics 25, 1984.
#ifndef KINETRI_OBSERVERS_NEIGHBOR_LIVES_H
#define KINETRI_OBSERVERS_NEIGHBOR_LIVES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/observers/edge_follower.h"

namespace kinetri {

/// Why two points become neighbors, or cease to be.
enum class Life_limit : std::uint8_t {
  run,       ///< the observation begins or ends
  point,     ///< a point has come or gone: one of the two, or one beside both
  exchange,  ///< the motions
};

/// The name in files: "run", "point", "exchange".
const char* name(Life_limit limit);

/// Two points that were neighbors without a break.
struct Neighbor_life {
  Edge_ids points = {no_point, no_point};  ///< the ids, the smaller first
  Algebraic_number begin;                  ///< just after it they are neighbors; exact
  Algebraic_number end;                    ///< just before it; later than `begin`; exact
  Life_limit begins_by = Life_limit::run;  ///< why then
  Life_limit ends_by = Life_limit::run;    ///< why then
  /// Whether the ridge between the two cells was shorter than the threshold at every time of this
  /// life; false without a threshold.
  bool is_short = false;
};

/// The neighbor exchanges of a point. A point takes part in an exchange where it gains or loses a
/// neighbor by one; each exchange of two pairs has four such points.
struct Point_exchanges {
  Point_id id = no_point;  ///< the point
  Algebraic_number from;   ///< it was there from then on
  Algebraic_number until;  ///< until then: it left, or the present
  std::size_t gained = 0;  ///< neighbors, by exchanges
  std::size_t lost = 0;    ///< neighbors, by exchanges
  /// Those of gained + lost by a short exchange: one that begins or ends a short life.
  std::size_t short_ones = 0;
};

/// An observer that keeps the life of every edge of a triangulation. An edge that goes and comes
/// back within one time has not gone. A turn of a point does not end the lives of its edges; that
/// of a jump ends those that the new place does not have, by exchange.
///
/// *By a point*: an edge comes or goes by a point if each end of it has come, has gone, or is a
/// neighbor of a point that has come or gone, at that time. So an exchange that happens at exactly
/// that time between such neighbors is not told apart.
///
/// *Short ridges.* With a threshold, a life is short if the length of its ridge, the side that the
/// two Voronoi cells (with weights: power cells) have in common, is less than the threshold at all
/// times of the life, from its begin to its end, these included; at a time at which points meet,
/// its length is the limit of that before and after it. That is decided exactly: the squared length
/// is a quotient of two polynomials in time, of degrees 10 and 8 for linear motion, whose common
/// divisor is divided out. Of a life that goes on, it is decided up to the present. The ridge of a
/// hull edge has no end, and is not short. Where an exchange is undone before the new ridge has
/// reached the threshold, that life is short, and both exchanges are. (Which pair another one
/// replaces is known of exchanges of two pairs that are alone in their quadrilateral; of several at
/// one time in one place, an exchange is short only for the two points of the short life.) The life
/// of the pair that parts and meets again is not joined.
///
/// Cost: O(log n) for each edge that changes, and O(degree) for each turn. With a threshold, also
/// predicates for the five edges around it, and until the ridge of an edge has reached the
/// threshold, bounds of its length, or the polynomial of each quadrilateral that it is the diagonal
/// of where these do not decide. Memory: O(n), and
/// for each life two exact times.
template <ContactKineticTraits_2 Traits>
class Neighbor_lives final : private Edge_follower<Traits> {
 public:
  using Time = Algebraic_number;                          ///< of lives
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what is observed

  /// @{
  /// Observes from the current time on. Precondition: the threshold is positive and finite.
  explicit Neighbor_lives(Simulation_2<Traits>& simulation,
                          std::optional<double> ridge_threshold = std::nullopt);
  explicit Neighbor_lives(Triangulation& triangulation,
                          std::optional<double> ridge_threshold = std::nullopt);
  /// @}

  /// All lives up to now, in the exact order of their begin, then of the ids. Those of the present
  /// neighbors end at the current time, by the end of the run. A life without duration, which has
  /// begun at the current time, is left out. Cost: O(n log n) exact comparisons.
  std::vector<Neighbor_life> lives();

  /// The exchanges of each point that has been there, up to now, in the order of the ids. An
  /// exchange at the current time counts.
  std::vector<Point_exchanges> exchanges();

 private:
  using Base = Edge_follower<Traits>;
  using typename Base::Changed_point;
  using typename Base::Motion;
  using typename Base::Point_2;
  using Index = std::size_t;
  using Opposite = std::array<Point_id, 2>;  // sorted; no_point of the infinite vertex

  static constexpr Index none = static_cast<Index>(-1);

  struct Life {
    Neighbor_life life;
    bool has_ended = false;
    Index replaced = none;     // the life in the place of which this one has begun
    Index replaced_by = none;  // the one that has begun in its place
  };

  /// A present edge. The rest is kept with a threshold only.
  struct Present {
    Index index = none;
    Opposite opposite = {no_point, no_point};  // the points of the triangles at the edge ...
    Time since;                                // ... from then on
    bool is_long = false;                      // the ridge has reached the threshold
  };

  struct Presence {
    Time from;
    std::optional<Time> until;
  };

  void start();
  void advance(const Time& time) override { now_ = time; }
  void before_change(std::span<const Edge_ids> removed,
                     std::span<const Changed_point> points) override;
  void change(const Time& time, std::span<const Edge_ids> removed, std::span<const Edge_ids> added,
              std::span<const Changed_point> points) override;
  void change_triangles(std::span<const Edge_ids> edges) override;

  void follow_opposites(std::span<const Edge_ids> removed, std::span<const Edge_ids> added);
  void add_points_around(std::span<const Edge_ids> edges, std::set<Point_id>& around) const;
  void update_opposites(const std::set<Point_id>& around);
  std::vector<Point_id> common_neighbors(Point_id a, Point_id b) const;
  Opposite opposite(const Edge_ids& edge) const;
  void end_piece(const Edge_ids& edge);
  bool reaches_threshold(const Edge_ids& edge, const Present& present, const Time& until) const;
  std::vector<bool> short_lives() const;

  std::optional<double> threshold_;
  Time now_;
  std::vector<Life> lives_;
  std::map<Edge_ids, Present> present_;
  std::map<Point_id, Presence> presences_;
  // Of the change that has begun: the neighbors that the points had which change, and what the
  // edges that go were.
  std::vector<std::pair<Point_id, std::vector<Point_id>>> neighbors_before_;
  std::map<Edge_ids, Present> ended_;
};

extern template class Neighbor_lives<Linear_kinetic_traits_2>;
extern template class Neighbor_lives<Polynomial_kinetic_traits_2>;
extern template class Neighbor_lives<Disc_kinetic_traits_2>;
extern template class Neighbor_lives<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_NEIGHBOR_LIVES_H
