// SPDX-License-Identifier: GPL-3.0-or-later
//
// Audits find what is wrong: in a triangulation broken by hand, and in one whose traits miss
// events.
#include "kinetri/triangulation/audit.h"

#include <gtest/gtest.h>

#include "kinetri/triangulation/audit_impl.h"
#include "kinetri/triangulation/kinetic_triangulation_2_impl.h"
#include "kinetri/triangulation/queries_2.h"
#include "support/motions.h"
#include "support/precondition_error.h"

namespace kinetri::audit_test {
namespace {

using Kinetic_delaunay = Kinetic_delaunay_triangulation_2<>;
using Triangulation = Kinetic_delaunay::Triangulation;

// The triangulation of `kinetic`, to be damaged.
Triangulation& damaged(Kinetic_delaunay& kinetic) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): what nobody else may do
  return const_cast<Triangulation&>(kinetic.triangulation());
}

bool mentions(const Audit_report& report, const std::string& text) {
  return std::ranges::any_of(report.failures, [&text](const std::string& failure) {
    return failure.find(text) != std::string::npos;
  });
}

// A finite edge whose flip leaves a proper triangulation that is not Delaunay.
Triangulation::Edge convex_edge(const Triangulation& triangulation) {
  for (const auto& edge : triangulation.finite_edges()) {
    const auto& [face, i] = edge;
    if (triangulation.is_infinite(face) || triangulation.is_infinite(face->neighbor(i))) continue;
    const auto orientation = triangulation.geom_traits().orientation_2_object();
    const auto& c = face->vertex(i)->point();
    const auto& d = triangulation.tds().mirror_vertex(face, i)->point();
    const auto& a = face->vertex(Triangulation::ccw(i))->point();
    const auto& b = face->vertex(Triangulation::cw(i))->point();
    if (orientation(d, c, a) != orientation(d, c, b)) return edge;
  }
  throw Internal_error("no convex quadrilateral");
}

TEST(Audit, of_a_right_triangulation_passes_at_every_level) {
  const Kinetic_delaunay kinetic(test::random_motions(20, 40, 5, 1));
  for (const Audit_level level : {Audit_level::links, Audit_level::embedding, Audit_level::delaunay,
                                  Audit_level::reference, Audit_level::certificates}) {
    EXPECT_TRUE(kinetic.audit(level).passed());
  }
}

TEST(Audit, finds_an_event_that_only_one_face_knows) {
  const Kinetic_delaunay kinetic(test::random_motions(20, 40, 5, 1));
  const auto edge = convex_edge(kinetic.triangulation());
  edge.first->set_event(edge.second, no_event);
  EXPECT_TRUE(mentions(kinetic.audit(Audit_level::links), "disagree about its event"));
}

TEST(Audit, finds_the_events_of_two_edges_exchanged) {
  const Kinetic_delaunay kinetic(test::random_motions(20, 40, 5, 1));
  const auto& triangulation = kinetic.triangulation();
  std::vector<Triangulation::Edge> scheduled;
  for (const auto& edge : triangulation.finite_edges()) {
    if (edge.first->event(edge.second) != no_event) scheduled.push_back(edge);
  }
  ASSERT_GE(scheduled.size(), 2u);
  const Queue_handle first = scheduled[0].first->event(scheduled[0].second);
  const Queue_handle second = scheduled[1].first->event(scheduled[1].second);
  const auto set_event = [&triangulation](const Triangulation::Edge& edge, Queue_handle handle) {
    edge.first->set_event(edge.second, handle);
    const auto mirror = triangulation.mirror_edge(edge);
    mirror.first->set_event(mirror.second, handle);
  };
  set_event(scheduled[0], second);
  set_event(scheduled[1], first);
  EXPECT_TRUE(mentions(kinetic.audit(Audit_level::links), "has the event of another edge"));
}

// Exchanging the points of two vertices leaves all links as they are.
TEST(Audit, finds_points_at_the_wrong_vertices) {
  const Kinetic_delaunay kinetic(test::random_motions(20, 40, 5, 1));
  std::swap(kinetic.vertex(3)->point(), kinetic.vertex(4)->point());
  EXPECT_TRUE(mentions(kinetic.audit(Audit_level::links), "the vertex of point 3 holds point 4"));
}

TEST(Audit, finds_a_triangle_turned_over) {
  const Kinetic_delaunay kinetic(test::random_motions(20, 40, 5, 1));
  // The same ids, but two points in each other's place.
  const Moving_point_2 third = kinetic.vertex(3)->point();
  const Moving_point_2 fourth = kinetic.vertex(4)->point();
  kinetic.vertex(3)->point() = Moving_point_2(fourth.motion(), 3);
  kinetic.vertex(4)->point() = Moving_point_2(third.motion(), 4);
  EXPECT_TRUE(kinetic.audit(Audit_level::links).passed());
  EXPECT_TRUE(mentions(kinetic.audit(Audit_level::embedding), "not counterclockwise: triangle"));
}

TEST(Audit, finds_an_edge_that_is_not_delaunay) {
  // Points at rest: there are no events, so that a flip breaks nothing but the Delaunay property.
  Kinetic_delaunay kinetic(test::random_motions(20, 40, 0, 1));
  const auto edge = convex_edge(kinetic.triangulation());
  damaged(kinetic).tds().flip(edge.first, edge.second);
  EXPECT_TRUE(kinetic.audit(Audit_level::links).passed());
  EXPECT_TRUE(kinetic.audit(Audit_level::embedding).passed());
  EXPECT_TRUE(mentions(kinetic.audit(Audit_level::delaunay), "not locally Delaunay"));
  EXPECT_TRUE(mentions(kinetic.audit(Audit_level::reference), "missing"));
}

// Finds no failures while `deaf`.
struct Forgetful_traits : Linear_kinetic_traits_2 {
  static Forgetful_traits exact() { return Forgetful_traits(); }

  static inline bool deaf_to_circles = false;
  static inline bool deaf_to_turns = false;

  Certificate in_circle_certificate(const Point_2& p, const Point_2& q, const Point_2& r,
                                    const Point_2& s, const Time& t,
                                    Certificate_state state) const {
    if (deaf_to_circles) return {};
    return Linear_kinetic_traits_2::in_circle_certificate(p, q, r, s, t, state);
  }
  Certificate orientation_certificate(const Point_2& p, const Point_2& q, const Point_2& r,
                                      const Time& t, Certificate_state state) const {
    if (deaf_to_turns) return {};
    return Linear_kinetic_traits_2::orientation_certificate(p, q, r, t, state);
  }
  Certificate flatness_certificate(const Point_2& p, const Point_2& q, const Point_2& r,
                                   const Time& t, Certificate_state state) const {
    if (deaf_to_turns) return {};
    return Linear_kinetic_traits_2::flatness_certificate(p, q, r, t, state);
  }
};

class Audit_of_missed_events : public testing::Test {
 protected:
  void TearDown() override {
    Forgetful_traits::deaf_to_circles = false;
    Forgetful_traits::deaf_to_turns = false;
  }

  Audit_report audit_after(double time) {
    Kinetic_delaunay_triangulation_2<Forgetful_traits> kinetic(test::random_motions(20, 40, 5, 1));
    kinetic.advance_to(time);
    Forgetful_traits::deaf_to_circles = false;
    Forgetful_traits::deaf_to_turns = false;
    return kinetic.audit(Audit_level::certificates);
  }
};

TEST_F(Audit_of_missed_events, without_any_missed_passes) {
  EXPECT_TRUE(audit_after(3.0).passed());
}

TEST_F(Audit_of_missed_events, finds_a_missed_failure_before_it_happens) {
  Forgetful_traits::deaf_to_circles = true;
  const Audit_report report = audit_after(0.0);
  EXPECT_TRUE(mentions(report, "will fail but has no event"));
  EXPECT_FALSE(mentions(report, "not locally Delaunay"));
}

TEST_F(Audit_of_missed_events, finds_the_edges_that_should_have_been_flipped) {
  Forgetful_traits::deaf_to_circles = true;
  EXPECT_TRUE(mentions(audit_after(2.0), "not locally Delaunay"));
}

TEST_F(Audit_of_missed_events, finds_a_hull_that_is_not_convex) {
  Forgetful_traits::deaf_to_turns = true;
  EXPECT_TRUE(mentions(audit_after(2.0), "the hull is not convex"));
}

// The queries of the library, with a triangulation that the library does not compile.
TEST(Queries, of_traits_that_are_derived_are_those_of_the_base) {
  const auto motions = test::random_motions(20, 40, 5, 1);
  Kinetic_delaunay_triangulation_2<Forgetful_traits> derived(motions);
  Kinetic_delaunay base(motions);
  for (const double t : {0.0, 1.0, 2.5}) {
    derived.advance_to(t);
    base.advance_to(t);
    const Kinetic_queries_2 of_derived(derived);
    const Kinetic_queries_2 of_base(base, t);
    EXPECT_EQ(of_derived.time(), t);
    EXPECT_EQ(of_derived.nearest_neighbors(), of_base.nearest_neighbors());
    for (Point_id id = 0; id < 20; ++id) {
      const Vector_2 place = rounded_place(base.motion(id), t + 0.5);
      EXPECT_EQ(of_derived.locate(place), of_base.locate(place));
      EXPECT_EQ(of_derived.nearest_vertex(place), of_base.nearest_vertex(place));
      EXPECT_EQ(of_derived.rounded_voronoi_cell(id).vertices,
                of_base.rounded_voronoi_cell(id).vertices);
    }
  }
  EXPECT_PRECONDITION_ERROR(Kinetic_queries_2(derived, 1.0),
                            "a query about the past; query a time before the triangulation "
                            "advances beyond it");
}

}  // namespace
}  // namespace kinetri::audit_test
