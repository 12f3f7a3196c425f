// SPDX-License-Identifier: GPL-3.0-or-later
//
// A slow, simple oracle for discs in a periodic box, of one radius or with radii of their own: the
// exact contact times of all pairs of images that are near enough, anew for each contact. It has no
// triangulation. It shares with the library only the algebra and the functions that change motions.
// It looks at four lines of images along the first vector on each side, so the box must not be much
// lower than the discs.
#ifndef KINETRI_TEST_SUPPORT_IMAGE_CONTACTS_H
#define KINETRI_TEST_SUPPORT_IMAGE_CONTACTS_H

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/brute_force_simulator.h"
#include "support/images.h"

namespace kinetri::test {

/// A contact of a disc and an image of another one, or of itself.
struct Image_contact {
  Algebraic_number time;
  Periodic_edge pair;

  friend bool operator<(const Image_contact& a, const Image_contact& b) {
    return a.time == b.time ? a.pair < b.pair : a.time < b.time;
  }
};

template <class Motion = Linear_motion_2>
class Image_contacts {
 public:
  using Motions = std::vector<std::optional<Motion>>;  ///< by id; none of an erased disc

  /// From `start` on; `passing` are pairs that a response has left in contact.
  template <class Given>
  Image_contacts(const Periodic_box_2& box, const std::vector<Given>& motions,
                 const Simulation_options& options, const Algebraic_number& start = {},
                 const std::vector<Periodic_edge>& passing = {})
      : box_(box),
        motions_(motions.begin(), motions.end()),
        options_(options),
        time_(start),
        passed_(passing.begin(), passing.end()) {}

  const Motions& motions() const { return motions_; }

  /// The pairs that overlap now, sorted; of one disc if it overlaps an image of itself.
  std::vector<Periodic_edge> overlaps() const {
    std::vector<Periodic_edge> result;
    const double now = time_.to_double();
    for_each_near(now, now, [&](const Periodic_edge& pair) {
      if (sign_at(gap(pair), time_) == CGAL::NEGATIVE) result.push_back(pair);
    });
    std::ranges::sort(result);
    return result;
  }

  /// The next contact, if it is at or before `until`; executed if its discs are two.
  std::optional<Image_contact> step(double until) {
    std::optional<Image_contact> next = first_contact(until);
    if (!next) return std::nullopt;
    time_ = next->time;
    if (next->pair.ids[0] != next->pair.ids[1]) collide(next->pair);
    return next;
  }

 private:
  using Image = Image_motion_of<Motion>;

  Image image(Point_id id, const Lattice_offset_2& offset) const {
    return image_of(*motions_[id], offset, &box_);
  }
  Vector_2 drift(const Lattice_offset_2& offset) const {
    const Vector_2& a = box_.first().velocity;
    const Vector_2& b = box_.second().velocity;
    return {offset.x * a.x + offset.y * b.x, offset.x * a.y + offset.y * b.y};
  }
  double growth(Point_id id) const {
    if constexpr (HasWeight<Motion>) {
      return motions_[id]->growth;
    } else {
      return 0;
    }
  }
  double mass(Point_id id) const { return id < options_.masses.size() ? options_.masses[id] : 1; }

  // The sum of the radii.
  Rational reach(const Image& p, const Image& q, const Rational& t) const {
    Rational result = 2 * to_rational(options_.radius);
    if constexpr (HasWeight<Motion>) {
      for (const Image* disc : {&p, &q}) {
        result += to_rational(disc->radius) +
                  to_rational(disc->growth) * (t - to_rational(epoch_of(*disc)));
      }
    }
    return result;
  }
  Polynomial gap(const Image& p, const Image& q) const {
    return interpolate(2, [&](const Rational& t) {
      const Rational contact = reach(p, q, t);
      const auto distance = CGAL::squared_distance(place_at(center(p), t), place_at(center(q), t));
      return Rational(distance - contact * contact);
    });
  }
  Polynomial gap(const Periodic_edge& pair) const {
    return gap(image(pair.ids[0], {}), image(pair.ids[1], pair.offset));
  }

  // When a pair is in contact from now on: touches or overlaps, and approaches.
  std::optional<Algebraic_number> contact_time(const Polynomial& p) const {
    if (p.degree() < 1) return std::nullopt;
    const Polynomial slope = derivative(p);
    if (sign_at(p, time_) != CGAL::POSITIVE && sign_just_after(slope, time_) == CGAL::NEGATIVE) {
      return time_;
    }
    for (const Real_root& root : real_roots(p)) {
      if (root.value > time_ && sign_just_after(slope, root.value) == CGAL::NEGATIVE) {
        return root.value;
      }
    }
    return std::nullopt;
  }

  // Calls look(pair) with all pairs of images that may be in contact from `begin` to `end`: their
  // distance at the beginning is not much more than what they may approach.
  template <class Look>
  void for_each_near(double begin, double end, const Look& look) const {
    const Vector_2 first = rounded_place(box_.first(), begin);
    const Vector_2 second = rounded_place(box_.second(), begin);
    const double area = first.x * second.y - first.y * second.x;
    const double square = first.x * first.x + first.y * first.y;
    for (Point_id a = 0; a < motions_.size(); ++a) {
      for (Point_id b = a; b < motions_.size(); ++b) {
        if (!motions_[a] || !motions_[b]) continue;
        const Vector_2 p = rounded_place(*motions_[a], begin);
        const Vector_2 q = rounded_place(*motions_[b], begin);
        const Vector_2 d = {p.x - q.x, p.y - q.y};
        // Of each line of images along the first vector those that are nearest.
        const auto l0 = std::lround((first.x * d.y - first.y * d.x) / area);
        constexpr long around = 4;
        for (long l = l0 - around; l <= l0 + around; ++l) {
          const auto lines = static_cast<double>(l);
          const Vector_2 rest = {d.x - lines * second.x, d.y - lines * second.y};
          const auto k0 = std::lround((rest.x * first.x + rest.y * first.y) / square);
          for (long k = k0 - around; k <= k0 + around; ++k) {
            const Lattice_offset_2 offset = {static_cast<std::int32_t>(k),
                                             static_cast<std::int32_t>(l)};
            if (a == b && !(Lattice_offset_2() < offset)) continue;
            const Vector_2 there = rounded_place(image(b, offset), begin);
            const Vector_2 shift = drift(offset);
            const double speed =
                std::hypot(motions_[b]->velocity.x + shift.x - motions_[a]->velocity.x,
                           motions_[b]->velocity.y + shift.y - motions_[a]->velocity.y);
            double reach = 2 * options_.radius + speed * (end - begin);
            if constexpr (HasWeight<Motion>) {
              for (const double t : {begin, end}) {
                reach += std::abs(rounded_radius(*motions_[a], t)) +
                         std::abs(rounded_radius(*motions_[b], t));
              }
            }
            if (std::hypot(there.x - p.x, there.y - p.y) <= 1.01 * reach + 0.01) {
              look(Periodic_edge{{a, b}, offset});
            }
          }
        }
      }
    }
  }

  // Looks a short while ahead at a time, in which few images come near.
  std::optional<Image_contact> first_contact(double until) const {
    constexpr double while_ahead = 0.5;
    for (double begin = time_.to_double(); begin <= until; begin += while_ahead) {
      const double end = std::min(begin + while_ahead, until);
      std::optional<Image_contact> first;
      for_each_near(begin, end, [&](const Periodic_edge& pair) {
        if (passed_.contains(pair)) return;
        const auto time = contact_time(gap(pair));
        if (!time || *time > Algebraic_number(end)) return;
        const Image_contact contact = {*time, pair};
        if (!first || contact < *first) first = contact;
      });
      if (first) return first;
    }
    return std::nullopt;
  }

  void collide(const Periodic_edge& pair) {
    const Point_id a = pair.ids[0];
    const Point_id b = pair.ids[1];
    const double time = time_.to_double();
    const Vector_2 shift = drift(pair.offset);
    const Vector_2 place_a = rounded_place(*motions_[a], time);
    const Vector_2 place_b = rounded_place(image(b, pair.offset), time);
    const Vector_2 before_a = motions_[a]->velocity;
    const Vector_2 before_b = {motions_[b]->velocity.x + shift.x,
                               motions_[b]->velocity.y + shift.y};
    const auto moving = [&](Point_id id, const Vector_2& velocity) {
      const Vector_2 own =
          id == a ? velocity : Vector_2{velocity.x - shift.x, velocity.y - shift.y};
      return with_velocity_at(*motions_[id], own, time);
    };
    const auto would_approach = [&](const Vector_2& v, const Vector_2& w) {
      const Polynomial p =
          gap(image_of(moving(a, v), {}, &box_), image_of(moving(b, w), pair.offset, &box_));
      return sign_just_after(derivative(p), time_) == CGAL::NEGATIVE;
    };
    const Polynomial contact = interpolate(
        1, [&](const Rational& t) { return reach(image(a, {}), image(b, pair.offset), t); });
    // Without radii the square of the gap has no slope at any speed.
    const bool is_pressed = sign_at(contact, time_) == CGAL::POSITIVE &&
                            sign_at(derivative(gap(pair)), time_) != CGAL::NEGATIVE;
    const Contact_response_2 response =
        options_.response({time,
                           a,
                           b,
                           {place_b.x - place_a.x, place_b.y - place_a.y},
                           before_a,
                           before_b,
                           mass(a),
                           mass(b),
                           growth(a),
                           growth(b),
                           is_pressed,
                           would_approach});
    // The motion of a disc afterwards; none if it is erased.
    const auto after = [&](Point_id id, bool erases, bool stops,
                           const std::optional<Vector_2>& velocity,
                           const Vector_2& before) -> std::optional<Motion> {
      if (erases) return std::nullopt;
      if (stops) return is_at_rest(*motions_[id]) ? motions_[id] : at_rest_at(*motions_[id], time);
      return velocity && *velocity != before ? moving(id, *velocity) : motions_[id];
    };
    const auto after_a =
        after(a, response.erases_a, response.stops_a, response.velocity_a, before_a);
    const auto after_b =
        after(b, response.erases_b, response.stops_b, response.velocity_b, before_b);
    if (after_a == motions_[a] && after_b == motions_[b]) {
      passed_.insert(pair);
      return;
    }
    end_passes(pair.ids);
    motions_[a] = after_a;
    motions_[b] = after_b;
    end_passes(pair.ids);
  }

  // Pairs that a response has let pass, and that are apart now or are no more, may come into
  // contact again. If both keep their motions, they do not: the distance of their boundaries is
  // convex in time.
  void end_passes(const Edge_ids& changed) {
    std::erase_if(passed_, [&](const Periodic_edge& pair) {
      const auto is_changed = [&](Point_id id) {
        return std::ranges::find(changed, id) != changed.end();
      };
      if (!is_changed(pair.ids[0]) && !is_changed(pair.ids[1])) return false;
      return !motions_[pair.ids[0]] || !motions_[pair.ids[1]] ||
             sign_at(gap(pair), time_) == CGAL::POSITIVE;
    });
  }

  Periodic_box_2 box_;
  Motions motions_;
  Simulation_options options_;
  Algebraic_number time_;
  std::set<Periodic_edge> passed_;  // pairs that pass through each other
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_IMAGE_CONTACTS_H
