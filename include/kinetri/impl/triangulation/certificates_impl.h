// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2: the certificates of edges.
#ifndef KINETRI_IMPL_TRIANGULATION_CERTIFICATES_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_CERTIFICATES_IMPL_H

#include <array>
#include <limits>
#include <span>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

template <KineticTraits_2 Traits>
inline auto Kinetic_triangulation_2<Traits>::two_sided(const Edge& edge) const -> Two_sided_edge {
  if (triangulation_.dimension() < 2) return {edge, edge};
  // Without branches, which nothing could predict.
  const auto& [face, i] = edge;
  const Face_handle neighbor = face->neighbor(i);
  const Vertex_handle right = face->vertex(Triangulation::ccw(i));
  const int right_there =
      (neighbor->vertex(1) == right ? 1 : 0) + (neighbor->vertex(2) == right ? 2 : 0);
  return {edge, Edge(neighbor, Triangulation::ccw(right_there))};
}

// Previous hull vertex, the edge's own, and the next one, counterclockwise around the hull, for an
// edge to the infinite vertex. In a face that lists (infinite, b, a) counterclockwise the hull
// runs from a to b.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::hull_turn(const Two_sided_edge& infinite_edge) const
    -> std::array<Vertex_handle, 3> {
  const auto& [face, i] = infinite_edge.here;
  const Vertex_handle here = face->vertex(i);
  const Vertex_handle there = infinite_edge.there.first->vertex(infinite_edge.there.second);
  const Vertex_handle left = face->vertex(Triangulation::cw(i));
  const Vertex_handle right = face->vertex(Triangulation::ccw(i));
  if (triangulation_.is_infinite(right)) return {here, left, there};
  return {there, right, here};
}

// The infinite vertex has the id no_point.
template <KineticTraits_2 Traits>
Edge_ids Kinetic_triangulation_2<Traits>::ids_of(const Edge& edge) {
  return edge_ids(edge.first->vertex(Triangulation::cw(edge.second))->point().id(),
                  edge.first->vertex(Triangulation::ccw(edge.second))->point().id());
}

// Precondition: dimension 2.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::certificate_points(const Two_sided_edge& edge) const
    -> Certificate_points {
  const auto& [face, i] = edge.here;
  const Vertex_handle left = face->vertex(Triangulation::cw(i));
  const Vertex_handle right = face->vertex(Triangulation::ccw(i));
  if (triangulation_.is_infinite(left) || triangulation_.is_infinite(right)) {
    const auto [previous, here, next] = hull_turn(edge);
    return {Entry_kind::hull_remove, {&previous->point(), &here->point(), &next->point()}};
  }
  const Vertex_handle apex = face->vertex(i);
  const Vertex_handle opposite = edge.there.first->vertex(edge.there.second);
  if (triangulation_.is_infinite(apex)) {
    return {Entry_kind::hull_insert, {&left->point(), &right->point(), &opposite->point()}};
  }
  if (triangulation_.is_infinite(opposite)) {
    return {Entry_kind::hull_insert, {&right->point(), &left->point(), &apex->point()}};
  }
  return {Entry_kind::flip, {&right->point(), &left->point(), &apex->point(), &opposite->point()}};
}

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::certificate_points(const Entry& entry) const
    -> Certificate_points {
  if constexpr (is_weighted) {
    if (entry.is_hidden()) return hidden_points().points(entry.hidden, entry.index);
  }
  return certificate_points(two_sided(entry.edge()));
}

template <KineticTraits_2 Traits>
inline Certificate Kinetic_triangulation_2<Traits>::certificate(const Certificate_points& points,
                                                                const Time& after,
                                                                Certificate_state state,
                                                                const Traits& traits) {
  const auto& [p, q, r, s] = points.points;
  if (points.kind == Entry_kind::flip) {
    return traits.in_circle_certificate(*p, *q, *r, *s, after, state);
  }
  if (points.kind == Entry_kind::hull_insert) {
    return traits.flatness_certificate(*p, *q, *r, after, state);
  }
  return traits.orientation_certificate(*p, *q, *r, after, state);
}

// Calls put(edge, kind, certificate) for each of the edges, with its certificate from `after` on
// and the kind of the failure. An edge has two conditions, that it belongs to the triangulation and
// that its ends are apart; its certificate is that of the one that fails first.
template <KineticTraits_2 Traits>
template <class Put>
void Kinetic_triangulation_2<Traits>::certify(std::span<const Two_sided_edge> edges,
                                              const Time& after, Certificate_state state,
                                              const Traits& traits, Certificate_counters& counters,
                                              const Put& put) const {
  const auto time = [&after]() -> const Time& { return after; };
  const auto finish = [&](const Two_sided_edge& edge, Entry_kind failure, Certificate&& known) {
    counters.count(known);
    const Entry_kind kind = first_failure(edge, failure, known, time, traits, counters);
    put(edge, kind, std::move(known));
  };
  const auto certify_alone = [&](const Two_sided_edge& edge, const Certificate_points& points) {
    finish(edge, points.kind, certificate(points, after, state, traits));
  };
  if (triangulation_.dimension() < 2) {
    const Double_interval among = {after.interval().lower, std::numeric_limits<double>::infinity()};
    for (const Two_sided_edge& edge : edges) {
      if (triangulation_.is_infinite(edge.here)) {
        put(edge, Entry_kind::coincidence, Certificate());
        continue;
      }
      if constexpr (is_weighted) {
        if (!weights_are_equal_) {
          Certificate chain = hidden_points().chain_certificate(edge.here, after, traits);
          counters.count(chain);
          put(edge, Entry_kind::coincidence, std::move(chain));
          continue;
        }
      }
      put(edge, Entry_kind::coincidence, coincidence(edge, after, among, traits, counters));
    }
    return;
  }
  if constexpr (BatchKineticTraits_2<Traits>) {
    // In-circle certificates go two by two.
    const Two_sided_edge* first = nullptr;
    Certificate_points points_of_first = {};
    for (const Two_sided_edge& edge : edges) {
      const Certificate_points points = certificate_points(edge);
      if (points.kind != Entry_kind::flip || state != Certificate_state::any) {
        certify_alone(edge, points);
      } else if (first == nullptr) {
        first = &edge;
        points_of_first = points;
      } else {
        auto both = traits.in_circle_certificates({points_of_first.points, points.points}, after);
        const auto finish_known = [&](const Two_sided_edge& e, const Certificate_points& p,
                                      Certificate&& known) {
          if (known.kind == Certificate::Kind::unknown) return certify_alone(e, p);
          finish(e, p.kind, std::move(known));
        };
        finish_known(*first, points_of_first, std::move(both[0]));
        finish_known(edge, points, std::move(both[1]));
        first = nullptr;
      }
    }
    if (first != nullptr) certify_alone(*first, points_of_first);
  } else {
    for (const Two_sided_edge& edge : edges) certify_alone(edge, certificate_points(edge));
  }
}

// The certificate of one edge, and the kind of its failure; counted nowhere.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::certificate_of(const Two_sided_edge& edge, const Time& after,
                                                     const Traits& traits) const
    -> std::pair<Entry_kind, Certificate> {
  std::pair<Entry_kind, Certificate> result;
  Certificate_counters unused;
  certify({&edge, 1}, after, Certificate_state::any, traits, unused,
          [&](const Two_sided_edge& /*edge*/, Entry_kind kind, Certificate&& certificate) {
            result = {kind, std::move(certificate)};
          });
  return result;
}

// The same of what an entry is about, with the points of the certificate that fails.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::certificate_of(const Entry& entry, const Time& after,
                                                     const Traits& traits) const
    -> std::pair<Certificate_points, Certificate> {
  if constexpr (is_weighted) {
    if (entry.is_hidden()) {
      Certificate_counters unused;
      auto [index, certificate] = hidden_points().certificate(entry.hidden, after, traits, unused);
      if (triangulation_.dimension() < 2) return {Certificate_points(), std::move(certificate)};
      return {hidden_points().points(entry.hidden, index), std::move(certificate)};
    }
  }
  const Two_sided_edge edge = two_sided(entry.edge());
  Certificate certificate = certificate_of(edge, after, traits).second;
  if (triangulation_.dimension() < 2) return {Certificate_points(), std::move(certificate)};
  return {certificate_points(edge), std::move(certificate)};
}

// Turns the certificate that an edge belongs to the triangulation, whose failure is of the given
// kind, into the certificate of the edge, and returns the kind of that one's failure. Points that
// come together share edges just before, so that watching edges finds every coincidence. While an
// in-circle or orientation polynomial is positive, no two of its points coincide.
template <KineticTraits_2 Traits>
template <class After>
inline auto Kinetic_triangulation_2<Traits>::first_failure(const Two_sided_edge& edge,
                                                           Entry_kind kind,
                                                           Certificate& certificate,
                                                           const After& after, const Traits& traits,
                                                           Certificate_counters& counters) const
    -> Entry_kind {
  using Kind = Certificate::Kind;
  if (certificate.kind == Kind::holds || kind == Entry_kind::hull_remove) return kind;
  const bool fails = certificate.kind == Kind::fails;
  if (!fails && !certificate.may_vanish) return kind;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Double_interval among = {
      certificate.may_vanish ? after().interval().lower : certificate.bounds.lower,
      fails ? certificate.bounds.upper : infinity};
  // If the polynomial vanishes nowhere before, the ends of the edge are apart up to bounds.lower.
  Certificate meeting = certificate.may_vanish ? coincidence(edge, after(), among, traits, counters)
                                               : coincidence(edge, Time(certificate.bounds.lower),
                                                             among, traits, counters);
  if (meeting.kind != Kind::fails) return kind;
  if (fails &&
      *meeting.failure > (certificate.failure ? *certificate.failure
                                              : failure_time(edge, kind, certificate.bounds))) {
    return kind;
  }
  certificate = std::move(meeting);
  return Entry_kind::coincidence;
}

// The certificate that the ends of the edge are apart.
template <KineticTraits_2 Traits>
inline Certificate Kinetic_triangulation_2<Traits>::coincidence(
    const Two_sided_edge& edge, const Time& after, const Double_interval& among,
    const Traits& traits, Certificate_counters& counters) const {
  const auto& [face, i] = edge.here;
  Certificate result =
      traits.coincidence_certificate(face->vertex(Triangulation::cw(i))->point(),
                                     face->vertex(Triangulation::ccw(i))->point(), after, among);
  KINETRI_ASSERT(result.kind == Certificate::Kind::never_fails || result.failure != nullptr,
                 "a coincidence certificate has its failure time or never fails");
  counters.count(result);
  return result;
}

// The exact failure time of an edge's certificate, within bounds that the traits gave.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::failure_time(const Two_sided_edge& edge, Entry_kind kind,
                                                   const Double_interval& bounds) const -> Time {
  KINETRI_ASSERT(kind >= Entry_kind::hull_insert, "the time of a coincidence is kept");
  return failure_time(certificate_points(edge), bounds);
}

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::failure_time(const Certificate_points& failed,
                                                   const Double_interval& bounds) const -> Time {
  const auto& [p, q, r, s] = failed.points;
  return failed.kind == Entry_kind::flip ? traits_.in_circle_failure(*p, *q, *r, *s, bounds)
                                         : traits_.orientation_failure(*p, *q, *r, bounds);
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_CERTIFICATES_IMPL_H
