// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/neighbor_lives.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
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

Interval_point interval_place(const Linear_motion_2& path, double t) {
  const Interval elapsed = Interval(t) - Interval(path.epoch);
  return {path.position.x + path.velocity.x * elapsed, path.position.y + path.velocity.y * elapsed,
          0};
}

Interval_point interval_place(const Image_motion_2& image, double t) {
  Interval_point result = interval_place(image.motion, t);
  const auto add = [&](double times, const Linear_motion_2& vector) {
    const Interval_point there = interval_place(vector, t);
    result.x += times * there.x;
    result.y += times * there.y;
  };
  if (image.offset.x != 0) add(image.offset.x, image.box->first());
  if (image.offset.y != 0) add(image.offset.y, image.box->second());
  return result;
}

template <class Motion>
Interval_point interval_point(const Motion& motion, double t) {
  Interval_point result = interval_place(center(motion), t);
  if constexpr (HasWeight<Motion>) {
    const Interval elapsed = Interval(t) - Interval(epoch_of(motion));
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
template <DistanceKineticTraits_2 Traits>
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
  using typename Base::Edge_name;
  using typename Base::Image_2;
  using typename Base::Neighbor;
  using Motion = typename Image_2::Motion;
  using Index = std::size_t;
  // Sorted, as the first end of the edge sees them; no_neighbor for the infinite vertex.
  using Opposite = std::array<Neighbor, 2>;

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
    // The points of the triangles at the edge ...
    Opposite opposite = {no_neighbor<Traits>(), no_neighbor<Traits>()};
    Time since;            // ... from then on
    bool is_long = false;  // the ridge has reached the threshold
  };

  struct Presence {
    Time from;
    std::optional<Time> until;
  };

  void start();
  void advance(const Time& time) override { now_ = time; }
  void before_change(std::span<const Edge_name> removed,
                     std::span<const Changed_point> points) override;
  void change(const Time& time, std::span<const Edge_name> removed,
              std::span<const Edge_name> added, std::span<const Changed_point> points) override;
  void change_triangles(std::span<const Edge_ids> edges) override;

  static Life new_life(const Edge_name& edge, const Time& begin, Life_limit begins_by) {
    return {{ids_of(edge), begin, begin, begins_by, Life_limit::run, false, offset_of(edge)}};
  }
  void follow_opposites(std::span<const Edge_name> removed, std::span<const Edge_name> added);
  template <class Name>
  void add_points_around(std::span<const Name> edges, std::set<Point_id>& around) const;
  void update_opposites(const std::set<Point_id>& around);
  std::vector<Neighbor> common_neighbors(Point_id id, const Neighbor& other) const;
  Opposite opposite(const Edge_name& edge) const;
  void end_piece(const Edge_name& edge);
  bool reaches_threshold(const Edge_name& edge, const Present& present, const Time& until) const;
  std::vector<bool> short_lives() const;

  std::optional<double> threshold_;
  Time now_;
  std::vector<Life> lives_;
  std::map<Edge_name, Present> present_;
  std::map<Point_id, Presence> presences_;
  // Of the change in progress: the former neighbors of changed points, and removed edges.
  std::vector<std::pair<Point_id, std::vector<Neighbor>>> neighbors_before_;
  std::map<Edge_name, Present> ended_;
};

template <DistanceKineticTraits_2 Traits>
Life_recorder<Traits>::Life_recorder(Simulation_2<Traits>& simulation,
                                     std::optional<double> ridge_threshold)
    : Base(simulation), threshold_(ridge_threshold) {
  start();
}

template <DistanceKineticTraits_2 Traits>
Life_recorder<Traits>::Life_recorder(Triangulation& triangulation,
                                     std::optional<double> ridge_threshold)
    : Base(triangulation), threshold_(ridge_threshold) {
  start();
}

template <DistanceKineticTraits_2 Traits>
void Life_recorder<Traits>::start() {
  KINETRI_PRECONDITION(!threshold_ || (std::isfinite(*threshold_) && *threshold_ > 0),
                       "the threshold of ridges is not positive and finite");
  now_ = this->triangulation().current_time();
  for (Point_id id = 0; id < this->graph().next_id(); ++id) {
    if (this->graph().contains(id)) presences_.emplace(id, Presence{now_, std::nullopt});
  }
  for (const Edge_name& edge : this->graph().edges()) {
    Present present;
    present.index = lives_.size();
    present.since = now_;
    if (threshold_) present.opposite = opposite(edge);
    present_.emplace(edge, std::move(present));
    lives_.push_back(new_life(edge, now_, Life_limit::run));
  }
}

// ---- answers ----

template <DistanceKineticTraits_2 Traits>
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
    return std::tie(a.begin, a.points, a.offset) < std::tie(b.begin, b.points, b.offset);
  });
  return result;
}

template <DistanceKineticTraits_2 Traits>
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
template <DistanceKineticTraits_2 Traits>
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

template <DistanceKineticTraits_2 Traits>
void Life_recorder<Traits>::before_change(std::span<const Edge_name> removed,
                                          std::span<const Changed_point> points) {
  const auto& graph = this->graph();
  neighbors_before_.clear();
  for (const Changed_point& changed : points) {
    if (!changed.before) continue;
    const auto neighbors = graph.neighbors(changed.id);
    neighbors_before_.emplace_back(changed.id,
                                   std::vector<Neighbor>(neighbors.begin(), neighbors.end()));
    if (!threshold_) continue;
    // The ridges that depend on the motion: of its edges, and of those opposite to it.
    for (const Neighbor& other : neighbors) {
      end_piece(pair_of(changed.id, other));
      for (const Neighbor& third : common_neighbors(changed.id, other)) {
        end_piece(pair_of(id_of(other), seen_from(other, third)));
      }
    }
  }
  ended_.clear();
  for (const Edge_name& edge : removed) {
    end_piece(edge);
    ended_.insert(present_.extract(edge));
  }
}

template <DistanceKineticTraits_2 Traits>
void Life_recorder<Traits>::change(const Time& time, std::span<const Edge_name> removed,
                                   std::span<const Edge_name> added,
                                   std::span<const Changed_point> points) {
  const auto& graph = this->graph();
  now_ = time;
  // Inserted and erased points, and their neighbors.
  std::set<Point_id> near;
  for (const auto& [id, neighbors] : neighbors_before_) {
    if (graph.contains(id)) continue;
    near.insert(id);
    for (const Neighbor& neighbor : neighbors) near.insert(id_of(neighbor));
    presences_.at(id).until = time;
  }
  for (const Changed_point& changed : points) {
    if (changed.before) continue;
    near.insert(changed.id);
    for (const Neighbor& neighbor : graph.neighbors(changed.id)) near.insert(id_of(neighbor));
    presences_.insert_or_assign(changed.id, Presence{time, std::nullopt});
  }
  const auto limit = [&](const Edge_name& edge) {
    const auto& [a, b] = ids_of(edge);
    return near.contains(a) && near.contains(b) ? Life_limit::point : Life_limit::exchange;
  };
  for (const Edge_name& edge : removed) {
    const Present& present = ended_.at(edge);
    Life& ended = lives_[present.index];
    ended.has_ended = true;
    ended.life.end = time;
    ended.life.ends_by = limit(edge);
    ended.life.is_short = threshold_.has_value() && !present.is_long;
  }
  for (const Edge_name& edge : added) {
    Present present;
    present.index = lives_.size();
    present.since = time;
    present_.emplace(edge, std::move(present));
    lives_.push_back(new_life(edge, time, limit(edge)));
  }
  if (threshold_) follow_opposites(removed, added);
}

// When points meet, triangles may change although no edge does.
template <DistanceKineticTraits_2 Traits>
void Life_recorder<Traits>::change_triangles(std::span<const Edge_ids> edges) {
  if (!threshold_) return;
  std::set<Point_id> around;
  add_points_around(edges, around);
  update_opposites(around);
}

// Updates the triangles at edges near added and removed ones.
template <DistanceKineticTraits_2 Traits>
void Life_recorder<Traits>::follow_opposites(std::span<const Edge_name> removed,
                                             std::span<const Edge_name> added) {
  std::set<Point_id> around;
  add_points_around(removed, around);
  add_points_around(added, around);
  update_opposites(around);
  for (const Edge_name& edge : added) {
    const Present& present = present_.at(edge);
    const auto& [r, s] = present.opposite;
    if (id_of(s) == no_point) continue;
    const auto replaced = ended_.find(pair_of(id_of(r), seen_from(r, s)));
    if (replaced == ended_.end()) continue;
    const auto& [p, q] = replaced->second.opposite;
    if (id_of(q) == no_point || pair_of(id_of(p), seen_from(p, q)) != edge) continue;
    lives_[present.index].replaced = replaced->second.index;
    lives_[replaced->second.index].replaced_by = present.index;
  }
}

// Adds the ends of edges and their common neighbors, be they of the same images or not; of an
// erased point, the other ends of its edges.
template <DistanceKineticTraits_2 Traits>
template <class Name>
void Life_recorder<Traits>::add_points_around(std::span<const Name> edges,
                                              std::set<Point_id>& around) const {
  const auto& graph = this->graph();
  for (const Name& edge : edges) {
    const auto& [a, b] = ids_of(edge);
    for (const Point_id id : {a, b}) {
      if (graph.contains(id)) around.insert(id);
    }
    if (!graph.contains(a) || !graph.contains(b)) continue;
    for (const Neighbor& between : graph.neighbors(a)) {
      const auto is_it = [&](const Neighbor& of_b) { return id_of(of_b) == id_of(between); };
      if (std::ranges::any_of(graph.neighbors(b), is_it)) around.insert(id_of(between));
    }
  }
}

// Updates the triangles of all edges between these points.
template <DistanceKineticTraits_2 Traits>
void Life_recorder<Traits>::update_opposites(const std::set<Point_id>& around) {
  for (const Point_id id : around) {
    for (const Neighbor& other : this->graph().neighbors(id)) {
      if (!is_first(id, other) || !around.contains(id_of(other))) continue;
      const Edge_name edge = pair_of(id, other);
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

// The neighbors of a point that are neighbors of one of its neighbors, too.
template <DistanceKineticTraits_2 Traits>
auto Life_recorder<Traits>::common_neighbors(Point_id id, const Neighbor& other) const
    -> std::vector<Neighbor> {
  const auto of_other = this->graph().neighbors(id_of(other));
  std::vector<Neighbor> result;
  for (const Neighbor& third : this->graph().neighbors(id)) {
    if (std::ranges::find(of_other, seen_from(other, third)) != of_other.end()) {
      result.push_back(third);
    }
  }
  return result;
}

// The third points of the triangles at an edge just after now: on each side the common neighbor
// whose circle contains no other one. It is unique even among cocircular ones: edges from two of
// them to both ends would cross.
template <DistanceKineticTraits_2 Traits>
auto Life_recorder<Traits>::opposite(const Edge_name& edge) const -> Opposite {
  const auto instantaneous = this->traits().instantaneous_traits(Instant{now_, Time_side::after});
  const auto orientation = instantaneous.orientation_2_object();
  const auto side_of_circle = instantaneous.side_of_oriented_circle_2_object();
  const Image_2& first = this->first_end(edge);
  const Image_2& second = this->second_end(edge);
  Opposite result = {no_neighbor<Traits>(), no_neighbor<Traits>()};
  for (const Neighbor& candidate : common_neighbors(ids_of(edge)[0], second_of(edge))) {
    const Image_2& r = this->image(candidate);
    const auto turn = orientation(first, second, r);
    if (turn == CGAL::COLLINEAR) continue;
    const bool is_left = turn == CGAL::LEFT_TURN;
    Neighbor& best = result[is_left ? 0 : 1];
    const auto is_in_circle = [&](const Image_2& of_best) {
      return side_of_circle(is_left ? first : second, is_left ? second : first, of_best, r) ==
             CGAL::ON_POSITIVE_SIDE;
    };
    if (id_of(best) == no_point || is_in_circle(this->image(best))) best = candidate;
  }
  std::ranges::sort(result);
  return result;
}

// The quadrilateral of the edge, or one of its motions, ends now.
template <DistanceKineticTraits_2 Traits>
void Life_recorder<Traits>::end_piece(const Edge_name& edge) {
  if (!threshold_) return;
  const auto found = present_.find(edge);
  if (found == present_.end()) return;
  Present& present = found->second;
  if (!present.is_long) present.is_long = reaches_threshold(edge, present, now_);
  present.since = now_;
}

// Whether the ridge reaches the threshold at a time since the present piece began.
template <DistanceKineticTraits_2 Traits>
bool Life_recorder<Traits>::reaches_threshold(const Edge_name& edge, const Present& present,
                                              const Time& until) const {
  if (present.since == until) return false;
  if (id_of(present.opposite[1]) == no_point) return true;
  const Image_2& p = this->first_end(edge);
  const Image_2& q = this->second_end(edge);
  const Image_2& r = this->image(present.opposite[0]);
  const Image_2& s = this->image(present.opposite[1]);
  if constexpr (!std::same_as<Center_motion_of<Motion>, Polynomial_motion_2>) {
    const double from = present.since.interval().upper;
    const double to = until.interval().lower;
    for (const double share : {0.5, 0.125, 0.875}) {
      const double t = from + share * (to - from);
      if (t >= from && t <= to &&
          are_certainly_apart(p.motion(), q.motion(), r.motion(), s.motion(), *threshold_, t)) {
        return true;
      }
    }
  }
  const Polynomial excess = distance_polynomial(center(p, q, r), center(p, q, s), *threshold_);
  if (sign_at(excess, until) != CGAL::NEGATIVE) return true;
  if (sign_at(excess, present.since) != CGAL::NEGATIVE) return true;
  if (excess.sign_at(simplest_between(present.since, until)) != CGAL::NEGATIVE) return true;
  const auto root = first_root_after(excess, present.since);
  return root && root->value < until;
}

}  // namespace detail

template <DistanceKineticTraits_2 Traits>
Neighbor_lives<Traits>::Neighbor_lives(Simulation_2<Traits>& simulation,
                                       std::optional<double> ridge_threshold)
    : recorder_(std::make_unique<detail::Life_recorder<Traits>>(simulation, ridge_threshold)) {}

template <DistanceKineticTraits_2 Traits>
Neighbor_lives<Traits>::Neighbor_lives(Triangulation& triangulation,
                                       std::optional<double> ridge_threshold)
    : recorder_(std::make_unique<detail::Life_recorder<Traits>>(triangulation, ridge_threshold)) {}

template <DistanceKineticTraits_2 Traits>
Neighbor_lives<Traits>::~Neighbor_lives() = default;

template <DistanceKineticTraits_2 Traits>
std::vector<Neighbor_life> Neighbor_lives<Traits>::lives() {
  return recorder_->lives();
}

template <DistanceKineticTraits_2 Traits>
std::vector<Point_exchanges> Neighbor_lives<Traits>::exchanges() {
  return recorder_->exchanges();
}

template class Neighbor_lives<Linear_kinetic_traits_2>;
template class Neighbor_lives<Polynomial_kinetic_traits_2>;
template class Neighbor_lives<Disc_kinetic_traits_2>;
template class Neighbor_lives<Polynomial_disc_kinetic_traits_2>;
template class Neighbor_lives<Periodic_kinetic_traits_2>;
template class Neighbor_lives<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri
