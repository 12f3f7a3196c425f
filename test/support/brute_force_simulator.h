// SPDX-License-Identifier: GPL-3.0-or-later
//
// A slow, simple oracle for few moving points. It finds all critical times, at which three points
// are collinear, four cocircular or two coincide, and between these the Delaunay edges by examining
// all pairs and circles. If four points stay cocircular, determinants with x y and then x^2 in
// place of x^2 + y^2 decide, and their roots are critical times too. It shares with the library
// only the algebra. Points may be inserted, erased, and given other motions.
#ifndef KINETRI_TEST_SUPPORT_BRUTE_FORCE_SIMULATOR_H
#define KINETRI_TEST_SUPPORT_BRUTE_FORCE_SIMULATOR_H

#include <algorithm>
#include <array>
#include <concepts>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/events/event.h"
#include "support/motions.h"

namespace kinetri::test {

/// Determinants with x^2 + y^2, x y or x^2 in the last column. The first that is not zero (for
/// moving points: not zero at all times) decides whether d is inside the circle of a, b, c.
inline std::array<Rational, 3> in_circle_determinants(const Static_point& a, const Static_point& b,
                                                      const Static_point& c,
                                                      const Static_point& d) {
  const std::array rows = {a - d, b - d, c - d};
  const auto with = [&](const auto& column) {
    return Rational(CGAL::determinant(rows[0].x(), rows[0].y(), column(rows[0]),  //
                                      rows[1].x(), rows[1].y(), column(rows[1]),  //
                                      rows[2].x(), rows[2].y(), column(rows[2])));
  };
  return {with([](const auto& v) { return v.squared_length(); }),
          with([](const auto& v) { return v.x() * v.y(); }),
          with([](const auto& v) { return v.x() * v.x(); })};
}

/// The Delaunay edges of static points. Cocircular points count as cocircular at all times.
inline std::set<Edge_ids> static_edges(const std::vector<Static_point>& points) {
  std::set<Edge_ids> result;
  const auto n = static_cast<Point_id>(points.size());
  for (Point_id a = 0; a < n; ++a) {
    for (Point_id b = a + 1; b < n; ++b) {
      // a and b have an edge if and only if some circle through them has no point inside. Each
      // point to the left bounds the centers of these circles from one side, each point to the
      // right from the other.
      bool is_edge = true;
      std::vector<Point_id> left;
      std::vector<Point_id> right;
      for (Point_id c = 0; c < n; ++c) {
        if (c == a || c == b) continue;
        switch (CGAL::orientation(points[a], points[b], points[c])) {
          case CGAL::LEFT_TURN:
            left.push_back(c);
            break;
          case CGAL::RIGHT_TURN:
            right.push_back(c);
            break;
          default:
            if (CGAL::collinear_are_ordered_along_line(points[a], points[c], points[b])) {
              is_edge = false;
            }
        }
      }
      for (const Point_id c : left) {
        for (const Point_id d : right) {
          const auto sides = in_circle_determinants(points[a], points[b], points[c], points[d]);
          const auto deciding = std::ranges::find_if(sides, [](const auto& s) { return s != 0; });
          if (deciding != sides.end() && *deciding > 0) is_edge = false;
        }
      }
      if (is_edge) result.insert({a, b});
    }
  }
  return result;
}

/// The polynomial of degree at most `degree` that interpolates `value` at 0, 1, ..., degree, up to
/// a positive factor. Newton's divided differences.
inline Polynomial interpolate(int degree, const std::function<Rational(const Rational&)>& value) {
  std::vector<Rational> differences;
  for (int i = 0; i <= degree; ++i) differences.push_back(value(Rational(i)));
  for (int order = 1; order <= degree; ++order) {
    for (int i = degree; i >= order; --i) {
      auto& d = differences[static_cast<std::size_t>(i)];
      d = (d - differences[static_cast<std::size_t>(i - 1)]) / order;
    }
  }
  std::vector<Rational> coefficients = {differences.back()};
  for (int i = degree - 1; i >= 0; --i) {
    // coefficients * (t - i) + differences[i]
    std::vector<Rational> next(coefficients.size() + 1, Rational(0));
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
      next[k + 1] += coefficients[k];
      next[k] -= coefficients[k] * i;
    }
    next[0] += differences[static_cast<std::size_t>(i)];
    coefficients = std::move(next);
  }
  return primitive_polynomial(coefficients);
}

/// The times after `start` at which the Delaunay triangulation of the motions may change, sorted.
template <class Motion>
std::vector<Algebraic_number> critical_times(const std::vector<Motion>& motions,
                                             const Algebraic_number& start) {
  constexpr int d = std::same_as<Motion, Linear_motion_2> ? 1 : 3;  // greatest degree
  std::vector<Algebraic_number> times;
  // Adds the roots of a polynomial. Returns false if it is zero.
  const auto add_roots = [&](int degree, const std::function<Rational(const Rational&)>& value) {
    const Polynomial p = interpolate(degree, value);
    if (p.is_zero()) return false;
    for (const Real_root& root : real_roots(p)) {
      if (root.value > start) times.push_back(root.value);
    }
    return true;
  };
  const std::size_t n = motions.size();
  const auto at = [&](std::size_t i, const Rational& t) { return place_at(motions[i], t); };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      add_roots(2 * d,
                [&](const Rational& t) { return CGAL::squared_distance(at(i, t), at(j, t)); });
      for (std::size_t k = j + 1; k < n; ++k) {
        add_roots(2 * d, [&](const Rational& t) {
          return CGAL::determinant(at(j, t) - at(i, t), at(k, t) - at(i, t));
        });
        for (std::size_t l = k + 1; l < n; ++l) {
          for (std::size_t column = 0; column < 3; ++column) {
            const auto value = [&](const Rational& t) {
              return in_circle_determinants(at(i, t), at(j, t), at(k, t), at(l, t))[column];
            };
            if (add_roots(4 * d, value)) break;
          }
        }
      }
    }
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// The Delaunay edges of the motions at a rational time.
template <class Motion>
std::set<Edge_ids> edges_at(const std::vector<Motion>& motions, const Rational& t) {
  std::vector<Static_point> points;
  for (const Motion& m : motions) points.push_back(place_at(m, t));
  return static_edges(points);
}

/// A run of points that change at times that the caller chooses.
class Brute_force_simulator {
 public:
  explicit Brute_force_simulator(const Algebraic_number& start) : time_(start) {}

  const Algebraic_number& time() const { return time_; }

  /// The motions of the present points.
  const std::map<Point_id, Linear_motion_2>& motions() const { return motions_; }

  /// Gives a point, perhaps a new one, a motion from now on.
  void set_motion(Point_id id, const Linear_motion_2& motion) {
    motions_[id] = motion;
    find_critical_times();
  }
  void erase(Point_id id) {
    motions_.erase(id);
    find_critical_times();
  }

  /// The later times at which the triangulation may change, if no point is changed, sorted.
  const std::vector<Algebraic_number>& critical_times() const { return critical_times_; }

  /// Precondition: no critical time is between now and `time`; it may be `time` itself.
  void advance_to(const Algebraic_number& time) {
    time_ = time;
    const auto is_past = [&](const Algebraic_number& critical) { return critical <= time_; };
    std::erase_if(critical_times_, is_past);
  }

  /// The edges, by point ids, just after the present time: those until the next critical time.
  std::set<Edge_ids> edges() const {
    const Algebraic_number end = critical_times_.empty()
                                     ? Algebraic_number(Rational(time_.upper() + 1))
                                     : critical_times_.front();
    std::vector<Point_id> ids;
    for (const auto& [id, motion] : motions_) ids.push_back(id);
    std::set<Edge_ids> result;
    for (const auto& [a, b] : edges_at(motion_list(), simplest_between(time_, end))) {
      result.insert({ids[a], ids[b]});
    }
    return result;
  }

 private:
  std::vector<Linear_motion_2> motion_list() const {
    std::vector<Linear_motion_2> result;
    for (const auto& [id, motion] : motions_) result.push_back(motion);
    return result;
  }

  void find_critical_times() { critical_times_ = test::critical_times(motion_list(), time_); }

  Algebraic_number time_;
  std::map<Point_id, Linear_motion_2> motions_;
  std::vector<Algebraic_number> critical_times_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_BRUTE_FORCE_SIMULATOR_H
