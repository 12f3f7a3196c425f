// SPDX-License-Identifier: GPL-3.0-or-later
//
// All encounters of all pairs, from the motions alone, in exact arithmetic.
#ifndef KINETRI_TEST_SUPPORT_ENCOUNTER_ORACLE_H
#define KINETRI_TEST_SUPPORT_ENCOUNTER_ORACLE_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "algebra/root_difference.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/observers/encounters.h"
#include "support/discs.h"
#include "support/images.h"
#include "support/motions.h"

namespace kinetri::test {

/// A motion from one time to another one, both included.
template <class Motion>
struct Leg_of {
  Motion motion;
  Algebraic_number since;
  std::optional<Algebraic_number> until = std::nullopt;  // none while it lasts
  bool is_initial = false;                               // the point existed before the first time
  bool is_last = false;                                  // the point was erased at the end
  bool goes_on = false;                                  // lasts at the present time

  // Whether the point has it just before, or just after, the events of a time.
  bool is_before(const Algebraic_number& t) const { return since < t || is_initial; }
  bool is_after(const Algebraic_number& t) const { return *until > t || goes_on; }
};

/// Records the motions of each point as an observer.
template <class Traits>
class Leg_recorder : public Event_observer {
 public:
  using Motion = typename Traits::Motion;
  using Leg = Leg_of<Motion>;

  template <class Observed>  // a simulation or a triangulation
  Leg_recorder(Observed& observed, const Kinetic_triangulation_2<Traits>& triangulation)
      : triangulation_(triangulation) {
    observed.add_observer(*this);
    for (Point_id id = 0; id < triangulation_.next_id(); ++id) {
      if (!triangulation_.contains(id)) continue;
      note(id, triangulation_.current_time());
      legs_[id].back().is_initial = true;
    }
  }
  explicit Leg_recorder(Simulation_2<Traits>& simulation)
      : Leg_recorder(simulation, simulation.triangulation()) {}

  /// By id, in the order of time. Motions that last get the present time as their end.
  std::vector<std::vector<Leg>> legs() const {
    auto result = legs_;
    for (auto& legs_of_point : result) {
      for (Leg& leg : legs_of_point) {
        if (leg.until) continue;
        leg.until = triangulation_.current_time();
        leg.goes_on = true;
      }
    }
    return result;
  }

 private:
  void after_event(const Event& event) override {
    if (event.kind == Event_kind::hide || event.kind == Event_kind::reveal) return;
    for (const auto& id : {event.point_a, event.point_b}) {
      if (id) note(*id, event.time);
    }
  }

  void note(Point_id id, const Algebraic_number& time) {
    if (id >= legs_.size()) legs_.resize(id + 1);
    auto& legs = legs_[id];
    if (!legs.empty() && !legs.back().until) {
      if (triangulation_.contains(id) && triangulation_.motion(id) == legs.back().motion) return;
      legs.back().until = time;
      // Of several motions that begin at one time only the last one counts.
      if (legs.back().since == time && !legs.back().is_initial) legs.pop_back();
    }
    if (triangulation_.contains(id)) {
      legs.push_back({triangulation_.motion(id), time});
    } else if (!legs.empty()) {
      legs.back().is_last = true;
    }
  }

  const Kinetic_triangulation_2<Traits>& triangulation_;
  std::vector<std::vector<Leg>> legs_;
};

namespace encounter_oracle {

using Coefficients = std::vector<Rational>;

/// The coefficients of the polynomial that interpolates `value`.
template <class Value>
Coefficients interpolation(int degree, Value value) {
  // Newton's divided differences at 0, 1, ..., degree.
  std::vector<Rational> differences;
  for (int i = 0; i <= degree; ++i) differences.push_back(value(Rational(i)));
  const auto size = differences.size();
  for (std::size_t order = 1; order < size; ++order) {
    for (std::size_t i = size - 1; i >= order; --i) {
      differences[i] = (differences[i] - differences[i - 1]) / Rational(order);
    }
  }
  Coefficients result(size);
  for (std::size_t i = size; i-- > 0;) {
    // result * (t - i) + differences[i]
    for (std::size_t k = size - 1; k > 0; --k) result[k] = result[k - 1] - Rational(i) * result[k];
    result[0] = differences[i] - Rational(i) * result[0];
  }
  return result;
}

template <class Motion>
Rational radius_of(const Motion& motion, double radius, const Rational& t) {
  if constexpr (HasWeight<Motion>) {
    return radius_at(motion, t);
  } else {
    return to_rational(radius);
  }
}

/// Functions of time of a pair with given motions.
struct Functions {
  Coefficients squared_distance;
  Coefficients radii;  // their sum
  Polynomial excess;   // negative if the gap is less than the range

  template <class Motion>
  Functions(const Motion& p, const Motion& q, double radius, double range) {
    constexpr bool is_linear = std::is_same_v<Center_motion_of<Motion>, Linear_motion_2> ||
                               std::is_same_v<Center_motion_of<Motion>, Image_motion_2>;
    constexpr int degree = is_linear ? 2 : 6;
    squared_distance = interpolation(degree, [&](const Rational& t) {
      return Rational(CGAL::squared_distance(place_at(center(p), t), place_at(center(q), t)));
    });
    radii = interpolation(1, [&](const Rational& t) {
      return Rational(radius_of(p, radius, t) + radius_of(q, radius, t));
    });
    // Less the square of the greatest distance within the range.
    const Rational reach = radii[0] + to_rational(range);
    Coefficients difference = squared_distance;
    difference[0] -= reach * reach;
    difference[1] -= 2 * reach * radii[1];
    difference[2] -= radii[1] * radii[1];
    excess = primitive_polynomial(difference);
  }

  /// Zero at minima of the gap.
  Polynomial critical() const {
    Coefficients slope;
    for (std::size_t i = 1; i < squared_distance.size(); ++i) {
      slope.push_back(squared_distance[i] * Rational(i));
    }
    const auto value = [](const Coefficients& f, const Rational& t) {
      Rational result = 0;
      for (std::size_t i = f.size(); i-- > 0;) result = result * t + f[i];
      return result;
    };
    const int degree = static_cast<int>(squared_distance.size()) - 1;
    const Polynomial result =
        primitive_polynomial(interpolation(2 * degree, [&](const Rational& t) {
          const Rational s = value(slope, t);
          return Rational(s * s - 4 * radii[1] * radii[1] * value(squared_distance, t));
        }));
    // Zero if the gap is piecewise linear.
    return result.is_zero() ? primitive_polynomial(slope) : result;
  }
};

inline std::vector<Algebraic_number> roots_between(const Polynomial& p, const Algebraic_number& a,
                                                   const Algebraic_number& b) {
  std::vector<Algebraic_number> result;
  if (p.is_zero()) return result;
  for (const Real_root& root : real_roots(p)) {
    if (a <= root.value && root.value <= b) result.push_back(root.value);
  }
  return result;
}

using Time_interval = std::pair<Algebraic_number, Algebraic_number>;

/// The maximal intervals in [a, b] in which a polynomial is not positive.
inline std::vector<Time_interval> not_positive(const Polynomial& p, const Algebraic_number& a,
                                               const Algebraic_number& b) {
  std::vector<Algebraic_number> times = {a};
  for (const Algebraic_number& root : roots_between(p, a, b)) {
    if (root != times.back()) times.push_back(root);
  }
  if (b != times.back()) times.push_back(b);
  std::vector<Time_interval> result;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (sign_at(p, times[i]) == CGAL::POSITIVE) continue;
    const bool goes_on = !result.empty() && i > 0 && result.back().second == times[i - 1] &&
                         p.sign_at(simplest_between(times[i - 1], times[i])) != CGAL::POSITIVE;
    if (goes_on) {
      result.back().second = times[i];
    } else {
      result.emplace_back(times[i], times[i]);
    }
  }
  return result;
}

}  // namespace encounter_oracle

/// Adds the encounters of two points, or images, with these legs. `points` has their names. Two of
/// which one is erased and the other one inserted at one time meet then if `may_replace`.
template <class Legs>
void add_encounters(const std::vector<Legs>& legs_a, const std::vector<Legs>& legs_b,
                    const Periodic_edge& points, double radius, double range, bool may_replace,
                    std::vector<Encounter>& result) {
  using namespace encounter_oracle;
  bool is_present = false;
  Encounter present;
  Algebraic_number least;  // of its gaps
  const auto close = [&] {
    if (is_present) result.push_back(present);
    is_present = false;
  };
  // A leg ends when the next one begins or the point is erased. Two legs share a time if both
  // are those just before it, or both just after it, or if one point is erased and the other
  // inserted then.
  const auto are_at_one_time = [may_replace](const Legs& p, const Legs& q, bool p_is_first,
                                             bool q_is_first, const Algebraic_number& t) {
    const auto comes = [&](const Legs& leg, bool is_first) {
      return is_first && !leg.is_initial && leg.since == t;
    };
    return (p.is_before(t) && q.is_before(t)) || (p.is_after(t) && q.is_after(t)) ||
           (may_replace &&
            ((p.is_last && comes(q, q_is_first)) || (q.is_last && comes(p, p_is_first))));
  };
  for (std::size_t i = 0, j = 0; i < legs_a.size() && j < legs_b.size();) {
    const auto& p = legs_a[i];
    const auto& q = legs_b[j];
    const Algebraic_number since = std::max(p.since, q.since);
    const Algebraic_number until = std::min(*p.until, *q.until);
    if (since < until || (since == until && are_at_one_time(p, q, i == 0, j == 0, since))) {
      const Functions functions(p.motion, q.motion, radius, range);
      const auto intervals = not_positive(functions.excess, since, until);
      const Polynomial critical = intervals.empty() ? Polynomial() : functions.critical();
      for (const auto& [from, to] : intervals) {
        const bool goes_on = is_present && from == since && present.end == since;
        if (!goes_on) {
          close();
          is_present = true;
          present = Encounter{points.ids, from, to, from, 0, 0, points.offset};
        }
        present.end = to;
        std::vector<Algebraic_number> times = {from};
        for (const auto& root : roots_between(critical, from, to)) {
          times.push_back(root);
        }
        times.push_back(to);
        bool is_first = !goes_on;
        for (const Algebraic_number& time : times) {
          const Algebraic_number gap =
              root_difference_at(functions.squared_distance, functions.radii, time);
          if (!is_first && gap >= least) continue;
          is_first = false;
          least = gap;
          present.closest = time;
          present.distance = root_difference_at(functions.squared_distance, {}, time).to_double();
          present.gap = gap.to_double();
        }
      }
    }
    // Of two that end at one time the one that has no next leg stays, for the other's next one.
    const bool p_is_last = i + 1 == legs_a.size();
    const bool q_is_last = j + 1 == legs_b.size();
    const auto order = *p.until <=> *q.until;
    if (order < 0 || (order == 0 && (!p_is_last || q_is_last))) ++i;
    if (order > 0 || (order == 0 && (!q_is_last || p_is_last))) ++j;
  }
  close();
}

inline void sort_encounters(std::vector<Encounter>& encounters) {
  std::sort(encounters.begin(), encounters.end(), [](const Encounter& a, const Encounter& b) {
    const auto order = a.begin <=> b.begin;
    if (order != 0) return order < 0;
    return Periodic_edge{a.points, a.offset} < Periodic_edge{b.points, b.offset};
  });
}

/// The encounters of these motions, in the order of Encounters. `radius` is the common radius of
/// points.
template <class Legs>
std::vector<Encounter> expected_encounters(const std::vector<std::vector<Legs>>& legs,
                                           double radius, double range) {
  std::vector<Encounter> result;
  for (Point_id a = 0; a < legs.size(); ++a) {
    for (Point_id b = a + 1; b < legs.size(); ++b) {
      add_encounters(legs[a], legs[b], {{a, b}, {}}, radius, range, true, result);
    }
  }
  sort_encounters(result);
  return result;
}

inline std::string text_of(const Encounter& encounter) {
  std::ostringstream out;
  out.precision(17);
  out << encounter.points[0] << ' ' << encounter.points[1] << " (" << encounter.offset.x << ", "
      << encounter.offset.y << ") from " << encounter.begin.to_double() << " to "
      << encounter.end.to_double() << ", closest at " << encounter.closest.to_double() << ": "
      << encounter.distance << ", gap " << encounter.gap;
  return out.str();
}

inline void expect_equal(const std::vector<Encounter>& found,
                         const std::vector<Encounter>& expected) {
  const std::size_t number = std::min(found.size(), expected.size());
  for (std::size_t i = 0; i < number; ++i) {
    const Encounter& a = found[i];
    const Encounter& b = expected[i];
    ASSERT_TRUE(a.points == b.points && a.offset == b.offset && a.begin == b.begin &&
                a.end == b.end && a.closest == b.closest && a.distance == b.distance &&
                a.gap == b.gap)
        << "found    " << text_of(a) << "\nexpected " << text_of(b);
  }
  EXPECT_EQ(found.size(), expected.size())
      << (found.size() > number ? "found " + text_of(found[number])
                                : "expected " + text_of(expected[number]));
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_ENCOUNTER_ORACLE_H
