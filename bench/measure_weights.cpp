// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

struct Run {
  double start = 0;  // seconds
  double seconds_per_event = 0;
  std::uint64_t events = 0;
  double hidden_share = 0;  // of the points, at the end
};

template <class Kinetic, class Motion>
Run run(const std::vector<Motion>& motions, double until) {
  const Stopwatch building;
  Kinetic kinetic(motions);
  const double start = building.seconds();
  const Stopwatch watch;
  kinetic.advance_to(Algebraic_number(until));
  const double seconds = watch.seconds();
  const std::uint64_t events = kinetic.counters().number_of_events();
  return {
      start, ratio(seconds, static_cast<double>(events)), events,
      static_cast<double>(kinetic.number_of_hidden_points()) / static_cast<double>(motions.size())};
}

// The centers with weights: `weight` of a random number in [0, 1).
template <class Weight>
std::vector<Disc_motion_2> weighted(const std::vector<Linear_motion_2>& motions, unsigned seed,
                                    const Weight& weight) {
  std::mt19937_64 random(seed);
  std::vector<Disc_motion_2> result;
  for (const Linear_motion_2& motion : motions) {
    result.push_back({motion, 0, 0, weight(static_cast<double>(random() >> 11U) * 0x1p-53)});
  }
  return result;
}

}  // namespace

json measure_weights(const Setup& setup) {
  using Delaunay = Kinetic_delaunay_triangulation_2<>;
  using Regular = Kinetic_regular_triangulation_2<>;
  const std::vector<Linear_motion_2> motions = setup.motions();
  std::vector<Disc_motion_2> equal;
  for (const Linear_motion_2& motion : motions)
    equal.push_back({motion, neighbor_distance / 4, 0, 0});
  const auto seed = static_cast<unsigned>(setup.options.seed);
  // Squares of radii up to a tenth of the distance of neighbors hide few points; a spread of
  // weights of up to six such squares hides about half.
  const double square = neighbor_distance * neighbor_distance;
  const auto unequal = weighted(motions, seed, [&](double u) { return 0.01 * square * u; });
  const auto hiding = weighted(motions, seed, [&](double u) { return 6 * square * u; });
  return median_round([&]() -> json {
    const Run delaunay = run<Delaunay>(motions, setup.until);
    const Run same = run<Regular>(equal, setup.until);
    if (same.events != delaunay.events) {
      throw std::runtime_error("discs of one size have other events than their centers");
    }
    const Run differing = run<Regular>(unequal, setup.until);
    const Run half = run<Regular>(hiding, setup.until);
    return {
        {"seconds_per_event", delaunay.seconds_per_event},
        {"equal_over_delaunay", ratio(same.seconds_per_event, delaunay.seconds_per_event)},
        {"unequal_over_delaunay", ratio(differing.seconds_per_event, delaunay.seconds_per_event)},
        {"hiding_over_unequal", ratio(half.seconds_per_event, differing.seconds_per_event)},
        {"hiding_events_over_unequal",
         ratio(static_cast<double>(half.events), static_cast<double>(differing.events))},
        {"hidden_share", half.hidden_share},
        {"unequal_hidden_share", differing.hidden_share},
        {"start_equal_over_delaunay", ratio(same.start, delaunay.start)},
        {"start_unequal_over_delaunay", ratio(differing.start, delaunay.start)}};
  });
}

}  // namespace kinetri::bench
