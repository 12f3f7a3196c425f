// SPDX-License-Identifier: GPL-3.0-or-later
//
// Optimistic parallel execution, compared with the sequential loop.
#ifndef KINETRI_TEST_SUPPORT_REGION_RUNS_H
#define KINETRI_TEST_SUPPORT_REGION_RUNS_H

#include <tbb/global_control.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/io/event_log.h"
#include "kinetri/simulation/recording.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/kinetic_runs.h"
#include "triangulation/regions.h"

namespace kinetri::test {

using detail::Region_counters;
using detail::Region_options;

/// Records events, without a look at the triangulation.
class Log : public Event_observer {
 public:
  bool looks_at_triangulation() const override { return false; }
  void before_event(const Event& event) override { befores.push_back(event.number); }
  void after_event(const Event& event) override { events.push_back(event); }
  void after_rebuild(const Algebraic_number& time, std::span<const Edge_ids> edges) override {
    rebuilds.push_back({events.size(), time, {edges.begin(), edges.end()}});
  }

  /// A report of rebuilt edges.
  struct Rebuild {
    std::size_t events;  ///< number of events before it
    Algebraic_number time;
    std::vector<Edge_ids> edges;

    bool operator==(const Rebuild&) const = default;
  };

  std::vector<std::uint64_t> befores;
  std::vector<Event> events;
  std::vector<Rebuild> rebuilds;
};

/// In a periodic box the edges of images.
template <class Traits>
auto named_edges(const Kinetic_triangulation_2<Traits>& kinetic) {
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    return kinetic.periodic_edges();
  } else {
    return kinetic.finite_edge_ids();
  }
}

/// The difference of two states, except for counts that depend on how the run was made.
template <class Traits>
std::string difference_of_states(const Kinetic_triangulation_2<Traits>& one,
                                 const Kinetic_triangulation_2<Traits>& other) {
  const auto a = one.snapshot();
  const auto b = other.snapshot();
  if (a.time != b.time) return "times";
  if (a.motions != b.motions) return "motions";
  if (named_edges(one) != named_edges(other)) return "edges";
  for (Point_id id = 0; id < one.next_id(); ++id) {
    if (one.contains(id) && one.is_hidden(id) != other.is_hidden(id)) return "hidden points";
  }
  if (a.counters.events != b.counters.events) return "counts of events";
  if (a.counters.instants != b.counters.instants) return "counts of instants";
  if (a.counters.largest_instant != b.counters.largest_instant) return "largest instants";
  if (a.counters.batches != b.counters.batches) return "counts of batches";
  if (a.counters.flat_hulls != b.counters.flat_hulls) return "counts of flat hulls";
  if (a.counters.points_set_aside != b.counters.points_set_aside) return "points set aside";
  if (a.counters.reconstructions != b.counters.reconstructions) return "reconstructions";
  return {};
}

inline void add(Region_counters& sum, const Region_counters& counters) {
  sum.windows += counters.windows;
  sum.truncated_windows += counters.truncated_windows;
  sum.by_region += counters.by_region;
  sum.by_union += counters.by_union;
  sum.by_root += counters.by_root;
  sum.rolled_back += counters.rolled_back;
  sum.truncated += counters.truncated;
}

/// The difference between the sequential loop and parallel execution, with and without observers,
/// in pieces that end at `times`.
template <class Traits = Linear_kinetic_traits_2>
std::string difference_from_loop(const std::vector<typename Traits::Motion>& motions,
                                 const std::vector<Algebraic_number>& times,
                                 const Region_options& options, Region_counters& sum,
                                 const Traits& traits = {}) {
  using Kinetic = Kinetic_triangulation_2<Traits>;
  // More threads than this machine may have.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  Kinetic plain(motions, 0, traits);
  Kinetic watched(motions, 0, traits);
  Kinetic alone(motions, 0, traits);
  Log expected;
  Log log;
  plain.add_observer(expected);
  watched.add_observer(log);
  std::ostringstream expected_text;
  std::ostringstream text;
  const Event_columns columns =
      PeriodicKineticTraits_2<Traits> ? Event_columns::periodic : Event_columns::planar;
  Event_log_writer expected_writer(expected_text, columns);
  Event_log_writer writer(text, columns);
  plain.add_observer(expected_writer);
  watched.add_observer(writer);
  const double end = times.back().to_double();
  kinetri::Recorder<Traits> expected_recorder(plain, end, 1'000'000);
  kinetri::Recorder<Traits> recorder(watched, end, 1'000'000);
  plain.add_observer(expected_recorder);
  watched.add_observer(recorder);
  auto watched_run = detail::region_run_of(watched, options);
  auto run = detail::region_run_of(alone, options);
  for (const Algebraic_number& time : times) {
    const std::size_t count = plain.advance_to(time);
    if (watched_run.advance_to(time) != count) return "another number of events";
    if (run.advance_to(time) != count) return "another number of events without an observer";
    std::string problem = difference(expected.events, log.events);
    if (!problem.empty()) return problem;
    if (expected.befores != log.befores) return "other numbers of events";
    if (expected.rebuilds != log.rebuilds) return "other edges rebuilt";
    problem = difference_of_states(plain, watched);
    if (!problem.empty()) return problem;
    problem = difference_of_states(plain, alone);
    if (!problem.empty()) return problem + " without an observer";
    const bool is_small = motions.size() < 100;
    problem = audit_problem(watched, is_small ? Audit_level::certificates : Audit_level::links);
    if (!problem.empty()) return problem;
    if (plain.next_event_time() != watched.next_event_time()) return "another next event";
  }
  add(sum, watched_run.counters());
  const Recording expected_recording = expected_recorder.recording();
  const Recording recording = recorder.recording();
  if (expected_recording.events.size() != recording.events.size()) return "recorded events";
  if (expected_recording.triangles != recording.triangles) return "recorded triangles";
  return expected_text.str() == text.str() ? "" : "texts of the logs";
}

/// The motions with radii up to `radius`, whole if `are_whole`, and growths up to `growth`.
template <class Motion>
std::vector<Basic_disc_motion_2<Motion>> discs_of(const std::vector<Motion>& motions, double radius,
                                                  double growth, bool are_whole, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto up_to = [&](double most) {
    const double number = std::uniform_real_distribution<double>(0, most)(random);
    return are_whole ? std::floor(number) : number;
  };
  std::vector<Basic_disc_motion_2<Motion>> result;
  for (const Motion& motion : motions) {
    const double r = up_to(radius);
    result.push_back({motion, r, up_to(growth), 0});
  }
  return result;
}

inline Region_options options_of(std::size_t regions, double events_per_vertex) {
  Region_options options;
  options.regions = regions;
  options.events_per_vertex = events_per_vertex;
  options.least_events_per_vertex = 0;
  options.most_waste = std::numeric_limits<double>::infinity();
  options.points_per_hidden_one = 0;
  options.events_per_division = 1;
  if (regions % 5 == 4) options.most_flips = 3;
  if (regions % 3 == 1) options.version_bits = 12;
  if (regions % 3 == 2) options.flips_per_slice = 4;
  options.threads = regions % 2 == 1 ? 1 + regions % 8 : 1;
  options.order_of_tasks = regions;
  return options;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_REGION_RUNS_H
