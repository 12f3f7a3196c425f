// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/event_certificates.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "simulation/named_faces.h"

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
  using Faces = Named_faces<Traits>;
  using Edge = typename Faces::Edge;
  using Edge_name = typename Faces::Edge_name;
  using Neighbor = typename Faces::Neighbor;
  using Sides = typename Faces::Sides;
  using Triple = typename Faces::Triple;
  static constexpr bool is_periodic = Faces::is_periodic;

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
  /// A polynomial that must not be negative from a time on. In a periodic box it is about images,
  /// as one of them sees the others.
  struct Condition {
    std::vector<Neighbor> points;
    Polynomial polynomial;
    Algebraic_number since;
  };

  // What polynomials are about.
  decltype(auto) image(const Neighbor& point) const {
    if constexpr (is_periodic) {
      return triangulation_.traits().image(triangulation_.point(point.id), point.offset);
    } else {
      return triangulation_.point(point);
    }
  }
  static Neighbor itself(Point_id id) {
    if constexpr (is_periodic) {
      return {id, {}};
    } else {
      return id;
    }
  }
  void set_now(const Algebraic_number& time);
  const Moment& latest(const Moment& moment, std::span<const Neighbor> points) const;

  static Edge_name removed_edge(const Event& event);
  static Edge_name discs_of(const Event& event);
  void watch(const Edge& edge);
  void watch_around(Point_id id);
  void watch_hidden(Point_id id);
  void replace_beside(const Neighbor& from, const Neighbor& to, const Neighbor& left);
  void follow_flip(const Event& event);
  void follow_contact(const Edge_name& pair);
  void forget_edges(const Edge_ids& ids);

  Condition condition(std::vector<Neighbor> points, const Moment& since) const;
  Condition condition_of_edge(const Edge_name& name) const;
  std::vector<Condition> conditions_of_hidden(Point_id id) const;
  std::vector<Condition> conditions_of_walls(Point_id id) const;
  std::vector<Condition> conditions_of_pair(const Edge_name& pair) const;
  std::vector<Condition> conditions(const Event& event) const;

  const Triangulation& triangulation_;
  Faces faces_;
  Function function_;
  double diameter_;
  std::vector<Wall_2> walls_;
  Moment start_;
  Moment now_;
  // Edges of the triangulation, infinite ones too, if it has dimension 2.
  std::map<Edge_name, Watched<Sides>> edges_;
  std::map<Point_id, Watched<Triple>> hidden_;
  std::map<Point_id, Moment> motions_;   // the begin of motions, if not the start
  std::map<Edge_name, Moment> touched_;  // the last contacts at which discs kept their motions
  Event_certificate certificate_;        // of the event that is about to happen
  std::vector<Motion> motions_before_;   // of the discs that are about to touch
};

template <class Traits>
Certificate_finder<Traits>::Certificate_finder(const Triangulation& triangulation,
                                               const Simulation_options& options, Function function)
    : triangulation_(triangulation),
      faces_(triangulation),
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
                                        std::span<const Neighbor> points) const -> const Moment& {
  const Moment* result = &moment;
  for (const Neighbor& point : points) {
    const auto since = motions_.find(id_of(point));
    if (since != motions_.end() && since->second.number > result->number) result = &since->second;
  }
  return *result;
}

// ---- neighborhoods of edges and hidden points ----

template <class Traits>
auto Certificate_finder<Traits>::removed_edge(const Event& event) -> Edge_name {
  if constexpr (is_periodic) {
    return {*event.removed, event.removed_offset};
  } else {
    return event.removed.value_or(Edge_ids{event.apex.value_or(no_point), no_point});
  }
}

// The two that touch, in the order of pairs.
template <class Traits>
auto Certificate_finder<Traits>::discs_of(const Event& event) -> Edge_name {
  if constexpr (is_periodic) {
    return pair_of(*event.point_a, Neighbor{*event.point_b, event.added_offset});
  } else {
    return {*event.point_a, *event.point_b};
  }
}

template <class Traits>
void Certificate_finder<Traits>::watch(const Edge& edge) {
  const Sides beside = faces_.opposite(edge);
  const auto [watched, is_new] = edges_.try_emplace(Faces::name(edge), beside, now_);
  if (!is_new && watched->second.beside != beside) watched->second = {beside, now_};
}

// The edges of the triangles of a point.
template <class Traits>
void Certificate_finder<Traits>::watch_around(Point_id id) {
  if constexpr (!is_periodic) {
    const Edge_ids to_infinity = {id, no_point};
    if (!faces_.find(to_infinity)) edges_.erase(to_infinity);
  }
  if (!triangulation_.contains(id) || triangulation_.is_hidden(id)) return;
  faces_.for_each_edge_around(id, [this](const Edge& edge) { watch(edge); });
}

template <class Traits>
void Certificate_finder<Traits>::watch_hidden(Point_id id) {
  const bool is_in_triangle = triangulation_.contains(id) && triangulation_.is_hidden(id) &&
                              triangulation_.vertex(id)->point().id() == id;
  if (!is_in_triangle || triangulation_.triangulation().dimension() < 2) {
    hidden_.erase(id);
    return;
  }
  if constexpr (HasWeight<Motion>) {
    const Triple triangle = faces_.hiding_triangle(id);
    const auto [watched, is_new] = hidden_.try_emplace(id, triangle, now_);
    if (!is_new && watched->second.beside != triangle) watched->second = {triangle, now_};
  }
}

// The triangle to the left of an edge, directed in this way, has another corner. The three see one
// another as one point sees them.
template <class Traits>
void Certificate_finder<Traits>::replace_beside(const Neighbor& from, const Neighbor& to,
                                                const Neighbor& left) {
  const bool is_directed = is_first(id_of(from), seen_from(from, to));
  const Neighbor& first = is_directed ? from : to;
  const Neighbor& second = is_directed ? to : from;
  auto& [beside, since] = edges_.at(pair_from(id_of(first), seen_from(first, second)));
  beside[is_directed ? 0 : 1] = seen_from(first, left);
  since = now_;
}

// A flip of an edge; one end may be infinite, at hull events. Its first end a sees the
// quadrilateral a, right, b, left.
template <class Traits>
void Certificate_finder<Traits>::follow_flip(const Event& event) {
  const Edge_name name = removed_edge(event);
  const Neighbor a = itself(ids_of(name)[0]);
  const Neighbor b = second_of(name);
  const auto [left, right] = edges_.at(name).beside;
  edges_.erase(name);
  const bool left_is_first = is_first(id_of(left), seen_from(left, right));
  const Neighbor& first = left_is_first ? left : right;
  const Sides beside = left_is_first ? Sides{seen_from(first, b), seen_from(first, a)}
                                     : Sides{seen_from(first, a), seen_from(first, b)};
  edges_.insert_or_assign(pair_of(id_of(left), seen_from(left, right)),
                          Watched<Sides>(beside, now_));
  replace_beside(a, right, left);
  replace_beside(right, b, left);
  replace_beside(b, left, right);
  replace_beside(left, a, right);
}

// Forgets edges between these two that do not exist.
template <class Traits>
void Certificate_finder<Traits>::forget_edges(const Edge_ids& ids) {
  if constexpr (is_periodic) {
    constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    auto edge = edges_.lower_bound(Edge_name{ids, {least, least}});
    while (edge != edges_.end() && edge->first.ids == ids) {
      edge = faces_.find(edge->first) ? std::next(edge) : edges_.erase(edge);
    }
  } else {
    if (!faces_.find(ids)) edges_.erase(ids);
  }
}

// ---- polynomials ----

template <class Traits>
auto Certificate_finder<Traits>::condition(std::vector<Neighbor> points, const Moment& since) const
    -> Condition {
  const auto at = [&](std::size_t i) -> decltype(auto) { return image(points[i]); };
  Polynomial polynomial = points.size() == 4
                              ? -perturbed_in_circle_polynomial(at(0), at(1), at(2), at(3))
                              : orientation_polynomial(at(0), at(1), at(2));
  const Algebraic_number& time = latest(since, points).time;
  return {std::move(points), std::move(polynomial), time};
}

// The condition that the edge belongs to the triangulation, as in Kinetic_triangulation_2.
template <class Traits>
auto Certificate_finder<Traits>::condition_of_edge(const Edge_name& name) const -> Condition {
  const std::optional<Edge> edge = faces_.find(name);
  KINETRI_ASSERT(edge, "an edge that is about to change is there");
  const Neighbor first = itself(ids_of(name)[0]);
  const Neighbor second = second_of(name);
  const auto [left, right] = faces_.opposite(*edge);
  std::vector<Neighbor> points = {first, second, left, right};
  // Without an infinite point, the others turn left.
  if (id_of(second) == no_point) {
    points = {right, first, left};
  } else if (id_of(left) == no_point) {
    points = {second, first, right};
  } else if (id_of(right) == no_point) {
    points = {first, second, left};
  }
  return condition(std::move(points), edges_.at(name).since);
}

// The conditions that the point is above the triangle that hides it and, in the plane, does not
// leave it.
template <class Traits>
auto Certificate_finder<Traits>::conditions_of_hidden(Point_id id) const -> std::vector<Condition> {
  const Triple triangle = faces_.hiding_triangle(id);
  const auto watched = hidden_.find(id);
  const Moment& since =
      watched != hidden_.end() && watched->second.beside == triangle ? watched->second.since : now_;
  const Neighbor point = itself(id);
  std::vector<Condition> result = {
      condition({triangle[0], triangle[1], triangle[2], point}, since)};
  if constexpr (!is_periodic) {
    for (std::size_t i = 0; i < 3; ++i) {
      result.push_back(condition({triangle[i], triangle[(i + 1) % 3], point}, since));
    }
  }
  return result;
}

template <class Traits>
auto Certificate_finder<Traits>::conditions_of_walls(Point_id id) const -> std::vector<Condition> {
  std::vector<Condition> result;
  if constexpr (!is_periodic) {
    const Algebraic_number& since = latest(start_, {&id, 1}).time;
    for (const Wall_2& wall : walls_) {
      result.push_back({{id}, wall_polynomial(image(id), wall), since});
    }
  }
  return result;
}

// The conditions that the discs are apart, since they last separated; or, if they overlap, that
// they separate.
template <class Traits>
auto Certificate_finder<Traits>::conditions_of_pair(const Edge_name& pair) const
    -> std::vector<Condition> {
  const auto touched = touched_.find(pair);
  const std::vector<Neighbor> points = {itself(ids_of(pair)[0]), second_of(pair)};
  const Algebraic_number& since =
      latest(touched == touched_.end() ? start_ : touched->second, points).time;
  Polynomial apart = contact_polynomial(image(points[0]), image(points[1]), diameter_);
  Algebraic_number parted = since;
  if (!apart.is_zero()) {
    for (const Real_root& root : real_roots(apart)) {
      if (root.multiplicity % 2 == 1 && root.value > since && root.value < now_.time) {
        parted = root.value;
      }
    }
  }
  Polynomial parting = derivative(apart);
  return {{points, std::move(apart), parted}, {points, std::move(parting), since}};
}

template <class Traits>
auto Certificate_finder<Traits>::conditions(const Event& event) const -> std::vector<Condition> {
  switch (event.kind) {
    case Event_kind::flip:
    case Event_kind::hull_insert:
    case Event_kind::hull_remove:
      return {condition_of_edge(removed_edge(event))};
    case Event_kind::hide: {
      // After a reconstruction, its results are reported.
      const Point_id id = *event.point_a;
      if (triangulation_.is_hidden(id)) return {};
      // Any of its edges, since it has three neighbors, of which one may be infinite.
      return {condition_of_edge(pair_of(id, faces_.least_neighbor(id)))};
    }
    case Event_kind::reveal:
      if constexpr (HasWeight<Motion>) {
        if (triangulation_.is_hidden(*event.point_a)) return conditions_of_hidden(*event.point_a);
      }
      return {};
    case Event_kind::wall:
      return conditions_of_walls(*event.point_a);
    case Event_kind::collision:
      return conditions_of_pair(discs_of(event));
    default:
      return {};
  }
}

// ---- events ----

template <class Traits>
void Certificate_finder<Traits>::before_event(const Event& event) {
  set_now(event.time);
  certificate_ = {event.number, event.kind, points_named(event), {}, std::nullopt, {}};
  const std::vector<Condition> all = conditions(event);
  for (const auto& [points, polynomial, since] : all) {
    certificate_.failure = certify_failure(polynomial, since, event.time);
    if (certificate_.failure) {
      certificate_.points.clear();
      for (const Neighbor& point : points) {
        certificate_.points.push_back(id_of(point));
        if constexpr (is_periodic) certificate_.offsets.push_back(point.offset);
      }
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
  const Edge_name pair = discs_of(event);
  for (const Point_id id : ids_of(pair)) motions_before_.push_back(triangulation_.motion(id));
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
      follow_contact(discs_of(event));
      break;
    default:
      break;
  }
  function_(certificate_);
}

template <class Traits>
void Certificate_finder<Traits>::follow_contact(const Edge_name& pair) {
  bool have_changed = false;
  for (const std::size_t i : {0U, 1U}) {
    const Point_id id = ids_of(pair)[i];
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
    forget_edges(edge);
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
template class Event_certificates<Periodic_kinetic_traits_2>;
template class Event_certificates<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri
