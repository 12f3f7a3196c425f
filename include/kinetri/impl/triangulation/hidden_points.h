// SPDX-License-Identifier: GPL-3.0-or-later
//
// The hidden points of a kinetic regular triangulation. A hidden point is above the lifted triangle
// in whose projection it is. Its certificate says so: one in-circle certificate, and one
// orientation certificate for each side of the triangle. When a side is reached, the point is
// located anew; when the plane is reached, the point becomes a vertex. A vertex of degree 3 whose
// certificates fail becomes a hidden point.
//
// Where a hidden point is recorded to be need not be right while the events of one time are
// executed: a wrong triangle is a certificate that fails at once, and hidden points come after all
// edges. docs/MATH.md, section 11.
#ifndef KINETRI_IMPL_TRIANGULATION_HIDDEN_POINTS_H
#define KINETRI_IMPL_TRIANGULATION_HIDDEN_POINTS_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri::detail {

/// What is done with the hidden points of a kinetic triangulation, of which it is a part.
template <class Kinetic, class Traits>
class Hidden_points {
 public:
  using Triangulation = typename Kinetic::Triangulation;
  using Vertex_handle = typename Kinetic::Vertex_handle;
  using Face_handle = typename Kinetic::Face_handle;
  using Edge = typename Kinetic::Edge;
  using Point_2 = typename Kinetic::Point_2;
  using Entry = typename Kinetic::Entry;
  using Entry_kind = typename Kinetic::Entry_kind;
  using Two_sided_edge = typename Kinetic::Two_sided_edge;
  using Certificate_points = typename Kinetic::Certificate_points;
  using Location = typename Kinetic::Location;
  using Time = Algebraic_number;

  explicit Hidden_points(Kinetic& kinetic)
      : kinetic_(kinetic), triangulation_(kinetic.triangulation_) {}

  // ---- certificates ----

  /// The certificate of a hidden point from `after` on, and what fails first: the index of an
  /// Entry. The condition `vanishing`, if it is one, vanishes at that time, at which its negation
  /// has failed.
  std::pair<std::uint8_t, Certificate> certificate(Vertex_handle v, const Time& after,
                                                   const Traits& traits,
                                                   Certificate_counters& counters,
                                                   std::uint8_t vanishing = none) const {
    std::pair<std::uint8_t, Certificate> first = {Entry::plane, Certificate()};
    const auto also = [&](std::uint8_t index) {
      const auto state = index == vanishing ? Certificate_state::vanishes : Certificate_state::any;
      Certificate next = certificate(v, index, after, state, traits);
      counters.count(next);
      if (next.kind == Certificate::Kind::never_fails) return;
      if (is_earlier(v, {index, &next}, {first.first, &first.second})) {
        first = {index, std::move(next)};
      }
    };
    also(Entry::plane);
    const int sides = triangulation_.dimension() < 1 ? 0 : triangulation_.dimension() + 1;
    for (int i = 0; i < sides; ++i) also(static_cast<std::uint8_t>(i));
    return first;
  }

  /// What the certificate of a hidden point is about. Precondition: dimension 2.
  static Certificate_points points(Vertex_handle v, std::uint8_t index) {
    const Face_handle face = v->face();
    if (index == Entry::plane) {
      return {Entry_kind::flip,
              {&face->vertex(0)->point(), &face->vertex(1)->point(), &face->vertex(2)->point(),
               &v->point()}};
    }
    return {Entry_kind::hull_remove,
            {&face->vertex(Triangulation::ccw(index))->point(),
             &face->vertex(Triangulation::cw(index))->point(), &v->point()}};
  }

  /// The certificate of an edge of points on a line, whose weights differ: its ends are apart, and
  /// its first vertex is not above the edge between its neighbors. Precondition: dimension 1, the
  /// edge is finite.
  Certificate chain_certificate(const Edge& edge, const Time& after, const Traits& traits) const {
    const Face_handle face = edge.first;
    const Point_2& here = face->vertex(0)->point();
    const Point_2& next = face->vertex(1)->point();
    Certificate apart = traits.meeting_certificate(here, next, after, from(after));
    const Face_handle beside = face->neighbor(1);
    const Vertex_handle previous = beside->vertex(1 - beside->index(face->vertex(0)));
    if (triangulation_.is_infinite(previous)) return apart;
    Certificate below = traits.segment_certificate(next, here, previous->point(), after);
    if (below.kind == Certificate::Kind::never_fails) return apart;
    if (apart.kind == Certificate::Kind::never_fails || *below.failure < *apart.failure) {
      return below;
    }
    return apart;
  }

  // ---- scheduling ----

  /// Schedules the failure of a hidden point's certificate, of which `vanishing` says what
  /// `certificate` says of it. Precondition: it has no entry.
  void schedule(Vertex_handle v, const Time& after, std::uint8_t vanishing = none) {
    auto [index, certificate] =
        this->certificate(v, after, kinetic_.traits_, kinetic_.certificate_counters_, vanishing);
    if (certificate.kind == Certificate::Kind::never_fails) return v->set_event(no_event);
    Entry entry(Edge(v->face(), index), Entry_kind::hidden, certificate);
    entry.hidden = v;
    v->set_event(certificate.failure == nullptr
                     ? kinetic_.queue_.emplace(entry)
                     : kinetic_.queue_.push(entry, std::move(*certificate.failure)));
  }

  /// Schedules the points that a face hides and that have no entry.
  void schedule_in(Face_handle face) {
    for (const Vertex_handle v : face->vertex_list()) {
      if (v->event() == no_event) schedule(v, kinetic_.current_time());
    }
  }

  void unschedule(Vertex_handle v) {
    if (v->event() == no_event) return;
    const Entry entry = kinetic_.queue_.erase(v->event());
    v->set_event(no_event);
    if (entry.kind == Entry_kind::hidden && entry.index == Entry::plane) {
      ++kinetic_.counters_.discarded[static_cast<std::size_t>(Event_kind::reveal)];
    }
  }
  void unschedule_in(Face_handle face) {
    for (const Vertex_handle v : face->vertex_list()) unschedule(v);
  }

  // ---- which triangle hides them ----

  /// Takes the hidden points out of faces that are about to change, and unschedules them.
  std::vector<Vertex_handle> take(std::span<const Face_handle> faces) {
    std::vector<Vertex_handle> result;
    for (const Face_handle face : faces) {
      auto& list = face->vertex_list();
      if (list.empty()) continue;
      unschedule_in(face);
      result.insert(result.end(), list.begin(), list.end());
      list.clear();
    }
    return result;
  }

  /// Puts them into one of the faces each, and schedules them: into the one where they are, if the
  /// faces are where they should be.
  void put(std::span<const Vertex_handle> hidden, std::span<const Face_handle> faces) {
    for (const Vertex_handle v : hidden) {
      const auto around = std::ranges::find_if(
          faces, [&](Face_handle face) { return is_inside(v->point(), face); });
      hide_in(v, around == faces.end() ? faces.front() : *around);
      schedule(v, kinetic_.current_time());
    }
  }

  /// Hides the vertex in the face or, if that is infinite, in the finite one beside it.
  void hide_in(Vertex_handle v, Face_handle face) {
    if (triangulation_.dimension() > 0 && triangulation_.is_infinite(face)) {
      face = face->neighbor(face->index(triangulation_.infinite_vertex()));
    }
    triangulation_.hide(v, face);
    kinetic_.moved_hidden_.push_back(v->point().id());
  }

  // ---- events ----

  /// Finds out what has become of a hidden point whose certificate has failed, and has been taken
  /// from the queue: it moves to another triangle, or becomes a vertex, or neither. The edges are
  /// right just after the present time.
  void execute(const Entry& failure) {
    const Vertex_handle v = failure.hidden;
    v->set_event(no_event);
    if (triangulation_.dimension() < 2) return kinetic_.rebuild();
    const Face_handle face = v->face();
    triangulation_.take_from_face(v);
    if (failure.index != Entry::plane) {
      // It passes a side of its triangle.
      const Two_sided_edge side = kinetic_.two_sided(Edge(face, failure.index));
      const auto& [beyond, i] = side.there;
      if (!triangulation_.is_infinite(beyond)) {
        hide_in(v, beyond);
        return schedule(v, kinetic_.current_time(),
                        kinetic_.rebuilt_edges_ ? none : static_cast<std::uint8_t>(i));
      }
    } else if (failure.changes_sign && is_inside(v->point(), face, true)) {
      return reveal(v, {face, Triangulation::FACE, 0},
                    kinetic_.rebuilt_edges_ ? Certificate_state::any : Certificate_state::vanishes);
    }
    kinetic_.show_current_time();
    place(v, kinetic_.locate(v->point(), face));
  }

  /// Puts a point where it is just after now: a hidden one that is in no face, or one that comes.
  void place(Vertex_handle v, const Location& location) {
    const auto& [face, locus, i] = location;
    const auto hide_now = [&](Face_handle where) {
      if (!v->is_hidden()) kinetic_.rebuilt_points_.push_back({v->point().id(), true});
      hide_in(v, where);
    };
    if (locus == Triangulation::VERTEX) {
      // They stay in one place: the heavier one hides the other.
      const auto side = triangulation_.geom_traits().power_side_of_oriented_power_circle_2_object();
      const bool is_heavier = side(face->vertex(i)->point(), v->point()) == CGAL::ON_POSITIVE_SIDE;
      hide_now(face);
      if (is_heavier) return kinetic_.rebuild();
      return schedule(v, kinetic_.current_time());
    }
    if (is_above(v->point(), location)) {
      hide_now(locus == Triangulation::EDGE && triangulation_.is_infinite(face) ? face->neighbor(i)
                                                                                : face);
      return schedule(v, kinetic_.current_time());
    }
    if (!v->is_hidden()) return kinetic_.put_in(v, location);
    reveal(v, location);
  }

  /// Makes a hidden point, which is in no face, a vertex: event `reveal`. The certificates of its
  /// edges are in the given state.
  void reveal(Vertex_handle v, const Location& location,
              Certificate_state state = Certificate_state::any) {
    report(Event_kind::reveal, v, [&] {
      triangulation_.show(v);
      kinetic_.moved_hidden_.push_back(v->point().id());
      kinetic_.put_in(v, location, state);
    });
  }

  /// The vertex that an edge whose in-circle certificate has failed hides: the end of the edge at
  /// which its quadrilateral is not convex, if it has degree 3. None if the edge can be flipped.
  ///
  ///          c                      c
  ///        / | \                  /   \                                                      .
  ///       /  a  \      ==>       /     \          a is in the triangle b, c, d
  ///      / / | \ \              /       \                                                    .
  ///     d ---+--- b            d ------- b        (the edge is any of the three at a)
  ///
  /// Sets `can_be_flipped` if the quadrilateral is strictly convex just after now, and c and d have
  /// no edge. They may have one while several events of one time are executed, as long as another
  /// triangle is not yet what it is just after that time.
  Vertex_handle hidden_end(const Two_sided_edge& edge, bool& can_be_flipped) {
    const auto& [face, i] = edge.here;
    const auto& [neighbor, j] = edge.there;
    const Vertex_handle a = face->vertex(Triangulation::cw(i));
    const Vertex_handle b = face->vertex(Triangulation::ccw(i));
    const Vertex_handle c = face->vertex(i);
    const Vertex_handle d = neighbor->vertex(j);
    const auto turn_at_a = turn(d->point(), a->point(), c->point());
    const auto turn_at_b = turn(c->point(), b->point(), d->point());
    can_be_flipped = turn_at_a == CGAL::LEFT_TURN && turn_at_b == CGAL::LEFT_TURN &&
                     !triangulation_.is_edge(c, d);
    const auto third = [](Face_handle one, Vertex_handle opposite, Face_handle other) {
      return one->neighbor(one->index(opposite)) == other->neighbor(other->index(opposite));
    };
    if (turn_at_a == CGAL::RIGHT_TURN && third(face, b, neighbor)) return a;
    if (turn_at_b == CGAL::RIGHT_TURN && third(face, a, neighbor)) return b;
    return {};
  }

  /// The hull vertex that the segment of its hull neighbors hides: of the triangle at a hull edge,
  /// flat at this time, that has another hull edge.
  ///
  ///         v
  ///       /   \                                  v reaches the segment from outside and is above
  ///      a --- b     ==>     a ----- b           it: it belongs to no other triangle
  ///       \   /               \     /
  ///         c                    c
  ///
  Vertex_handle hidden_hull_vertex(const Two_sided_edge& hull_edge) const {
    const Face_handle face = kinetic_.hull_triangle(hull_edge).first;
    const auto now =
        kinetic_.traits_.instantaneous_traits({kinetic_.current_time(), Time_side::at});
    for (int i = 0; i < 3; ++i) {
      const int left = Triangulation::ccw(i);
      const int right = Triangulation::cw(i);
      if (triangulation_.is_infinite(face->neighbor(left)) &&
          triangulation_.is_infinite(face->neighbor(right)) &&
          !triangulation_.is_infinite(face->neighbor(i)) &&
          now.collinear_are_strictly_ordered_along_line_2_object()(face->vertex(left)->point(),
                                                                   face->vertex(i)->point(),
                                                                   face->vertex(right)->point())) {
        return face->vertex(i);
      }
    }
    return {};
  }

  /// Hides a vertex of degree 3, of which one neighbor may be the infinite vertex: event `hide`.
  void hide(Vertex_handle v) {
    const bool was_noted = kinetic_.rebuilt_edges_.has_value();
    report(Event_kind::hide, v, [&] {
      std::vector<Face_handle> faces;
      for_each_face_at(triangulation_, v, [&](Face_handle face) { faces.push_back(face); });
      const std::vector<Vertex_handle> hidden = take(faces);
      for (const Face_handle face : faces) kinetic_.unschedule_face(face);
      kinetic_.note_edges_at(v, -1);
      const Vertex_handle stand_in = triangulation_.tds().create_vertex();
      kinetic_.replace_in_faces(v, stand_in);
      const Face_handle face = faces.front();
      triangulation_.tds().remove_degree_3(stand_in, face);
      const std::array<Two_sided_edge, 3> edges = {kinetic_.two_sided(Edge(face, 0)),
                                                   kinetic_.two_sided(Edge(face, 1)),
                                                   kinetic_.two_sided(Edge(face, 2))};
      kinetic_.schedule(edges, kinetic_.current_time());
      put(hidden, {&face, 1});
      // Beyond the hull the sign of its certificate is another one.
      const bool is_inner = !triangulation_.is_infinite(face);
      hide_in(v, face);
      schedule(v, kinetic_.current_time(), is_inner && !was_noted ? Entry::plane : none);
    });
  }

  /// Reports that a point is hidden or revealed by `change`, which does it, and the edges that come
  /// or go with it.
  template <class Change>
  void report(Event_kind kind, Vertex_handle v, const Change& change) {
    ++kinetic_.changes_;
    if (kinetic_.rebuilt_edges_) {
      kinetic_.rebuilt_points_.push_back({v->point().id(), kind == Event_kind::hide});
      return change();
    }
    Event event;
    event.kind = kind;
    event.point_a = v->point().id();
    kinetic_.report(event, [&] {
      kinetic_.rebuilt_edges_.emplace();
      change();
    });
    kinetic_.report_rebuild();
  }

  // ---- changes ----

  /// Throws if the point would have the trajectory and the weight of another one that does not
  /// change; `changed` are those that do, sorted.
  void check_is_new(const Point_2& point, const Location& location,
                    std::span<const Point_id> changed) const {
    const auto check = [&](Vertex_handle v) {
      if (triangulation_.is_infinite(v)) return;
      const Point_id other = v->point().id();
      if (other == point.id() || std::ranges::binary_search(changed, other) ||
          !same_trajectory(v->point().motion(), point.motion())) {
        return;
      }
      throw Coincident_trajectories_error(std::min(other, point.id()), std::max(other, point.id()));
    };
    const auto check_in = [&](Face_handle face) {
      for (const Vertex_handle v : face->vertex_list()) check(v);
    };
    const auto& [face, locus, i] = location;
    check_in(face);
    if (locus == Triangulation::EDGE) check_in(face->neighbor(i));
    if (locus != Triangulation::VERTEX) return;
    check(face->vertex(i));
    for_each_face_at(triangulation_, face->vertex(i), check_in);
  }

  /// Whether the point is not below the lifted triangle where it is. False beyond the hull.
  bool is_above(const Point_2& point, const Location& location) const {
    auto [face, locus, i] = location;
    if (triangulation_.is_infinite(face)) {
      if (locus != Triangulation::EDGE) return false;
      face = face->neighbor(i);
    }
    const auto side = triangulation_.geom_traits().power_side_of_oriented_power_circle_2_object();
    return side(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point(),
                point) != CGAL::ON_POSITIVE_SIDE;
  }

  /// As an index: no condition.
  static constexpr std::uint8_t none = Entry::plane + 1;

 private:
  static Double_interval from(const Time& time) {
    return {time.interval().lower, std::numeric_limits<double>::infinity()};
  }

  struct Condition {
    std::uint8_t index;
    const Certificate* certificate;
  };

  // In dimension 2 the condition of a side or of the plane. Below, of the segment or vertex that
  // hides the point (`plane`), or of an end of the segment.
  Certificate certificate(Vertex_handle v, std::uint8_t index, const Time& after,
                          Certificate_state state, const Traits& traits) const {
    const Face_handle face = v->face();
    const Point_2& point = v->point();
    if (triangulation_.dimension() == 2) {
      const auto [kind, about] = points(v, index);
      const auto& [p, q, r, s] = about;
      return kind == Entry_kind::flip ? traits.in_circle_certificate(*p, *q, *r, *s, after, state)
                                      : traits.orientation_certificate(*p, *q, *r, after, state);
    }
    if (triangulation_.dimension() < 1) {
      return traits.weight_certificate(triangulation_.finite_vertex()->point(), point, after);
    }
    const Point_2& first = face->vertex(0)->point();
    const Point_2& second = face->vertex(1)->point();
    if (index == Entry::plane) return traits.hiding_certificate(first, point, second, after);
    return traits.meeting_certificate(index == 0 ? first : second, point, after, from(after));
  }

  // Whether the first fails, or is to be checked again, before the second.
  bool is_earlier(Vertex_handle v, const Condition& a, const Condition& b) const {
    if (b.certificate->kind == Certificate::Kind::never_fails) return true;
    if (a.certificate->bounds.upper < b.certificate->bounds.lower) return true;
    if (a.certificate->bounds.lower > b.certificate->bounds.upper) return false;
    const auto time = [&](const Condition& condition) {
      const auto& [index, certificate] = condition;
      if (certificate->kind == Certificate::Kind::holds) return Time(certificate->bounds.lower);
      return certificate->failure ? *certificate->failure
                                  : kinetic_.failure_time(points(v, index), certificate->bounds);
    };
    return time(a) < time(b);
  }

  // The turn just after now.
  Sign turn(const Point_2& p, const Point_2& q, const Point_2& r) const {
    const Sign certain = kinetic_.traits_.certain_turn(p, q, r, kinetic_.current_bounds());
    if (certain != CGAL::ZERO) return certain;
    kinetic_.show_current_time();
    return triangulation_.geom_traits().orientation_2_object()(p, q, r);
  }

  bool is_inside(const Point_2& point, Face_handle face, bool strictly = false) const {
    if (triangulation_.is_infinite(face)) return false;
    for (int i = 0; i < 3; ++i) {
      const Sign side = turn(face->vertex(Triangulation::ccw(i))->point(),
                             face->vertex(Triangulation::cw(i))->point(), point);
      if (side == CGAL::NEGATIVE || (strictly && side == CGAL::ZERO)) return false;
    }
    return true;
  }

  Kinetic& kinetic_;
  decltype((std::declval<Kinetic&>().triangulation_)) triangulation_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_HIDDEN_POINTS_H
