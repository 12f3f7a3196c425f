// SPDX-License-Identifier: GPL-3.0-or-later
//
// One run by the plain loop, by regions one after the other, and by regions on all threads, three
// times in turn: the times of the last round, and the ratios of all, sorted.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinetri/triangulation/detail/regions.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;
using Kinetic = Kinetic_delaunay_triangulation_2<>;

double seconds_of_loop(const Setup& setup, const std::vector<Linear_motion_2>& motions,
                       std::size_t& events) {
  Kinetic kinetic(motions);
  const Stopwatch watch;
  events = kinetic.advance_to(setup.until);
  return watch.seconds();
}

json run_by_regions(const Setup& setup, const std::vector<Linear_motion_2>& motions,
                    std::size_t threads) {
  Kinetic kinetic(motions);
  detail::Region_options options;
  options.threads = threads;
  options.least_events_per_vertex = 0;
  detail::Region_run<Kinetic> run(kinetic, options);
  const Stopwatch watch;
  run.advance_to(setup.until);
  const double seconds = watch.seconds();
  const detail::Region_counters& counters = run.counters();
  return {{"seconds", seconds},
          {"windows", counters.windows},
          {"cuts", counters.cuts},
          {"by_region", counters.by_region},
          {"by_union", counters.by_union},
          {"by_rest", counters.by_rest},
          {"by_loop", counters.by_loop},
          {"deferred", counters.deferred},
          {"undone", counters.undone},
          {"cut_off", counters.cut_off}};
}

}  // namespace

json measure_regions(const Setup& setup) {
  constexpr int rounds = 3;
  const std::vector<Linear_motion_2> motions = setup.motions();
  std::size_t events = 0;
  json result;
  std::vector<double> over_one_thread;
  std::vector<double> over_threads;
  for (int round = 0; round < rounds; ++round) {
    const double loop = seconds_of_loop(setup, motions, events);
    result["one_thread"] = run_by_regions(setup, motions, 1);
    result["threads"] = run_by_regions(setup, motions, 0);
    result["loop_seconds"] = loop;
    over_one_thread.push_back(ratio(loop, result["one_thread"]["seconds"].get<double>()));
    over_threads.push_back(ratio(loop, result["threads"]["seconds"].get<double>()));
  }
  result["events"] = events;
  std::ranges::sort(over_one_thread);
  std::ranges::sort(over_threads);
  result["loop_over_one_thread"] = over_one_thread;
  result["loop_over_threads"] = over_threads;
  return result;
}

}  // namespace kinetri::bench
