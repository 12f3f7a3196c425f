// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/field_2.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_set>
#include <utility>

#include "kinetri/algebra/rounded_quotient.h"
#include "kinetri/base/check.h"
#include "kinetri/kinetic/rounded_places.h"
#include "kinetri/triangulation/detail/ball.h"
#include "kinetri/triangulation/detail/incident.h"
#include "kinetri/triangulation/queries_2.h"
#include "triangulation/field_weights.h"

namespace kinetri {
namespace {

// Beyond it differences of coordinates might overflow.
constexpr double largest_coordinate = 1e300;
constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

double rounded_value(const Linear_value& v, double t) {
  return v.value + v.slope * (t - v.epoch);
}

bool has_finite_numbers(const Linear_value& v) {
  return std::isfinite(v.value) && std::isfinite(v.slope) && std::isfinite(v.epoch);
}

void check_place(const Vector_2& place) {
  KINETRI_PRECONDITION(detail::size_of(place) <= largest_coordinate,
                       "a position has a coordinate that is not finite or beyond 1e300");
}

// Indices from `first` up to, not including, `last`.
struct Index_range {
  std::size_t first = 0;
  std::size_t last = 0;
};

// The indices at which origin + index * step may be in [lower, upper]. May name more; never fewer:
// the computed index is off by the roundings of the quotient and of the places.
Index_range indices_between(double lower, double upper, double origin, double step,
                            std::size_t count) {
  double from = (lower - origin) / step;
  double to = (upper - origin) / step;
  if (from > to) std::swap(from, to);
  const double size = std::abs(origin) + std::max(std::abs(lower), std::abs(upper));
  const double slack = 1 + 0x1p-48 * (size / std::abs(step) + static_cast<double>(count));
  const double n = static_cast<double>(count);
  const double first = std::clamp(std::floor(from - slack), 0.0, n);
  const double last = std::clamp(std::floor(to + slack) + 1, 0.0, n);
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

// The triangulation at its current time, as a field sees it.
template <class Traits>
class Present {
 public:
  using Kinetic = Kinetic_triangulation_2<Traits>;
  using Topology = typename Kinetic::Triangulation;
  using Face_handle = typename Kinetic::Face_handle;
  using Vertex_handle = typename Kinetic::Vertex_handle;
  using Point_2 = typename Traits::Point_2;

  explicit Present(const Kinetic& kinetic)
      : kinetic_(kinetic),
        time_(detail::ball_of(kinetic.current_time())),
        at_(kinetic.traits().instantaneous_traits({kinetic.current_time(), Time_side::at})),
        after_(kinetic.traits().instantaneous_traits({kinetic.current_time(), Time_side::after})) {}

  // Rounds the places of all points, so that most signs need no exact arithmetic.
  void round_all() {
    places_.resize(kinetic_.next_id());
    for (const Vertex_handle v : topology().finite_vertex_handles()) {
      const Vector_2 p = rounded(v);
      places_[id(v)] = p;
      error_ = std::max(error_, 0x1p-53 * detail::size_of(p));
    }
    error_ += std::numeric_limits<double>::denorm_min();
  }

  // The error of each coordinate, at most. After round_all.
  double error() const { return error_; }

  const Topology& topology() const { return kinetic_.triangulation(); }
  static Point_id id(Vertex_handle v) { return v->point().id(); }

  // Each coordinate is the nearest binary64 number.
  Vector_2 place(Vertex_handle v) const { return places_.empty() ? rounded(v) : places_[id(v)]; }

  // The ids of the corners in ascending order.
  static std::array<Point_id, 3> ids(Face_handle face) {
    std::array<Point_id, 3> result = {id(face->vertex(0)), id(face->vertex(1)),
                                      id(face->vertex(2))};
    std::ranges::sort(result);
    return result;
  }

  static Point_2 query(const Vector_2& place) {
    typename Traits::Motion motion{};
    motion.position = place;
    return Point_2(motion, no_point);
  }

  bool has_area(Face_handle face) const {
    if (!places_.empty() &&
        detail::certain_orientation(place(face->vertex(0)), place(face->vertex(1)),
                                    place(face->vertex(2)), error_) == CGAL::POSITIVE) {
      return true;
    }
    return at_.orientation_2_object()(face->vertex(0)->point(), face->vertex(1)->point(),
                                      face->vertex(2)->point()) == CGAL::LEFT_TURN;
  }

  // Whether the position is in the triangle or on its boundary. Precondition: has_area(face).
  bool contains(Face_handle face, const Vector_2& position) const {
    for (int i = 0; i < 3; ++i) {
      if (turn(face, i, position) == CGAL::NEGATIVE) return false;
    }
    return true;
  }

  // The triangle of the position; none if it has none.
  Face_handle triangle_at(const Vector_2& position) const {
    if (topology().dimension() < 2) return Face_handle();
    const Location_2 location = Kinetic_queries_2(kinetic_).locate(position);
    if (location.kind == Location_2::Kind::outside_convex_hull) return Face_handle();
    Face_handle start;
    detail::for_each_face_at(
        topology(), kinetic_.vertex(location.points.front()), [&](Face_handle face) {
          if (topology().is_infinite(face)) return;
          const auto corners = ids(face);
          const auto is_corner = [&](Point_id p) { return std::ranges::count(corners, p) != 0; };
          if (std::ranges::all_of(location.points, is_corner)) start = face;
        });
    return least_around(start, position);
  }

  // The natural neighbors of a position, counterclockwise, from its triangle on.
  void find_neighbors(Face_handle triangle, const Vector_2& position,
                      std::vector<Vertex_handle>& result) {
    result.clear();
    stack_.clear();
    for (int i = 2; i >= 0; --i) stack_.emplace_back(triangle, i);
    while (!stack_.empty()) {
      const auto [face, i] = stack_.back();
      stack_.pop_back();
      const Face_handle next = face->neighbor(i);
      if (!topology().is_infinite(next) && is_in_circle(next, position)) {
        const int j = next->index(face);
        stack_.emplace_back(next, Topology::cw(j));
        stack_.emplace_back(next, Topology::ccw(j));
      } else {
        result.push_back(face->vertex(Topology::ccw(i)));
      }
    }
  }

 private:
  Vector_2 rounded(Vertex_handle v) const {
    const detail::Ball_2 ball = detail::ball_place(v->point().motion(), time_);
    const auto coordinate = [&](const detail::Ball& known, Polynomial Trajectory_2::*axis) {
      if (const auto value = known.rounded()) return *value;
      const Trajectory_2 path = v->point().trajectory();
      return rounded_quotient(path.*axis, path.w, kinetic_.current_time());
    };
    const Vector_2 result = {coordinate(ball.x, &Trajectory_2::x),
                             coordinate(ball.y, &Trajectory_2::y)};
    KINETRI_PRECONDITION(
        detail::size_of(result) <= largest_coordinate,
        "point " + std::to_string(id(v)) + " has a coordinate beyond 1e300 at the current time");
    return result;
  }

  // On which side of the edge opposite corner i the position is: positive inside.
  Sign turn(Face_handle face, int i, const Vector_2& position) const {
    const Vertex_handle p = face->vertex(Topology::ccw(i));
    const Vertex_handle q = face->vertex(Topology::cw(i));
    if (!places_.empty()) {
      const Sign sign = detail::certain_orientation(place(p), place(q), position, error_);
      if (sign != CGAL::ZERO) return sign;
    }
    return at_.orientation_2_object()(p->point(), q->point(), query(position));
  }

  // What is certainly so at the time is so just after it.
  bool is_in_circle(Face_handle face, const Vector_2& position) const {
    const Vertex_handle p = face->vertex(0);
    const Vertex_handle q = face->vertex(1);
    const Vertex_handle r = face->vertex(2);
    if (!places_.empty()) {
      const Sign sign =
          detail::certain_side_of_oriented_circle(place(p), place(q), place(r), position, error_);
      if (sign != CGAL::ZERO) return sign == CGAL::POSITIVE;
    }
    return after_.side_of_oriented_circle_2_object()(p->point(), q->point(), r->point(),
                                                     query(position)) == CGAL::ON_POSITIVE_SIDE;
  }

  bool is_on_closed_edge(Face_handle face, int i, const Vector_2& position) const {
    if (turn(face, i, position) != CGAL::ZERO) return false;
    const Point_2& p = face->vertex(Topology::ccw(i))->point();
    const Point_2& q = face->vertex(Topology::cw(i))->point();
    const Point_2 here = query(position);
    const auto compare = at_.compare_xy_2_object();
    // In the order of one line.
    const auto from_p = compare(p, here);
    const auto to_q = compare(here, q);
    return from_p == CGAL::EQUAL || to_q == CGAL::EQUAL || from_p == to_q;
  }

  // Of the triangles with an area that contain the position, the one with the least ids; `start`
  // contains it. They are connected across edges that contain it (docs/MATH.md, section 10).
  Face_handle least_around(Face_handle start, const Vector_2& position) const {
    std::vector<Face_handle> faces = {start};
    std::unordered_set<Face_handle> seen = {start};
    Face_handle least;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const Face_handle face = faces[k];
      if (has_area(face) && (least == Face_handle() || ids(face) < ids(least))) least = face;
      for (int i = 0; i < 3; ++i) {
        const Face_handle next = face->neighbor(i);
        if (topology().is_infinite(next) || seen.contains(next)) continue;
        if (!is_on_closed_edge(face, i, position)) continue;
        seen.insert(next);
        faces.push_back(next);
      }
    }
    return least;
  }

  const Kinetic& kinetic_;
  detail::Ball time_;
  typename Kinetic::Instantaneous_traits at_;
  typename Kinetic::Instantaneous_traits after_;
  std::vector<Vector_2> places_;  // by id; empty before round_all
  double error_ = 0;
  std::vector<std::pair<Face_handle, int>> stack_;  // edges of find_neighbors
};

// Points and their weights at a position.
template <class Traits>
class Combination {
 public:
  using Vertex_handle = typename Present<Traits>::Vertex_handle;

  // For a position and its triangle.
  void find(Present<Traits>& present, typename Present<Traits>::Face_handle triangle,
            const Vector_2& position, Interpolation interpolation) {
    vertices_ = {triangle->vertex(0), triangle->vertex(1), triangle->vertex(2)};
    begin_with_least_id();
    if (interpolation == Interpolation::flat) {
      weights_.assign(3, 1.0 / 3);
      return;
    }
    const std::array<Vector_2, 3> corners = {
        present.place(vertices_[0]), present.place(vertices_[1]), present.place(vertices_[2])};
    if (interpolation == Interpolation::smooth &&
        std::ranges::find(corners, position) == corners.end()) {
      return find_smooth(present, triangle, position);
    }
    const std::array<double, 3> weights = detail::barycentric_weights(corners, position);
    weights_.assign(weights.begin(), weights.end());
  }

  const std::vector<Vertex_handle>& vertices() const { return vertices_; }
  const std::vector<double>& weights() const { return weights_; }

 private:
  // The order of vertices within faces must not matter.
  void begin_with_least_id() {
    const auto least = std::ranges::min_element(
        vertices_, {}, [](Vertex_handle v) { return Present<Traits>::id(v); });
    std::rotate(vertices_.begin(), least, vertices_.end());
  }

  void find_smooth(Present<Traits>& present, typename Present<Traits>::Face_handle triangle,
                   const Vector_2& position) {
    present.find_neighbors(triangle, position, vertices_);
    begin_with_least_id();
    // Of neighbors at one rounded place, which share one side of the cell, the first stands for
    // all.
    places_.clear();
    std::size_t kept = 0;
    for (const Vertex_handle v : vertices_) {
      const Vector_2 place = present.place(v);
      if (std::ranges::find(places_, place) != places_.end()) continue;
      places_.push_back(place);
      vertices_[kept++] = v;
    }
    vertices_.resize(kept);
    weights_.resize(kept);
    if (kept == 1) {
      weights_[0] = 1;
    } else {
      detail::laplace_weights(places_, position, weights_);
    }
  }

  std::vector<Vertex_handle> vertices_;
  std::vector<double> weights_;
  std::vector<Vector_2> places_;
};

// The positions of a grid, and the triangle of each.
template <class Traits>
class Raster {
 public:
  using Face_handle = typename Present<Traits>::Face_handle;

  // Keeps a reference to `present`, in which all places are rounded.
  Raster(const Present<Traits>& present, const Grid_2& grid)
      : present_(present), grid_(grid), triangle_(grid.rows * grid.columns, no_triangle) {
    if (present_.topology().dimension() < 2) return;
    for (const Face_handle face : present_.topology().finite_face_handles()) {
      faces_.push_back(face);
    }
    std::ranges::sort(faces_, {}, [](Face_handle face) { return Present<Traits>::ids(face); });
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      if (present_.has_area(faces_[i])) fill(i);
    }
  }

  // The triangle of a position; none if it has none.
  Face_handle triangle(std::size_t column, std::size_t row) const {
    const std::uint32_t i = triangle_[row * grid_.columns + column];
    return i == no_triangle ? Face_handle() : faces_[i];
  }

 private:
  // The triangles come in ascending order of ids, so that the first one that contains a position
  // is the position's.
  void fill(std::uint32_t index) {
    const Face_handle face = faces_[index];
    const std::array<Vector_2, 3> p = {present_.place(face->vertex(0)),
                                       present_.place(face->vertex(1)),
                                       present_.place(face->vertex(2))};
    const double e = present_.error();
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    const Index_range rows =
        indices_between(low - 2 * e, high + 2 * e, grid_.origin.y, grid_.step.y, grid_.rows);
    for (std::size_t row = rows.first; row < rows.last; ++row) {
      const Index_range columns = columns_in(p, grid_.place(0, row).y);
      for (std::size_t column = columns.first; column < columns.last; ++column) {
        std::uint32_t& found = triangle_[row * grid_.columns + column];
        if (found == no_triangle && present_.contains(face, grid_.place(column, row))) {
          found = index;
        }
      }
    }
  }

  // The columns that may be in the triangle with rounded corners p, at height y. An edge pq meets
  // it at p + s (q - p), and s is off by at most 8 e / |q.y - p.y| where each coordinate and
  // difference is off by at most e: by six roundings and errors of that size.
  Index_range columns_in(const std::array<Vector_2, 3>& p, double y) const {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector_2& a = p[i];
      const Vector_2& b = p[(i + 1) % 3];
      const double size = std::max(std::max(detail::size_of(a), detail::size_of(b)), std::abs(y));
      const double e = present_.error() + 0x1p-50 * size;
      if (y < std::min(a.y, b.y) - e || y > std::max(a.y, b.y) + e) continue;
      const double height = std::abs(b.y - a.y);
      if (height <= 8 * e) {
        left = std::min(left, std::min(a.x, b.x) - 4 * e);
        right = std::max(right, std::max(a.x, b.x) + 4 * e);
      } else {
        const double width = b.x - a.x;
        const double x = a.x + (y - a.y) / (b.y - a.y) * width;
        const double slack = std::abs(width) * (8 * e / height) + 4 * e;
        left = std::min(left, x - slack);
        right = std::max(right, x + slack);
      }
    }
    if (left > right) return {};
    return indices_between(left, right, grid_.origin.x, grid_.step.x, grid_.columns);
  }

  const Present<Traits>& present_;
  const Grid_2& grid_;
  std::vector<Face_handle> faces_;
  std::vector<std::uint32_t> triangle_;  // by position; an index of faces_
};

}  // namespace

Vector_2 Grid_2::place(std::size_t column, std::size_t row) const {
  return {origin.x + static_cast<double>(column) * step.x,
          origin.y + static_cast<double>(row) * step.y};
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>) Kinetic_field_2<Traits>::Kinetic_field_2(
    const Triangulation& triangulation, std::size_t channels)
    : triangulation_(triangulation), channels_(channels) {
  KINETRI_PRECONDITION(channels > 0, "a field needs at least one channel");
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>) void Kinetic_field_2<Traits>::set_values(
    Point_id id, std::span<const Linear_value> values) {
  KINETRI_PRECONDITION(triangulation_.contains(id), "there is no point " + std::to_string(id));
  KINETRI_PRECONDITION(values.size() == channels_, "point " + std::to_string(id) + " is given " +
                                                       std::to_string(values.size()) +
                                                       " values; the field has " +
                                                       std::to_string(channels_) + " channels");
  KINETRI_PRECONDITION(std::ranges::all_of(values, has_finite_numbers),
                       "a value of point " + std::to_string(id) + " is not finite");
  if (is_set_.size() <= id) {
    is_set_.resize(triangulation_.next_id());
    values_.resize(is_set_.size() * channels_);
  }
  std::ranges::copy(values, values_.begin() + static_cast<std::ptrdiff_t>(id * channels_));
  is_set_[id] = true;
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>)
    std::span<const Linear_value> Kinetic_field_2<Traits>::values(Point_id id)
const {
  if (id >= is_set_.size() || !is_set_[id]) return {};
  return std::span(values_).subspan(id * channels_, channels_);
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>)
    std::optional<std::vector<double>> Kinetic_field_2<Traits>::at(const Vector_2& place,
                                                                   Interpolation interpolation)
const {
  check_place(place);
  Present<Traits> present(triangulation_);
  const auto triangle = present.triangle_at(place);
  if (triangle == typename Triangulation::Face_handle()) return std::nullopt;
  Combination<Traits> combination;
  combination.find(present, triangle, place, interpolation);
  const double time = triangulation_.current_time().to_double();
  std::vector<double> result(channels_);
  std::vector<double> at_points(combination.vertices().size());
  for (std::size_t channel = 0; channel < channels_; ++channel) {
    for (std::size_t i = 0; i < at_points.size(); ++i) {
      const Point_id id = Present<Traits>::id(combination.vertices()[i]);
      const std::span<const Linear_value> of_point = values(id);
      KINETRI_PRECONDITION(!of_point.empty(), "point " + std::to_string(id) + " has no values");
      at_points[i] = rounded_value(of_point[channel], time);
    }
    result[channel] = detail::weighted_mean(at_points, combination.weights());
  }
  return result;
}

template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>) void Kinetic_field_2<Traits>::raster(
    const Grid_2& grid, Interpolation interpolation, std::span<double> result) const {
  const auto is_step = [](double step) { return std::isfinite(step) && step != 0; };
  KINETRI_PRECONDITION(is_step(grid.step.x) && is_step(grid.step.y),
                       "a step of a grid is zero or not finite");
  const std::size_t most = std::numeric_limits<std::size_t>::max() / channels_;
  KINETRI_PRECONDITION(grid.columns == 0 || grid.rows <= most / grid.columns,
                       "a grid has too many positions");
  const std::size_t size = grid.rows * grid.columns;
  KINETRI_PRECONDITION(result.size() == size * channels_,
                       "the result has " + std::to_string(result.size()) + " elements; a grid of " +
                           std::to_string(grid.columns) + " x " + std::to_string(grid.rows) +
                           " positions with " + std::to_string(channels_) + " channels needs " +
                           std::to_string(size * channels_));
  if (size == 0) return;
  check_place(grid.origin);
  check_place(grid.place(grid.columns - 1, grid.rows - 1));

  // By id, then by channel.
  std::vector<double> of_points(std::size_t{triangulation_.next_id()} * channels_);
  const double time = triangulation_.current_time().to_double();
  for (Point_id id = 0; id < triangulation_.next_id(); ++id) {
    if (!triangulation_.contains(id)) continue;
    const std::span<const Linear_value> of_point = values(id);
    KINETRI_PRECONDITION(!of_point.empty(), "point " + std::to_string(id) + " has no values");
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      of_points[id * channels_ + channel] = rounded_value(of_point[channel], time);
    }
  }

  Present<Traits> present(triangulation_);
  present.round_all();
  const Raster<Traits> raster(present, grid);
  Combination<Traits> combination;
  std::vector<double> at_points;
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const auto here = result.subspan((row * grid.columns + column) * channels_, channels_);
      const auto triangle = raster.triangle(column, row);
      if (triangle == typename Triangulation::Face_handle()) {
        std::ranges::fill(here, std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      combination.find(present, triangle, grid.place(column, row), interpolation);
      at_points.resize(combination.vertices().size());
      for (std::size_t channel = 0; channel < channels_; ++channel) {
        for (std::size_t i = 0; i < at_points.size(); ++i) {
          const Point_id id = Present<Traits>::id(combination.vertices()[i]);
          at_points[i] = of_points[id * channels_ + channel];
        }
        here[channel] = detail::weighted_mean(at_points, combination.weights());
      }
    }
  }
}

template class Kinetic_field_2<Linear_kinetic_traits_2>;
template class Kinetic_field_2<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
