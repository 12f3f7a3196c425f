// SPDX-License-Identifier: GPL-3.0-or-later
//
// The audits of Kinetic_triangulation_2. The geometric levels check exact positions at a rational
// time with CGAL's static predicates, which share no formula with the certificates. The level
// `reference`, which also checks the diagonals of cocircular points, compares with a triangulation
// that CGAL (in a periodic box Static_construction) builds just after the present time with the
// predicates of the traits.
#ifndef KINETRI_TRIANGULATION_AUDIT_IMPL_H
#define KINETRI_TRIANGULATION_AUDIT_IMPL_H

#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost_mp.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/certification_impl.h"
#include "kinetri/impl/triangulation/insertion_order.h"
#include "kinetri/impl/triangulation/torus_triangulation.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri::detail {

inline std::string edge_name(const Periodic_edge& edge) {
  const auto& [ids, offset] = edge;
  return "edge " + std::to_string(ids[0]) + "-" + std::to_string(ids[1]) + " (" +
         std::to_string(offset.x) + ", " + std::to_string(offset.y) + ")";
}
inline std::string edge_name(const Edge_ids& ids) {
  if (ids[1] == no_point) return "edge from " + std::to_string(ids[0]) + " to infinity";
  return "edge " + std::to_string(ids[0]) + "-" + std::to_string(ids[1]);
}

/// One audit of a kinetic triangulation.
template <class Traits>
class Auditor {
 public:
  explicit Auditor(const Kinetic_core<Traits>& audited)
      : topology_(audited.topology),
        triangulation_(audited.topology.triangulation()),
        certification_(audited.certification),
        schedule_(audited.schedule),
        queue_(audited.schedule.queue()) {}

  Audit_report run(Audit_level level);

 private:
  // Lazy: floating-point intervals decide most predicates.
  using Exact_number = CGAL::Lazy_exact_nt<Rational>;
  using Kernel = CGAL::Simple_cartesian<Exact_number>;
  using Place = typename Kernel::Point_2;
  using Weighted_place = typename Kernel::Weighted_point_2;
  using Types = Kinetic_types<Traits>;
  static constexpr bool is_weighted = Types::is_weighted;
  static constexpr bool is_periodic = Types::is_periodic;
  using Triangulation = typename Types::Triangulation;
  using Vertex_handle = typename Types::Vertex_handle;
  using Face_handle = typename Types::Face_handle;
  using Edge = typename Types::Edge;
  using Time = typename Types::Time;
  using Entry = typename Types::Entry;
  using Point_2 = typename Types::Point_2;
  using Edge_name = typename Types::Edge_name;

  struct Failure {
    Entry_kind kind;
    Time time;
  };

  void place_points();
  Time latest() const;
  bool are_twins(const Point_2& p, const Point_2& q) const;
  bool has_touch(const Time& time) const;
  void check_links();
  void check_vertices();
  void check_events();
  bool are_links_right() const;
  void check_embedding();
  void check_hull();
  void check_chain();
  void check_delaunay();
  void check_hidden_points();
  void check_reference();
  void check_certificates();
  template <class Function>
  void for_each_failure(const Function& function) const;
  std::optional<Failure> next_failure(const Edge& edge, const Certification<Traits>& exact) const;
  std::optional<Failure> next_failure(Vertex_handle hidden,
                                      const Certification<Traits>& exact) const;
  void check_entry(const std::string& name, Queue_handle handle,
                   const std::optional<Failure>& failure);

  const Place& place(Vertex_handle v) const { return places_[v->point().id()]; }
  // The position of the corner; of its image against corner 0, in a periodic box.
  Place place(Face_handle face, int i) const {
    if constexpr (is_periodic) return moved(place(face->vertex(i)), face->offset(i));
    return place(face->vertex(i));
  }
  // The position of a hidden point; of its image in the face that hides it, in a periodic box.
  Place place_of_hidden(Vertex_handle v) const {
    if constexpr (is_periodic) {
      return moved(place(v), Topology<Traits>::location_of_hidden(v).offset);
    } else {
      return place(v);
    }
  }
  Place moved(const Place& place, const Lattice_offset_2& offset) const {
    return place + offset.x * box_[0] + offset.y * box_[1];
  }
  // The position, with the weight of the point if there are weights.
  auto input(const Place& place, Vertex_handle v) const {
    if constexpr (is_weighted) {
      return Weighted_place(place, weights_[v->point().id()]);
    } else {
      return place;
    }
  }
  auto input(Face_handle face, int i) const { return input(place(face, i), face->vertex(i)); }
  // The side of the circle, or power circle, through three points on which the fourth is.
  template <class Input>
  static CGAL::Oriented_side side_of_circle(const Input& p, const Input& q, const Input& r,
                                            const Input& s) {
    if constexpr (is_weighted) {
      return CGAL::power_side_of_oriented_power_circle(p, q, r, s);
    } else {
      return CGAL::side_of_oriented_circle(p, q, r, s);
    }
  }
  std::string name(const Edge& edge) const { return edge_name(Topology<Traits>::name_of(edge)); }
  std::string name(const Entry& entry) const {
    if constexpr (is_weighted) {
      if (entry.is_hidden()) return "hidden point " + std::to_string(entry.hidden->point().id());
    }
    return name(entry.edge());
  }
  void fail(std::string message) { report_.failures.push_back(std::move(message)); }
  void fail(const char* what, const std::array<Vertex_handle, 3>& v);

  const Topology<Traits>& topology_;
  const Triangulation& triangulation_;
  const Certification<Traits>& certification_;
  const Schedule<Traits>& schedule_;
  const typename Schedule<Traits>::Queue& queue_;
  std::vector<Place> places_;                     // at one exact time, by point id
  std::vector<Exact_number> weights_;             // at the same time, if points have weights
  std::array<typename Kernel::Vector_2, 2> box_;  // at the same time, in a periodic box
  Audit_report report_;
};

template <class Traits>
Audit_report Auditor<Traits>::run(Audit_level level) {
  check_links();
  // The other checks follow the links.
  if (!report_.passed() || level == Audit_level::links) return std::move(report_);

  place_points();
  check_embedding();
  if (level >= Audit_level::delaunay) {
    check_delaunay();
    check_hidden_points();
  }
  if (level >= Audit_level::reference) check_reference();
  if (level >= Audit_level::certificates) check_certificates();
  return std::move(report_);
}

// Computes the positions at a rational time strictly between now and the next event. A triangle may
// be flat at a time between events without turning over (a touch): then an earlier time is taken.
template <class Traits>
void Auditor<Traits>::place_points() {
  const Time& now = schedule_.current_time();
  Time end = latest();
  if (schedule_.is_deferred()) {
    for_each_failure([&](const std::string&, Queue_handle, const std::optional<Failure>& failure) {
      if (failure) end = std::min(end, failure->time);
    });
  } else if (!queue_.empty()) {
    end = std::min(end, queue_.time_of(queue_.top()));
  }
  do {
    const Rational time = simplest_between(now, end);
    places_.clear();
    weights_.clear();
    for (const Vertex_handle v : topology_.vertices()) {
      if (v == Vertex_handle()) {
        places_.emplace_back();  // unused: there is no such vertex
        weights_.emplace_back();
        continue;
      }
      const auto position = v->point().position(time);
      places_.emplace_back(Exact_number(position.x), Exact_number(position.y));
      if constexpr (is_weighted) weights_.emplace_back(v->point().weight(time));
    }
    if constexpr (is_periodic) {
      const Periodic_box_2& box = certification_.traits().box();
      const auto vector = [&](const Linear_motion_2& motion) {
        const auto end_of_vector = Moving_point_2(motion).position(time);
        return typename Kernel::Vector_2(end_of_vector.x, end_of_vector.y);
      };
      box_ = {vector(box.first()), vector(box.second())};
    }
    end = Time(time);
  } while (has_touch(end));
}

// A time after the present one, and not after the end of time.
template <class Traits>
auto Auditor<Traits>::latest() const -> Time {
  const Time later(Rational(schedule_.current_time().upper() + 1));
  return schedule_.end() ? std::min(later, *schedule_.end()) : later;
}

// Whether a triangle is flat at `time`, that of `places_`, but not just after it.
template <class Traits>
bool Auditor<Traits>::has_touch(const Time& time) const {
  if (triangulation_.dimension() < 2) return false;
  const auto after = certification_.traits().instantaneous_traits({time, Time_side::after});
  return std::ranges::any_of(triangulation_.finite_face_handles(), [&](Face_handle f) {
    return CGAL::collinear(place(f, 0), place(f, 1), place(f, 2)) &&
           after.orientation_2_object()(topology_.corner(f, 0), topology_.corner(f, 1),
                                        topology_.corner(f, 2)) != CGAL::COLLINEAR;
  });
}

// Whether the faces fit together. If there are hidden vertices, CGAL's own check does not count
// them right.
template <class Traits>
bool Auditor<Traits>::are_links_right() const {
  const auto& tds = triangulation_.tds();
  if (topology_.number_of_hidden_vertices() == 0) return tds.is_valid();
  for (auto f = tds.faces().begin(); f != tds.faces().end(); ++f) {
    if (!f->is_valid()) return false;
  }
  std::size_t visible = 1;  // the infinite one
  for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end();
       ++v) {
    ++visible;
    if (!v->face()->has_vertex(v)) return false;
  }
  if (tds.dimension() == 0) return visible == 2;
  return tds.faces().size() == (tds.dimension() == 1 ? visible : 2 * visible - 4);
}

template <class Traits>
void Auditor<Traits>::check_links() {
  if constexpr (is_periodic) {
    if (const std::string problem = triangulation_.problem(); !problem.empty()) {
      return fail(problem);
    }
  } else {
    if (!are_links_right()) return fail("the triangulation's links are broken");
  }
  check_vertices();
  check_events();
}

template <class Traits>
void Auditor<Traits>::check_vertices() {
  const auto& vertices = topology_.vertices();
  const std::size_t infinite = is_periodic ? 0 : 1;
  const std::size_t vertices_there = triangulation_.tds().number_of_vertices() - infinite;
  if (vertices_there != topology_.number_of_vertices()) {
    fail("there are " + std::to_string(topology_.number_of_vertices()) + " points but " +
         std::to_string(vertices_there) + " vertices");
  }
  for (std::size_t id = 0; id < vertices.size(); ++id) {
    if (topology_.has_vertex(static_cast<Point_id>(id)) && vertices[id]->point().id() != id) {
      fail("the vertex of point " + std::to_string(id) + " holds point " +
           std::to_string(vertices[id]->point().id()));
    }
  }
  for (const auto& [id, twin] : topology_.twins().all()) {
    if (topology_.has_vertex(twin.shown) && twin.shown < id && !topology_.has_vertex(id) &&
        are_twins(topology_.point(twin.shown), twin.point)) {
      continue;
    }
    fail("point " + std::to_string(id) + " is hidden by point " + std::to_string(twin.shown) +
         ", which has another trajectory, or no vertex");
  }
}

// Whether two points have the same trajectory (and weight); in a periodic box, whether images have.
template <class Traits>
bool Auditor<Traits>::are_twins(const Point_2& p, const Point_2& q) const {
  if constexpr (is_periodic) {
    const Periodic_box_2& box = certification_.traits().box();
    const Rational time = simplest_between(schedule_.current_time(), latest());
    const auto at = [&](const Linear_motion_2& motion) {
      return Moving_point_2(motion).position(time);
    };
    const Exact_position_2 from = p.position(time);
    const Exact_position_2 to = q.position(time);
    const auto [a, b] = std::pair(at(box.first()), at(box.second()));
    const Rational x = ((to.x - from.x) * b.y - (to.y - from.y) * b.x) / box.area(time);
    const Rational y = (a.x * (to.y - from.y) - a.y * (to.x - from.x)) / box.area(time);
    const Lattice_offset_2 offset = {x.convert_to<std::int32_t>(), y.convert_to<std::int32_t>()};
    const auto motion = [&](const Point_2& point, const Lattice_offset_2& of_image) {
      return certification_.traits().image(point, of_image).motion();
    };
    return offset.x == x && offset.y == y && same_trajectory(motion(p, offset), motion(q, {}));
  } else {
    return same_trajectory(p.motion(), q.motion());
  }
}

template <class Traits>
void Auditor<Traits>::check_events() {
  if (schedule_.is_deferred()) {
    if (!queue_.empty()) fail("certificates are deferred, but the queue has entries");
    return;
  }
  if (!queue_.is_valid()) fail("the queue is out of order");
  if (!queue_.empty() && queue_.time_of(queue_.top()) <= schedule_.current_time()) {
    fail("the event of " + name(queue_.top()) + " is not in the future");
  }
  std::size_t events = 0;
  if constexpr (is_weighted) {
    for (const Vertex_handle v : triangulation_.hidden_vertex_handles()) {
      const auto& list = v->face()->vertex_list();
      if (std::ranges::count(list, v) != 1) {
        fail("the hidden point " + std::to_string(v->point().id()) +
             " is not in the list of its face");
      }
      if (v->event() == no_event) continue;
      ++events;
      if (!queue_.contains(v->event()) || !queue_[v->event()].is_hidden() ||
          queue_[v->event()].hidden != v) {
        fail("the hidden point " + std::to_string(v->point().id()) + " has the event of another");
      }
    }
  }
  for (const Edge& edge : triangulation_.all_edges()) {
    if (triangulation_.dimension() < 1) break;
    const Queue_handle handle = edge.first->event(edge.second);
    const Edge mirror = topology_.with_mirror(edge).there;
    if (mirror.first->event(mirror.second) != handle) {
      fail("the two faces at " + name(edge) + " disagree about its event");
    }
    if (handle == no_event) continue;
    ++events;
    if (!queue_.contains(handle)) {
      fail(name(edge) + " has an event that is not queued");
    } else if (queue_[handle].edge() != edge && queue_[handle].edge() != mirror) {
      fail(name(edge) + " has the event of another edge");
    }
  }
  if (events != queue_.size()) {
    fail(std::to_string(queue_.size()) + " events are queued for " + std::to_string(events) +
         " edges");
  }
}

template <class Traits>
void Auditor<Traits>::fail(const char* what, const std::array<Vertex_handle, 3>& v) {
  fail(std::string(what) + " " + std::to_string(v[0]->point().id()) + ", " +
       std::to_string(v[1]->point().id()) + ", " + std::to_string(v[2]->point().id()));
}

template <class Traits>
void Auditor<Traits>::check_embedding() {
  if constexpr (!is_periodic) {
    if (triangulation_.dimension() < 2) return check_chain();
  }
  for (const Face_handle f : triangulation_.finite_face_handles()) {
    if (CGAL::orientation(place(f, 0), place(f, 1), place(f, 2)) != CGAL::LEFT_TURN) {
      fail("not counterclockwise: triangle", {f->vertex(0), f->vertex(1), f->vertex(2)});
    }
  }
  if constexpr (!is_periodic) check_hull();
}

template <class Traits>
void Auditor<Traits>::check_hull() {
  for (const Edge& edge : triangulation_.all_edges()) {
    if (!triangulation_.is_infinite(edge)) continue;
    const auto turn = topology_.hull_turn(topology_.with_mirror(edge));
    if (CGAL::orientation(place(turn[0]), place(turn[1]), place(turn[2])) == CGAL::RIGHT_TURN) {
      fail("the hull is not convex at", turn);
    }
  }
}

// Collinear points form a chain whose faces are its edges; the neighbors of each inner point lie on
// opposite sides.
template <class Traits>
void Auditor<Traits>::check_chain() {
  if (triangulation_.dimension() < 1) return;
  for (const auto& [face, unused] : triangulation_.finite_edges()) {
    for (const int end : {0, 1}) {
      const Face_handle next = face->neighbor(1 - end);
      if (triangulation_.is_infinite(next)) continue;
      const Vertex_handle here = face->vertex(end);
      const Vertex_handle beyond = next->vertex(1 - next->index(here));
      if (!CGAL::are_strictly_ordered_along_line(place(face->vertex(1 - end)), place(here),
                                                 place(beyond))) {
        fail("not in order along their line:", {face->vertex(1 - end), here, beyond});
      }
    }
  }
}

template <class Traits>
void Auditor<Traits>::check_delaunay() {
  if (triangulation_.dimension() < 2) return;
  for (const Edge& edge : triangulation_.all_edges()) {
    const auto& [face, i] = edge;
    const auto& [neighbor, j] = topology_.with_mirror(edge).there;
    if (triangulation_.is_infinite(face) || triangulation_.is_infinite(neighbor)) continue;
    const Vertex_handle opposite = neighbor->vertex(j);
    Place there = place(neighbor, j);
    if constexpr (is_periodic) {
      there = place(face, Triangulation::cw(i)) + (there - place(neighbor, Triangulation::ccw(j)));
    }
    if (side_of_circle(input(face, 0), input(face, 1), input(face, 2), input(there, opposite)) ==
        CGAL::ON_POSITIVE_SIDE) {
      fail("not locally Delaunay: " + name(edge) + " between " +
           std::to_string(face->vertex(i)->point().id()) + " and " +
           std::to_string(opposite->point().id()));
    }
  }
}

// Checks that each hidden point is in its face and not below the lifted face. With locally regular
// edges that makes the triangulation regular.
template <class Traits>
void Auditor<Traits>::check_hidden_points() {
  if constexpr (is_weighted) {
    for (const Vertex_handle v : triangulation_.hidden_vertex_handles()) {
      const Face_handle face = v->face();
      const auto fail_at = [&](const char* what) {
        fail("the hidden point " + std::to_string(v->point().id()) + what);
      };
      const auto corner = [&](int i) { return input(face, i); };
      const auto point = input(place_of_hidden(v), v);
      if (triangulation_.dimension() == 0) {
        if (corner(0).point() != point.point() || corner(0).weight() < point.weight()) {
          fail_at(" is not hidden by the vertex that should hide it");
        }
        continue;
      }
      if (triangulation_.is_infinite(face)) {
        fail_at(" is in an infinite face");
        continue;
      }
      if (triangulation_.dimension() == 1) {
        if (!CGAL::collinear_are_ordered_along_line(corner(0).point(), point.point(),
                                                    corner(1).point()) ||
            CGAL::power_side_of_oriented_power_circle(corner(0), corner(1), point) ==
                CGAL::ON_POSITIVE_SIDE) {
          fail_at(" is not hidden by the edge that should hide it");
        }
        continue;
      }
      for (int i = 0; i < 3; ++i) {
        if (CGAL::orientation(corner(Triangulation::ccw(i)).point(),
                              corner(Triangulation::cw(i)).point(),
                              point.point()) == CGAL::RIGHT_TURN) {
          fail_at(" is not in its face");
        }
      }
      if (side_of_circle(corner(0), corner(1), corner(2), point) == CGAL::ON_POSITIVE_SIDE) {
        fail_at(" is not hidden by its face");
      }
    }
  }
}

template <class Traits>
void Auditor<Traits>::check_reference() {
  auto points = topology_.points();
  const auto after = certification_.traits().exact().instantaneous_traits(
      {schedule_.current_time(), Time_side::after});
  Triangulation reference(after);
  if constexpr (is_periodic) {
    std::vector<Edge_ids> coincident;
    reference = triangulation_of_torus<typename Types::Instantaneous_traits>(
        points, schedule_.current_time().to_double(), after, coincident);
  } else {
    sort_for_insertion(points, after);
    insert_in_order(reference, points, std::identity(), [](const auto&, const auto&) {});
  }
  std::vector<Edge_name> edges;
  for (const Edge& edge : reference.all_edges()) {
    if (reference.dimension() > 0 && !reference.is_infinite(edge)) {
      edges.push_back(Topology<Traits>::name_of(edge));
    }
  }
  std::ranges::sort(edges);
  const std::vector<Edge_name> present = topology_.finite_edges();
  for (const Edge_name& edge : edges) {
    if (std::ranges::binary_search(present, edge)) continue;
    fail("missing: " + edge_name(edge) + " of the static Delaunay triangulation");
  }
  for (const Edge_name& edge : present) {
    if (std::ranges::binary_search(edges, edge)) continue;
    fail(edge_name(edge) + " is not in the static Delaunay triangulation");
  }
  if constexpr (is_weighted) {
    auto& vertices = reference.tds().vertices();
    for (Vertex_handle v = vertices.begin(); v != vertices.end(); ++v) {
      if (reference.is_infinite(v)) continue;
      const Point_id id = v->point().id();
      if (v->is_hidden() == topology_.is_hidden(id)) continue;
      fail("point " + std::to_string(id) + (v->is_hidden() ? " is not" : " is") +
           " hidden, unlike in the static regular triangulation");
    }
  }
}

// The next failure of the edge, computed again: its kind and its exact time.
template <class Traits>
auto Auditor<Traits>::next_failure(const Edge& edge, const Certification<Traits>& exact) const
    -> std::optional<Failure> {
  const auto sides = topology_.with_mirror(edge);
  auto [kind, next] = exact.certificate_of(sides, schedule_.current_time());
  while (next.kind == Certificate::Kind::holds) {
    std::tie(kind, next) = exact.certificate_of(sides, Time(next.bounds.lower));
  }
  if (next.kind == Certificate::Kind::never_fails) return std::nullopt;
  if (next.failure) return Failure{kind, std::move(*next.failure)};
  return Failure{kind, exact.failure_time(exact.points(sides), next.bounds)};
}

template <class Traits>
auto Auditor<Traits>::next_failure(Vertex_handle hidden, const Certification<Traits>& exact) const
    -> std::optional<Failure> {
  Certificate_counters unused;
  auto [index, next] = exact.hidden_certificate(hidden, schedule_.current_time(), unused);
  while (next.kind == Certificate::Kind::holds) {
    std::tie(index, next) = exact.hidden_certificate(hidden, Time(next.bounds.lower), unused);
  }
  if (next.kind == Certificate::Kind::never_fails) return std::nullopt;
  if (next.failure) return Failure{Entry_kind::hidden, std::move(*next.failure)};
  return Failure{Entry_kind::hidden,
                 exact.failure_time(exact.hidden_points(hidden, index), next.bounds)};
}

// Calls `function` with the name of each edge and hidden point, its handle and its failure, if it
// has one.
template <class Traits>
template <class Function>
void Auditor<Traits>::for_each_failure(const Function& function) const {
  const Certification<Traits> exact(certification_.traits().exact(), topology_);
  if constexpr (is_weighted) {
    for (const Vertex_handle v : triangulation_.hidden_vertex_handles()) {
      function("the hidden point " + std::to_string(v->point().id()), v->event(),
               next_failure(v, exact));
    }
  }
  if (triangulation_.dimension() < 1) return;
  for (const Edge& edge : triangulation_.all_edges()) {
    if (triangulation_.dimension() == 1 && triangulation_.is_infinite(edge)) continue;
    function(name(edge), edge.first->event(edge.second), next_failure(edge, exact));
  }
}

template <class Traits>
void Auditor<Traits>::check_certificates() {
  if (schedule_.is_deferred()) return;
  for_each_failure(
      [this](const std::string& what, Queue_handle handle, const std::optional<Failure>& failure) {
        check_entry(what, handle, failure);
      });
}

// Whether what the queue holds for the edge or hidden point agrees with its failure.
template <class Traits>
void Auditor<Traits>::check_entry(const std::string& name, Queue_handle handle,
                                  const std::optional<Failure>& failure) {
  if (handle == no_event) {
    if (failure) fail(name + " will fail but has no event");
  } else if (queue_[handle].kind == Entry_kind::recheck) {
    if (failure && failure->time <= queue_.time_of(queue_[handle])) {
      fail(name + " fails before it is checked again");
    }
  } else if (!failure) {
    fail(name + " has an event but never fails");
  } else if (failure->time != queue_.time_of(queue_[handle]) ||
             failure->kind != queue_[handle].kind) {
    fail(name + " has an event at another time, or of another kind, than its failure");
  }
}

/// As Kinetic_triangulation_2::audit.
template <class Traits>
Audit_report audit(const Kinetic_core<Traits>& core, Audit_level level) {
  return Auditor<Traits>(core).run(level);
}

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_AUDIT_IMPL_H
