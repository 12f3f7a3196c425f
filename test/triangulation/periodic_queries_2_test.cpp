// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries in periodic boxes, compared with an oracle that examines all copies of the points about a
// reduced basis of the lattice in exact arithmetic, and with queries about copies in the plane.
#include "kinetri/triangulation/periodic_queries_2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/message_of.h"
#include "support/multiplier.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"
#include "support/random_choices.h"
#include "support/torus_reference.h"

namespace kinetri::periodic_queries_2_test {
namespace {

using Traits = Periodic_kinetic_traits_2;
using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;
using Time = Algebraic_number;
using Kind = Location_2::Kind;
using Place = test::Vector<Rational>;
__extension__ using Wide = __int128;

unsigned times(unsigned number) {
  return number * static_cast<unsigned>(test::multiplier());
}
Kinetic kinetic_of(const Periodic_box_2& box, const std::vector<Linear_motion_2>& motions) {
  return Kinetic(motions, Time(0), Traits(box));
}
Periodic_box_2 square(double side) {
  return {{{side, 0}, {0, 0}, 0}, {{0, side}, {0, 0}, 0}};
}

Rational squared_distance(const Place& p, const Place& q) {
  return dot(p - q, p - q);
}
bool is_strictly_between(const Place& p, const Place& q, const Place& r) {
  return turn(p, q, r) == 0 && dot(p - q, r - q) < 0;
}

/// The points at a rational time, and answers by exhaustive search. All numbers of motions are
/// small integers, with the epoch 0; query positions are multiples of 1/2.
class Oracle {
 public:
  Oracle(const Kinetic& kinetic, const Rational& t)
      : p_(2 * numerator(t).convert_to<std::int64_t>()),
        q_(2 * denominator(t).convert_to<std::int64_t>()) {
    const Periodic_box_2& box = kinetic.traits().box();
    box_ = {scaled(box.first()), scaled(box.second())};
    first_ = place(box_.first);
    second_ = place(box_.second);
    std::vector<test::Placed_point<Wide>> points;
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (!kinetic.contains(id)) continue;
      points.emplace_back(id, scaled(kinetic.motion(id)));
      given_[id] = place(points.back().place);
    }
    for (const auto& copy : test::copies(box_, points)) {
      if (in_cells_.size() < points.size()) in_cells_.push_back(copy);
      copies_.push_back(exact(copy));
    }
    for (std::size_t i = 0; i < points.size(); ++i) base_[copies_[i].image.id] = copies_[i];
    for (const auto face : kinetic.triangulation().finite_face_handles()) {
      for (const Copy& copy : copies_) {
        if (copy.image.id != face->vertex(0)->point().id()) continue;
        std::vector<Copy> corners;
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
  const std::map<Point_id, Place>& given() const { return given_; }
  Place place_of(const Periodic_image& image) const {
    const Place& p = given_.at(image.id);
    return {p.x + image.offset.x * first_.x + image.offset.y * second_.x,
            p.y + image.offset.x * first_.y + image.offset.y * second_.y};
  }

  std::optional<Periodic_image> nearest(const Vector_2& query) const {
    const Copy in_cell = in_cell_of(query);
    std::optional<std::tuple<Rational, Periodic_image>> best;
    for (const Copy& copy : copies_) {
      const std::tuple key(squared_distance(copy.place, in_cell.place), copy.image);
      if (!best || key < *best) best = key;
    }
    if (!best) return std::nullopt;
    return relative(std::get<1>(*best), in_cell);
  }

  /// Of points that coincide, the least id is at a vertex.
  Periodic_location_2 locate(const Vector_2& query) const {
    if (given_.empty()) return {};
    const Copy in_cell = in_cell_of(query);
    const Place& q = in_cell.place;
    std::optional<Periodic_image> vertex;
    for (const Copy& copy : copies_) {
      if (copy.place == q && (!vertex || copy.image < *vertex)) vertex = copy.image;
    }
    if (vertex) return {Kind::vertex, {relative(*vertex, in_cell)}};
    std::vector<std::vector<Periodic_image>> edges;
    for (const auto& corners : faces_) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Copy& a = corners[i];
        const Copy& b = corners[(i + 1) % 3];
        if (!is_strictly_between(a.place, q, b.place)) continue;
        if (std::ranges::any_of(copies_, [&](const Copy& c) {
              return is_strictly_between(a.place, c.place, b.place);
            }))
          continue;
        edges.push_back({relative(std::min(a.image, b.image), in_cell),
                         relative(std::max(a.image, b.image), in_cell)});
      }
    }
    if (!edges.empty()) return {Kind::edge, *std::ranges::min_element(edges)};
    for (const auto& corners : faces_) {
      bool is_inside = true;
      std::vector<Periodic_image> images;
      for (std::size_t i = 0; i < 3; ++i) {
        is_inside = is_inside && turn(corners[i].place, corners[(i + 1) % 3].place, q) > 0;
        images.push_back(relative(corners[i].image, in_cell));
      }
      if (!is_inside) continue;
      std::rotate(images.begin(), std::ranges::min_element(images), images.end());
      return {Kind::face, images};
    }
    ADD_FAILURE() << "no face at the position";
    return {};
  }

  Periodic_image nearest_neighbor(Point_id id) const {
    const Copy& own = base_.at(id);
    std::optional<std::tuple<Rational, Periodic_image>> best;
    for (const Copy& copy : copies_) {
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
    const test::Reduced<Wide> basis(box_);
    const Periodic_image& own = base_.at(id).image;
    const auto place_of_own = std::ranges::find(in_cells_, id, id_of)->place;
    std::vector<std::tuple<Wide, Periodic_image>> found;
    for (const test::Copy<Wide>& copy : in_cells_) {
      for (int r = -k - 2; r <= k + 2; ++r) {
        for (int s = -k - 2; s <= k + 2; ++s) {
          const test::Copy<Wide> moved = basis.moved(copy, r, s);
          const Periodic_image image = image_of(moved);
          if (image == own) continue;
          const test::Vector<Wide> away = moved.place - place_of_own;
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
      for (const Copy& copy : copies_) {
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
    for (const Copy& copy : copies_) {
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
    const Copy& own = base_.at(id);
    const Place& p = own.place;
    constexpr int far = 100000;
    std::vector<Place> polygon;
    for (const auto& [x, y] : {std::array{-far, -far}, {far, -far}, {far, far}, {-far, far}}) {
      polygon.push_back({p.x + x, p.y + y});
    }
    const auto beyond = [&](const Place& v, const Copy& u) -> Rational {
      return squared_distance(v, p) - squared_distance(v, u.place);
    };
    for (const Copy& u : copies_) {
      if (u.place == p) continue;
      std::vector<Place> left;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Place& v = polygon[i];
        const Place& w = polygon[(i + 1) % polygon.size()];
        const Rational here = beyond(v, u);
        const Rational there = beyond(w, u);
        if (here <= 0) left.push_back(v);
        if (!(here * there < 0)) continue;
        const Rational part = here / (here - there);
        left.push_back({v.x + part * (w.x - v.x), v.y + part * (w.y - v.y)});
      }
      polygon = left;
    }
    Cell result;
    auto& [neighbors, vertices] = result.cell;
    std::vector<std::tuple<Rational, Periodic_image>> across;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Place& v = polygon[i];
      const Place& w = polygon[(i + 1) % polygon.size()];
      std::optional<std::tuple<Rational, Periodic_image>> least;
      for (const Copy& u : copies_) {
        if (u.place == p || beyond(v, u) != 0 || beyond(w, u) != 0) continue;
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
    const Place& given = given_.at(id);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t k = (static_cast<std::size_t>(first) + i) % polygon.size();
      neighbors.push_back(relative(std::get<1>(across[k]), own));
      const Place& end = polygon[(k + 1) % polygon.size()];
      vertices.push_back({given.x + (end.x - p.x), given.y + (end.y - p.y)});
    }
    return result;
  }

  /// The position of the image in the parallelogram of the box.
  Place wrapped(const Place& p) const {
    const auto floor_of = [](const Rational& x) -> Rational {
      const Integer quotient = numerator(x) / denominator(x);
      return Rational(quotient) - (Rational(quotient) > x ? 1 : 0);
    };
    const Rational k = floor_of(cross(p, second_) / area_of_box());
    const Rational l = floor_of(cross(first_, p) / area_of_box());
    return {p.x - k * first_.x - l * second_.x, p.y - k * first_.y - l * second_.y};
  }

 private:
  struct Copy {
    Place place;
    Periodic_image image;
  };

  test::Vector<Wide> scaled(const Linear_motion_2& motion) const {
    const auto at = [&](double position, double velocity) {
      return static_cast<Wide>(position) * q_ + static_cast<Wide>(velocity) * p_;
    };
    return {at(motion.position.x, motion.velocity.x), at(motion.position.y, motion.velocity.y)};
  }
  Place place(const test::Vector<Wide>& v) const {
    const auto divided = [&](Wide x) -> Rational {
      return Rational(static_cast<std::int64_t>(x)) / q_;
    };
    return {divided(v.x), divided(v.y)};
  }
  static Point_id id_of(const test::Copy<Wide>& copy) { return std::get<0>(copy.image); }
  static Periodic_image image_of(const test::Copy<Wide>& copy) {
    const auto& [id, x, y] = copy.image;
    return {id, {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}};
  }
  Copy exact(const test::Copy<Wide>& copy) const { return {place(copy.place), image_of(copy)}; }
  Copy in_cell_of(const Vector_2& query) const {
    const auto at = [&](double x) { return static_cast<Wide>(2 * x) * (q_ / 2); };
    return exact(test::copies<Wide>(box_, {{0, {at(query.x), at(query.y)}}}).front());
  }
  static Periodic_image relative(const Periodic_image& image, const Copy& to) {
    return {image.id, {image.offset.x - to.image.offset.x, image.offset.y - to.image.offset.y}};
  }

  // The time is p_ / q_; positions are multiples of 1 / q_.
  std::int64_t p_;
  std::int64_t q_;
  test::Box<Wide> box_;
  Place first_;
  Place second_;
  std::map<Point_id, Place> given_;
  std::vector<test::Copy<Wide>> in_cells_;  // one of each point, in one cell
  std::vector<Copy> copies_;
  std::map<Point_id, Copy> base_;
  std::vector<std::vector<Copy>> faces_;
};

std::string text(const Periodic_image& image) {
  return std::to_string(image.id) + " (" + std::to_string(image.offset.x) + ", " +
         std::to_string(image.offset.y) + ")";
}
std::string text(const std::vector<Periodic_image>& images) {
  std::string result;
  for (const Periodic_image& image : images) result += text(image) + "; ";
  return result;
}

/// What degenerate cases there were.
struct Seen {
  int sides_without_length = 0;
  int coincidences = 0;
  int locations[3] = {0, 0, 0};
};

void expect_neighbors(const Kinetic& kinetic, const Periodic_queries_2& queries, Point_id id) {
  const std::vector<Periodic_image> neighbors = queries.neighbors(id);
  const auto coincident = kinetic.coincident_points(id);
  if (!coincident.empty() && coincident.front() < id) {
    ASSERT_EQ(neighbors.size(), 1u);
    EXPECT_EQ(neighbors.front().id, coincident.front());
    return;
  }
  ASSERT_GT(neighbors.size(), coincident.size());
  const std::size_t degree = neighbors.size() - coincident.size();
  for (std::size_t i = 0; i < coincident.size(); ++i) {
    EXPECT_EQ(neighbors[degree + i].id, coincident[i]);
  }
  EXPECT_EQ(std::ranges::min_element(neighbors.begin(),
                                     neighbors.begin() + static_cast<std::ptrdiff_t>(degree)),
            neighbors.begin());
  // The faces at the point, each as often as it has the point as a corner.
  std::multiset<test::Face> faces;
  std::multiset<test::Face> expected;
  for (const auto face : kinetic.triangulation().finite_face_handles()) {
    const auto image = [&](int i) -> test::Image {
      return {face->vertex(i)->point().id(), face->offset(i).x, face->offset(i).y};
    };
    for (int i = 0; i < 3; ++i) {
      if (std::get<0>(image(i)) != id) continue;
      expected.insert(test::normal_form({image(0), image(1), image(2)}));
    }
  }
  for (std::size_t i = 0; i < degree; ++i) {
    const auto image = [&](std::size_t k) -> test::Image {
      const auto& [u, offset] = neighbors[k % degree];
      return {u, offset.x, offset.y};
    };
    faces.insert(test::normal_form({test::Image{id, 0, 0}, image(i), image(i + 1)}));
  }
  EXPECT_EQ(faces, expected);
}

void expect_right_answers(const Kinetic& kinetic, const Rational& t, test::Random_choices& random,
                          Seen& seen) {
  const Periodic_queries_2 queries(kinetic, Time(t));
  const Oracle oracle(kinetic, t);
  const std::vector<double> areas = queries.rounded_voronoi_areas();
  const std::vector<double> positions = queries.rounded_positions();
  const std::vector<double> wrapped = queries.rounded_positions(true);
  const std::vector<Periodic_image> nearest = queries.nearest_neighbors();
  const int k = random.integer(0, 9);
  const std::vector<Periodic_image> k_nearest =
      queries.nearest_neighbors(static_cast<std::size_t>(k));
  ASSERT_EQ(k_nearest.size(), static_cast<std::size_t>(k) * kinetic.next_id());
  EXPECT_EQ(queries.closest_pair(), oracle.closest_pair());
  ASSERT_EQ(areas.size(), kinetic.next_id());
  ASSERT_EQ(nearest.size(), kinetic.next_id());
  ASSERT_EQ(wrapped.size(), 2 * kinetic.next_id());
  Rational sum_of_areas;
  std::map<Point_id, std::vector<Point_id>> sharing;  // by the least id at the position
  for (const auto& [id, place] : oracle.given()) {
    SCOPED_TRACE("point " + std::to_string(id));
    EXPECT_EQ(text(queries.nearest_neighbor(id)), text(oracle.nearest_neighbor(id)));
    EXPECT_EQ(nearest[id], queries.nearest_neighbor(id));
    const auto first = k_nearest.begin() + k * static_cast<std::ptrdiff_t>(id);
    EXPECT_EQ(text({first, first + k}), text(oracle.nearest_neighbors(id, k)));
    expect_neighbors(kinetic, queries, id);
    // The hidden ones are at the position.
    const auto coincident = kinetic.coincident_points(id);
    const auto neighbors = queries.neighbors(id);
    for (std::size_t i = 0; i < std::min(coincident.size(), neighbors.size()); ++i) {
      EXPECT_EQ(oracle.place_of(neighbors[neighbors.size() - 1 - i]), place);
      if (coincident.front() < id) break;
    }

    const Oracle::Cell expected = oracle.cell(id);
    const auto cell = queries.voronoi_cell(id);
    EXPECT_EQ(text(cell.neighbors), text(expected.cell.neighbors));
    const auto rounded_cell = queries.rounded_voronoi_cell(id);
    EXPECT_EQ(rounded_cell.neighbors, cell.neighbors);
    ASSERT_EQ(cell.vertices.size(), expected.cell.vertices.size());
    ASSERT_EQ(rounded_cell.vertices.size(), cell.vertices.size());
    for (std::size_t i = 0; i < cell.vertices.size(); ++i) {
      const auto& [x, y] = expected.cell.vertices[i];
      EXPECT_EQ(cell.vertices[i].x, x);
      EXPECT_EQ(cell.vertices[i].y, y);
      EXPECT_EQ(rounded_cell.vertices[i], (Vector_2{to_double(x), to_double(y)}));
    }
    if (cell.vertices.size() < neighbors.size() && coincident.empty()) ++seen.sides_without_length;

    const Point_id least = oracle.least_at(id);
    if (least != id && coincident.empty()) ++seen.coincidences;
    if (least == id) {
      sum_of_areas += expected.area;
      const auto share = static_cast<double>(1 + coincident.size());
      const Rational error = abs(Rational(to_rational(areas[id] * share) - expected.area));
      const double bound = (3 + static_cast<double>(cell.vertices.size()) / 2) * 0x1p-53 *
                           expected.radius * expected.perimeter;
      EXPECT_LE(error, to_rational(bound));
      for (const Point_id other : coincident) EXPECT_EQ(areas[other], areas[id]);
    } else if (coincident.empty() || id < coincident.front()) {
      EXPECT_EQ(areas[id], 0);
    }
    EXPECT_EQ(positions[2 * id], to_double(place.x));
    EXPECT_EQ(positions[2 * id + 1], to_double(place.y));
    EXPECT_EQ(wrapped[2 * id], to_double(oracle.wrapped(place).x));
    EXPECT_EQ(wrapped[2 * id + 1], to_double(oracle.wrapped(place).y));
  }
  EXPECT_EQ(sum_of_areas, oracle.given().empty() ? Rational(0) : oracle.area_of_box());
  for (int i = 0; i < 12; ++i) {
    const int range = i < 9 ? 12 : 1000;
    Vector_2 place = {random.integer(-range, range) / 2.0, random.integer(-range, range) / 2.0};
    // At an image, or in the middle between two.
    if (i % 3 == 0 && !oracle.given().empty()) {
      const Place& p = oracle.given().begin()->second;
      const Place& q = oracle.given().rbegin()->second;
      const Vector_2 middle = {to_double(p.x + q.x) / 2, to_double(p.y + q.y) / 2};
      if (2 * middle.x == std::floor(2 * middle.x) && 2 * middle.y == std::floor(2 * middle.y)) {
        place = middle;
      }
    }
    SCOPED_TRACE("position " + std::to_string(place.x) + ", " + std::to_string(place.y));
    const auto image = queries.nearest_vertex(place);
    EXPECT_EQ(image, oracle.nearest(place));
    const Periodic_location_2 location = queries.locate(place);
    const Periodic_location_2 expected = oracle.locate(place);
    EXPECT_EQ(location.kind, expected.kind);
    EXPECT_EQ(text(location.points), text(expected.points));
    if (image) ++seen.locations[static_cast<int>(location.kind)];
  }
}

Periodic_box_2 random_box(test::Random_choices& random, int range) {
  const int kind = random.integer(0, 3);
  for (;;) {
    const auto number = [&](int greatest) {
      return static_cast<double>(random.integer(-greatest, greatest));
    };
    const Vector_2 a = {number(range), number(range)};
    const Vector_2 b = {number(range), number(range)};
    if (a.x * b.y - a.y * b.x <= 0) continue;
    switch (kind) {
      case 0:  // at rest
        return {{a, {0, 0}, 0}, {b, {0, 0}, 0}};
      case 1:  // grows in proportion
        return {{a, a, 0}, {b, b, 0}};
      case 2:  // shear
        return {{{static_cast<double>(range), 0}, {0, 0}, 0},
                {{0, static_cast<double>(range)}, {static_cast<double>(range), 0}, 0}};
      default:
        return {{a, {number(1), number(1)}, 0}, {b, {number(1), number(1)}, 0}};
    }
  }
}

/// Some are images of others at all times.
std::vector<Linear_motion_2> random_motions(test::Random_choices& random, int number, int range,
                                            const Periodic_box_2& box) {
  std::vector<Linear_motion_2> result;
  for (int i = 0; i < number; ++i) {
    const auto coordinate = [&] { return static_cast<double>(random.integer(-range, range)); };
    Linear_motion_2 motion = {{coordinate(), coordinate()}, {coordinate(), coordinate()}, 0};
    if (i > 0 && random.integer(0, 4) == 0) {
      motion = result[static_cast<std::size_t>(random.integer(0, i - 1))];
      const auto add = [&](int k, const Linear_motion_2& vector) {
        motion.position.x += k * vector.position.x;
        motion.position.y += k * vector.position.y;
        motion.velocity.x += k * vector.velocity.x;
        motion.velocity.y += k * vector.velocity.y;
      };
      add(random.integer(-2, 2), box.first());
      add(random.integer(-2, 2), box.second());
    }
    result.push_back(motion);
  }
  return result;
}

TEST(Periodic_queries_2, are_those_of_an_oracle_at_rational_times) {
  Seen seen;
  int irrational = 0;
  for (unsigned seed = 1; seed <= times(24); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random_choices random(seed);
    const int range = std::array{2, 3, 5}[seed % 3];
    const Periodic_box_2 box = random_box(random, range);
    Kinetic kinetic =
        kinetic_of(box, random_motions(random, static_cast<int>(seed % 7), range, box));
    for (int steps = 0; steps < 4; ++steps) {
      const Time now = kinetic.current_time();
      Time end = Time(Rational(now.upper() + 1));
      if (const auto collapse = box.collapse_after(now)) {
        end = std::min(end, Time(simplest_between(now, *collapse)));
      }
      if (const auto next = kinetic.next_event_time()) end = std::min(end, *next);
      std::vector<Rational> at;
      if (now.is_known_rational()) at.push_back(now.rational());
      if (now < end) at.push_back(simplest_between(now, end));
      // The queries may find out that a time is rational.
      const Periodic_queries_2 queries(kinetic, end);
      if (const auto t = test::rational_value(end)) {
        at.push_back(*t);
      } else {
        ++irrational;
        if (kinetic.number_of_points() > 0) {
          EXPECT_PRECONDITION_ERROR(queries.voronoi_cell(0),
                                    "at a time that is not known to be rational a Voronoi vertex "
                                    "has no exact coordinates; call rounded_voronoi_cell");
        }
      }
      for (const Rational& t : at) {
        if (denominator(t) > 10000) continue;
        SCOPED_TRACE("time " + t.str());
        expect_right_answers(kinetic, t, random, seen);
        if (testing::Test::HasFailure()) return;
      }
      if (kinetic.step(end) == 0) break;
    }
  }
  EXPECT_GT(seen.sides_without_length, 50);
  EXPECT_GT(seen.coincidences, 10);
  EXPECT_GT(irrational, 5);
  for (const int number : seen.locations) EXPECT_GT(number, 50);
}

// ---- copies in the plane ----

// Copies in three cells on each side of the middle one, in the order of images; also at irrational
// times.
TEST(Periodic_queries_2, are_those_about_copies_in_the_plane) {
  constexpr int cells = 3;
  int irrational = 0;
  for (unsigned seed = 1; seed <= times(2); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random_choices random(seed);
    const Periodic_box_2 box = {{{16, 0}, {1, 0}, 0},
                                {{2, 16}, {1, random.integer(0, 1) * 1.0}, 0}};
    std::vector<Linear_motion_2> motions;
    for (int i = 0; i < 4; ++i) {
      const auto number = [&](int least, int greatest) {
        return static_cast<double>(random.integer(least, greatest));
      };
      motions.push_back({{number(0, 15), number(0, 15)}, {number(-9, 9), number(-9, 9)}, 0});
    }
    std::vector<Periodic_image> images;
    std::vector<Linear_motion_2> copies;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      for (int x = -cells; x <= cells; ++x) {
        for (int y = -cells; y <= cells; ++y) {
          images.push_back({static_cast<Point_id>(i), {x, y}});
          const auto at = [&](Vector_2 p, Vector_2 u, Vector_2 v) -> Vector_2 {
            return {p.x + x * u.x + y * v.x, p.y + x * u.y + y * v.y};
          };
          copies.push_back({at(motions[i].position, box.first().position, box.second().position),
                            at(motions[i].velocity, box.first().velocity, box.second().velocity),
                            0});
        }
      }
    }
    Kinetic kinetic = kinetic_of(box, motions);
    Kinetic_delaunay_triangulation_2<> plane(copies);
    constexpr int number = (2 * cells + 1) * (2 * cells + 1);
    for (int step = 0; step < 8; ++step) {
      if (kinetic.step(Time(1)) == 0) break;
      plane.advance_to(kinetic.current_time());
      if (!kinetic.current_time().is_known_rational()) ++irrational;
      const Periodic_queries_2 queries(kinetic);
      const Kinetic_queries_2 expected(plane);
      constexpr std::size_t k = 12;
      const std::vector<Periodic_image> nearest = queries.nearest_neighbors(k);
      const std::vector<Point_id> in_plane_nearest = expected.nearest_neighbors(k);
      for (Point_id id = 0; id < motions.size(); ++id) {
        const Point_id middle = id * number + number / 2;
        EXPECT_EQ(text(queries.nearest_neighbor(id)),
                  text(images[*expected.nearest_neighbor(middle)]));
        std::vector<Periodic_image> k_nearest;
        for (std::size_t i = 0; i < k; ++i) {
          k_nearest.push_back(images[in_plane_nearest[k * middle + i]]);
        }
        const auto first = nearest.begin() + static_cast<std::ptrdiff_t>(k * id);
        EXPECT_EQ(text({first, first + static_cast<std::ptrdiff_t>(k)}), text(k_nearest));
        const auto cell = queries.rounded_voronoi_cell(id);
        const auto in_plane = expected.rounded_voronoi_cell(middle);
        std::vector<Periodic_image> neighbors;
        for (const Point_id u : in_plane.neighbors) neighbors.push_back(images[u]);
        EXPECT_EQ(text(cell.neighbors), text(neighbors));
        EXPECT_EQ(cell.vertices, in_plane.vertices);
      }
      for (int i = 0; i < 10; ++i) {
        const Vector_2 place = {random.integer(0, 63) / 4.0, random.integer(0, 63) / 4.0};
        EXPECT_EQ(text(*queries.nearest_vertex(place)),
                  text(images[*expected.nearest_vertex(place)]));
        const Periodic_location_2 location = queries.locate(place);
        const Location_2 in_plane = expected.locate(place);
        EXPECT_EQ(location.kind, in_plane.kind);
        std::vector<Periodic_image> points;
        for (const Point_id u : in_plane.points) points.push_back(images[u]);
        EXPECT_EQ(text(location.points), text(points));
      }
      const std::vector<double> areas = queries.rounded_voronoi_areas();
      const std::vector<double> positions = queries.rounded_positions(true);
      for (Point_id id = 0; id < motions.size(); ++id) {
        const Vector_2 place = rounded_position(wrapped(motions[id], box, kinetic.current_time()),
                                                kinetic.current_time());
        EXPECT_EQ((Vector_2{positions[2 * id], positions[2 * id + 1]}), place);
      }
      // The area of the box increases. Each cell has at most 12 sides, a perimeter of less than
      // 128, and no position that is 32 away from the point.
      const Time& now = kinetic.current_time();
      now.refine_to_bits(128);
      Rational error = Rational(areas.size()) * 9 * 32 * 128;
      error /= Integer(1) << 53;
      Rational sum;
      for (const double area : areas) sum += to_rational(area);
      EXPECT_GE(sum + error, box.area(now.lower()));
      EXPECT_LE(sum - error, box.area(now.upper()));
    }
  }
  EXPECT_GT(irrational, 5);
}

// ---- single cases ----

TEST(Periodic_queries_2, about_one_point_in_a_square) {
  Kinetic kinetic = kinetic_of(square(4), {{{9, 1}, {1, 0}, 0}});
  const Periodic_queries_2 queries(kinetic);
  EXPECT_EQ(queries.time(), Time(0));
  EXPECT_EQ(text(queries.nearest_neighbor(0)), "0 (-1, 0)");
  EXPECT_EQ(text(queries.nearest_neighbors(5)),
            "0 (-1, 0); 0 (0, -1); 0 (0, 1); 0 (1, 0); 0 (-1, -1); ");
  EXPECT_EQ(queries.closest_pair(), (Periodic_edge{{0, 0}, {0, 1}}));
  EXPECT_EQ(text(*queries.nearest_vertex({0, 0})), "0 (-2, 0)");
  EXPECT_EQ(text(queries.locate({5, 1}).points), "0 (-1, 0); ");
  EXPECT_EQ(queries.locate({7, 1}).kind, Kind::edge);
  EXPECT_EQ(text(queries.locate({7, 1}).points), "0 (-1, 0); 0 (0, 0); ");
  EXPECT_EQ(queries.neighbors(0).size(), 6u);
  const auto cell = queries.rounded_voronoi_cell(0);
  EXPECT_EQ(text(cell.neighbors), "0 (-1, 0); 0 (0, -1); 0 (1, 0); 0 (0, 1); ");
  EXPECT_EQ(cell.vertices, (std::vector<Vector_2>{{7, -1}, {11, -1}, {11, 3}, {7, 3}}));
  EXPECT_EQ(queries.rounded_voronoi_areas(), std::vector<double>{16});
  EXPECT_EQ(queries.rounded_positions(), (std::vector<double>{9, 1}));
  EXPECT_EQ(queries.rounded_positions(true), (std::vector<double>{1, 1}));
  // On the sides at the origin, and on the other ones.
  EXPECT_EQ(Periodic_queries_2(kinetic, Time(3)).rounded_positions(true),
            (std::vector<double>{0, 1}));
}

// That is found out when the cell is asked for.
TEST(Periodic_queries_2, give_an_exact_cell_at_a_root_that_is_a_binary64_number) {
  const Kinetic kinetic = kinetic_of(square(4), {{{1, 1}, {1, 0}, 0}, {{3, 2}, {0, 1}, 0}});
  const Periodic_queries_2 queries(kinetic, Time(Polynomial{-1, 0, 1024}, 0, 1));
  ASSERT_FALSE(queries.time().is_known_rational());
  const auto cell = queries.voronoi_cell(0);
  const auto expected = Periodic_queries_2(kinetic, Time(0x1p-5)).voronoi_cell(0);
  EXPECT_EQ(text(cell.neighbors), text(expected.neighbors));
  EXPECT_TRUE(std::ranges::equal(cell.vertices, expected.vertices,
                                 [](const Exact_position_2& p, const Exact_position_2& q) {
                                   return p.x == q.x && p.y == q.y;
                                 }));
}

TEST(Periodic_queries_2, about_nothing) {
  Kinetic kinetic = kinetic_of(square(4), {});
  const Periodic_queries_2 empty(kinetic);
  EXPECT_EQ(empty.nearest_vertex({1, 1}), std::nullopt);
  EXPECT_EQ(empty.locate({1, 1}), Periodic_location_2());
  EXPECT_TRUE(empty.rounded_voronoi_areas().empty());
  EXPECT_TRUE(empty.nearest_neighbors().empty());
  EXPECT_TRUE(empty.nearest_neighbors(3).empty());
  EXPECT_EQ(empty.closest_pair(), std::nullopt);
  kinetic.insert({{1, 1}, {0, 0}, 0});
  kinetic.insert({{1, 2}, {0, 0}, 0});
  kinetic.erase(0);
  const Periodic_queries_2 queries(kinetic);
  EXPECT_TRUE(std::isnan(queries.rounded_positions()[0]));
  EXPECT_EQ(queries.rounded_positions()[3], 2);
  EXPECT_EQ(queries.nearest_neighbors()[0], Periodic_image());
  EXPECT_EQ(text(queries.nearest_neighbors(2)),
            text({Periodic_image(), Periodic_image(), {1, {-1, 0}}, {1, {0, -1}}}));
  EXPECT_EQ(queries.rounded_voronoi_areas(), (std::vector<double>{0, 16}));
}

TEST(Periodic_queries_2, throw_as_those_in_the_plane) {
  Kinetic kinetic = kinetic_of(square(4), {{{1, 1}, {1, 0}, 0}, {{3, 2}, {0, 1}, 0}});
  kinetic.advance_to(Time(Rational(1) / 16));
  EXPECT_PRECONDITION_ERROR(Periodic_queries_2(kinetic, Time(0)),
                            "a query about the past; query a time before the triangulation "
                            "advances beyond it");
  EXPECT_PRECONDITION_ERROR(Periodic_queries_2(kinetic, Time(100)),
                            "a query about a time after the next event; call advance_to for that "
                            "time first");
  const Periodic_queries_2 queries(kinetic);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_PRECONDITION_ERROR(queries.nearest_vertex({infinity, 0}),
                            "a place has a coordinate that is not finite");
  EXPECT_PRECONDITION_ERROR(queries.locate({0, std::nan("")}),
                            "a place has a coordinate that is not finite");
  EXPECT_THROW(queries.neighbors(2), Precondition_error);
  EXPECT_THROW(queries.voronoi_cell(2), Precondition_error);
  EXPECT_THROW(queries.nearest_neighbor(2), Precondition_error);
  EXPECT_PRECONDITION_ERROR(queries.nearest_neighbors(std::size_t{1} << 32),
                            "k is 4294967296; expected less than 2^32");
  for (const double far : {1e10, 1e300}) {
    EXPECT_EQ(
        test::message_of<Periodic_box_error>([&] {
          queries.locate({far, 0});
        }),
        "a position is 2^31 or more lattice vectors away from point 0; expected less: take an "
        "image of it that is closer");
  }
  kinetic.step();
  EXPECT_PRECONDITION_ERROR(queries.rounded_positions(),
                            "the triangulation has changed since these queries were made; make new "
                            "ones after an event");

  const Kinetic shrinking = kinetic_of({{{4, 0}, {-1, 0}, 0}, {{0, 4}, {0, 0}, 0}}, {});
  EXPECT_EQ(test::message_of<Periodic_box_error>([&] { Periodic_queries_2(shrinking, Time(4)); }),
            "the periodic box has no area at time 4; stop before that time, or change the rates of "
            "the lattice vectors");
}

// The quotients of these positions and the side round to the other side of 7 and of 9.
TEST(Periodic_queries_2, know_exactly_what_is_in_the_box) {
  const double side = 0.1;
  const Vector_2 place = {0.7000000000000001, 0.9};
  const Kinetic kinetic = kinetic_of(square(side), {{place, {0, 0}, 0}});
  const auto rest = [&](double x, int sides) {
    return to_double(to_rational(x) - sides * to_rational(side));
  };
  EXPECT_EQ(Periodic_queries_2(kinetic).rounded_positions(true),
            (std::vector<double>{rest(place.x, 7), rest(place.y, 8)}));
}

TEST(Periodic_queries_2, refuse_images_beyond_2_to_the_31_boxes) {
  const Kinetic kinetic = kinetic_of(square(1), {{{0, 0}, {0, 0}, 0}, {{0x1p30, 0.5}, {0, 0}, 0}});
  const Periodic_queries_2 queries(kinetic);
  EXPECT_EQ(text(*queries.nearest_vertex({5, 0.5})), "1 (-1073741819, 0)");
  EXPECT_EQ(test::message_of<Periodic_box_error>([&] {
              queries.nearest_vertex({-0x1p30, 0});
            }),
            "an image of a point is 2^31 or more lattice vectors away from the position of the "
            "point; give positions that are closer together");
}

// An image of a point that is on it for a while is another one, at the distance 0.
TEST(Periodic_queries_2, about_images_that_coincide_for_a_while) {
  const Kinetic kinetic =
      kinetic_of(square(4), {{{1, 1}, {0, 0}, 0}, {{9, 1}, {0, 0}, 0}, {{2, 1}, {0, 0}, 0}});
  const Periodic_queries_2 queries(kinetic);
  EXPECT_EQ(queries.closest_pair(), (Periodic_edge{{0, 1}, {-2, 0}}));
  EXPECT_EQ(text(queries.nearest_neighbors(3)),
            "1 (-2, 0); 2 (0, 0); 2 (-1, 0); 0 (2, 0); 2 (2, 0); 2 (1, 0); "
            "0 (0, 0); 1 (-2, 0); 0 (1, 0); ");
}

// Numbers whose products are too great for binary64.
TEST(Periodic_queries_2, about_huge_boxes_are_exact) {
  const double side = 0x1p600;
  const Kinetic kinetic = kinetic_of(square(side), {{{0, 0}, {0, 0}, 0}, {{side / 2, 0}, {}, 0}});
  const Periodic_queries_2 queries(kinetic);
  EXPECT_EQ(text(*queries.nearest_vertex({5.75 * side, 3 * side})), "0 (6, 3)");
  EXPECT_EQ(text(*queries.nearest_vertex({0x1p630, 0})), "0 (1073741824, 0)");
  EXPECT_EQ(queries.rounded_voronoi_cell(0).vertices.size(), 4u);
  EXPECT_PRECONDITION_ERROR(queries.rounded_voronoi_areas(),
                            "a Voronoi cell is so large that its area may not be a binary64 "
                            "number; give lattice vectors below 1e150");
}

}  // namespace
}  // namespace kinetri::periodic_queries_2_test
