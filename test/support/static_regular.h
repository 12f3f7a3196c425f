// SPDX-License-Identifier: GPL-3.0-or-later
//
// An oracle for few discs: the regular triangulation at a rational time by its definition.
#ifndef KINETRI_TEST_SUPPORT_STATIC_REGULAR_H
#define KINETRI_TEST_SUPPORT_STATIC_REGULAR_H

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "kinetri/kinetri.h"
#include "support/discs.h"

namespace kinetri::test {

/// The regular triangulation of discs at a time, by the definition: three of which all others are
/// above the lifted plane are a triangle. Of four, determinants with x^2 + y^2 - weight, x y, x^2
/// and y^2 decide, the first that is not zero at all times.
class Static_regular {
 public:
  Static_regular(const std::vector<Disc_motion_2>& discs, const Rational& time) : discs_(discs) {
    const auto n = static_cast<Point_id>(discs.size());
    for (Point_id a = 0; a < n; ++a) {
      for (Point_id b = a + 1; b < n; ++b) {
        for (Point_id c = b + 1; c < n; ++c) {
          if (is_triangle({a, b, c}, time)) {
            edges_.insert({{a, b}, {b, c}, {a, c}});
            visible_.insert({a, b, c});
          }
        }
      }
    }
  }

  /// Whether all signs at the time are those just beside it, and there is a triangle.
  bool is_certain() const { return is_certain_ && !edges_.empty(); }
  const std::set<Edge_ids>& edges() const { return edges_; }
  const std::set<Point_id>& visible() const { return visible_; }

 private:
  using Triple = std::array<Point_id, 3>;

  Rational turn(const Triple& t, const Rational& time) const {
    const auto at = [&](Point_id id) { return place_at(discs_[id], time); };
    return CGAL::determinant(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
  }

  Rational determinant(const Triple& t, Point_id d, int column, const Rational& time) const {
    const auto row = [&](Point_id id) {
      const auto v = place_at(discs_[id], time) - place_at(discs_[d], time);
      const Rational weight = to_rational(discs_[id].weight) - to_rational(discs_[d].weight);
      const std::array<Rational, 4> lifts = {v.squared_length() - weight, v.x() * v.y(),
                                             v.x() * v.x(), v.y() * v.y()};
      return std::array<Rational, 3>{v.x(), v.y(), lifts[static_cast<std::size_t>(column)]};
    };
    const auto a = row(t[0]);
    const auto b = row(t[1]);
    const auto c = row(t[2]);
    return CGAL::determinant(a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]);
  }

  // The value at the time of the polynomial, of degree 4 at most; none if it is zero at all times.
  template <class Value>
  std::optional<Rational> value_of(const Value& value, const Rational& time) {
    const Rational now = value(time);
    if (now != 0) return now;
    for (int k = 1; k <= 4; ++k) {
      if (value(Rational(time + k)) == 0) continue;
      is_certain_ = false;
      return now;
    }
    return std::nullopt;
  }

  bool is_triangle(Triple t, const Rational& time) {
    const auto turned = value_of([&](const Rational& s) { return turn(t, s); }, time);
    if (!turned) return false;
    if (*turned < 0) std::swap(t[1], t[2]);
    for (Point_id d = 0; d < discs_.size(); ++d) {
      if (std::ranges::count(t, d) > 0) continue;
      std::optional<Rational> above;
      for (int column = 0; column < 4 && !above; ++column) {
        above = value_of([&](const Rational& s) { return determinant(t, d, column, s); }, time);
      }
      if (!above || *above > 0) return false;
    }
    return true;
  }

  const std::vector<Disc_motion_2>& discs_;
  std::set<Edge_ids> edges_;
  std::set<Point_id> visible_;
  bool is_certain_ = true;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_STATIC_REGULAR_H
