// SPDX-License-Identifier: GPL-3.0-or-later
//
// Answers of queries in periodic boxes, by an oracle that examines all copies of the points about a
// reduced basis of the lattice in exact arithmetic.
#ifndef KINETRI_TEST_SUPPORT_PERIODIC_QUERY_ORACLE_H
#define KINETRI_TEST_SUPPORT_PERIODIC_QUERY_ORACLE_H

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "kinetri/triangulation/periodic_queries_2.h"
#include "support/kinetic_in_box.h"
#include "support/periodic_runs.h"
#include "support/torus_reference.h"

namespace kinetri::test {

using Exact_place = Vector<Rational>;

inline Rational squared_distance(const Exact_place& p, const Exact_place& q) {
  return dot(p - q, p - q);
}
inline bool is_strictly_between(const Exact_place& p, const Exact_place& q, const Exact_place& r) {
  return turn(p, q, r) == 0 && dot(p - q, r - q) < 0;
}

/// The points at a rational time, and answers by exhaustive search. All numbers of motions are
/// small integers, with the epoch 0; query positions are multiples of 1/2.
class Periodic_query_oracle {
 public:
  Periodic_query_oracle(const Kinetic_in_box& kinetic, const Rational& t)
      : p_(2 * numerator(t).convert_to<std::int64_t>()),
        q_(2 * denominator(t).convert_to<std::int64_t>()) {
    const Periodic_box_2& box = kinetic.traits().box();
    box_ = {scaled(box.first()), scaled(box.second())};
    first_ = place(box_.first);
    second_ = place(box_.second);
    std::vector<Placed_point<Wide>> points;
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (!kinetic.contains(id)) continue;
      points.emplace_back(id, scaled(kinetic.motion(id)));
      given_[id] = place(points.back().place);
    }
    for (const auto& copy : copies(box_, points)) {
      if (in_cells_.size() < points.size()) in_cells_.push_back(copy);
      copies_.push_back(exact(copy));
    }
    for (std::size_t i = 0; i < points.size(); ++i) base_[copies_[i].image.id] = copies_[i];
    for (const auto face : kinetic.triangulation().finite_face_handles()) {
      for (const Exact_copy& copy : copies_) {
        if (copy.image.id != face->vertex(0)->point().id()) continue;
        std::vector<Exact_copy> corners;
        for (int i = 0; i < 3; ++i) {
          const Lattice_offset_2 o = face->offset(i);
          const Periodic_image image = {face->vertex(i)->point().id(),
                                        {copy.image.offset.x + o.x, copy.image.offset.y + o.y}};
          corners.push_back({place_of(image), image});
        }
        faces_.push_back(corners);
      }
    }
  }

  Rational area_of_box() const { return cross(first_, second_); }
  const std::map<Point_id, Exact_place>& given() const { return given_; }
  Exact_place place_of(const Periodic_image& image) const {
    const Exact_place& p = given_.at(image.id);
    return {p.x + image.offset.x * first_.x + image.offset.y * second_.x,
            p.y + image.offset.x * first_.y + image.offset.y * second_.y};
  }

  std::optional<Periodic_image> nearest(const Vector_2& query) const {
    const Exact_copy in_cell = in_cell_of(query);
    std::optional<std::tuple<Rational, Periodic_image>> best;
    for (const Exact_copy& copy : copies_) {
      const std::tuple key(squared_distance(copy.place, in_cell.place), copy.image);
      if (!best || key < *best) best = key;
    }
    if (!best) return std::nullopt;
    return relative(std::get<1>(*best), in_cell);
  }

  /// Of points that coincide, the least id is at a vertex.
  Periodic_location_2 locate(const Vector_2& query) const {
    if (given_.empty()) return {};
    const Exact_copy in_cell = in_cell_of(query);
    const Exact_place& q = in_cell.place;
    std::optional<Periodic_image> vertex;
    for (const Exact_copy& copy : copies_) {
      if (copy.place == q && (!vertex || copy.image < *vertex)) vertex = copy.image;
    }
    if (vertex) return {Location_2::Kind::vertex, {relative(*vertex, in_cell)}};
    std::vector<std::vector<Periodic_image>> edges;
    for (const auto& corners : faces_) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Exact_copy& a = corners[i];
        const Exact_copy& b = corners[(i + 1) % 3];
        if (!is_strictly_between(a.place, q, b.place)) continue;
        if (std::ranges::any_of(copies_, [&](const Exact_copy& c) {
              return is_strictly_between(a.place, c.place, b.place);
            }))
          continue;
        edges.push_back({relative(std::min(a.image, b.image), in_cell),
                         relative(std::max(a.image, b.image), in_cell)});
      }
    }
    if (!edges.empty()) return {Location_2::Kind::edge, *std::ranges::min_element(edges)};
    for (const auto& corners : faces_) {
      bool is_inside = true;
      std::vector<Periodic_image> images;
      for (std::size_t i = 0; i < 3; ++i) {
        is_inside = is_inside && turn(corners[i].place, corners[(i + 1) % 3].place, q) > 0;
        images.push_back(relative(corners[i].image, in_cell));
      }
      if (!is_inside) continue;
      std::rotate(images.begin(), std::ranges::min_element(images), images.end());
      return {Location_2::Kind::face, images};
    }
    ADD_FAILURE() << "no face at the position";
    return {};
  }

  Periodic_image nearest_neighbor(Point_id id) const {
    const Exact_copy& own = base_.at(id);
    std::optional<std::tuple<Rational, Periodic_image>> best;
    for (const Exact_copy& copy : copies_) {
      if (copy.image == own.image) continue;
      const std::tuple key(squared_distance(copy.place, own.place), copy.image);
      if (!best || key < *best) best = key;
    }
    return relative(std::get<1>(*best), own);
  }

  /// Of all images less than k + 2 vectors of the reduced basis away from the cell of the point.
  /// The k images along the shortest vector are at most (k + 1) / 2 of its lengths away, and what
  /// is farther than r cells on one side is more than 0.86 (r - 1) of them away.
  std::vector<Periodic_image> nearest_neighbors(Point_id id, int k) const {
    const Reduced<Wide> basis(box_);
    const Periodic_image& own = base_.at(id).image;
    const auto place_of_own = std::ranges::find(in_cells_, id, id_of)->place;
    std::vector<std::tuple<Wide, Periodic_image>> found;
    for (const Copy<Wide>& copy : in_cells_) {
      for (int r = -k - 2; r <= k + 2; ++r) {
        for (int s = -k - 2; s <= k + 2; ++s) {
          const Copy<Wide> moved = basis.moved(copy, r, s);
          const Periodic_image image = image_of(moved);
          if (image == own) continue;
          const Vector<Wide> away = moved.place - place_of_own;
          found.emplace_back(dot(away, away), relative(image, base_.at(id)));
        }
      }
    }
    std::ranges::sort(found);
    std::vector<Periodic_image> result;
    for (int i = 0; i < k; ++i) {
      result.push_back(std::get<1>(found[static_cast<std::size_t>(i)]));
    }
    return result;
  }

  std::optional<Periodic_edge> closest_pair() const {
    std::optional<std::tuple<Rational, Periodic_edge>> best;
    for (const auto& [id, own] : base_) {
      for (const Exact_copy& copy : copies_) {
        if (copy.image == own.image) continue;
        const Periodic_image image = relative(copy.image, own);
        const std::tuple key(squared_distance(copy.place, own.place),
                             periodic_edge(id, image.id, image.offset));
        if (!best || key < *best) best = key;
      }
    }
    return best ? std::optional(std::get<1>(*best)) : std::nullopt;
  }

  /// The smallest id of a point with an image at the position of the point.
  Point_id least_at(Point_id id) const {
    Point_id result = id;
    for (const Exact_copy& copy : copies_) {
      if (copy.place == base_.at(id).place) result = std::min(result, copy.image.id);
    }
    return result;
  }

  /// The intersection of the half planes of all copies.
  struct Cell {
    Periodic_voronoi_cell_2<Exact_position_2> cell;
    Rational area;
    double radius = 0;     // a bound
    double perimeter = 0;  // a bound
  };
  Cell cell(Point_id id) const {
    const Exact_copy& own = base_.at(id);
    const Exact_place& p = own.place;
    constexpr int far = 100000;
    std::vector<Exact_place> polygon;
    for (const auto& [x, y] : {std::array{-far, -far}, {far, -far}, {far, far}, {-far, far}}) {
      polygon.push_back({p.x + x, p.y + y});
    }
    // By how much a place is nearer to a copy than to p: the difference of the squared distances.
    struct Side {
      const Exact_copy* copy;
      Exact_place normal;
      Rational constant;
      Rational beyond(const Exact_place& v) const { return dot(normal, v) + constant; }
    };
    std::vector<Side> sides;
    for (const Exact_copy& u : copies_) {
      if (u.place == p) continue;
      const Exact_place away = u.place - p;
      sides.push_back({&u, {2 * away.x, 2 * away.y}, dot(p, p) - dot(u.place, u.place)});
    }
    for (const Side& side : sides) {
      std::vector<Rational> beyond;
      for (const Exact_place& v : polygon) beyond.push_back(side.beyond(v));
      std::vector<Exact_place> left;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Exact_place& v = polygon[i];
        const Exact_place& w = polygon[(i + 1) % polygon.size()];
        const Rational& here = beyond[i];
        const Rational& there = beyond[(i + 1) % polygon.size()];
        if (here <= 0) left.push_back(v);
        if (!(here * there < 0)) continue;
        const Rational part = here / (here - there);
        left.push_back({v.x + part * (w.x - v.x), v.y + part * (w.y - v.y)});
      }
      polygon = left;
    }
    Cell result;
    auto& neighbors = result.cell.neighbors;
    auto& vertices = result.cell.vertices;
    std::vector<std::tuple<Rational, Periodic_image>> across;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Exact_place& v = polygon[i];
      const Exact_place& w = polygon[(i + 1) % polygon.size()];
      std::optional<std::tuple<Rational, Periodic_image>> least;
      for (const Side& side : sides) {
        if (side.beyond(v) != 0 || side.beyond(w) != 0) continue;
        const Exact_copy& u = *side.copy;
        const std::tuple key(squared_distance(p, u.place), u.image);
        if (!least || key < *least) least = key;
      }
      across.push_back(*least);
      result.area += cross(v - p, w - p) / 2;
      const auto length = [](const Rational& squared) {
        return std::sqrt(to_double(squared)) * (1 + 0x1p-50);
      };
      result.radius = std::max(result.radius, length(squared_distance(v, p)));
      result.perimeter += length(squared_distance(v, w));
    }
    const auto first = std::ranges::min_element(across) - across.begin();
    const Exact_place& given = given_.at(id);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t k = (static_cast<std::size_t>(first) + i) % polygon.size();
      neighbors.push_back(relative(std::get<1>(across[k]), own));
      const Exact_place& end = polygon[(k + 1) % polygon.size()];
      vertices.push_back({given.x + (end.x - p.x), given.y + (end.y - p.y)});
    }
    return result;
  }

  /// The position of the image in the parallelogram of the box.
  Exact_place wrapped(const Exact_place& p) const {
    const auto floor_of = [](const Rational& x) -> Rational {
      const Integer quotient = numerator(x) / denominator(x);
      return Rational(quotient) - (Rational(quotient) > x ? 1 : 0);
    };
    const Rational k = floor_of(cross(p, second_) / area_of_box());
    const Rational l = floor_of(cross(first_, p) / area_of_box());
    return {p.x - k * first_.x - l * second_.x, p.y - k * first_.y - l * second_.y};
  }

 private:
  struct Exact_copy {
    Exact_place place;
    Periodic_image image;
  };

  Vector<Wide> scaled(const Linear_motion_2& motion) const {
    const auto at = [&](double position, double velocity) {
      return static_cast<Wide>(position) * q_ + static_cast<Wide>(velocity) * p_;
    };
    return {at(motion.position.x, motion.velocity.x), at(motion.position.y, motion.velocity.y)};
  }
  Exact_place place(const Vector<Wide>& v) const {
    const auto divided = [&](Wide x) -> Rational {
      return Rational(static_cast<std::int64_t>(x)) / q_;
    };
    return {divided(v.x), divided(v.y)};
  }
  static Point_id id_of(const Copy<Wide>& copy) { return std::get<0>(copy.image); }
  static Periodic_image image_of(const Copy<Wide>& copy) {
    const auto& [id, x, y] = copy.image;
    return {id, {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}};
  }
  Exact_copy exact(const Copy<Wide>& copy) const { return {place(copy.place), image_of(copy)}; }
  Exact_copy in_cell_of(const Vector_2& query) const {
    const auto at = [&](double x) { return static_cast<Wide>(2 * x) * (q_ / 2); };
    return exact(copies<Wide>(box_, {{0, {at(query.x), at(query.y)}}}).front());
  }
  static Periodic_image relative(const Periodic_image& image, const Exact_copy& to) {
    return {image.id, {image.offset.x - to.image.offset.x, image.offset.y - to.image.offset.y}};
  }

  // The time is p_ / q_; positions are multiples of 1 / q_.
  std::int64_t p_;
  std::int64_t q_;
  Box<Wide> box_;
  Exact_place first_;
  Exact_place second_;
  std::map<Point_id, Exact_place> given_;
  std::vector<Copy<Wide>> in_cells_;  // one of each point, in one cell
  std::vector<Exact_copy> copies_;
  std::map<Point_id, Exact_copy> base_;
  std::vector<std::vector<Exact_copy>> faces_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_PERIODIC_QUERY_ORACLE_H
