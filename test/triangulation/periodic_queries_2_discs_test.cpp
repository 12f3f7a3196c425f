// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries about discs and points with weights in periodic boxes at rational times, compared with
// exact arithmetic over all images that are near enough.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "kinetri/triangulation/periodic_queries_2.h"
#include "support/image_pairs.h"
#include "support/periodic_runs.h"
#include "support/precondition_error.h"

namespace kinetri::periodic_queries_2_discs_test {
namespace {

using Traits = Periodic_disc_kinetic_traits_2;
using Kinetic = Kinetic_regular_triangulation_2<Traits>;
using Queries = Periodic_queries_2<Traits>;
using Time = Algebraic_number;

constexpr double end = 2;

/// A vector, exactly.
struct Place {
  Rational x;
  Rational y;

  friend Place operator-(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y}; }
  friend bool operator==(const Place& a, const Place& b) { return a.x == b.x && a.y == b.y; }
  friend bool operator<(const Place& a, const Place& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  }
};
Rational dot(const Place& a, const Place& b) {
  return a.x * b.x + a.y * b.y;
}
Rational cross(const Place& a, const Place& b) {
  return a.x * b.y - a.y * b.x;
}
Rational turn(const Place& p, const Place& q, const Place& r) {
  return cross(q - p, r - p);
}
bool is_strictly_between(const Place& p, const Place& q, const Place& r) {
  return turn(p, q, r) == 0 && dot(p - q, r - q) < 0;
}

struct Image {
  Periodic_image name;
  Place place;
  Rational weight;
};

/// All images of the discs at a time.
class Oracle {
 public:
  Oracle(const Kinetic& kinetic, const Rational& t)
      : kinetic_(kinetic), box_(kinetic.traits().box()), t_(t), time_(t.convert_to<double>()) {}

  Image image(const Periodic_image& name) const {
    const Disc_motion_2& disc = kinetic_.motion(name.id);
    const auto there = test::place_at(center(image_of(disc, name.offset, &box_)), t_);
    return {name, {there.x(), there.y()}, test::weight_at(disc, t_)};
  }
  Image given(Point_id id) const { return image({id, {}}); }
  std::vector<Point_id> ids() const {
    std::vector<Point_id> result;
    for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
      if (kinetic_.contains(id)) result.push_back(id);
    }
    return result;
  }

  /// All images that are not farther from a place than half the sum of two vectors of the lattice,
  /// times `factor`. Among them are those of least power at the place, since no one is farther than
  /// the nearest one of the heaviest point.
  std::vector<Image> images_near(const Place& place, double factor = 1) const {
    const Vector_2 a = rounded_place(box_.first(), time_);
    const Vector_2 b = rounded_place(box_.second(), time_);
    const double sum = std::hypot(a.x, a.y) + std::hypot(b.x, b.y);
    const double reach = factor * 0.501 * sum + 0.01;
    const double area = test::rounded_area(box_, time_);
    const double x = place.x.convert_to<double>();
    const double y = place.y.convert_to<double>();
    std::vector<Image> result;
    for (const Point_id id : ids()) {
      const Vector_2 p = rounded_place(kinetic_.motion(id), time_);
      const Vector_2 d = {x - p.x, y - p.y};
      const auto k0 = std::lround((d.x * b.y - d.y * b.x) / area);
      const auto l0 = std::lround((a.x * d.y - a.y * d.x) / area);
      const auto most = static_cast<long>(reach * sum / area) + 1;
      for (long k = k0 - most; k <= k0 + most; ++k) {
        for (long l = l0 - most; l <= l0 + most; ++l) {
          const double away_x = d.x - double(k) * a.x - double(l) * b.x;
          const double away_y = d.y - double(k) * a.y - double(l) * b.y;
          if (std::hypot(away_x, away_y) > reach) continue;
          result.push_back(
              image({id, {static_cast<std::int32_t>(k), static_cast<std::int32_t>(l)}}));
        }
      }
    }
    return result;
  }

  /// Of least power at a place. Precondition: there is a point.
  Image nearest(const Place& place) const {
    std::optional<std::pair<Rational, Image>> best;
    for (const Image& u : images_near(place)) {
      const Place d = place - u.place;
      const Rational power = dot(d, d) - u.weight;
      if (!best || std::tie(power, u.name) < std::tie(best->first, best->second.name)) {
        best = {power, u};
      }
    }
    return best->second;
  }

  /// The corners of the power cell, from the position of the point, counterclockwise; perhaps some
  /// several times if it has no area.
  std::vector<Place> cell(Point_id id) const {
    const Image p = given(id);
    constexpr int far = 1000;
    std::vector<Place> polygon = {{-far, -far}, {far, -far}, {far, far}, {-far, far}};
    for (const Image& u : images_near(p.place, 2)) cut(polygon, p, u);
    // Until the point has the least power at all corners.
    for (bool is_cut = true; is_cut;) {
      is_cut = false;
      for (const Place& v : std::vector(polygon)) {
        const Image u = nearest({p.place.x + v.x, p.place.y + v.y});
        if (beyond(p, u, v) <= 0) continue;
        cut(polygon, p, u);
        is_cut = true;
      }
    }
    return polygon;
  }
  /// By how much more power a position, from that of p, has to p than to u.
  static Rational beyond(const Image& p, const Image& u, const Place& v) {
    const Place d = u.place - p.place;
    return 2 * dot(v, d) - dot(d, d) - p.weight + u.weight;
  }
  /// Whether the two have one position, modulo the lattice, and one weight.
  bool are_alike(Point_id a, Point_id b) const {
    const Image p = given(a);
    return std::ranges::any_of(images_near(p.place), [&](const Image& u) {
      return u.name.id == b && u.place == p.place && u.weight == p.weight;
    });
  }

 private:
  static void cut(std::vector<Place>& polygon, const Image& p, const Image& u) {
    std::vector<Rational> values;
    for (const Place& v : polygon) values.push_back(beyond(p, u, v));
    if (std::ranges::all_of(values, [](const Rational& value) { return value <= 0; })) return;
    std::vector<Place> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t k = (i + 1) % polygon.size();
      if (values[i] <= 0) left.push_back(polygon[i]);
      if (!(values[i] * values[k] < 0)) continue;
      const Rational part = values[i] / (values[i] - values[k]);
      const Place d = polygon[k] - polygon[i];
      left.push_back({polygon[i].x + part * d.x, polygon[i].y + part * d.y});
    }
    polygon = std::move(left);
  }

  const Kinetic& kinetic_;
  const Periodic_box_2& box_;
  Rational t_;
  double time_;
};

/// What cases there were.
struct Seen {
  std::size_t hidden = 0;
  std::size_t empty = 0;
  std::size_t without_area = 0;
  std::size_t outside = 0;  // cells that do not contain their points
  std::array<std::size_t, 3> locations = {};
};

double rounded(const Rational& x) {
  return Time(x).to_double();
}

void expect_cell(const Queries& queries, const Oracle& oracle, Point_id id, Seen& seen) {
  const std::vector<Place> corners = oracle.cell(id);
  const std::set<Place> distinct(corners.begin(), corners.end());
  const Image p = oracle.given(id);
  const auto cell = queries.voronoi_cell(id);
  EXPECT_EQ(cell.is_empty, corners.empty());
  std::set<Place> found;
  std::vector<Place> vertices;
  for (const Exact_position_2& v : cell.vertices) {
    vertices.push_back(Place{v.x, v.y} - p.place);
    found.insert(vertices.back());
  }
  EXPECT_EQ(found, distinct);
  EXPECT_EQ(found.size(), vertices.size());
  ASSERT_EQ(cell.neighbors.size(), vertices.size() > 1 ? vertices.size() : 0);
  for (std::size_t i = 0; i < cell.neighbors.size(); ++i) {
    const Image u = oracle.image(cell.neighbors[i]);
    const std::size_t before = (i + vertices.size() - 1) % vertices.size();
    EXPECT_EQ(Oracle::beyond(p, u, vertices[i]), 0);
    EXPECT_EQ(Oracle::beyond(p, u, vertices[before]), 0);
    const auto distance = [&](const Image& image) {
      const Place d = image.place - p.place;
      return std::pair(dot(d, d), image.name);
    };
    EXPECT_FALSE(distance(u) < distance(oracle.image(cell.neighbors[0])));
  }
  const auto rounded_cell = queries.rounded_voronoi_cell(id);
  EXPECT_EQ(rounded_cell.neighbors, cell.neighbors);
  EXPECT_EQ(rounded_cell.is_empty, cell.is_empty);
  ASSERT_EQ(rounded_cell.vertices.size(), cell.vertices.size());
  for (std::size_t i = 0; i < cell.vertices.size(); ++i) {
    EXPECT_EQ(rounded_cell.vertices[i].x, rounded(cell.vertices[i].x));
    EXPECT_EQ(rounded_cell.vertices[i].y, rounded(cell.vertices[i].y));
  }
  seen.empty += cell.is_empty;
  seen.without_area += !cell.is_empty && vertices.size() < 3;
  for (std::size_t i = 0; i < cell.neighbors.size(); ++i) {
    if (Oracle::beyond(p, oracle.image(cell.neighbors[i]), {0, 0}) > 0) {
      ++seen.outside;
      break;
    }
  }
}

// The exact areas, and those of Periodic_queries_2 within their bounds.
void expect_areas(const Kinetic& kinetic, const Queries& queries, const Oracle& oracle) {
  const std::vector<double> areas = queries.rounded_voronoi_areas();
  ASSERT_EQ(areas.size(), kinetic.next_id());
  for (const Point_id id : oracle.ids()) {
    Point_id first = id;
    for (const Point_id other : oracle.ids()) {
      if (other < first && oracle.are_alike(id, other)) first = other;
    }
    const std::vector<Point_id> sharing = kinetic.coincident_points(first);
    if (id != first && std::ranges::find(sharing, id) == sharing.end()) {
      EXPECT_EQ(areas[id], 0);
      continue;
    }
    const std::vector<Place> corners = oracle.cell(id);
    Rational area = 0;
    double radius = 0;
    double perimeter = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Place& v = corners[i];
      const Place d = corners[(i + 1) % corners.size()] - v;
      area += cross(v, corners[(i + 1) % corners.size()]) / 2;
      radius = std::max(radius, std::sqrt(Rational(dot(v, v)).convert_to<double>()));
      perimeter += std::sqrt(Rational(dot(d, d)).convert_to<double>());
    }
    const auto share = static_cast<double>(1 + sharing.size());
    EXPECT_NEAR(areas[id], area.convert_to<double>() / share,
                (8 + double(corners.size()) / 2) * 0x1p-53 * radius * perimeter);
  }
}

void expect_neighbors(const Kinetic& kinetic, const Queries& queries, Point_id id) {
  const std::vector<Periodic_image> neighbors = queries.neighbors(id);
  const std::vector<Point_id> coincident = kinetic.coincident_points(id);
  if (kinetic.is_hidden(id)) {
    const bool is_by_triangle = coincident.empty() || id < coincident.front();
    ASSERT_EQ(neighbors.size(), is_by_triangle ? coincident.size() : 1);
    return;
  }
  std::multiset<Periodic_image> expected;
  for (const Periodic_edge& edge : kinetic.periodic_edges()) {
    if (edge.ids[0] == id) expected.insert({edge.ids[1], edge.offset});
    if (edge.ids[1] == id) expected.insert({edge.ids[0], {-edge.offset.x, -edge.offset.y}});
  }
  ASSERT_EQ(neighbors.size(), expected.size() + coincident.size());
  const auto degree = static_cast<std::ptrdiff_t>(expected.size());
  EXPECT_EQ(std::multiset<Periodic_image>(neighbors.begin(), neighbors.begin() + degree), expected);
}

void expect_location(const Kinetic& kinetic, const Queries& queries, const Oracle& oracle,
                     const Vector_2& query, Seen& seen) {
  const Periodic_location_2 location = queries.locate(query);
  const Place q = {to_rational(query.x), to_rational(query.y)};
  std::vector<Image> corners;
  for (const Periodic_image& name : location.points) corners.push_back(oracle.image(name));
  // All that may be between the ends of an edge.
  std::vector<Image> visible = oracle.images_near(q, 2);
  std::erase_if(visible, [&](const Image& u) { return kinetic.is_hidden(u.name.id); });
  std::optional<Periodic_image> at;
  for (const Image& u : visible) {
    if (u.place == q && (!at || u.name < *at)) at = u.name;
  }
  using Kind = Location_2::Kind;
  ASSERT_NE(location.kind, Kind::outside_convex_hull);
  ++seen.locations[static_cast<std::size_t>(location.kind)];
  ASSERT_EQ(location.kind == Kind::vertex, at.has_value());
  if (location.kind == Kind::vertex) {
    EXPECT_EQ(location.points, std::vector{*at});
  } else if (location.kind == Kind::edge) {
    const auto [a, b] = std::pair(corners[0], corners[1]);
    EXPECT_LT(a.name, b.name);
    EXPECT_TRUE(is_strictly_between(a.place, q, b.place));
    EXPECT_TRUE(std::ranges::none_of(visible, [&a = a, &b = b](const Image& u) {
      return is_strictly_between(a.place, u.place, b.place);
    }));
  } else {
    std::array<test::Image, 3> face;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GT(turn(corners[i].place, corners[(i + 1) % 3].place, q), 0);
      face[i] = {corners[i].name.id, corners[i].name.offset.x, corners[i].name.offset.y};
    }
    const auto faces = test::faces_of(kinetic);
    EXPECT_NE(std::ranges::find(faces, test::normal_form(face)), faces.end());
  }
}

void expect_right_answers(const Kinetic& kinetic, const Rational& t, std::mt19937& random,
                          Seen& seen) {
  SCOPED_TRACE("at " + std::to_string(t.convert_to<double>()));
  const Queries queries(kinetic, Time(t));
  const Oracle oracle(kinetic, t);
  const std::vector<double> positions = queries.rounded_positions();
  for (const Point_id id : oracle.ids()) {
    SCOPED_TRACE("point " + std::to_string(id));
    seen.hidden += kinetic.is_hidden(id);
    expect_cell(queries, oracle, id, seen);
    expect_neighbors(kinetic, queries, id);
    EXPECT_EQ(positions[2 * std::size_t{id}], rounded(oracle.given(id).place.x));
  }
  expect_areas(kinetic, queries, oracle);
  for (int i = 0; i < 4; ++i) {
    const auto coordinate = [&] { return double(int(random() % 33) - 16) / 2; };
    const double x = coordinate();
    Vector_2 query = {x, coordinate()};
    if (i == 0) query = rounded_place(kinetic.motion(oracle.ids()[0]), t.convert_to<double>());
    SCOPED_TRACE("query " + std::to_string(query.x) + ", " + std::to_string(query.y));
    EXPECT_EQ(queries.nearest_vertex(query),
              oracle.nearest({to_rational(query.x), to_rational(query.y)}).name);
    expect_location(kinetic, queries, oracle, query, seen);
  }
}

std::vector<Disc_motion_2> random_discs(std::mt19937& random, std::size_t number, unsigned kind) {
  const auto integer = [&](int least, int most) {
    return double(least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1)));
  };
  std::vector<Disc_motion_2> result;
  while (result.size() < number) {
    const double x = integer(-5, 5);
    const double y = integer(-5, 5);
    const double vx = integer(-2, 2);
    const double vy = integer(-2, 2);
    const double radius = integer(0, 3);
    const double growth = kind == 1 ? integer(-1, 1) : 0;
    const double weight = kind == 2 ? integer(-8, 8) : 0;
    result.push_back({{{x, y}, {vx, vy}, 0}, radius, growth, weight});
    if (result.size() > 1 && integer(0, 5) == 0) result.back() = result.front();
  }
  return result;
}

TEST(Periodic_queries_2_of_discs, are_those_of_an_oracle_at_rational_times) {
  Seen seen;
  for (unsigned seed = 0; seed < test::cases(60u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto box = test::random_periodic_box(
        random, static_cast<int>(seed % test::periodic_box_kinds), seed % 3 == 0 ? 3 : 5, end);
    Kinetic kinetic(random_discs(random, 1 + seed / 4 % 5, seed % 3), Time(0), Traits(box));
    for (int i = 0; i < 3; ++i) {
      const double now = kinetic.current_time().to_double();
      if (kinetic.current_time() == Time(now)) {
        expect_right_answers(kinetic, to_rational(now), random, seen);
      }
      // At the time of an event, before it, and after it.
      const auto next = kinetic.next_event_time();
      if (next && *next <= Time(end)) {
        next->tight_interval();
        if (next->is_known_rational()) {
          expect_right_answers(kinetic, next->rational(), random, seen);
        }
        kinetic.advance_to(*next);
      }
      if (testing::Test::HasFailure()) return;
      const double later = std::floor(4 * kinetic.current_time().to_double() + 1) / 4;
      if (later > end) break;
      kinetic.advance_to(later);
    }
  }
  EXPECT_GT(seen.hidden, 60U);
  EXPECT_GT(seen.empty, 60U);
  EXPECT_GT(seen.without_area, 0U);
  EXPECT_GT(seen.outside, 10U);
  for (const std::size_t number : seen.locations) EXPECT_GT(number, 20U);
}

// The position is in the large disc, and nearer to the center of the small one.
TEST(Periodic_queries_2_of_discs, find_the_disc_at_a_place) {
  const Kinetic kinetic({{{{1, 5}, {0, 0}, 0}, 3, 0, 0}, {{{6, 5}, {0, 0}, 0}, 0.5, 0, 0}}, Time(0),
                        Traits(test::square(10)));
  const Periodic_queries_2 queries(kinetic);
  EXPECT_EQ(queries.nearest_vertex({3.75, 5}), (Periodic_image{0, {0, 0}}));
  EXPECT_EQ(queries.nearest_vertex({-2, 5}), (Periodic_image{0, {0, 0}}));
  EXPECT_EQ(queries.nearest_vertex({16, 5}), (Periodic_image{1, {1, 0}}));
}

// Four images of the large disc, or two lines of them, leave one position to the small one, or a
// segment; another one, of a little less weight, has none.
TEST(Periodic_queries_2_of_discs, have_cells_without_area) {
  const auto kinetic_of = [](const Periodic_box_2& box, const Disc_motion_2& large,
                             const Disc_motion_2& small) {
    return Kinetic({large, small}, Time(0), Traits(box));
  };
  const Kinetic four = kinetic_of(test::square(10), {{{0, 0}, {0, 0}, 0}, 7.5, 0, 0},
                                  {{{5, 5}, {0, 0}, 0}, 2.5, 0, 0});
  const auto position = Queries(four).voronoi_cell(1);
  EXPECT_FALSE(position.is_empty);
  EXPECT_TRUE(position.neighbors.empty());
  ASSERT_EQ(position.vertices.size(), 1U);
  EXPECT_EQ(position.vertices[0].x, 5);
  EXPECT_EQ(position.vertices[0].y, 5);

  const Periodic_box_2 low({{10, 0}, {0, 0}, 0}, {{0, 4}, {0, 0}, 0});
  const Kinetic lines =
      kinetic_of(low, {{{0, 0}, {0, 0}, 0}, 5, 0, 0}, {{{5, 0}, {0, 0}, 0}, 0, 0, 0});
  const auto segment = Queries(lines).rounded_voronoi_cell(1);
  EXPECT_EQ(segment.vertices, (std::vector<Vector_2>{{5, -2}, {5, 2}}));
  EXPECT_EQ(segment.neighbors, (std::vector<Periodic_image>{{0, {0, 0}}, {0, {1, 0}}}));
  EXPECT_EQ(Queries(lines).rounded_voronoi_areas(), (std::vector<double>{40, 0}));

  const Kinetic less =
      kinetic_of(low, {{{0, 0}, {0, 0}, 0}, 5, 0, 0}, {{{5, 0}, {0, 0}, 0}, 0, 0, -1});
  EXPECT_TRUE(Queries(less).voronoi_cell(1).is_empty);
}

TEST(Periodic_queries_2_of_discs, are_refused_when_another_triangle_hides_a_disc) {
  Kinetic kinetic({{{{0, 0}, {0, 0}, 0}, 3, 0, 0},
                   {{{5, 0}, {0, 0}, 0}, 3, 0, 0},
                   {{{0, 5}, {0, 0}, 0}, 3, 0, 0},
                   {{{0.5, 0.25}, {0, -1}, 0}, 0.5, 0, 0}},
                  Time(0), Traits(test::square(10)));
  ASSERT_TRUE(kinetic.is_hidden(3));
  const Queries queries(kinetic);
  EXPECT_TRUE(queries.voronoi_cell(3).is_empty);
  ASSERT_EQ(kinetic.advance_to(0.5), 0U);
  ASSERT_TRUE(kinetic.is_hidden(3));
  EXPECT_PRECONDITION_ERROR(queries.neighbors(0),
                            "the triangulation has changed since these queries were made; make new "
                            "ones after an event");
}

}  // namespace
}  // namespace kinetri::periodic_queries_2_discs_test
