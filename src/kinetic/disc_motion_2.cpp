// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/disc_motion_2.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "kinetri/algebra/number_types.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/moving_point_2.h"

namespace kinetri {
namespace {

template <class Disc>
bool has_finite_numbers(const Disc& disc) {
  return is_finite(center(disc)) && std::isfinite(disc.radius) && std::isfinite(disc.growth) &&
         std::isfinite(disc.weight);
}

template <class Disc>
bool have_same_weight(const Disc& a, const Disc& b) {
  if (a.radius == b.radius && a.weight == b.weight && a.growth == b.growth &&
      (a.growth == 0 || a.epoch == b.epoch)) {
    return true;
  }
  using Point = Basic_moving_point_2<Disc>;
  return weight_difference(Point(a), Point(b)).is_zero();
}

template <class Disc>
bool have_same_trajectory(const Disc& a, const Disc& b) {
  return same_trajectory(center(a), center(b)) && have_same_weight(a, b);
}

double sum_of(const Vector_2& v) {
  return std::abs(v.x) + std::abs(v.y);
}

// A bound for the path length within `duration` after, or before, the time t.
double path_length(const Linear_motion_2& motion, double /*t*/, double duration) {
  return sum_of(motion.velocity) * duration;
}
double path_length(const Polynomial_motion_2& motion, double t, double duration) {
  const double s = std::abs(t - motion.epoch) + duration;
  return (sum_of(motion.velocity) +
          s * (sum_of(motion.acceleration) + s * sum_of(motion.jerk) / 2)) *
         duration;
}

// Let the discs touch, or be apart, at a time s with |s - t| <= h, half the distance from |t| to
// the next binary64 number. At s the center of the new motion is at most
//
// m = (rounding error of its position at t) + (path lengths of the old and the new motion within h)
//
// from that of the old motion, and the radius that it would have without any rounding differs from
// the old one by at most |growth| h if the growth changes too (at_rest_at). So if the radius at t
// is less than that of the old motion at t by m + |growth| h, the new disc at s is inside the old
// one, and two such discs do not overlap at s. A coordinate is rounded by at most the unit roundoff
// times its magnitude, and what an underflow takes. Twice all of this covers the roundings of this
// computation, of which each is relative to a sum of numbers of one sign. The radius at t is
// computed with three roundings, each of two unit roundoffs of its terms at most.
template <class Disc>
double radius_after_change(const Disc& old, const Disc& result, double t) {
  const double size = std::abs(t);
  const double h = 0.5 * (std::nextafter(size, std::numeric_limits<double>::infinity()) - size);
  const double rounded = 0x1p-53 * sum_of(result.position) + std::numeric_limits<double>::min();
  const double shift = rounded + path_length(center(old), t, h) +
                       path_length(center(result), t, h) + std::abs(old.growth) * h;
  const double elapsed = t - old.epoch;
  const double grown = old.growth * elapsed;
  const double margin = 2 * shift + 0x1p-49 * (std::abs(old.radius) + std::abs(grown)) +
                        std::numeric_limits<double>::min();
  return std::max(0.0, old.radius + grown - margin);
}

template <class Disc>
Disc continued(const Disc& disc, const Vector_2& velocity, double t) {
  Disc result = {with_velocity_at(center(disc), velocity, t), disc.radius, disc.growth,
                 disc.weight};
  if (disc.growth != 0) result.radius = radius_after_change(disc, result, t);
  return result;
}

// The distance of the disc's boundary from the wall, as a polynomial on [0, 1], to which `times` is
// mapped.
template <class Disc>
std::array<Rational, 4> inside_by_share(const Disc& disc, const Wall_2& wall,
                                        const Double_interval& times) {
  const Trajectory_2 path = Basic_moving_point_2<Disc>(disc).trajectory();
  const Polynomial& place = wall.is_vertical() ? path.x : path.y;
  std::array<Rational, 4> c;
  for (int k = 0; k <= place.degree(); ++k) {
    c[static_cast<std::size_t>(k)] = Rational(wall.is_upper() ? -place[k] : place[k], path.w[0]);
  }
  const Rational position = to_rational(wall.position);
  const Rational growth = to_rational(disc.growth);
  c[0] -= (wall.is_upper() ? Rational(-position) : position) + to_rational(wall.clearance) +
          to_rational(disc.radius) - growth * to_rational(disc.epoch);
  c[1] -= growth;
  // Powers of t - times.lower.
  for (std::size_t i = 0; i + 1 < c.size(); ++i) {
    for (std::size_t k = c.size() - 1; k-- > i;) c[k] += to_rational(times.lower) * c[k + 1];
  }
  Rational power = 1;
  for (Rational& coefficient : c) {
    coefficient *= power;
    power *= to_rational(times.upper) - to_rational(times.lower);
  }
  return c;
}

template <class Disc>
Disc clamped_with_rim(const Disc& disc, const Wall_2& wall, const Double_interval& times) {
  const auto c = inside_by_share(disc, wall, times);
  // The least Bernstein coefficient is a lower bound for the values.
  const Rational least =
      std::min({c[0], Rational(c[0] + c[1] / 3), Rational(c[0] + (2 * c[1] + c[2]) / 3),
                Rational(c[0] + c[1] + c[2] + c[3])});
  if (least >= 0) return disc;
  const auto axis = wall.is_vertical() ? &Vector_2::x : &Vector_2::y;
  const Rational wanted =
      to_rational(disc.position.*axis) + (wall.is_upper() ? least : Rational(-least));
  Disc result = disc;
  result.position.*axis = wall.is_upper() ? to_interval(wanted).lower : to_interval(wanted).upper;
  return result;
}

template <class Disc>
Disc clamped(const Disc& disc, const Wall_2& wall, const Double_interval& times) {
  if (wall.rim_touches) return clamped_with_rim(disc, wall, times);
  return {clamped_inside(center(disc), wall, times), disc.radius, disc.growth, disc.weight};
}

}  // namespace

Polynomial_disc_motion_2 polynomial_motion(const Disc_motion_2& disc) {
  return {polynomial_motion(center(disc)), disc.radius, disc.growth, disc.weight};
}

bool is_finite(const Disc_motion_2& disc) {
  return has_finite_numbers(disc);
}
bool is_finite(const Polynomial_disc_motion_2& disc) {
  return has_finite_numbers(disc);
}

bool same_trajectory(const Disc_motion_2& a, const Disc_motion_2& b) {
  return have_same_trajectory(a, b);
}
bool same_trajectory(const Polynomial_disc_motion_2& a, const Polynomial_disc_motion_2& b) {
  return have_same_trajectory(a, b);
}

bool have_equal_weights(const Disc_motion_2& a, const Disc_motion_2& b) {
  return have_same_weight(a, b);
}
bool have_equal_weights(const Polynomial_disc_motion_2& a, const Polynomial_disc_motion_2& b) {
  return have_same_weight(a, b);
}

Disc_motion_2 with_velocity_at(const Disc_motion_2& disc, const Vector_2& velocity, double t) {
  return continued(disc, velocity, t);
}
Polynomial_disc_motion_2 with_velocity_at(const Polynomial_disc_motion_2& disc,
                                          const Vector_2& velocity, double t) {
  return continued(disc, velocity, t);
}

Disc_motion_2 clamped_inside(const Disc_motion_2& disc, const Wall_2& wall,
                             const Double_interval& times) {
  return clamped(disc, wall, times);
}
Polynomial_disc_motion_2 clamped_inside(const Polynomial_disc_motion_2& disc, const Wall_2& wall,
                                        const Double_interval& times) {
  return clamped(disc, wall, times);
}

}  // namespace kinetri
