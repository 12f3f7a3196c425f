// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;
using Kind = Certificate::Kind;

// The mean distance of neighbors is 10.
constexpr double contact_range = 5;

// Two points that are neighbors at time 0, and the next two, for comparisons.
struct Neighbors {
  const Moving_point_2* p;
  const Moving_point_2* q;
  const Moving_point_2* r;
  const Moving_point_2* s;
  Algebraic_number from;  // the start time of certificates
};

// The corners of two triangles that share an edge; the first three are a counterclockwise triangle.
struct Quadrilateral {
  std::array<const Moving_point_2*, 4> corners;
};

// The pairs of points that have an edge, and the quadrilaterals around edges.
struct Edges {
  std::vector<Neighbors> neighbors;
  std::vector<Quadrilateral> quadrilaterals;
};

Edges edges_of(const std::vector<Moving_point_2>& points,
               const std::vector<Linear_motion_2>& motions) {
  std::vector<std::pair<Static_kernel::Point_2, std::size_t>> places;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    places.emplace_back(Static_kernel::Point_2(motions[i].position.x, motions[i].position.y), i);
  }
  // Ids by position: no scenario repeats a position.
  std::ranges::sort(places);
  const auto point_at = [&](const Static_kernel::Point_2& place) {
    const auto found =
        std::lower_bound(places.begin(), places.end(), std::pair(place, std::size_t{0}));
    return &points[found->second];
  };
  std::vector<Static_kernel::Point_2> positions;
  for (const auto& [place, id] : places) positions.push_back(place);
  const Static_triangulation triangulation(positions.begin(), positions.end());
  Edges edges;
  std::vector<Neighbors>& result = edges.neighbors;
  for (const auto& [face, i] : triangulation.finite_edges()) {
    const auto corner = [&, &face = face, i = i](int k) {
      return point_at(face->vertex((i + k) % 3)->point());
    };
    result.push_back({corner(1), corner(2), nullptr, nullptr, 0.0});
    const auto opposite = triangulation.mirror_vertex(face, i);
    if (triangulation.is_infinite(face) || triangulation.is_infinite(opposite)) continue;
    edges.quadrilaterals.push_back(
        {{corner(0), corner(1), corner(2), point_at(opposite->point())}});
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Neighbors& next = result[(i + 1) % result.size()];
    result[i].r = next.p;
    result[i].s = next.q;
  }
  return edges;
}

// Nanoseconds of a certificate: the fastest of several passes, over those that fail and over the
// others.
template <class Case, class Make>
json nanoseconds(const std::vector<Case>& all, const Make& make) {
  json result = json::object();
  for (const bool fails : {false, true}) {
    std::vector<const Case*> chosen;
    for (const Case& n : all) {
      const Certificate certificate = make(n);
      if ((certificate.kind == Kind::fails) == fails) chosen.push_back(&n);
    }
    if (chosen.empty()) continue;
    double least = std::numeric_limits<double>::infinity();
    std::size_t exact = 0;
    for (int pass = 0; pass < 5; ++pass) {
      exact = 0;
      const Stopwatch watch;
      for (const Case* n : chosen) exact += make(*n).means == Certificate::Means::exact;
      least = std::min(least, watch.seconds());
    }
    const auto number = static_cast<double>(chosen.size());
    result[fails ? "fails" : "never"] = {{"ns", 1e9 * least / number},
                                         {"number", chosen.size()},
                                         {"exact_share", static_cast<double>(exact) / number}};
  }
  return result;
}

template <class Traits>
json certificates(const Traits& traits, const Edges& edges) {
  const std::vector<Neighbors>& all = edges.neighbors;
  // Certificates that start when the points enter the range, a time known by a bracket. Computed
  // here, since a number caches its exact value.
  std::vector<Neighbors> within;
  std::vector<Neighbors> entering;
  for (Neighbors n : all) {
    const Certificate certificate = traits.apart_certificate(*n.p, *n.q, contact_range, n.from);
    if (certificate.kind != Kind::fails) continue;
    if (certificate.failure && *certificate.failure == n.from) {
      within.push_back(n);
    } else if (!certificate.failure) {
      n.from = traits.contact_failure(*n.p, *n.q, contact_range, certificate.bounds);
      entering.push_back(std::move(n));
    }
  }
  const Algebraic_number zero;
  json result = {
      {"in_circle", nanoseconds(edges.quadrilaterals,
                                [&](const Quadrilateral& q) {
                                  const auto& [a, b, c, d] = q.corners;
                                  return traits.in_circle_certificate(*a, *b, *c, *d, zero,
                                                                      Certificate_state::any);
                                })},
      {"contact", nanoseconds(all,
                              [&](const Neighbors& n) {
                                return traits.contact_certificate(*n.p, *n.q, contact_range,
                                                                  n.from);
                              })},
      {"apart", nanoseconds(all,
                            [&](const Neighbors& n) {
                              return traits.apart_certificate(*n.p, *n.q, contact_range, n.from);
                            })},
      {"near", nanoseconds(within,
                           [&](const Neighbors& n) {
                             return traits.near_certificate(*n.p, *n.q, contact_range, n.from);
                           })},
      {"closer", nanoseconds(all, [&](const Neighbors& n) {
         return traits.closer_certificate(*n.p, *n.q, *n.r, *n.s, n.from);
       })}};
  if (!entering.empty()) {
    const Stopwatch watch;
    for (const Neighbors& n : entering) traits.near_certificate(*n.p, *n.q, contact_range, n.from);
    result["near_from_entry"] = {
        {"ns", 1e9 * watch.seconds() / static_cast<double>(entering.size())},
        {"number", entering.size()}};
  }
  return result;
}

}  // namespace

json measure_certificates(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  std::vector<Moving_point_2> points;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    points.emplace_back(motions[i], static_cast<Point_id>(i));
  }
  const Edges all = edges_of(points, motions);
  return {{"filtered", certificates(Linear_kinetic_traits_2(), all)},
          {"exact", certificates(Linear_kinetic_traits_2::exact(), all)}};
}

}  // namespace kinetri::bench
