// SPDX-License-Identifier: GPL-3.0-or-later
#include "uncertified_kinetic_delaunay.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_map>

#include "first_failure.h"

namespace kinetri::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int cw(int i) {
  return i == 0 ? 2 : i - 1;
}
constexpr int ccw(int i) {
  return i == 2 ? 0 : i + 1;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Relative to the time in which the points pass their distance at their relative speed.
constexpr double window_share = 0.65;

// A vector type of GCC and Clang, for two certificates at a time.
using Pair = double __attribute__((vector_size(16)));

// The difference of two motions: position now, and velocity.
template <class Number>
struct Difference {
  Number x, y;
  Number slope_x, slope_y;
};

template <class Number>
using Quadratic = std::array<Number, 3>;

template <class Vertex>
Difference<double> difference(const Vertex& p, const Vertex& q, double now) {
  Difference<double> d;
  d.slope_x = p.velocity.x - q.velocity.x;
  d.slope_y = p.velocity.y - q.velocity.y;
  d.x = (p.point().x() - q.point().x()) + d.slope_x * now;
  d.y = (p.point().y() - q.point().y()) + d.slope_y * now;
  return d;
}

Difference<Pair> both(const Difference<double>& a, const Difference<double>& b) {
  return {Pair{a.x, b.x}, Pair{a.y, b.y}, Pair{a.slope_x, b.slope_x}, Pair{a.slope_y, b.slope_y}};
}

template <class Number>
Quadratic<Number> squared_length(const Difference<Number>& d) {
  return {d.x * d.x + d.y * d.y, 2 * (d.x * d.slope_x + d.y * d.slope_y),
          d.slope_x * d.slope_x + d.slope_y * d.slope_y};
}

template <class A, class B>
auto cross(const Difference<A>& a, const Difference<B>& b) {
  using Number = decltype(A() * B());
  return Quadratic<Number>{
      a.x * b.y - a.y * b.x,
      (a.x * b.slope_y - a.y * b.slope_x) + (a.slope_x * b.y - a.slope_y * b.x),
      a.slope_x * b.slope_y - a.slope_y * b.slope_x};
}

// A point relative to the corner of the triangles, with its squared distance.
template <class Number>
struct Lifted {
  explicit Lifted(const Difference<Number>& difference)
      : d(difference), l(squared_length(difference)) {}

  Difference<Number> d;
  Quadratic<Number> l;
};

// Minus the in-circle determinant of the triangle (0, u, v) and s: l_u v x s - l_v u x s + l_s u x
// v.
template <class Number>
std::array<Number, 5> in_circle_coefficients(const Lifted<double>& u, const Lifted<double>& v,
                                             const Quadratic<double>& uv, const Lifted<Number>& s) {
  const Quadratic<Number> vs = cross(v.d, s.d);
  const Quadratic<Number> us = cross(u.d, s.d);
  return {u.l[0] * vs[0] - v.l[0] * us[0] + s.l[0] * uv[0],
          (u.l[0] * vs[1] + u.l[1] * vs[0]) - (v.l[0] * us[1] + v.l[1] * us[0]) +
              (s.l[0] * uv[1] + s.l[1] * uv[0]),
          (u.l[0] * vs[2] + u.l[1] * vs[1] + u.l[2] * vs[0]) -
              (v.l[0] * us[2] + v.l[1] * us[1] + v.l[2] * us[0]) +
              (s.l[0] * uv[2] + s.l[1] * uv[1] + s.l[2] * uv[0]),
          (u.l[1] * vs[2] + u.l[2] * vs[1]) - (v.l[1] * us[2] + v.l[2] * us[1]) +
              (s.l[1] * uv[2] + s.l[2] * uv[1]),
          u.l[2] * vs[2] - v.l[2] * us[2] + s.l[2] * uv[2]};
}

// The time in which points would pass their greatest distance at their greatest relative speed.
double time_scale(const Quadratic<double>& a, const Quadratic<double>& b) {
  return std::sqrt(std::max(a[0], b[0]) / std::max(a[2], b[2]));
}
double time_scale(const Quadratic<double>& a, const Quadratic<double>& b,
                  const Quadratic<double>& c) {
  return std::sqrt(std::max({a[0], b[0], c[0]}) / std::max({a[2], b[2], c[2]}));
}

template <std::size_t M>
std::array<double, M> lane(const std::array<Pair, M>& pair, std::size_t i) {
  std::array<double, M> result;
  for (std::size_t k = 0; k < M; ++k) result[k] = pair[k][i];
  return result;
}

}  // namespace

// ---- construction ----

Uncertified_kinetic_delaunay::Uncertified_kinetic_delaunay(std::span<const Linear_motion_2> motions,
                                                           Outlook_range range)
    : range_(range) {
  const auto start = Clock::now();
  build(motions);
  number_edges();
  build_seconds_ = seconds_since(start);
  const auto built = Clock::now();
  for (std::uint32_t edge = 0; edge < edges_.size(); ++edge) schedule(edge, false);
  initialize_seconds_ = seconds_since(built);
}

// Copies the Delaunay triangulation of the points at time 0 so that vertices and faces lie in
// memory in the order of a Hilbert curve.
void Uncertified_kinetic_delaunay::build(std::span<const Linear_motion_2> motions) {
  using Point = Static_kernel::Point_2;
  using Id_vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Static_kernel>;
  using Static = CGAL::Delaunay_triangulation_2<Static_kernel,
                                                CGAL::Triangulation_data_structure_2<Id_vertex>>;
  std::vector<std::pair<Point, std::uint32_t>> points;
  points.reserve(motions.size());
  for (const Linear_motion_2& motion : motions) {
    points.emplace_back(Point(motion.position.x, motion.position.y),
                        static_cast<std::uint32_t>(points.size()));
  }
  const Static source(points.begin(), points.end());
  using Points = CGAL::First_of_pair_property_map<std::pair<Point, std::uint32_t>>;
  CGAL::hilbert_sort(points.begin(), points.end(),
                     CGAL::Spatial_sort_traits_adapter_2<Static_kernel, Points>());

  std::vector<Static::Vertex_handle> source_vertices(motions.size());
  for (const auto& vertex : source.finite_vertex_handles())
    source_vertices[vertex->info()] = vertex;
  tds_.set_dimension(2);
  infinite_ = tds_.create_vertex();
  std::vector<Vertex_handle> vertices(motions.size());
  for (const auto& [point, id] : points) {
    const Vertex_handle vertex = tds_.create_vertex();
    vertex->set_point(point);
    vertex->velocity = motions[id].velocity;
    vertex->id = id;
    vertices[id] = vertex;
  }
  const auto copy_of = [&](Static::Vertex_handle vertex) {
    return source.is_infinite(vertex) ? infinite_ : vertices[vertex->info()];
  };
  std::unordered_map<Static::Face_handle, Face_handle> faces;
  faces.reserve(2 * motions.size());
  for (const auto& entry : points) {
    auto face = source.incident_faces(source_vertices[entry.second]);
    const auto first = face;
    do {
      Face_handle& copy = faces[face];
      if (copy != nullptr) continue;
      copy = tds_.create_face(copy_of(face->vertex(0)), copy_of(face->vertex(1)),
                              copy_of(face->vertex(2)));
      for (int i = 0; i < 3; ++i) copy->vertex(i)->set_face(copy);
    } while (++face != first);
  }
  for (const auto& [face, copy] : faces) {
    copy->set_neighbors(faces.at(face->neighbor(0)), faces.at(face->neighbor(1)),
                        faces.at(face->neighbor(2)));
  }
}

void Uncertified_kinetic_delaunay::number_edges() {
  for (Face_handle face = tds_.faces_begin(); face != tds_.faces_end(); ++face) {
    for (int i = 0; i < 3; ++i) {
      const Face_handle neighbor = face->neighbor(i);
      if (neighbor < face) continue;
      const auto number = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back({face, i});
      face->edge[static_cast<std::size_t>(i)] = number;
      neighbor->edge[static_cast<std::size_t>(tds_.mirror_index(face, i))] = number;
    }
  }
  look_again_.assign(edges_.size(), 0);
  queue_.reset(edges_.size());
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> Uncertified_kinetic_delaunay::finite_edge_ids()
    const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
  for (const auto& [face, i] : edges_) {
    const Vertex_handle a = face->vertex(cw(i));
    const Vertex_handle b = face->vertex(ccw(i));
    if (a == infinite_ || b == infinite_) continue;
    result.emplace_back(std::min(a->id, b->id), std::max(a->id, b->id));
  }
  std::sort(result.begin(), result.end());
  return result;
}

// ---- certificates ----

// The time of the first failure of a certificate with coefficients `c` in the time from now on; in
// lazy mode perhaps the time of the next recheck.
template <std::size_t M>
double Uncertified_kinetic_delaunay::look(const std::array<double, M>& c, double scale,
                                          bool just_flipped) {
  if (!just_flipped) return c[0] < 0 ? now_ : now_ + first_look(c, scale);
  // The root at the present time is divided out. A next root so close that rounding hides it is
  // missed; when a triangle of the edge changes, the edge is found violated.
  std::array<double, M - 1> quotient;
  std::copy(c.begin() + 1, c.end(), quotient.begin());
  return quotient[0] <= 0 ? never : now_ + first_look(quotient, scale);
}

template <std::size_t M>
double Uncertified_kinetic_delaunay::first_look(const std::array<double, M>& c, double scale) {
  if (range_ == Outlook_range::unlimited) return first_failure(c, scale, counters_.root_solves);
  return first_look_in_window(c, window_share * scale);
}

template <std::size_t M>
double Uncertified_kinetic_delaunay::first_look_in_window(const std::array<double, M>& c,
                                                          double window) {
  if (sign_changes(c) == 0) return never;
  std::array<double, M> b = bernstein(c, window);
  double root = never;
  if (sign_changes(b) > 0) {
    ++counters_.root_solves;
    root = first_root_in_piece(b);
  }
  holds_ = root == never;
  return holds_ ? window : window * root;
}

double Uncertified_kinetic_delaunay::in_circle_look(const Vertex& p, const Vertex& q,
                                                    const Vertex& r, const Vertex& s,
                                                    bool just_flipped) {
  const Lifted<double> u(difference(q, p, now_));
  const Lifted<double> v(difference(r, p, now_));
  const Lifted<double> w(difference(s, p, now_));
  return look(in_circle_coefficients(u, v, cross(u.d, v.d), w), time_scale(u.l, v.l, w.l),
              just_flipped);
}

double Uncertified_kinetic_delaunay::orientation_look(const Vertex& p, const Vertex& q,
                                                      const Vertex& r, bool just_flipped) {
  const Difference<double> u = difference(q, p, now_);
  const Difference<double> v = difference(r, p, now_);
  return look(cross(u, v), time_scale(squared_length(u), squared_length(v)), just_flipped);
}

// As in the exact triangulation: the in-circle certificate for an edge between finite triangles,
// the orientation of the triangle for a hull edge, and that of three hull vertices for an infinite
// edge.
double Uncertified_kinetic_delaunay::next_look(const Edge& edge, bool just_flipped) {
  const auto& [face, i] = edge;
  const Face_handle neighbor = face->neighbor(i);
  const Vertex_handle left = face->vertex(cw(i));
  const Vertex_handle right = face->vertex(ccw(i));
  const Vertex_handle apex = face->vertex(i);
  const Vertex_handle opposite = neighbor->vertex(cw(neighbor->index(left)));
  if (left == infinite_) return orientation_look(*opposite, *right, *apex, just_flipped);
  if (right == infinite_) return orientation_look(*apex, *left, *opposite, just_flipped);
  if (apex == infinite_) return orientation_look(*left, *right, *opposite, just_flipped);
  if (opposite == infinite_) return orientation_look(*right, *left, *apex, just_flipped);
  return in_circle_look(*right, *left, *apex, *opposite, just_flipped);
}

// ---- events ----

void Uncertified_kinetic_delaunay::schedule(std::uint32_t edge, bool just_flipped) {
  holds_ = false;
  set_time(edge, next_look(edges_[edge], just_flipped));
}

void Uncertified_kinetic_delaunay::set_time(std::uint32_t edge, double time) {
  ++counters_.certificates;
  if (time < never) {
    counters_.discarded += queue_.contains(edge);
    ++counters_.scheduled;
    look_again_[edge] = holds_;
    queue_.set(edge, time);
  } else if (queue_.contains(edge)) {
    ++counters_.discarded;
    queue_.erase(edge);
  }
}

// Flips as CGAL does: each of the two faces keeps one outer edge and gives the other one to its
// neighbor.
void Uncertified_kinetic_delaunay::flip(std::uint32_t edge) {
  const auto [face, i] = edges_[edge];
  const Face_handle neighbor = face->neighbor(i);
  const int j = tds_.mirror_index(face, i);
  tds_.flip(face, i);
  auto& ours = face->edge;
  auto& theirs = neighbor->edge;
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  const std::uint32_t to_neighbor = ours[at(ccw(i))];
  const std::uint32_t to_face = theirs[at(ccw(j))];
  ours[at(i)] = to_face;
  theirs[at(j)] = to_neighbor;
  ours[at(ccw(i))] = theirs[at(ccw(j))] = edge;
  edges_[to_face] = {face, i};
  edges_[to_neighbor] = {neighbor, j};
  edges_[edge] = {face, ccw(i)};
  ++counters_.executed;
  const std::array<std::uint32_t, 4> outer = {to_face, ours[at(cw(i))], to_neighbor,
                                              theirs[at(cw(j))]};
  if (schedule_finite(edge, outer, face, i, neighbor, j)) return;
  schedule(edge, true);
  for (const std::uint32_t e : outer) schedule(e, false);
}

// The five certificates after a flip, if all their points are finite; otherwise does nothing and
// returns false. The new triangles are (a, r, b) and (a, b, l), and `a` is the origin.
bool Uncertified_kinetic_delaunay::schedule_finite(std::uint32_t diagonal,
                                                   const std::array<std::uint32_t, 4>& outer,
                                                   Face_handle face, int i, Face_handle neighbor,
                                                   int j) {
  const Vertex_handle a = face->vertex(i);
  const Vertex_handle b = neighbor->vertex(j);
  const Vertex_handle r = face->vertex(ccw(i));
  const Vertex_handle l = neighbor->vertex(ccw(j));
  const auto beyond = [](Face_handle f, Vertex_handle end) {
    return f->vertex(ccw(f->index(end)));
  };
  const std::array<Vertex_handle, 4> s = {
      beyond(face->neighbor(i), r), beyond(face->neighbor(cw(i)), a),
      beyond(neighbor->neighbor(j), l), beyond(neighbor->neighbor(cw(j)), b)};
  for (const Vertex_handle v : {a, b, r, l, s[0], s[1], s[2], s[3]}) {
    if (v == infinite_) return false;
  }
  const auto from_a = [&a, this](Vertex_handle v) { return difference(*v, *a, now_); };
  const Lifted<double> right(from_a(r));
  const Lifted<double> far(from_a(b));
  const Lifted<double> left(from_a(l));
  const Quadratic<double> right_far = cross(right.d, far.d);
  const Quadratic<double> far_left = cross(far.d, left.d);
  holds_ = false;
  set_time(diagonal, look(in_circle_coefficients(right, far, right_far, left),
                          time_scale(right.l, far.l, left.l), true));
  const auto schedule_two = [&](const Lifted<double>& u, const Lifted<double>& v,
                                const Quadratic<double>& uv, std::size_t first) {
    const Lifted<Pair> w(both(from_a(s[first]), from_a(s[first + 1])));
    const std::array<Pair, 5> c = in_circle_coefficients(u, v, uv, w);
    for (std::size_t k = 0; k < 2; ++k) {
      holds_ = false;
      set_time(outer[first + k], look(lane(c, k), time_scale(u.l, v.l, lane(w.l, k)), false));
    }
  };
  schedule_two(right, far, right_far, 0);
  schedule_two(far, left, far_left, 2);
  return true;
}

void Uncertified_kinetic_delaunay::advance_to(double time) {
  while (!queue_.empty() && queue_.top().time <= time) {
    const auto [when, edge] = queue_.top();
    now_ = std::max(now_, when);
    // Prefetches the faces that are probably next, and the surroundings of the next one.
    for (const Time_heap::Entry& next : queue_.after_top()) {
      __builtin_prefetch(&*edges_[next.id].face);
    }
    if (const auto after = queue_.after_top(); !after.empty()) {
      const auto next = std::ranges::min_element(after, {}, &Time_heap::Entry::time);
      const Face_handle face = edges_[next->id].face;
      for (int i = 0; i < 3; ++i) {
        __builtin_prefetch(&*face->vertex(i));
        __builtin_prefetch(&*face->neighbor(i));
      }
    }
    // The entry stays first until schedule() replaces it, and is not counted as discarded there.
    --counters_.discarded;
    if (look_again_[edge] != 0) {
      ++counters_.looked_again;
      schedule(edge, false);
    } else {
      flip(edge);
    }
  }
  now_ = std::max(now_, time);
}

}  // namespace kinetri::bench
