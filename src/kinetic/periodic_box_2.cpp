// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/periodic_box_2.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/kinetic/moving_point_2.h"

namespace kinetri {
namespace {

void require_finite(const Linear_motion_2& vector, const std::string& which) {
  if (is_finite(vector)) return;
  throw Periodic_box_error("the " + which +
                           " lattice vector of a periodic box has a number that is not finite; "
                           "expected a finite vector, rate and epoch");
}

// "the periodic box <problem> at time <time>; <remedy>".
[[noreturn]] void throw_problem(const std::string& problem, const Algebraic_number& time,
                                const std::string& remedy) {
  std::ostringstream message;
  message.precision(std::numeric_limits<double>::max_digits10);
  message << "the periodic box " << problem << " at time " << time.to_double() << "; " << remedy;
  throw Periodic_box_error(message.str());
}

}  // namespace

Periodic_box_2::Periodic_box_2(const Linear_motion_2& first, const Linear_motion_2& second)
    : first_(first), second_(second) {
  require_finite(first, "first");
  require_finite(second, "second");
  if (area_polynomial().degree() <= 0) require_area(0.0, 0.0);
}

Polynomial Periodic_box_2::area_polynomial() const {
  const Moving_point_2 first(first_);
  const Moving_point_2 second(second_);
  const auto [a, b] = common_trajectories<2, Linear_motion_2>({&first, &second});
  return a.x * b.y - a.y * b.x;
}

Rational Periodic_box_2::area(const Rational& t) const {
  const Exact_position_2 a = Moving_point_2(first_).position(t);
  const Exact_position_2 b = Moving_point_2(second_).position(t);
  return a.x * b.y - a.y * b.x;
}

Vector_2 Periodic_box_2::flow_at(Vector_2 place, double t) const {
  Vector_2 a = rounded_place(first_, t);
  Vector_2 b = rounded_place(second_, t);
  // Scaled by a power of two, so that products neither overflow nor underflow.
  const int power =
      -std::ilogb(std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)}));
  const auto scale = [power](Vector_2 v) {
    return Vector_2{std::ldexp(v.x, power), std::ldexp(v.y, power)};
  };
  a = scale(a);
  b = scale(b);
  place = scale(place);
  const double area = a.x * b.y - a.y * b.x;
  const double k = (place.x * b.y - place.y * b.x) / area;
  const double l = (a.x * place.y - a.y * place.x) / area;
  return {k * first_.velocity.x + l * second_.velocity.x,
          k * first_.velocity.y + l * second_.velocity.y};
}

std::optional<Algebraic_number> Periodic_box_2::collapse_after(const Algebraic_number& t) const {
  const Polynomial area = area_polynomial();
  KINETRI_PRECONDITION(sign_at(area, t) == CGAL::POSITIVE,
                       "the area of a periodic box is not positive");
  std::optional<Real_root> root = first_root_after(area, t);
  if (!root) return std::nullopt;
  return std::move(root->value);
}

void Periodic_box_2::require_area(const Algebraic_number& from,
                                  const Algebraic_number& until) const {
  switch (sign_at(area_polynomial(), from)) {
    case CGAL::ZERO:
      throw_problem("has no area", from, "expected lattice vectors that are not parallel");
    case CGAL::NEGATIVE:
      throw_problem("has a negative area", from,
                    "the second lattice vector is to the right of the first: swap the two");
    default:
      break;
  }
  const std::optional<Algebraic_number> collapse = collapse_after(from);
  if (collapse && *collapse <= until) {
    throw_problem("has no area", *collapse,
                  "stop before that time, or change the rates of the lattice vectors");
  }
}

}  // namespace kinetri
