// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's regular triangulation on moving discs at an instant, against the one on weighted points of
// an exact kernel.
#include "kinetri/kinetic/instantaneous_traits_2.h"

#include <CGAL/Regular_triangulation_2.h>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <type_traits>
#include <utility>

#include "kinetri/events/event.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "support/discs.h"
#include "support/on_failure.h"

namespace kinetri::weighted_instantaneous_traits_2_test {
namespace {

using test::disc_at;
using test::Static_disc;

static_assert(
    std::is_same_v<Disc_kinetic_traits_2::Instantaneous_traits, Weighted_instantaneous_traits_2>);
static_assert(
    std::is_same_v<Linear_kinetic_traits_2::Instantaneous_traits, Instantaneous_traits_2>);

template <class Disc>
using Triangulation = CGAL::Regular_triangulation_2<Basic_weighted_instantaneous_traits_2<Disc>>;
using Static_triangulation = CGAL::Regular_triangulation_2<test::Static_kernel>;

template <class Disc>
std::vector<Disc> discs(std::size_t n, int flavor, unsigned seed) {
  test::Disc_source source(seed);
  std::vector<Disc> result;
  for (std::size_t i = 0; i < n; ++i) result.push_back(source.next<Disc>(flavor));
  return result;
}

// The finite edges, by ids; hidden points have none.
template <class T, class Id_of>
std::set<Edge_ids> edges_of(const T& triangulation, const Id_of& id_of) {
  std::set<Edge_ids> result;
  for (const auto& [face, i] : triangulation.finite_edges()) {
    result.insert(
        edge_ids(id_of(face->vertex(T::cw(i))->point()), id_of(face->vertex(T::ccw(i))->point())));
  }
  return result;
}
template <class T, class Id_of>
std::set<Point_id> hidden_of(const T& triangulation, const Id_of& id_of) {
  std::set<Point_id> result;
  for (auto v = triangulation.hidden_vertices_begin(); v != triangulation.hidden_vertices_end();
       ++v) {
    result.insert(id_of(v->point()));
  }
  return result;
}

// Of weighted points at one time, of which no two are equal.
class Ids {
 public:
  void set(const Static_disc& p, Point_id id) { ids_[key(p)] = id; }
  Point_id operator()(const Static_disc& p) const { return ids_.at(key(p)); }

 private:
  static std::tuple<Rational, Rational, Rational> key(const Static_disc& p) {
    return {p.x(), p.y(), p.weight()};
  }
  std::map<std::tuple<Rational, Rational, Rational>, Point_id> ids_;
};

template <class Disc>
void compare_with_static(const std::vector<Disc>& motions, const Rational& t) {
  const test::On_failure trace([&] { return test::describe_discs(motions) + "t = " + t.str(); });
  using Point = Basic_moving_point_2<Disc>;
  const Algebraic_number time(t);
  Triangulation<Disc> moving{Basic_weighted_instantaneous_traits_2<Disc>(Instant{time})};
  Static_triangulation expected;
  Ids id_of;
  Point_id id = 0;
  std::set<std::tuple<Rational, Rational, Rational>> seen;
  // In the same order, and with the same symbolic perturbation.
  for (const Disc& m : motions) {
    const Static_disc s = disc_at(m, t);
    if (!seen.insert({s.x(), s.y(), s.weight()}).second) continue;
    id_of.set(s, id);
    moving.insert(Point(m, id));
    expected.insert(s);
    ++id;
  }
  const auto id_of_moving = [](const Point& p) { return p.id(); };
  const auto expect_equal = [&] {
    ASSERT_EQ(moving.dimension(), expected.dimension());
    ASSERT_EQ(moving.number_of_hidden_vertices(), expected.number_of_hidden_vertices());
    ASSERT_EQ(hidden_of(moving, id_of_moving), hidden_of(expected, id_of));
    ASSERT_EQ(edges_of(moving, id_of_moving), edges_of(expected, id_of));
    ASSERT_TRUE(moving.is_valid());
  };
  expect_equal();
  if (moving.dimension() == 2) {
    for (const auto& face : moving.finite_face_handles()) {
      const Point center = moving.weighted_circumcenter(face);
      const auto nearest = moving.nearest_power_vertex(center);
      const auto compare = moving.geom_traits().compare_power_distance_2_object();
      ASSERT_EQ(compare(center, nearest->point(), face->vertex(0)->point()), CGAL::EQUAL);
    }
    for (const auto& edge : moving.finite_edges()) ASSERT_FALSE(moving.dual(edge).is_empty());
  }
  // Remove every other one of those that are not hidden.
  bool is_every_other = false;
  while (moving.number_of_vertices() > 4) {
    const auto v = moving.finite_vertices_begin();
    const Point_id gone = v->point().id();
    auto e = expected.finite_vertices_begin();
    while (id_of(e->point()) != gone) ++e;
    moving.remove(v);
    expected.remove(e);
    is_every_other = !is_every_other;
    if (is_every_other) expect_equal();
  }
  expect_equal();
}

template <class Disc>
class Weighted_instantaneous_traits : public testing::Test {};
using Discs = testing::Types<Disc_motion_2, Polynomial_disc_motion_2>;
TYPED_TEST_SUITE(Weighted_instantaneous_traits, Discs);

TYPED_TEST(Weighted_instantaneous_traits, give_the_regular_triangulation_of_an_exact_kernel) {
  for (int flavor = 0; flavor < test::Disc_source::flavors; ++flavor) {
    for (const unsigned seed : {1u, 3u, 6u}) {
      const std::size_t n = 3 + 4 * seed;
      test::Disc_source times(seed);
      compare_with_static(discs<TypeParam>(n, flavor, seed), times.time(flavor));
      if (this->HasFatalFailure()) return;
    }
  }
}

TYPED_TEST(Weighted_instantaneous_traits, of_discs_on_a_line_give_that_of_an_exact_kernel) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    auto motions = discs<TypeParam>(8, 1, seed);
    for (TypeParam& m : motions) {
      m.position.y = 2 * m.position.x;
      m.velocity.y = 2 * m.velocity.x;
      if constexpr (requires { m.jerk; }) m.acceleration = m.jerk = {};
    }
    compare_with_static(motions, Rational(static_cast<int>(seed), 3));
    if (this->HasFatalFailure()) return;
  }
}

TEST(Weighted_instantaneous_traits, beside_the_time_at_which_a_disc_is_hidden_tell_the_sides) {
  // The middle of a circle of radius 5 is hidden as soon as its weight is less than -25; it is
  // (2 - t)^2 - 26.
  std::vector<Disc_motion_2> motions(4);
  motions[0].position = {5, 0};
  motions[1].position = {-3, 4};
  motions[2].position = {-3, -4};
  motions[3].radius = 2;
  motions[3].growth = -1;
  motions[3].weight = -26;
  const auto hidden = [&](const Rational& t, Time_side side) {
    Triangulation<Disc_motion_2> triangulation{
        Weighted_instantaneous_traits_2(Instant{Algebraic_number(t), side})};
    Point_id id = 0;
    for (const Disc_motion_2& m : motions) triangulation.insert(Moving_disc_2(m, id++));
    return triangulation.number_of_hidden_vertices();
  };
  EXPECT_EQ(hidden(1, Time_side::before), 0);
  EXPECT_EQ(hidden(1, Time_side::after), 1);
  EXPECT_EQ(hidden(3, Time_side::before), 1);
  EXPECT_EQ(hidden(3, Time_side::after), 0);
}

TEST(Weighted_instantaneous_traits, compare_weights) {
  Disc_motion_2 small;
  small.radius = 1;
  Disc_motion_2 large = small;
  large.weight = 0x1p-1000;
  const Weighted_instantaneous_traits_2 traits;
  const auto compare = traits.compare_weight_2_object();
  EXPECT_EQ(compare(Moving_disc_2(small), Moving_disc_2(large)), CGAL::SMALLER);
  EXPECT_EQ(compare(Moving_disc_2(large), Moving_disc_2(small)), CGAL::LARGER);
  EXPECT_EQ(compare(Moving_disc_2(large), Moving_disc_2(large)), CGAL::EQUAL);
}

}  // namespace
}  // namespace kinetri::weighted_instantaneous_traits_2_test
