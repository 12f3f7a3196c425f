// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/kinetic/drawn_box_2.h"

#include <algorithm>
#include <cmath>

namespace kinetri {
namespace {

double spanned_area(const Vector_2& a, const Vector_2& b) {
  return a.x * b.y - a.y * b.x;
}

double greatest(const Vector_2& a) {
  return std::max(std::abs(a.x), std::abs(a.y));
}

Vector_2 divided(const Vector_2& a, double divisor) {
  return {a.x / divisor, a.y / divisor};
}

}  // namespace

Drawn_box_2::Drawn_box_2(const Periodic_box_2& box, double t)
    : first_(rounded_place(box.first(), t)), second_(rounded_place(box.second(), t)) {
  // In units of the first vector, so that squares do not overflow.
  const double unit = greatest(first_);
  const Vector_2 u = divided(first_, unit);
  const Vector_2 v = divided(second_, unit);
  turns_ = std::round((u.x * v.x + u.y * v.y) / (u.x * u.x + u.y * u.y));
  second_.x -= turns_ * first_.x;
  second_.y -= turns_ * first_.y;
}

std::array<Vector_2, 4> Drawn_box_2::corners() const {
  return {Vector_2(), first_, Vector_2{first_.x + second_.x, first_.y + second_.y}, second_};
}

Drawn_box_2::Image Drawn_box_2::image(const Vector_2& place) const {
  const Vector_2 u = divided(first_, greatest(first_));
  const Vector_2 v = divided(second_, greatest(second_));
  const double area = spanned_area(u, v);
  const Vector_2 moves = {-std::floor(spanned_area(place, v) / area / greatest(first_)),
                          -std::floor(spanned_area(u, place) / area / greatest(second_))};
  return {{place.x + moves.x * first_.x + moves.y * second_.x,
           place.y + moves.x * first_.y + moves.y * second_.y},
          moves};
}

Vector_2 Drawn_box_2::shift(const Lattice_offset_2& offset, const Image& from,
                            const Image& to) const {
  const double x = offset.x + turns_ * offset.y + from.moves.x - to.moves.x;
  const double y = offset.y + from.moves.y - to.moves.y;
  return {x * first_.x + y * second_.x, x * first_.y + y * second_.y};
}

Vector_2 Drawn_box_2::move(const Image& image, const Vector_2& first,
                           const Vector_2& second) const {
  const double x = image.moves.x - turns_ * image.moves.y;
  const double y = image.moves.y;
  return {x * first.x + y * second.x, x * first.y + y * second.y};
}

}  // namespace kinetri
