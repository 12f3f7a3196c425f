// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/closest_approaches.h"

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/root_difference.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/base/check.h"
#include "kinetri/triangulation/detail/incident.h"

namespace kinetri {
namespace {

// ---- bounds, by interval arithmetic ----

using Interval = CGAL::Interval_nt<false>;
using Upward_rounding = CGAL::Protect_FPU_rounding<true>;

// The vector from the centre of q to that of p, its derivative, and the sum of the radii.
struct Relative_motion {
  Interval x;
  Interval y;
  Interval vx;
  Interval vy;
  Interval reach;

  // At the time t. Precondition: an Upward_rounding is in force.
  Relative_motion(const Disc_motion_2& p, const Disc_motion_2& q, const Interval& t)
      : x(linear(p.position.x, p.velocity.x, p.epoch, t) -
          linear(q.position.x, q.velocity.x, q.epoch, t)),
        y(linear(p.position.y, p.velocity.y, p.epoch, t) -
          linear(q.position.y, q.velocity.y, q.epoch, t)),
        vx(Interval(p.velocity.x) - Interval(q.velocity.x)),
        vy(Interval(p.velocity.y) - Interval(q.velocity.y)),
        reach(linear(p.radius, p.growth, p.epoch, t) + linear(q.radius, q.growth, q.epoch, t)) {}

  Interval squared_distance() const { return CGAL::square(x) + CGAL::square(y); }
  Interval half_slope() const { return x * vx + y * vy; }
  Interval gap() const { return CGAL::sqrt(squared_distance()) - reach; }

 private:
  static Interval linear(double value, double slope, double epoch, const Interval& t) {
    return Interval(value) + Interval(slope) * (t - Interval(epoch));
  }
};

bool is_finite(const Double_interval& interval) {
  return std::isfinite(interval.lower) && std::isfinite(interval.upper);
}

// Bounds of the gap at a time.
Double_interval gap_bounds(const Disc_motion_2& p, const Disc_motion_2& q,
                           const Double_interval& time) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr Double_interval everything = {-infinite, infinite};
  if (!is_finite(time)) return everything;
  const Upward_rounding protection;
  const Interval result = Relative_motion(p, q, Interval(time.lower, time.upper)).gap();
  if (!(result.inf() <= result.sup())) return everything;  // an overflow
  return {result.inf(), result.sup()};
}

// Whether the gap is greater than `limit` at every one of the times, proved: the squared distance
// is a convex function, and so nowhere below its tangent at the time s; s is about where it is
// least, but any time is right.
bool is_certainly_farther(const Disc_motion_2& p, const Disc_motion_2& q,
                          const Double_interval& times, double limit) {
  if (!is_finite(times)) return false;
  const Upward_rounding protection;
  const Interval all_times(times.lower, times.upper);
  const Interval least = Interval(limit) + Relative_motion(p, q, all_times).reach;
  if (least.sup() < 0) return true;  // no distance is negative
  const Relative_motion at_begin(p, q, Interval(times.lower));
  const double speed = (CGAL::square(at_begin.vx) + CGAL::square(at_begin.vy)).sup();
  double s = times.lower;
  if (speed > 0) s = std::clamp(s - at_begin.half_slope().sup() / speed, s, times.upper);
  if (!std::isfinite(s)) return false;
  const Relative_motion at_s(p, q, Interval(s));
  const Interval tangent =
      at_s.squared_distance() + Interval(2) * at_s.half_slope() * (all_times - Interval(s));
  // False where one of the two is not a number.
  return tangent.inf() > CGAL::square(Interval(least.sup())).sup();
}

// ---- the same, exactly ----

Rational constant_term(double value, double slope, double epoch) {
  return to_rational(value) - to_rational(slope) * to_rational(epoch);
}

// The squared distance as a polynomial in time, by ascending power.
std::array<Rational, 3> squared_distance(const Disc_motion_2& p, const Disc_motion_2& q) {
  const Rational x = constant_term(p.position.x, p.velocity.x, p.epoch) -
                     constant_term(q.position.x, q.velocity.x, q.epoch);
  const Rational y = constant_term(p.position.y, p.velocity.y, p.epoch) -
                     constant_term(q.position.y, q.velocity.y, q.epoch);
  const Rational vx = to_rational(p.velocity.x) - to_rational(q.velocity.x);
  const Rational vy = to_rational(p.velocity.y) - to_rational(q.velocity.y);
  return {x * x + y * y, 2 * (x * vx + y * vy), vx * vx + vy * vy};
}

// The sum of the radii in the same form.
std::array<Rational, 2> reach(const Disc_motion_2& p, const Disc_motion_2& q) {
  return {constant_term(p.radius, p.growth, p.epoch) + constant_term(q.radius, q.growth, q.epoch),
          to_rational(p.growth) + to_rational(q.growth)};
}

// The first time between the two at which the gap is least. The gap sqrt(f) - r - g t, with
// f = a t^2 + b t + c, is a convex function (docs/MATH.md, section 11).
Algebraic_number time_of_least_gap(const Disc_motion_2& p, const Disc_motion_2& q,
                                   const Algebraic_number& since, const Algebraic_number& until) {
  const auto [c, b, a] = squared_distance(p, q);
  const Rational g = reach(p, q)[1];
  const Rational excess = a - g * g;
  const auto clamped = [&](const Algebraic_number& least) {
    return least < since ? since : least > until ? until : least;
  };
  if (excess > 0) {
    // The root of f'^2 = 4 g^2 f at which f' has the sign of g.
    const std::array<Rational, 3> coefficients = {b * b - 4 * g * g * c, 4 * b * excess,
                                                  4 * a * excess};
    if (g == 0) return clamped(Algebraic_number(Rational(-b / (2 * a))));
    const std::vector<Real_root> roots = real_roots(primitive_polynomial(coefficients));
    return clamped(g > 0 ? roots.back().value : roots.front().value);
  }
  // The gap increases or decreases for ever; only where the rims keep a distance, from the time on
  // at which the centres meet, it may be constant.
  if (g <= 0) return since;
  const bool becomes_constant = excess == 0 && b * b == 4 * a * c;
  return becomes_constant ? clamped(Algebraic_number(Rational(-b / (2 * a)))) : until;
}

}  // namespace

template <HasLinearMotion Traits>
Closest_approaches<Traits>::Closest_approaches(Simulation_2<Traits>& simulation, std::size_t number)
    : simulation_(simulation), number_(number), limit_(std::numeric_limits<double>::infinity()) {
  KINETRI_PRECONDITION(number > 0, "no approach is asked for");
  KINETRI_PRECONDITION(!has_radii || simulation.options().response,
                       "overlaps are not followed without a response; log_contact changes nothing");
  for (const Edge_ids& edge : simulation_.triangulation().finite_edge_ids()) {
    begin(edge, simulation_.current_time(), true);
  }
  if constexpr (has_radii) {
    for (Point_id id = 0; id < simulation_.triangulation().next_id(); ++id) {
      after_change({&id, 1});
    }
    simulation_.add_overlap_observer(*this);
  }
  simulation_.add_observer(*this);
}

template <HasLinearMotion Traits>
Closest_approaches<Traits>::~Closest_approaches() {
  simulation_.remove_observer(*this);
  simulation_.remove_overlap_observer(*this);
}

template <HasLinearMotion Traits>
std::vector<Approach> Closest_approaches<Traits>::approaches() {
  for (auto& [pair, piece] : pieces_) {
    examine(pair, piece, simulation_.current_time());
    piece.since = simulation_.current_time();
  }
  drop_all_but_nearest();
  std::vector<const Candidate*> sorted;
  for (const auto& [pair, candidate] : nearest_) sorted.push_back(&candidate);
  std::ranges::sort(sorted, [](const auto* a, const auto* b) { return is_nearer(*a, *b); });
  std::vector<Approach> result;
  for (const Candidate* candidate : sorted) {
    const auto& [points, time, p, q, bounds, known_gap] = *candidate;
    const double distance = root_difference_at(squared_distance(p, q), {}, time).to_double();
    const bool is_gap = p.radius == 0 && q.radius == 0 && p.growth == 0 && q.growth == 0;
    result.push_back({points, time, distance, is_gap ? distance : gap(*candidate).to_double()});
  }
  return result;
}

// ---- which pairs ----

template <HasLinearMotion Traits>
void Closest_approaches<Traits>::after_event(const Event& event) {
  if (event.removed) {
    end(*event.removed, event.time);
    begin_overlap(*event.removed, event.time);
  }
  if (event.added) {
    end(*event.added, event.time);
    begin(*event.added, event.time, true);
  }
  for (const std::optional<Point_id>& id : {event.point_a, event.point_b}) {
    if (id) turn(*id, event.time);
  }
  if (event.kind == Event_kind::collision) {
    begin_overlap(edge_ids(*event.point_a, *event.point_b), event.time);
  }
}

template <HasLinearMotion Traits>
void Closest_approaches<Traits>::after_change(std::span<const Point_id> points) {
  if constexpr (has_radii) {
    for (const Point_id id : points) {
      if (!simulation_.triangulation().contains(id)) continue;
      for (const Point_id other : simulation_.overlapping_discs(id)) {
        const Edge_ids pair = edge_ids(id, other);
        if (!pieces_.contains(pair)) begin(pair, simulation_.current_time(), false);
      }
    }
  }
}

template <HasLinearMotion Traits>
Disc_motion_2 Closest_approaches<Traits>::disc(Point_id id) const {
  const auto& motion = simulation_.triangulation().motion(id);
  if constexpr (has_radii) {
    return motion;
  } else {
    return {motion, simulation_.options().radius, 0, 0};
  }
}

// Whether the motions of a piece are over, as one of the points has another motion or has gone.
template <HasLinearMotion Traits>
bool Closest_approaches<Traits>::has_turned(const Edge_ids& pair, const Piece& piece) const {
  const auto& triangulation = simulation_.triangulation();
  return !triangulation.contains(pair[0]) || !triangulation.contains(pair[1]) ||
         disc(pair[0]) != piece.p || disc(pair[1]) != piece.q;
}

template <HasLinearMotion Traits>
void Closest_approaches<Traits>::begin(const Edge_ids& pair, const Algebraic_number& time,
                                       bool is_edge) {
  pieces_.insert_or_assign(pair, Piece{disc(pair[0]), disc(pair[1]), time, is_edge});
  if (is_edge) return;
  overlaps_.emplace(pair[0], pair[1]);
  overlaps_.emplace(pair[1], pair[0]);
}

// Follows a pair without an edge, if it overlaps just after `time`, which is the current one.
template <HasLinearMotion Traits>
void Closest_approaches<Traits>::begin_overlap(const Edge_ids& pair, const Algebraic_number& time) {
  if constexpr (has_radii) {
    const auto& triangulation = simulation_.triangulation();
    if (pieces_.contains(pair) || !triangulation.contains(pair[0]) ||
        !triangulation.contains(pair[1])) {
      return;
    }
    const auto& p = triangulation.vertex(pair[0])->point();
    const auto& q = triangulation.vertex(pair[1])->point();
    if (triangulation.traits().may_overlap(p, q, 0, time) &&
        triangulation.traits().exact().may_overlap(p, q, 0, time)) {
      begin(pair, time, false);
    }
  }
}

template <HasLinearMotion Traits>
void Closest_approaches<Traits>::end(const Edge_ids& pair, const Algebraic_number& time) {
  const auto piece = pieces_.find(pair);
  if (piece == pieces_.end()) return;
  examine(pair, piece->second, time);
  if (!piece->second.is_edge) {
    overlaps_.erase({pair[0], pair[1]});
    overlaps_.erase({pair[1], pair[0]});
  }
  pieces_.erase(piece);
}

// New motions, perhaps: the pieces so far end, with the motions that they had. Those of edges are
// begun here, those of overlaps when these are known.
template <HasLinearMotion Traits>
void Closest_approaches<Traits>::turn(Point_id id, const Algebraic_number& time) {
  std::vector<Edge_ids> ended;
  const auto add_if_turned = [&](Point_id other, bool is_edge) {
    const Edge_ids pair = edge_ids(id, other);
    const auto piece = pieces_.find(pair);
    // An edge without a piece is yet to be reported.
    if (piece != pieces_.end() && piece->second.is_edge == is_edge &&
        has_turned(pair, piece->second)) {
      ended.push_back(pair);
    }
  };
  const auto& triangulation = simulation_.triangulation();
  if (triangulation.contains(id) && !triangulation.is_hidden(id)) {
    detail::for_each_neighbor(triangulation.triangulation(), triangulation.vertex(id),
                              [&](auto neighbor) { add_if_turned(neighbor->point().id(), true); });
  }
  const std::size_t edges = ended.size();
  for (auto other = overlaps_.lower_bound({id, 0}); other != overlaps_.end() && other->first == id;
       ++other) {
    add_if_turned(other->second, false);
  }
  for (const Edge_ids& pair : ended) end(pair, time);
  for (std::size_t i = 0; i < edges; ++i) begin(ended[i], time, true);
}

// ---- the nearest of them ----

template <HasLinearMotion Traits>
void Closest_approaches<Traits>::examine(const Edge_ids& pair, const Piece& piece,
                                         const Algebraic_number& until) {
  const auto& [p, q, since, is_edge] = piece;
  const Double_interval times = {since.interval().lower, until.interval().upper};
  if (is_certainly_farther(p, q, times, limit_)) return;
  const Algebraic_number time = time_of_least_gap(p, q, since, until);
  keep({pair, time, p, q, gap_bounds(p, q, time.interval()), std::nullopt});
}

template <HasLinearMotion Traits>
const Algebraic_number& Closest_approaches<Traits>::gap(const Candidate& candidate) {
  if (!candidate.gap) {
    candidate.gap = root_difference_at(squared_distance(candidate.p, candidate.q),
                                       reach(candidate.p, candidate.q), candidate.time);
  }
  return *candidate.gap;
}

template <HasLinearMotion Traits>
bool Closest_approaches<Traits>::is_nearer(const Candidate& a, const Candidate& b) {
  if (a.gap_bounds.upper < b.gap_bounds.lower) return true;
  if (b.gap_bounds.upper < a.gap_bounds.lower) return false;
  const auto order = compare(gap(a), gap(b));
  if (order != CGAL::EQUAL) return order == CGAL::SMALLER;
  if (a.time != b.time) return a.time < b.time;
  return a.points < b.points;
}

template <HasLinearMotion Traits>
void Closest_approaches<Traits>::keep(Candidate candidate) {
  const auto known = nearest_.find(candidate.points);
  if (known == nearest_.end()) {
    nearest_.emplace(candidate.points, std::move(candidate));
    if (nearest_.size() > 4 * number_ + 1000) drop_all_but_nearest();
  } else if (is_nearer(candidate, known->second)) {
    known->second = std::move(candidate);
  }
}

template <HasLinearMotion Traits>
void Closest_approaches<Traits>::drop_all_but_nearest() {
  if (nearest_.size() < number_) return;
  std::vector<const Candidate*> candidates;
  for (const auto& [pair, candidate] : nearest_) candidates.push_back(&candidate);
  const auto last = candidates.begin() + static_cast<std::ptrdiff_t>(number_ - 1);
  std::ranges::nth_element(candidates, last,
                           [](const auto* a, const auto* b) { return is_nearer(*a, *b); });
  limit_ = (*last)->gap_bounds.upper;
  std::vector<Edge_ids> dropped;
  for (auto other = last + 1; other != candidates.end(); ++other) {
    dropped.push_back((*other)->points);
  }
  for (const Edge_ids& pair : dropped) nearest_.erase(pair);
}

template class Closest_approaches<Linear_kinetic_traits_2>;
template class Closest_approaches<Disc_kinetic_traits_2>;

}  // namespace kinetri
