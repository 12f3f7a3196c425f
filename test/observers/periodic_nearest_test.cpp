// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nearest images over runs in periodic boxes, compared with all images.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/observers/nearest_neighbors.h"
#include "observers/random_runs.h"
#include "support/observed_periodic_run.h"

namespace kinetri::periodic_nearest_test {
namespace {

using Traits = Periodic_kinetic_traits_2;
using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;
using Time = Algebraic_number;
using test::Periodic_run;

Rational squared_distance_at(const Linear_motion_2& p, const Image_motion_2& q, const Rational& t) {
  return CGAL::squared_distance(test::place_at(p, t), test::place_at(q, t));
}

/// The derivatives of the squared distance of an image from a point: by them, in this order, images
/// that are equally far at a time are compared just after it.
std::pair<Rational, Rational> derivatives_at(const Linear_motion_2& p, const Image_motion_2& q,
                                             const Rational& now) {
  const Rational before = squared_distance_at(p, q, now - 1);
  const Rational after = squared_distance_at(p, q, now + 1);
  return {(after - before) / 2, after - 2 * squared_distance_at(p, q, now) + before};
}

/// The nearest image just after a time, of all points and of offsets around.
Periodic_image nearest_of_all(const Periodic_run& run, Kinetic& kinetic, Point_id id,
                              const Rational& now) {
  std::optional<Rational> least;
  std::vector<Periodic_image> nearest;  // all that are equally far
  const Linear_motion_2& p = kinetic.motion(id);
  const auto image = [&](const Periodic_image& of) {
    return Image_motion_2{kinetic.motion(of.id), of.offset, &run.box()};
  };
  for (Point_id other = 0; other < kinetic.next_id(); ++other) {
    if (!kinetic.contains(other)) continue;
    for (const Lattice_offset_2& offset : run.offsets_near(p, kinetic.motion(other), now)) {
      if (other == id && offset == Lattice_offset_2()) continue;
      const Periodic_image candidate{other, offset};
      const Rational distance = squared_distance_at(p, image(candidate), now);
      if (least && distance > *least) continue;
      if (!least || distance < *least) nearest.clear();
      least = distance;
      nearest.push_back(candidate);
    }
  }
  return std::ranges::min(nearest, {}, [&](const Periodic_image& candidate) {
    return std::pair(derivatives_at(p, image(candidate), now), candidate);
  });
}

// What is not made for periodic boxes refuses them.
static_assert(DistanceKineticTraits_2<Traits>);
static_assert(!PlanarKineticTraits_2<Traits>);
static_assert(!ContactKineticTraits_2<Traits>);

TEST(Periodic_nearest, of_a_point_alone_is_its_own_image) {
  const Periodic_box_2 box({{4, 0}, {-1, 0}, 0}, {{0, 3}, {0, 0}, 0});
  Kinetic kinetic(std::vector<Linear_motion_2>{{{0, 0}, {1, 1}, 0}}, Time(), Traits(box));
  Nearest_neighbors nearest(kinetic);
  EXPECT_EQ(nearest.nearest_neighbor(0), (Periodic_image{0, {0, -1}}));
  kinetic.advance_to(3.0);
  EXPECT_EQ(nearest.nearest_neighbor(0), (Periodic_image{0, {-1, 0}}));
  const auto& changes = nearest.changes();
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].time, Time(0.0));
  EXPECT_EQ(changes[0].before, no_point);
  EXPECT_EQ(changes[1].time, Time(1.0));
  EXPECT_EQ(changes[1].before, 0U);
  EXPECT_EQ(changes[1].before_offset, (Lattice_offset_2{0, -1}));
  EXPECT_EQ(changes[1].after, 0U);
  EXPECT_EQ(changes[1].after_offset, (Lattice_offset_2{-1, 0}));
}

// Between two changes nothing changes, and at each change the two images are equally far.
TEST(Periodic_nearest, are_those_of_all_images) {
  std::size_t number = 0;
  std::size_t own = 0;
  for (unsigned seed = 0; seed < test::cases(40u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed));
    Periodic_run run(seed);
    Kinetic& kinetic = run.kinetic();
    Nearest_neighbors nearest(kinetic);
    kinetic.advance_to(1.0);
    if (seed % 2 == 0) static_cast<void>(nearest.changes());
    kinetic.advance_to(3.0);
    const auto changes = nearest.changes();
    std::vector<Periodic_image> present(kinetic.next_id());
    std::set<Time> times = {Time(3.0)};
    for (double t = 0; t < 3; t += 0.75) times.insert(Time(t));
    for (const auto& change : changes) times.insert(change.time);
    auto change = changes.begin();
    for (auto time = times.begin(); *time < Time(3.0); ++time) {
      for (; change != changes.end() && change->time == *time; ++change) {
        ASSERT_EQ(present[change->id], (Periodic_image{change->before, change->before_offset}));
        present[change->id] = {change->after, change->after_offset};
        if (*time == Time(0.0)) continue;
        const auto paths = test::paths_of(std::array<Image_motion_2, 3>{
            Image_motion_2{kinetic.motion(change->id), {}, &run.box()},
            Image_motion_2{kinetic.motion(change->before), change->before_offset, &run.box()},
            Image_motion_2{kinetic.motion(change->after), change->after_offset, &run.box()}});
        const auto square = [&paths](const auto& q) {
          const auto& p = paths[0];
          return (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
        };
        ASSERT_EQ(sign_at(square(paths[1]) - square(paths[2]), *time), CGAL::ZERO);
        ++number;
        own += change->after == change->id;
      }
      const Rational between = simplest_between(*time, *std::next(time));
      for (Point_id id = 0; id < kinetic.next_id(); ++id) {
        ASSERT_EQ(present[id], nearest_of_all(run, kinetic, id, between))
            << "point " << id << " after " << time->to_double();
      }
    }
  }
  EXPECT_GT(number, 250U);
  EXPECT_GT(own, 10U);
}

// Points that turn, jump, come, go, and coincide with images of others for a while.
TEST(Periodic_nearest, of_points_that_change_are_those_of_all_images) {
  for (unsigned seed = 0; seed < test::cases(50u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed));
    Periodic_run run(seed);
    Kinetic& kinetic = run.kinetic();
    Nearest_neighbors nearest(kinetic);
    for (double time = 0; time <= 3; time += 0.5) {
      kinetic.advance_to(time);
      const int changes = run.integer(0, 3);
      for (int i = 0; i < changes; ++i) run.change();
      if (run.integer(0, 2) == 0) continue;
      const auto found = nearest.nearest_neighbors();
      for (Point_id id = 0; id < kinetic.next_id(); ++id) {
        if (!kinetic.contains(id)) continue;
        ASSERT_EQ(found[id], nearest_of_all(run, kinetic, id, to_rational(time)))
            << "point " << id << " at " << time;
      }
    }
  }
}

}  // namespace
}  // namespace kinetri::periodic_nearest_test
