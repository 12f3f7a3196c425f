// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/gap_of_pair.h"

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "algebra/root_difference.h"
#include "kinetic/filter/least_distance.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri::detail {
namespace {

// ---- bounds, by interval arithmetic ----

using Interval = CGAL::Interval_nt<false>;
using Upward_rounding = CGAL::Protect_FPU_rounding<true>;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Double_interval everything = {-infinite, infinite};

template <class Disc>
constexpr bool is_linear = std::same_as<Center_motion_of<Disc>, Linear_motion_2>;
// Whether the velocity is constant.
template <class Disc>
constexpr bool is_straight =
    is_linear<Disc> || std::same_as<Center_motion_of<Disc>, Image_motion_2>;

// The vector from the center of q to that of p, and the sum of the radii.
struct Relative_place {
  Interval x;
  Interval y;
  Interval reach;

  // At the time t. Precondition: an Upward_rounding is in force.
  template <class Disc>
  Relative_place(const Disc& p, const Disc& q, const Interval& t)
      : x(coordinate(center(p), t, &Vector_2::x) - coordinate(center(q), t, &Vector_2::x)),
        y(coordinate(center(p), t, &Vector_2::y) - coordinate(center(q), t, &Vector_2::y)),
        reach(radius(p, t) + radius(q, t)) {}

  Interval squared_distance() const { return CGAL::square(x) + CGAL::square(y); }
  Interval gap() const { return CGAL::sqrt(squared_distance()) - reach; }

 private:
  template <class Motion>
  static Interval coordinate(const Motion& disc, const Interval& t, double Vector_2::*axis) {
    const Interval elapsed = t - Interval(disc.epoch);
    if constexpr (is_linear<Motion>) {
      return Interval(disc.position.*axis) + Interval(disc.velocity.*axis) * elapsed;
    } else {
      const Interval jerk = Interval(disc.jerk.*axis) / Interval(6);
      const Interval acceleration = Interval(disc.acceleration.*axis) / Interval(2);
      const Interval velocity =
          Interval(disc.velocity.*axis) + elapsed * (acceleration + elapsed * jerk);
      return Interval(disc.position.*axis) + elapsed * velocity;
    }
  }
  static Interval coordinate(const Image_motion_2& image, const Interval& t,
                             double Vector_2::*axis) {
    Interval result = coordinate(image.motion, t, axis);
    const auto add = [&](double times, const Linear_motion_2& vector) {
      result += Interval(times) * coordinate(vector, t, axis);
    };
    if (image.offset.x != 0) add(image.offset.x, image.box->first());
    if (image.offset.y != 0) add(image.offset.y, image.box->second());
    return result;
  }
  template <class Disc>
  static Interval radius(const Disc& disc, const Interval& t) {
    return Interval(disc.radius) + Interval(disc.growth) * (t - Interval(epoch_of(disc)));
  }
};

bool is_finite(const Double_interval& interval) {
  return std::isfinite(interval.lower) && std::isfinite(interval.upper);
}

// Bounds of the gap at all of the times.
template <class Disc>
Double_interval gap_bounds(const Disc& p, const Disc& q, const Double_interval& times) {
  if (!is_finite(times)) return everything;
  const Upward_rounding protection;
  const Interval result = Relative_place(p, q, Interval(times.lower, times.upper)).gap();
  if (!(result.inf() <= result.sup())) return everything;  // an overflow
  return {result.inf(), result.sup()};
}

// A lower bound of the gap, and a time at which the gap is about least.
struct Lower_bound {
  double time;
  double gap;
};

Interval velocity(const Linear_motion_2& motion, double Vector_2::*axis) {
  return motion.velocity.*axis;
}

Interval velocity(const Image_motion_2& image, double Vector_2::*axis) {
  Interval result = velocity(image.motion, axis);
  const auto add = [&](double times, const Linear_motion_2& vector) {
    result += Interval(times) * velocity(vector, axis);
  };
  if (image.offset.x != 0) add(image.offset.x, image.box->first());
  if (image.offset.y != 0) add(image.offset.y, image.box->second());
  return result;
}

// If velocities are constant the squared distance is convex, so it is nowhere below its tangent at
// any time s. Here s is about the time of its minimum.
template <class Disc>
Lower_bound lower_bound_by_tangent(const Disc& p, const Disc& q, const Double_interval& times) {
  const Upward_rounding protection;
  const Interval vx = velocity(center(p), &Vector_2::x) - velocity(center(q), &Vector_2::x);
  const Interval vy = velocity(center(p), &Vector_2::y) - velocity(center(q), &Vector_2::y);
  const auto half_slope = [&](const Relative_place& at) { return at.x * vx + at.y * vy; };
  const double squared_speed = (CGAL::square(vx) + CGAL::square(vy)).sup();
  double s = times.lower;
  if (squared_speed > 0) {
    const Relative_place at_begin(p, q, Interval(times.lower));
    s = std::clamp(s - half_slope(at_begin).sup() / squared_speed, s, times.upper);
    if (!std::isfinite(s)) return {times.lower, -infinite};
  }
  const Interval all_times(times.lower, times.upper);
  const Relative_place at_s(p, q, Interval(s));
  const Interval tangent =
      at_s.squared_distance() + Interval(2) * half_slope(at_s) * (all_times - Interval(s));
  const double least_square = std::max(tangent.inf(), 0.0);
  const Interval reach = Relative_place(p, q, all_times).reach;
  const double gap = (CGAL::sqrt(Interval(least_square)) - Interval(reach.sup())).inf();
  return {s, std::isnan(tangent.inf()) || std::isnan(gap) ? -infinite : gap};
}

template <class Disc>
Lower_bound lower_bound_of_gap(const Disc& p, const Disc& q, const Double_interval& times) {
  if constexpr (is_straight<Disc>) {
    return lower_bound_by_tangent(p, q, times);
  } else {
    return {times.lower, gap_bounds(p, q, times).lower};
  }
}

// ---- the same, exactly ----

// Polynomials in time, by ascending power.
using Coefficients = std::vector<Rational>;

Coefficients coordinate(const Linear_motion_2& motion, double Vector_2::*axis) {
  const Rational velocity = to_rational(motion.velocity.*axis);
  return {to_rational(motion.position.*axis) - velocity * to_rational(motion.epoch), velocity};
}

Coefficients coordinate(const Polynomial_motion_2& motion, double Vector_2::*axis) {
  const Rational e = to_rational(motion.epoch);
  const Rational c0 = to_rational(motion.position.*axis);
  const Rational c1 = to_rational(motion.velocity.*axis);
  const Rational c2 = to_rational(motion.acceleration.*axis) / 2;
  const Rational c3 = to_rational(motion.jerk.*axis) / 6;
  return {c0 - e * (c1 - e * (c2 - e * c3)), c1 - e * (2 * c2 - 3 * e * c3), c2 - 3 * e * c3, c3};
}

Coefficients coordinate(const Image_motion_2& image, double Vector_2::*axis) {
  Coefficients result = coordinate(image.motion, axis);
  const auto add = [&](std::int32_t times, const Linear_motion_2& vector) {
    const Coefficients of_vector = coordinate(vector, axis);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += times * of_vector[i];
  };
  if (image.offset.x != 0) add(image.offset.x, image.box->first());
  if (image.offset.y != 0) add(image.offset.y, image.box->second());
  return result;
}

Coefficients difference(Coefficients a, const Coefficients& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

void add_product(Coefficients& sum, const Coefficients& a, const Coefficients& b,
                 const Rational& factor = 1) {
  if (sum.size() + 1 < a.size() + b.size()) sum.resize(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) sum[i + j] += factor * a[i] * b[j];
  }
}

template <class Disc>
Coefficients squared_distance(const Disc& p, const Disc& q) {
  Coefficients result;
  for (double Vector_2::*const axis : {&Vector_2::x, &Vector_2::y}) {
    const Coefficients d = difference(coordinate(center(p), axis), coordinate(center(q), axis));
    add_product(result, d, d);
  }
  return result;
}

template <class Disc>
bool has_radius(const Disc& disc) {
  return disc.radius != 0 || disc.growth != 0;
}

template <class Disc>
bool are_points(const Disc& p, const Disc& q) {
  return !has_radius(p) && !has_radius(q);
}

// The sum of the radii.
template <class Disc>
Coefficients reach(const Disc& p, const Disc& q) {
  const auto constant_term = [](const Disc& disc) -> Rational {
    return to_rational(disc.radius) - to_rational(disc.growth) * to_rational(epoch_of(disc));
  };
  return {constant_term(p) + constant_term(q), to_rational(p.growth) + to_rational(q.growth)};
}

// The binary64 number nearest to the square root, ties to even; none if the square is too small or
// too large for the estimate. Exact: the root is compared with the midpoints of binary64 numbers.
std::optional<double> rounded_root(const Rational& square) {
  if (square == 0) return 0.0;
  const double estimate = std::sqrt(square.convert_to<double>());
  if (!(estimate > 1e-140 && estimate < 1e140)) return std::nullopt;
  // Positive if the root is beyond the midpoint of x and the next number toward `limit`.
  const auto beyond_middle = [&](double x, double limit) {
    const Rational middle = (to_rational(x) + to_rational(std::nextafter(x, limit))) / 2;
    const int order = square.compare(Rational(middle * middle));
    return limit > x ? order : -order;
  };
  const auto is_odd = [](double x) { return std::bit_cast<std::uint64_t>(x) % 2 == 1; };
  double result = estimate;
  for (const double limit : {infinite, 0.0}) {
    for (int beyond = beyond_middle(result, limit); beyond > 0 || (beyond == 0 && is_odd(result));
         beyond = beyond_middle(result, limit)) {
      result = std::nextafter(result, limit);
    }
  }
  return result;
}

// The time at which the distance of two points is least: the root of its derivative.
struct Least_distance_root : Root_source {
  Least_distance_root(const Linear_motion_2& a, const Linear_motion_2& b, const Rounding& r)
      : p(a), q(b), rounding(r) {}
  Polynomial polynomial() const override {
    return derivative(contact_polynomial(Moving_point_2(p), Moving_point_2(q), 0));
  }
  std::optional<Rounding> rounded(const Double_interval& /*bracket*/) const override {
    return rounding;
  }
  Linear_motion_2 p, q;
  Rounding rounding;
};

// The first time between the two at which the gap is least. The gap sqrt(f) - r - g t, with
// f = a t^2 + b t + c, is a convex function (docs/MATH.md, section 11).
template <class Disc>
Algebraic_number time_of_least_gap(const Disc& p, const Disc& q, const Algebraic_number& since,
                                   const Algebraic_number& until) {
  const Coefficients f = squared_distance(p, q);
  const Rational& c = f[0];
  const Rational& b = f[1];
  const Rational& a = f[2];
  const Rational g = reach(p, q)[1];
  const Rational excess = a - g * g;
  const auto clamped = [&](const Algebraic_number& least) {
    return least < since ? since : least > until ? until : least;
  };
  if (excess > 0) {
    if (g == 0) return clamped(Algebraic_number(Rational(-b / (2 * a))));
    // The root of f'^2 = 4 g^2 f at which f' has the sign of g.
    const Coefficients coefficients = {b * b - 4 * g * g * c, 4 * b * excess, 4 * a * excess};
    const std::vector<Real_root> roots = real_roots(primitive_polynomial(coefficients));
    return clamped(g > 0 ? roots.back().value : roots.front().value);
  }
  // The gap is monotone; it may be constant from the time on at which the centers meet.
  if (g <= 0) return since;
  const bool becomes_constant = excess == 0 && b * b == 4 * a * c;
  return becomes_constant ? clamped(Algebraic_number(Rational(-b / (2 * a)))) : until;
}

}  // namespace

// ---- a gap ----

template <class Disc>
Gap_of_pair<Disc>::Gap_of_pair(const Disc& p, const Disc& q, Algebraic_number time, bool is_minimal)
    : p_(p),
      q_(q),
      time_(std::move(time)),
      is_minimal_(is_minimal),
      bounds_(gap_bounds(p_, q_, time_.interval())) {}

template <class Disc>
double Gap_of_pair<Disc>::rounded_distance() const {
  if (are_points(p_, q_)) return rounded();
  return root_difference_at(squared_distance(p_, q_), {}, time_).to_double();
}

template <class Disc>
double Gap_of_pair<Disc>::rounded() const {
  if (const auto result = certainly_rounded()) return *result;
  if (const auto square = rational_square()) {
    if (const auto result = rounded_root(*square)) return *result;
  }
  return exact().to_double();
}

template <class Disc>
const Algebraic_number& Gap_of_pair<Disc>::exact() const {
  if (!exact_) {
    Coefficients radii;
    if (!are_points(p_, q_)) radii = reach(p_, q_);
    exact_ = root_difference_at(squared_distance(p_, q_), radii, time_);
  }
  return *exact_;
}

// Without exact arithmetic; none if the rounding is uncertain.
template <class Disc>
std::optional<double> Gap_of_pair<Disc>::certainly_rounded() const {
  if constexpr (is_linear<Disc>) {
    if (!are_points(p_, q_)) return std::nullopt;
    if (is_minimal_) return rounded_least_distance(center(p_), center(q_));
    const Double_interval time = time_.interval();
    if (time.lower == time.upper) return rounded_distance_at(center(p_), center(q_), time.lower);
  }
  return std::nullopt;
}

// The square of the gap of points, if the time is known to be rational.
template <class Disc>
std::optional<Rational> Gap_of_pair<Disc>::rational_square() const {
  if (!are_points(p_, q_)) return std::nullopt;
  if (!is_minimal_ && !time_.is_known_rational()) return std::nullopt;
  const Coefficients f = squared_distance(p_, q_);
  const Rational t = is_minimal_ ? Rational(-f[1] / (2 * f[2])) : time_.rational();
  Rational result = 0;
  for (auto c = f.rbegin(); c != f.rend(); ++c) result = result * t + *c;
  return result;
}

template <class Disc>
Comparison_result Gap_of_pair<Disc>::compare(const Gap_of_pair& other) const {
  if (bounds_.upper < other.bounds_.lower) return CGAL::SMALLER;
  if (other.bounds_.upper < bounds_.lower) return CGAL::LARGER;
  if (const auto square = rational_square()) {
    if (const auto other_square = other.rational_square()) {
      if (*square == *other_square) return CGAL::EQUAL;
      return *square < *other_square ? CGAL::SMALLER : CGAL::LARGER;
    }
  }
  return kinetri::compare(exact(), other.exact());
}

// ---- the least one ----

template <>
Gap_of_pair<Image_disc_motion_2> least_gap(const Image_disc_motion_2& p,
                                           const Image_disc_motion_2& q,
                                           const Algebraic_number& since,
                                           const Algebraic_number& until) {
  return {p, q, time_of_least_gap(p, q, since, until)};
}

template <>
Gap_of_pair<Disc_motion_2> least_gap(const Disc_motion_2& p, const Disc_motion_2& q,
                                     const Algebraic_number& since, const Algebraic_number& until) {
  if (are_points(p, q)) {
    if (const auto rounding = rounded_time_of_least_distance(center(p), center(q))) {
      Algebraic_number least(std::make_shared<Least_distance_root>(center(p), center(q), *rounding),
                             rounding->bounds);
      if (least < since) return {p, q, since};
      if (least > until) return {p, q, until};
      return {p, q, std::move(least), true};
    }
  }
  return {p, q, time_of_least_gap(p, q, since, until)};
}

// The gap sqrt(f) - r - g t is least at an end or at a root of f'^2 = 4 g^2 f, where its derivative
// is zero or does not exist.
template <>
Gap_of_pair<Polynomial_disc_motion_2> least_gap(const Polynomial_disc_motion_2& p,
                                                const Polynomial_disc_motion_2& q,
                                                const Algebraic_number& since,
                                                const Algebraic_number& until) {
  const Coefficients f = squared_distance(p, q);
  Coefficients derivative(f.size() - 1);
  for (std::size_t i = 1; i < f.size(); ++i) derivative[i - 1] = Rational(i) * f[i];
  const Rational g = to_rational(p.growth) + to_rational(q.growth);
  Coefficients critical;
  if (g == 0) {
    critical = derivative;
  } else {
    add_product(critical, derivative, derivative);
    add_product(critical, f, {1}, -4 * g * g);
    // Zero at all times if f is the square of g t + c: then the gap has a kink at the root.
    const auto is_zero = [](const Rational& c) { return c == 0; };
    if (std::ranges::all_of(critical, is_zero)) critical = derivative;
  }
  Gap_of_pair<Polynomial_disc_motion_2> result(p, q, since);
  const auto examine = [&](const Algebraic_number& time) {
    Gap_of_pair<Polynomial_disc_motion_2> other(p, q, time);
    if (other.compare(result) == CGAL::SMALLER) result = std::move(other);
  };
  if (const Polynomial polynomial = primitive_polynomial(critical); !polynomial.is_zero()) {
    for (const Real_root& root : real_roots(polynomial)) {
      if (root.value > since && root.value < until) examine(root.value);
    }
  }
  examine(until);
  return result;
}

template <class Disc>
Double_interval least_gap_bounds(const Disc& p, const Disc& q, const Algebraic_number& since,
                                 const Algebraic_number& until) {
  const Double_interval first = since.interval();
  const Double_interval last = until.interval();
  const Double_interval times = {first.lower, last.upper};
  if (!is_finite(times)) return everything;
  const Lower_bound lower = lower_bound_of_gap(p, q, times);
  // A time that is certainly in the interval.
  const Double_interval one = first.upper <= last.lower
                                  ? Double_interval{std::clamp(lower.time, first.upper, last.lower),
                                                    std::clamp(lower.time, first.upper, last.lower)}
                                  : first;
  return {lower.gap, gap_bounds(p, q, one).upper};
}

#define KINETRI_INSTANTIATE(Disc)                                                              \
  template class Gap_of_pair<Disc>;                                                            \
  template Double_interval least_gap_bounds(const Disc&, const Disc&, const Algebraic_number&, \
                                            const Algebraic_number&)
KINETRI_INSTANTIATE(Disc_motion_2);
KINETRI_INSTANTIATE(Polynomial_disc_motion_2);
KINETRI_INSTANTIATE(Image_disc_motion_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri::detail
