// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/closest_approaches.h"

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "algebra/value_at.h"
#include "kinetri/base/check.h"
#include "kinetri/triangulation/detail/incident.h"

namespace kinetri {
namespace {

// ---- bounds, by interval arithmetic ----

using Interval = CGAL::Interval_nt<false>;
using Upward_rounding = CGAL::Protect_FPU_rounding<true>;

// The vector from q to p, and its derivative.
struct Relative_motion {
  Interval x;
  Interval y;
  Interval vx;
  Interval vy;

  // At the time t. Precondition: an Upward_rounding is in force.
  Relative_motion(const Linear_motion_2& p, const Linear_motion_2& q, const Interval& t)
      : x(coordinate(p.position.x, p.velocity.x, p.epoch, t) -
          coordinate(q.position.x, q.velocity.x, q.epoch, t)),
        y(coordinate(p.position.y, p.velocity.y, p.epoch, t) -
          coordinate(q.position.y, q.velocity.y, q.epoch, t)),
        vx(Interval(p.velocity.x) - Interval(q.velocity.x)),
        vy(Interval(p.velocity.y) - Interval(q.velocity.y)) {}

  Interval squared_distance() const { return CGAL::square(x) + CGAL::square(y); }
  Interval half_slope() const { return x * vx + y * vy; }

 private:
  static Interval coordinate(double position, double velocity, double epoch, const Interval& t) {
    return Interval(position) + Interval(velocity) * (t - Interval(epoch));
  }
};

bool is_finite(const Double_interval& interval) {
  return std::isfinite(interval.lower) && std::isfinite(interval.upper);
}

// Bounds of the squared distance at a time.
Double_interval squared_distance_bounds(const Linear_motion_2& p, const Linear_motion_2& q,
                                        const Double_interval& time) {
  constexpr Double_interval everything = {0, std::numeric_limits<double>::infinity()};
  if (!is_finite(time)) return everything;
  const Upward_rounding protection;
  const Interval result =
      Relative_motion(p, q, Interval(time.lower, time.upper)).squared_distance();
  if (!(result.inf() <= result.sup())) return everything;  // an overflow
  return {std::max(result.inf(), 0.0), result.sup()};
}

// Whether the squared distance is greater than `limit` at every one of the times, proved: it is a
// convex function, and so nowhere below its tangent at the time s; s is about where it is least,
// but any time is right.
bool is_certainly_farther(const Linear_motion_2& p, const Linear_motion_2& q,
                          const Double_interval& times, double limit) {
  if (!is_finite(times)) return false;
  const Upward_rounding protection;
  const Relative_motion at_begin(p, q, Interval(times.lower));
  const double speed = (CGAL::square(at_begin.vx) + CGAL::square(at_begin.vy)).sup();
  double s = times.lower;
  if (speed > 0) s = std::clamp(s - at_begin.half_slope().sup() / speed, s, times.upper);
  if (!std::isfinite(s)) return false;
  const Relative_motion at_s(p, q, Interval(s));
  const Interval tangent =
      at_s.squared_distance() +
      Interval(2) * at_s.half_slope() * (Interval(times.lower, times.upper) - Interval(s));
  return tangent.inf() > limit;  // false where it is not a number
}

// ---- the same, exactly ----

Rational constant_term(double position, double velocity, double epoch) {
  return to_rational(position) - to_rational(velocity) * to_rational(epoch);
}

// The squared distance as a polynomial in time, by ascending power.
std::array<Rational, 3> squared_distance_polynomial(const Linear_motion_2& p,
                                                    const Linear_motion_2& q) {
  const Rational x = constant_term(p.position.x, p.velocity.x, p.epoch) -
                     constant_term(q.position.x, q.velocity.x, q.epoch);
  const Rational y = constant_term(p.position.y, p.velocity.y, p.epoch) -
                     constant_term(q.position.y, q.velocity.y, q.epoch);
  const Rational vx = to_rational(p.velocity.x) - to_rational(q.velocity.x);
  const Rational vy = to_rational(p.velocity.y) - to_rational(q.velocity.y);
  return {x * x + y * y, 2 * (x * vx + y * vy), vx * vx + vy * vy};
}

// The binary64 number nearest to the square root, ties to even. Those that are not negative are in
// the order of their representations, so that a representation is what is searched for.
double rounded_square_root(const Algebraic_number& squared) {
  constexpr auto infinite = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
  const auto number = [](std::uint64_t bits) {
    return bits == infinite ? scaled_by_power_of_two(1, 1024)  // what would come after the largest
                            : to_rational(std::bit_cast<double>(bits));
  };
  const auto is_at_most_root = [&](std::uint64_t bits) {
    const Rational x = number(bits);
    return compare(squared, x * x) != CGAL::SMALLER;
  };
  // From a guess to bounds with lower <= root < upper, by steps that double.
  const std::uint64_t guess = std::min(
      std::bit_cast<std::uint64_t>(std::sqrt(std::max(squared.to_double(), 0.0))), infinite - 1);
  std::uint64_t lower = guess;
  for (std::uint64_t step = 1; lower > 0 && !is_at_most_root(lower); step *= 2) {
    lower -= std::min(step, lower);
  }
  std::uint64_t upper = lower + 1;
  for (std::uint64_t step = 1; upper < infinite && is_at_most_root(upper); step *= 2) {
    lower = upper;
    upper += std::min(step, infinite - upper);
  }
  while (upper - lower > 1) {
    const std::uint64_t middle = lower + (upper - lower) / 2;
    (is_at_most_root(middle) ? lower : upper) = middle;
  }
  const Rational middle = (number(lower) + number(upper)) / 2;
  const auto to_middle = compare(squared, middle * middle);
  const bool is_up = to_middle == CGAL::LARGER || (to_middle == CGAL::EQUAL && lower % 2 == 1);
  return std::bit_cast<double>(is_up ? upper : lower);
}

}  // namespace

Closest_approaches::Closest_approaches(Simulation_2<>& simulation, std::size_t number)
    : simulation_(simulation),
      number_(number),
      squared_limit_(std::numeric_limits<double>::infinity()) {
  KINETRI_PRECONDITION(number > 0, "no approach is asked for");
  for (const Edge_ids& edge : simulation_.triangulation().finite_edge_ids()) {
    begin(edge, simulation_.current_time());
  }
  simulation_.add_observer(*this);
}

Closest_approaches::~Closest_approaches() {
  simulation_.remove_observer(*this);
}

std::vector<Approach> Closest_approaches::approaches() {
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
    result.push_back(
        {candidate->points, candidate->time, rounded_square_root(squared_distance(*candidate))});
  }
  return result;
}

void Closest_approaches::before_event(const Event& event) {
  if (event.removed) end(*event.removed, event.time);
}

void Closest_approaches::after_event(const Event& event) {
  if (event.added) begin(*event.added, event.time);
  // New motions: the pieces so far end, with the motions that they had.
  for (const std::optional<Point_id>& id : {event.point_a, event.point_b}) {
    if (!id || !simulation_.triangulation().contains(*id)) continue;
    for_each_pair_of(*id, [&](const Edge_ids& pair) {
      if (!pieces_.contains(pair)) return;  // its edge is yet to be reported
      end(pair, event.time);
      begin(pair, event.time);
    });
  }
}

template <class Function>
void Closest_approaches::for_each_pair_of(Point_id id, Function function) const {
  const auto& triangulation = simulation_.triangulation();
  detail::for_each_neighbor(triangulation.triangulation(), triangulation.vertex(id),
                            [&](auto neighbor) { function(edge_ids(id, neighbor->point().id())); });
}

void Closest_approaches::begin(const Edge_ids& pair, const Algebraic_number& time) {
  const auto& triangulation = simulation_.triangulation();
  pieces_.insert_or_assign(
      pair, Piece{triangulation.motion(pair[0]), triangulation.motion(pair[1]), time});
}

void Closest_approaches::end(const Edge_ids& pair, const Algebraic_number& time) {
  const auto piece = pieces_.find(pair);
  if (piece == pieces_.end()) return;
  examine(pair, piece->second, time);
  pieces_.erase(piece);
}

// The squared distance is a convex quadratic: nearest where its slope vanishes, or at an end.
void Closest_approaches::examine(const Edge_ids& pair, const Piece& piece,
                                 const Algebraic_number& until) {
  const Double_interval times = {piece.since.interval().lower, until.interval().upper};
  if (is_certainly_farther(piece.p, piece.q, times, squared_limit_)) return;
  const auto [c, b, a] = squared_distance_polynomial(piece.p, piece.q);
  Algebraic_number time = piece.since;
  if (a != 0) {
    const Algebraic_number least(Rational(-b / (2 * a)));
    time = least < piece.since ? piece.since : least > until ? until : least;
  }
  keep({pair, time, piece.p, piece.q, squared_distance_bounds(piece.p, piece.q, time.interval()),
        std::nullopt});
}

const Algebraic_number& Closest_approaches::squared_distance(const Candidate& candidate) {
  if (!candidate.squared_distance) {
    candidate.squared_distance =
        value_at(squared_distance_polynomial(candidate.p, candidate.q), candidate.time);
  }
  return *candidate.squared_distance;
}

bool Closest_approaches::is_nearer(const Candidate& a, const Candidate& b) {
  if (a.squared_bounds.upper < b.squared_bounds.lower) return true;
  if (b.squared_bounds.upper < a.squared_bounds.lower) return false;
  const auto order = compare(squared_distance(a), squared_distance(b));
  if (order != CGAL::EQUAL) return order == CGAL::SMALLER;
  if (a.time != b.time) return a.time < b.time;
  return a.points < b.points;
}

void Closest_approaches::keep(Candidate candidate) {
  const auto known = nearest_.find(candidate.points);
  if (known == nearest_.end()) {
    nearest_.emplace(candidate.points, std::move(candidate));
    if (nearest_.size() > 4 * number_ + 1000) drop_all_but_nearest();
  } else if (is_nearer(candidate, known->second)) {
    known->second = std::move(candidate);
  }
}

void Closest_approaches::drop_all_but_nearest() {
  if (nearest_.size() < number_) return;
  std::vector<const Candidate*> candidates;
  for (const auto& [pair, candidate] : nearest_) candidates.push_back(&candidate);
  const auto last = candidates.begin() + static_cast<std::ptrdiff_t>(number_ - 1);
  std::ranges::nth_element(candidates, last,
                           [](const auto* a, const auto* b) { return is_nearer(*a, *b); });
  squared_limit_ = (*last)->squared_bounds.upper;
  std::vector<Edge_ids> dropped;
  for (auto other = last + 1; other != candidates.end(); ++other) {
    dropped.push_back((*other)->points);
  }
  for (const Edge_ids& pair : dropped) nearest_.erase(pair);
}

}  // namespace kinetri
