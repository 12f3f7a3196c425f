// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/kinetri.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;
using Kinetic = Kinetic_delaunay_triangulation_2<>;

constexpr double least_total_seconds = 2;
constexpr std::size_t most_rounds = 25;

json counters(const Kinetic& triangulation) {
  const Certificate_counters certificates = triangulation.certificate_counters();
  const Queue_counters queue = triangulation.queue_counters();
  return {{"events", triangulation.counters().number_of_events()},
          {"reconstructions", triangulation.counters().reconstructions},
          {"pushed", queue.pushed},
          {"discarded", queue.discarded},
          {"peak", queue.peak},
          {"created", certificates.created},
          {"root_solves", certificates.root_solves},
          {"filter_decided", certificates.filter_decided},
          {"exact_decided", certificates.exact_decided}};
}

json counters(const Uncertified_kinetic_delaunay& triangulation) {
  const Uncertified_counters& c = triangulation.counters();
  return {{"events", c.executed},      {"scheduled", c.scheduled},
          {"discarded", c.discarded},  {"looked_again", c.looked_again},
          {"created", c.certificates}, {"root_solves", c.root_solves}};
}

bool same_edges(const std::vector<Edge_ids>& exact, const Uncertified_kinetic_delaunay& other) {
  return std::ranges::equal(exact, other.finite_edge_ids(), [](const Edge_ids& a, const auto& b) {
    return a == Edge_ids{b.first, b.second};
  });
}

// One run of each.
json measure_round(const Setup& setup, const std::vector<Linear_motion_2>& motions,
                   const std::vector<Static_kernel::Point_2>& halfway) {
  json result;
  const double points = static_cast<double>(motions.size());
  const double rebuild = rebuild_seconds(halfway);
  result["rebuild_seconds_per_point"] = rebuild / points;
  double per_event = 0;
  std::vector<Edge_ids> edges;
  {
    Kinetic exact(motions);
    const Certificate_counters initial = exact.certificate_counters();
    const std::size_t initial_edges = exact.triangulation().tds().number_of_edges();
    const Stopwatch watch;
    const auto events = static_cast<double>(exact.advance_to(setup.until));
    const double seconds = watch.seconds();
    per_event = ratio(seconds, events);
    const auto [build, initialize] = exact.construction_seconds();
    result["build_seconds"] = build;
    result["initialize_seconds"] = initialize;
    result["initial_certificates"] = initial.created;
    result["initial_root_solves"] = initial.root_solves;
    result["initial_edges"] = initial_edges;
    result["seconds_per_initial_edge"] = ratio(initialize, static_cast<double>(initial_edges));
    result["run_seconds"] = seconds;
    result["seconds_per_event"] = per_event;
    result["event_over_rebuild_point"] = ratio(per_event, rebuild / points);
    result["counters"] = counters(exact);
    edges = exact.finite_edge_ids();
    // Freed here, so that the baseline runs in as much memory as this did.
  }
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [name, range] :
       {std::pair("eager", Outlook_range::unlimited), std::pair("lazy", Outlook_range::window)}) {
    Uncertified_kinetic_delaunay baseline(motions, range);
    const Stopwatch watch;
    baseline.advance_to(setup.until);
    const double seconds = watch.seconds();
    const double baseline_per_event =
        ratio(seconds, static_cast<double>(baseline.counters().executed));
    best = std::min(best, baseline_per_event);
    result["baseline"][name] = {{"run_seconds", seconds},
                                {"initialize_seconds", baseline.initialize_seconds()},
                                {"seconds_per_event", baseline_per_event},
                                {"same_edges_at_end", same_edges(edges, baseline)},
                                {"counters", counters(baseline)}};
  }
  result["event_over_baseline_event"] = ratio(per_event, best);
  return result;
}

// The median over the rounds of each floating-point number. Counts are equal in all rounds.
json medians(const std::vector<json>& rounds) {
  json result = rounds.front();
  const json flat = rounds.front().flatten();
  for (const auto& [path, first] : flat.items()) {
    if (!first.is_number_float()) continue;
    std::vector<double> values;
    for (const json& round : rounds) values.push_back(round.at(json::json_pointer(path)));
    result.at(json::json_pointer(path)) = median(std::move(values));
  }
  return result;
}

}  // namespace

double ratio(double numerator, double denominator) {
  return denominator > 0 ? numerator / denominator : 0;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<Static_kernel::Point_2> positions(const std::vector<Linear_motion_2>& motions,
                                              double time) {
  std::vector<Static_kernel::Point_2> result;
  result.reserve(motions.size());
  for (const Linear_motion_2& m : motions) {
    const double elapsed = time - m.epoch;
    result.emplace_back(m.position.x + m.velocity.x * elapsed,
                        m.position.y + m.velocity.y * elapsed);
  }
  return result;
}

double rebuild_seconds(const std::vector<Static_kernel::Point_2>& points) {
  constexpr double enough = 0.2;
  double total = 0;
  int repeats = 0;
  while (total < enough) {
    const Stopwatch watch;
    const Static_triangulation triangulation(points.begin(), points.end());
    total += watch.seconds();
    ++repeats;
  }
  return total / repeats;
}

json median_round(const std::function<json()>& round) {
  std::vector<json> rounds;
  const Stopwatch watch;
  do {
    rounds.push_back(round());
  } while (watch.seconds() < least_total_seconds && rounds.size() < most_rounds);
  json result = medians(rounds);
  result["rounds"] = rounds.size();
  return result;
}

json measure_events(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  const auto halfway = positions(motions, 0.5 * setup.until);
  return median_round([&] { return measure_round(setup, motions, halfway); });
}

// The peak of this process so far.
double peak_rss_bytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024;
}

json measure_memory(const Setup& setup) {
  const auto points = static_cast<double>(setup.options.points);
  json result;
  {
    Kinetic exact(setup.motions());
    exact.advance_to(setup.until);
    const double bytes = peak_rss_bytes();
    result = {{"peak_rss_bytes", bytes},
              {"bytes_per_point", bytes / points},
              {"counters", counters(exact)}};
  }
  // Measured second, since it needs more.
  Kinetic exact(setup.motions());
  exact.set_threads(0);
  exact.advance_to(setup.until);
  result["bytes_per_point_with_threads"] = peak_rss_bytes() / points;
  return result;
}

json measure_lattice_row(const Setup& setup) {
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(setup.options.points)));
  std::vector<Linear_motion_2> lattice;
  for (std::size_t i = 0; i < side * side; ++i) {
    const std::size_t row = i / side;
    const double speed = row == side / 2 ? 1 : 0;
    lattice.push_back({{static_cast<double>(i % side), static_cast<double>(row)}, {speed, 0}, 0});
  }
  const auto seconds_per_event = [](const std::vector<Linear_motion_2>& motions) {
    Kinetic exact(motions);
    const Stopwatch watch;
    const auto events = static_cast<double>(exact.advance_to(1.0));
    return ratio(watch.seconds(), events);
  };
  const double of_lattice = seconds_per_event(lattice);
  const double of_scenario = seconds_per_event(setup.motions());
  return {{"seconds_per_event", of_lattice}, {"event_over_event", ratio(of_lattice, of_scenario)}};
}

Periodic_box_2 periodic_square(const std::vector<Linear_motion_2>& motions) {
  double side = 0;
  for (const Linear_motion_2& m : motions) {
    side = std::max({side, m.position.x, m.position.y});
  }
  return {{{side, 0}, {0, 0}, 0}, {{0, side}, {0, 0}, 0}};
}

json measure_periodic(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  const Periodic_kinetic_traits_2 box(periodic_square(motions));
  const auto run = [&](const auto& traits) {
    using Traits = std::remove_cvref_t<decltype(traits)>;
    const Stopwatch start;
    Kinetic_triangulation_2<Traits> triangulation(motions, Algebraic_number(), traits);
    const double start_seconds = start.seconds();
    const Stopwatch watch;
    const auto events = static_cast<double>(triangulation.advance_to(setup.until));
    return std::array{start_seconds / static_cast<double>(motions.size()), events,
                      ratio(watch.seconds(), events)};
  };
  return median_round([&]() -> json {
    const auto [start, events, event] = run(box);
    const auto [start_in_plane, events_in_plane, event_in_plane] = run(Linear_kinetic_traits_2());
    return {{"events", events},
            {"events_in_plane", events_in_plane},
            {"seconds_per_event", event},
            {"event_over_event_in_plane", ratio(event, event_in_plane)},
            {"start_seconds_per_point", start},
            {"start_over_start_in_plane", ratio(start, start_in_plane)}};
  });
}

json measure_paper_table(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  Uncertified_kinetic_delaunay eager(motions, Outlook_range::unlimited);
  eager.advance_to(setup.until);
  Kinetic lazy(motions);
  lazy.advance_to(setup.until);
  json result = {{"eager", counters(eager)}, {"lazy", counters(lazy)}};
  // The same count under another name.
  result["lazy"]["scheduled"] = result["lazy"]["pushed"];
  return result;
}

}  // namespace kinetri::bench
