// SPDX-License-Identifier: GPL-3.0-or-later
//
// One run by the plain loop, by regions one after the other, and by regions on all threads.
#include <cmath>
#include <cstddef>
#include <cstdint>

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
          {"by_rest", counters.by_rest},
          {"by_loop", counters.by_loop},
          {"deferred", counters.deferred},
          {"undone", counters.undone},
          {"cut_off", counters.cut_off}};
}

}  // namespace

json measure_regions(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  std::size_t events = 0;
  const double loop = seconds_of_loop(setup, motions, events);
  const json one = run_by_regions(setup, motions, 1);
  const json threads = run_by_regions(setup, motions, 0);
  return {{"events", events},
          {"loop_seconds", loop},
          {"one_thread", one},
          {"threads", threads},
          {"loop_over_one_thread", ratio(loop, one["seconds"].get<double>())},
          {"loop_over_threads", ratio(loop, threads["seconds"].get<double>())}};
}

}  // namespace kinetri::bench
