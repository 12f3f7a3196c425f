// SPDX-License-Identifier: GPL-3.0-or-later
//
// Components of points in range, from all pairs: the pieces of constant motion of a run, the closed
// time intervals in which two points are linked, and union-find.
#ifndef KINETRI_TEST_SUPPORT_COMPONENT_ORACLE_H
#define KINETRI_TEST_SUPPORT_COMPONENT_ORACLE_H

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/motions.h"

namespace kinetri::test {

/// A motion that a point has from one time to another.
template <class Motion>
struct Motion_piece {
  Point_id id;
  Motion motion;
  Algebraic_number from;
  Algebraic_number to;
};

/// Records the motions of all points of a simulation, except those without duration.
template <class Traits>
class Motion_recorder : public Event_observer {
 public:
  using Motion = typename Traits::Motion;

  explicit Motion_recorder(Simulation_2<Traits>& simulation) : simulation_(simulation) {
    for (Point_id id = 0; id < simulation.triangulation().next_id(); ++id) begin(id);
    simulation.add_observer(*this);
  }
  ~Motion_recorder() override { simulation_.remove_observer(*this); }

  void after_event(const Event& event) override {
    for (const auto& id : {event.point_a, event.point_b}) {
      if (!id) continue;
      end(*id);
      begin(*id);
    }
  }

  /// All pieces up to now.
  std::vector<Motion_piece<Motion>> pieces() const {
    std::vector<Motion_piece<Motion>> result = ended_;
    for (const auto& [id, piece] : present_) {
      result.push_back(piece);
      result.back().to = simulation_.current_time();
    }
    return result;
  }

 private:
  void begin(Point_id id) {
    if (!simulation_.triangulation().contains(id)) return;
    const Algebraic_number& now = simulation_.current_time();
    present_.insert_or_assign(
        id, Motion_piece<Motion>{id, simulation_.triangulation().motion(id), now, now});
  }
  void end(Point_id id) {
    const auto piece = present_.find(id);
    if (piece == present_.end()) return;
    piece->second.to = simulation_.current_time();
    if (piece->second.from != piece->second.to) ended_.push_back(piece->second);
    present_.erase(piece);
  }

  Simulation_2<Traits>& simulation_;
  std::map<Point_id, Motion_piece<Motion>> present_;
  std::vector<Motion_piece<Motion>> ended_;
};

/// Simple union-find.
class Partition {
 public:
  void add(Point_id id) { parents_.emplace(id, id); }
  Point_id root(Point_id id) const {
    while (parents_.at(id) != id) id = parents_.at(id);
    return id;
  }
  void join(Point_id a, Point_id b) { parents_[root(a)] = root(b); }
  bool contains(Point_id id) const { return parents_.contains(id); }
  bool are_joined(Point_id a, Point_id b) const {
    return contains(a) && contains(b) && root(a) == root(b);
  }
  /// The sizes of the components in descending order.
  std::vector<std::size_t> sizes() const {
    std::map<Point_id, std::size_t> sizes;
    for (const auto& [id, parent] : parents_) ++sizes[root(id)];
    std::vector<std::size_t> result;
    for (const auto& [id, size] : sizes) result.push_back(size);
    std::ranges::sort(result, std::greater());
    return result;
  }

 private:
  std::map<Point_id, Point_id> parents_;
};

// ---- the polynomial of a squared distance, from the definition ----

using Coefficients = std::vector<Rational>;  // by ascending power

inline Coefficients product(const Coefficients& a, const Coefficients& b) {
  Coefficients result(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  }
  return result;
}

inline Coefficients sum(Coefficients a, const Coefficients& b, int factor = 1) {
  a.resize(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < b.size(); ++i) a[i] += factor * b[i];
  return a;
}

/// A coordinate whose derivatives at `epoch` are given.
inline Coefficients coordinate(std::initializer_list<double> derivatives, double epoch) {
  const Coefficients elapsed = {-to_rational(epoch), 1};
  Coefficients result;
  Coefficients power = {1};
  int factorial = 1;
  int order = 0;
  for (const double derivative : derivatives) {
    result = sum(result, product(power, {to_rational(derivative) / factorial}));
    power = product(power, elapsed);
    factorial *= ++order;
  }
  return result;
}

inline Coefficients coordinate(const Linear_motion_2& m, double Vector_2::*axis) {
  return coordinate({m.position.*axis, m.velocity.*axis}, m.epoch);
}
inline Coefficients coordinate(const Polynomial_motion_2& m, double Vector_2::*axis) {
  return coordinate({m.position.*axis, m.velocity.*axis, m.acceleration.*axis, m.jerk.*axis},
                    m.epoch);
}

template <class Motion>
Coefficients squared_distance(const Motion& p, const Motion& q) {
  const Coefficients x = sum(coordinate(p, &Vector_2::x), coordinate(q, &Vector_2::x), -1);
  const Coefficients y = sum(coordinate(p, &Vector_2::y), coordinate(q, &Vector_2::y), -1);
  return sum(product(x, x), product(y, y));
}

// ---- when two are linked ----

/// Both ends included.
struct Closed_interval {
  Algebraic_number begin;
  Algebraic_number end;

  bool contains(const Algebraic_number& t) const { return begin <= t && t <= end; }
  bool contains_before(const Algebraic_number& t) const { return begin < t && t <= end; }
  bool contains_after(const Algebraic_number& t) const { return begin <= t && t < end; }
};

/// The squared distance minus the squared range, up to a positive factor.
template <class Motion>
Polynomial excess(const Motion& p, const Motion& q, double range) {
  const Rational r = to_rational(range);
  return primitive_polynomial(sum(squared_distance(p, q), {r * r}, -1));
}

/// The times from `from` to `to` at which two points are at most `range` apart. Precondition: from
/// < to.
template <class Motion>
std::vector<Closed_interval> near_times(const Motion& p, const Motion& q, double range,
                                        const Algebraic_number& from, const Algebraic_number& to) {
  const Polynomial squared_excess = excess(p, q, range);
  std::vector<Algebraic_number> times = {from};
  if (!squared_excess.is_zero()) {
    for (const Real_root& root : real_roots(squared_excess)) {
      if (from < root.value && root.value < to) times.push_back(root.value);
    }
  }
  times.push_back(to);
  std::vector<Closed_interval> result;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (sign_at(squared_excess, times[i]) == CGAL::POSITIVE) continue;
    const bool goes_on = !result.empty() && result.back().end == times[i];
    if (!goes_on) result.push_back({times[i], times[i]});
    if (i + 1 == times.size()) break;
    if (squared_excess.sign_at(simplest_between(times[i], times[i + 1])) != CGAL::POSITIVE) {
      result.back().end = times[i + 1];
    }
  }
  return result;
}

/// Of a run that is observed from `start` on, the times at which points exist, and those at which
/// pairs are linked. There need not be a point at the start. The last pieces end where the records
/// end: what is asked is about times before that.
class Component_oracle {
 public:
  struct Link {
    Edge_ids points;
    Closed_interval times;
  };

  template <class Motion>
  Component_oracle(const std::vector<Motion_piece<Motion>>& pieces, const Algebraic_number& start,
                   double range)
      : start_(start) {
    for (const auto& piece : pieces) {
      auto& times = presence_[piece.id];
      const auto before = std::ranges::find(times, piece.from, &Closed_interval::end);
      if (before != times.end()) {
        before->end = piece.to;
      } else {
        times.push_back({piece.from, piece.to});
      }
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto& [a, p, p_from, p_to] = pieces[i];
        const auto& [b, q, q_from, q_to] = pieces[j];
        const Algebraic_number from = std::max(p_from, q_from);
        const Algebraic_number to = std::min(p_to, q_to);
        if (a == b || from > to) continue;
        if (from == to) {
          const bool meet = (goes(a, to) && comes(b, to)) || (goes(b, to) && comes(a, to));
          if (meet && sign_at(excess(p, q, range), to) != CGAL::POSITIVE) {
            links_.push_back({edge_ids(a, b), {to, to}});
          }
          continue;
        }
        for (const Closed_interval& times : near_times(p, q, range, from, to)) {
          links_.push_back({edge_ids(a, b), times});
        }
      }
    }
  }

  const std::vector<Link>& links() const { return links_; }

  /// The start, and all times at which a point comes or goes, or a link begins or ends; sorted.
  std::vector<Algebraic_number> times() const {
    std::vector<Algebraic_number> result = {start_};
    const auto add = [&](const Closed_interval& interval) {
      result.push_back(interval.begin);
      result.push_back(interval.end);
    };
    for (const auto& [id, times] : presence_) std::ranges::for_each(times, add);
    for (const Link& link : links_) add(link.times);
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  std::size_t number_of_comings(const Algebraic_number& t) const {
    return number([&](const Closed_interval& times) { return times.begin == t; });
  }
  std::size_t number_of_goings(const Algebraic_number& t) const {
    return number([&](const Closed_interval& times) { return times.end == t; });
  }

  /// The components just before a time, at it, or just after it.
  Partition partition(const Algebraic_number& t, Time_side side) const {
    const auto contains = [&](const Closed_interval& times) {
      return side == Time_side::before  ? times.contains_before(t)
             : side == Time_side::after ? times.contains_after(t)
                                        : times.contains(t);
    };
    Partition result;
    for (const auto& [id, times] : presence_) {
      if (std::ranges::any_of(times, contains)) result.add(id);
    }
    for (const Link& link : links_) {
      if (contains(link.times)) result.join(link.points[0], link.points[1]);
    }
    return result;
  }

  /// The times up to `until` at which two points are connected.
  std::vector<Closed_interval> connected(Point_id a, Point_id b,
                                         const Algebraic_number& until) const {
    std::vector<Closed_interval> result;
    for (const Algebraic_number& time : times()) {
      const Algebraic_number& t = std::min(time, until);
      if (partition(t, Time_side::at).are_joined(a, b)) {
        if (partition(t, Time_side::before).are_joined(a, b)) {
          result.back().end = t;
        } else {
          result.push_back({t, t});
        }
      }
      if (time >= until) break;
    }
    return result;
  }

 private:
  bool comes(Point_id id, const Algebraic_number& t) const {
    const auto& times = presence_.at(id);
    return std::ranges::find(times, t, &Closed_interval::begin) != times.end();
  }
  bool goes(Point_id id, const Algebraic_number& t) const {
    const auto& times = presence_.at(id);
    return std::ranges::find(times, t, &Closed_interval::end) != times.end();
  }
  template <class Condition>
  std::size_t number(Condition condition) const {
    std::size_t result = 0;
    for (const auto& [id, times] : presence_) {
      result += static_cast<std::size_t>(std::ranges::count_if(times, condition));
    }
    return result;
  }

  Algebraic_number start_;
  std::map<Point_id, std::vector<Closed_interval>> presence_;
  std::vector<Link> links_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_COMPONENT_ORACLE_H
