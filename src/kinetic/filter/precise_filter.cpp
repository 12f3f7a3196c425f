// SPDX-License-Identifier: GPL-3.0-or-later
#include "precise_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "precise_places.h"
#include "weighted_differences.h"

namespace kinetri {
namespace {

// The radius at a time, times the scale of the motion; adds the magnitudes of all numbers that it
// is computed from to `terms`.
template <class Disc>
Double_double scaled_radius(const Disc& disc, const Double_double& time, double& terms) {
  constexpr double scale = Scaled<typename Disc::Center_motion>::scale;
  const Double_double radius = exact_product(scale, disc.radius);
  const Double_double grown =
      (time - Double_double{epoch_of(disc)}) * exact_product(scale, disc.growth);
  terms += std::abs(radius.high) + std::abs(grown.high);
  return radius + grown;
}

// The weights of discs minus that of the last one at a time, times the square of the motion's
// scale.
template <std::size_t N, class Disc>
class Weights {
 public:
  Weights(const std::array<const Disc*, N>& discs, const Double_double& time) {
    constexpr double scale = Scaled<typename Disc::Center_motion>::scale;
    std::array<Double_double, N> radii;
    double terms = 0;
    for (std::size_t i = 0; i < N; ++i) radii[i] = scaled_radius(*discs[i], time, terms);
    double rest = 0;
    for (std::size_t i = 0; i + 1 < N; ++i) {
      const Double_double difference =
          Double_double{scale * scale} * exact_sum(discs[i]->weight, -discs[N - 1]->weight);
      rest += std::abs(difference.high);
      relative_[i] = (radii[i] - radii[N - 1]) * (radii[i] + radii[N - 1]) + difference;
    }
    size_ = terms * terms + rest;
  }

  const Double_double& relative(std::size_t i) const { return relative_[i]; }
  // Bounds the weights; their errors are relative to this.
  double size() const { return size_; }
  bool is_in_range() const { return size_ < greatest_size * greatest_size; }

 private:
  std::array<Double_double, N - 1> relative_;
  double size_ = 0;
};

}  // namespace

template <class Motion>
double precise_in_circle(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                         double high, double low) {
  using Center = Center_motion_of<Motion>;
  const Places<4, Center> places({&p, &q, &r, &s}, {high, low});
  if (!places.is_in_range() || !is_precise()) return 0;
  std::array<Double_double, 3> lifts = {places.squared_length(0), places.squared_length(1),
                                        places.squared_length(2)};
  const double size = places.size();
  double lift_size = size * size;
  if constexpr (HasWeight<Motion>) {
    if (!have_same_weight_numbers(std::array{&p, &q, &r, &s})) {
      const Weights<4, Motion> weights({&p, &q, &r, &s}, {high, low});
      if (!weights.is_in_range()) return 0;
      for (std::size_t i = 0; i < 3; ++i) lifts[i] = lifts[i] - weights.relative(i);
      lift_size += weights.size();
    }
  }
  const Double_double value =
      lifts[0] * places.cross(1, 2) + lifts[1] * places.cross(2, 0) + lifts[2] * places.cross(0, 1);
  constexpr double units = 4096 * Scaled<Center>::error_factor * unit;
  return certain(value, units * lift_size * (size * places.terms()));
}

template <class Motion>
double precise_orientation(const Motion& p, const Motion& q, const Motion& r, double high,
                           double low) {
  // Relative to the last point: the orientation of r, p, q.
  const Places<3, Motion> places({&p, &q, &r}, {high, low});
  if (!places.is_in_range() || !is_precise()) return 0;
  constexpr double units = 256 * Scaled<Motion>::error_factor * unit;
  return certain(places.cross(0, 1), units * (places.size() * places.terms()));
}

// The reach of two points at a time, times the scale of the motion.
template <class Motion>
Double_double scaled_reach(const Motion& p, const Motion& q, double diameter,
                           const Double_double& time, double& terms) {
  const Double_double scaled = exact_product(diameter, Scaled<Center_motion_of<Motion>>::scale);
  terms += std::abs(scaled.high);
  if constexpr (HasWeight<Motion>) {
    return scaled + (scaled_radius(p, time, terms) + scaled_radius(q, time, terms));
  } else {
    return scaled;
  }
}

template <class Motion>
double precise_contact(const Motion& p, const Motion& q, double diameter, double high, double low) {
  using Center = Center_motion_of<Motion>;
  const Places<2, Center> places({&p, &q}, {high, low});
  double terms = 0;
  const Double_double reach = scaled_reach(p, q, diameter, {high, low}, terms);
  if (!places.is_in_range() || !is_precise() || !is_in_range(terms)) return 0;
  constexpr double units = 256 * Scaled<Center>::error_factor * unit;
  return certain(places.squared_length(0) - reach * reach,
                 units * (places.size() * places.terms() + terms * terms));
}

template <class Motion>
double precise_distance_comparison(const Motion& p, const Motion& q, const Motion& r,
                                   const Motion& s, double high, double low) {
  const Places<2, Motion> first({&r, &s}, {high, low});
  const Places<2, Motion> second({&p, &q}, {high, low});
  if (!first.is_in_range() || !second.is_in_range() || !is_precise()) return 0;
  constexpr double units = 256 * Scaled<Motion>::error_factor * unit;
  return certain(first.squared_length(0) - second.squared_length(0),
                 units * (first.size() * first.terms() + second.size() * second.terms()));
}

namespace {

// The velocity of p relative to q, rounded. Of images, adds the magnitudes of all numbers that it
// is computed from to `terms`; its error is at most one unit roundoff of itself and 2^-100 of
// these.
Vector_2 relative_velocity(const Linear_motion_2& p, const Linear_motion_2& q, double& /*terms*/) {
  return {p.velocity.x - q.velocity.x, p.velocity.y - q.velocity.y};
}
Vector_2 relative_velocity(const Image_motion_2& p, const Image_motion_2& q, double& terms) {
  const Offset_difference offset(p, q);
  if (offset.is_zero()) return relative_velocity(p.motion, q.motion, terms);
  const Periodic_box_2& box = p.box != nullptr ? *p.box : *q.box;
  const auto coordinate = [&](double Vector_2::*axis) {
    const Double_double of_points = exact_sum(p.motion.velocity.*axis, -(q.motion.velocity.*axis));
    const Double_double a = exact_product(offset.first, box.first().velocity.*axis);
    const Double_double b = exact_product(offset.second, box.second().velocity.*axis);
    terms += std::abs(of_points.high) + std::abs(a.high) + std::abs(b.high);
    return (of_points + (a + b)).high;
  };
  return {coordinate(&Vector_2::x), coordinate(&Vector_2::y)};
}

}  // namespace

template <class Motion>
std::optional<Rounding> rounded_contact(const Motion& p, const Motion& q, double diameter,
                                        const Double_interval& bracket) {
  const double width = bracket.upper - bracket.lower;
  const double origin = bracket.lower + 0.5 * width;
  using Center = Center_motion_of<Motion>;
  const Places<2, Center> places({&p, &q}, {origin});
  double velocity_terms = 0;
  const auto [slope_x, slope_y] = relative_velocity(center(p), center(q), velocity_terms);
  double terms = 0;
  const Double_double reach = scaled_reach(p, q, diameter, {origin}, terms);
  double growth = 0;
  if constexpr (HasWeight<Motion>) growth = p.growth + q.growth;
  double speed = std::abs(slope_x) + std::abs(slope_y) + std::abs(growth);
  // As in rounded_in_circle.
  if constexpr (!std::same_as<Center, Linear_motion_2>) speed += 0x1p-45 * velocity_terms;
  if (!places.is_in_range() || !is_precise() || !is_in_range(terms) || !is_in_range(speed)) {
    return std::nullopt;
  }
  const Double_double value = places.squared_length(0) - reach * reach;
  const auto& [x, y] = places.relative(0);
  const double slope = 2 * (x.high * slope_x + y.high * slope_y - reach.high * growth);
  const double error = 256 * unit * (places.size() * places.terms() + terms * terms);
  const double slope_error =
      32 * unit_roundoff *
          ((places.size() + unit_roundoff * places.terms()) * speed + terms * std::abs(growth)) +
      width * speed * speed;
  return newton_rounding(origin, value.high, error, slope, slope_error);
}

std::optional<Rounding> rounded_distance_comparison(const Linear_motion_2& p,
                                                    const Linear_motion_2& q,
                                                    const Linear_motion_2& r,
                                                    const Linear_motion_2& s,
                                                    const Double_interval& bracket) {
  const double width = bracket.upper - bracket.lower;
  const double origin = bracket.lower + 0.5 * width;
  if (!is_precise()) return std::nullopt;
  // The squared length of a difference: its value, half its slope, and their errors.
  struct Square {
    Double_double value;
    double half_slope = 0;
    double error = 0;
    double slope_error = 0;
    bool is_in_range = false;
  };
  const auto square = [&](const Linear_motion_2& from, const Linear_motion_2& to) {
    const Places<2, Linear_motion_2> places({&from, &to}, {origin});
    const double slope_x = from.velocity.x - to.velocity.x;
    const double slope_y = from.velocity.y - to.velocity.y;
    const double speed = std::abs(slope_x) + std::abs(slope_y);
    const auto& [x, y] = places.relative(0);
    return Square{places.squared_length(0), x.high * slope_x + y.high * slope_y,
                  256 * unit * (places.size() * places.terms()),
                  32 * unit_roundoff * ((places.size() + unit_roundoff * places.terms()) * speed) +
                      width * speed * speed,
                  places.is_in_range() && (speed == 0 || is_in_range(speed))};
  };
  const Square first = square(r, s);
  const Square second = square(p, q);
  if (!first.is_in_range || !second.is_in_range) return std::nullopt;
  return newton_rounding(origin, (first.value - second.value).high, first.error + second.error,
                         2 * (first.half_slope - second.half_slope),
                         first.slope_error + second.slope_error);
}

template <class Motion>
std::optional<Rounding> rounded_in_circle(const Motion& p, const Motion& q, const Motion& r,
                                          const Motion& s, const Double_interval& bracket) {
  const double width = bracket.upper - bracket.lower;
  const double origin = bracket.lower + 0.5 * width;
  const Places<4, Motion> places({&p, &q, &r, &s}, {origin});
  // The differences to s and their derivatives, in binary64.
  std::array<double, 3> x;
  std::array<double, 3> y;
  std::array<double, 3> vx;
  std::array<double, 3> vy;
  double speed = 0;
  double velocity_terms = 0;
  const std::array<const Motion*, 3> others = {&p, &q, &r};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = places.relative(i).x.high;
    y[i] = places.relative(i).y.high;
    const Vector_2 velocity = relative_velocity(*others[i], s, velocity_terms);
    vx[i] = velocity.x;
    vy[i] = velocity.y;
    speed = std::max({speed, std::abs(vx[i]), std::abs(vy[i])});
  }
  // So that one unit roundoff of it is more than the error of a velocity; of points it has none.
  if constexpr (!std::same_as<Motion, Linear_motion_2>) speed += 0x1p-45 * velocity_terms;
  if (!places.is_in_range() || !is_precise() || !is_in_range(speed)) return std::nullopt;
  const Double_double value = places.squared_length(0) * places.cross(1, 2) +
                              places.squared_length(1) * places.cross(2, 0) +
                              places.squared_length(2) * places.cross(0, 1);
  double slope = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    slope += 2 * (x[i] * vx[i] + y[i] * vy[i]) * (x[j] * y[k] - y[j] * x[k]);
    slope += (x[i] * x[i] + y[i] * y[i]) *
             ((vx[j] * y[k] - vy[j] * x[k]) + (x[j] * vy[k] - y[j] * vx[k]));
  }
  const double size = places.size();
  const double terms = places.terms();
  const double error = 4096 * unit * (size * size) * (size * terms);
  const double greatest = size + 2 * speed * width;
  const double slope_error =
      (1024 * unit_roundoff * size + 0x1p-80 * terms) * (size * size) * speed +
      128 * (greatest * greatest) * (speed * speed) * width;
  return newton_rounding(origin, value.high, error, slope, slope_error);
}

template double precise_orientation(const Linear_motion_2&, const Linear_motion_2&,
                                    const Linear_motion_2&, double, double);
template double precise_orientation(const Image_motion_2&, const Image_motion_2&,
                                    const Image_motion_2&, double, double);
template double precise_in_circle(const Image_motion_2&, const Image_motion_2&,
                                  const Image_motion_2&, const Image_motion_2&, double, double);
template double precise_in_circle(const Image_disc_motion_2&, const Image_disc_motion_2&,
                                  const Image_disc_motion_2&, const Image_disc_motion_2&, double,
                                  double);
template std::optional<Rounding> rounded_in_circle(const Linear_motion_2&, const Linear_motion_2&,
                                                   const Linear_motion_2&, const Linear_motion_2&,
                                                   const Double_interval&);
template double precise_contact(const Image_motion_2&, const Image_motion_2&, double, double,
                                double);
template double precise_contact(const Image_disc_motion_2&, const Image_disc_motion_2&, double,
                                double, double);
template double precise_distance_comparison(const Image_motion_2&, const Image_motion_2&,
                                            const Image_motion_2&, const Image_motion_2&, double,
                                            double);
template std::optional<Rounding> rounded_in_circle(const Image_motion_2&, const Image_motion_2&,
                                                   const Image_motion_2&, const Image_motion_2&,
                                                   const Double_interval&);
template double precise_orientation(const Polynomial_motion_2&, const Polynomial_motion_2&,
                                    const Polynomial_motion_2&, double, double);
template double precise_distance_comparison(const Linear_motion_2&, const Linear_motion_2&,
                                            const Linear_motion_2&, const Linear_motion_2&, double,
                                            double);
template double precise_distance_comparison(const Polynomial_motion_2&, const Polynomial_motion_2&,
                                            const Polynomial_motion_2&, const Polynomial_motion_2&,
                                            double, double);
#define KINETRI_INSTANTIATE(Motion)                                                             \
  template double precise_in_circle(const Motion&, const Motion&, const Motion&, const Motion&, \
                                    double, double);                                            \
  template double precise_contact(const Motion&, const Motion&, double, double, double)
KINETRI_INSTANTIATE(Linear_motion_2);
KINETRI_INSTANTIATE(Polynomial_motion_2);
KINETRI_INSTANTIATE(Disc_motion_2);
KINETRI_INSTANTIATE(Polynomial_disc_motion_2);
#undef KINETRI_INSTANTIATE
template std::optional<Rounding> rounded_contact(const Linear_motion_2&, const Linear_motion_2&,
                                                 double, const Double_interval&);
template std::optional<Rounding> rounded_contact(const Image_motion_2&, const Image_motion_2&,
                                                 double, const Double_interval&);
template std::optional<Rounding> rounded_contact(const Image_disc_motion_2&,
                                                 const Image_disc_motion_2&, double,
                                                 const Double_interval&);
template std::optional<Rounding> rounded_contact(const Disc_motion_2&, const Disc_motion_2&, double,
                                                 const Double_interval&);

}  // namespace kinetri
