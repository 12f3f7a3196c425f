// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/neighbor_lives.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "observers/edge_follower.h"

namespace kinetri {
namespace {

// The position equidistant to the three points: the circumcenter, or with weights the power center.
template <class Point>
Trajectory_2 center(const Point& p, const Point& q, const Point& r) {
  if constexpr (HasWeight<typename Point::Motion>) {
    return weighted_circumcenter_trajectory(p, q, r);
  } else {
    return circumcenter_trajectory(p, q, r);
  }
}

// Negative when two positions are nearer than `distance`, positive when they are farther apart. The
// squared distance is the quotient of two nonnegative polynomials. They have a common root when
// corners of a triangle meet; the distance is the limit then, so their common divisor, also
// nonnegative, is divided out.
Polynomial distance_polynomial(const Trajectory_2& a, const Trajectory_2& b, double distance) {
  const Rational exact = to_rational(distance);
  const Polynomial x = a.x * b.w - b.x * a.w;
  const Polynomial y = a.y * b.w - b.y * a.w;
  const Polynomial w = a.w * b.w;
  const Integer one = denominator(exact);
  const Integer length = numerator(exact);
  const Polynomial excess =
      primitive_part((x * x + y * y) * Integer(one * one) - w * w * Integer(length * length));
  return excess.is_zero() ? excess : exact_quotient(excess, gcd(excess, w * w));
}

// ---- bounds, by interval arithmetic ----

using Interval = CGAL::Interval_nt<>;

struct Interval_point {
  Interval x;
  Interval y;
  Interval weight;
};

template <class Motion>
Interval_point interval_point(const Motion& motion, double t) {
  const Linear_motion_2& path = center(motion);
  const Interval elapsed = Interval(t) - Interval(path.epoch);
  Interval_point result = {path.position.x + path.velocity.x * elapsed,
                           path.position.y + path.velocity.y * elapsed, 0};
  if constexpr (HasWeight<Motion>) {
    result.weight = CGAL::square(motion.radius + motion.growth * elapsed) + motion.weight;
  }
  return result;
}

// Whether the centers of the triangles p, q, r and p, q, s are certainly at least `distance` apart
// at the time t.
template <class Motion>
bool are_certainly_apart(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                         double distance, double t) {
  const Interval_point a = interval_point(p, t);
  const auto center = [&](const Motion& third) {
    const Interval_point b = interval_point(q, t);
    const Interval_point c = interval_point(third, t);
    const Interval bx = b.x - a.x;
    const Interval by = b.y - a.y;
    const Interval cx = c.x - a.x;
    const Interval cy = c.y - a.y;
    const Interval of_b = CGAL::square(bx) + CGAL::square(by) - b.weight + a.weight;
    const Interval of_c = CGAL::square(cx) + CGAL::square(cy) - c.weight + a.weight;
    const Interval denominator = 2 * (bx * cy - by * cx);
    return std::pair((cy * of_b - by * of_c) / denominator, (bx * of_c - cx * of_b) / denominator);
  };
  const auto [x1, y1] = center(r);
  const auto [x2, y2] = center(s);
  const Interval squared = CGAL::square(x1 - x2) + CGAL::square(y1 - y2);
  return squared.inf() >= CGAL::square(Interval(distance)).sup();
}

}  // namespace

const char* name(Life_limit limit) {
  switch (limit) {
    case Life_limit::run:
      return "run";
    case Life_limit::point:
      return "point";
    default:
      return "exchange";
  }
}

namespace detail {

// Follows the triangles at the edges, and records when edges begin and end.
template <ContactKineticTraits_2 Traits>
class Life_recorder final : private Edge_follower<Traits> {
 public:
  using Time = Algebraic_number;
  using Triangulation = Kinetic_triangulation_2<Traits>;

  Life_recorder(Simulation_2<Traits>& simulation, std::optional<double> ridge_threshold);
  Life_recorder(Triangulation& triangulation, std::optional<double> ridge_threshold);

  std::vector<Neighbor_life> lives();
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
    Index replaced = none;     // the lifetime that the exchange has ended
    Index replaced_by = none;  // the one that has begun instead
  };

  /// A present edge. All but `index` is kept with a threshold only.
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
  // Of the change in progress: the former neighbors of changed points, and removed edges.
  std::vector<std::pair<Point_id, std::vector<Point_id>>> neighbors_before_;
  std::map<Edge_ids, Present> ended_;
};

template <ContactKineticTraits_2 Traits>
Life_recorder<Traits>::Life_recorder(Simulation_2<Traits>& simulation,
                                     std::optional<double> ridge_threshold)
    : Base(simulation), threshold_(ridge_threshold) {
  start();
}

template <ContactKineticTraits_2 Traits>
Life_recorder<Traits>::Life_recorder(Triangulation& triangulation,
                                     std::optional<double> ridge_threshold)
    : Base(triangulation), threshold_(ridge_threshold) {
  start();
}

template <ContactKineticTraits_2 Traits>
void Life_recorder<Traits>::start() {
  KINETRI_PRECONDITION(!threshold_ || (std::isfinite(*threshold_) && *threshold_ > 0),
                       "the threshold of ridges is not positive and finite");
  now_ = this->triangulation().current_time();
  for (Point_id id = 0; id < this->graph().next_id(); ++id) {
    if (this->graph().contains(id)) presences_.emplace(id, Presence{now_, std::nullopt});
  }
  for (const Edge_ids& edge : this->graph().edges()) {
    Present present;
    present.index = lives_.size();
    present.since = now_;
    if (threshold_) present.opposite = opposite(edge);
    present_.emplace(edge, std::move(present));
    lives_.push_back({{edge, now_, now_}});
  }
}

// ---- answers ----

template <ContactKineticTraits_2 Traits>
std::vector<Neighbor_life> Life_recorder<Traits>::lives() {
  this->update();
  const Time& now = this->triangulation().current_time();
  const std::vector<bool> is_short = short_lives();
  std::vector<Neighbor_life> result;
  for (Index i = 0; i < lives_.size(); ++i) {
    Neighbor_life life = lives_[i].life;
    if (!lives_[i].has_ended) life.end = now;
    life.is_short = is_short[i];
    if (life.begin != life.end) result.push_back(std::move(life));
  }
  std::ranges::stable_sort(result, [](const Neighbor_life& a, const Neighbor_life& b) {
    return std::tie(a.begin, a.points) < std::tie(b.begin, b.points);
  });
  return result;
}

template <ContactKineticTraits_2 Traits>
std::vector<Point_exchanges> Life_recorder<Traits>::exchanges() {
  this->update();
  const Time& now = this->triangulation().current_time();
  std::map<Point_id, Point_exchanges> of_points;
  for (const auto& [id, presence] : presences_) {
    of_points[id] = {id, presence.from, presence.until.value_or(now)};
  }
  const std::vector<bool> is_short = short_lives();
  const auto is_short_too = [&](Index i) { return i != none && is_short[i]; };
  for (Index i = 0; i < lives_.size(); ++i) {
    const auto& [life, has_ended, replaced, replaced_by] = lives_[i];
    for (const Point_id id : life.points) {
      Point_exchanges& counts = of_points[id];
      if (life.begins_by == Life_limit::exchange) {
        ++counts.gained;
        if (is_short[i] || is_short_too(replaced)) ++counts.short_ones;
      }
      if (life.ends_by == Life_limit::exchange) {
        ++counts.lost;
        if (is_short[i] || is_short_too(replaced_by)) ++counts.short_ones;
      }
    }
  }
  std::vector<Point_exchanges> result;
  for (const auto& [id, counts] : of_points) result.push_back(counts);
  return result;
}

// Whether each lifetime is short up to now.
template <ContactKineticTraits_2 Traits>
std::vector<bool> Life_recorder<Traits>::short_lives() const {
  std::vector<bool> result(lives_.size(), false);
  for (Index i = 0; i < lives_.size(); ++i) result[i] = lives_[i].life.is_short;
  if (!threshold_) return result;
  const Time& now = this->triangulation().current_time();
  for (const auto& [edge, present] : present_) {
    result[present.index] = !present.is_long && !reaches_threshold(edge, present, now);
  }
  return result;
}

// ---- called by the base ----

template <ContactKineticTraits_2 Traits>
void Life_recorder<Traits>::before_change(std::span<const Edge_ids> removed,
                                          std::span<const Changed_point> points) {
  const auto& graph = this->graph();
  neighbors_before_.clear();
  for (const Changed_point& changed : points) {
    if (!changed.before) continue;
    const auto neighbors = graph.neighbors(changed.id);
    neighbors_before_.emplace_back(changed.id,
                                   std::vector<Point_id>(neighbors.begin(), neighbors.end()));
    if (!threshold_) continue;
    // The ridges that depend on the motion: of its edges, and of those opposite to it.
    for (const Point_id other : neighbors) {
      end_piece(edge_ids(changed.id, other));
      for (const Point_id third : common_neighbors(changed.id, other)) {
        end_piece(edge_ids(other, third));
      }
    }
  }
  ended_.clear();
  for (const Edge_ids& edge : removed) {
    end_piece(edge);
    ended_.insert(present_.extract(edge));
  }
}

template <ContactKineticTraits_2 Traits>
void Life_recorder<Traits>::change(const Time& time, std::span<const Edge_ids> removed,
                                   std::span<const Edge_ids> added,
                                   std::span<const Changed_point> points) {
  const auto& graph = this->graph();
  now_ = time;
  // Inserted and erased points, and their neighbors.
  std::set<Point_id> near;
  for (const auto& [id, neighbors] : neighbors_before_) {
    if (graph.contains(id)) continue;
    near.insert(id);
    near.insert(neighbors.begin(), neighbors.end());
    presences_.at(id).until = time;
  }
  for (const Changed_point& changed : points) {
    if (changed.before) continue;
    near.insert(changed.id);
    const auto neighbors = graph.neighbors(changed.id);
    near.insert(neighbors.begin(), neighbors.end());
    presences_.insert_or_assign(changed.id, Presence{time, std::nullopt});
  }
  const auto limit = [&](const Edge_ids& edge) {
    return near.contains(edge[0]) && near.contains(edge[1]) ? Life_limit::point
                                                            : Life_limit::exchange;
  };
  for (const Edge_ids& edge : removed) {
    const Present& present = ended_.at(edge);
    Life& ended = lives_[present.index];
    ended.has_ended = true;
    ended.life.end = time;
    ended.life.ends_by = limit(edge);
    ended.life.is_short = threshold_.has_value() && !present.is_long;
  }
  for (const Edge_ids& edge : added) {
    Present present;
    present.index = lives_.size();
    present.since = time;
    present_.emplace(edge, std::move(present));
    lives_.push_back({{edge, time, time, limit(edge)}});
  }
  if (threshold_) follow_opposites(removed, added);
}

// When points meet, triangles may change although no edge does.
template <ContactKineticTraits_2 Traits>
void Life_recorder<Traits>::change_triangles(std::span<const Edge_ids> edges) {
  if (!threshold_) return;
  std::set<Point_id> around;
  add_points_around(edges, around);
  update_opposites(around);
}

// Updates the triangles at edges near added and removed ones.
template <ContactKineticTraits_2 Traits>
void Life_recorder<Traits>::follow_opposites(std::span<const Edge_ids> removed,
                                             std::span<const Edge_ids> added) {
  std::set<Point_id> around;
  add_points_around(removed, around);
  add_points_around(added, around);
  update_opposites(around);
  for (const Edge_ids& edge : added) {
    const Present& present = present_.at(edge);
    const auto replaced = ended_.find(present.opposite);
    if (replaced == ended_.end() || replaced->second.opposite != edge) continue;
    lives_[present.index].replaced = replaced->second.index;
    lives_[replaced->second.index].replaced_by = present.index;
  }
}

// Adds the ends of edges and their common neighbors; of an erased point, the other ends of its
// edges.
template <ContactKineticTraits_2 Traits>
void Life_recorder<Traits>::add_points_around(std::span<const Edge_ids> edges,
                                              std::set<Point_id>& around) const {
  const auto& graph = this->graph();
  for (const Edge_ids& edge : edges) {
    for (const Point_id id : edge) {
      if (graph.contains(id)) around.insert(id);
    }
    if (!graph.contains(edge[0]) || !graph.contains(edge[1])) continue;
    const auto between = common_neighbors(edge[0], edge[1]);
    around.insert(between.begin(), between.end());
  }
}

// Updates the triangles of all edges between these points.
template <ContactKineticTraits_2 Traits>
void Life_recorder<Traits>::update_opposites(const std::set<Point_id>& around) {
  const auto& graph = this->graph();
  for (const Point_id id : around) {
    for (const Point_id other : graph.neighbors(id)) {
      if (other < id || !around.contains(other)) continue;
      const Edge_ids edge = {id, other};
      const Opposite now = opposite(edge);
      Present& present = present_.at(edge);
      if (present.opposite == now) continue;
      if (present.since != now_) end_piece(edge);
      present.opposite = now;
      present.since = now_;
    }
  }
}

// ---- ridges ----

template <ContactKineticTraits_2 Traits>
std::vector<Point_id> Life_recorder<Traits>::common_neighbors(Point_id a, Point_id b) const {
  const auto of_b = this->graph().neighbors(b);
  std::vector<Point_id> result;
  std::ranges::copy_if(this->graph().neighbors(a), std::back_inserter(result),
                       [&](Point_id id) { return std::ranges::find(of_b, id) != of_b.end(); });
  return result;
}

// The third points of the triangles at an edge just after now: on each side the common neighbor
// whose circle contains no other one. It is unique even among cocircular ones: edges from two of
// them to both ends would cross.
template <ContactKineticTraits_2 Traits>
auto Life_recorder<Traits>::opposite(const Edge_ids& edge) const -> Opposite {
  const auto& graph = this->graph();
  const auto instantaneous = this->traits().instantaneous_traits(Instant{now_, Time_side::after});
  const auto orientation = instantaneous.orientation_2_object();
  const auto side_of_circle = instantaneous.side_of_oriented_circle_2_object();
  Opposite result = {no_point, no_point};
  const std::vector<Point_id> candidates = common_neighbors(edge[0], edge[1]);
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    const Point_2& p = graph.point(edge[side]);
    const Point_2& q = graph.point(edge[1 - side]);
    for (const Point_id id : candidates) {
      const Point_2& r = graph.point(id);
      if (orientation(p, q, r) != CGAL::LEFT_TURN) continue;
      if (result[side] == no_point ||
          side_of_circle(p, q, graph.point(result[side]), r) == CGAL::ON_POSITIVE_SIDE) {
        result[side] = id;
      }
    }
  }
  std::ranges::sort(result);
  return result;
}

// The quadrilateral of the edge, or one of its motions, ends now.
template <ContactKineticTraits_2 Traits>
void Life_recorder<Traits>::end_piece(const Edge_ids& edge) {
  if (!threshold_) return;
  const auto found = present_.find(edge);
  if (found == present_.end()) return;
  Present& present = found->second;
  if (!present.is_long) present.is_long = reaches_threshold(edge, present, now_);
  present.since = now_;
}

// Whether the ridge reaches the threshold at a time since the present piece began.
template <ContactKineticTraits_2 Traits>
bool Life_recorder<Traits>::reaches_threshold(const Edge_ids& edge, const Present& present,
                                              const Time& until) const {
  if (present.since == until) return false;
  if (present.opposite[1] == no_point) return true;
  const auto& graph = this->graph();
  const auto center_at = [&](Point_id id) {
    return center(graph.point(edge[0]), graph.point(edge[1]), graph.point(id));
  };
  if constexpr (std::same_as<Center_motion_of<Motion>, Linear_motion_2>) {
    const double from = present.since.interval().upper;
    const double to = until.interval().lower;
    const auto motion = [&](Point_id id) -> const Motion& { return graph.point(id).motion(); };
    for (const double share : {0.5, 0.125, 0.875}) {
      const double t = from + share * (to - from);
      if (t >= from && t <= to &&
          are_certainly_apart(motion(edge[0]), motion(edge[1]), motion(present.opposite[0]),
                              motion(present.opposite[1]), *threshold_, t)) {
        return true;
      }
    }
  }
  const Polynomial excess = distance_polynomial(center_at(present.opposite[0]),
                                                center_at(present.opposite[1]), *threshold_);
  if (sign_at(excess, until) != CGAL::NEGATIVE) return true;
  if (sign_at(excess, present.since) != CGAL::NEGATIVE) return true;
  if (excess.sign_at(simplest_between(present.since, until)) != CGAL::NEGATIVE) return true;
  const auto root = first_root_after(excess, present.since);
  return root && root->value < until;
}

}  // namespace detail

template <ContactKineticTraits_2 Traits>
Neighbor_lives<Traits>::Neighbor_lives(Simulation_2<Traits>& simulation,
                                       std::optional<double> ridge_threshold)
    : recorder_(std::make_unique<detail::Life_recorder<Traits>>(simulation, ridge_threshold)) {}

template <ContactKineticTraits_2 Traits>
Neighbor_lives<Traits>::Neighbor_lives(Triangulation& triangulation,
                                       std::optional<double> ridge_threshold)
    : recorder_(std::make_unique<detail::Life_recorder<Traits>>(triangulation, ridge_threshold)) {}

template <ContactKineticTraits_2 Traits>
Neighbor_lives<Traits>::~Neighbor_lives() = default;

template <ContactKineticTraits_2 Traits>
std::vector<Neighbor_life> Neighbor_lives<Traits>::lives() {
  return recorder_->lives();
}

template <ContactKineticTraits_2 Traits>
std::vector<Point_exchanges> Neighbor_lives<Traits>::exchanges() {
  return recorder_->exchanges();
}

template class Neighbor_lives<Linear_kinetic_traits_2>;
template class Neighbor_lives<Polynomial_kinetic_traits_2>;
template class Neighbor_lives<Disc_kinetic_traits_2>;
template class Neighbor_lives<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri
