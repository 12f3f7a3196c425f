// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run and its transformations: mirrored, moved, scaled in space or time, reversed. Events must
// correspond, except for diagonals of points that stay cocircular if the axes change.
#ifndef KINETRI_TEST_SUPPORT_TRANSFORMED_RUN_H
#define KINETRI_TEST_SUPPORT_TRANSFORMED_RUN_H

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/brute_force_simulator.h"
#include "support/kinetic_runs.h"

namespace kinetri::test {

/// Steps that are exact for small integers, applied in the order of the members.
struct Transformation {
  bool reversed = false;    ///< time runs from some T to 0
  bool mirrored = false;    ///< x becomes -x
  bool transposed = false;  ///< x becomes y
  int shift = 0;            ///< (x, y) becomes (x + shift, y - 3 shift)
  int drift = 0;            ///< the same for velocities
  int scale = 0;            ///< lengths are multiplied by 2^scale
  int clock = 0;            ///< times are multiplied by 2^clock
  int epoch = 0;            ///< motions are written with this epoch
  bool renumbered = false;  ///< the last point is the first one

  friend std::ostream& operator<<(std::ostream& out, const Transformation& t) {
    return out << "reversed " << t.reversed << " mirrored " << t.mirrored << " transposed "
               << t.transposed << " shift " << t.shift << " drift " << t.drift << " scale "
               << t.scale << " clock " << t.clock << " epoch " << t.epoch << " renumbered "
               << t.renumbered;
  }
};

/// The root of p((t - shift) / factor) that belongs to the root `a` of p: factor * a + shift.
inline Algebraic_number affine_image(const Algebraic_number& a, const Rational& factor,
                                     const Rational& shift) {
  if (a.is_known_rational()) return Algebraic_number(Rational(a.rational() * factor + shift));
  std::vector<Rational> image;
  const Polynomial polynomial = a.polynomial();
  const auto coefficients = polynomial.coefficients();
  for (std::size_t i = coefficients.size(); i-- > 0;) {
    // image * (t - shift) / factor + coefficients[i]
    std::vector<Rational> next(image.size() + 1, Rational(0));
    for (std::size_t k = 0; k < image.size(); ++k) {
      next[k + 1] += image[k] / factor;
      next[k] -= image[k] * shift / factor;
    }
    next[0] += coefficients[i];
    image = std::move(next);
  }
  const Rational lower = a.lower() * factor + shift;
  const Rational upper = a.upper() * factor + shift;
  return {primitive_polynomial(image), std::min(lower, upper), std::max(lower, upper)};
}

/// Times between the critical times of a run: times[i] < critical[i] < times[i + 1].
struct Run_outline {
  explicit Run_outline(const std::vector<Linear_motion_2>& motions)
      : critical(critical_times(motions, Algebraic_number())) {
    Algebraic_number previous;
    end = critical.empty() ? 1 : std::ceil(critical.back().interval().upper) + 1;
    for (const Algebraic_number& time : critical) {
      times.push_back(simplest_between(previous, time));
      previous = time;
    }
    times.push_back(simplest_between(previous, Algebraic_number(end)));
    for (const Rational& time : times) expected.push_back(edges_at(motions, time));
  }

  std::vector<Algebraic_number> critical;
  std::vector<Rational> times;
  std::vector<std::set<Edge_ids>> expected;  ///< at the times
  double end = 1;                            ///< an integer after all of them
};

/// A run of transformed points.
class Transformed_run {
 public:
  Transformed_run(const std::vector<Linear_motion_2>& motions, const Transformation& by,
                  const Run_outline& outline)
      : by_(by), outline_(outline), count_(static_cast<Point_id>(motions.size())) {
    for (const Linear_motion_2& m : motions) motions_.push_back(image(m));
    if (by.renumbered) std::ranges::reverse(motions_);
  }

  const std::vector<Linear_motion_2>& motions() const { return motions_; }

  /// The first difference from the original in the edges between critical times or the times of
  /// events.
  std::string problem() const {
    Kinetic_delaunay kinetic(motions_);
    Event_recorder recorder(kinetic);
    const std::size_t n = outline_.times.size();
    for (std::size_t step = 0; step < n; ++step) {
      const std::size_t i = by_.reversed ? n - 1 - step : step;
      const std::size_t first = recorder.events.size();
      const Algebraic_number time = time_image(Algebraic_number(outline_.times[i]));
      kinetic.advance_to(time);
      const std::set<Edge_ids> edges = edges_of(kinetic);
      const std::string where = " at " + outline_.times[i].str() + " of the original";
      const bool has_other_axes = by_.mirrored || by_.transposed;
      if (has_other_axes ? edges != edges_at(motions_, time.rational())
                         : originals(edges) != outline_.expected[i]) {
        return "wrong edges" + where;
      }
      if (recorder.events.size() == first) continue;
      if (step == 0) return "an event before the first critical time";
      const Algebraic_number& critical = outline_.critical[by_.reversed ? i : i - 1];
      const Algebraic_number expected_time = time_image(critical);
      for (std::size_t k = first; k < recorder.events.size(); ++k) {
        if (recorder.events[k].time != expected_time) return "an event at another time" + where;
      }
    }
    return {};
  }

 private:
  Linear_motion_2 image(Linear_motion_2 m) const {
    if (by_.reversed) {
      m.position.x += m.velocity.x * outline_.end;
      m.position.y += m.velocity.y * outline_.end;
      m.velocity = {-m.velocity.x, -m.velocity.y};
    }
    if (by_.mirrored) {
      m.position.x = -m.position.x;
      m.velocity.x = -m.velocity.x;
    }
    if (by_.transposed) {
      std::swap(m.position.x, m.position.y);
      std::swap(m.velocity.x, m.velocity.y);
    }
    m.position = {m.position.x + by_.shift, m.position.y - 3.0 * by_.shift};
    m.velocity = {m.velocity.x + by_.drift, m.velocity.y - 3.0 * by_.drift};
    const auto scaled = [](const Vector_2& v, int exponent) {
      return Vector_2{std::ldexp(v.x, exponent), std::ldexp(v.y, exponent)};
    };
    m.position = scaled(m.position, by_.scale);
    m.velocity = scaled(m.velocity, by_.scale - by_.clock);
    m.position.x += m.velocity.x * by_.epoch;
    m.position.y += m.velocity.y * by_.epoch;
    m.epoch = by_.epoch;
    return m;
  }

  Algebraic_number time_image(const Algebraic_number& time) const {
    const Rational unit = scaled_by_power_of_two(Rational(1), by_.clock);
    if (by_.reversed) return affine_image(time, -unit, unit * to_rational(outline_.end));
    return affine_image(time, unit, Rational(0));
  }

  std::set<Edge_ids> originals(const std::set<Edge_ids>& edges) const {
    if (!by_.renumbered) return edges;
    std::set<Edge_ids> result;
    for (const Edge_ids& e : edges) {
      result.insert(edge_ids(count_ - 1 - e[0], count_ - 1 - e[1]));
    }
    return result;
  }

  Transformation by_;
  const Run_outline& outline_;
  Point_id count_;
  std::vector<Linear_motion_2> motions_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_TRANSFORMED_RUN_H
