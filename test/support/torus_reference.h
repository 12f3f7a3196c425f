// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Delaunay triangulation, or regular triangulation, of a few points on a flat torus by brute
// force, in integers of any type: all copies of the points about a reduced basis of the lattice.
#ifndef KINETRI_TEST_SUPPORT_TORUS_REFERENCE_H
#define KINETRI_TEST_SUPPORT_TORUS_REFERENCE_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"

namespace kinetri::test {

template <class Number>
struct Vector {
  Number x;
  Number y;
  friend bool operator==(const Vector&, const Vector&) = default;
};
template <class Number>
Vector<Number> operator-(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class Number>
Number cross(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class Number>
int sign_of(const Number& x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}
template <class Number>
int turn(const Vector<Number>& p, const Vector<Number>& q, const Vector<Number>& r) {
  return sign_of<Number>(cross(q - p, r - p));
}
/// Positive if s is in the circle of p, q, r, which turn left; the first that is not zero of the
/// signs with the lifts x^2 + y^2, xy, x^2. With weights, x^2 + y^2 less these.
template <class Number>
int in_circle(const Vector<Number>& p, const Vector<Number>& q, const Vector<Number>& r,
              const Vector<Number>& s, const std::array<Number, 4>& weights = {}) {
  const Vector<Number> a = p - s;
  const Vector<Number> b = q - s;
  const Vector<Number> c = r - s;
  const Number bc = cross(b, c);
  const Number ca = cross(c, a);
  const Number ab = cross(a, b);
  const auto& [wp, wq, wr, ws] = weights;
  const Number lifted =
      (dot(a, a) - wp + ws) * bc + (dot(b, b) - wq + ws) * ca + (dot(c, c) - wr + ws) * ab;
  if (lifted != 0) return sign_of<Number>(lifted);
  const Number of_products = a.x * a.y * bc + b.x * b.y * ca + c.x * c.y * ab;
  if (of_products != 0) return sign_of<Number>(of_products);
  return sign_of<Number>(a.x * a.x * bc + b.x * b.x * ca + c.x * c.x * ab);
}

/// Two vectors that span a lattice.
template <class Number>
struct Box {
  Vector<Number> first{1, 0};
  Vector<Number> second{0, 1};
};

/// A point: its id, its place, and its weight.
template <class Number>
struct Placed_point {
  Placed_point(Point_id i, const Vector<Number>& p, const Number& w = 0)
      : id(i), place(p), weight(w) {}
  Point_id id;
  Vector<Number> place;
  Number weight;
};

/// An image: the id of the point and the offset.
using Image = std::tuple<Point_id, std::int64_t, std::int64_t>;
/// The corners of a face, moved and rotated so that the result is the same for all its images.
using Face = std::array<Image, 3>;

inline Face normal_form(const Face& face) {
  Face best;
  for (std::size_t r = 0; r < 3; ++r) {
    Face moved;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [id, x, y] = face[(r + i) % 3];
      moved[i] = {id, x - std::get<1>(face[r]), y - std::get<2>(face[r])};
    }
    if (r == 0 || moved < best) best = moved;
  }
  return best;
}

template <class Number>
struct Copy {
  Vector<Number> place;
  Image image;
  Number weight = 0;
};

/// Precondition: b > 0.
template <class Number>
Number floor_of_quotient(const Number& a, const Number& b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

/// Two shortest vectors of a lattice that span it, and their offsets.
template <class Number>
struct Reduced {
  Vector<Number> first;
  Vector<Number> second;
  std::array<std::int64_t, 2> first_offset = {1, 0};
  std::array<std::int64_t, 2> second_offset = {0, 1};

  explicit Reduced(const Box<Number>& box) : first(box.first), second(box.second) {
    for (;;) {
      if (dot(first, first) > dot(second, second)) {
        std::swap(first, second);
        std::swap(first_offset, second_offset);
      }
      const Number length = dot(first, first);
      const Number k = floor_of_quotient<Number>(2 * dot(first, second) + length, 2 * length);
      if (k == 0) return;
      second = second - Vector<Number>{k * first.x, k * first.y};
      for (std::size_t i = 0; i < 2; ++i)
        second_offset[i] -= static_cast<std::int64_t>(k) * first_offset[i];
    }
  }

  Copy<Number> moved(const Copy<Number>& copy, std::int64_t r, std::int64_t s) const {
    const auto& [id, x, y] = copy.image;
    return {{copy.place.x + r * first.x + s * second.x, copy.place.y + r * first.y + s * second.y},
            {id, x + r * first_offset[0] + s * second_offset[0],
             y + r * first_offset[1] + s * second_offset[1]},
            copy.weight};
  }
};

/// The copies of the points in one cell of the reduced basis, first, and in the three on each side.
/// The neighbors of a point in the cell are among them: a circle with no copies inside is no wider
/// along a line of copies than the first vector. With weights, no position in the cell of a point
/// is farther from it than from an image of the heaviest one, which has such a circle.
template <class Number>
std::vector<Copy<Number>> copies(const Box<Number>& box,
                                 const std::vector<Placed_point<Number>>& points) {
  const Reduced<Number> basis(box);
  const Number area = cross(basis.first, basis.second);
  const auto cells = [area](const Number& numerator) {
    return static_cast<std::int64_t>(area > 0 ? floor_of_quotient<Number>(numerator, area)
                                              : floor_of_quotient<Number>(-numerator, -area));
  };
  std::vector<Copy<Number>> result;
  for (const auto& [id, place, weight] : points) {
    result.push_back(basis.moved({place, {id, 0, 0}, weight}, -cells(cross(place, basis.second)),
                                 -cells(cross(basis.first, place))));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::int64_t r = -3; r <= 3; ++r) {
      for (std::int64_t s = -3; s <= 3; ++s) {
        if (r != 0 || s != 0) result.push_back(basis.moved(result[i], r, s));
      }
    }
  }
  return result;
}

/// The faces of the Delaunay or regular triangulation, sorted, each once. A point that is in none
/// is hidden. Precondition: no images coincide that have the same weight.
template <class Number>
std::vector<Face> reference(const Box<Number>& box,
                            const std::vector<Placed_point<Number>>& points) {
  const std::vector<Copy<Number>> all = copies(box, points);
  const auto contains = [](const Copy<Number>& p, const Copy<Number>& q, const Copy<Number>& r,
                           const Copy<Number>& s) {
    return in_circle<Number>(p.place, q.place, r.place, s.place,
                             {p.weight, q.weight, r.weight, s.weight}) > 0;
  };
  std::set<Face> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector<Number>& p = all[i].place;
    for (const Copy<Number>& q : all) {
      if (q.image == all[i].image) continue;
      // The apex whose circle contains no other to the left of p q.
      const Copy<Number>* apex = nullptr;
      for (const Copy<Number>& r : all) {
        if (turn(p, q.place, r.place) <= 0) continue;
        if (apex == nullptr || contains(all[i], q, *apex, r)) apex = &r;
      }
      if (apex == nullptr) continue;
      const bool is_empty = std::ranges::none_of(all, [&](const Copy<Number>& s) {
        return s.image != all[i].image && s.image != q.image && s.image != apex->image &&
               contains(all[i], q, *apex, s);
      });
      if (is_empty) result.insert(normal_form({all[i].image, q.image, apex->image}));
    }
  }
  return {result.begin(), result.end()};
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_TORUS_REFERENCE_H
