// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that are moved to other positions in steps of every kind, with other changes and motion
// between, beside a new triangulation of the same motions.
#ifndef KINETRI_TEST_SUPPORT_POSITION_RUNS_H
#define KINETRI_TEST_SUPPORT_POSITION_RUNS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/coincident_runs.h"
#include "support/kinetic_runs.h"

namespace kinetri::test {

/// The ids of the points, sorted.
template <class Kinetic>
std::vector<Point_id> ids_of(const Kinetic& kinetic) {
  std::vector<Point_id> result;
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (kinetic.contains(id)) result.push_back(id);
  }
  return result;
}

/// The motions of the points, in the order of their ids.
template <class Kinetic>
auto motions_of(const Kinetic& kinetic) {
  std::vector<typename Kinetic::Motion> result;
  for (const Point_id id : ids_of(kinetic)) result.push_back(kinetic.motion(id));
  return result;
}

/// What differs from `made`, whose points are those of `kinetic` in the order of their ids; empty
/// if nothing does.
template <class Kinetic>
std::string difference_from(const Kinetic& made, const Kinetic& kinetic) {
  const std::vector<Point_id> ids = ids_of(kinetic);
  std::vector<Edge_ids> edges;
  for (const auto& [a, b] : made.finite_edge_ids()) edges.push_back(edge_ids(ids[a], ids[b]));
  if (kinetic.finite_edge_ids() != edges) return "other edges";
  for (Point_id k = 0; k < ids.size(); ++k) {
    const Point_id id = ids[k];
    if (kinetic.is_hidden(id) != made.is_hidden(k)) return "other hidden points";
    std::vector<Point_id> others;
    for (const Point_id other : made.coincident_points(k)) others.push_back(ids[other]);
    if (kinetic.coincident_points(id) != others) return "other groups";
    if (kinetic.vertex(id)->point().id() != ids[made.vertex(k)->point().id()]) {
      return "other vertices";
    }
  }
  return {};
}

/// What differs from a triangulation that is made of the same motions; empty if nothing does.
template <class Kinetic>
std::string difference_from_new(const Kinetic& kinetic) {
  return difference_from(Kinetic(motions_of(kinetic), kinetic.current_time()), kinetic);
}

/// Where the points of a run are, and how many there are at most.
struct Position_range {
  std::size_t most_points = 0;
  int size = 0;  ///< of the square at the start
  bool is_grid = false;
};

/// Random changes; `Choices` has integer(lowest, highest), of at most 256 values.
template <class Kinetic, class Choices>
class Position_run {
 public:
  using Motion = typename Kinetic::Motion;
  using Traits = std::remove_cvref_t<decltype(std::declval<Kinetic>().traits())>;
  using Places = std::vector<Vector_2>;

  Position_run(Choices& choices, const Position_range& range) : choices_(choices), range_(range) {
    has_weights_ = HasWeight<Motion> && any(4) > 0;
    std::vector<Motion> motions;
    for (std::size_t n = any(range.most_points + 1); n > 0; --n) {
      motions.push_back(motion_at(any_place(), {}));
    }
    kinetic_.emplace(motions, Algebraic_number(0));
    if (!do_coincide(*kinetic_) && any(8) == 0) {
      kinetic_.emplace(motions, Algebraic_number(0), Traits(), Coincident_points::refuse);
    }
  }

  /// The first problem after one of the steps; empty if there is none.
  std::string problem(int steps) {
    for (int k = 0; k < steps; ++k) {
      if constexpr (requires { choices_.at_end(); }) {
        if (choices_.at_end()) break;
      }
      Hidden_follower<Kinetic> follower(*kinetic_);
      what_.str({});
      std::string found = take_step();
      kinetic_->remove_observer(follower);
      if (found.empty()) found = follower.problem;
      if (found.empty() && follower.edges != edges_of(*kinetic_)) found = "other edges by events";
      if (found.empty() && follower.hidden != hidden()) found = "other hidden points by events";
      if (found.empty()) found = difference();
      if (!found.empty()) {
        return "step " + std::to_string(k) + ", " + what_.str() + ": " + found;
      }
    }
    return {};
  }

  /// What has been seen, which a test may demand.
  std::size_t hidden_seen() const { return hidden_seen_; }
  std::size_t refused() const { return refused_; }

 private:
  // Less than `limit`.
  std::size_t any(std::size_t limit) {
    return static_cast<std::size_t>(choices_.integer(0, static_cast<int>(limit) - 1));
  }
  double whole(int lowest, int highest) { return choices_.integer(lowest, highest); }
  double now() const { return kinetic_ ? kinetic_->current_time().to_double() : 0.0; }

  // At least 0 and less than 1; 0 on a grid.
  double fraction() {
    if (range_.is_grid) return 0;
    const double coarse = whole(0, 255) / 256;
    return coarse + whole(0, 255) / 65536;
  }
  double coordinate(int lowest, int highest) {
    const double integer = whole(lowest, highest - (range_.is_grid ? 0 : 1));
    return integer + fraction();
  }
  Vector_2 any_place() {
    const double x = coordinate(0, range_.size);
    return {x, coordinate(0, range_.size)};
  }
  Vector_2 any_velocity() {
    const double x = coordinate(-1, 1);
    return {x, coordinate(-1, 1)};
  }
  Motion motion_at(const Vector_2& place, const Vector_2& velocity) {
    Motion result = {};
    result.position = place;
    result.velocity = velocity;
    result.epoch = now();
    if constexpr (HasWeight<Motion>) {
      if (has_weights_) {
        result.radius = whole(0, 1);
        result.weight = whole(-1, 1);
        if (velocity != Vector_2()) result.growth = whole(0, 1) / 2;
      }
    }
    return result;
  }

  static bool do_coincide(const Kinetic& kinetic) {
    return std::ranges::any_of(ids_of(kinetic),
                               [&](Point_id id) { return !kinetic.coincident_points(id).empty(); });
  }
  Places places_of(const std::vector<Point_id>& ids) const {
    Places result;
    for (const Point_id id : ids) result.push_back(rounded_place(kinetic_->motion(id), now()));
    return result;
  }
  std::set<Point_id> hidden() const {
    std::set<Point_id> result;
    for (const Point_id id : ids_of(*kinetic_)) {
      if (kinetic_->is_hidden(id)) result.insert(id);
    }
    return result;
  }
  // Those of the finite vertices on the hull.
  std::set<Point_id> on_hull() const {
    std::set<Point_id> result;
    const auto& triangulation = kinetic_->triangulation();
    if (triangulation.dimension() < 1) return result;
    auto v = triangulation.incident_vertices(triangulation.infinite_vertex());
    const auto first = v;
    do result.insert(v->point().id());
    while (++v != first);
    return result;
  }

  // Where all points go, from these places.
  Places next(const std::vector<Point_id>& ids, Places places) {
    const std::size_t n = places.size();
    const auto each = [&](const auto& map) { std::ranges::transform(places, places.begin(), map); };
    const auto some = [&](const auto& change) {
      for (std::size_t k = 1 + any(3); k > 0; --k) change(places[any(n)]);
    };
    const double half = range_.size / 2.0;
    switch (any(13)) {
      case 0:
      case 1: {  // a step of one length
        constexpr std::array lengths = {1e-9, 1e-3, 0.03, 0.1, 0.3, 1.0, 10.0};
        const double length = range_.is_grid ? 1.0 : lengths[any(lengths.size())];
        what_ << "steps of " << length;
        each([&](const Vector_2& p) {
          const Vector_2 by = any_velocity();
          return Vector_2{p.x + length * by.x, p.y + length * by.y};
        });
        break;
      }
      case 2:
      case 3:
        what_ << "steps of some";
        some([&](Vector_2& p) {
          const Vector_2 by = any_velocity();
          p = {p.x + by.x, p.y + by.y};
        });
        break;
      case 4:
        what_ << "jumps of some";
        some([&](Vector_2& p) {
          p = {coordinate(-range_.size, 2 * range_.size), coordinate(-range_.size, range_.size)};
        });
        break;
      case 5:
        what_ << "some onto others";
        some([&](Vector_2& p) { p = places[any(n)]; });
        break;
      case 6:
        what_ << "all into one position";
        places.assign(n, any(2) == 0 ? any_place() : places[any(n)]);
        break;
      case 7: {
        what_ << "the hull inwards";
        const std::set<Point_id> hull = on_hull();
        for (std::size_t k = 0; k < n; ++k) {
          if (!hull.contains(ids[k])) continue;
          places[k] = {(places[k].x + half) / 2, (places[k].y + half) / 2};
        }
        break;
      }
      case 8: {
        what_ << "onto a lattice";
        const double side = std::ceil(std::sqrt(static_cast<double>(n)));
        for (std::size_t k = 0; k < n; ++k) {
          const double row = std::floor(static_cast<double>(k) / side);
          places[k] = {static_cast<double>(k) - side * row, row};
        }
        break;
      }
      case 9: {
        const Vector_2 line = {whole(0, 2), whole(-1, 1)};
        what_ << "onto a line";
        each([&](const Vector_2& p) { return Vector_2{line.x * p.x, line.y * p.x}; });
        break;
      }
      case 10: {
        const std::size_t k = any(2);
        what_ << (k == 0 ? "to the next" : "in the opposite order");
        if (k == 0) std::rotate(places.begin(), places.begin() + 1, places.end());
        if (k == 1) std::ranges::reverse(places);
        break;
      }
      case 11:
        what_ << "all anywhere";
        each([&](const Vector_2&) { return any_place(); });
        break;
      default:
        map(places);
    }
    return places;
  }

  // Moves all by one map.
  void map(Places& places) {
    const double half = range_.size / 2.0;
    const std::size_t kind = any(9);
    what_ << "map " << kind;
    for (Vector_2& place : places) {
      const auto [x, y] = Vector_2{place.x - half, place.y - half};
      const std::array<Vector_2, 9> maps = {{
          {-x, y},                      // all triangles turn over
          {-x, -y},                     // none does
          {-y, x},                      //
          {4 * x, 4 * y},               //
          {x / 4, y / 4},               //
          {x * x - y * y, 2 * x * y},   // twice around: the hull crosses itself
          {x * x - y * y, -2 * x * y},  //
          {std::abs(x), y},             // folded
          {x + y, y},
      }};
      place = {maps[kind].x + half, maps[kind].y + half};
    }
    // Maps must not add up to numbers that are not finite.
    const bool are_far = std::ranges::any_of(
        places, [](const Vector_2& p) { return std::max(std::abs(p.x), std::abs(p.y)) > 1e9; });
    if (!are_far) return;
    for (Vector_2& place : places) place = any_place();
  }

  std::string take_step() {
    std::vector<Point_id> ids = ids_of(*kinetic_);
    const std::size_t choice = any(16);
    if (ids.empty() || choice == 0) return insert();
    if (choice == 1) return erase(std::move(ids));
    if (choice == 2) {
      const double until = now() + whole(1, 4) / 4;
      what_ << "advance to " << until;
      kinetic_->advance_to(Algebraic_number(until));
      return {};
    }
    if (choice == 3 && any(4) == 0) {
      what_ << "reverse";
      kinetic_->reverse();
      return {};
    }
    return move(std::move(ids));
  }

  std::string insert() {
    std::vector<Motion> motions;
    for (std::size_t n = 1 + any(any(4) == 0 ? 20 : 3); n > 0; --n) {
      if (kinetic_->number_of_points() + motions.size() >= range_.most_points) break;
      motions.push_back(motion_at(any_place(), any(2) == 0 ? any_velocity() : Vector_2()));
    }
    what_ << "insert " << motions.size();
    std::vector<Motion> wanted = motions_of(*kinetic_);
    wanted.insert(wanted.end(), motions.begin(), motions.end());
    return unless_refused(wanted, [&] { kinetic_->insert(motions); });
  }

  std::string erase(std::vector<Point_id> ids) {
    take(any(4) == 0 ? ids.size() : std::min<std::size_t>(3, ids.size()), ids);
    what_ << "erase " << ids.size();
    kinetic_->erase(ids);
    return {};
  }

  // Keeps `most` of the ids or fewer, in another order.
  void take(std::size_t most, std::vector<Point_id>& ids) {
    const std::size_t n = 1 + any(most);
    for (std::size_t k = 0; k < n; ++k) std::swap(ids[k], ids[k + any(ids.size() - k)]);
    ids.resize(n);
  }

  std::string move(std::vector<Point_id> ids) {
    const std::vector<Point_id> all = ids;
    Places places = next(all, places_of(all));
    const std::size_t share = any(6);
    if (share < 2) {
      take(share == 0 ? std::min<std::size_t>(4, all.size()) : all.size(), ids);
      Places chosen;
      for (const Point_id id : ids) {
        const auto at = std::ranges::lower_bound(all, id);
        chosen.push_back(places[static_cast<std::size_t>(at - all.begin())]);
      }
      places = std::move(chosen);
    }
    what_ << ", " << ids.size() << " of " << all.size();
    const std::size_t way = any(8);
    std::vector<Motion> motions;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      motions.push_back(way == 0 ? motion_at(places[k], any_velocity())
                                 : at_rest_in(kinetic_->motion(ids[k]), places[k]));
    }
    std::vector<Motion> wanted = motions_of(*kinetic_);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const auto at = std::ranges::lower_bound(all, ids[k]);
      wanted[static_cast<std::size_t>(at - all.begin())] = motions[k];
    }
    return unless_refused(wanted, [&] {
      if (way < 2) {
        what_ << " by motions";
        kinetic_->set_motions(ids, motions);
      } else if (ids == all && way < 6) {
        kinetic_->set_positions(places);
      } else {
        kinetic_->set_positions(ids, places);
      }
    });
  }

  // Makes the change, after which the points should have these motions. It changes nothing if it is
  // refused, which it is if and only if points would coincide that may not.
  template <class Change>
  std::string unless_refused(const std::vector<Motion>& wanted, const Change& change) {
    const bool is_wrong = kinetic_->coincident() == Coincident_points::refuse &&
                          do_coincide(Kinetic(wanted, kinetic_->current_time()));
    const std::vector<Motion> before = motions_of(*kinetic_);
    try {
      change();
      if (is_wrong) return "is not refused";
      return motions_of(*kinetic_) == wanted ? std::string() : "other motions";
    } catch (const Coincident_trajectories_error&) {
      ++refused_;
      what_ << " refused";
      if (!is_wrong) return "is refused";
      return motions_of(*kinetic_) == before ? std::string() : "refused, but motions changed";
    }
  }

  // What differs from a new triangulation, which may also be asked for the next event: that makes
  // the certificates of both.
  std::string difference() {
    Kinetic made(motions_of(*kinetic_), kinetic_->current_time());
    std::string found = difference_from(made, *kinetic_);
    hidden_seen_ += kinetic_->number_of_hidden_points();
    if (found.empty() && any(4) == 0) {
      found = audit_problem(*kinetic_, static_cast<Audit_level>(any(5)));
    }
    if (found.empty() && any(8) == 0 && kinetic_->next_event_time() != made.next_event_time()) {
      found = "another time of the next event";
    }
    return found;
  }

  Choices& choices_;
  const Position_range range_;
  bool has_weights_ = false;
  std::optional<Kinetic> kinetic_;
  std::ostringstream what_;  // the present step
  std::size_t hidden_seen_ = 0;
  std::size_t refused_ = 0;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_POSITION_RUNS_H
