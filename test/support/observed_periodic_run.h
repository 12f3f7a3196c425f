// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs of a few points in periodic boxes of small integers, for tests of observers against brute
// force over pairs and offsets.
#ifndef KINETRI_TEST_SUPPORT_OBSERVED_PERIODIC_RUN_H
#define KINETRI_TEST_SUPPORT_OBSERVED_PERIODIC_RUN_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/encounter_oracle.h"

namespace kinetri::test {

/// A triangulation in a periodic box, for at most four units of time from 0 on.
class Periodic_run {
 public:
  using Kinetic = Kinetic_delaunay_triangulation_2<Periodic_kinetic_traits_2>;
  using Leg = Leg_recorder<Periodic_kinetic_traits_2>::Leg;
  using Legs = std::vector<std::vector<Leg>>;  ///< by id

  static constexpr int kinds = 4;
  static const char* name(unsigned seed) {
    constexpr std::array<const char*, kinds> names = {"at rest", "sheared", "growing", "turning"};
    return names[seed % kinds];
  }

  /// Of 1 to 6 points. Different seeds have boxes of different kinds.
  explicit Periodic_run(unsigned seed)
      : random_(seed),
        kind_(static_cast<int>(seed % kinds)),
        range_(seed % 3 == 0 ? 3 : 5),
        box_(random_box()),
        kinetic_(motions(1 + seed / kinds % 6), Algebraic_number(),
                 Periodic_kinetic_traits_2(box_)),
        recorder_(kinetic_, kinetic_) {}

  Kinetic& kinetic() { return kinetic_; }
  const Periodic_box_2& box() const { return box_; }
  Legs legs() const { return recorder_.legs(); }
  int integer(int least, int greatest) {
    return least + static_cast<int>(random_() % static_cast<unsigned>(greatest - least + 1));
  }
  Linear_motion_2 motion() {
    const auto coordinate = [&](int greatest) {
      return static_cast<double>(integer(-greatest, greatest));
    };
    const double x = coordinate(range_);
    const double y = coordinate(range_);
    const double vx = coordinate(2);
    return {{x, y}, {vx, coordinate(2)}, kinetic_time_};
  }

  /// A point turns, jumps, moves to another image of itself or of another point, comes or goes; at
  /// the present time, which is a half integer.
  void change() {
    kinetic_time_ = kinetic_.current_time().to_double();
    const auto id = static_cast<Point_id>(integer(0, static_cast<int>(kinetic_.next_id()) - 1));
    const int what = integer(0, 6);
    if (what == 0 && kinetic_.next_id() < 8) {
      kinetic_.insert(motion());
    } else if (!kinetic_.contains(id)) {
      return;
    } else if (what == 1 && kinetic_.number_of_points() > 1) {
      kinetic_.erase(id);
    } else if (what == 2) {
      kinetic_.set_motion(id, motion());
    } else if (what == 3 && kind_ == 0) {
      // To an image of another point, with which it coincides from then on, or of itself.
      const auto other =
          static_cast<Point_id>(integer(0, static_cast<int>(kinetic_.next_id()) - 1));
      if (!kinetic_.contains(other)) return;
      Linear_motion_2 there = kinetic_.motion(other);
      there.position.x += box_.first().position.x - box_.second().position.x;
      there.position.y += box_.first().position.y - box_.second().position.y;
      kinetic_.set_motion(id, there);
    } else if (what == 4) {
      std::vector<Point_id> ids;
      std::vector<Linear_motion_2> motions;
      for (Point_id each = 0; each < kinetic_.next_id(); ++each) {
        if (!kinetic_.contains(each)) continue;
        ids.push_back(each);
        motions.push_back(motion());
      }
      kinetic_.set_motions(ids, motions);
    } else {
      kinetic_.set_motion(
          id, with_velocity_at(kinetic_.motion(id),
                               {double(integer(-2, 2)), double(integer(-2, 2))}, kinetic_time_));
    }
  }

  /// So many that the images of a point within the range of another one have no greater offsets, as
  /// long as positions are not farther apart than `apart`.
  int greatest_offset(double range, double apart) const {
    double least_area = area(0);
    double length = 0;
    for (double t = 0; t <= end; t += 0x1p-6) {
      least_area = std::min(least_area, area(t));
      for (const Linear_motion_2* const vector : {&box_.first(), &box_.second()}) {
        const Vector_2 there = rounded_place(*vector, t);
        length = std::max(length, std::hypot(there.x, there.y));
      }
    }
    // Between these times the area falls by less than 1.
    return static_cast<int>((range + apart) * length / (least_area - 1)) + 1;
  }

  /// Calls function(pair, p, q) for each pair of images that may be as near to each other as
  /// `range` at a time, and others, with the motions of its ends: p and q are legs of images.
  template <class Function>
  void for_each_pair(double range, Function function) const {
    const Legs all = legs();
    double apart = 0;
    for (const auto& of_point : all) {
      for (const Leg& leg : of_point) {
        for (const double t : {0.0, end}) {
          const Vector_2 place = rounded_place(leg.motion, t);
          apart = std::max(apart, std::hypot(place.x, place.y));
        }
      }
    }
    const int most = greatest_offset(range, 2 * apart);
    for (Point_id a = 0; a < all.size(); ++a) {
      for (Point_id b = a; b < all.size(); ++b) {
        for (int k = -most; k <= most; ++k) {
          for (int l = -most; l <= most; ++l) {
            const Lattice_offset_2 offset = {k, l};
            if (a == b && !(Lattice_offset_2() < offset)) continue;
            if (!may_be_near(all[a], all[b], offset, range)) continue;
            function(Periodic_edge{{a, b}, offset}, images(all[a], {}), images(all[b], offset));
          }
        }
      }
    }
  }

  /// The pairs of images that are at most `range` apart just after the present time, a half
  /// integer.
  std::set<Periodic_edge> links_after(double range) const {
    std::set<Periodic_edge> result;
    const Rational now = to_rational(kinetic_.current_time().to_double());
    for_each_pair(range, [&](const Periodic_edge& pair, const auto& p, const auto& q) {
      const auto& [a, b] = pair.ids;
      if (!kinetic_.contains(a) || !kinetic_.contains(b)) return;
      // The squared distance less that of the range: its value and derivatives now, by differences.
      const auto value = [&](const Rational& t) {
        return Rational(
            CGAL::squared_distance(place_at(p.back().motion, t), place_at(q.back().motion, t)) -
            to_rational(range) * to_rational(range));
      };
      const Rational here = value(now);
      const Rational slope = (value(now + 1) - value(now - 1)) / 2;
      const Rational curvature = value(now + 1) - 2 * here + value(now - 1);
      const bool is_farther =
          here > 0 || (here == 0 && (slope > 0 || (slope == 0 && curvature > 0)));
      if (!is_farther) result.insert(pair);
    });
    return result;
  }

  /// Offsets of images of q, among them that of the nearest one to p at a time, and of all that are
  /// about as near: those of a distance of at most half the sum of the lengths of the lattice
  /// vectors.
  std::vector<Lattice_offset_2> offsets_near(const Linear_motion_2& p, const Linear_motion_2& q,
                                             const Rational& now) const {
    const double t = to_double(now);
    const Vector_2 a = rounded_place(box_.first(), t);
    const Vector_2 b = rounded_place(box_.second(), t);
    const Vector_2 place_p = rounded_place(p, t);
    const Vector_2 place_q = rounded_place(q, t);
    const Vector_2 d = {place_p.x - place_q.x, place_p.y - place_q.y};
    const double reach = (std::hypot(a.x, a.y) + std::hypot(b.x, b.y)) / 2;
    const double determinant = a.x * b.y - a.y * b.x;
    const double k0 = (d.x * b.y - d.y * b.x) / determinant;
    const double l0 = (a.x * d.y - a.y * d.x) / determinant;
    const int most_k = 1 + static_cast<int>(reach * std::hypot(b.x, b.y) / determinant);
    const int most_l = 1 + static_cast<int>(reach * std::hypot(a.x, a.y) / determinant);
    std::vector<Lattice_offset_2> result;
    for (int k = -most_k; k <= most_k; ++k) {
      for (int l = -most_l; l <= most_l; ++l) {
        const int x = static_cast<int>(std::lround(k0)) + k;
        const int y = static_cast<int>(std::lround(l0)) + l;
        const double away_x = d.x - x * a.x - y * b.x;
        const double away_y = d.y - x * a.y - y * b.y;
        if (std::hypot(away_x, away_y) <= 1.001 * reach) result.push_back({x, y});
      }
    }
    return result;
  }

  static constexpr double end = 4;

 private:
  using Image_leg = Leg_of<Image_motion_2>;

  double area(double t) const {
    const Vector_2 a = rounded_place(box_.first(), t);
    const Vector_2 b = rounded_place(box_.second(), t);
    return a.x * b.y - a.y * b.x;
  }

  std::vector<Image_leg> images(const std::vector<Leg>& legs,
                                const Lattice_offset_2& offset) const {
    std::vector<Image_leg> result;
    for (const Leg& leg : legs) {
      result.push_back({{leg.motion, offset, &box_},
                        leg.since,
                        leg.until,
                        leg.is_initial,
                        leg.is_last,
                        leg.goes_on});
    }
    return result;
  }

  // Whether p and an image of q may be within the range while both have one of their motions: by
  // the least distance of straight lines, in numbers that are exact but for the last division.
  bool may_be_near(const std::vector<Leg>& p, const std::vector<Leg>& q,
                   const Lattice_offset_2& offset, double range) const {
    const Vector_2 place_zero = rounded_place(Image_motion_2{{}, offset, &box_}, 0);
    const Vector_2 speed_zero = rounded_velocity(Image_motion_2{{}, offset, &box_}, 0);
    for (const Leg& a : p) {
      const Vector_2 place_a = rounded_place(a.motion, 0);
      for (const Leg& b : q) {
        const double since = std::max(a.since, b.since).to_double();
        const double until = std::min(*a.until, *b.until).to_double();
        if (since > until) continue;
        const Vector_2 place_b = rounded_place(b.motion, 0);
        const Vector_2 d = {place_a.x - place_b.x - place_zero.x,
                            place_a.y - place_b.y - place_zero.y};
        const Vector_2 v = {a.motion.velocity.x - b.motion.velocity.x - speed_zero.x,
                            a.motion.velocity.y - b.motion.velocity.y - speed_zero.y};
        const double speed = v.x * v.x + v.y * v.y;
        const double least =
            speed > 0 ? std::clamp(-(d.x * v.x + d.y * v.y) / speed, since, until) : since;
        const double x = d.x + least * v.x;
        const double y = d.y + least * v.y;
        if (x * x + y * y <= range * range + 0.001) return true;
      }
    }
    return false;
  }

  Periodic_box_2 random_box() {
    for (;;) {
      const auto vector = [&] {
        const double x = integer(-range_, range_);
        return Vector_2{x, static_cast<double>(integer(-range_, range_))};
      };
      const Vector_2 a = vector();
      const Vector_2 b = vector();
      Vector_2 rate_a;
      Vector_2 rate_b;
      if (kind_ == 1) rate_b = {a.x * 0.5, a.y * 0.5};
      if (kind_ == 2) {
        rate_a = {a.x * 0.25, a.y * 0.25};
        rate_b = {b.x * 0.5, b.y * 0.5};
      }
      if (kind_ == 3) {
        rate_a = {integer(-1, 1) * 0.25, integer(-1, 1) * 0.25};
        rate_b = {integer(-1, 1) * 0.25, integer(-1, 1) * 0.25};
      }
      bool has_area = true;
      for (double t = 0; t <= end; t += 0x1p-6) {
        const Vector_2 at_a = {a.x + t * rate_a.x, a.y + t * rate_a.y};
        const Vector_2 at_b = {b.x + t * rate_b.x, b.y + t * rate_b.y};
        has_area = has_area && at_a.x * at_b.y - at_a.y * at_b.x >= 4;
      }
      if (has_area) return {{a, rate_a, 0}, {b, rate_b, 0}};
    }
  }

  std::vector<Linear_motion_2> motions(std::size_t number) {
    std::vector<Linear_motion_2> result;
    while (result.size() < number) result.push_back(motion());
    return result;
  }

  std::mt19937 random_;
  int kind_;
  int range_;
  double kinetic_time_ = 0;
  Periodic_box_2 box_;
  Kinetic kinetic_;
  Leg_recorder<Periodic_kinetic_traits_2> recorder_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_OBSERVED_PERIODIC_RUN_H
