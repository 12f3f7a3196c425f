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
#include "support/image_pairs.h"

namespace kinetri::test {

/// A triangulation in a periodic box, for at most four units of time from 0 on.
class Periodic_run {
 public:
  using Kinetic = Kinetic_delaunay_triangulation_2<Periodic_kinetic_traits_2>;
  using Leg = Leg_recorder<Periodic_kinetic_traits_2>::Leg;
  using Legs = std::vector<std::vector<Leg>>;  ///< by id

  static constexpr int kinds = periodic_box_kinds;
  static const char* name(unsigned seed) { return periodic_box_kind(seed % kinds); }

  /// Of 1 to 6 points. Different seeds have boxes of different kinds.
  explicit Periodic_run(unsigned seed)
      : random_(seed),
        kind_(static_cast<int>(seed % kinds)),
        range_(seed % 3 == 0 ? 3 : 5),
        box_(random_periodic_box(random_, kind_, range_, end)),
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

  /// Calls function(pair, p, q) for each pair of images that may be as near to each other as
  /// `range` at a time, and others, with the motions of its ends: p and q are legs of images.
  template <class Function>
  void for_each_pair(double range, Function function) const {
    for_each_pair_of_images(box_, legs(), range, end, function);
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
