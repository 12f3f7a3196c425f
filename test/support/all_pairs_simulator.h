// SPDX-License-Identifier: GPL-3.0-or-later
//
// A slow, simple oracle for discs: the exact contact times of all pairs, and of all points with all
// walls. It has no triangulation. It shares with the library only the algebra and the functions
// that change motions.
#ifndef KINETRI_TEST_SUPPORT_ALL_PAIRS_SIMULATOR_H
#define KINETRI_TEST_SUPPORT_ALL_PAIRS_SIMULATOR_H

#include <algorithm>
#include <array>
#include <concepts>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/brute_force_simulator.h"
#include "support/motions.h"

namespace kinetri::test {

/// A contact: of two points, or of a point and one of the four walls.
struct All_pairs_contact {
  Algebraic_number time;
  Event_kind kind = Event_kind::wall;
  Point_id a = no_point;
  Point_id b = no_point;  ///< of a wall contact, the index of the wall

  bool operator<(const All_pairs_contact& other) const {
    if (time != other.time) return time < other.time;
    if (kind != other.kind) return kind == Event_kind::wall;
    return std::pair(a, b) < std::pair(other.a, other.b);
  }
};

/// The radius at a time, by its definition; of points, the common radius.
template <class Motion>
Rational radius_at(const Motion& motion, const Rational& t, const Simulation_options& options) {
  if constexpr (HasWeight<Motion>) {
    return to_rational(motion.radius) +
           to_rational(motion.growth) * (t - to_rational(motion.epoch));
  } else {
    return to_rational(options.radius);
  }
}

template <class Motion>
class All_pairs_simulator {
 public:
  All_pairs_simulator(const std::vector<Motion>& motions, const Simulation_options& options)
      : options_(options), time_(0.0) {
    if (options.box) walls_ = options.box->walls(0);
    for (Point_id id = 0; id < motions.size(); ++id) motions_[id] = motions[id];
    for (const auto& [id, motion] : motions_) find_contacts(id);
  }

  const std::map<Point_id, Motion>& motions() const { return motions_; }

  /// Whether the run has ended with a resting contact.
  bool is_pressed() const { return is_pressed_; }

  /// Precondition: there is no contact before that time.
  void advance_to(const Algebraic_number& time) { time_ = time; }

  /// Gives a point, perhaps a new one, a motion from now on; empty: erases it.
  void set_motion(Point_id id, const std::optional<Motion>& motion) {
    change(id, motion);
    finish_changes();
  }

  /// Executes the next contact if it is at or before `until`. None if it is a resting contact.
  std::optional<All_pairs_contact> step(const Algebraic_number& until) {
    const All_pairs_contact* first = nullptr;
    for (const auto& [key, contact] : contacts_) {
      if (contact && (first == nullptr || *contact < *first)) first = &*contact;
    }
    if (first == nullptr || first->time > until) return std::nullopt;
    const All_pairs_contact next = *first;
    time_ = next.time;
    if (next.kind == Event_kind::wall) {
      hit_wall(next.a, walls_[next.b]);
    } else {
      collide(next.a, next.b);
    }
    if (is_pressed_) return std::nullopt;
    return next;
  }

 private:
  static constexpr int degree = std::derived_from<Motion, Linear_motion_2> ? 1 : 3;

  // The squared distance minus the square of the sum of the radii, up to a positive factor.
  Polynomial gap(const Motion& p, const Motion& q) const {
    return interpolate(2 * degree, [&](const Rational& t) {
      const Rational contact = radius_at(p, t, options_) + radius_at(q, t, options_);
      return Rational(CGAL::squared_distance(place_at(p, t), place_at(q, t)) - contact * contact);
    });
  }

  Polynomial clearance(const Motion& p, const Wall_2& wall) const {
    const Rational position = to_rational(wall.position);
    return interpolate(degree, [&](const Rational& t) {
      const Static_point place = place_at(p, t);
      const Rational x = wall.is_vertical() ? place.x() : place.y();
      const Rational distance = options_.rim_touches ? radius_at(p, t, options_) : Rational(0);
      return Rational((wall.is_upper() ? position - x : x - position) - distance);
    });
  }

  // The first time from `from` on at which p is not positive and decreases.
  static std::optional<Algebraic_number> fall(const Polynomial& p, const Algebraic_number& from) {
    if (p.degree() < 1) return std::nullopt;
    const Polynomial slope = derivative(p);
    std::vector<Algebraic_number> candidates = {from};
    for (const Polynomial* source : {&p, &slope}) {
      if (source->degree() < 1) continue;
      for (const Real_root& root : real_roots(*source)) {
        if (root.value > from) candidates.push_back(root.value);
      }
    }
    std::ranges::sort(candidates);
    for (const Algebraic_number& t : candidates) {
      if (sign_at(p, t) != CGAL::POSITIVE && sign_just_after(slope, t) == CGAL::NEGATIVE) return t;
    }
    return std::nullopt;
  }

  // The first time from now on just after which p is positive.
  std::optional<Algebraic_number> rise(const Polynomial& p) const {
    if (sign_just_after(p, time_) == CGAL::POSITIVE) return time_;
    if (p.degree() < 1) return std::nullopt;
    for (const Real_root& root : real_roots(p)) {
      if (root.value > time_ && sign_just_after(p, root.value) == CGAL::POSITIVE) return root.value;
    }
    return std::nullopt;
  }

  void find_contact(Point_id a, Point_id b) {
    const Polynomial p = gap(motions_.at(a), motions_.at(b));
    const auto from = passing_.contains({a, b}) ? rise(p) : std::optional(time_);
    const auto time = from ? fall(p, *from) : std::nullopt;
    contacts_[{a, b, false}] =
        time ? std::optional(All_pairs_contact{*time, Event_kind::collision, a, b}) : std::nullopt;
  }

  // All contacts of a point.
  void find_contacts(Point_id id) {
    std::erase_if(contacts_, [&](const auto& entry) {
      const auto& [a, b, is_wall] = entry.first;
      return a == id || (b == id && !is_wall);
    });
    if (!motions_.contains(id)) return;
    if (options_.box) {
      for (Point_id wall = 0; wall < walls_.size(); ++wall) {
        const auto time = fall(clearance(motions_.at(id), walls_[wall]), time_);
        if (time) contacts_[{id, wall, true}] = {*time, Event_kind::wall, id, wall};
      }
    }
    if (!options_.response) return;
    for (const auto& [other, motion] : motions_) {
      if (other != id) find_contact(std::min(id, other), std::max(id, other));
    }
  }

  Motion clamped(Motion motion) const {
    if (!options_.box) return motion;
    for (Wall_2 wall : walls_) {
      wall.clearance = options_.rim_touches ? options_.radius : 0;
      wall.rim_touches = HasWeight<Motion> && options_.rim_touches;
      motion = clamped_inside(motion, wall, time_.tight_interval());
    }
    return motion;
  }

  static double growth_of(const Motion& motion) {
    if constexpr (HasWeight<Motion>) return motion.growth;
    return 0;
  }
  double mass(Point_id id) const { return id < options_.masses.size() ? options_.masses[id] : 1; }

  bool do_approach(const Motion& p, const Motion& q) const {
    return sign_just_after(derivative(gap(p, q)), time_) == CGAL::NEGATIVE;
  }

  // Whether a pair, with its present motions, has been apart at some time from `since` to now.
  bool has_separated(const Edge_ids& pair, const Algebraic_number& since) const {
    const Polynomial p = gap(motions_.at(pair[0]), motions_.at(pair[1]));
    if (sign_at(p, time_) == CGAL::POSITIVE) return true;
    if (since == time_) return false;
    if (sign_just_after(p, since) == CGAL::POSITIVE) return true;
    if (p.degree() < 1) return false;
    return std::ranges::any_of(real_roots(p), [&](const Real_root& root) {
      return root.value > since && root.value < time_ &&
             sign_just_after(p, root.value) == CGAL::POSITIVE;
    });
  }

  // Removes pairs of a point that pass through each other no more.
  void end_passes(Point_id id) {
    std::erase_if(passing_, [&](const auto& pass) {
      const auto& [pair, since] = pass;
      if (pair[0] != id && pair[1] != id) return false;
      return !motions_.contains(pair[0]) || !motions_.contains(pair[1]) ||
             has_separated(pair, since);
    });
  }

  void change(Point_id id, const std::optional<Motion>& motion) {
    end_passes(id);
    if (motion) {
      motions_[id] = *motion;
    } else {
      motions_.erase(id);
    }
    changed_.insert(id);
  }
  void finish_changes() {
    for (auto& [pair, since] : passing_) {
      if (changed_.contains(pair[0]) || changed_.contains(pair[1])) since = time_;
    }
    for (const Point_id id : changed_) end_passes(id);
    for (const Point_id id : changed_) find_contacts(id);
    changed_.clear();
  }

  void hit_wall(Point_id id, const Wall_2& wall) {
    const Motion& motion = motions_.at(id);
    if (sign_at(derivative(clearance(motion, wall)), time_) != CGAL::NEGATIVE) {
      is_pressed_ = true;
      return;
    }
    const double time = time_.to_double();
    Vector_2 velocity = rounded_velocity(motion, time);
    double& component = wall.is_vertical() ? velocity.x : velocity.y;
    component = -component;
    if (options_.rim_touches) component += (wall.is_upper() ? -2 : 2) * growth_of(motion);
    change(id, clamped(with_velocity_at(motion, velocity, time)));
    finish_changes();
  }

  void collide(Point_id a, Point_id b) {
    passing_.erase({a, b});
    const double time = time_.to_double();
    const Motion p = motions_.at(a);
    const Motion q = motions_.at(b);
    const auto moving = [&](const Motion& motion, const Vector_2& velocity) {
      return clamped(with_velocity_at(motion, velocity, time));
    };
    const auto would_approach = [&](const Vector_2& v, const Vector_2& w) {
      return do_approach(moving(p, v), moving(q, w));
    };
    const Vector_2 place_p = rounded_place(p, time);
    const Vector_2 place_q = rounded_place(q, time);
    const Polynomial distance = interpolate(1, [&](const Rational& t) {
      return Rational(radius_at(p, t, options_) + radius_at(q, t, options_));
    });
    // Without radii the square of the gap has no slope at any speed.
    const bool is_pressed = sign_at(distance, time_) == CGAL::POSITIVE &&
                            sign_at(derivative(gap(p, q)), time_) != CGAL::NEGATIVE;
    const Contact_response_2 response =
        options_.response({time,
                           a,
                           b,
                           {place_q.x - place_p.x, place_q.y - place_p.y},
                           rounded_velocity(p, time),
                           rounded_velocity(q, time),
                           mass(a),
                           mass(b),
                           growth_of(p),
                           growth_of(q),
                           is_pressed,
                           would_approach});
    const auto after = [&](const Motion& motion, bool stops,
                           const std::optional<Vector_2>& velocity) -> std::optional<Motion> {
      if (stops && is_at_rest(motion)) return std::nullopt;
      if (stops) return clamped(at_rest_at(motion, time));
      if (!velocity || *velocity == rounded_velocity(motion, time)) return std::nullopt;
      return moving(motion, *velocity);
    };
    const auto new_p = after(p, response.stops_a, response.velocity_a);
    const auto new_q = after(q, response.stops_b, response.velocity_b);
    if (is_pressed && response.is_motion_given() &&
        do_approach(new_p.value_or(p), new_q.value_or(q))) {
      is_pressed_ = true;
      return;
    }
    if (response.erases_a) change(a, std::nullopt);
    if (response.erases_b) change(b, std::nullopt);
    if (!response.erases_a && new_p) change(a, new_p);
    if (!response.erases_b && new_q) change(b, new_q);
    if (changed_.empty()) {
      passing_.insert_or_assign(Edge_ids{a, b}, time_);
      find_contact(a, b);
    } else {
      finish_changes();
    }
  }

  Simulation_options options_;
  std::array<Wall_2, 4> walls_ = {};
  Algebraic_number time_;
  std::map<Point_id, Motion> motions_;
  std::map<std::tuple<Point_id, Point_id, bool>, std::optional<All_pairs_contact>> contacts_;
  std::map<Edge_ids, Algebraic_number> passing_;  // pairs that pass through each other, since when
  std::set<Point_id> changed_;                    // by the present contact
  bool is_pressed_ = false;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_ALL_PAIRS_SIMULATOR_H
