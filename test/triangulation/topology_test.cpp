// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/kinetic_parts.h"
#include "support/precondition_error.h"

namespace kinetri::topology_test {
namespace {

using test::resting;
using Part = test::Topology_part<>;
using Topology = Part::Topology;
using Edge_set = std::set<Edge_ids>;

/// A square with two points inside, at rest, and so without a choice of its edges.
const std::vector<Linear_motion_2> square = {resting(0, 0), resting(8, 0), resting(8, 9),
                                             resting(0, 8), resting(3, 3), resting(5, 4)};

Edge_ids ids(const Part::Edge_with_mirror& edge) {
  EXPECT_EQ(Topology::ids_of(edge.here), Topology::ids_of(edge.there));
  return Topology::ids_of(edge.here);
}

TEST(Topology, has_a_vertex_for_each_point_and_the_edges_of_static_points) {
  for (unsigned seed = 1; seed <= test::cases(10u); ++seed) {
    const auto motions = test::grid_motions(9, 4, 2, seed);
    const Part part(motions, 0.5);
    EXPECT_EQ(part.topology.number_of_vertices(), motions.size());
    for (Point_id id = 0; id < motions.size(); ++id) {
      EXPECT_EQ(part.topology.vertex(id)->point().id(), id);
      EXPECT_EQ(part.topology.points()[id].motion(), motions[id]);
    }
    EXPECT_EQ(part.edges(), test::edges_after(motions, 0.5)) << "seed " << seed;
    EXPECT_TRUE(part.topology.triangulation().is_valid());
  }
}

TEST(Topology, gives_ids_out_once_and_takes_back_those_that_no_point_has) {
  Part part(square);
  EXPECT_EQ(part.topology.give_ids(3), 6u);
  EXPECT_EQ(part.topology.give_ids(1), 9u);
  EXPECT_FALSE(part.topology.contains(9));
  EXPECT_FALSE(part.topology.contains(10));
  part.topology.take_back_ids(8);
  EXPECT_EQ(part.topology.give_ids(1), 8u);
  EXPECT_EQ(part.topology.number_of_vertices(), 6u);
  EXPECT_PRECONDITION_ERROR(part.topology.give_ids(no_point - 9),
                            "too many points; expected fewer than 2^32 - 1");
  EXPECT_EQ(part.topology.vertices().size(), 9u) << "a refused call gives no ids";
}

TEST(Topology, of_a_point_that_comes_turns_and_goes_keeps_its_vertex_until_then) {
  Part part(square);
  const Point_id id = part.topology.give_ids(1);
  part.topology.set_point({id, resting(1, 1)});
  const Part::Vertex_handle v = part.topology.vertex(id);
  EXPECT_EQ(part.topology.number_of_vertices(), 7u);
  part.topology.set_point({id, Linear_motion_2{{2, 2}, {1, 0}}});
  EXPECT_EQ(part.topology.vertex(id), v);
  EXPECT_EQ(v->point().motion(), (Linear_motion_2{{2, 2}, {1, 0}}));
  part.topology.set_point({id, std::nullopt});
  EXPECT_FALSE(part.topology.contains(id));
  EXPECT_EQ(part.topology.number_of_vertices(), 6u);
}

TEST(Flip, exchanges_the_diagonal_and_keeps_the_edges_around_it) {
  Part part(square);
  const Edge_set before = part.edges();
  const Part::Edge_with_mirror edge = part.edge(4, 5);
  const auto [removed, added] = part.topology.flipped_edges(edge);
  EXPECT_EQ(removed, (Edge_ids{4, 5}));
  auto outer = part.topology.outer_edges(edge);
  Edge_set outer_before;
  for (const auto& side : outer) outer_before.insert(ids(side));
  const Part::Edge_with_mirror flipped = part.topology.flip(edge, outer);
  EXPECT_EQ(ids(flipped), added);
  Edge_set outer_after;
  for (std::size_t k = 0; k < 4; ++k) {
    outer_after.insert(ids(outer[k]));
    EXPECT_EQ(outer[k].there.first, k < 2 ? flipped.here.first : flipped.there.first);
  }
  EXPECT_EQ(outer_after, outer_before);
  Edge_set expected = before;
  expected.erase(removed);
  expected.insert(added);
  EXPECT_EQ(part.edges(), expected);
  part.topology.flip(flipped, outer);
  EXPECT_EQ(part.edges(), before);
  EXPECT_TRUE(part.topology.triangulation().is_valid());
}

TEST(Flip, of_a_hull_edge_makes_its_apex_a_hull_vertex) {
  Part part({resting(0, 0), resting(4, 0), resting(2, 5), {{2, 1}, {0, -1}}});
  auto outer = part.topology.outer_edges(part.edge(0, 1));
  part.topology.set_instant({1.0, Time_side::after});
  part.topology.flip(part.edge(0, 1), outer);
  EXPECT_TRUE(part.topology.triangulation().is_valid());
  EXPECT_EQ(part.edges(), (Edge_set{{0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
}

TEST(Hull, turns_counterclockwise) {
  const Part part(square);
  for (const auto& [a, b, c] : {std::array<Point_id, 3>{3, 0, 1}, {0, 1, 2}, {1, 2, 3}}) {
    const Part::Edge_with_mirror to_infinity = part.edge(b, no_point);
    for (const auto& side : {to_infinity, {to_infinity.there, to_infinity.here}}) {
      const auto turn = part.topology.hull_turn(side);
      EXPECT_EQ(turn[0]->point().id(), a);
      EXPECT_EQ(turn[1]->point().id(), b);
      EXPECT_EQ(turn[2]->point().id(), c);
    }
  }
  const Part::Edge_with_mirror lower = part.edge(0, 1);
  const auto& [face, i] = part.topology.hull_triangle(lower);
  EXPECT_EQ(face->vertex(i)->point().id(), 4u) << "the triangle inside";
}

TEST(Vertex, taken_out_leaves_the_triangulation_of_the_others_and_comes_back) {
  for (unsigned seed = 1; seed <= test::cases(2u); ++seed) {
    const auto motions = test::random_motions(9, 10, 1, seed);
    for (Point_id id = 0; id < 9; ++id) {
      Part part(motions);
      const Part::Vertex_handle v = part.topology.vertex(id);
      Edge_set noted = part.edges();
      const auto note = [&](const Edge_ids& edge, int change) {
        EXPECT_EQ(change == 1 ? noted.insert(edge).second : noted.erase(edge) == 1, true);
      };
      std::vector<Part::Face_handle> faces;
      const auto edges = part.topology.remove_from_faces(v, faces, note);
      auto others = motions;
      others.erase(others.begin() + id);
      Edge_set expected;
      for (const auto& [a, b] : test::edges_after(others, 0.0)) {
        expected.insert({a < id ? a : a + 1, b < id ? b : b + 1});
      }
      EXPECT_EQ(part.edges(), expected);
      EXPECT_EQ(noted, expected) << "the edges that are noted account for all changes";
      for (const auto& edge : edges) {
        EXPECT_EQ(edge.here.first->event(edge.here.second), Topology::listed);
      }
      EXPECT_EQ(part.topology.vertex(id), v);
      const auto location = part.topology.locate(v->point(), faces.front());
      if (part.topology.triangulation().is_infinite(location.face)) continue;
      part.topology.insert_in_faces(v, location);
      EXPECT_EQ(part.topology.vertex(id), v);
      EXPECT_EQ(part.topology.triangulation().degree(v), 3u);
      EXPECT_TRUE(part.topology.triangulation().tds().is_valid());
    }
  }
}

TEST(Topology, that_adopts_another_triangulation_keeps_its_vertices) {
  const auto motions = test::random_motions(9, 10, 4, 1);
  Part part(motions);
  const std::vector<Part::Vertex_handle> vertices = part.topology.vertices();
  part.topology.set_instant({3.0, Time_side::after});
  Part::Triangulation later(Linear_kinetic_traits_2().instantaneous_traits(part.topology.clock()));
  for (const auto& point : part.topology.points()) later.insert(point);
  const Edge_set before = part.edges();
  part.topology.adopt(std::move(later), [](Point_id, bool, bool) { FAIL() << "none is hidden"; });
  EXPECT_EQ(part.topology.vertices(), vertices);
  EXPECT_EQ(part.edges(), test::edges_after(motions, 3.0));
  EXPECT_NE(part.edges(), before);
  EXPECT_TRUE(part.topology.triangulation().is_valid());
}

TEST(Place, is_found_in_a_face_on_an_edge_at_a_vertex_and_beyond_the_hull) {
  const Part part({resting(0, 0), resting(4, 0), {{4, 4}, {1, 1}}, resting(0, 4)});
  const auto locus = [&](const Vector_2& place) {
    const Part::Point_2 point(resting(place.x, place.y), 4);
    const auto location = part.topology.locate(point, part.topology.vertex_near(point, 0)->face());
    return location.locus;
  };
  EXPECT_EQ(locus({3, 2}), Part::Triangulation::FACE);
  EXPECT_EQ(locus({4, 0}), Part::Triangulation::VERTEX);
  EXPECT_EQ(locus({2, 0}), Part::Triangulation::EDGE);
  EXPECT_EQ(locus({-1, 2}), Part::Triangulation::OUTSIDE_CONVEX_HULL);
}

}  // namespace
}  // namespace kinetri::topology_test
