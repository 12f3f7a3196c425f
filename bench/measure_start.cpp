// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <random>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

// Mean seconds per event until the given time.
template <class Traits, class Motion>
double seconds_per_event(const std::vector<Motion>& motions, double until) {
  Kinetic_delaunay_triangulation_2<Traits> kinetic(motions);
  const Stopwatch watch;
  const auto events = static_cast<double>(kinetic.advance_to(Algebraic_number(until)));
  return ratio(watch.seconds(), events);
}

// The mean over as many starts as take 0.2 seconds, as of static triangulations.
Construction_seconds start_seconds(const std::vector<Linear_motion_2>& motions) {
  Construction_seconds sum;
  double starts = 0;
  for (const Stopwatch watch; starts == 0 || watch.seconds() < 0.2; ++starts) {
    const Construction_seconds seconds =
        Kinetic_delaunay_triangulation_2<>(motions).construction_seconds();
    sum.build += seconds.build;
    sum.initialize += seconds.initialize;
  }
  return {sum.build / starts, sum.initialize / starts};
}

}  // namespace

json measure_start(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  const auto places = positions(motions, 0);
  const double n = static_cast<double>(motions.size());
  return median_round([&]() -> json {
    const Construction_seconds start = start_seconds(motions);
    const double fixed = rebuild_seconds(places);
    return {{"build_ns", 1e9 * start.build / n},
            {"first_certificates_ns", 1e9 * start.initialize / n},
            {"static_ns", 1e9 * fixed / n},
            {"build_over_static", ratio(start.build, fixed)},
            {"start_over_static", ratio(start.build + start.initialize, fixed)}};
  });
}

json measure_accelerated(const Setup& setup) {
  const std::vector<Linear_motion_2> straight = setup.motions();
  std::mt19937_64 random(setup.options.seed);
  std::uniform_real_distribution<double> component(-1, 1);
  std::vector<Polynomial_motion_2> accelerated;
  for (const Linear_motion_2& m : straight) {
    Polynomial_motion_2& motion = accelerated.emplace_back(polynomial_motion(m));
    motion.acceleration.x = component(random);
    motion.acceleration.y = component(random);
  }
  // So speeds keep their order of magnitude.
  const double until = std::min(setup.until, 5.0);
  return median_round([&]() -> json {
    const double of_straight = seconds_per_event<Linear_kinetic_traits_2>(straight, until);
    const double of_accelerated =
        seconds_per_event<Polynomial_kinetic_traits_2>(accelerated, until);
    return {{"straight_ns", 1e9 * of_straight},
            {"accelerated_ns", 1e9 * of_accelerated},
            {"accelerated_over_straight", ratio(of_accelerated, of_straight)}};
  });
}

}  // namespace kinetri::bench
