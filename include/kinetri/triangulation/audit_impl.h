// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of the audits of Kinetic_triangulation_2. The geometric levels judge the
// exact positions at a rational time by CGAL's static predicates and share no formula with the
// certificates.
#ifndef KINETRI_TRIANGULATION_AUDIT_IMPL_H
#define KINETRI_TRIANGULATION_AUDIT_IMPL_H

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/boost_mp.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

namespace detail {

inline std::string edge_name(const Edge_ids& ids) {
  if (ids[1] == no_point) return "edge from " + std::to_string(ids[0]) + " to infinity";
  return "edge " + std::to_string(ids[0]) + "-" + std::to_string(ids[1]);
}

/// One audit of a kinetic triangulation.
template <class KineticTriangulation>
class Auditor {
 public:
  explicit Auditor(const KineticTriangulation& audited)
      : audited_(audited), triangulation_(audited.triangulation_), queue_(audited.queue_) {}

  Audit_report run(Audit_level level);

 private:
  // Lazy numbers decide most predicates by floating-point intervals.
  using Exact_number = CGAL::Lazy_exact_nt<Rational>;
  using Kernel = CGAL::Simple_cartesian<Exact_number>;
  using Place = typename Kernel::Point_2;
  using Static_triangulation = CGAL::Delaunay_triangulation_2<
      Kernel, CGAL::Triangulation_data_structure_2<
                  CGAL::Triangulation_vertex_base_with_info_2<Point_id, Kernel>>>;
  using Triangulation = typename KineticTriangulation::Triangulation;
  using Vertex_handle = typename KineticTriangulation::Vertex_handle;
  using Face_handle = typename KineticTriangulation::Face_handle;
  using Edge = typename KineticTriangulation::Edge;
  using Time = typename KineticTriangulation::Time;
  using Entry_kind = typename KineticTriangulation::Entry_kind;
  using Traits = std::remove_cv_t<decltype(KineticTriangulation::traits_)>;

  struct Failure {
    Entry_kind kind;
    Time time;
  };

  void place_points();
  bool has_touch(const Time& time) const;
  void check_links();
  void check_embedding();
  void check_chain();
  void check_delaunay();
  void check_reference();
  void check_certificates();
  std::optional<Failure> next_failure(const Edge& edge, const Traits& traits) const;

  const Place& place(Vertex_handle v) const { return places_[v->point().id()]; }
  std::string name(const Edge& edge) const { return edge_name(audited_.ids_of(edge)); }
  void fail(std::string message) { report_.failures.push_back(std::move(message)); }
  void fail(const char* what, const std::array<Vertex_handle, 3>& v);

  const KineticTriangulation& audited_;
  const Triangulation& triangulation_;
  const decltype(KineticTriangulation::queue_)& queue_;
  std::vector<Place> places_;  // at one exact time, by point id
  Audit_report report_;
};

template <class KineticTriangulation>
Audit_report Auditor<KineticTriangulation>::run(Audit_level level) {
  check_links();
  // What follows walks the links.
  if (!report_.passed() || level == Audit_level::links) return std::move(report_);

  place_points();
  check_embedding();
  if (level >= Audit_level::delaunay) check_delaunay();
  if (level >= Audit_level::reference) check_reference();
  if (level >= Audit_level::certificates) check_certificates();
  return std::move(report_);
}

// Places the points at a rational time strictly between now and the next event. Between events a
// triangle may touch: be flat at one time without turning over, which is no event and no fault.
// Such a time is no place to look, so another one is taken, nearer to now.
template <class KineticTriangulation>
void Auditor<KineticTriangulation>::place_points() {
  const Time& now = audited_.current_time();
  Time end = queue_.empty() ? Time(Rational(now.upper() + 1)) : queue_.time_of(queue_.top());
  do {
    const Rational time = simplest_between(now, end);
    places_.clear();
    for (const Vertex_handle v : audited_.vertices_) {
      if (v == Vertex_handle()) {
        places_.emplace_back();  // of no point: nobody asks
        continue;
      }
      const auto position = v->point().position(time);
      places_.emplace_back(Exact_number(position.x), Exact_number(position.y));
    }
    end = Time(time);
  } while (has_touch(end));
}

// Whether a triangle is flat at `time`, where the points have been placed, but not for a while.
template <class KineticTriangulation>
bool Auditor<KineticTriangulation>::has_touch(const Time& time) const {
  if (triangulation_.dimension() < 2) return false;
  const auto after = audited_.traits_.instantaneous_traits({time, Time_side::after});
  return std::ranges::any_of(triangulation_.finite_face_handles(), [&](Face_handle f) {
    return CGAL::collinear(place(f->vertex(0)), place(f->vertex(1)), place(f->vertex(2))) &&
           after.orientation_2_object()(f->vertex(0)->point(), f->vertex(1)->point(),
                                        f->vertex(2)->point()) != CGAL::COLLINEAR;
  });
}

template <class KineticTriangulation>
void Auditor<KineticTriangulation>::check_links() {
  const auto& vertices = audited_.vertices_;
  if (!triangulation_.tds().is_valid()) return fail("the triangulation's links are broken");
  if (triangulation_.number_of_vertices() != audited_.number_of_points()) {
    fail("there are " + std::to_string(audited_.number_of_points()) + " points but " +
         std::to_string(triangulation_.number_of_vertices()) + " vertices");
  }
  for (std::size_t id = 0; id < vertices.size(); ++id) {
    if (audited_.contains(static_cast<Point_id>(id)) && vertices[id]->point().id() != id) {
      fail("the vertex of point " + std::to_string(id) + " holds point " +
           std::to_string(vertices[id]->point().id()));
    }
  }
  if (!queue_.is_valid()) fail("the queue is out of order");
  if (!queue_.empty() && queue_.time_of(queue_.top()) <= audited_.current_time()) {
    fail("the event of " + name(queue_.top().edge()) + " is not in the future");
  }
  if (triangulation_.dimension() < 1) return;
  std::size_t events = 0;
  for (const Edge& edge : triangulation_.all_edges()) {
    const Queue_handle handle = edge.first->event(edge.second);
    const Edge mirror = triangulation_.dimension() == 2 ? triangulation_.mirror_edge(edge) : edge;
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

template <class KineticTriangulation>
void Auditor<KineticTriangulation>::fail(const char* what, const std::array<Vertex_handle, 3>& v) {
  fail(std::string(what) + " " + std::to_string(v[0]->point().id()) + ", " +
       std::to_string(v[1]->point().id()) + ", " + std::to_string(v[2]->point().id()));
}

template <class KineticTriangulation>
void Auditor<KineticTriangulation>::check_embedding() {
  if (triangulation_.dimension() < 2) return check_chain();
  for (const Face_handle f : triangulation_.finite_face_handles()) {
    if (CGAL::orientation(place(f->vertex(0)), place(f->vertex(1)), place(f->vertex(2))) !=
        CGAL::LEFT_TURN) {
      fail("not counterclockwise: triangle", {f->vertex(0), f->vertex(1), f->vertex(2)});
    }
  }
  for (const Edge& edge : triangulation_.all_edges()) {
    if (!triangulation_.is_infinite(edge)) continue;
    const auto turn = audited_.hull_turn(audited_.two_sided(edge));
    if (CGAL::orientation(place(turn[0]), place(turn[1]), place(turn[2])) == CGAL::RIGHT_TURN) {
      fail("the hull is not convex at", turn);
    }
  }
}

// Points on a line form a chain whose faces are its edges; at each inner point the neighbors lie on
// opposite sides.
template <class KineticTriangulation>
void Auditor<KineticTriangulation>::check_chain() {
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

template <class KineticTriangulation>
void Auditor<KineticTriangulation>::check_delaunay() {
  if (triangulation_.dimension() < 2) return;
  for (const Edge& edge : triangulation_.finite_edges()) {
    const auto& [face, i] = edge;
    if (triangulation_.is_infinite(face) || triangulation_.is_infinite(face->neighbor(i))) continue;
    const Vertex_handle opposite = triangulation_.tds().mirror_vertex(face, i);
    if (CGAL::side_of_oriented_circle(place(face->vertex(0)), place(face->vertex(1)),
                                      place(face->vertex(2)),
                                      place(opposite)) == CGAL::ON_POSITIVE_SIDE) {
      fail("not locally Delaunay: " + name(edge) + " between " +
           std::to_string(face->vertex(i)->point().id()) + " and " +
           std::to_string(opposite->point().id()));
    }
  }
}

// Where points stay cocircular the Delaunay triangulation is not unique; then any choice of
// diagonals is right, and only the edges that every choice has are compared, and the number of all.
template <class KineticTriangulation>
void Auditor<KineticTriangulation>::check_reference() {
  std::vector<std::pair<Place, Point_id>> input;
  input.reserve(places_.size());
  for (const Vertex_handle v : audited_.vertices_) {
    if (v != Vertex_handle()) input.emplace_back(place(v), v->point().id());
  }
  Static_triangulation reference;
  reference.insert(input.begin(), input.end());

  const std::vector<Edge_ids> present = audited_.finite_edge_ids();
  std::size_t edges = 0;
  for (const auto& [face, i] : reference.finite_edges()) {
    ++edges;
    const Edge_ids ids = edge_ids(face->vertex(Static_triangulation::cw(i))->info(),
                                  face->vertex(Static_triangulation::ccw(i))->info());
    if (std::ranges::binary_search(present, ids)) continue;
    const bool has_alternative =
        reference.dimension() == 2 && !reference.is_infinite(face) &&
        !reference.is_infinite(face->neighbor(i)) &&
        CGAL::side_of_oriented_circle(
            face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point(),
            reference.tds().mirror_vertex(face, i)->point()) == CGAL::ON_ORIENTED_BOUNDARY;
    if (!has_alternative) {
      fail("missing: " + edge_name(ids) + " of the static Delaunay triangulation");
    }
  }
  if (edges != present.size()) {
    fail("there are " + std::to_string(present.size()) +
         " edges, but the static Delaunay triangulation has " + std::to_string(edges));
  }
}

// The next failure of the edge, computed anew: its kind and its exact time.
template <class KineticTriangulation>
auto Auditor<KineticTriangulation>::next_failure(const Edge& edge, const Traits& traits) const
    -> std::optional<Failure> {
  const auto sides = audited_.two_sided(edge);
  auto [kind, next] = audited_.certificate_of(sides, audited_.current_time(), traits);
  while (next.kind == Certificate::Kind::holds) {
    std::tie(kind, next) = audited_.certificate_of(sides, Time(next.bounds.lower), traits);
  }
  if (next.kind == Certificate::Kind::never_fails) return std::nullopt;
  if (next.failure) return Failure{kind, std::move(*next.failure)};
  return Failure{kind, audited_.failure_time(sides, kind, next.bounds)};
}

template <class KineticTriangulation>
void Auditor<KineticTriangulation>::check_certificates() {
  if (triangulation_.dimension() < 1) return;
  const Traits traits = audited_.traits_.exact();
  for (const Edge& edge : triangulation_.all_edges()) {
    if (triangulation_.dimension() == 1 && triangulation_.is_infinite(edge)) continue;
    const auto failure = next_failure(edge, traits);
    const Queue_handle handle = edge.first->event(edge.second);
    if (handle == no_event) {
      if (failure) fail(name(edge) + " will fail but has no event");
    } else if (queue_[handle].kind == Entry_kind::recheck) {
      if (failure && failure->time <= queue_.time_of(queue_[handle])) {
        fail(name(edge) + " fails before it is checked again");
      }
    } else if (!failure) {
      fail(name(edge) + " has an event but never fails");
    } else if (failure->time != queue_.time_of(queue_[handle]) ||
               failure->kind != queue_[handle].kind) {
      fail(name(edge) + " has an event at another time, or of another kind, than its failure");
    }
  }
}

}  // namespace detail

template <KineticTraits_2 Traits>
Audit_report Kinetic_triangulation_2<Traits>::audit(Audit_level level) const {
  return detail::Auditor<Kinetic_triangulation_2>(*this).run(level);
}

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_AUDIT_IMPL_H
