// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "bench_discs.h"
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "measurements.h"
#include "simulation/contact_events.h"
#include "triangulation/regions.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;
using Kinetic = Kinetic_delaunay_triangulation_2<>;

// One run in time windows.
template <class Make>
json run_by_regions(const Setup& setup, const Make& make, std::size_t threads) {
  auto kinetic = make();
  detail::Region_options options;
  options.threads = threads;
  options.least_events_per_vertex = 0;
  options.most_waste = std::numeric_limits<double>::infinity();
  auto run = detail::region_run_of(kinetic, options);
  const Stopwatch watch;
  run.advance_to(setup.until);
  const double seconds = watch.seconds();
  const detail::Region_counters& counters = run.counters();
  return {{"seconds", seconds},
          {"windows", counters.windows},
          {"truncated_windows", counters.truncated_windows},
          {"by_region", counters.by_region},
          {"by_union", counters.by_union},
          {"by_root", counters.by_root},
          {"rolled_back", counters.rolled_back},
          {"truncated", counters.truncated}};
}

template <class Make>
json measure_runs(const Setup& setup, const Make& make) {
  constexpr int rounds = 3;
  json result;
  std::vector<double> over_one_thread;
  std::vector<double> over_threads;
  for (int round = 0; round < rounds; ++round) {
    double loop = 0;
    {
      auto kinetic = make();
      const Stopwatch watch;
      result["events"] = kinetic.advance_to(setup.until);
      loop = watch.seconds();
    }
    result["one_thread"] = run_by_regions(setup, make, 1);
    result["threads"] = run_by_regions(setup, make, 0);
    result["loop_seconds"] = loop;
    over_one_thread.push_back(ratio(loop, result["one_thread"]["seconds"].get<double>()));
    over_threads.push_back(ratio(loop, result["threads"]["seconds"].get<double>()));
  }
  std::ranges::sort(over_one_thread);
  std::ranges::sort(over_threads);
  result["loop_over_one_thread"] = over_one_thread;
  result["loop_over_threads"] = over_threads;
  return result;
}

}  // namespace

json measure_regions(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  return measure_runs(setup, [&] { return Kinetic(motions); });
}

json measure_periodic_regions(const Setup& setup) {
  using In_box = Kinetic_triangulation_2<Periodic_kinetic_traits_2>;
  const std::vector<Linear_motion_2> motions = setup.motions();
  const Periodic_kinetic_traits_2 traits(periodic_square(motions));
  return measure_runs(setup, [&] { return In_box(motions, Algebraic_number(), traits); });
}

json measure_periodic_contacts(const Setup& setup) {
  const Bench_discs discs = equal_discs(setup);
  Simulation_options options;
  options.response = collide_elastically;
  options.radius = discs.radii.front();
  const Vector_2 size = {discs.box.xmax - discs.box.xmin, discs.box.ymax - discs.box.ymin};
  const Periodic_kinetic_traits_2 traits({{{size.x, 0}, {0, 0}, 0}, {{0, size.y}, {0, 0}, 0}});
  return measure_runs(setup, [&] {
    return Simulation_2<Periodic_kinetic_traits_2>(discs.motions, options, 0, traits);
  });
}

json measure_contacts(const Setup& setup) {
  Simulation_options options;
  options.response = collide_elastically;
  if (!setup.size_ratio) {
    const Bench_discs discs = equal_discs(setup);
    options.box = discs.box;
    options.radius = discs.radii.front();
    return measure_runs(
        setup, [&] { return Simulation_2<Linear_kinetic_traits_2>(discs.motions, options); });
  }
  const Bench_discs discs = discs_of_different_sizes(setup);
  options.box = discs.box;
  std::vector<Disc_motion_2> motions;
  for (std::size_t i = 0; i < discs.motions.size(); ++i) {
    options.masses.push_back(discs.radii[i] * discs.radii[i]);
    motions.push_back({discs.motions[i], discs.radii[i], 0, 0});
  }
  return measure_runs(setup, [&] { return Simulation_2<Disc_kinetic_traits_2>(motions, options); });
}

}  // namespace kinetri::bench
