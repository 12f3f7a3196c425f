// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/wrapping.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kinetri/base/error.h"
#include "kinetri/impl/triangulation/torus_triangulation.h"

namespace kinetri::detail {
namespace {

constexpr double two_to_the_31 = 2147483648;

double scalar_product(const Vector_2& a, const Vector_2& b) {
  return a.x * b.x + a.y * b.y;
}

// That of the greater coordinate in base 2; of the zero vector 0.
int exponent_of(const Vector_2& vector) {
  const double greater = std::max(std::abs(vector.x), std::abs(vector.y));
  return greater > 0 ? std::ilogb(greater) : 0;
}

}  // namespace

Wrapping::Wrapping(const Periodic_box_2& box, double time)
    : first_(rounded_place(box.first(), time)), second_(rounded_place(box.second(), time)) {
  const int exponent = (exponent_of(first_) + exponent_of(second_)) / 2;
  scale_ = std::ldexp(1.0, -std::clamp(exponent, -1000, 1000));
  for (double* number : {&first_.x, &first_.y, &second_.x, &second_.y}) *number *= scale_;
  reduce();
  area_ = cross(first_, second_);
}

Vector_2 Wrapping::heights() const {
  return {area_ / std::sqrt(scalar_product(second_, second_)) / scale_,
          area_ / std::sqrt(scalar_product(first_, first_)) / scale_};
}

std::optional<Lattice_offset_2> Wrapping::moved(const Lattice_offset_2& offset,
                                                const std::array<std::int8_t, 2>& by) const {
  const std::int64_t x = std::int64_t{offset.x} + std::int64_t{by[0]} * basis_[0].x +
                         std::int64_t{by[1]} * basis_[1].x;
  const std::int64_t y = std::int64_t{offset.y} + std::int64_t{by[0]} * basis_[0].y +
                         std::int64_t{by[1]} * basis_[1].y;
  return to_offset(x, y);
}

Wrapping::Image Wrapping::image(const Vector_2& position, Point_id id) const {
  const Vector_2 there = multiples(position);
  const Vector_2 whole = {std::floor(there.x), std::floor(there.y)};
  return {{there.x - whole.x, there.y - whole.y}, offset(whole, id)};
}

Lattice_offset_2 Wrapping::nearest(const Vector_2& position, const Vector_2& other,
                                   Point_id id) const {
  const Vector_2 away = multiples({position.x - other.x, position.y - other.y});
  return offset({std::nearbyint(away.x), std::nearbyint(away.y)}, id);
}

// That many vectors back.
Lattice_offset_2 Wrapping::offset(const Vector_2& whole, Point_id id) const {
  const double x = -whole.x * basis_[0].x - whole.y * basis_[1].x;
  const double y = -whole.x * basis_[0].y - whole.y * basis_[1].y;
  if (std::abs(x) < two_to_the_31 && std::abs(y) < two_to_the_31) {
    return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
  }
  throw Periodic_box_error("point " + std::to_string(id) +
                           " is 2^31 or more lattice vectors away from the periodic box, or from "
                           "other points; give the position of an image that is closer");
}

// The reduction of Lagrange, in which each step makes the sum of the lengths less. It stops when
// rounding, or the range of offsets, allows no further step.
void Wrapping::reduce() {
  for (;;) {
    if (scalar_product(second_, second_) < scalar_product(first_, first_)) {
      first_ = std::exchange(second_, {-first_.x, -first_.y});
      basis_[0] = std::exchange(basis_[1], {-basis_[0].x, -basis_[0].y});
    }
    const double k =
        std::nearbyint(scalar_product(first_, second_) / scalar_product(first_, first_));
    if (k == 0 || !(std::abs(k) < two_to_the_31)) return;
    const auto number = static_cast<std::int64_t>(k);
    const std::int64_t x = basis_[1].x - number * basis_[0].x;
    const std::int64_t y = basis_[1].y - number * basis_[0].y;
    const Vector_2 shorter = {second_.x - k * first_.x, second_.y - k * first_.y};
    const auto offset = to_offset(x, y);
    if (!offset || !(scalar_product(shorter, shorter) < scalar_product(second_, second_))) return;
    second_ = shorter;
    basis_[1] = *offset;
  }
}

}  // namespace kinetri::detail
