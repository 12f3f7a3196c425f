// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/event_certificates.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri {
namespace {

std::string_view reason_without(const Event& event) {
  switch (event.kind) {
    case Event_kind::rebuild:
      return "the edges of this time come and go together: nothing fails for one of them";
    case Event_kind::insert:
      return "a point is inserted: nothing fails";
    case Event_kind::erase:
      return "a point is erased: nothing fails";
    case Event_kind::trajectory:
      return "a point gets another motion: nothing fails";
    case Event_kind::hide:
    case Event_kind::reveal:
      if (event.point_b) return "two points coincide from now on, or until now: nothing fails";
      return "the triangulation is built anew at this time: nothing fails for one point";
    case Event_kind::collision:
      return "the discs overlap and approach from the time on at which one got its motion, which "
             "is this time";
    default:
      return "the polynomial is negative from the time on at which its points got together, which "
             "is this time";
  }
}

// The points of an event without a failure.
std::vector<Point_id> points_named(const Event& event) {
  std::vector<Point_id> result;
  for (const auto& edge : {event.removed, event.added}) {
    if (!edge) continue;
    for (const Point_id id : *edge) result.push_back(id);
  }
  for (const auto& point : {event.point_a, event.point_b}) {
    if (point) result.push_back(*point);
  }
  return result;
}

}  // namespace

namespace detail {

// Follows which certificates there are, and since when.
template <class Traits>
class Certificate_finder {
 public:
  using Triangulation = typename Event_certificates<Traits>::Triangulation;
  using Function = typename Event_certificates<Traits>::Function;

  Certificate_finder(const Triangulation& triangulation, const Simulation_options& options,
                     Function function);

  void before_event(const Event& event);
  void after_event(const Event& event);
  void after_rebuild(const Algebraic_number& time, std::span<const Edge_ids> edges);
  void after_hiding(const Algebraic_number& time, std::span<const Point_id> points);

 private:
  using Point_2 = typename Traits::Point_2;
  using Motion = typename Traits::Motion;
  using Cgal = typename Triangulation::Triangulation;
  using Edge = typename Triangulation::Edge;
  using Sides = std::array<Point_id, 2>;
  using Triple = std::array<Point_id, 3>;

  /// A time, and the number of times recorded before it.
  struct Moment {
    std::uint64_t number = 0;
    Algebraic_number time;
  };
  /// An edge with the points opposite it, or a hidden point with the triangle that hides it. Points
  /// that coincide with the one that hides them have no certificate.
  template <class Beside>
  struct Watched {
    Watched(const Beside& b, const Moment& m) : beside(b), since(m) {}
    Beside beside;
    Moment since;
  };
  /// A polynomial that must not be negative from a time on.
  struct Condition {
    std::vector<Point_id> points;
    Polynomial polynomial;
    Algebraic_number since;
  };

  const Point_2& point(Point_id id) const { return triangulation_.point(id); }
  void set_now(const Algebraic_number& time);
  const Moment& latest(const Moment& moment, std::span<const Point_id> points) const;

  static Edge_ids ids_of(const Edge& edge);
  Sides opposite(const Edge& edge) const;
  std::optional<Edge> find_edge(const Edge_ids& ids) const;
  Triple hiding_triangle(Point_id id) const;
  void watch(const Edge& edge);
  void watch_around(Point_id id);
  void watch_hidden(Point_id id);
  void replace_beside(Point_id a, Point_id b, Point_id before, Point_id after);
  void follow_flip(const Event& event);
  void follow_contact(const Edge_ids& pair);

  Condition condition(std::vector<Point_id> points, const Moment& since) const;
  Condition condition_of_edge(const Edge_ids& ids) const;
  Condition condition_of_vertex(Point_id id) const;
  std::vector<Condition> conditions_of_hidden(Point_id id) const;
  std::vector<Condition> conditions_of_walls(Point_id id) const;
  std::vector<Condition> conditions_of_pair(const Edge_ids& pair) const;
  std::vector<Condition> conditions(const Event& event) const;

  const Triangulation& triangulation_;
  Function function_;
  double diameter_;
  std::vector<Wall_2> walls_;
  Moment start_;
  Moment now_;
  // Edges of the triangulation, infinite ones too, if it has dimension 2. The infinite vertex has
  // the id no_point.
  std::map<Edge_ids, Watched<Sides>> edges_;
  std::map<Point_id, Watched<Triple>> hidden_;
  std::map<Point_id, Moment> motions_;  // the begin of motions, if not the start
  std::map<Edge_ids, Moment> touched_;  // the last contacts at which discs kept their motions
  Event_certificate certificate_;       // of the event that is about to happen
  std::vector<Motion> motions_before_;  // of the discs that are about to touch
};

template <class Traits>
Certificate_finder<Traits>::Certificate_finder(const Triangulation& triangulation,
                                               const Simulation_options& options, Function function)
    : triangulation_(triangulation),
      function_(std::move(function)),
      diameter_(2 * options.radius),
      start_{0, triangulation.current_time()},
      now_(start_) {
  constexpr bool has_radii = HasWeight<typename Traits::Motion>;
  if (options.box) {
    for (Wall_2 wall : options.box->walls(options.rim_touches ? options.radius : 0)) {
      wall.rim_touches = has_radii && options.rim_touches;
      walls_.push_back(wall);
    }
  }
  if (triangulation_.triangulation().dimension() < 2) return;
  for (const Edge& edge : triangulation_.triangulation().all_edges()) watch(edge);
  if (triangulation_.number_of_hidden_points() == 0) return;
  for (Point_id id = 0; id < triangulation_.next_id(); ++id) watch_hidden(id);
}

// ---- times ----

template <class Traits>
void Certificate_finder<Traits>::set_now(const Algebraic_number& time) {
  if (time != now_.time) now_ = {now_.number + 1, time};
}

// The latest of the moment and those at which the points got their motions.
template <class Traits>
auto Certificate_finder<Traits>::latest(const Moment& moment,
                                        std::span<const Point_id> points) const -> const Moment& {
  const Moment* result = &moment;
  for (const Point_id id : points) {
    const auto since = motions_.find(id);
    if (since != motions_.end() && since->second.number > result->number) result = &since->second;
  }
  return *result;
}

// ---- neighborhoods of edges and hidden points ----

template <class Traits>
Edge_ids Certificate_finder<Traits>::ids_of(const Edge& edge) {
  const auto& [face, i] = edge;
  return edge_ids(face->vertex(Cgal::cw(i))->point().id(),
                  face->vertex(Cgal::ccw(i))->point().id());
}

// The points opposite the edge: left and right of it, directed from the smaller id to the greater.
// So an inverted triangle is a different one.
template <class Traits>
auto Certificate_finder<Traits>::opposite(const Edge& edge) const -> Sides {
  const auto& [face, i] = edge;
  const Point_id apex = face->vertex(i)->point().id();
  const Point_id beyond = triangulation_.triangulation().mirror_vertex(face, i)->point().id();
  const bool is_left =
      face->vertex(Cgal::ccw(i))->point().id() < face->vertex(Cgal::cw(i))->point().id();
  return is_left ? Sides{apex, beyond} : Sides{beyond, apex};
}

// The edge of two points, of which the second may be infinite, if there is one.
template <class Traits>
auto Certificate_finder<Traits>::find_edge(const Edge_ids& ids) const -> std::optional<Edge> {
  const Cgal& triangulation = triangulation_.triangulation();
  const auto is_there = [&](Point_id id) {
    return id == no_point || (triangulation_.contains(id) && !triangulation_.is_hidden(id));
  };
  if (!is_there(ids[0]) || !is_there(ids[1])) return std::nullopt;
  const auto vertex = [&](Point_id id) {
    return id == no_point ? triangulation.infinite_vertex() : triangulation_.vertex(id);
  };
  Edge edge;
  if (!triangulation.is_edge(vertex(ids[0]), vertex(ids[1]), edge.first, edge.second)) {
    return std::nullopt;
  }
  return edge;
}

template <class Traits>
void Certificate_finder<Traits>::watch(const Edge& edge) {
  const Sides beside = opposite(edge);
  const auto [watched, is_new] = edges_.try_emplace(ids_of(edge), beside, now_);
  if (!is_new && watched->second.beside != beside) watched->second = {beside, now_};
}

// The edges of the triangles of a point.
template <class Traits>
void Certificate_finder<Traits>::watch_around(Point_id id) {
  const Edge_ids to_infinity = {id, no_point};
  if (!find_edge(to_infinity)) edges_.erase(to_infinity);
  if (!triangulation_.contains(id) || triangulation_.is_hidden(id)) return;
  for_each_face_at(triangulation_.triangulation(), triangulation_.vertex(id),
                   [this](auto face, int i) {
                     watch(Edge(face, i));
                     watch(Edge(face, Cgal::cw(i)));
                   });
}

// The corners of the triangle that hides a point, counterclockwise, the least id first.
template <class Traits>
auto Certificate_finder<Traits>::hiding_triangle(Point_id id) const -> Triple {
  const auto face = triangulation_.vertex(id)->face();
  Triple result;
  for (int i = 0; i < 3; ++i) {
    result[static_cast<std::size_t>(i)] = face->vertex(i)->point().id();
  }
  std::rotate(result.begin(), std::ranges::min_element(result), result.end());
  return result;
}

template <class Traits>
void Certificate_finder<Traits>::watch_hidden(Point_id id) {
  const bool is_in_triangle = triangulation_.contains(id) && triangulation_.is_hidden(id) &&
                              triangulation_.vertex(id)->point().id() == id;
  if (!is_in_triangle || triangulation_.triangulation().dimension() < 2) {
    hidden_.erase(id);
    return;
  }
  const Triple triangle = hiding_triangle(id);
  const auto [watched, is_new] = hidden_.try_emplace(id, triangle, now_);
  if (!is_new && watched->second.beside != triangle) watched->second = {triangle, now_};
}

template <class Traits>
void Certificate_finder<Traits>::replace_beside(Point_id a, Point_id b, Point_id before,
                                                Point_id after) {
  auto& [beside, since] = edges_.at(edge_ids(a, b));
  beside[beside[0] == before ? 0 : 1] = after;
  since = now_;
}

// A flip of an edge; one end may be infinite, at hull events.
template <class Traits>
void Certificate_finder<Traits>::follow_flip(const Event& event) {
  const Edge_ids to_infinity = {event.apex.value_or(no_point), no_point};
  const auto [a, b] = event.removed.value_or(to_infinity);
  const auto [c, d] = event.added.value_or(to_infinity);
  const bool c_is_left = edges_.at({a, b}).beside[0] == c;
  edges_.erase({a, b});
  edges_.insert_or_assign({c, d}, Watched<Sides>(c_is_left ? Sides{b, a} : Sides{a, b}, now_));
  replace_beside(a, c, b, d);
  replace_beside(a, d, b, c);
  replace_beside(b, c, a, d);
  replace_beside(b, d, a, c);
}

// ---- polynomials ----

template <class Traits>
auto Certificate_finder<Traits>::condition(std::vector<Point_id> points, const Moment& since) const
    -> Condition {
  const auto at = [&](std::size_t i) -> const Point_2& { return point(points[i]); };
  Polynomial polynomial = points.size() == 4
                              ? -perturbed_in_circle_polynomial(at(0), at(1), at(2), at(3))
                              : orientation_polynomial(at(0), at(1), at(2));
  const Algebraic_number& time = latest(since, points).time;
  return {std::move(points), std::move(polynomial), time};
}

// The condition that the edge belongs to the triangulation, as in Kinetic_triangulation_2.
template <class Traits>
auto Certificate_finder<Traits>::condition_of_edge(const Edge_ids& ids) const -> Condition {
  const std::optional<Edge> edge = find_edge(ids);
  KINETRI_ASSERT(edge, "an edge that is about to change is there");
  const auto& [face, i] = *edge;
  const auto beyond = triangulation_.triangulation().mirror_vertex(face, i)->point().id();
  const Point_id apex = face->vertex(i)->point().id();
  const Point_id left = face->vertex(Cgal::cw(i))->point().id();
  const Point_id right = face->vertex(Cgal::ccw(i))->point().id();
  std::vector<Point_id> points;
  if (right == no_point) {
    points = {apex, left, beyond};
  } else if (left == no_point) {
    points = {beyond, right, apex};
  } else if (apex == no_point) {
    points = {left, right, beyond};
  } else if (beyond == no_point) {
    points = {right, left, apex};
  } else if (right < left) {
    points = {right, left, apex, beyond};
  } else {
    points = {left, right, beyond, apex};
  }
  return condition(std::move(points), edges_.at(ids).since);
}

// The condition that the vertex is not hidden: that of any of its edges, since it has three
// neighbors, of which one may be infinite.
template <class Traits>
auto Certificate_finder<Traits>::condition_of_vertex(Point_id id) const -> Condition {
  Point_id neighbor = no_point;
  for_each_neighbor(triangulation_.triangulation(), triangulation_.vertex(id),
                    [&](auto v) { neighbor = std::min(neighbor, v->point().id()); });
  return condition_of_edge(edge_ids(id, neighbor));
}

// The conditions that the point is above the triangle that hides it, and does not leave it.
template <class Traits>
auto Certificate_finder<Traits>::conditions_of_hidden(Point_id id) const -> std::vector<Condition> {
  const Triple triangle = hiding_triangle(id);
  const auto watched = hidden_.find(id);
  const Moment& since =
      watched != hidden_.end() && watched->second.beside == triangle ? watched->second.since : now_;
  std::vector<Condition> result = {condition({triangle[0], triangle[1], triangle[2], id}, since)};
  for (std::size_t i = 0; i < 3; ++i) {
    result.push_back(condition({triangle[i], triangle[(i + 1) % 3], id}, since));
  }
  return result;
}

template <class Traits>
auto Certificate_finder<Traits>::conditions_of_walls(Point_id id) const -> std::vector<Condition> {
  const Algebraic_number& since = latest(start_, {&id, 1}).time;
  std::vector<Condition> result;
  for (const Wall_2& wall : walls_) {
    result.push_back({{id}, wall_polynomial(point(id), wall), since});
  }
  return result;
}

// The conditions that the discs are apart, since they last separated; or, if they overlap, that
// they separate.
template <class Traits>
auto Certificate_finder<Traits>::conditions_of_pair(const Edge_ids& pair) const
    -> std::vector<Condition> {
  const auto touched = touched_.find(pair);
  const Algebraic_number& since =
      latest(touched == touched_.end() ? start_ : touched->second, pair).time;
  Polynomial apart = contact_polynomial(point(pair[0]), point(pair[1]), diameter_);
  Algebraic_number parted = since;
  if (!apart.is_zero()) {
    for (const Real_root& root : real_roots(apart)) {
      if (root.multiplicity % 2 == 1 && root.value > since && root.value < now_.time) {
        parted = root.value;
      }
    }
  }
  Polynomial parting = derivative(apart);
  const std::vector<Point_id> points(pair.begin(), pair.end());
  return {{points, std::move(apart), parted}, {points, std::move(parting), since}};
}

template <class Traits>
auto Certificate_finder<Traits>::conditions(const Event& event) const -> std::vector<Condition> {
  switch (event.kind) {
    case Event_kind::flip:
    case Event_kind::hull_insert:
      return {condition_of_edge(*event.removed)};
    case Event_kind::hull_remove:
      return {condition_of_edge({*event.apex, no_point})};
    case Event_kind::hide:
      // After a reconstruction, its results are reported.
      if (triangulation_.is_hidden(*event.point_a)) return {};
      return {condition_of_vertex(*event.point_a)};
    case Event_kind::reveal:
      if (!triangulation_.is_hidden(*event.point_a)) return {};
      return conditions_of_hidden(*event.point_a);
    case Event_kind::wall:
      return conditions_of_walls(*event.point_a);
    case Event_kind::collision:
      return conditions_of_pair({*event.point_a, *event.point_b});
    default:
      return {};
  }
}

// ---- events ----

template <class Traits>
void Certificate_finder<Traits>::before_event(const Event& event) {
  set_now(event.time);
  certificate_ = {event.number, event.kind, points_named(event), std::nullopt, {}};
  const std::vector<Condition> all = conditions(event);
  for (const auto& [points, polynomial, since] : all) {
    certificate_.failure = certify_failure(polynomial, since, event.time);
    if (certificate_.failure) {
      certificate_.points = points;
      break;
    }
  }
  if (!certificate_.failure) {
    KINETRI_ASSERT(
        std::ranges::all_of(all, [&](const Condition& c) { return c.since == event.time; }),
        "an event is the failure of a certificate");
    certificate_.reason = reason_without(event);
  }
  motions_before_.clear();
  if (event.kind != Event_kind::collision) return;
  for (const Point_id id : {*event.point_a, *event.point_b}) {
    motions_before_.push_back(triangulation_.motion(id));
  }
}

template <class Traits>
void Certificate_finder<Traits>::after_event(const Event& event) {
  switch (event.kind) {
    case Event_kind::flip:
    case Event_kind::hull_insert:
    case Event_kind::hull_remove:
      follow_flip(event);
      break;
    case Event_kind::wall:
    case Event_kind::insert:
    case Event_kind::trajectory:
      motions_.insert_or_assign(*event.point_a, now_);
      break;
    case Event_kind::erase:
      motions_.erase(*event.point_a);
      hidden_.erase(*event.point_a);
      break;
    case Event_kind::collision:
      follow_contact({*event.point_a, *event.point_b});
      break;
    default:
      break;
  }
  function_(certificate_);
}

template <class Traits>
void Certificate_finder<Traits>::follow_contact(const Edge_ids& pair) {
  bool have_changed = false;
  for (const std::size_t i : {0U, 1U}) {
    const Point_id id = pair[i];
    if (!triangulation_.contains(id)) {
      motions_.erase(id);
      hidden_.erase(id);
    } else if (triangulation_.motion(id) == motions_before_[i]) {
      continue;
    } else {
      motions_.insert_or_assign(id, now_);
    }
    have_changed = true;
  }
  if (have_changed) {
    touched_.erase(pair);
  } else {
    touched_.insert_or_assign(pair, now_);
  }
}

template <class Traits>
void Certificate_finder<Traits>::after_rebuild(const Algebraic_number& time,
                                               std::span<const Edge_ids> edges) {
  set_now(time);
  if (triangulation_.triangulation().dimension() < 2) return edges_.clear();
  // A new triangle has corners that have got or lost an edge.
  std::set<Point_id> ends;
  for (const Edge_ids& edge : edges) {
    if (!find_edge(edge)) edges_.erase(edge);
    ends.insert(edge.begin(), edge.end());
  }
  for (const Point_id id : ends) watch_around(id);
}

template <class Traits>
void Certificate_finder<Traits>::after_hiding(const Algebraic_number& time,
                                              std::span<const Point_id> points) {
  set_now(time);
  for (const Point_id id : points) watch_hidden(id);
}

}  // namespace detail

template <class Traits>
Event_certificates<Traits>::Event_certificates(const Triangulation& triangulation,
                                               const Simulation_options& options, Function function)
    : finder_(std::make_unique<detail::Certificate_finder<Traits>>(triangulation, options,
                                                                   std::move(function))) {}

template <class Traits>
Event_certificates<Traits>::~Event_certificates() = default;

template <class Traits>
void Event_certificates<Traits>::before_event(const Event& event) {
  finder_->before_event(event);
}

template <class Traits>
void Event_certificates<Traits>::after_event(const Event& event) {
  finder_->after_event(event);
}

template <class Traits>
void Event_certificates<Traits>::after_rebuild(const Algebraic_number& time,
                                               std::span<const Edge_ids> edges) {
  finder_->after_rebuild(time, edges);
}

template <class Traits>
void Event_certificates<Traits>::after_hiding(const Algebraic_number& time,
                                              std::span<const Point_id> points) {
  finder_->after_hiding(time, points);
}

template class Event_certificates<Linear_kinetic_traits_2>;
template class Event_certificates<Polynomial_kinetic_traits_2>;
template class Event_certificates<Disc_kinetic_traits_2>;
template class Event_certificates<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri
