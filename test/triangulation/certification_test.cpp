// SPDX-License-Identifier: GPL-3.0-or-later
//
// When certificates of edges fail, against determinants of places at rational times.
#include "kinetri/impl/triangulation/certification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "support/kinetic_parts.h"

namespace kinetri::certification_test {
namespace {

using detail::Entry_kind;
using test::resting;
using Failure = std::optional<Algebraic_number>;
using At = std::function<Rational(const Rational&)>;

/// The first time from `start` on just after which the polynomial, of which `value` gives values,
/// is negative; or the first one strictly after that at which it is zero, if zeros count.
Failure first_failure(const Polynomial& p, const At& value, const Algebraic_number& start,
                      bool zeros_count) {
  if (p.is_zero()) return std::nullopt;
  std::vector<Algebraic_number> times = {start};
  for (const Real_root& root : real_roots(p)) {
    if (root.value > start) times.push_back(root.value);
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Algebraic_number end =
        i + 1 < times.size() ? times[i + 1] : Algebraic_number(Rational(times[i].upper() + 1));
    if (zeros_count && i > 0) return times[i];
    if (value(simplest_between(times[i], end)) < 0) return times[i];
  }
  return std::nullopt;
}

/// What the certificate of an edge is to say, from the points at its two faces.
template <class Part, class Motion>
class Edge_oracle {
  static constexpr int degree = std::same_as<Motion, Linear_motion_2> ? 1 : 3;
  using Vertex_handle = typename Part::Vertex_handle;

 public:
  Edge_oracle(const Part& part, const std::vector<Motion>& motions)
      : part_(part), motions_(motions) {}

  Failure failure(const typename Part::Edge_with_mirror& edge,
                  const Algebraic_number& start) const {
    const auto& [face, i] = edge.here;
    const auto& [neighbor, j] = edge.there;
    const Vertex_handle a = face->vertex(Part::Triangulation::ccw(i));
    const Vertex_handle b = face->vertex(Part::Triangulation::cw(i));
    const Vertex_handle c = face->vertex(i);
    const Vertex_handle d = neighbor->vertex(j);
    // The faces list a, b, c and b, a, d counterclockwise; the hull turns at the finite end.
    const auto is_infinite = [&](Vertex_handle v) {
      return part_.topology.triangulation().is_infinite(v);
    };
    if (is_infinite(a)) return convex(c, b, d, start);
    if (is_infinite(b)) return convex(d, a, c, start);
    const Failure meeting = meet(a, b, start);
    const Failure other = is_infinite(c)   ? flat(b, a, d, start)
                          : is_infinite(d) ? flat(a, b, c, start)
                                           : circle(a, b, c, d, start);
    if (!meeting || !other) return meeting ? meeting : other;
    return std::min(*meeting, *other);
  }

 private:
  auto place(Vertex_handle v, const Rational& t) const {
    return test::place_at(motions_[v->point().id()], t);
  }
  At turn(Vertex_handle p, Vertex_handle q, Vertex_handle r) const {
    return [this, p, q, r](const Rational& t) {
      return Rational(CGAL::determinant(place(q, t) - place(p, t), place(r, t) - place(p, t)));
    };
  }
  Failure convex(Vertex_handle p, Vertex_handle q, Vertex_handle r,
                 const Algebraic_number& start) const {
    if (p == r) return std::nullopt;
    const At value = turn(p, q, r);
    return first_failure(test::interpolate(2 * degree, value), value, start, false);
  }
  Failure flat(Vertex_handle p, Vertex_handle q, Vertex_handle r,
               const Algebraic_number& start) const {
    const At value = turn(p, q, r);
    return first_failure(test::interpolate(2 * degree, value), value, start, true);
  }
  Failure meet(Vertex_handle p, Vertex_handle q, const Algebraic_number& start) const {
    const At value = [&](const Rational& t) {
      return Rational(CGAL::squared_distance(place(p, t), place(q, t)));
    };
    return first_failure(test::interpolate(2 * degree, value), value, start, true);
  }
  // The first determinant that does not vanish at all times decides.
  Failure circle(Vertex_handle a, Vertex_handle b, Vertex_handle c, Vertex_handle d,
                 const Algebraic_number& start) const {
    for (std::size_t column = 0; column < 3; ++column) {
      const At value = [&](const Rational& t) {
        return Rational(-test::in_circle_determinants(place(a, t), place(b, t), place(c, t),
                                                      place(d, t))[column]);
      };
      const Polynomial p = test::interpolate(4 * degree, value);
      if (!p.is_zero()) return first_failure(p, value, start, false);
    }
    return std::nullopt;
  }

  const Part& part_;
  const std::vector<Motion>& motions_;
};

/// Compares the certificates of all edges, from `after` on, of the triangulation at `start`.
/// Returns how many of them fail.
template <class Traits, class Motion>
int compare(const std::vector<Motion>& motions, const Algebraic_number& start,
            const Algebraic_number& after) {
  using Part = test::Certification_part<Traits>;
  const Part part(motions, start);
  if (part.topology.triangulation().dimension() < 2) return 0;
  const Edge_oracle<Part, Motion> oracle(part, motions);
  int failures = 0;
  for (const auto& edge : part.all_edges()) {
    const auto known = part.failure(edge, after);
    const Failure expected = oracle.failure(edge, after);
    const auto [a, b] = Part::Topology::ids_of(edge.here);
    EXPECT_EQ(known.has_value(), expected.has_value()) << a << " - " << b;
    if (known && expected) {
      EXPECT_EQ(known->second, *expected) << a << " - " << b << ", kind " << int(known->first);
      ++failures;
    }
  }
  return failures;
}

TEST(Certification, fails_when_the_determinants_say_so) {
  int failures = 0;
  for (unsigned seed = 1; seed <= test::cases(4u); ++seed) {
    SCOPED_TRACE(seed);
    failures += compare<Linear_kinetic_traits_2>(test::random_motions(12, 10, 2, seed), 0.0, 0.0);
    failures += compare<Linear_kinetic_traits_2>(test::grid_motions(12, 4, 2, seed), 0.0, 0.0);
    failures += compare<Polynomial_kinetic_traits_2>(
        test::polynomial_grid_motions(9, 6, 2, 3, seed), 0.5, 0.5);
  }
  EXPECT_GT(failures, 100);
}

// Certificates that vanish at the present time, at an irrational one as well.
TEST(Certification, at_the_times_of_events_fails_when_the_determinants_say_so) {
  const auto motions = test::grid_motions(7, 4, 2, 3);
  const auto times = test::critical_times(motions, 0.0);
  ASSERT_GT(times.size(), 20u);
  for (std::size_t k = 0; k < 20; ++k) {
    SCOPED_TRACE(k);
    compare<Linear_kinetic_traits_2>(motions, times[k], times[k]);
  }
}

TEST(Certification, of_edges_that_are_violated_already_fails_at_once) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    compare<Linear_kinetic_traits_2>(test::random_motions(12, 10, 2, seed), 0.0, 2.0);
  }
}

// While four points are cocircular one of the two diagonals is right, and only that one.
TEST(Certification, of_points_that_stay_cocircular_says_which_diagonal_is_right) {
  const std::vector<Linear_motion_2> square = {
      {{0, 0}, {1, 2}}, {{1, 0}, {1, 2}}, {{1, 1}, {1, 2}}, {{0, 1}, {1, 2}}};
  test::Certification_part<> part(square);
  ASSERT_EQ(part.edges(), test::edges_at(square, Rational(0)));
  const bool has_rising = part.edges().contains({0, 2});
  const auto right = has_rising ? part.edge(0, 2) : part.edge(1, 3);
  EXPECT_EQ(part.failure(right, 7.0), std::nullopt);
  auto outer = part.topology.outer_edges(right);
  const auto wrong = part.topology.flip(right, outer);
  EXPECT_EQ(part.failure(wrong, 7.0), std::pair(Entry_kind::flip, Algebraic_number(7.0)));
}

TEST(Certification, names_the_kind_of_what_fails_first) {
  const std::vector<Linear_motion_2> motions = {
      resting(0, 0), resting(8, 0), resting(8, 8), resting(0, 8), {{4, 3}, {0, -1}}};
  const test::Certification_part<> part(motions);
  EXPECT_EQ(part.failure(part.edge(0, 1), 0.0),
            std::pair(Entry_kind::hull_insert, Algebraic_number(3.0)));
  EXPECT_EQ(part.failure(part.edge(1, no_point), 0.0), std::nullopt);
  // Two that come together on a line through no other point.
  const test::Certification_part<> meeting(
      {resting(0, 0), resting(9, 0), resting(4, 9), {{3, 3}, {1, 0}}, {{6, 3}, {-1, 0}}});
  EXPECT_EQ(meeting.failure(meeting.edge(3, 4), 0.0),
            std::pair(Entry_kind::coincidence, Algebraic_number(1.5)));
}

// All five certificates, mostly made together, are those that each edge has by itself.
TEST(Certification, after_a_flip_is_that_of_each_edge) {
  test::Certification_part<> part(test::random_motions(40, 10, 1, 5));
  std::optional<std::pair<Algebraic_number, test::Certification_part<>::Edge_with_mirror>> first;
  for (const auto& edge : part.all_edges()) {
    const auto failure = part.failure(edge, 0.0);
    if (failure && failure->first == Entry_kind::flip &&
        (!first || failure->second < first->first)) {
      first = {failure->second, edge};
    }
  }
  ASSERT_TRUE(first);
  const auto& now = first->first;
  const auto& edge = first->second;
  auto outer = part.topology.outer_edges(edge);
  const auto flipped = part.topology.flip(edge, outer);
  Certificate_counters counters;
  std::set<Edge_ids> certified;
  part.certification.certify_after_flip(
      flipped, outer, now.interval(), [&]() -> const Algebraic_number& { return now; }, counters,
      [&](const auto& e, Entry_kind kind, Certificate&& certificate) {
        certified.insert(test::Topology_part<>::Topology::ids_of(e.here));
        const auto expected = part.failure(e, now);
        if (certificate.kind == Certificate::Kind::never_fails) {
          EXPECT_EQ(expected, std::nullopt);
        } else if (certificate.kind == Certificate::Kind::fails) {
          ASSERT_TRUE(expected);
          EXPECT_EQ(kind, expected->first);
          EXPECT_EQ(certificate.failure ? *certificate.failure
                                        : part.certification.failure_time(
                                              part.certification.points(e), certificate.bounds),
                    expected->second);
        }
      });
  EXPECT_EQ(certified.size(), 5u);
  EXPECT_GE(counters.created, 5u);
}

TEST(Vertex, that_moves_within_its_star_leaves_its_triangles_embedded) {
  test::Certification_part<> part(
      {resting(0, 0), resting(8, 0), resting(8, 8), resting(0, 8), resting(4, 3)});
  const auto orientation = part.topology.triangulation().geom_traits().orientation_2_object();
  const auto is_embedded_at = [&](Point_id id, double x, double y) {
    part.topology.set_point({id, resting(x, y)});
    const auto v = part.topology.vertex(id);
    return part.certification.is_embedded_around(v, {0, 0},
                                                 [&](const auto& p, const auto& q, const auto& r) {
                                                   return orientation(p, q, r) == CGAL::LEFT_TURN;
                                                 });
  };
  EXPECT_TRUE(is_embedded_at(4, 7, 7.5));
  EXPECT_FALSE(is_embedded_at(4, 7, 8)) << "on the hull: a triangle is flat";
  EXPECT_FALSE(is_embedded_at(4, 9, 4));
  EXPECT_TRUE(is_embedded_at(4, 4, 3));
  EXPECT_TRUE(is_embedded_at(2, 9, 12));
  EXPECT_FALSE(is_embedded_at(2, 3, 4)) << "the hull is not convex";
}

}  // namespace
}  // namespace kinetri::certification_test
