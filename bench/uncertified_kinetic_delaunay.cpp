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

// Of the time in which the points pass their distance from one another at their relative speed.
constexpr double window_share = 0.25;

// The difference of two motions: place now, and per unit of time.
struct Difference {
  double x, y;
  double slope_x, slope_y;
};

template <class Vertex>
Difference difference(const Vertex& p, const Vertex& q, double now) {
  Difference d;
  d.slope_x = p.velocity.x - q.velocity.x;
  d.slope_y = p.velocity.y - q.velocity.y;
  d.x = (p.point().x() - q.point().x()) + d.slope_x * now;
  d.y = (p.point().y() - q.point().y()) + d.slope_y * now;
  return d;
}

template <std::size_t N>
double time_scale(const std::array<Difference, N>& differences) {
  double place = 0;
  double slope = 0;
  for (const Difference& d : differences) {
    place = std::max({place, std::abs(d.x), std::abs(d.y)});
    slope = std::max({slope, std::abs(d.slope_x), std::abs(d.slope_y)});
  }
  return place / slope;
}

// Minus the in-circle determinant of the differences to the fourth point.
Coefficients<4> in_circle_coefficients(const std::array<Difference, 3>& d) {
  Coefficients<4> c = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const Difference& a = d[i];
    const Difference& b = d[(i + 1) % 3];
    const Difference& e = d[(i + 2) % 3];
    const double l0 = a.x * a.x + a.y * a.y;
    const double l1 = 2 * (a.x * a.slope_x + a.y * a.slope_y);
    const double l2 = a.slope_x * a.slope_x + a.slope_y * a.slope_y;
    const double m0 = b.y * e.x - b.x * e.y;
    const double m1 = (b.y * e.slope_x - b.x * e.slope_y) + (b.slope_y * e.x - b.slope_x * e.y);
    const double m2 = b.slope_y * e.slope_x - b.slope_x * e.slope_y;
    c[0] += l0 * m0;
    c[1] += l0 * m1 + l1 * m0;
    c[2] += l0 * m2 + l1 * m1 + l2 * m0;
    c[3] += l1 * m2 + l2 * m1;
    c[4] += l2 * m2;
  }
  return c;
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

// Copies the Delaunay triangulation of the points at time 0 so that vertices and faces lie in memory
// in the order of a Hilbert curve.
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
  for (const auto& vertex : source.finite_vertex_handles()) source_vertices[vertex->info()] = vertex;
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
    if (a != infinite_ && b != infinite_) result.push_back(std::minmax(a->id, b->id));
  }
  std::sort(result.begin(), result.end());
  return result;
}

// ---- certificates ----

// The time of the first failure, or in lazy mode possibly that of the next look, of a certificate
// with coefficients `c` in the time from now on.
template <std::size_t M>
double Uncertified_kinetic_delaunay::look(const std::array<double, M>& c, double scale,
                                          bool just_flipped) {
  if (!just_flipped) return c[0] < 0 ? now_ : now_ + first_look(c, scale);
  // The root that is now is divided out. A next root so close that rounding hides it is passed
  // over; the next look at the edge, when one of its triangles changes, finds it violated.
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
  const std::array<Difference, 3> d = {difference(p, s, now_), difference(q, s, now_),
                                       difference(r, s, now_)};
  return look(in_circle_coefficients(d), time_scale(d), just_flipped);
}

double Uncertified_kinetic_delaunay::orientation_look(const Vertex& p, const Vertex& q,
                                                      const Vertex& r, bool just_flipped) {
  const std::array<Difference, 2> d = {difference(p, r, now_), difference(q, r, now_)};
  const Coefficients<2> c = {
      d[0].x * d[1].y - d[0].y * d[1].x,
      (d[0].x * d[1].slope_y - d[0].y * d[1].slope_x) +
          (d[0].slope_x * d[1].y - d[0].slope_y * d[1].x),
      d[0].slope_x * d[1].slope_y - d[0].slope_y * d[1].slope_x};
  return look(c, time_scale(d), just_flipped);
}

// As in the exact triangulation: the in-circle certificate for an edge between finite triangles,
// the orientation of its triangle for a hull edge, and a left turn of the hull for an edge to the
// infinite vertex.
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
  ++counters_.certificates;
  holds_ = false;
  const double time = next_look(edges_[edge], just_flipped);
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

// The vertex indices of CGAL's flip: `face` keeps the edges i's clockwise and loses its other ones.
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
  schedule(edge, true);
  schedule(to_face, false);
  schedule(to_neighbor, false);
  schedule(ours[at(cw(i))], false);
  schedule(theirs[at(cw(j))], false);
}

void Uncertified_kinetic_delaunay::advance_to(double time) {
  while (!queue_.empty() && queue_.top().time <= time) {
    const auto [when, edge] = queue_.top();
    now_ = std::max(now_, when);
    if (look_again_[edge] != 0) {
      ++counters_.looked_again;
      --counters_.discarded;  // schedule() takes the entry for a replaced one
      schedule(edge, false);
    } else {
      queue_.erase(edge);
      flip(edge);
    }
  }
  now_ = std::max(now_, time);
}

}  // namespace kinetri::bench
