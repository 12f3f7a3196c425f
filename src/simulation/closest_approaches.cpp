// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/closest_approaches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "kinetri/base/check.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double distance_at(const Linear_motion_2& p, const Linear_motion_2& q, double time) {
  const Vector_2 a = rounded_place(p, time);
  const Vector_2 b = rounded_place(q, time);
  return std::hypot(a.x - b.x, a.y - b.y);
}

bool is_nearer(const Approach& a, const Approach& b) {
  if (a.distance != b.distance) return a.distance < b.distance;
  if (a.time != b.time) return a.time < b.time;
  return a.points < b.points;
}

}  // namespace

Closest_approaches::Closest_approaches(Simulation_2<>& simulation, std::size_t number)
    : simulation_(simulation), number_(number), limit_(infinity) {
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
    look_at(pair, piece, simulation_.current_time());
    piece.since = simulation_.current_time();
  }
  std::vector<Approach> result;
  for (const auto& [pair, approach] : nearest_) result.push_back(approach);
  std::ranges::sort(result, is_nearer);
  if (result.size() > number_) result.resize(number_);
  return result;
}

void Closest_approaches::before_event(const Event<Algebraic_number>& event) {
  if (event.removed) end(*event.removed, event.time);
}

void Closest_approaches::after_event(const Event<Algebraic_number>& event) {
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
  const auto& topology = simulation_.triangulation().triangulation();
  if (topology.dimension() < 1) return;
  auto neighbor = topology.incident_vertices(simulation_.triangulation().vertex(id));
  const auto first = neighbor;
  do {
    if (!topology.is_infinite(neighbor)) function(edge_ids(id, neighbor->point().id()));
  } while (++neighbor != first);
}

void Closest_approaches::begin(const Edge_ids& pair, const Algebraic_number& time) {
  const auto& triangulation = simulation_.triangulation();
  pieces_.insert_or_assign(
      pair, Piece{triangulation.motion(pair[0]), triangulation.motion(pair[1]), time});
}

void Closest_approaches::end(const Edge_ids& pair, const Algebraic_number& time) {
  const auto piece = pieces_.find(pair);
  if (piece == pieces_.end()) return;
  look_at(pair, piece->second, time);
  pieces_.erase(piece);
}

// The squared distance is a convex quadratic: nearest where its slope vanishes, or at an end.
void Closest_approaches::look_at(const Edge_ids& pair, const Piece& piece,
                                 const Algebraic_number& until) {
  // Roughly first: mostly it is far.
  const double from = piece.since.interval().lower;
  const double to = until.interval().upper;
  const Vector_2 a = rounded_place(piece.p, from);
  const Vector_2 b = rounded_place(piece.q, from);
  const double x = a.x - b.x;
  const double y = a.y - b.y;
  const double vx = piece.p.velocity.x - piece.q.velocity.x;
  const double vy = piece.p.velocity.y - piece.q.velocity.y;
  const double speed = vx * vx + vy * vy;
  const double elapsed = speed > 0 ? std::clamp(-(x * vx + y * vy) / speed, 0.0, to - from) : 0;
  if (std::hypot(x + vx * elapsed, y + vy * elapsed) > limit_ * (1 + 0x1p-20)) return;

  const Polynomial slope =
      derivative(contact_polynomial(Moving_point_2(piece.p), Moving_point_2(piece.q), 0));
  Algebraic_number time = piece.since;
  if (slope.degree() == 1) {
    const Algebraic_number least(Rational(-slope[0], slope[1]));
    time = least < piece.since ? piece.since : least > until ? until : least;
  }
  keep({pair, time, distance_at(piece.p, piece.q, time.to_double())});
}

void Closest_approaches::keep(const Approach& approach) {
  const auto [known, is_new] = nearest_.emplace(approach.points, approach);
  if (!is_new && is_nearer(approach, known->second)) known->second = approach;
  if (is_new && nearest_.size() > 4 * number_ + 1000) forget_far_ones();
}

void Closest_approaches::forget_far_ones() {
  std::vector<double> distances;
  for (const auto& [pair, approach] : nearest_) distances.push_back(approach.distance);
  const auto last = distances.begin() + static_cast<std::ptrdiff_t>(number_ - 1);
  std::ranges::nth_element(distances, last);
  limit_ = *last;
  std::erase_if(nearest_, [&](const auto& entry) { return entry.second.distance > limit_; });
}

}  // namespace kinetri
