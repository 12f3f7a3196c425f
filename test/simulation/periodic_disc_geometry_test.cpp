// SPDX-License-Identifier: GPL-3.0-or-later
//
// Disc_geometry of discs of any radii in a periodic box, and Short_vectors: against all images.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <span>
#include <vector>

#include "simulation/disc_geometry.h"
#include "simulation/known_responses.h"
#include "support/images.h"
#include "support/multiplier.h"
#include "support/simulation_parts.h"

namespace kinetri::periodic_disc_geometry_test {
namespace {

using Traits = Periodic_disc_kinetic_traits_2;
using Discs = test::Geometry_part<Traits>;
using Offsets = std::set<Lattice_offset_2>;

Disc_motion_2 disc(double x, double y, double radius = 0, double growth = 0) {
  return {{{x, y}, {0, 0}, 0}, radius, growth, 0};
}

// ---- short vectors ----

/// A random lattice of whole numbers; mostly its shortest vectors make angles of nearly 60 degrees.
Periodic_box_2 random_box(std::mt19937_64& random) {
  const auto number = [&](int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random);
  };
  const bool is_hexagonal = number(0, 3) > 0;
  const double side = is_hexagonal ? 52 : number(20, 60);
  const double x = is_hexagonal ? number(24, 28) : number(-60, 60);
  const double y = is_hexagonal ? number(44, 47) : number(20, 60);
  const int more = number(-3, 3);  // another basis of the lattice
  return {{{side, 0}, {0, 0}, 0}, {{x + more * side, y}, {0, 0}, 0}};
}

/// From p to an image of q, exactly: all numbers are whole.
std::int64_t squared_distance(const Disc_motion_2& p, const Disc_motion_2& q,
                              const Lattice_offset_2& offset, const Periodic_box_2& box) {
  const auto along = [&](double Vector_2::*axis) {
    return static_cast<std::int64_t>(q.position.*axis - p.position.*axis +
                                     offset.x * box.first().position.*axis +
                                     offset.y * box.second().position.*axis);
  };
  const std::int64_t x = along(&Vector_2::x);
  const std::int64_t y = along(&Vector_2::y);
  return x * x + y * y;
}

template <class Function>
void for_each_offset(int most, const Function& function) {
  for (std::int32_t i = -most; i <= most; ++i) {
    for (std::int32_t j = -most; j <= most; ++j) function(Lattice_offset_2{i, j});
  }
}

TEST(Short_vectors, know_all_images_that_are_near) {
  std::mt19937_64 random(1);
  const auto place = [&] {
    const auto number = [&] { return std::uniform_int_distribution<int>(-100, 100)(random); };
    const double x = number();
    return disc(x, number());
  };
  std::size_t images = 0;
  for (int run = 0; run < test::cases(200); ++run) {
    const Periodic_box_2 box = random_box(random);
    const detail::Short_vectors<Traits> vectors(Traits(box), 0);
    const Disc_motion_2 origin = disc(0, 0);
    const std::int64_t shortest = squared_distance(origin, origin, vectors.shortest(), box);
    for_each_offset(6, [&](const Lattice_offset_2& offset) {
      if (offset == Lattice_offset_2()) return;
      ASSERT_GE(squared_distance(origin, origin, offset, box), shortest);
    });
    // Near are those whose distance is at most so many times the shortest vector.
    const std::int64_t times = run % 4 + 1;
    const std::int64_t most = times * times * shortest;
    const auto steps = vectors.steps(std::sqrt(double(most)));
    ASSERT_LE(double(steps), 1 + 1.1548 * double(times));
    for (int k = 0; k < 4; ++k) {
      const Traits::Point_2 p(place(), 0);
      const Traits::Point_2 q(place(), 1);
      Offsets near;
      vectors.for_each_near(p, q, steps,
                            [&](const Lattice_offset_2& offset) { near.insert(offset); });
      // Images of both in the parallelogram at the origin.
      const Lattice_offset_2 home_p = vectors.home(p);
      const Lattice_offset_2 home_q = vectors.home(q);
      Offsets around;
      vectors.for_each_around(home_q, steps, [&](const Lattice_offset_2& offset) {
        around.insert(detail::sum(offset, detail::reversed(home_p)));
      });
      for_each_offset(40, [&](const Lattice_offset_2& offset) {
        if (squared_distance(p.motion(), q.motion(), offset, box) > most) return;
        ++images;
        ASSERT_TRUE(near.contains(offset)) << "run " << run;
        ASSERT_TRUE(around.contains(offset)) << "run " << run;
      });
    }
  }
  EXPECT_GT(images, 15000U);
}

// ---- overlaps ----

TEST(Periodic_discs, that_overlap_are_found_by_their_boxes_and_their_places) {
  const Rational time(1, 2);
  for (unsigned seed = 1; seed <= test::cases(4U); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    // Some are larger than the box.
    const bool is_large = seed % 4 == 0;
    const double most = is_large ? 9 : seed % 2 == 0 ? 2 : 0.7;
    const int greatest_offset = is_large ? 6 : 3;
    const Periodic_box_2 box({{10, 0}, {0, 0}}, {{2.5, 10}, {seed % 3 - 1.0, 0.5}});
    std::uniform_real_distribution<double> radius(0, most);
    std::vector<Disc_motion_2> discs;
    for (const auto& motion : test::random_motions(40, 10, 1, seed)) {
      discs.push_back({motion, random() % 5 == 0 ? 0 : radius(random), 0.25 * radius(random), 0});
    }
    Simulation_options options;
    if (is_large) options.response = detail::let_images_overlap;
    const Discs part(discs, options, 0.5, Traits(box));
    std::set<Periodic_edge> expected;
    std::set<Edge_ids> expected_ids;
    for (Point_id a = 0; a < 40; ++a) {
      for (Point_id b = a; b < 40; ++b) {
        const Rational reach = part.radius(a, time) + part.radius(b, time);
        for_each_offset(greatest_offset, [&](const Lattice_offset_2& offset) {
          if (a == b && !(Lattice_offset_2() < offset)) return;
          const auto place = test::place_at(center(image_of(discs[b], offset, &box)), time);
          if (CGAL::squared_distance(test::place_at(center(discs[a]), time), place) <
              reach * reach) {
            expected.insert({{a, b}, offset});
            expected_ids.insert({a, b});
          }
        });
      }
    }
    std::set<Periodic_edge> found;
    part.geometry.for_each_exact_overlap(
        part.setup.traits().exact(), [&](Point_id a, const Periodic_image& b) {
          EXPECT_TRUE(found.insert(detail::pair_from(a, b)).second);
        });
    EXPECT_EQ(found, expected);
    for (const Periodic_edge& pair : expected) {
      const auto [a, b] = pair.ids;
      Offsets near;
      part.geometry.for_each_near(part.geometry.point(a), b, part.geometry.vectors(),
                                  [&](const Periodic_image& image) { near.insert(image.offset); });
      EXPECT_TRUE(near.contains(pair.offset));
    }
    // Each disc that overlaps one of the points is in the result, or overlaps one that is.
    for (Point_id id = 0; id < 40; ++id) {
      const auto about = part.geometry.discs_about(std::span(&id, 1));
      for (const auto& [a, b] : expected_ids) {
        if (a != id && b != id) continue;
        const Point_id other = a == id ? b : a;
        EXPECT_TRUE(std::ranges::any_of(about,
                                        [&](Point_id there) {
                                          return there == other ||
                                                 expected_ids.contains(edge_ids(there, other));
                                        }))
            << id << " and " << other;
      }
    }
  }
}

// Disc 0 is hidden; 1 owns its center, and 2 all positions that are in 0 and in 3. They are given
// far from one another.
TEST(Periodic_discs, are_found_by_the_owners_of_positions_in_a_disc) {
  const Discs part(
      {disc(0, 0, 2), disc(12.875, 0, 2.5), disc(-26, 12, 2.875), disc(-1.875 + 36, -12, 0.125)},
      {}, 0.0, Traits({{{12, 0}, {0, 0}}, {{0, 12}, {0, 0}}}));
  EXPECT_TRUE(part.triangulation.is_hidden(0));
  const Point_id id = 0;
  const auto about = part.geometry.discs_about(std::span(&id, 1));
  for (const Point_id owner : {1U, 2U}) {
    EXPECT_NE(std::ranges::find(about, owner), about.end()) << owner;
  }
}

// ---- neighbors ----

// Hidden points are neighbors of the corners of their triangles, each with its offset, from both
// sides; also if points are given far away.
TEST(Periodic_discs, have_the_neighbors_that_see_them) {
  std::mt19937_64 random(3);
  std::size_t links = 0;
  for (int run = 0; run < test::cases(20); ++run) {
    const Periodic_box_2 box({{8, 0}, {0, 0}}, {{3, 8}, {0, 0}});
    std::vector<Disc_motion_2> discs;
    for (int i = 0; i < 12; ++i) {
      const auto number = [&](int least, int most) -> double {
        return std::uniform_int_distribution<int>(least, most)(random);
      };
      const double x = number(0, 63) / 8 + 8 * number(-9, 9);
      discs.push_back(disc(x, number(0, 63) / 8, number(0, 2) > 0 ? number(4, 24) / 8 : 0));
    }
    const Discs part(discs, {}, 0.0, Traits(box));
    std::set<Periodic_edge> expected;
    for (const Periodic_edge& edge : part.triangulation.periodic_edges()) expected.insert(edge);
    std::set<Periodic_edge> of_links;
    for (Point_id id = 0; id < 12; ++id) {
      if (!part.triangulation.is_hidden(id) || discs[id].radius > 0) {
        EXPECT_TRUE(part.geometry.corners_of(id).empty());
        continue;
      }
      // The point is in the triangle of its corners.
      const auto corners = part.geometry.corners_of(id);
      ASSERT_EQ(corners.size(), 3U);
      const auto place = [&](std::size_t i) {
        return test::place_at(center(image_of(discs[corners[i].id], corners[i].offset, &box)), 0);
      };
      const auto here = test::place_at(center(discs[id]), 0);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NE(CGAL::orientation(place(i), place((i + 1) % 3), here), CGAL::RIGHT_TURN);
        of_links.insert(detail::pair_of(id, corners[i]));
      }
    }
    links += of_links.size();
    expected.insert(of_links.begin(), of_links.end());
    std::set<Periodic_edge> seen;
    for (Point_id id = 0; id < 12; ++id) {
      part.geometry.for_each_neighbor(id, [&](const Periodic_image& other) {
        const Periodic_edge pair = detail::pair_of(id, other);
        seen.insert(pair);
        EXPECT_TRUE(part.geometry.is_edge(pair));
        EXPECT_TRUE(expected.contains(pair)) << id << " and " << other.id;
      });
    }
    EXPECT_EQ(seen, expected);
    std::set<Periodic_edge> made;
    for (const auto& block : part.geometry.make_for_edges<std::vector<Periodic_edge>>(
             [](const Periodic_edge&edge, const Algebraic_number&, auto&list) {
               list.push_back(edge);
             })) {
      made.insert(block.begin(), block.end());
    }
    EXPECT_EQ(made, expected);
  }
  EXPECT_GT(links, 50U);
}

}  // namespace
}  // namespace kinetri::periodic_disc_geometry_test
