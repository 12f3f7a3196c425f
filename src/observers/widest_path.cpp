// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/widest_path.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri {
namespace {

template <class Traits>
typename Traits::Point_2 resting_point(const Vector_2& place) {
  typename Traits::Motion motion;
  motion.position = place;
  return typename Traits::Point_2(motion, no_point);
}

// Prim's algorithm: grows the maximum spanning tree of the dual graph from one position until it
// reaches the other one, always across the longest edge.
template <class Traits>
class Search {
 public:
  using Kinetic = Kinetic_triangulation_2<Traits>;
  using Topology = typename Kinetic::Triangulation;
  using Face_handle = typename Kinetic::Face_handle;

  explicit Search(const Kinetic& kinetic)
      : kinetic_(kinetic), topology_(kinetic.triangulation()), frontier_(Is_narrower{&kinetic}) {}

  Widest_path path(const Vector_2& from, const Vector_2& to) {
    Widest_path result{from, to, {}, std::nullopt, {}, {}};
    if (topology_.dimension() < 2) return result;
    const Face_handle first = topology_.locate(resting_point<Traits>(from));
    const Face_handle last = topology_.locate(resting_point<Traits>(to));
    result.around_from = around(first);
    result.around_to = around(last);
    reach(first, {});
    while (!reached_.contains(&*last)) {
      const Crossing next = frontier_.top();
      frontier_.pop();
      if (!reached_.contains(&*next.into)) reach(next.into, next);
    }
    for (Step step = reached_.at(&*last); step.crossing; step = reached_.at(step.crossing->from)) {
      result.gaps.push_back(step.crossing->gap);
    }
    std::ranges::reverse(result.gaps);
    if (!result.gaps.empty()) {
      result.narrowest = *std::ranges::min_element(
          result.gaps,
          [this](const Edge_ids& a, const Edge_ids& b) { return Is_narrower{&kinetic_}(a, b); });
    }
    return result;
  }

 private:
  using Face = typename Topology::Face;

  struct Crossing {
    Edge_ids gap = {no_point, no_point};
    const Face* from = nullptr;
    Face_handle into;
  };

  // How a face has been reached; the first ones without a crossing.
  struct Step {
    std::optional<Crossing> crossing;
  };

  // A strict order: of equal lengths the smaller ids come first.
  struct Is_narrower {
    const Kinetic* kinetic;

    bool operator()(const Edge_ids& a, const Edge_ids& b) const {
      const auto point = [this](Point_id id) { return kinetic->vertex(id)->point(); };
      const Sign order = sign_just_after(
          distance_comparison_polynomial(point(a[0]), point(a[1]), point(b[0]), point(b[1])),
          kinetic->current_time());
      return order == CGAL::ZERO ? a < b : order == CGAL::POSITIVE;
    }
    bool operator()(const Crossing& a, const Crossing& b) const { return (*this)(a.gap, b.gap); }
  };

  // The outside of the convex hull is one region.
  void reach(Face_handle face, const std::optional<Crossing>& crossing) {
    if (!topology_.is_infinite(face)) return reach_one(face, crossing);
    detail::for_each_face_at(topology_, topology_.infinite_vertex(),
                             [&](Face_handle infinite) { reach_one(infinite, crossing); });
  }

  void reach_one(Face_handle face, const std::optional<Crossing>& crossing) {
    reached_.emplace(&*face, Step{crossing});
    for (int i = 0; i < 3; ++i) {
      const auto p = face->vertex(Topology::ccw(i));
      const auto q = face->vertex(Topology::cw(i));
      if (topology_.is_infinite(p) || topology_.is_infinite(q)) continue;
      const Face_handle into = face->neighbor(i);
      if (reached_.contains(&*into)) continue;
      frontier_.push({edge_ids(p->point().id(), q->point().id()), &*face, into});
    }
  }

  std::vector<std::array<Point_id, 2>> around(Face_handle face) const {
    std::vector<std::array<Point_id, 2>> result;
    for (int i = 0; i < 3; ++i) {
      const auto p = face->vertex(Topology::ccw(i));
      const auto q = face->vertex(Topology::cw(i));
      if (topology_.is_infinite(p) || topology_.is_infinite(q)) continue;
      result.push_back({p->point().id(), q->point().id()});
    }
    return result;
  }

  const Kinetic& kinetic_;
  const Topology& topology_;
  std::unordered_map<const Face*, Step> reached_;
  std::priority_queue<Crossing, std::vector<Crossing>, Is_narrower> frontier_;
};

}  // namespace

template <class Traits>
requires HasNearestNeighbors<Traits> && PlanarKineticTraits_2<Traits> Widest_path
widest_path(const Kinetic_triangulation_2<Traits>& triangulation, const Vector_2& from,
            const Vector_2& to) {
  KINETRI_PRECONDITION(
      std::isfinite(from.x) && std::isfinite(from.y) && std::isfinite(to.x) && std::isfinite(to.y),
      "a place is not finite");
  return Search<Traits>(triangulation).path(from, to);
}

template <class Traits>
requires HasNearestNeighbors<Traits> && PlanarKineticTraits_2<Traits>
    std::optional<Algebraic_number> end_of_path(
        const Kinetic_triangulation_2<Traits>& triangulation, const Widest_path& path,
        double width) {
  KINETRI_PRECONDITION(std::isfinite(width) && width >= 0, "the width is negative or not finite");
  // Failures are exact; a certificate that holds until some time is checked again from there.
  const Traits& traits = triangulation.traits();
  const auto point = [&](Point_id id) { return triangulation.vertex(id)->point(); };
  std::optional<Algebraic_number> first;
  const auto consider = [&](const auto& certificate_from, const auto& failure) {
    Algebraic_number time = triangulation.current_time();
    while (true) {
      const Certificate certificate = certificate_from(time);
      if (certificate.kind == Certificate::Kind::never_fails) return;
      if (first && *first <= Algebraic_number(certificate.bounds.lower)) return;
      if (certificate.kind == Certificate::Kind::holds) {
        time = Algebraic_number(certificate.bounds.lower);
        continue;
      }
      Algebraic_number end =
          certificate.failure ? *certificate.failure : failure(certificate.bounds);
      if (!first || end < *first) first = std::move(end);
      return;
    }
  };
  for (const Edge_ids& gap : path.gaps) {
    const auto p = point(gap[0]);
    const auto q = point(gap[1]);
    consider([&](const auto& t) { return traits.apart_certificate(p, q, width, t); },
             [&](const auto& bounds) { return traits.contact_failure(p, q, width, bounds); });
  }
  for (const auto& [place, edges] :
       {std::pair(&path.from, &path.around_from), std::pair(&path.to, &path.around_to)}) {
    const auto r = resting_point<Traits>(*place);
    for (const auto& edge : *edges) {
      const auto p = point(edge[0]);
      const auto q = point(edge[1]);
      consider(
          [&](const auto& t) {
            return traits.orientation_certificate(p, q, r, t, Certificate_state::any);
          },
          [&](const auto& bounds) { return traits.orientation_failure(p, q, r, bounds); });
    }
  }
  return first;
}

KINETRI_WIDEST_PATH(template, Linear_kinetic_traits_2);
KINETRI_WIDEST_PATH(template, Polynomial_kinetic_traits_2);

}  // namespace kinetri
