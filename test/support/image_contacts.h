// SPDX-License-Identifier: GPL-3.0-or-later
//
// A slow, simple oracle for discs of one radius in a periodic box: the exact contact times of all
// pairs of images that are near enough, anew for each contact. It has no triangulation. It shares
// with the library only the algebra and the functions that change motions. It looks at four lines
// of images along the first vector on each side, so the box must not be much lower than the discs.
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

class Image_contacts {
 public:
  Image_contacts(const Periodic_box_2& box, const std::vector<Linear_motion_2>& motions,
                 const Simulation_options& options, const Algebraic_number& start = {})
      : box_(box), motions_(motions), options_(options), time_(start) {}

  const std::vector<Linear_motion_2>& motions() const { return motions_; }

  /// The next contact, if it is at or before `until`; executed if its discs are two.
  std::optional<Image_contact> step(double until) {
    std::optional<Image_contact> next = first_contact(until);
    if (!next) return std::nullopt;
    time_ = next->time;
    if (next->pair.ids[0] != next->pair.ids[1]) collide(next->pair);
    return next;
  }

 private:
  Image_motion_2 image(Point_id id, const Lattice_offset_2& offset) const {
    return {motions_[id], offset, &box_};
  }
  Vector_2 drift(const Lattice_offset_2& offset) const {
    const Vector_2& a = box_.first().velocity;
    const Vector_2& b = box_.second().velocity;
    return {offset.x * a.x + offset.y * b.x, offset.x * a.y + offset.y * b.y};
  }

  Polynomial gap(const Image_motion_2& p, const Image_motion_2& q) const {
    const Rational diameter = 2 * to_rational(options_.radius);
    return interpolate(2, [&](const Rational& t) {
      return Rational(CGAL::squared_distance(place_at(p, t), place_at(q, t)) - diameter * diameter);
    });
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
        const Vector_2 p = rounded_place(motions_[a], begin);
        const Vector_2 q = rounded_place(motions_[b], begin);
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
                std::hypot(motions_[b].velocity.x + shift.x - motions_[a].velocity.x,
                           motions_[b].velocity.y + shift.y - motions_[a].velocity.y);
            const double reach = 2 * options_.radius + speed * (end - begin);
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
        const auto time =
            contact_time(gap(image(pair.ids[0], {}), image(pair.ids[1], pair.offset)));
        if (!time || *time > Algebraic_number(end)) return;
        const Image_contact contact = {*time, pair};
        if (!first || contact < *first) first = contact;
      });
      if (first) return first;
    }
    return std::nullopt;
  }

  void collide(const Periodic_edge& pair) {
    const auto [a, b] = pair.ids;
    const double time = time_.to_double();
    const Vector_2 shift = drift(pair.offset);
    const Vector_2 place_a = rounded_place(motions_[a], time);
    const Vector_2 place_b = rounded_place(image(b, pair.offset), time);
    const Vector_2 before_a = motions_[a].velocity;
    const Vector_2 before_b = {motions_[b].velocity.x + shift.x, motions_[b].velocity.y + shift.y};
    const auto moving = [&](Point_id id, const Vector_2& velocity) {
      const Vector_2 own =
          id == a ? velocity : Vector_2{velocity.x - shift.x, velocity.y - shift.y};
      return with_velocity_at(motions_[id], own, time);
    };
    const auto would_approach = [&](const Vector_2& v, const Vector_2& w) {
      const Polynomial p = gap({moving(a, v), {}, &box_}, {moving(b, w), pair.offset, &box_});
      return sign_just_after(derivative(p), time_) == CGAL::NEGATIVE;
    };
    const Contact_response_2 response =
        options_.response({time,
                           a,
                           b,
                           {place_b.x - place_a.x, place_b.y - place_a.y},
                           before_a,
                           before_b,
                           1,
                           1,
                           0,
                           0,
                           false,
                           would_approach});
    const bool changes_a = response.velocity_a && *response.velocity_a != before_a;
    const bool changes_b = response.velocity_b && *response.velocity_b != before_b;
    if (!changes_a && !changes_b) {
      passed_.insert(pair);
      return;
    }
    if (changes_a) motions_[a] = moving(a, *response.velocity_a);
    if (changes_b) motions_[b] = moving(b, *response.velocity_b);
  }

  Periodic_box_2 box_;
  std::vector<Linear_motion_2> motions_;
  Simulation_options options_;
  Algebraic_number time_;
  std::set<Periodic_edge> passed_;  // pairs that pass through each other, with these motions
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_IMAGE_CONTACTS_H
