// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_TRIANGULATION_CERTIFICATION_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_CERTIFICATION_IMPL_H

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/certification.h"
#include "kinetri/impl/triangulation/topology_impl.h"

namespace kinetri::detail {

// ---- edges ----

template <class Traits>
auto Kinetic_types<Traits>::Certification::points(const Edge_with_mirror& edge) const
    -> Certificate_points {
  if constexpr (is_periodic) {
    // Against an end of the edge, which has an edge to all others.
    const auto& [face, i] = edge.here;
    const auto& [neighbor, j] = edge.there;
    const int left = Triangulation::cw(i);
    return {Entry_kind::flip,
            {triangulation_.corner(face, Triangulation::ccw(i), left),
             triangulation_.corner(face, left, left), triangulation_.corner(face, i, left),
             triangulation_.corner(neighbor, j, Triangulation::ccw(j))}};
  } else {
    return points_in_plane(edge);
  }
}

template <class Traits>
auto Kinetic_types<Traits>::Certification::points_in_plane(const Edge_with_mirror& edge) const
    -> Certificate_points {
  const auto& [face, i] = edge.here;
  const Vertex_handle left = face->vertex(Triangulation::cw(i));
  const Vertex_handle right = face->vertex(Triangulation::ccw(i));
  if (triangulation_.is_infinite(left) || triangulation_.is_infinite(right)) {
    const auto [previous, here, next] = topology_.hull_turn(edge);
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

template <class Traits>
inline Certificate Kinetic_types<Traits>::Certification::certificate(
    const Certificate_points& about, const Time& after, Certificate_state state) const {
  const auto [p, q, r, s] = about.quadruple();
  if (about.kind == Entry_kind::flip) {
    return traits_.in_circle_certificate(*p, *q, *r, *s, after, state);
  }
  if (about.kind == Entry_kind::hull_insert) {
    return traits_.flatness_certificate(*p, *q, *r, after, state);
  }
  return traits_.orientation_certificate(*p, *q, *r, after, state);
}

template <class Traits>
template <class Put>
void Kinetic_types<Traits>::Certification::certify(std::span<const Edge_with_mirror> edges,
                                                   const Time& after, Certificate_state state,
                                                   Certificate_counters& counters,
                                                   const Put& put) const {
  if (triangulation_.dimension() < 2) return certify_chain(edges, after, counters, put);
  const auto time = [&after]() -> const Time& { return after; };
  const auto finish = [&](const Edge_with_mirror& edge, Entry_kind failure, Certificate&& known) {
    counters.count(known);
    const Entry_kind kind = first_failure(edge, failure, known, time, counters);
    put(edge, kind, std::move(known));
  };
  const auto certify_alone = [&](const Edge_with_mirror& edge, const Certificate_points& about) {
    finish(edge, about.kind, certificate(about, after, state));
  };
  if constexpr (BatchKineticTraits_2<Traits>) {
    // In-circle certificates go two by two.
    const Edge_with_mirror* first = nullptr;
    Certificate_points points_of_first = {};
    for (const Edge_with_mirror& edge : edges) {
      const Certificate_points about = points(edge);
      if (about.kind != Entry_kind::flip || state != Certificate_state::any) {
        certify_alone(edge, about);
      } else if (first == nullptr) {
        first = &edge;
        points_of_first = about;
      } else {
        auto both =
            traits_.in_circle_certificates({points_of_first.quadruple(), about.quadruple()}, after);
        const auto finish_known = [&](const Edge_with_mirror& e, const Certificate_points& p,
                                      Certificate&& known) {
          if (known.kind == Certificate::Kind::unknown) return certify_alone(e, p);
          finish(e, p.kind, std::move(known));
        };
        finish_known(*first, points_of_first, std::move(both[0]));
        finish_known(edge, about, std::move(both[1]));
        first = nullptr;
      }
    }
    if (first != nullptr) certify_alone(*first, points_of_first);
  } else {
    for (const Edge_with_mirror& edge : edges) certify_alone(edge, points(edge));
  }
}

// For collinear points, or fewer than two.
template <class Traits>
template <class Put>
void Kinetic_types<Traits>::Certification::certify_chain(std::span<const Edge_with_mirror> edges,
                                                         const Time& after,
                                                         Certificate_counters& counters,
                                                         const Put& put) const {
  for (const Edge_with_mirror& edge : edges) {
    if (triangulation_.is_infinite(edge.here)) {
      put(edge, Entry_kind::coincidence, Certificate());
      continue;
    }
    if constexpr (is_weighted && !is_periodic) {
      if (!topology_.are_weights_equal()) {
        Certificate chain = chain_certificate(edge.here, after);
        counters.count(chain);
        put(edge, Entry_kind::coincidence, std::move(chain));
        continue;
      }
    }
    put(edge, Entry_kind::coincidence, coincidence(edge, after, from(after), counters));
  }
}

// The certificate of an edge of collinear points with different weights: its ends are apart, and
// its first vertex is not hidden by its neighbors. Precondition: dimension 1, the edge is finite.
template <class Traits>
Certificate Kinetic_types<Traits>::Certification::chain_certificate(const Edge& edge,
                                                                    const Time& after) const {
  const Face_handle face = edge.first;
  const Point_2& here = face->vertex(0)->point();
  const Point_2& next = face->vertex(1)->point();
  Certificate apart = traits_.meeting_certificate(here, next, after, from(after));
  const Face_handle beside = face->neighbor(1);
  const Vertex_handle previous = beside->vertex(1 - beside->index(face->vertex(0)));
  if (triangulation_.is_infinite(previous)) return apart;
  Certificate below = traits_.segment_certificate(next, here, previous->point(), after);
  if (below.kind == Certificate::Kind::never_fails) return apart;
  if (apart.kind == Certificate::Kind::never_fails || *below.failure < *apart.failure) return below;
  return apart;
}

template <class Traits>
template <class Now, class Put>
inline void Kinetic_types<Traits>::Certification::certify_after_flip(
    const Edge_with_mirror& edge, const Outer_edges& outer, const Double_interval& bounds,
    const Now& now, Certificate_counters& counters, const Put& put) const {
  if (certify_together(edge, outer, bounds, now, counters, put)) return;
  certify({&edge, 1}, now(), Certificate_state::vanishes, counters, put);
  certify(outer, now(), Certificate_state::any, counters, put);
}

// Calls use(around) with the points around an edge that has been flipped. Does nothing and returns
// false if a point is infinite or, in a periodic box, an offset too great.
template <class Traits>
template <class Use>
inline bool Kinetic_types<Traits>::Certification::use_around(const Edge_with_mirror& edge,
                                                             const Outer_edges& outer,
                                                             const Use& use) const {
  const auto& [face, i] = edge.here;
  const auto& [neighbor, j] = edge.there;
  const int left = Triangulation::cw(i);
  const int right = Triangulation::ccw(i);
  KINETRI_ASSERT(face->neighbor(i) == neighbor && neighbor->neighbor(j) == face,
                 "CGAL's flip turns the edge in its faces by one index");
  const auto beyond = [&](std::size_t k) {
    return outer[k].here.first->vertex(outer[k].here.second);
  };
  if constexpr (is_periodic) {
    // Against an end of the edge, which has an edge to all corners.
    const int left_beyond = Triangulation::ccw(j);
    std::array<Lattice_offset_2, 4> offsets;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto offset = Triangulation::offset_beyond(outer[k].there, k < 2 ? left : left_beyond);
      if (!offset) return false;
      offsets[k] = *offset;
    }
    const auto image_beyond = [&](std::size_t k) {
      return traits_.image(beyond(k)->point(), offsets[k]);
    };
    const std::array<Image_2, 8> images = {triangulation_.corner(face, left, left),
                                           triangulation_.corner(face, i, left),
                                           triangulation_.corner(face, right, left),
                                           triangulation_.corner(neighbor, j, left_beyond),
                                           image_beyond(0),
                                           image_beyond(1),
                                           image_beyond(2),
                                           image_beyond(3)};
    use({{&images[0], &images[1], &images[2], &images[3]},
         {&images[4], &images[5], &images[6], &images[7]}});
    return true;
  } else {
    const std::array<Vertex_handle, 4> corners = {face->vertex(left), face->vertex(i),
                                                  face->vertex(right), neighbor->vertex(j)};
    bool are_finite = true;
    Flip_neighborhood<Point_2> around;
    for (std::size_t k = 0; k < 4; ++k) {
      around.corners[k] = &corners[k]->point();
      around.beyond[k] = &beyond(k)->point();
      are_finite = are_finite && !triangulation_.is_infinite(corners[k]) &&
                   !triangulation_.is_infinite(beyond(k));
    }
    if (are_finite) use(around);
    return are_finite;
  }
}

// Does nothing and returns false if these points have no batch, or the traits have none.
template <class Traits>
template <class Now, class Put>
inline bool Kinetic_types<Traits>::Certification::certify_together(
    const Edge_with_mirror& edge, const Outer_edges& outer, const Double_interval& bounds,
    const Now& now, Certificate_counters& counters, const Put& put) const {
  if constexpr (BatchKineticTraits_2<Traits>) {
    return use_around(edge, outer, [&](const Flip_neighborhood<Image_2>& around) {
      auto certificates = traits_.certificates_after_flip(around, bounds);
      for (std::size_t k = 0; k < certificates.size(); ++k) {
        const Edge_with_mirror& e = k < 4 ? outer[k] : edge;
        Certificate& known = certificates[k];
        if (known.kind == Certificate::Kind::unknown) {
          const auto [p, q, r, s] = around.certificate(k);
          known = traits_.in_circle_certificate(
              *p, *q, *r, *s, now(), k < 4 ? Certificate_state::any : Certificate_state::vanishes);
        }
        counters.count(known);
        const Entry_kind kind = first_failure(e, Entry_kind::flip, known, now, counters);
        put(e, kind, std::move(known));
      }
    });
  }
  return false;
}

template <class Traits>
auto Kinetic_types<Traits>::Certification::certificate_of(const Edge_with_mirror& edge,
                                                          const Time& after) const
    -> std::pair<Entry_kind, Certificate> {
  std::pair<Entry_kind, Certificate> result;
  Certificate_counters unused;
  certify({&edge, 1}, after, Certificate_state::any, unused,
          [&](const Edge_with_mirror& /*edge*/, Entry_kind kind, Certificate&& certificate) {
            result = {kind, std::move(certificate)};
          });
  return result;
}

// Turns the certificate that an edge is Delaunay (or a hull edge), whose failure is of the given
// kind, into that of the first failure of the edge, and returns the kind of that failure. Points
// that meet share edges just before, so the edges find every coincidence. While an in-circle or
// orientation polynomial is positive, no two of its points coincide.
template <class Traits>
template <class After>
inline Entry_kind Kinetic_types<Traits>::Certification::first_failure(
    const Edge_with_mirror& edge, Entry_kind kind, Certificate& certificate, const After& after,
    Certificate_counters& counters) const {
  using Kind = Certificate::Kind;
  if (certificate.kind == Kind::holds || kind == Entry_kind::hull_remove) return kind;
  const bool fails = certificate.kind == Kind::fails;
  if (!fails && !certificate.may_be_zero) return kind;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Double_interval among = {
      certificate.may_be_zero ? after().interval().lower : certificate.bounds.lower,
      fails ? certificate.bounds.upper : infinity};
  // If the polynomial vanishes nowhere before, the ends of the edge are apart up to bounds.lower.
  Certificate meeting = certificate.may_be_zero
                            ? coincidence(edge, after(), among, counters)
                            : coincidence(edge, Time(certificate.bounds.lower), among, counters);
  if (meeting.kind != Kind::fails) return kind;
  if (fails) {
    KINETRI_ASSERT(kind >= Entry_kind::hull_insert, "the time of a coincidence is kept");
    if (*meeting.failure > (certificate.failure ? *certificate.failure
                                                : failure_time(points(edge), certificate.bounds))) {
      return kind;
    }
  }
  certificate = std::move(meeting);
  return Entry_kind::coincidence;
}

template <class Traits>
inline Certificate Kinetic_types<Traits>::Certification::coincidence(
    const Edge_with_mirror& edge, const Time& after, const Double_interval& among,
    Certificate_counters& counters) const {
  const auto& [face, i] = edge.here;
  const int left = Triangulation::cw(i);
  const int right = Triangulation::ccw(i);
  Certificate result;
  if constexpr (is_periodic) {
    result =
        traits_.coincidence_certificate(triangulation_.corner(face, left, left),
                                        triangulation_.corner(face, right, left), after, among);
  } else {
    result = traits_.coincidence_certificate(face->vertex(left)->point(),
                                             face->vertex(right)->point(), after, among);
  }
  KINETRI_ASSERT(result.kind == Certificate::Kind::never_fails || result.failure != nullptr,
                 "a coincidence certificate has its failure time or never fails");
  counters.count(result);
  return result;
}

template <class Traits>
auto Kinetic_types<Traits>::Certification::failure_time(const Certificate_points& failed,
                                                        const Double_interval& bounds) const
    -> Time {
  const auto [p, q, r, s] = failed.quadruple();
  return failed.kind == Entry_kind::flip ? traits_.in_circle_failure(*p, *q, *r, *s, bounds)
                                         : traits_.orientation_failure(*p, *q, *r, bounds);
}

// ---- hidden points ----

template <class Traits>
std::pair<std::uint8_t, Certificate> Kinetic_types<Traits>::Certification::hidden_certificate(
    Vertex_handle v, const Time& after, Certificate_counters& counters,
    std::uint8_t vanishing) const {
  std::pair<std::uint8_t, Certificate> first = {plane_condition, Certificate()};
  const auto also = [&](std::uint8_t index) {
    const auto state = index == vanishing ? Certificate_state::vanishes : Certificate_state::any;
    Certificate next = hidden_certificate(v, index, after, state);
    counters.count(next);
    if (next.kind == Certificate::Kind::never_fails) return;
    if (is_earlier(v, {index, &next}, {first.first, &first.second})) {
      first = {index, std::move(next)};
    }
  };
  also(plane_condition);
  if (triangulation_.dimension() == 1) {
    also(0);
    also(1);
  }
  if (triangulation_.dimension() < 2) return first;
  // By name, so that the first of equal ones does not depend on how the face stores its corners.
  std::array<std::uint8_t, 3> sides = {0, 1, 2};
  std::ranges::sort(sides, {},
                    [v](std::uint8_t i) { return Topology::name_of(Edge(v->face(), i)); });
  for (const std::uint8_t side : sides) also(side);
  return first;
}

template <class Traits>
auto Kinetic_types<Traits>::Certification::hidden_points(Vertex_handle v,
                                                         std::uint8_t condition) const
    -> Certificate_points {
  const auto corner = [&](int i) -> Corner {
    if constexpr (is_periodic) {
      return topology_.corner(v->face(), i);
    } else {
      return &v->face()->vertex(i)->point();
    }
  };
  const auto hidden = [&]() -> Corner {
    if constexpr (is_periodic) {
      return topology_.point_at(Topology::location_of_hidden(v), v->point());
    } else {
      return &v->point();
    }
  };
  if (condition == plane_condition) {
    return {Entry_kind::flip, {corner(0), corner(1), corner(2), hidden()}};
  }
  return {Entry_kind::hull_remove,
          {corner(Triangulation::ccw(condition)), corner(Triangulation::cw(condition)), hidden()}};
}

// In dimension 2 the condition of a side or of the plane. In lower dimensions that of the segment
// or vertex that hides the point (`plane_condition`), or of an end of the segment.
template <class Traits>
Certificate Kinetic_types<Traits>::Certification::hidden_certificate(
    Vertex_handle v, std::uint8_t condition, const Time& after, Certificate_state state) const {
  if (is_periodic || triangulation_.dimension() == 2) {
    return certificate(hidden_points(v, condition), after, state);
  }
  if constexpr (!is_periodic) {
    const Face_handle face = v->face();
    const Point_2& point = v->point();
    if (triangulation_.dimension() < 1) {
      return traits_.weight_certificate(triangulation_.finite_vertex()->point(), point, after);
    }
    const Point_2& first = face->vertex(0)->point();
    const Point_2& second = face->vertex(1)->point();
    if (condition == plane_condition) {
      return traits_.hiding_certificate(first, point, second, after);
    }
    return traits_.meeting_certificate(condition == 0 ? first : second, point, after, from(after));
  }
}

// Whether the first fails, or must be rechecked, before the second.
template <class Traits>
bool Kinetic_types<Traits>::Certification::is_earlier(Vertex_handle v, const Condition& a,
                                                      const Condition& b) const {
  if (b.certificate->kind == Certificate::Kind::never_fails) return true;
  if (a.certificate->bounds.upper < b.certificate->bounds.lower) return true;
  if (a.certificate->bounds.lower > b.certificate->bounds.upper) return false;
  const auto time = [&](const Condition& condition) {
    const auto& [index, certificate] = condition;
    if (certificate->kind == Certificate::Kind::holds) return Time(certificate->bounds.lower);
    return certificate->failure ? *certificate->failure
                                : failure_time(hidden_points(v, index), certificate->bounds);
  };
  return time(a) < time(b);
}

// ---- triangles ----

template <class Traits>
template <class Is_left_turn>
bool Kinetic_types<Traits>::Certification::is_embedded_around(
    Vertex_handle v, const Double_interval& bounds, const Is_left_turn& is_left_turn) const {
  if constexpr (BatchKineticTraits_2<Traits>) {
    // The usual case: an inner vertex with few neighbors.
    constexpr std::size_t most = 16;
    std::array<Image_2, is_periodic ? most : 0> images;
    std::array<const Image_2*, most> around;
    std::size_t number = 0;
    bool is_inner = true;
    for_each_face_at(triangulation_, v, [&](Face_handle face, int i) {
      const int right = Triangulation::ccw(i);
      is_inner = is_inner && number < most && !triangulation_.is_infinite(face->vertex(right));
      if (!is_inner) return;
      if constexpr (is_periodic) {
        images[number] = triangulation_.corner(face, right, i);
        around[number] = &images[number];
      } else {
        around[number] = &face->vertex(right)->point();
      }
      ++number;
    });
    const auto is_surrounded = [&](const Image_2& p) {
      return traits_.is_surrounded(p, std::span(std::as_const(around)).first(number), bounds);
    };
    if constexpr (is_periodic) {
      if (is_inner && is_surrounded(traits_.image(v->point(), {}))) return true;
    } else if (is_inner && is_surrounded(v->point())) {
      return true;
    }
  }
  if constexpr (is_periodic) {
    bool is_embedded = true;
    for_each_face_at(triangulation_, v, [&](Face_handle face) {
      is_embedded =
          is_embedded && is_left_turn(topology_.corner(face, 0), topology_.corner(face, 1),
                                      topology_.corner(face, 2));
    });
    return is_embedded;
  } else {
    const auto is_left = [&](Vertex_handle p, Vertex_handle q, Vertex_handle r) {
      return is_left_turn(p->point(), q->point(), r->point());
    };
    Vertex_handle previous;  // hull neighbors, if v is on the hull
    Vertex_handle next;
    Vertex_handle before_previous;
    Vertex_handle after_next;
    auto face = triangulation_.incident_faces(v);
    const auto first = face;
    do {
      const int i = face->index(v);
      const Vertex_handle right = face->vertex(Triangulation::ccw(i));
      const Vertex_handle left = face->vertex(Triangulation::cw(i));
      const auto beyond = [&] { return triangulation_.tds().mirror_vertex(face, i); };
      if (triangulation_.is_infinite(left)) {
        previous = right;
        before_previous = beyond();
      } else if (triangulation_.is_infinite(right)) {
        next = left;
        after_next = beyond();
      } else if (!is_left(v, right, left)) {
        return false;
      }
    } while (++face != first);
    if (previous == Vertex_handle()) return true;
    if (!is_left(before_previous, previous, v) || !is_left(v, next, after_next)) {
      return false;
    }
    bool is_embedded = true;
    for_each_neighbor(triangulation_, v, [&](Vertex_handle u) {
      is_embedded = is_embedded && (u == next || is_left(v, next, u)) &&
                    (u == previous || is_left(v, u, previous));
    });
    return is_embedded;
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_CERTIFICATION_IMPL_H
